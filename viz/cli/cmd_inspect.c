/* cmd_inspect.c - octreel inspect: the tree of a point cloud, drawn and counted. */
#include "command.h"
#include "film.h"
#include "inspect.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>

static const char help[] =
    "usage: octreel inspect CLOUD [-o PICTURE.png] [OPTION ...]\n\n"
    "Build an octree from a point cloud (x y z text, PLY or PCD), print its statistics, and draw its subdivision.\n\n"
    "  -o, --output FILE     draw the tree into this PNG\n"
    "      --capacity N      points a leaf holds before it splits (default 64)\n"
    "      --depth N         deepest level, 0 to 21 (default 21)\n"
    "      --full MODE       what a full leaf at that depth does: grow (default) or refuse\n"
    "      --world BOX       x0,y0,z0,x1,y1,z1 (default: the smallest cube around the points)\n"
    "      --node ADDRESS    print one node, as in 0/3/7 (or root): its box and its points\n"
    "      --nodes FILE.csv  write all nodes\n";

static const char more_help[] = "      --json            print JSON\n"
                                "  -h, --help\n\n"
                                "Examples: octreel inspect scan.pcd -o tree.png --capacity 32\n"
                                "          octreel inspect points.txt --node 0/3 --json\n";

typedef struct arguments {
    const char *cloud, *picture, *node, *nodes;
    octree_def def;
    bool has_world, json;
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

static bool take_option(arguments *a, int option)
{
    if (take_view_option(&a->view_options, option))
        return true;
    switch (option) {
    case 'o':
        a->picture = optarg;
        return true;
    case 'n':
        a->node = optarg;
        return true;
    case 'N':
        a->nodes = optarg;
        return true;
    case OPTION_CONTEXT:
        return read_context(optarg, &a->renderer);
    case OPTION_ANY_RENDERER:
        return a->renderer.any_renderer = true;
    case 'j':
        a->json = true;
        return true;
    case 'C':
    case 'd':
    case 'f':
    case 'w':
        return read_tree_option(a, option);
    default:
        fputs("octreel inspect --help tells what it takes\n", stderr);
        return false;
    }
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static int report(const arguments *a, const inspection *made)
{
    record_error error;
    film_summary drawn = {0};
    octree_node node;
    const char *name = base_name(a->cloud);
    const film_options options = {.view = a->view, .renderer = a->renderer};
    if (a->node && !inspect_find_node(made, a->node, &node, &error))
        return trouble("%s", error.text);
    const tree_look about = {.title = name, .node = a->node ? node.address : 0};
    if (a->picture && !film_tree(made->tree, &about, &options, a->picture, &drawn, &error))
        return trouble("%s", error.text);
    if (drawn.over_budget)
        fprintf(stderr, "octreel: %s leaves out what is beyond --budget\n", a->picture);
    if (a->nodes && !inspect_write_nodes(made, a->nodes, &error))
        return trouble("%s", error.text);
    if (a->node)
        inspect_print_node(&node, a->json, stdout);
    else if (a->json)
        inspect_print_json(made, name, stdout);
    else
        inspect_print(made, name, stdout);
    return EXIT_DONE;
}

static int inspect_it(arguments *a)
{
    cloud points;
    cloud_error unread;
    if (!cloud_read(a->cloud, &points, &unread))
        return trouble("%s", unread.text);
    if (!a->has_world)
        a->def.world = inspect_world(&points);
    inspection made;
    record_error error;
    const bool built = inspect_build(&points, &a->def, &made, &error);
    cloud_release(&points);
    if (!built)
        return trouble("%s: %s", a->cloud, error.text);
    const int status = report(a, &made);
    inspect_release(&made);
    return status;
}

int cmd_inspect(int argc, char **argv)
{
    arguments a = {.def = octree_def_default(), .view = view_default()};
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
    if (argc - optind != 1)
        return trouble("inspect takes one point cloud; octreel inspect --help tells more");
    a.cloud = argv[optind];
    return check_renderer(&a.renderer) && read_view(&a.view_options, &a.view) ? inspect_it(&a) : EXIT_TROUBLE;
}
