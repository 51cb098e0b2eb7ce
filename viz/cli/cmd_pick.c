/* cmd_pick.c - octreel pick: what is drawn at a pixel of a frame. */
#include "command.h"
#include "options.h"
#include "pick.h"

#include <stdio.h>
#include <string.h>

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

typedef struct arguments {
    const char *frame;
    pick_options pick;
    bool json;
} arguments;

static const struct option options[] = {
    {"radius", required_argument, NULL, 'r'},
    {"context", required_argument, NULL, OPTION_CONTEXT},
    {"any-renderer", no_argument, NULL, OPTION_ANY_RENDERER},
    {"json", no_argument, NULL, 'j'},
    {"help", no_argument, NULL, 'h'},
    {NULL, 0, NULL, 0},
};

static bool read_pixels(const char *name, const char *text, uint64_t most, int *value)
{
    uint64_t number;
    if (!read_count(name, text, 0, most, &number))
        return false;
    *value = (int)number;
    return true;
}

static bool take_option(arguments *a, int option)
{
    switch (option) {
    case 'r':
        return read_pixels("--radius", optarg, VIEW_MAX_SIDE, &a->pick.radius);
    case OPTION_CONTEXT:
        return read_context(optarg, &a->pick.renderer);
    case OPTION_ANY_RENDERER:
        return a->pick.renderer.any_renderer = true;
    case 'j':
        return a->json = true;
    case '0': /* as in -10 */
        trouble("the coordinates of a pixel are counted from 0 on, from the top left");
        return false;
    default:
        fputs("octreel pick --help tells what it takes\n", stderr);
        return false;
    }
}

static int pick_it(const arguments *a)
{
    pick found;
    octreel_error error;
    if (!pick_frame(a->frame, &a->pick, &found, &error))
        return trouble("%s", error.text);
    pick_print(stdout, &found, a->json);
    pick_release(&found);
    return EXIT_DONE;
}

int cmd_pick(int argc, char **argv)
{
    static const char digits[] = "0123456789"; /* a negative number looks like an option */
    arguments a = {.pick = {.radius = 8}};
    optind = 1;
    for (int option; (option = getopt_long(argc, argv, "h0123456789", options, NULL)) != -1;) {
        if (option == 'h') {
            fputs(help, stdout);
            print_renderer_options(stdout);
            fputs(more_help, stdout);
            return EXIT_DONE;
        }
        if (!take_option(&a, strchr(digits, option) ? '0' : option))
            return EXIT_TROUBLE;
    }
    if (argc - optind != 3)
        return trouble("pick takes a frame and two coordinates, as in frames/frame_000041.png 312 200; octreel pick "
                       "--help tells more");
    a.frame = argv[optind];
    if (!check_names("pick", argv + optind, 1) || !read_pixels("X", argv[optind + 1], MOST_PLACE, &a.pick.x) ||
        !read_pixels("Y", argv[optind + 2], MOST_PLACE, &a.pick.y))
        return EXIT_TROUBLE;
    return check_renderer(&a.pick.renderer) ? pick_it(&a) : EXIT_TROUBLE;
}
