/* SPDX-License-Identifier: MIT */
/* cmd_audit.c - octreel audit: what a program answered to queries, judged by the true answers. */
#include "audit.h"
#include "command.h"
#include "command_line.h"
#include "progress.h"

#include <stdio.h>

static const char help[] = "usage: octreel audit RECORDING|SESSION [OPTION ...]\n\n"
                           "Judge a program's own spatial index: play a session whose queries say what the program "
                           "answered, and say for each\n"
                           "kind of query how many answers were asked for and how many were wrong; their recall, the "
                           "share of the true points\n"
                           "that were named; of neighbours how many times as far as the true one of its rank one of "
                           "them was, at worst and in\n"
                           "99 of 100 answers; the first tick with a wrong one; and the three worst cases with their "
                           "numbers. Nothing is drawn,\n"
                           "and files are not changed. octreel help session says how a query carries an answer.\n\n";

static const char more_help[] =
    "      --json            print JSON; a ratio of null is infinite: the true one is at the target\n"
    "  -h, --help\n\n"
    "Exit status: 0 all are right, 1 one is wrong, 2 trouble, or no query has an answer.\n"
    "Examples: octreel audit flight\n"
    "          octreel audit game.json --json\n";

static void on_progress(uint64_t done, uint64_t total, void *context)
{
    progress_show(context, done, total);
}

static int audit_it(const char *path, bool json)
{
    progress p = progress_start("ticks");
    audit_report report;
    octreel_error error;
    const bool done = audit_read(path, on_progress, &p, &report, &error);
    const bool wrong = report.wrong > 0;
    progress_end(&p);
    if (done)
        audit_print(stdout, path, &report, json);
    audit_release(&report);
    return !done ? trouble("%s", error.text) : wrong ? EXIT_FINDING : EXIT_DONE;
}

int cmd_audit(int argc, char **argv)
{
    bool json = false;
    const command_line line = {.name = "audit",
                               .help = help,
                               .more_help = more_help,
                               .json = &json,
                               .least = 1,
                               .most = 1,
                               .takes = "the folder of one recording, or one session",
                               .inputs = {FILE_KIND(RECORDING) | FILE_KIND(SESSION)}};
    const int status = command_line_read(&line, argc, argv);
    return status == COMMAND_GO_ON ? audit_it(argv[optind], json) : status;
}
