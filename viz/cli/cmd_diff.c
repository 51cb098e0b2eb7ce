/* SPDX-License-Identifier: MIT */
/* cmd_diff.c - octreel diff: compares two pictures, folders or recordings frame by frame. */
#include "command.h"
#include "baseline.h"
#include "contact_sheet.h"
#include "explain.h"
#include "hint.h"
#include "history.h"
#include "ignored_layers.h"
#include "outputs.h"
#include "picture_store.h"
#include "report.h"
#include "text.h"
#include "view_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The outputs of the command. PAGE is report.html in the folder of --output, COMMENT comment.md in that of --comment.
 */
enum { PAGE, JUNIT, MARKDOWN, COMMENT, OUTPUTS };

typedef struct arguments {
    diff_options options;
    output_file outputs[OUTPUTS];
    uint64_t max_ticks;
    uint64_t causes; /* the value of --causes: how many differing frames and ticks are explained */
    bool has_causes; /* true: --causes was given */
    size_t lines;    /* the number of groups of differences that are listed; at least the value of --causes */
    bool flat, json, force, each, annotate;
} arguments;

/* Reads a tolerance, an option whose name is that of a row of tolerance.c. */
static bool read_tolerance(const command_option *option, const char *text, void *into)
{
    octreel_error error;
    return tolerance_read(tolerance_find(option->name), text, "--", into, &error) || print_refusal("%s", error.text);
}

static bool refuse_layer(const command_option *option, const char *bad)
{
    char meant[HINT_TEXT];
    const size_t length = strcspn(bad, ",");
    hint h = hint_create(bad, length);
    for (int i = 0; view_layer_name(i); i++)
        hint_add_candidate(&h, view_layer_name(i));
    return print_refusal("--%s: unknown layer \"%.*s\"%s%s record --help lists them", option->name, (int)length, bad,
                         hint_format(&h, "", meant), hint_program_name());
}

static bool read_layers(const command_option *option, const char *text, void *into)
{
    arguments *a = into;
    const char *bad;
    if (a->options.ignored_layers)
        return print_refusal("--%s can be given once; separate the names of several layers by commas", option->name);
    if (!view_layers_parse(text, &a->options.ignored_layers, &bad))
        return refuse_layer(option, bad);
    a->options.layers = text;
    return true;
}

static bool read_today(const command_option *option, const char *text, void *into)
{
    if (!baseline_is_date(text))
        return refuse_value(option, "an existing date such as 2026-11-22", text);
    memcpy(into, text, option->size);
    return true;
}

static bool read_causes(const command_option *option, const char *text, void *into)
{
    arguments *a = into;
    a->causes = UINT64_MAX;
    a->has_causes = true;
    return strcmp(text, "all") == 0 || read_whole(option, text, &a->causes);
}

