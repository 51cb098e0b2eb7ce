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

static bool read_pixels(const char *name, const char *text, uint64_t most, int *value)
{
    uint64_t number;
    if (!read_count(name, text, 0, most, &number))
        return false;
    *value = (int)number;
    return true;
}

static const struct option options[] = {{"radius", required_argument, NULL, 'r'}, {NULL, 0, NULL, 0}};

static bool read_option(int option, void *context)
{
    pick_options *pick = context;
    if (option == 'r')
        return read_pixels("--radius", optarg, VIEW_MAX_SIDE, &pick->radius);
    trouble("the coordinates of a pixel are counted from 0 on, from the top left"); /* a digit, as in -10 */
    return false;
}

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
                               .short_options = "h0123456789", /* a negative number looks like an option */
                               .options = options,
                               .read = read_option,
                               .context = &pick,
                               .json = &json,
                               .renderer = &pick.renderer,
                               .least = 3,
                               .most = 3,
                               .takes = "a frame and two coordinates, as in frames/frame_000041.png 312 200"};
    const int status = command_line_read(&line, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    const bool ok = read_pixels("X", argv[optind + 1], MOST_PLACE, &pick.x) &&
                    read_pixels("Y", argv[optind + 2], MOST_PLACE, &pick.y);
    return ok ? pick_it(argv[optind], &pick, json) : EXIT_TROUBLE;
}
