/* SPDX-License-Identifier: MIT */
/* cmd_join.c - octreel join: a recording that was filmed in chunks becomes whole. */
#include "command.h"
#include "command_line.h"
#include "film_report.h"
#include "join.h"
#include "progress.h"

#include <stdio.h>

static const char help[] =
    "usage: octreel join DIR [OPTION ...]\n\n"
    "Check that all chunks of a recording are there (octreel record --ticks A:B -o DIR) and fit: every tick has its\n"
    "line, and every frame is whole, of its tick and of the session. Then write the rest, ticks.jsonl and index.html,\n"
    "so that DIR is the same as if it had been filmed at once. What is missing is named. Nothing is played or drawn:\n"
    "octreel verify does that.\n\n"
    "      --json            print a summary as JSON on stdout\n"
    "  -h, --help\n\n"
    "Example: octreel record s.json --ticks :500 -o film & octreel record s.json --ticks 500: -o film; wait\n"
    "         octreel join film\n";

static int join_it(const char *folder, bool json)
{
    watch w = watch_begin("ticks");
    film_options film = {.folder = folder, .progress = watch_progress, .keep_going = watch_keep_going, .context = &w};
    film_summary summary;
    octreel_error error;
    const bool ok = join_chunks(&film, &summary, &error), whole = ok && summary.ticks == summary.total;
    progress_end(&w.progress);
    if (!ok)
        trouble("%s", error.text);
    else if (!whole)
        trouble("stopped; %s is as it was", folder);
    else
        film_report_joined(stdout, &summary, &film, json);
    watch_end(&w);
    return whole ? EXIT_DONE : EXIT_TROUBLE;
}

int cmd_join(int argc, char **argv)
{
    bool json = false;
    const command_line line = {.name = "join",
                               .help = help,
                               .json = &json,
                               .least = 1,
                               .most = 1,
                               .takes = "the folder of one recording",
                               .inputs = {FILE_KIND(RECORDING)}};
    const int status = command_line_read(&line, argc, argv);
    return status == COMMAND_GO_ON ? join_it(argv[optind], json) : status;
}