static const command_option options[] = {
    {.help =
         "What counts as the same (the default is exact equality). The verdict names every tolerance that was used:"},
    {"max-pixels", "N",
     "accept up to N different pixels in a frame, or N% of its pixels, such as 0.5%, after the tolerances below are "
     "applied",
     .read = read_tolerance, OPTION_VALUE(arguments, options.tolerance)},
    {"max-delta", "D",
     "accept colours at most D apart in YIQ (Kotsarenko and Ramos 2010), from 0, equal, to 1. This is the threshold "
     "of pixelmatch and odiff, whose default is 0.1",
     .read = read_tolerance, OPTION_VALUE(arguments, options.tolerance)},
    {"max-channel", "N",
     "accept colours whose red, green and blue each differ by at most N of 255, or of 65535 in frames with 16 bits a "
     "channel",
     .read = read_tolerance, OPTION_VALUE(arguments, options.tolerance)},
    {"antialias", NULL, "ignore pixels on anti-aliased edges (Vysniauskas 2009, as in pixelmatch)",
     .read = read_tolerance, OPTION_VALUE(arguments, options.tolerance)},
    {"flip", "X",
     "accept a frame whose mean FLIP (Andersson and others 2020) is at most X. FLIP is how visible a difference is to "
     "a person who sees the two frames in alternation, from 0, invisible, to 1. It is measured and reported with any "
     "X. A mean hides small differences: a missing line in a frame of 640 x 360 pixels has about 0.001",
     .read = read_tolerance, OPTION_VALUE(arguments, options.tolerance)},
    {"pixels-per-degree", "N",
     "resolution that a person sees, for --flip, from 1 to 200 (default 67: a display 0.7 m and 3840 pixels wide, seen "
     "from 0.7 m)",
     .read = read_tolerance, OPTION_VALUE(arguments, options.tolerance)},
    {"ignore", "X,Y,W,H", "ignore a rectangle of pixels; can be given several times", .read = read_tolerance,
     OPTION_VALUE(arguments, options.tolerance)},
    {"ignore-layer", "LIST",
     "ignore pixels of recordings where these layers, such as nodes,points, are on top in either frame; octreel record "
     "--help lists the layers",
     .read = read_layers, .names = view_layer_name},
    {.help =
         "Why the frames differ. For two recordings, the causes are the members of their sessions and views that "
         "differ, the consequences in each tick, and the elements that are drawn at the different pixels. For other "
         "pictures, the only known cause is a different rendering. Causes never change the verdict:"},
    {"causes", "N",
     "explain the first N different frames and ticks. The report lists N findings, but at least 10. \"all\" explains "
     "everything, 0 explains nothing (default 10, and 50 for the page of -o)",
     .read = read_causes, .size = sizeof(uint64_t), .max = UINT32_MAX},
    MAX_TICKS_OPTION(arguments, max_ticks),
    {"each", NULL,
     "report one finding for each frame. Without this option, frames with the same cause are one finding. Frames of "
     "unknown cause are one finding if the same pixels differ by the same amounts",
     .read = read_flag, OPTION_VALUE(arguments, each)},
    {.help = "Input and output:"},
    FLAT_OPTION(arguments, flat),
    {"store", "DIR",
     "with a baseline as REFERENCE: show the expected pictures that octreel accept --store has saved in DIR, and apply "
     "the tolerances and the rules of the baseline to these pictures. Without a tolerance or rule, the pictures never "
     "change the verdict",
     .read = read_name, OPTION_VALUE(arguments, options.store)},
    {"today", "DATE",
     "with a baseline as REFERENCE: the date, as YYYY-MM-DD, on which rules of the baseline expire or not (default: "
     "the date of SOURCE_DATE_EPOCH, if it is set, else today)",
     .read = read_today, OPTION_VALUE(arguments, options.today)},
    {"background", "RRGGBB", "colour behind transparent pixels (default ffffff, white)", .read = read_color,
     OPTION_VALUE(arguments, options.background)},
    {"output", "DIR",
     "write evidence into DIR. report.html is one page with everything, in which you tick findings for octreel accept "
     "--from. NAME.expected.png, NAME.actual.png and NAME.difference.png show the first frame of each finding; in the "
     "difference, all different pixels glow, however small their difference, and tolerated pixels are blue. With "
     "--flip, "
     "NAME.flip.png is a map of FLIP, from black to pale yellow. contact.png has small copies of all pictures",
     .read = read_folder, OPTION_VALUE(arguments, outputs[PAGE].folder)},
    FORCE_OPTION(arguments, force, FORCE_FILES),
    JSON_OPTION(arguments, json, "print JSON; share/octreel/diff.schema.json describes it"),
    {"junit", "FILE", "write JUnit XML, one test case for each frame, for GitLab, Jenkins and GitHub",
     .read = read_file, OPTION_VALUE(arguments, outputs[JUNIT].path)},
    {"markdown", "FILE",
     "write a summary for the page of a CI job: the verdict and a table of differences. FILE may be -, standard "
     "output. Only one of --markdown, --junit and --json may write to standard output",
     .read = read_file, OPTION_VALUE(arguments, outputs[MARKDOWN].path)},
    {"comment", "DIR",
     "write a comment for a pull request into the new or empty folder DIR: comment.md has the sentence, the pictures "
     "and "
     "the line of octreel accept for the first 10 findings. Its pictures are beside it. Needs --output",
     .read = read_folder, OPTION_VALUE(arguments, outputs[COMMENT].folder)},
    {"annotate", NULL,
     "print GitHub annotations, which show differences beside a pull request, to standard error (default when the "
     "environment variable GITHUB_ACTIONS is set)",
     .read = read_flag, OPTION_VALUE(arguments, annotate)},
    {0},
};

/* Prints the error of the first unreadable frame and the number of further unreadable frames. If all frames are
 * readable, prints the error that prevented an explanation. */
static int print_first_error(const diff_result *result, const explanation *why)
{
    size_t i = 0;
    if (result->found[FOUND_UNREADABLE] == 0)
        return print_error("%s; --causes 0 skips the explanation", why->trouble);
    while (result->pairs[i].finding != FOUND_UNREADABLE)
        i++;
    const char *sentence = result->pairs[i].trouble ? result->pairs[i].trouble : "out of memory";
    const size_t more = result->found[FOUND_UNREADABLE] - 1;
    return more ? print_error("%s (and %zu more that cannot be read)", sentence, more) : print_error("%s", sentence);
}

/* ---- Reports ------------------------------------------------------------------------------------------------- */

