/* cmd_inspect.c - octreel inspect: the trees of point clouds, drawn, counted and asked. */
#include "command.h"
#include "film.h"
#include "inspect.h"
#include "inspect_output.h"
#include "inspect_query.h"

#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char help[] =
    "usage: octreel inspect CLOUD ... [-o PICTURE.png] [OPTION ...]\n\n"
    "Build an octree from a point cloud (x y z text, PLY or PCD), print its statistics, and draw its subdivision. Of\n"
    "several clouds each has a tree of its own.\n\n"
    "  -o, --output FILE     draw the tree into this PNG; for several clouds a folder: DIR/scan.pcd.png ...\n"
    "      --capacity N      points a leaf holds before it splits (default 64)\n"
    "      --depth N         deepest level, 0 to 21 (default 21)\n"
    "      --full MODE       what a full leaf at that depth does: grow (default) or refuse\n"
    "      --world BOX       x0,y0,z0,x1,y1,z1 (default: the smallest cube around the points)\n"
    "      --node ADDRESS    print one node, as in 0/3/7 (or root): its box and its points; a picture marks it\n"
    "      --nodes FILE.csv  write all nodes; for several clouds into a folder\n"
    "      --nearest X,Y,Z[,K]        print and draw the point nearest to a place, or the K nearest\n"
    "      --radius X,Y,Z,R           and the points within R of a place\n"
    "      --range X0,Y0,Z0,X1,Y1,Z1  and the points in a box; these three can be given several times\n";

static const char more_help[] = "      --json            print JSON, one object a cloud\n"
                                "  -h, --help\n\n"
                                "Points are numbered from 0 in the order of the file.\n\n"
                                "Examples: octreel inspect scan.pcd -o tree.png --capacity 32\n"
                                "          octreel inspect points.txt --node 0/3 --json\n"
                                "          octreel inspect a.pcd b.ply -o pictures/ --nearest 1,2,3,8\n";

#define MOST_QUERIES 100

typedef struct arguments {
    char *const *clouds;
    size_t cloud_count;
    inspect_output picture, nodes;
    const char *node;
    octree_query queries[MOST_QUERIES];
    size_t query_count;
    octree_def def;
    bool has_world, json;
    const char *who_draws; /* the option that says so; null: none does */
    view_options view_options;
    view view;
    renderer_choice renderer;
} arguments;

static const struct option own_options[] = {
    {"output", required_argument, NULL, 'o'},
    {"capacity", required_argument, NULL, 'C'},
    {"depth", required_argument, NULL, 'd'},
    {"full", required_argument, NULL, 'f'},
    {"world", required_argument, NULL, 'w'},
    {"node", required_argument, NULL, 'n'},
    {"nodes", required_argument, NULL, 'N'},
    {"nearest", required_argument, NULL, 'q'},
    {"radius", required_argument, NULL, 'r'},
    {"range", required_argument, NULL, 'b'},
    {"json", no_argument, NULL, 'j'},
    {"help", no_argument, NULL, 'h'},
    {"context", required_argument, NULL, OPTION_CONTEXT},
    {"any-renderer", no_argument, NULL, OPTION_ANY_RENDERER},
    {NULL, 0, NULL, 0},
};

static bool read_world(const char *text, octree_box *world)
{
    if (!read_box("--world", text, world))
        return false;
    for (int i = 0; i < 3; i++) {
        if (world->min[i] == world->max[i]) {
            trouble("--world: min must be below max on every axis, not so in \"%s\"", text);
            return false;
        }
    }
    return true;
}

static bool read_full(const char *text, octree_full_leaf *mode)
{
    *mode = strcmp(text, "grow") == 0 ? OCTREE_GROW : OCTREE_REFUSE;
    if (*mode == OCTREE_GROW || strcmp(text, "refuse") == 0)
        return true;
    trouble("--full takes refuse or grow, not \"%s\"", text);
    return false;
}

static bool read_tree_option(arguments *a, int option)
{
    uint64_t value = 0;
    bool ok = true;
    switch (option) {
    case 'C':
        ok = read_count("--capacity", optarg, 1, UINT32_MAX, &value);
        a->def.leaf_capacity = (size_t)value;
        return ok;
    case 'd':
        if (strchr(optarg, ':')) {
            trouble("--depth is that of the tree, one number; --depths %s shows some of its levels", optarg);
            return false;
        }
        ok = read_count("--depth", optarg, 0, OCTREE_MAX_DEPTH, &value);
        a->def.max_depth = (size_t)value;
        return ok;
    case 'f':
        return read_full(optarg, &a->def.full_leaf);
    default:
        a->has_world = true;
        return read_world(optarg, &a->def.world);
    }
}

