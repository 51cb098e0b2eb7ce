/* SPDX-License-Identifier: MIT */
/* cmd_diff.c - octreel diff: two pictures, folders or recordings, compared frame by frame. */
#include "command.h"
#include "contact_sheet.h"
#include "explain.h"
#include "hint.h"
#include "ignored_layers.h"
#include "number.h"
#include "picture_store.h"
#include "report.h"
#include "text.h"
#include "view_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct arguments {
    diff_options options;
    unsigned layers;                       /* left out: bits 1 << view_layer */
    image_rectangle *ignored;              /* owned */
    const char *folder, *junit, *markdown; /* null: not asked for */
    const char *store;                     /* null: there is none */
    uint64_t causes;                       /* how many are explained */
    bool causes_said;
    size_t lines; /* how many groups are listed: no fewer than are asked for by --causes */
    bool json, each, annotate;
} arguments;

static bool read_delta(const command_option *option, const char *text, void *into)
{
    double *delta = into;
    if (numbers_parse(text, delta, 1) && *delta >= 0 && *delta <= 1)
        return true;
    return refuse("--%s takes a number from 0 to 1, not \"%s\"", option->name, text);
}

static bool read_rectangle(const command_option *option, const char *text, void *into)
{
    arguments *a = into;
    image_tolerance *t = &a->options.tolerance;
    const char *at = text;
    uint64_t values[4] = {0};
    bool ok = true;
    for (int i = 0; ok && i < 4; i++, at++)
        ok = whole_parse(&at, INT32_MAX, &values[i]) && *at == (i < 3 ? ',' : 0);
    if (!ok || values[2] == 0 || values[3] == 0)
        return refuse("--%s takes left, top, width and height in pixels, as in 10,20,300,40, each at most %d and the "
                      "last two at least 1, not \"%s\"",
                      option->name, INT32_MAX, text);
    image_rectangle *grown = realloc(a->ignored, (t->ignored_count + 1) * sizeof *grown);
    if (!grown)
        return refuse("there is no memory for what is ignored");
    grown[t->ignored_count++] = (image_rectangle){(int)values[0], (int)values[1], (int)values[2], (int)values[3]};
    t->ignored = a->ignored = grown;
    return true;
}

static bool refuse_layer(const command_option *option, const char *bad)
{
    char meant[HINT_TEXT];
    const size_t length = strcspn(bad, ",");
    hint h = hint_for(bad, length);
    for (int i = 0; view_layer_at(i); i++)
        hint_offer(&h, view_layer_at(i));
    return refuse("--%s takes names of layers with commas between, and \"%.*s\" is none%s%s record --help lists them",
                  option->name, (int)length, bad, hint_text(&h, "", meant), hint_program_name());
}

static bool read_layers(const command_option *option, const char *text, void *into)
{
    arguments *a = into;
    const char *bad;
    if (a->options.mask)
        return refuse("--%s is given once, with commas between the names of several layers", option->name);
    if (!view_layers_parse(text, &a->layers, &bad))
        return refuse_layer(option, bad);
    a->options.mask = ignore_layers;
    a->options.mask_context = &a->layers;
    a->options.layers = text;
    return true;
}

static bool read_causes(const command_option *option, const char *text, void *into)
{
    arguments *a = into;
    a->causes = UINT64_MAX;
    a->causes_said = true;
    return strcmp(text, "all") == 0 || read_whole(option, text, &a->causes);
}