typedef void reporter(FILE *out, const diff_report *report);

static bool write_report(const char *path, reporter *write, const diff_report *report, octreel_error *error)
{
    file_writer file;
    if (!path)
        return true;
    if (!file_writer_open(&file, path, error))
        return false;
    write(file.stream, report);
    return file_writer_close(&file, error);
}

static void print_report(const arguments *a, const diff_report *report)
{
    if (a->json)
        diff_report_json(stdout, report);
    else if (!is_standard_output_taken(a->outputs, OUTPUTS) &&
             (report->result->count != 1 ||
              /* The error of a single unreadable frame is printed on standard error instead. */
              report->result->found[FOUND_UNREADABLE] == 0))
        diff_report_text(stdout, report);
}

static int write_reports(const arguments *a, diff_report *all)
{
    static const int statuses[] = {
        [DIFF_SAME] = EXIT_DONE, [DIFF_DIFFERENT] = EXIT_FINDING, [DIFF_TROUBLE] = EXIT_TROUBLE};
    const diff_verdict verdict = explanation_verdict(all->why, all->result);
    const char *folder = a->outputs[PAGE].folder;
    evidence e = {.folder = NULL};
    octreel_error error;
    bool ok = true;
    if (folder) {
        ok = evidence_write_groups(&e, folder, all->result, all->groups, &error);
        all->evidence = &e;
        ok = ok && contact_sheet_write(all, &error) && diff_report_page(all, &error);
    }
    ok = ok && write_report(a->outputs[JUNIT].path, diff_report_junit, all, &error) &&
         write_report(a->outputs[MARKDOWN].path, diff_report_markdown, all, &error);
    if (ok && a->outputs[COMMENT].folder)
        ok = diff_report_comment(all, a->outputs[COMMENT].folder, &error);
    if (ok)
        print_report(a, all);
    if (ok && a->annotate)
        diff_report_github(stderr, all);
    evidence_release(&e);
    if (!ok)
        return print_error("%s", error.text);
    return verdict == DIFF_TROUBLE ? print_first_error(all->result, all->why) : statuses[verdict];
}

static bool check_resolution(const image_tolerance *tolerance)
{
    return !tolerance_has_idle_resolution(tolerance) ||
           print_refusal("--pixels-per-degree has no effect without --flip: add --flip X");
}

static bool check_comment(const arguments *a)
{
    return !a->outputs[COMMENT].folder || a->outputs[PAGE].folder ||
           print_refusal("--comment shows pictures of the evidence: add --output DIR");
}

/* Checks everything that can be checked before the folder of evidence is changed. */
static bool check_before_writing(const arguments *a, const diff_side sides[2], octreel_error *error)
{
    const char *folder = a->outputs[PAGE].folder;
    return diff_check(&sides[0], &sides[1], &a->options, error) &&
           (!folder || evidence_prepare(folder, &sides[0], &sides[1], error)) &&
           (!a->outputs[COMMENT].folder || diff_comment_prepare(a->outputs[COMMENT].folder, error));
}

static bool open_sides(const arguments *a, const char *paths[2], diff_side sides[2], octreel_error *error)
{
    for (int i = 0; i < 2; i++) {
        const diff_search search = {a->flat, {paths[1 - i], a->options.store}};
        if (!diff_side_open(&sides[i], paths[i], &search, error))
            return false;
        sides[i].max_ticks = a->max_ticks;
    }
    return true;
}

static int compare_sides(const arguments *a, const char *paths[2])
{
    diff_side sides[2] = {{0}, {0}};
    diff_result result = {0};
    explanation why = {0};
    frame_groups groups = {0};
    octreel_error error;
    bool ok = open_sides(a, paths, sides, &error) && check_before_writing(a, sides, &error) &&
              diff_run(&sides[0], &sides[1], &a->options, &result, &error);
    ok = ok && picture_store_fetch(&sides[0], &sides[1], &result, &error) &&
         history_find_flaky(&sides[0], &result, &error) &&
         explain(&sides[0], &sides[1], &result, a->causes, &why, &error) &&
         frame_groups_make(&groups, &result, &why, a->each, &error);
    diff_report all = {
        .a = &sides[0], .b = &sides[1], .result = &result, .why = &why, .lines = a->lines, .groups = &groups};
    const int status = ok ? write_reports(a, &all) : print_error("%s", error.text);
    frame_groups_release(&groups);
    explanation_release(&why);
    diff_release(&result);
    diff_side_release(&sides[0]);
    diff_side_release(&sides[1]);
    return status;
}

#define SIDE FILE_KIND(PNG) | FILE_KIND(FOLDER) | FILE_KIND(RECORDING) | FILE_KIND(BASELINE)

