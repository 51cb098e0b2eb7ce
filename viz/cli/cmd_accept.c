/* SPDX-License-Identifier: MIT */
/* cmd_accept.c - octreel accept: new frames become the reference. */
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
               : refuse("--%s takes one line of text, without blanks around it, and \"%s\" is none", option->name,
                        text);
}

static const command_option options[] = {
    {"from", "FILE",
     "the frames that FILE names, one a line: what was ticked in the page of octreel diff -o, which saves it as "
     "accept.txt; - is standard input",
     .read = read_name, OPTION_VALUE(arguments, from)},
    {.help = "A baseline is a file of digests that says why: text for git, a line for each digest of a frame and one "
             "for each reason; octreel help baseline tells more."},
    {"reason", "TEXT", "why, in one line; makes REFERENCE a baseline where there is nothing", .read = read_reason,
     OPTION_VALUE(arguments, reason)},
    {"date", "DATE", "when, as YYYY-MM-DD (default: today)", .read = read_date, OPTION_VALUE(arguments, date)},
    {"variant", NULL, "what was accepted before stays so, too: any of a frame's variants passes", .read = read_flag,
     OPTION_VALUE(arguments, variant)},
    {"store", "DIR",
     "put the pictures there, each under the digest of its pixels, for octreel diff --store to show what was expected; "
     "no verdict depends on it",
     .read = read_folder, OPTION_VALUE(arguments, store)},
    JSON_OPTION(arguments, json, "print what was done as JSON, with all frames that it was done to"),
    {0},
};

/* By the clock and the time zone of who accepts. */
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
        return print_error("nothing is accepted where CI is set in the environment: references change by hand alone");
    if (a.date && !a.reason)
        return print_error("--date is that of a reason: give --reason, too");
    if (a.from && file_is_standard(a.from) && file_is_standard(argv[optind + 1]))
        return print_error("standard input can be read once, and \"-\" names it twice");
    return accept_listed(&a, argv + optind, argc - optind);
}

const command command_accept = {
    .name = "accept",
    .run = run,
    .options = options,
    .line = "take over new frames as the reference",
    .usage = "REFERENCE NEW [FRAME ...] [OPTION ...]",
    .about = "Take over new frames as the reference: all of them, or those that are named. NEW is a PNG, a folder of "
             "PNGs or a recording, or -, a PNG from standard input; REFERENCE is the like, or a file of digests, and "
             "is made where there is nothing. References with the same pixels stay as they are; those that NEW has no "
             "frame for are removed, where all or they are asked for. What was there before is told as octreel diff "
             "tells it. Look at the pictures first.\n",
    .more =
        "Of several who accept into one reference at once each sees what the others did, and where a disk is full "
        "nothing is accepted. Nor is a recording that is still being filmed, is damaged or was not done: references "
        "of the frames that it lacks would go. Where the environment has CI set, nothing is either: a test that "
        "accepts what it should test proves nothing.\n",
    .examples =
        "octreel accept golden frames\n"
        "octreel accept golden frames frame_000041.png frame_000042.png\n"
        "octreel accept baseline.txt frames --reason \"the letters are larger\" --store pictures\n"
        "octreel accept baseline.txt frames --from accept.txt --variant --reason \"Mesa 26 rounds otherwise\"\n",
    .environment = "  CI  when it is set, nothing is accepted\n",
    .least = 2,
    .most = INT_MAX,
    .takes = "a reference and what is new",
    .inputs = {FILE_KIND(MISSING) | FILE_KIND(BASELINE) | SIDE, FILE_KIND(BASELINE) | SIDE},
};