static const command_option options[] = {
    {.help = "Forgiven is only what is asked for, and every verdict says so:"},
    {"max-pixels", "N", "up to N unlike pixels a frame, after all below is forgiven", .read = read_whole,
     OPTION_VALUE(arguments, options.tolerance.max_pixels), .max = UINT32_MAX},
    {"max-delta", "D",
     "colours no farther apart than D in the unit YIQ (Kotsarenko and Ramos 2010), from 0, the same, to 1: "
     "pixelmatch's and odiff's threshold, which is 0.1 there by default",
     .read = read_delta, OPTION_VALUE(arguments, options.tolerance.max_delta)},
    {"antialias", NULL, "pixels on anti-aliased edges (Vysniauskas 2009, as in pixelmatch)", .read = read_flag,
     OPTION_VALUE(arguments, options.tolerance.antialias)},
    {"ignore", "X,Y,W,H", "a rectangle of pixels; may be given again", .read = read_rectangle},
    {"ignore-layer", "LIST",
     "what these layers show, in recordings, where it is on top in either frame, as in nodes,points; octreel record "
     "--help lists them",
     .read = read_layers, .names = view_layer_at},
    {.help = "Of two recordings it says why they differ: what is unlike in their sessions and views, what follows from "
             "it in each tick, and what is drawn at the pixels that differ. Other frames may tell that rendering alone "
             "differs. The verdict is about the frames, whatever their sessions are."},
    {"causes", "N",
     "explain the first N frames and ticks that differ, and list as many findings, at least 10 (default 10; a page "
     "explains 50), \"all\", or 0 for none",
     .read = read_causes, .size = sizeof(uint64_t), .max = UINT32_MAX},
    {"each", NULL,
     "a finding for each frame. Else frames that differ for one cause are one, told and shown once, by the first of "
     "them; where no cause is known, those in which the same pixels differ by as much",
     .read = read_flag, OPTION_VALUE(arguments, each)},
    {.help = "What is read and written:"},
    {"store", "DIR",
     "of a file of digests: pictures that octreel accept --store has put there show what was expected; no verdict "
     "depends on them",
     .read = read_name, OPTION_VALUE(arguments, store)},
    {"background", "RRGGBB", "what transparent pixels are laid over (default ffffff, white)", .read = read_color,
     OPTION_VALUE(arguments, options.background)},
    {"output", "DIR",
     "leave evidence: report.html, a page that holds all it shows, and in which findings are ticked for octreel accept "
     "--from; of the first frame of each finding NAME.expected.png, NAME.actual.png and NAME.difference.png (what "
     "counts glows, be it by one level; what is forgiven is blue); and contact.png, all of them small",
     .read = read_folder, OPTION_VALUE(arguments, folder)},
    JSON_OPTION(arguments, json, "print JSON, as share/octreel/diff.schema.json says"),
    {"junit", "FILE", "write JUnit's XML, a test case for each frame, as GitLab, Jenkins and GitHub's actions read it",
     .read = read_file, OPTION_VALUE(arguments, junit)},
    {"markdown", "FILE",
     "write a summary for a CI job's page: the verdict and a table of what differs (FILE may be -, standard output, "
     "for one of the two, unless --json goes there)",
     .read = read_file, OPTION_VALUE(arguments, markdown)},
    {"annotate", NULL,
     "print GitHub's commands that show what differs beside a change, to standard error; so it is where the "
     "environment has GITHUB_ACTIONS set",
     .read = read_flag, OPTION_VALUE(arguments, annotate)},
    {0},
};

/* The first sentence of what cannot be read, and how many more there are; or why nobody can say why. */
static int print_first_error(const diff_result *result, const explanation *why)
{
    size_t i = 0;
    if (result->found[FOUND_UNREADABLE] == 0)
        return print_error("%s; --causes 0 does not ask why", why->trouble);
    while (result->pairs[i].finding != FOUND_UNREADABLE)
        i++;
    const char *sentence = result->pairs[i].trouble ? result->pairs[i].trouble : "there is no memory";
    const size_t more = result->found[FOUND_UNREADABLE] - 1;
    return more ? print_error("%s (and %zu more)", sentence, more) : print_error("%s", sentence);
}

/* ---- What is said, and where --------------------------------------------------------------------------------- */

typedef bool reporter(FILE *out, const diff_report *report);

/* The files that it writes; the folder is one by its page. */
enum { OUTPUTS = 3 };

static void list_outputs(const arguments *a, const char *page, output_file outputs[OUTPUTS])
{
    outputs[0] = (output_file){"-o", page};
    outputs[1] = (output_file){"--junit", a->junit};
    outputs[2] = (output_file){"--markdown", a->markdown};
}

static bool check_outputs(const arguments *a)
{
    output_file outputs[OUTPUTS];
    list_outputs(a, NULL, outputs);
    return check_standard_output(outputs, OUTPUTS, a->json);
}

static bool write_report(const char *path, reporter *write, const diff_report *report, octreel_error *error)
{
    file_writer file;
    if (!path)
        return true;
    if (!file_writer_open(&file, path, error))
        return false;
    if (write(file.stream, report))
        return file_writer_close(&file, error);
    error_set(error, "%s: there is no memory to write it", file_output_title(path));
    return file_writer_abandon(&file);
}

static void print_report(const arguments *a, const diff_report *report)
{
    output_file outputs[OUTPUTS];
    list_outputs(a, NULL, outputs);
    if (a->json)
        diff_report_json(stdout, report);
    else if (!is_standard_output_taken(outputs, OUTPUTS) &&
             (report->result->count != 1 ||
              report->result->found[FOUND_UNREADABLE] == 0)) /* else standard error has all there is to say */
        diff_report_text(stdout, report);
}

static int report(const arguments *a, diff_report *all)
{
    static const int statuses[] = {
        [DIFF_SAME] = EXIT_DONE, [DIFF_DIFFERENT] = EXIT_FINDING, [DIFF_TROUBLE] = EXIT_TROUBLE};
    const diff_verdict verdict = explanation_verdict(all->why, all->result);
    evidence e = {.folder = NULL};
    octreel_error error;
    bool ok = true;
    if (a->folder) {
        ok = evidence_collect(&e, a->folder, all->result, all->groups, &error);
        all->evidence = &e;
        ok = ok && contact_sheet_write(all, &error) && diff_report_page(all, &error);
    }
    ok = ok && write_report(a->junit, diff_report_junit, all, &error) &&
         write_report(a->markdown, diff_report_markdown, all, &error);
    if (ok)
        print_report(a, all);
    if (ok && a->annotate && !diff_report_github(stderr, all))
        ok = error_no_memory(&error);
    evidence_release(&e);
    if (!ok)
        return print_error("%s", error.text);
    return verdict == DIFF_TROUBLE ? print_first_error(all->result, all->why) : statuses[verdict];
}