static int run(int argc, char **argv)
{
    arguments a = {
        .options = diff_options_default(),
        .outputs = {{.option = "-o"}, {.option = "--junit"}, {.option = "--markdown"}, {.option = "--comment"}},
        .causes = EXPLAIN_DEFAULT};
    a.options.mask = ignore_layers;
    int status = command_read_arguments(&command_diff, &a, argc, argv);
    a.annotate = a.annotate || getenv("GITHUB_ACTIONS");
    a.lines = a.has_causes && a.causes > LIST_LINES ? (size_t)a.causes : LIST_LINES;
    output_file *page = &a.outputs[PAGE];
    if (page->folder && !a.has_causes)
        a.causes = DIFF_REPORT_PAGE_CAUSES;
    char *path = page->folder ? path_join(page->folder, EVIDENCE_PAGE) : NULL;
    page->path = path;
    if (status == COMMAND_GO_ON && page->folder && !path)
        status = print_error("out of memory");
    else if (status == COMMAND_GO_ON)
        status = check_resolution(&a.options.tolerance) && check_comment(&a) &&
                         check_outputs(a.outputs, OUTPUTS, argv + optind, 2, a.json, a.force)
                     ? compare_sides(&a, (const char *[]){argv[optind], argv[optind + 1]})
                     : EXIT_TROUBLE;
    free(path);
    tolerance_release(&a.options.tolerance);
    return status;
}

const command command_diff = {
    .name = "diff",
    .run = run,
    .options = options,
    .line = "compare pictures, folders of pictures or recordings, and say why they differ",
    .usage = "REFERENCE COMPARED [OPTION ...]",
    .about = "Compare the pictures of two sides frame by frame. A side is a PNG, a folder of PNGs with its subfolders, "
             "a recording, or a baseline that octreel accept has made; - is a PNG or a baseline from standard input. "
             "Frames are paired by name; in a subfolder, the name is the path below the folder, as in menu/1.png. A "
             "frame that only one side has is a difference. Where a baseline accepts several digests of a frame, any "
             "of them passes. A rule in the baseline forgives differences of some frames; octreel help baseline "
             "describes rules. Recordings without frames are compared by their ticks.\n"
             "\n"
             "In a folder, octreel diff ignores files and subfolders whose names begin with a dot, links to folders, "
             "folders that octreel diff -o has written, the folder of --store, and the other side if it lies in the "
             "folder. A recording in a subfolder is compared like other PNGs. Subfolders of a recording are "
             "not searched.\n",
    .statuses = {"the same, or within the tolerances", "different", "error, such as an unreadable picture"},
    .examples = "# print whether two pictures are the same, pixel by pixel\n"
                "octreel diff before.png after.png\n"
                "# compare folders, with a colour tolerance and without the top left corner\n"
                "octreel diff golden frames --max-delta 0.02 --ignore 0,0,320,16\n"
                "# accept the antialiasing of another graphics driver\n"
                "octreel diff golden frames --flip 0.01\n"
                "# in a GitHub job: write evidence/report.html and a summary of the job\n"
                "octreel diff golden frames -o evidence --markdown - >> \"$GITHUB_STEP_SUMMARY\"\n"
                "# compare with a baseline, and show the expected pictures from its store\n"
                "octreel diff baseline.txt frames --store pictures -o evidence\n"
                "# compare with a baseline, with a colour tolerance for the frames whose digests differ\n"
                "octreel diff baseline.txt frames --store pictures --max-delta 0.02\n"
                "# list the frames that will fail because rules of the baseline expire before the end of the year\n"
                "octreel diff baseline.txt frames --store pictures --today 2026-12-31\n",
    .environment =
        "  GITHUB_ACTIONS  if set, GitHub annotations are printed, as with --annotate\n"
        "  SOURCE_DATE_EPOCH  the default of --today, in seconds since 1970-01-01 (reproducible-builds.org)\n",
    .files = "  DIR/report.html  the page, which needs no other file\n"
             "  DIR/contact.png  small copies of the pictures of all findings\n"
             "  DIR/NAME.expected.png, DIR/NAME.actual.png, DIR/NAME.difference.png  the first frame of a finding\n"
             "  DIR/NAME.flip.png  its FLIP map, with --flip\n"
             "  DIR/comment.md, DIR/N.expected.png, DIR/N.actual.png, DIR/N.difference.png  with --comment DIR\n",
    .min_arguments = 2,
    .max_arguments = 2,
    .takes = "two sides, each a PNG, a folder of PNGs, a recording or a baseline",
    .inputs = {SIDE, SIDE},
};
