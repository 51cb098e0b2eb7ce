/* SPDX-License-Identifier: MIT */
/* cmd_accept.c - octreel accept: makes new frames the reference. */
#include "command.h"
#include "accept.h"
#include "choose.h"
#include "outputs.h"
#include "rule.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct arguments {
    const char *from, *date, *reason, *store;
    bool variant, flat, json, force, interactive;
} arguments;

static bool read_date(const command_option *option, const char *text, void *into)
{
    return baseline_is_date(text) ? read_text(option, text, into)
                                  : refuse_value(option, "an existing date such as 2026-11-22", text);
}

static bool read_reason(const command_option *option, const char *text, void *into)
{
    return baseline_is_reason(text)
               ? read_text(option, text, into)
               : refuse_value(option, "one line of text that neither begins nor ends with a space", text);
}

static const command_option options[] = {
    {"from", "FILE",
     "accept only the frames that FILE lists, one name on each line; - is standard input. The page of octreel diff -o "
     "saves the findings that you tick as such a list, accept.txt",
     .read = read_name, OPTION_VALUE(arguments, from)},
    {"interactive", NULL,
     "ask about one finding after the other: print its sentence and the paths of its pictures, and read y (accept), n "
     "(skip), a (accept all that follow) or q (quit) from standard input. The end of the input is q. The accepted "
     "frames are written together at the end",
     .read = read_flag, OPTION_VALUE(arguments, interactive)},
    FLAT_OPTION(arguments, flat),
    {"store", "DIR",
     "also save the pictures in DIR, each named by the digest of its pixels. octreel diff --store DIR then shows the "
     "expected pictures and can compare within a tolerance",
     .read = read_folder, OPTION_VALUE(arguments, store)},
    FORCE_OPTION(arguments, force, "save pictures in DIR even if it is or contains the current folder"),
    JSON_OPTION(arguments, json, "print a summary as JSON, with the names of all changed frames"),
    {.help = "Baselines. A baseline is a text file for git with one digest for each frame and the reason for each "
             "change; octreel help baseline describes it:"},
    {"reason", "TEXT",
     "the reason for the change, one line of text. If REFERENCE does not exist, a baseline is created",
     .read = read_reason, OPTION_VALUE(arguments, reason)},
    {"date", "DATE",
     "the date of the change, as YYYY-MM-DD (default: that of SOURCE_DATE_EPOCH, if it is set, else today)",
     .read = read_date, OPTION_VALUE(arguments, date)},
    {"variant", NULL, "keep the previously accepted digests: a frame then passes if it matches any of its digests",
     .read = read_flag, OPTION_VALUE(arguments, variant)},
    {0},
};

static int accept_given_frames(const arguments *a, char **paths, int count)
{
    char today[11] = "";
    octreel_error error;
    frame_list names = {0};
    choosing person = {stdin, stdout};
    if (a->reason && !a->date && !rule_today(today, &error))
        return print_error("%s", error.text);
    const accept_options all = {.reference = paths[0],
                                .frames = paths[1],
                                .flat = a->flat,
                                .names = &names,
                                .choose = a->interactive ? choose_findings : NULL,
                                .choose_context = &person,
                                .note = {a->date ? a->date : today, a->reason},
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

/* Checks that no argument makes the questions of --interactive impossible or useless. */
static bool check_interactive(const arguments *a, char **paths, int count)
{
    if (a->from || count > 2)
        return print_refusal("--interactive asks about every finding: give it neither --from nor names of frames");
    if (a->json)
        return print_refusal("--interactive prints its questions where --json prints: leave out one of them");
    return (!file_is_standard_stream(paths[0]) && !file_is_standard_stream(paths[1])) ||
           print_refusal("--interactive reads the answers from standard input: name a file in place of \"-\"");
}

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
    if (a.from && file_is_standard_stream(a.from) && file_is_standard_stream(argv[optind + 1]))
        return print_error("\"-\" is given twice, but standard input can be read only once");
    if (a.interactive && !check_interactive(&a, argv + optind, argc - optind))
        return EXIT_TROUBLE;
    if (!check_outputs(&(output_file){"--store", NULL, a.store}, 1, NULL, 0, false, a.force))
        return EXIT_TROUBLE;
    return accept_given_frames(&a, argv + optind, argc - optind);
}

const command command_accept = {
    .name = "accept",
    .run = run,
    .options = options,
    .line = "make new frames the reference that octreel diff compares with",
    .usage = "REFERENCE NEW [FRAME ...] [OPTION ...]",
    .about =
        "Copy frames from NEW to REFERENCE: all frames, or only the named ones. NEW is a PNG, a folder of PNGs with "
        "its subfolders, a recording, or - for a PNG from standard input. REFERENCE is one of these or a baseline, "
        "and is created if it does not exist. FRAME is a path below NEW, as in menu/1.png. References with the same "
        "pixels are not changed. A reference without a frame in NEW is removed if you accept all frames or name this "
        "reference. Like octreel diff, this command prints the differences and searches subfolders. Look at the "
        "pictures before you accept them. Rules and comments of a baseline are kept.\n",
    .more = "Several processes may accept into one reference at the same time; each sees the changes of the others. "
            "Nothing is accepted when the disk is full. Nothing is accepted from a damaged or unfinished recording, "
            "because this would remove the references of its missing frames. Nothing is accepted when the environment "
            "variable CI is set: a CI test that accepts its own results tests nothing.\n",
    .statuses = {"the frames are accepted", NULL, "error; nothing is accepted"},
    .examples =
        "# make golden hold the same frames as the folder frames\n"
        "octreel accept golden frames\n"
        "# accept two frames\n"
        "octreel accept golden frames frame_000041.png frame_000042.png\n"
        "# ask about each finding\n"
        "octreel accept golden frames --interactive\n"
        "# create or update a baseline, and save the pictures outside of git\n"
        "octreel accept baseline.txt frames --reason \"the letters are larger\" --store pictures\n"
        "# accept the findings that you ticked in the page, and keep the old digests\n"
        "octreel accept baseline.txt frames --from accept.txt --variant --reason \"Mesa 26 rounds otherwise\"\n",
    .files =
        "  BASELINE.history  the digests that acceptances replaced, by which octreel diff recognizes flaky frames\n",
    .environment = "  CI  if set, nothing is accepted\n"
                   "  SOURCE_DATE_EPOCH  the default of --date, in seconds since 1970-01-01\n",
    .min_arguments = 2,
    .max_arguments = INT_MAX,
    .takes = "a reference and new frames",
    .inputs = {FILE_KIND(MISSING) | FILE_KIND(BASELINE) | SIDE, FILE_KIND(BASELINE) | SIDE},
};
