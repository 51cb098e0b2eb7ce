/* SPDX-License-Identifier: MIT */
/* cmd_verify.c - octreel verify: play a recording again, and say what is not the same. */
#include "command.h"
#include "command_line.h"
#include "progress.h"
#include "verify.h"

#include <stdio.h>

static const char help[] =
    "usage: octreel verify RECORDING [OPTION ...]\n\n"
    "Play the session of a recording again, let GL alone draw it, and compare tick by tick. It says that all is\n"
    "identical, or which tick is the first that differs, and in what: the session, what happened (a fact of\n"
    "ticks.jsonl), what is drawn (the scene), or only its pixels, and then who drew both; and which frames or lines "
    "are\n"
    "missing, torn or too many. Of gaps, ticks that a program which recorded itself could not hand over, it says how\n"
    "many there are and why; they are no finding. Of a recording without frames the facts alone are compared. Files "
    "are\n"
    "not changed.\n\n";

static const char more_help[] = "      --json            print JSON\n"
                                "  -h, --help\n\n"
                                "Exit status: 0 identical, 1 differs, 2 trouble.\n"
                                "Examples: octreel verify frames\n"
                                "          octreel verify frames --context egl --json\n";

static void on_progress(uint64_t done, uint64_t total, void *context)
{
    progress_show(context, done, total);
}

static int verify_it(const char *folder, const renderer_choice *renderer, bool json)
{
    progress p = progress_start("ticks");
    const verify_options options = {.renderer = *renderer, .progress = on_progress, .context = &p};
    verify_report report;
    octreel_error error;
    const bool ok = verify_recording(folder, &options, &report, &error);
    progress_end(&p);
    if (!ok)
        return trouble("%s", error.text);
    verify_print(stdout, folder, &report, json);
    return report.count ? EXIT_FINDING : EXIT_DONE;
}

int cmd_verify(int argc, char **argv)
{
    renderer_choice renderer = {0};
    bool json = false;
    const command_line line = {.name = "verify",
                               .help = help,
                               .more_help = more_help,
                               .json = &json,
                               .renderer = &renderer,
                               .least = 1,
                               .most = 1,
                               .takes = "the folder of one recording",
                               .inputs = {FILE_KIND(RECORDING)}};
    const int status = command_line_read(&line, argc, argv);
    return status == COMMAND_GO_ON ? verify_it(argv[optind], &renderer, json) : status;
}
