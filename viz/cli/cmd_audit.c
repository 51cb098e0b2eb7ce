/* SPDX-License-Identifier: MIT */
/* cmd_audit.c - octreel audit: compares the answers of a foreign index with the exact answers. */
#include "audit_print.h"
#include "command.h"
#include "file.h"
#include "file_kind.h"
#include "folder.h"
#include "outputs.h"
#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The files that the command can write: an HTML page and a JUnit file. */
enum { HTML, JUNIT, OUTPUTS };

typedef struct arguments {
    audit_limits limits;
    output_file outputs[OUTPUTS];
    uint64_t max_ticks;
    bool json, force;
} arguments;

static bool read_limits(const command_option *option, const char *text, void *into)
{
    octreel_error error;
    return audit_limits_parse(text, into, &error) || print_refusal("--%s: %s", option->name, error.text);
}

/* Returns true if the value of --html is the name of a page, such as "a.html". Any other value names a folder, into
 * which the page is written. */
static bool is_page_path(const char *path)
{
    const char *dot = strrchr(path, '.');
    return file_is_standard_stream(path) || (!is_folder(path) && dot && strcasecmp(dot, ".html") == 0);
}

/* Reads the value of --html. As in the options of other commands, a name without a file ending is the name of a
 * folder. */
static bool read_page(const command_option *option, const char *text, void *into)
{
    if (is_page_path(text) || is_folder(text) || output_kind_of_name(text) == NAME_OPEN)
        return read_name(option, text, into);
    return print_refusal("--%s takes the name of an HTML file, such as report.html, or of a folder, not \"%s\"",
                         option->name, text);
}

static const command_option options[] = {
    {"allow", "LIMITS",
     "accept approximate answers within limits. ratio=1.01: a neighbour may be at most 1.01 times as far away as the "
     "true neighbour. recall=0.99: the answers must name at least 0.99 of all true points, and of all pairs. A comma "
     "separates two limits. Always wrong are unknown ids, points or pairs named twice, points outside the query, "
     "points that the query excludes, pairs that do not overlap, and wrong nodes. An empty answer to a neighbour query "
     "has an "
     "infinite ratio",
     .read = read_limits, OPTION_VALUE(arguments, limits)},
    {"html", "FILE.html|DIR",
     "write a page, FILE.html or DIR/audit.html: recall and ratio over time, with a link from every tick to its frame, "
     "and the worst cases",
     .read = read_page, OPTION_VALUE(arguments, outputs[HTML].path)},
    {"junit", "FILE", "write JUnit XML with one test case for each kind of query, the pairs and the nodes",
     .read = read_file, OPTION_VALUE(arguments, outputs[JUNIT].path)},
    MAX_TICKS_OPTION(arguments, max_ticks),
    FORCE_OPTION(arguments, force, FORCE_FILES),
    JSON_OPTION(arguments, json,
                "print JSON. A ratio of null is infinite: the true neighbour is at the target, or the answer names no "
                "neighbour"),
    {0},
};

/* ---- Files -------------------------------------------------------------------------------------------------- */

/* A function that prints a verdict to the file `out`. Relative links start at `from`, the folder of that file. Returns
 * false if memory runs out. */
typedef bool printer(FILE *out, const audit_verdict *verdict, const char *from);

static bool print_junit(FILE *out, const audit_verdict *verdict, const char *from)
{
    (void)from;
    audit_print_junit(out, verdict);
    return true;
}

static bool write_file(const char *path, printer *print, const audit_verdict *verdict, octreel_error *error)
{
    file_writer file;
    char *from;
    if (!path)
        return true;
    if (!file_writer_open(&file, path, error))
        return false;
    from = path_parent_folder(path);
    const bool made = from && print(file.stream, verdict, from);
    free(from);
    if (made)
        return file_writer_close(&file, error);
    error_set(error, "%s: out of memory", path);
    return file_writer_discard(&file);
}

static void print_verdict(const arguments *a, const audit_verdict *verdict)
{
    if (a->json)
        audit_print_json(stdout, verdict);
    else if (!is_standard_output_taken(a->outputs, OUTPUTS))
        audit_print_text(stdout, verdict);
}

