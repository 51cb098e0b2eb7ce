/* SPDX-License-Identifier: MIT */
/* cmd_join.c - octreel join: completes a recording whose chunks were filmed by several processes. */
#include "command.h"
#include "film_report.h"
#include "join.h"
#include "progress.h"

#include <stdio.h>

static int join_and_report(const char *folder, bool json)
{
    progress p = progress_start("ticks");
    film_options film = {.folder = folder, .watch = {progress_show, has_no_stop_signal, &p}};
    film_summary summary;
    octreel_error error;
    defer_stop_signals();
    const bool ok = join_chunks(&film, &summary, &error), whole = ok && summary.ticks == summary.total;
    progress_end(&p);
    if (!ok)
        print_error("%s", error.text);
    else if (!whole)
        print_error("stopped; %s is unchanged", folder);
    else if (json || !is_quiet())
        film_report_joined(stdout, &summary, &film, json);
    deliver_stop_signal();
    return whole ? EXIT_DONE : EXIT_TROUBLE;
}

typedef struct arguments {
    bool json;
} arguments;

static const command_option options[] = {
    JSON_OPTION(arguments, json, "print a summary as JSON to standard output"),
    {0},
};

static int run(int argc, char **argv)
{
    arguments a = {.json = false};
    const int status = command_read_arguments(&command_join, &a, argc, argv);
    return status == COMMAND_GO_ON ? join_and_report(argv[optind], a.json) : status;
}

const command command_join = {
    .name = "join",
    .run = run,
    .options = options,
    .line = "complete a recording that was filmed in chunks",
    .usage = "DIR [OPTION ...]",
    .about = "Check that DIR holds all chunks of a recording (octreel record --ticks A:B -o DIR) and that they fit "
             "together: every tick has its line, every frame is whole and belongs to its tick and session. Then write "
             "ticks.jsonl and index.html, so that DIR is the same as if one process had filmed it. Missing ticks are "
             "named. octreel join does not replay the session or redraw frames; octreel verify does both.\n",
    .more = "The summary of --json has the members \"folder\", \"ticks\", \"frames\", \"gaps\" and \"left_out\"; "
            "octreel record --help describes them.\n",
    .statuses = {"the recording is complete", NULL, "error or stopped; DIR is unchanged"},
    .examples = "# film the two halves of a session at the same time, then join them\n"
                "octreel record s.json --ticks :500 -o film & octreel record s.json --ticks 500: -o film; wait\n"
                "octreel join film\n",
    .min_arguments = 1,
    .max_arguments = 1,
    .takes = "the folder of one recording",
    .inputs = {FILE_KIND(RECORDING)},
};
