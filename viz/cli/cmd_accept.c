/* SPDX-License-Identifier: MIT */
/* cmd_accept.c - octreel accept: makes new frames the reference. */
#include "command.h"
#include "accept.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct arguments {
    const char *from, *date, *reason, *store;
    bool variant, json;
} arguments;

static bool read_date(const command_option *option, const char *text, void *into)
{
    return baseline_is_date(text) ? read_text(option, text, into)
                                  : refuse("--%s takes a date such as 2026-11-22, not \"%s\"", option->name, text);
}

static bool read_reason(const command_option *option, const char *text, void *into)
{
    return baseline_is_reason(text)
               ? read_text(option, text, into)
               : refuse("--%s takes one line of text without blanks at its ends, not \"%s\"", option->name, text);
}

static const command_option options[] = {
    {"from", "FILE",
     "accept only the frames that FILE lists, one on each line; the page of octreel diff -o saves ticked frames as "
     "accept.txt; - is standard input",
     .read = read_name, OPTION_VALUE(arguments, from)},
    {.help = "A baseline is a text file for git that holds digests of frames, and the date and reason of each "
             "acceptance; octreel help baseline describes it."},
    {"reason", "TEXT", "why the frames are accepted, in one line; creates a baseline if REFERENCE does not exist",
     .read = read_reason, OPTION_VALUE(arguments, reason)},
    {"date", "DATE", "the date of acceptance, as YYYY-MM-DD (default: today)", .read = read_date,
     OPTION_VALUE(arguments, date)},
    {"variant", NULL, "keep earlier digests of a frame, too: a frame passes if it matches any variant",
     .read = read_flag, OPTION_VALUE(arguments, variant)},
    {"store", "DIR",
     "also store the pictures in DIR, each under its digest, so that octreel diff --store can show the expected "
     "picture; no verdict depends on it",
     .read = read_folder, OPTION_VALUE(arguments, store)},
    JSON_OPTION(arguments, json, "print the changes as JSON, with all changed frames"),
    {0},
};

/* Today's date in the local time zone. */
static const char *today(char text[11])
{
    const time_t now = time(NULL);
    struct tm local;
    if (!localtime_r(&now, &local) || strftime(text, 11, "%Y-%m-%d", &local) == 0)
        snprintf(text, 11, "1970-01-01");
    return text;
}

static int accept_listed(const arguments *a, char **paths, int count)
{
    char date[11];
    octreel_error error;
    frame_list names = {0};
    const accept_options all = {.reference = paths[0],
                                .frames = paths[1],
                                .names = &names,
                                .note = {a->date ? a->date : today(date), a->reason},
                                .store = a->store,
                                .variant = a->variant,
                                .json = a->json};
    bool ok = !a->from || frame_list_read(&names, a->from, &error);
    for (int i = 2; ok && i < count; i++)
        ok = frame_list_add(&names, paths[i], 0, &error);
    ok = ok && accept_frames(&all, is_quiet() && !a->json ? NULL : stdout, &error);
    frame_list_release(&names);
    return ok ? EXIT_DONE : print_error("%s", error.text);
}

#define SIDE (FILE_KIND(PNG) | FILE_KIND(FOLDER) | FILE_KIND(RECORDING))

static int run(int argc, char **argv)
{
    arguments a = {0};
    const int status = command_read_arguments(&command_accept, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    if (getenv("CI"))
        return print_error("refusing to update references because CI is set; run accept locally and commit the result");
    if (a.date && !a.reason)
        return print_error("--date needs --reason TEXT");
    if (a.from && file_is_standard(a.from) && file_is_standard(argv[optind + 1]))
        return print_error("standard input can be read once, and \"-\" names it twice");
    return accept_listed(&a, argv + optind, argc - optind);
}

const command command_accept = {
    .name = "accept",
    .run = run,
    .options = options,
    .line = "make new frames the reference",
    .usage = "REFERENCE NEW [FRAME ...] [OPTION ...]",
    .about = "Make new frames the reference: all of them, or only the named ones. NEW is a PNG, a folder of PNGs, a "
             "recording, or - for a PNG from standard input. REFERENCE is a PNG, a folder, a recording or a baseline; "
             "it is created if it does not exist. References with equal pixels stay unchanged. References without a "
             "frame in NEW are removed if they are named or if all frames are accepted. The changes are printed as by "
             "octreel diff. Look at the pictures before you accept them.\n",
    .more =
        "Several accept commands may run on one reference at the same time: they wait for each other. If the disk is "
        "full, the reference stays unchanged. Recordings that are still being recorded, damaged or incomplete are "
        "refused, since the references of their missing frames would be removed. If the environment variable CI is "
        "set, accept does nothing and fails: a test that accepts its own results proves nothing.\n",
    .examples =
        "octreel accept golden frames\n"
        "octreel accept golden frames frame_000041.png frame_000042.png\n"
        "octreel accept baseline.txt frames --reason \"the letters are larger\" --store pictures\n"
        "octreel accept baseline.txt frames --from accept.txt --variant --reason \"Mesa 26 rounds differently\"\n",
    .environment = "  CI  if it is set, accept fails and changes nothing\n",
    .least = 2,
    .most = INT_MAX,
    .takes = "a reference and new frames",
    .inputs = {FILE_KIND(MISSING) | FILE_KIND(BASELINE) | SIDE, FILE_KIND(BASELINE) | SIDE},
};
