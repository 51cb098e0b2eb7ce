/* SPDX-License-Identifier: MIT */
/* cmd_inspect.c - octreel inspect: builds the tree of a point cloud, and prints or draws the tree, its nodes and the
 * answers to queries. */
#include "cloud.h"
#include "cloud_page.h"
#include "command.h"
#include "file.h"
#include "film.h"
#include "film_report.h"
#include "inspect.h"
#include "inspect_advice.h"
#include "inspect_answers.h"
#include "inspect_view.h"
#include "layer.h"
#include "octree/octree.h"
#include "point_scale.h"
#include "number.h"
#include "outputs.h"
#include "point_world.h"
#include "progress.h"
#include "query_options.h"
#include "text.h"
#include "recording_file.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

/* The files that the command can write: a picture or a page, and a CSV file of the nodes. */
enum { PICTURE, NODES, OUTPUTS };

typedef struct arguments {
    const char *cloud;
    output_file outputs[OUTPUTS];
    const char *node; /* the address of the node to print, or null */
    query_options queries;
    octree_def def;
    bool has_world, advise, json, force;
    view_options view_options;
    view view;
    renderer_choice renderer;
} arguments;

/* Returns true if -o names a page and not a picture. */
static bool is_page(const arguments *a)
{
    return a->outputs[PICTURE].path && file_has_ending(a->outputs[PICTURE].path, ".html");
}

static bool read_depth(const command_option *option, const char *text, void *into)
{
    if (strchr(text, ':'))
        return print_refusal(
            "--depth takes one number, the deepest level of the tree; to draw only some levels, use --depths %s", text);
    return read_whole(option, text, into);
}

static const char *full_leaf_name_at(int n)
{
    static const char *const names[] = {[OCTREE_REFUSE] = "refuse", [OCTREE_GROW] = "grow"};
    return n <= OCTREE_GROW ? names[n] : NULL;
}

static const char *full_leaf_words_at(int n)
{
    static const char *const words[] = {[OCTREE_REFUSE] = "refuses the point",
                                        [OCTREE_GROW] =
                                            "keeps the point, although this exceeds the capacity (default)"};
    return n <= OCTREE_GROW ? words[n] : NULL;
}

static bool read_world(const command_option *option, const char *text, void *into)
{
    arguments *a = into;
    octree_box *world = &a->def.world;
    double corners[6];
    a->has_world = true;
    if (!numbers_parse(text, corners, 6))
        return refuse_value(option, "six numbers such as -10,-10,-10,10,10,10", text);
    for (int i = 0; i < 3; i++) {
        world->min[i] = corners[i];
        world->max[i] = corners[i + 3];
        if (world->min[i] >= world->max[i])
            return print_refusal("--%s: the first corner must be below the second on every axis; found \"%s\"",
                                 option->name, text);
    }
    return true;
}

static bool read_node(const command_option *option, const char *text, void *into)
{
    const char **node = into;
    return *node ? print_refusal("--node can be given only once; found %s and %s", *node, text)
                 : read_text(option, text, into);
}

static const command_option options[] = {
    {.help = "The tree:"},
    {"capacity", "N", "points that a leaf holds before it splits (default 64)", .read = read_whole,
     OPTION_VALUE(arguments, def.leaf_capacity), .min = 1, .max = UINT32_MAX},
    {"depth", "N", "deepest level, 0 to 21 (default 21)", .read = read_depth, OPTION_VALUE(arguments, def.max_depth),
     .max = OCTREE_MAX_DEPTH},
    {"full", "MODE", "what a full leaf at the deepest level does with another point: one of", .read = read_choice,
     OPTION_VALUE(arguments, def.full_leaf), .names = full_leaf_name_at, .words = full_leaf_words_at},
    {"world", "BOX", "x0,y0,z0,x1,y1,z1 (default: the smallest cube around the points)", .read = read_world,
     .size = sizeof(arguments)},
    {.help = "What is printed and written:"},
    {"output", "FILE",
     "draw the tree into this PNG, or make a page that shows it in a browser if the name ends with .html; - is a PNG "
     "on "
     "standard output, and the report then goes to standard error",
     .read = read_picture_or_page, OPTION_VALUE(arguments, outputs[PICTURE].path)},
    {"node", "ADDRESS", "print the box and the points of one node, such as 0/3/7 or root; a picture marks it",
     .read = read_node, OPTION_VALUE(arguments, node)},
    {"nodes", "FILE.csv", "write all nodes as CSV; - is standard output, and the report then goes to standard error",
     .read = read_file, OPTION_VALUE(arguments, outputs[NODES].path)},
    {"advise", NULL,
     "measure which --capacity and which epsilon (octree_search.epsilon of the library) save time for these points, "
     "and which errors each epsilon causes. This takes about two seconds for a million points",
     .read = read_flag, OPTION_VALUE(arguments, advise)},
    FORCE_OPTION(arguments, force, FORCE_FILES),
    SHARED_OPTIONS(query_option_row, arguments, queries),
    JSON_OPTION(arguments, json, "print JSON, which lists every point of an answer"),
    {.help = "How the picture looks:"},
    SHARED_OPTIONS(view_option_row, arguments, view_options),
    {.help = "How the picture is drawn:"},
    FILL_OPTION(arguments, renderer.fill),
    SHARED_OPTIONS(renderer_option_row, arguments, renderer),
    {0},
};

