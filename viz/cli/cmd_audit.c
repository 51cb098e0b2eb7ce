/* SPDX-License-Identifier: MIT */
/* cmd_audit.c - octreel audit: what a program answered to queries, judged by the true answers. */
#include "audit_print.h"
#include "command.h"
#include "file.h"
#include "file_kind.h"
#include "folder.h"
#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct arguments {
    audit_limits limits;
    const char *html, *junit; /* null: not asked for */
    bool json;
} arguments;

static bool read_limits(const command_option *option, const char *text, void *into)
{
    octreel_error error;
    return audit_limits_parse(text, into, &error) || refuse("--%s: %s", option->name, error.text);
}

static bool is_folder(const char *path)
{
    const file_kind kind = file_kind_of(path);
    return !file_is_standard(path) && (kind == KIND_FOLDER || kind == KIND_RECORDING);
}

/* Whether the name is that of the page itself, and not of the folder that holds it. */
static bool is_page(const char *path)
{
    const char *dot = strrchr(path, '.');
    return file_is_standard(path) || (!is_folder(path) && dot && strcasecmp(dot, ".html") == 0);
}

/* A name that ends like no file is that of a folder, as elsewhere. */
static bool read_page(const command_option *option, const char *text, void *into)
{
    if (is_page(text) || is_folder(text) || name_kind_of(text) == NAME_OPEN)
        return read_name(option, text, into);
    return refuse("--%s takes the name of a page, as in report.html, or of a folder, and \"%s\" is neither",
                  option->name, text);
}

static const command_option options[] = {
    {"allow", "LIMITS",
     "what is no finding: ratio=1.01, neighbours up to so many times as far; recall=0.99, answers that miss points, as "
     "long as so much of all true points is named; or both with a comma. Nothing allows ids that no point has, points "
     "named twice, left out or outside, nor what is wrong with nodes; and a neighbour query that names none has an "
     "infinite ratio",
     .read = read_limits, OPTION_VALUE(arguments, limits)},
    {"html", "FILE.html|DIR",
     "write a page, FILE.html or DIR/audit.html: recall and ratio over the ticks, where each point leads to its frame, "
     "and the "
     "worst cases",
     .read = read_page, OPTION_VALUE(arguments, html)},
    {"junit", "FILE", "write JUnit's XML, a test case for each kind of query", .read = read_file,
     OPTION_VALUE(arguments, junit)},
    JSON_OPTION(arguments, json,
                "print JSON; a ratio of null is infinite: the true one is at the target, or none is named"),
    {0},
};

