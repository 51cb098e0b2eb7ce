/* SPDX-License-Identifier: MIT */
/* cmd_pick.c - octreel pick: lists the elements that are drawn at a pixel of a frame. */
#include "command.h"
#include "pick.h"

#include <stdio.h>

/* The largest coordinate that the command line accepts. It is larger than any picture: a coordinate outside the picture
 * is refused later, when the error can name the size of the picture. */
enum { MOST_COORDINATE = 1000000000 };

static bool read_coordinate(const char *name, const char *text, int *value)
{
    uint64_t number = 0;
    const bool ok = read_count(name, text, 0, MOST_COORDINATE, &number);
    *value = (int)number;
    return ok;
}

typedef struct arguments {
    pick_options pick;
    bool json;
} arguments;

static const command_option options[] = {
    {"radius", "N",
     "if nothing is drawn at the pixel, report the nearest drawn pixel at most N pixels away (default 8; 0: report "
     "nothing)",
     .read = read_whole, OPTION_VALUE(arguments, pick.radius), .max = VIEW_MAX_SIDE},
    MAX_TICKS_OPTION(arguments, pick.max_ticks),
    SHARED_OPTIONS(renderer_option_row, arguments, pick.renderer),
    JSON_OPTION(
        arguments, json,
        "print JSON: the kind, layer, node or point and a sentence for each element, topmost first. A pixel has "
        "`samples` samples; an element was painted in `painted` of them and is visible in `shown` of them. An "
        "explained `node` also has `capacity`, `split` (at this tick), the ids of `arrived` and `left` points and, "
        "unless its cell exists since tick 0, `made_by`"),
    {0},
};

static int print_pick(const char *frame, const pick_options *options, bool json)
{
    pick found;
    octreel_error error;
    if (!pick_frame(frame, options, &found, &error))
        return print_error("%s", error.text);
    pick_print(stdout, &found, json);
    pick_release(&found);
    return EXIT_DONE;
}

static int run(int argc, char **argv)
{
    arguments a = {.pick = {.radius = 8, .renderer.fill = DRAW_FILL_CHECKED}};
    const int status = command_read_arguments(&command_pick, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    if (a.pick.renderer.context != DRAW_AUTO)
        a.pick.renderer.fill = DRAW_FILL_GL;
    const bool ok = check_renderer(&a.pick.renderer) && read_coordinate("X", argv[optind + 1], &a.pick.x) &&
                    read_coordinate("Y", argv[optind + 2], &a.pick.y);
    return ok ? print_pick(argv[optind], &a.pick, a.json) : EXIT_TROUBLE;
}

const command command_pick = {
    .name = "pick",
    .run = run,
    .options = options,
    .line = "list what is drawn at a pixel of a frame",
    .usage = "FRAME X Y [OPTION ...]",
    .about =
        "Name the node, point, query or text that is drawn on top at pixel (X, Y) of a recorded frame, the "
        "elements below it, the other nodes that share the same edge, and the other points on the same pixel. "
        "(0, 0) is the top left pixel. For a leaf, and for a node that split at the frame's tick, this also prints "
        "the capacity of a leaf, the points that arrived or left at the tick, and which split or merge made the "
        "node's cell. The session beside the frame is replayed to the frame's tick. A frame "
        "that differs from what the session draws is refused.\n",
    .statuses = {"done, also where nothing is drawn", NULL, "error"},
    .examples = "# record the example, and ask for the element at pixel (800, 200) of tick 219\n"
                "octreel record -o flight\n"
                "octreel pick flight/frame_000219.png 800 200\n",
    .negative_error = "pixel coordinates start at (0, 0) in the top left corner and cannot be negative",
    .min_arguments = 3,
    .max_arguments = 3,
    .takes = "a frame and two coordinates, as in frames/frame_000041.png 312 200",
    .inputs = {FILE_KIND(PNG)},
    .refuses_standard_input = true,
};