/* ---- The report --------------------------------------------------------------------------------------------- */

/* The data of everything that the command prints and draws. */
typedef struct report {
    const arguments *a;
    const char *name; /* the cloud's file name: the last part of its path */
    const inspection *made;
    octree_node node;
    query_options queries; /* the queries of the command line; rays without a thickness have received one */
    inspect_answers answers;
    inspect_advice advice;       /* measured if a->advise is true */
    view view;                   /* the view of the picture */
    char chosen[INSPECT_CHOICE]; /* a sentence about the view options that the program chose by itself, or "" */
} report;

static void note_missing_value(const report *r)
{
    const char *missing = point_scale_missing_value(&r->view, &r->made->values);
    if (missing)
        print_note("no point has %s: --color-points %s shows all points alike", missing,
                   view_point_color_name(r->view.point_color));
}

static bool write_page(const report *r, octreel_error *error)
{
    const arguments *a = r->a;
    const char *path = a->outputs[PICTURE].path;
    const cloud_page page = {.title = r->name,
                             .node = a->node ? r->node.address : 0,
                             .made = r->made,
                             .view = &r->view,
                             .queries = r->queries.items,
                             .query_count = r->queries.count};
    file_writer file;
    progress bar = progress_start("");
    progress_show_sentence(&bar, "writing %s", path);
    const bool ok =
        file_writer_open(&file, path, error) &&
        (cloud_page_write(&page, file.stream, error) ? file_writer_close(&file, error) : file_writer_discard(&file));
    progress_end(&bar);
    if (ok)
        note_missing_value(r);
    return ok;
}

static bool draw_picture(const report *r, octreel_error *error)
{
    film_summary drawn = {0};
    char left_out[FILM_LEFT_OUT];
    const arguments *a = r->a;
    const char *picture = file_output_display_name(a->outputs[PICTURE].path);
    const tree_subject about = {.title = r->name,
                                .node = a->node ? r->node.address : 0,
                                .answers = r->answers.answers,
                                .answer_count = r->answers.count};
    const film_options options = {.view = r->view, .values = &r->made->values, .renderer = a->renderer};
    progress bar = progress_start("");
    progress_show_sentence(&bar, "drawing %s", picture);
    const bool ok = film_tree(r->made->tree, &about, &options, a->outputs[PICTURE].path, &drawn, error);
    progress_end(&bar);
    if (!ok)
        return false;
    if (*drawn.checks.reason.text)
        print_note("%s was not checked: %s", picture, drawn.checks.reason.text);
    note_missing_value(r);
    if (drawn.over_budget)
        print_note("%s leaves out %s beyond --budget", picture, film_left_out_text(drawn.beyond, left_out));
    /* If the picture has the text layer, the picture itself contains this note. */
    if (drawn.below_lod && !view_shows_layer(&a->view, LAYER_TEXT))
        print_note("%s leaves out %s smaller than --lod", picture, film_left_out_text(drawn.small, left_out));
    if (drawn.left_out)
        print_note("%" PRIu64 " element%s too far away to be drawn in %s", drawn.left_out,
                   plural_ending(drawn.left_out), picture);
    return true;
}

/* Prints "wrote ", the path and ": ". Returns `out`. */
static FILE *print_wrote_prefix(const char *path, FILE *out)
{
    fputs("wrote ", out);
    write_escaped(out, file_output_display_name(path), escape_nothing);
    fputs(": ", out);
    return out;
}

static void print_picture_size(const report *r, FILE *out)
{
    const char *more = *r->chosen ? "; " : "";
    if (is_page(r->a))
        fprintf(out, "open it in a browser%s%s\n", more, r->chosen);
    else
        fprintf(out, "%d x %d pixels%s%s\n", r->a->view.width, r->a->view.height, more, r->chosen);
}