static bool take_query(arguments *a, int option)
{
    octree_query *query = &a->queries[a->query_count];
    if (a->query_count == MOST_QUERIES) {
        trouble("inspect takes at most %d queries", MOST_QUERIES);
        return false;
    }
    a->query_count++;
    return option == 'q'   ? read_nearest(optarg, query)
           : option == 'r' ? read_radius(optarg, query)
                           : read_range(optarg, query);
}

static bool take_node(arguments *a, const char *address)
{
    if (a->node)
        trouble("--node names one node, not %s and %s", a->node, address);
    const bool first = !a->node;
    a->node = address;
    return first;
}

static bool take_option(arguments *a, int option)
{
    if (take_view_option(&a->view_options, option))
        return true;
    switch (option) {
    case 'o':
        a->picture.given = optarg;
        return check_name("-o", optarg);
    case 'n':
        return take_node(a, optarg);
    case 'N':
        a->nodes.given = optarg;
        return check_name("--nodes", optarg);
    case 'j':
        a->json = true;
        return true;
    case 'C':
    case 'd':
    case 'f':
    case 'w':
        return read_tree_option(a, option);
    case 'q':
    case 'r':
    case 'b':
        return take_query(a, option);
    case OPTION_CONTEXT:
        a->who_draws = "context";
        return read_context(optarg, &a->renderer);
    case OPTION_ANY_RENDERER:
        a->who_draws = "any-renderer";
        return a->renderer.any_renderer = true;
    default:
        fputs("octreel inspect --help tells what it takes\n", stderr);
        return false;
    }
}

/* ---- Progress -------------------------------------------------------------------------------------------------- */

/* How much of the clouds has been read, in bytes. */
typedef struct reading {
    progress bar;
    double before, here, all;
} reading;

static void on_step(double part, void *context)
{
    reading *r = context;
    progress_show(&r->bar, (uint64_t)((r->before + r->here * part) / 1000), (uint64_t)(r->all / 1000));
}

/* ---- One cloud ---------------------------------------------------------------------------------------------- */

/* What is said of one cloud. */
typedef struct report {
    const arguments *a;
    const char *cloud;
    const inspection *made;
    octree_node node;
    inspect_answers answers;
} report;

static bool draw(const report *r, octreel_error *error)
{
    film_summary drawn = {0};
    const tree_look about = {.title = inspect_base_name(r->cloud),
                             .node = r->a->node ? r->node.address : 0,
                             .answers = r->answers.answers,
                             .answer_count = r->answers.count};
    const film_options options = {.view = r->a->view, .renderer = r->a->renderer};
    char *path = inspect_output_path(&r->a->picture, r->cloud, error);
    const bool ok = path && film_tree(r->made->tree, &about, &options, path, &drawn, error);
    if (ok && drawn.over_budget)
        fprintf(stderr, "octreel: %s leaves out what is beyond --budget\n", path);
    if (ok && drawn.left_out)
        fprintf(stderr, "octreel: %" PRIu64 " elements are too far off to be in %s\n", drawn.left_out, path);
    free(path);
    return ok;
}

static bool write_nodes(const report *r, octreel_error *error)
{
    char *path = inspect_output_path(&r->a->nodes, r->cloud, error);
    const bool ok = path && inspect_write_nodes(r->made, path, error);
    free(path);
    return ok;
}

/* A node or answers are printed alone, without the statistics. */
static void print(const report *r)
{
    const arguments *a = r->a;
    const char *name = inspect_told_name(r->cloud, a->clouds, a->cloud_count);
    if (a->node)
        inspect_print_node(&r->node, name, a->json, stdout);
    if (a->query_count)
        inspect_print_answers(r->made->tree, &r->answers, name, a->json, stdout);
    if (!a->node && !a->query_count && a->json)
        inspect_print_json(r->made, name, stdout);
    if (!a->node && !a->query_count && !a->json)
        inspect_print(r->made, name, stdout);
}