/* What is written may not take the place of what is compared, nor a report that of another. */
static bool check_files(const arguments *a, const diff_side sides[2], octreel_error *error)
{
    char *page = a->folder ? path_join(a->folder, EVIDENCE_PAGE) : NULL;
    output_file outputs[OUTPUTS];
    list_outputs(a, page, outputs);
    bool ok = check_outputs_differ(outputs, OUTPUTS, error);
    for (size_t i = 0; ok && i < OUTPUTS; i++)
        ok = diff_side_spared(&sides[0], &outputs[i], error) && diff_side_spared(&sides[1], &outputs[i], error);
    free(page);
    return ok;
}

/* What cannot be compared leaves no evidence. */
static bool check(const arguments *a, const diff_side sides[2], octreel_error *error)
{
    return diff_check(&sides[0], &sides[1], &a->options, error) && check_files(a, sides, error) &&
           (!a->folder || evidence_prepare(a->folder, &sides[0], &sides[1], error));
}

static int compare(const arguments *a, const char *paths[2])
{
    diff_side sides[2] = {{0}, {0}};
    diff_result result = {0};
    explanation why = {0};
    frame_groups groups = {0};
    octreel_error error;
    const bool ok = diff_side_open(&sides[0], paths[0], &error) && diff_side_open(&sides[1], paths[1], &error) &&
                    check(a, sides, &error) && diff_run(&sides[0], &sides[1], &a->options, &result, &error) &&
                    (!a->store || picture_store_fetch(a->store, &sides[0], &result, &error)) &&
                    explain(&sides[0], &sides[1], &result, a->causes, &why, &error) &&
                    frame_groups_make(&groups, &result, &why, a->each, &error);
    diff_report all = {
        .a = &sides[0], .b = &sides[1], .result = &result, .why = &why, .lines = a->lines, .groups = &groups};
    const int status = ok ? report(a, &all) : print_error("%s", error.text);
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
    arguments a = {.options = diff_options_default(), .causes = EXPLAIN_DEFAULT};
    int status = command_read_arguments(&command_diff, &a, argc, argv);
    a.annotate = a.annotate || getenv("GITHUB_ACTIONS");
    a.lines = a.causes_said && a.causes > LIST_LINES ? (size_t)a.causes : LIST_LINES;
    if (a.folder && !a.causes_said)
        a.causes = DIFF_REPORT_PAGE_FRAMES; /* each frame of the page has its cause beside it */
    if (status == COMMAND_GO_ON)
        status = check_outputs(&a) ? compare(&a, (const char *[]){argv[optind], argv[optind + 1]}) : EXIT_TROUBLE;
    free(a.ignored);
    return status;
}

const command command_diff = {
    .name = "diff",
    .run = run,
    .options = options,
    .line = "compare two pictures, folders of them or recordings, exactly or within a tolerance",
    .usage = "REFERENCE COMPARED [OPTION ...]",
    .about = "Compare pictures, exactly unless told otherwise. Each side is a PNG, a folder of PNGs (those directly in "
             "it), a recording, or a file of digests, made by octreel digest or octreel accept; - is a PNG or digests "
             "from standard input. Frames belong together by their names; a frame without a reference is a difference, "
             "and so is a reference without a frame. Where a baseline accepts several digests of a frame, any of them "
             "passes. Of recordings without frames the ticks are compared.\n",
    .statuses = {"the same, or all forgiven", "different", "trouble, as when a picture cannot be read"},
    .examples = "octreel diff before.png after.png\n"
                "octreel diff golden frames --max-delta 0.02 --ignore 0,0,320,16\n"
                "octreel diff golden frames -o evidence --markdown - >> \"$GITHUB_STEP_SUMMARY\"\n"
                "octreel diff baseline.txt frames --store pictures -o evidence\n",
    .environment = "  GITHUB_ACTIONS  when it is set, GitHub's commands are printed, as by --annotate\n",
    .files = "  DIR/report.html  the page, which holds all that it shows\n"
             "  DIR/contact.png  the pictures of all findings, small\n"
             "  DIR/NAME.expected.png, DIR/NAME.actual.png, DIR/NAME.difference.png  of the first frame of a finding\n",
    .least = 2,
    .most = 2,
    .takes = "two sides, each a PNG, a folder of PNGs, a recording or a file of digests",
    .inputs = {SIDE, SIDE},
};