/* Prints the node of --node, the answers to queries and the advice. If none was asked for, prints the statistics. With
 * --json, does not mention the written files, because the output must be JSON only. */
static void print_report(const report *r)
{
    const arguments *a = r->a;
    const char *picture = a->outputs[PICTURE].path, *nodes = a->outputs[NODES].path;
    FILE *out = is_standard_output_taken(a->outputs, OUTPUTS) ? stderr : stdout;
    if (a->node)
        inspect_print_node(&r->node, r->name, a->json, out);
    if (a->queries.count)
        inspect_print_answers(&r->answers, r->name, a->json, out);
    if (a->advise)
        inspect_print_advice(&r->advice, r->made, r->name, a->json, out);
    if (!a->node && !a->queries.count && !a->advise)
        inspect_print(r->made, r->name, a->json, out);
    if (picture && !a->json && !is_quiet())
        print_picture_size(r, print_wrote_prefix(picture, out));
    if (nodes && !a->json && !is_quiet())
        fputs("all nodes\n", print_wrote_prefix(nodes, out));
}

static bool measure_advice(report *r, octreel_error *error)
{
    progress bar = progress_start("leaf capacities measured");
    const bool ok = inspect_advise(r->made, &(watcher){progress_show, NULL, &bar}, &r->advice, error);
    progress_end(&bar);
    return ok;
}

/* Makes the report. All steps that can fail for other reasons come before the first file is written. */
static bool make_report(report *r, octreel_error *error)
{
    const arguments *a = r->a;
    if (a->node && !inspect_find_node(r->made, a->node, &r->node, error))
        return false;
    if (a->advise && !measure_advice(r, error))
        return false;
    r->queries = a->queries;
    inspect_fill_queries(r->made->tree, r->queries.items, r->queries.count);
    if (!inspect_ask(r->made->tree, r->queries.items, r->queries.count, &r->answers, error))
        return false;
    r->view = a->view;
    const bool ok = (!a->outputs[PICTURE].path ||
                     (inspect_choose_view(r->made, has_view_option(&a->view_options, "color-points"),
                                          has_view_option(&a->view_options, "shade"), &r->view, r->chosen, error) &&
                      (is_page(a) ? write_page : draw_picture)(r, error))) &&
                    (!a->outputs[NODES].path || inspect_write_nodes(r->made, a->outputs[NODES].path, error));
    if (ok)
        print_report(r);
    inspect_answers_release(&r->answers);
    return ok;
}

/* ---- The cloud ---------------------------------------------------------------------------------------------- */

typedef struct reading {
    progress bar;
    double size; /* the number of bytes that have been read from the cloud's file */
} reading;

static void show_read_bytes(uint64_t done, uint64_t total, void *context)
{
    reading *r = context;
    r->size = (double)done;
    progress_show(done / 1000, total / 1000, &r->bar);
}

static void show_parsed_part(double fraction, void *context)
{
    reading *r = context;
    progress_show((uint64_t)(r->size * fraction / 1000), (uint64_t)(r->size / 1000), &r->bar);
}

/* Reads the cloud and builds its tree, and shows a progress bar during this time. */
static bool build_tree(const arguments *a, inspection *made, octreel_error *error)
{
    reading r = {.bar = progress_start("kB read")};
    octree_def def = a->def;
    octreel_error why;
    cloud points;
    char left_out[sizeof points.note] = "";
    bool ok = cloud_read(a->cloud, &(cloud_watch){show_read_bytes, show_parsed_part, &r}, &points, error);
    if (ok) {
        if (!a->has_world)
            def.world = find_point_world(points.positions, sizeof *points.positions, points.count);
        progress_end(&r.bar);
        r.bar = progress_start("points inserted");
        ok = inspect_build(&points, &def, &(watcher){progress_show, NULL, &r.bar}, made, &why) ||
             error_set(error, "%s: %s", file_display_name(a->cloud), why.text);
        memcpy(left_out, points.note, sizeof left_out);
        cloud_release(&points);
    }
    progress_end(&r.bar);
    if (*left_out)
        print_note("%s", left_out);
    return ok;
}

static int inspect_and_report(const arguments *a)
{
    inspection made;
    octreel_error error;
    if (!build_tree(a, &made, &error))
        return print_error("%s", error.text);
    report r = {.a = a, .name = path_base_name(file_display_name(a->cloud)), .made = &made};
    const bool ok = make_report(&r, &error);
    inspect_release(&made);
    return ok ? EXIT_DONE : print_error("%s", error.text);
}