/* ---- The command -------------------------------------------------------------------------------------------- */

static bool audit_and_write_outputs(const arguments *a, const char *path, audit_report *report, octreel_error *error)
{
    progress p = progress_start("ticks");
    const char *folder = a->outputs[HTML].folder;
    const bool done = audit_replay(path, &a->limits, a->max_ticks, &(watcher){progress_show, NULL, &p}, report, error);
    progress_end(&p);
    const audit_verdict verdict = {file_display_name(path), file_kind_of(path) == KIND_RECORDING, report};
    if (!done || (folder && !folder_create(folder, error)) ||
        !write_file(a->outputs[HTML].path, audit_print_page, &verdict, error) ||
        !write_file(a->outputs[JUNIT].path, print_junit, &verdict, error))
        return false;
    print_verdict(a, &verdict);
    return true;
}

static int audit_and_report(const arguments *a, const char *path)
{
    audit_report report = {0};
    octreel_error error;
    const bool done = audit_and_write_outputs(a, path, &report, &error), passes = done && audit_passes(&report);
    audit_release(&report);
    return !done ? print_error("%s", error.text) : passes ? EXIT_DONE : EXIT_FINDING;
}

static int run(int argc, char **argv)
{
    arguments a = {.outputs = {[HTML] = {.option = "--html"}, [JUNIT] = {.option = "--junit"}}};
    output_file *html = &a.outputs[HTML];
    char *page = NULL;
    int status = command_read_arguments(&command_audit, &a, argc, argv);
    if (status != COMMAND_GO_ON)
        return status;
    if (html->path && !is_page_path(html->path)) {
        html->folder = html->path;
        html->path = page = path_join(html->folder, AUDIT_PAGE);
    }
    if (html->folder && !page)
        return print_error("out of memory");
    status = check_outputs(a.outputs, OUTPUTS, argv + optind, 1, a.json, a.force) ? audit_and_report(&a, argv[optind])
                                                                                  : EXIT_TROUBLE;
    free(page);
    return status;
}

const command command_audit = {
    .name = "audit",
    .run = run,
    .options = options,
    .line = "check the answers of a foreign index against the exact answers",
    .usage = "RECORDING|SESSION [OPTION ...]",
    .about =
        "Replay a session whose queries carry the answers of a foreign index (an index of your own), and compare each "
        "answer with "
        "the exact one. The pairs of overlapping bodies that the index found at a tick are an answer, too. For each "
        "kind of query, and for the pairs, this prints the number of answers and of wrong answers; the recall of "
        "the answers (the share of the true points that they name); the ratio of a neighbour's distance to the "
        "distance of the true neighbour of the same rank (the worst ratio, and the largest ratio in the best 99 of 100 "
        "answers); the first tick with a wrong answer; the three "
        "worst cases with their numbers; and the wrong foreign nodes. If all missing or all extra points of an answer "
        "lie exactly on the boundary of a box or a ball, the report names the \"bounds\" that accept these points. "
        "Nothing is drawn and no file is changed. SESSION may be -, standard input; octreel help session shows how a "
        "query carries an answer, and a tick the pairs.\n",
    .more = "One of --html FILE, --junit FILE and --json may write to standard output; FILE is then -.\n",
    .statuses = {"all answers are right, or within the limits of --allow", "wrong answers",
                 "error, or the session has no answers, nodes or pairs of a foreign index"},
    .examples = "# print a table of right and wrong answers\n"
                "octreel audit flight\n"
                "# write the page flight/audit.html and a report for a CI job\n"
                "octreel audit flight --html flight --junit audit.xml\n"
                "# accept an approximate index within limits, and print JSON\n"
                "octreel audit game.json --allow ratio=1.01,recall=0.99 --json\n",
    .files = "  DIR/audit.html  the page of --html DIR\n",
    .min_arguments = 1,
    .max_arguments = 1,
    .takes = "the folder of one recording, or one session",
    .inputs = {FILE_KIND(RECORDING) | FILE_KIND(SESSION)},
};