/* Everything that can be refused comes before the first file is made. */
static bool make_report(report *r, octreel_error *error)
{
    const arguments *a = r->a;
    if (a->node && !inspect_find_node(r->made, a->node, &r->node, error))
        return false;
    if (!inspect_ask(r->made->tree, a->queries, a->query_count, &r->answers, error))
        return false;
    const bool ok = (!a->picture.given || draw(r, error)) && (!a->nodes.given || write_nodes(r, error));
    if (ok)
        print(r);
    inspect_answers_release(&r->answers);
    return ok;
}

static int inspect_one(const arguments *a, const char *path, reading *so_far)
{
    const cloud_watch watch = {on_step, so_far};
    octree_def def = a->def;
    cloud points;
    octreel_error unread;
    octreel_error error;
    inspection made;
    bool ok = cloud_read(path, &watch, &points, &unread);
    if (!ok) {
        progress_end(&so_far->bar);
        return trouble("%s", unread.text);
    }
    if (!a->has_world)
        def.world = inspect_world(&points);
    progress_say(&so_far->bar, "building the tree of %zu points", points.count); /* at once: in parts it takes longer */
    ok = inspect_build(&points, &def, &made, &error);
    progress_end(&so_far->bar); /* what is said next has the line for itself */
    cloud_release(&points);
    if (!ok)
        return trouble("%s: %s", path, error.text);
    report r = {.a = a, .cloud = path, .made = &made};
    ok = make_report(&r, &error);
    inspect_release(&made);
    return ok ? EXIT_DONE : trouble("%s", error.text);
}

/* ---- All of them -------------------------------------------------------------------------------------------- */

/* What is no file is refused when it is read. */
static double bytes_of(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 ? (double)status.st_size : 0;
}

/* One that cannot be inspected does not keep the others from it. */
static int inspect_all(const arguments *a)
{
    reading r = {.bar = progress_start("kB of clouds")};
    int worst = EXIT_DONE;
    for (size_t i = 0; i < a->cloud_count; i++)
        r.all += bytes_of(a->clouds[i]);
    for (size_t i = 0; i < a->cloud_count; i++) {
        r.here = bytes_of(a->clouds[i]);
        const int status = inspect_one(a, a->clouds[i], &r);
        worst = status > worst ? status : worst;
        r.before += r.here;
    }
    return worst;
}

/* What is said of a picture must not be lost because nobody asked for one. */
static bool check_picture(const arguments *a)
{
    const char *first = first_view_option(&a->view_options);
    first = first ? first : a->who_draws;
    if (a->picture.given || !first)
        return true;
    trouble("--%s is about a picture, and none is made without -o", first);
    return false;
}

static int check_and_inspect(arguments *a)
{
    octreel_error error;
    if (!check_names("inspect", a->clouds, (int)a->cloud_count) || !check_picture(a))
        return EXIT_TROUBLE;
    if (!check_renderer(&a->renderer) || !read_view(&a->view_options, &a->view))
        return EXIT_TROUBLE;
    if (!inspect_output_check(&a->picture, a->clouds, a->cloud_count, &error) ||
        !inspect_output_check(&a->nodes, a->clouds, a->cloud_count, &error) ||
        !inspect_outputs_spare((const inspect_output[]){a->picture, a->nodes}, a->clouds, a->cloud_count, &error))
        return trouble("%s", error.text);
    return inspect_all(a);
}

int cmd_inspect(int argc, char **argv)
{
    arguments a = {.picture = {.option = "-o", .ending = ".png"},
                   .nodes = {.option = "--nodes", .ending = ".csv"},
                   .def = octree_def_default(),
                   .view = view_default()};
    struct option options[COMMAND_OPTIONS];
    join_options(own_options, options);
    a.def.full_leaf = OCTREE_GROW;
    a.view.fit = FIT_POINTS; /* the world is a cube around a cloud that seldom is one */
    optind = 1;
    for (int option; (option = getopt_long(argc, argv, "o:h", options, NULL)) != -1;) {
        if (option == 'h') {
            fputs(help, stdout);
            print_view_options(stdout);
            print_renderer_options(stdout);
            fputs(more_help, stdout);
            return EXIT_DONE;
        }
        if (!take_option(&a, option))
            return EXIT_TROUBLE;
    }
    if (optind == argc)
        return trouble("inspect takes a point cloud; octreel inspect --help tells more");
    a.clouds = argv + optind;
    a.cloud_count = (size_t)(argc - optind);
    return check_and_inspect(&a);
}