/* ---- The command line --------------------------------------------------------------------------------------- */

/* Refuses options that would have no effect: options of the picture without -o, and options of drawing if -o names a
 * page. */
static bool check_picture_options(const arguments *a)
{
    const char *first = find_first_view_option(&a->view_options),
               *drawing = a->renderer.fill != DRAW_FILL_CHECKED ? "fill"
                          : a->renderer.any_renderer            ? "any-renderer"
                          : a->renderer.context != DRAW_AUTO    ? "context"
                                                                : NULL;
    if (is_page(a) && drawing)
        return print_refusal(
            "--%s changes how a PNG is drawn, but %s is a page, which the browser draws; leave out this option",
            drawing, a->outputs[PICTURE].path);
    first = first ? first : drawing;
    if (a->outputs[PICTURE].path || !first)
        return true;
    return print_refusal("--%s changes the picture, but no picture is drawn: add -o FILE.png", first);
}

static int run(int argc, char **argv)
{
    arguments a = {.outputs = {[PICTURE] = {.option = "-o"}, [NODES] = {.option = "--nodes"}},
                   .def = octree_def_default(),
                   .view = view_make_default(),
                   .renderer.fill = DRAW_FILL_CHECKED};
    a.view.fit = FIT_POINTS; /* fit the view to the points, because few clouds fill their world, which is a cube */
    const int status = command_read_arguments(&command_inspect, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    a.cloud = argv[optind];
    const bool ok = check_renderer(&a.renderer) && check_picture_options(&a) && read_view(&a.view_options, &a.view) &&
                    check_outputs(a.outputs, OUTPUTS, argv + optind, 1, a.json, a.force) &&
                    (!is_page(&a) || check_page_output(&a.outputs[PICTURE], a.force));
    return ok ? inspect_and_report(&a) : EXIT_TROUBLE;
}

const command command_inspect = {
    .name = "inspect",
    .run = run,
    .options = options,
    .line = "show how a point cloud subdivides: a picture, a page, statistics, nodes, queries",
    .usage = "CLOUD [-o PICTURE.png | -o PAGE.html] [OPTION ...]",
    .about = "Build an octree from a point cloud (" CLOUD_NAMES ") and print its statistics. With -o, "
             "draw the tree as well, or make a page for a browser. The page shows the same picture, turns and zooms "
             "it, names the element under the mouse, measures distances and asks queries. CLOUD may be -, standard "
             "input. The format is recognized by the content, "
             "not by "
             "the name.\n",
    .more = "Text may begin with column names or, as .pts files do, with the number of points. Without column names, "
            "the columns after the coordinates are colours in .xyzrgb files and normals in .xyzn files. In .pts files "
            "that begin with the number of points, they are an intensity, a colour or both. Points are numbered from 0 "
            "in file order. Points without "
            "finite coordinates and withheld LAS points are skipped, but keep their "
            "numbers. To read LAZ and COPC, octreel must be built with liblaszip (in Debian 13). Without liblaszip, "
            "convert the file first: pdal translate in.laz out.las\n",
    .statuses = {"done", NULL, "error"},
    .examples = "# draw the tree of a scan whose leaves hold at most 32 points\n"
                "octreel inspect scan.pcd -o tree.png --capacity 32\n"
                "# make a page that shows the scan in a browser\n"
                "octreel inspect scan.pcd -o scan.html\n"
                "# print one node, its box and its points, as JSON\n"
                "octreel inspect points.txt --node 0/3 --json\n"
                "# print which leaf capacity and which epsilon suit these points\n"
                "octreel inspect scan.ply --advise\n"
                "# print and draw the 8 nearest neighbours of a place in each of many clouds\n"
                "for f in *.ply; do octreel inspect \"$f\" -o \"$f.png\" --nearest 1,2,3,8; done\n"
                "# shoot a ray straight down, and print and draw the first 3 points that it hits\n"
                "octreel inspect scan.pcd -o ray.png --ray 1,2,90,0,0,-1,3\n"
                "# print the statistics of a cloud that pdal converts\n"
                "pdal translate scan.laz STDOUT --writer text | octreel inspect -\n",
    .min_arguments = 1,
    .max_arguments = 1,
    .takes = "one point cloud",
    .inputs = {FILE_KIND(CLOUD)},
    .files_pattern = "*.pcd",
};
