/* cmd_join.c - octreel join: a recording that was filmed in parts becomes whole. */
#include "command.h"
#include "film_report.h"
#include "join.h"
#include "options.h"
#include "progress.h"

#include <stdio.h>

static const char help[] =
    "usage: octreel join DIR [OPTION ...]\n\n"
    "Check that all parts of a recording are there (octreel record --ticks A:B -o DIR) and fit: every frame is whole "
    "and\n"
    "of its tick, and every line is what the session makes of it. Then write the rest, ticks.jsonl and index.html, so\n"
    "that DIR is the same as if it had been filmed at once. What is missing is named. Nothing is drawn.\n\n"
    "      --json            print a summary as JSON on stdout\n"
    "  -h, --help\n\n"
    "Example: octreel record s.json --ticks :500 -o film & octreel record s.json --ticks 500: -o film; wait\n"
    "         octreel join film\n";

static const struct option options[] = {
    {"json", no_argument, NULL, 'j'},
    {"help", no_argument, NULL, 'h'},
    {NULL, 0, NULL, 0},
};

static int join_it(const char *folder, bool json)
{
    watch w = watch_begin("ticks");
    film_options film = {.folder = folder, .progress = watch_progress, .keep_going = watch_keep_going, .context = &w};
    film_summary summary;
    octreel_error error;
    const bool ok = join_parts(&film, &summary, &error), whole = ok && summary.ticks == summary.total;
    progress_end(&w.progress);
    if (!ok)
        trouble("%s", error.text);
    else if (!whole)
        trouble("stopped; %s is as it was", folder);
    else
        film_report(stdout, &summary, &film, progress_seconds(&w.progress), json);
    watch_end(&w);
    return whole ? EXIT_DONE : EXIT_TROUBLE;
}

int cmd_join(int argc, char **argv)
{
    bool json = false;
    optind = 1;
    for (int option; (option = getopt_long(argc, argv, "h", options, NULL)) != -1;) {
        if (option == 'h') {
            fputs(help, stdout);
            return EXIT_DONE;
        }
        if (option != 'j') {
            fputs("octreel join --help tells what it takes\n", stderr);
            return EXIT_TROUBLE;
        }
        json = true;
    }
    if (argc - optind != 1)
        return trouble("join takes the folder of one recording; octreel join --help tells more");
    return check_names("join", argv + optind, 1) ? join_it(argv[optind], json) : EXIT_TROUBLE;
}