static void on_progress(uint64_t done, uint64_t total, void *context)
{
    progress_show(context, done, total);
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

/* The page's file; a folder holds it under its own name. Null where there is no memory. */
static char *page_file(const char *html)
{
    return is_page(html) ? strdup(html) : path_join(html, AUDIT_PAGE);
}

/* The folder that is to hold the page, where there is none yet. */
static bool make_folder(const char *html, octreel_error *error)
{
    return !html || is_page(html) || folder_make(html, error);
}

/* The folder that a file lies in; for standard output the current one. Null where there is no memory. */
static char *folder_of(const char *file)
{
    const char *slash = file_is_standard(file) ? NULL : strrchr(file, '/');
    return slash ? strndup(file, slash == file ? 1 : (size_t)(slash - file)) : strdup(".");
}

/* None may take the place of what is read, nor of another. */
static bool check_files(const char *path, const char *page, const char *junit, octreel_error *error)
{
    const output_file outputs[] = {{"--html", page}, {"--junit", junit}};
    char *session = path_join(path, "session.json");
    bool ok = session ? check_outputs_differ(outputs, 2, error) : error_no_memory(error);
    for (int i = 0; ok && i < 2; i++)
        ok = check_output_is_not_input(&outputs[i], path, error) &&
             check_output_is_not_input(&outputs[i], session, error);
    free(session);
    return ok;
}

/* `from` is the folder in which the file lies. */
typedef bool printer(FILE *out, const audit_verdict *verdict, const char *from);

static bool print_junit(FILE *out, const audit_verdict *verdict, const char *from)
{
    (void)from;
    return audit_print_junit(out, verdict);
}

static bool write_file(const char *path, printer *print, const audit_verdict *verdict, octreel_error *error)
{
    file_writer file;
    char *from;
    if (!path)
        return true;
    if (!file_writer_open(&file, path, error))
        return false;
    from = folder_of(path);
    const bool made = from && print(file.stream, verdict, from);
    free(from);
    if (made)
        return file_writer_close(&file, error);
    error_set(error, "%s: there is no memory to write it", path);
    return file_writer_abandon(&file);
}

static void print_verdict(const arguments *a, const audit_verdict *verdict)
{
    const output_file outputs[] = {{"--html", a->html}, {"--junit", a->junit}};
    if (a->json)
        audit_print_json(stdout, verdict);
    else if (!is_standard_output_taken(outputs, 2))
        audit_print_text(stdout, verdict);
}

/* ---- The command -------------------------------------------------------------------------------------------- */

static bool write_audit(const arguments *a, const char *path, const char *page, audit_report *report,
                        octreel_error *error)
{
    progress p = progress_start("ticks");
    const bool done =
        check_files(path, page, a->junit, error) && audit_read(path, &a->limits, on_progress, &p, report, error);
    progress_end(&p);
    const audit_verdict verdict = {file_title(path), file_kind_of(path) == KIND_RECORDING, report};
    if (!done || !make_folder(a->html, error) || !write_file(page, audit_print_page, &verdict, error) ||
        !write_file(a->junit, print_junit, &verdict, error))
        return false;
    print_verdict(a, &verdict);
    return true;
}

static int audit(const arguments *a, const char *path)
{
    const output_file outputs[] = {{"--html", a->html}, {"--junit", a->junit}};
    audit_report report = {0};
    octreel_error error;
    if (!check_standard_output(outputs, 2, a->json))
        return EXIT_TROUBLE;
    char *page = a->html ? page_file(a->html) : NULL;
    if (a->html && !page)
        return print_error("there is no memory");
    const bool done = write_audit(a, path, page, &report, &error), passes = done && audit_passes(&report);
    free(page);
    audit_release(&report);
    return !done ? print_error("%s", error.text) : passes ? EXIT_DONE : EXIT_FINDING;
}

static int run(int argc, char **argv)
{
    arguments a = {.json = false};
    const int status = command_read_arguments(&command_audit, &a, argc, argv);
    return status == COMMAND_GO_ON ? audit(&a, argv[optind]) : status;
}

const command command_audit = {
    .name = "audit",
    .run = run,
    .options = options,
    .line = "judge what a program answered to queries: how much of it is wrong, and where",
    .usage = "RECORDING|SESSION [OPTION ...]",
    .about =
        "Judge a program's own spatial index: play a session whose queries say what the program answered, and say for "
        "each kind of query how many answers were asked for and how many were wrong; their recall, the share of the "
        "true points that were named; of neighbours how many times as far as the true one of its rank one of them was, "
        "at worst and in 99 of 100 answers; the first tick with a wrong one; and the three worst cases with their "
        "numbers; and what is proved wrong about nodes of its own. Nothing is drawn, and the files are not changed. "
        "octreel help session says how a query carries an answer. SESSION may be -, standard input.\n",
    .more = "FILE may be -, standard output, for one of --html, --junit and --json.\n",
    .statuses = {"all are right or within what is allowed", "a finding", "trouble, or no query has an answer"},
    .examples = "octreel audit flight\n"
                "octreel audit flight --html flight --junit audit.xml\n"
                "octreel audit game.json --allow ratio=1.01,recall=0.99 --json\n",
    .files = "  DIR/audit.html  the page of --html DIR\n",
    .least = 1,
    .most = 1,
    .takes = "the folder of one recording, or one session",
    .inputs = {FILE_KIND(RECORDING) | FILE_KIND(SESSION)},
};
