/* SPDX-License-Identifier: MIT */
/* cmd_accept.c - octreel accept: new frames become the reference. */
#include "command.h"
#include "command_line.h"
#include "accept.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

static const char help[] =
    "usage: octreel accept REFERENCE NEW [FRAME ...]\n\n"
    "Take over new frames as the reference: all of them, or those that are named. NEW is a PNG, a folder of PNGs or a\n"
    "recording, or -, a PNG from standard input; REFERENCE is the like, or a file of digests, and is made where there\n"
    "is nothing. References with the\n"
    "same pixels stay as they are; those that NEW has no frame for are removed, where all or they are asked for.\n"
    "What was there before is told as octreel diff tells it. Look at the pictures first.\n\n"
    "Where the environment has CI set, nothing is accepted: a test that accepts what it should test proves nothing.\n\n"
    "  -h, --help\n\n"
    "Exit status: 0 done, 2 trouble.\n\n"
    "Examples: octreel accept golden frames\n"
    "          octreel accept golden frames frame_000041.png frame_000042.png\n"
    "          octreel accept frames.digests frames\n";

#define SIDE FILE_KIND(PNG) | FILE_KIND(FOLDER) | FILE_KIND(RECORDING)

int cmd_accept(int argc, char **argv)
{
    const command_line line = {.name = "accept",
                               .help = help,
                               .least = 2,
                               .most = INT_MAX,
                               .takes = "a reference and what is new, each a PNG, a folder of PNGs or a recording",
                               .inputs = {FILE_KIND(MISSING) | FILE_KIND(DIGESTS) | SIDE, FILE_KIND(DIGESTS) | SIDE}};
    const int status = command_line_read(&line, argc, argv);
    octreel_error error;
    if (status != COMMAND_GO_ON)
        return status;
    if (getenv("CI"))
        return trouble("nothing is accepted where CI is set in the environment: references change by hand alone");
    const accept_options all = {
        .reference = argv[optind],
        .frames = argv[optind + 1],
        .names = (const char *const *)argv + optind + 2,
        .name_count = (size_t)(argc - optind - 2),
    };
    return accept_frames(&all, stdout, &error) ? EXIT_DONE : trouble("%s", error.text);
}
