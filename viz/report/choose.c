/* SPDX-License-Identifier: MIT */
/* choose.c - asks a person which findings to accept: see choose.h. The difference picture of the current finding is a
 * file in a temporary folder. It always has the same path, so that a viewer that reloads its file follows the
 * questions. */
#include "choose.h"
#include "file.h"
#include "history.h"
#include "picture_store.h"
#include "report.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef enum answer { YES, NO, ALL, QUIT, HELP } answer;

/* One comparison whose findings are chosen. */
typedef struct questions {
    const choosing *with;
    const diff_result *result;
    const frame_groups *groups;
    frame_list *chosen;
    char *folder, *difference; /* the temporary folder, and the difference picture in it; null: no picture is drawn */
    size_t count, asked;       /* how many findings can be accepted, and how many were asked about */
} questions;

static bool is_acceptable(const questions *q, size_t group)
{
    return frame_group_fails(&q->groups->groups[group], q->result) &&
           q->result->pairs[q->groups->groups[group].first].finding != FOUND_UNREADABLE;
}

/* ---- The difference picture ---------------------------------------------------------------------------------- */

/* Without a temporary folder, the questions are asked without difference pictures. */
static void make_folder(questions *q)
{
    const char *parent = getenv("TMPDIR");
    q->folder = path_join(parent && *parent ? parent : "/tmp", "octreel-accept-XXXXXX");
    if (q->folder && mkdtemp(q->folder)) {
        q->difference = path_join(q->folder, "difference.png");
        return;
    }
    free(q->folder);
    q->folder = NULL;
}

static void remove_folder(questions *q)
{
    if (q->difference)
        remove(q->difference);
    if (q->folder)
        rmdir(q->folder);
    free(q->difference);
    free(q->folder);
}

/* ---- One question -------------------------------------------------------------------------------------------- */

static void print_path(FILE *out, const char *which, const char *path)
{
    fprintf(out, "    %-10s  ", which);
    write_escaped(out, path, escape_nothing);
    fputc('\n', out);
}

static void print_finding(const questions *q, const frame_group *group)
{
    FILE *out = q->with->out;
    octreel_error ignored;
    const diff_pair *pair = &q->result->pairs[group->first];
    fprintf(out, "\nfinding %zu of %zu:\n", q->asked, q->count);
    diff_report_print_group(out, group);
    if (pair->a && pair->a->path)
        print_path(out, evidence_picture_name(EVIDENCE_EXPECTED), pair->a->path);
    if (pair->b && pair->b->path)
        print_path(out, evidence_picture_name(EVIDENCE_ACTUAL), pair->b->path);
    if (q->difference && evidence_has_difference(pair) &&
        evidence_write_difference(pair, &q->result->options, q->difference, &ignored))
        print_path(out, evidence_picture_name(EVIDENCE_DIFFERENCE), q->difference);
}

static answer read_answer(FILE *in)
{
    static const char letters[] = {[YES] = 'y', [NO] = 'n', [ALL] = 'a', [QUIT] = 'q'};
    int letter = fgetc(in), last = letter;
    while (last != '\n' && last != EOF)
        last = fgetc(in);
    if (letter == EOF)
        return QUIT;
    const char *found = memchr(letters, letter, sizeof letters);
    return found ? (answer)(found - letters) : HELP;
}

static answer ask(const questions *q)
{
    for (;;) {
        fputs("accept? y, n, a, q or ? for help: ", q->with->out);
        fflush(q->with->out);
        const answer given = read_answer(q->with->in);
        if (given != HELP) {
            if (feof(q->with->in))
                fputc('\n', q->with->out);
            return given;
        }
        fputs("  y  accept all frames of this finding\n"
              "  n  skip it\n"
              "  a  accept it and all findings that follow\n"
              "  q  quit; the findings that were accepted stay accepted\n",
              q->with->out);
    }
}

/* ---- All questions ------------------------------------------------------------------------------------------- */

static bool choose_group(questions *q, size_t group, octreel_error *error)
{
    const frame_group *g = &q->groups->groups[group];
    bool ok = true;
    for (size_t i = g->first; ok && i <= g->last; i++)
        if (q->groups->of[i] == group)
            ok = frame_list_add(q->chosen, diff_pair_name(&q->result->pairs[i]), 0, error);
    return ok;
}

static bool ask_about_all(questions *q, octreel_error *error)
{
    answer given = NO;
    bool ok = true;
    for (size_t i = 0; i < q->groups->count; i++)
        q->count += is_acceptable(q, i);
    for (size_t i = 0; ok && given != QUIT && i < q->groups->count; i++) {
        if (!is_acceptable(q, i)) {
            fputc('\n', q->with->out);
            diff_report_print_group(q->with->out, &q->groups->groups[i]);
            continue;
        }
        q->asked++;
        if (given != ALL) {
            print_finding(q, &q->groups->groups[i]);
            given = ask(q);
        }
        ok = (given != YES && given != ALL) || choose_group(q, i, error);
    }
    return ok;
}

bool choose_findings(void *context, diff_side *reference, const diff_side *frames, diff_result *result,
                     frame_list *chosen, octreel_error *error)
{
    explanation why = {0};
    frame_groups groups = {0};
    questions q = {.with = context, .result = result, .groups = &groups, .chosen = chosen};
    if (result->by_ticks)
        return error_set(error, "%s: --interactive asks about frames, and this recording has none", frames->path);
    bool ok = picture_store_fetch(reference, frames, result, error) && history_find_flaky(reference, result, error) &&
              explain(reference, frames, result, DIFF_REPORT_PAGE_CAUSES, &why, error) &&
              frame_groups_make(&groups, result, &why, false, error);
    make_folder(&q);
    ok = ok && ask_about_all(&q, error);
    remove_folder(&q);
    frame_groups_release(&groups);
    explanation_release(&why);
    return ok;
}
