/* SPDX-License-Identifier: MIT */
/* cmd_join.c - octreel join: a recording that was filmed in chunks becomes whole. */
#include "command.h"
#include "film_report.h"
#include "join.h"
#include "progress.h"

#include <stdio.h>

static int join(const char *folder, bool json)
{
    watch w = watch_begin("ticks");
    film_options film = {.folder = folder, .progress = watch_progress, .keep_going = watch_keep_going, .context = &w};
    film_summary summary;
    octreel_error error;
    const bool ok = join_chunks(&film, &summary, &error), whole = ok && summary.ticks == summary.total;
    progress_end(&w.progress);
    if (!ok)
        print_error("%s", error.text);
    else if (!whole)
        print_error("stopped; %s is as it was", folder);
    else if (json || !is_quiet())
        film_report_joined(stdout, &summary, &film, json);
    watch_end(&w);
    return whole ? EXIT_DONE : EXIT_TROUBLE;
}

typedef struct arguments {
    bool json;
} arguments;

static const command_option options[] = {
    JSON_OPTION(arguments, json, "print a summary as JSON on stdout"),
    {0},
};

static int run(int argc, char **argv)
{
    arguments a = {.json = false};
    const int status = command_read_arguments(&command_join, &a, argc, argv);
    return status == COMMAND_GO_ON ? join(argv[optind], a.json) : status;
}

const command command_join = {
    .name = "join",
    .run = run,
    .options = options,
    .line = "make a recording that was filmed in chunks whole",
    .usage = "DIR [OPTION ...]",
    .about = "Check that all chunks of a recording are there (octreel record --ticks A:B -o DIR) and fit: every tick "
             "has its line, and every frame is whole, of its tick and of the session. Then write the rest, ticks.jsonl "
             "and index.html, so that DIR is the same as if it had been filmed at once. What is missing is named. "
             "Nothing is played or drawn: octreel verify does that.\n",
    .more =
        "What --json prints has \"folder\", \"ticks\", \"frames\", \"gaps\" and \"left_out\", of which octreel help "
        "record tells.\n",
    .examples = "octreel record s.json --ticks :500 -o film & octreel record s.json --ticks 500: -o film; wait\n"
                "octreel join film\n",
    .least = 1,
    .most = 1,
    .takes = "the folder of one recording",
    .inputs = {FILE_KIND(RECORDING)},
};
