/* SPDX-License-Identifier: MIT */
/* cmd_pick.c - octreel pick: what is drawn at a pixel of a frame. */
#include "command.h"
#include "command_line.h"
#include "pick.h"

#include <stdio.h>

#define MOST_PLACE 1000000000 /* beyond any picture, which then says how large it is */

static const char help[] =
    "usage: octreel pick FRAME X Y [OPTION ...]\n\n"
    "Say what is drawn at pixel (X, Y) of a recording's frame: the node, point, query or text on top, what it covers,\n"
    "which other nodes have the same edge there, and which other points lie on the same pixel. (0, 0) is the top left\n"
    "pixel. The session beside the frame is played to its tick and the scene is made anew; a frame that is not of it,\n"
    "or that somebody changed, is refused.\n\n"
    "      --radius N        where nothing is drawn, tell of the nearest pixel within N on which anything is (default\n"
    "                        8; 0: of none)\n";

static const char more_help[] =
    "      --json            print JSON: kind, layer, node or point and a sentence for each element, from the top "
    "down;\n"
    "                        of `samples` of the pixel, `shown` are seen and `painted` are also covered by others\n"
    "  -h, --help\n\n"
    "Exit status: 0 done, whether or not anything is there, 2 trouble.\n"
    "Example: octreel record -o flight\n"
    "         octreel pick flight/frame_000219.png 800 200\n";

static bool read_place(const char *name, const char *text, int *value)
{
    uint64_t number = 0;
    const bool ok = read_count(name, text, 0, MOST_PLACE, &number);
    *value = (int)number;
    return ok;
}

static const command_option options[] = {
    {"radius", read_whole, OPTION_VALUE(pick_options, radius), 0, VIEW_MAX_SIDE},
    {0},
};

static int pick_it(const char *frame, const pick_options *options, bool json)
{
    pick found;
    octreel_error error;
    if (!pick_frame(frame, options, &found, &error))
        return trouble("%s", error.text);
    pick_print(stdout, &found, json);
    pick_release(&found);
    return EXIT_DONE;
}

int cmd_pick(int argc, char **argv)
{
    pick_options pick = {.radius = 8};
    bool json = false;
    const command_line line = {.name = "pick",
                               .help = help,
                               .more_help = more_help,
                               .options = options,
                               .arguments = &pick,
                               .no_negative = "the coordinates of a pixel are counted from 0 on, from the top left",
                               .json = &json,
                               .renderer = &pick.renderer,
                               .least = 3,
                               .most = 3,
                               .takes = "a frame and two coordinates, as in frames/frame_000041.png 312 200",
                               .inputs = {FILE_KIND(PNG)},
                               .no_standard_input = true};
    const int status = command_line_read(&line, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    const bool ok = read_place("X", argv[optind + 1], &pick.x) && read_place("Y", argv[optind + 2], &pick.y);
    return ok ? pick_it(argv[optind], &pick, json) : EXIT_TROUBLE;
}
