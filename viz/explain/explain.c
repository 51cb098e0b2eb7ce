/* SPDX-License-Identifier: MIT */
/* explain.c - explains why two sides differ, for each pair of frames. If both sides are recordings, the file also plays
 * their sessions. */
#include "explain.h"
#include "array.h"
#include "cause_words.h"
#include "pair_look.h"
#include "parallel.h"
#include "file.h"
#include "text.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

bool explain_has_difference(const diff_pair *pair)
{
    return pair->finding != FOUND_SAME_BYTES && pair->finding != FOUND_SAME_PIXELS && pair->finding != FOUND_UNREADABLE;
}

void explanation_release(explanation *e)
{
    for (size_t i = 0; i < e->count; i++) {
        free(e->pairs[i].text);
        free(e->pairs[i].key);
    }
    free(e->pairs);
    free(e->headline);
    free(e->trouble);
    recorded_close(&e->sides[0]);
    recorded_close(&e->sides[1]);
    cause_release(&e->cause);
    tracer_close(&e->tracer);
    *e = (explanation){0};
}

const char *explanation_cause(const explanation *e, size_t i)
{
    return e->pairs ? e->pairs[i].text : NULL;
}

diff_verdict explanation_verdict(const explanation *e, const diff_result *result)
{
    return e->trouble ? DIFF_TROUBLE : result->verdict;
}

/* ---- Playing both recordings ----------------------------------------------------------------------------------- */

/* A pair of frames that is explained, and the tick of these frames. */
typedef struct wanted_pair {
    uint64_t tick;
    const diff_pair *pair;
} wanted_pair;

/* The state while both recordings are played. */
typedef struct watching {
    explanation *e;
    const diff_options *options;
    wanted_pair *pairs; /* the pairs to explain, in ascending order of ticks */
    size_t count;
} watching;

static const wanted_pair *find_wanted(const watching *w, uint64_t tick)
{
    return w->count ? bsearch(&tick, w->pairs, w->count, sizeof *w->pairs, compare_uint64) : NULL;
}

/* Return whether the pair of frames of this tick is explained. */
static bool is_wanted(void *context, uint64_t tick)
{
    return find_wanted(context, tick);
}

static bool explain_pair_of_tick(void *context, const octree_game *const games[2], bool differs, octreel_error *error)
{
    watching *w = context;
    const uint64_t tick = octree_game_tick(games[0])->number;
    if (!recorded_check_tick(w->e->sides, games, differs, error) ||
        !tracer_add_tick(&w->e->tracer, w->e->sides, games, error))
        return false;
    const wanted_pair *wanted = find_wanted(w, tick);
    if (!wanted || !wanted->pair->difference.unlike.pixels)
        return true;
    /* is_wanted() returned true for this tick, so cause_find() has just appended the details of this tick */
    cause_tick *reported = &w->e->cause.ticks[w->e->cause.count - 1];
    return tracer_trace(&w->e->tracer, w->e->sides, games, wanted->pair, w->options, &reported->trace, error);
}

/* Return the first tick whose frames differ. All pairs are searched: the pairs are sorted by name, and names of
 * ticks with more than six digits are not in the order of ticks. */
static uint64_t find_first_tick_with_other_frame(const diff_result *result)
{
    uint64_t first = CAUSE_NO_TICK;
    for (size_t i = 0; i < result->count; i++) {
        const diff_pair *pair = &result->pairs[i];
        if (pair->a && pair->b && explain_has_difference(pair) && diff_pair_tick(pair) < first)
            first = diff_pair_tick(pair);
    }
    return first;
}

/* List the first `most` pairs whose frames differ. */
static bool list_wanted_pairs(watching *w, const diff_result *result, uint64_t most)
{
    w->pairs = malloc((result->count + 1) * sizeof *w->pairs);
    if (!w->pairs)
        return false;
    for (size_t i = 0; i < result->count && w->count < most; i++)
        if (explain_has_difference(&result->pairs[i]))
            w->pairs[w->count++] = (wanted_pair){diff_pair_tick(&result->pairs[i]), &result->pairs[i]};
    qsort(w->pairs, w->count, sizeof *w->pairs, compare_uint64);
    return true;
}

static bool play_both_sessions(explanation *e, const diff_result *result, uint64_t most, octreel_error *error)
{
    const cause_view views[2] = {e->sides[0].view, e->sides[1].view};
    watching w = {.e = e, .options = &result->options};
    const cause_watcher watcher = {most < SIZE_MAX ? (size_t)most : SIZE_MAX, is_wanted, explain_pair_of_tick, &w};
    const bool ok =
        list_wanted_pairs(&w, result, most)
            ? cause_find(&e->sides[0].replay.session, &e->sides[1].replay.session, views, &watcher, &e->cause, error)
            : error_no_memory(error);
    e->cause.drawn = find_first_tick_with_other_frame(result);
    free(w.pairs);
    return ok;
}

/* ---- The headline -------------------------------------------------------------------------------------------- */

/* Print the warnings about both sides. Return whether any warning was printed. */
static bool print_warnings(FILE *out, const explanation *e)
{
    bool any = false;
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < e->sides[side].warning_count; i++) {
            fprintf(out, "%s%s", any ? "; " : "", e->sides[side].warnings[i]);
            any = true;
        }
    return any;
}

/* Print the warnings about files, then the cause. If the sessions are equal and the views are equal, the cause is
 * rendering. */
static void print_headline(FILE *out, const explanation *e, const diff_result *result)
{
    const bool known = e->cause.session.count > 0 || e->cause.view.count > 0;
    /* the index of the first explained pair, and the number of explained pairs whose scenes differ */
    size_t first = e->count, other_scenes = 0;
    for (size_t i = e->count; i-- > 0;)
        if (e->pairs[i].text) {
            first = i;
            other_scenes += !e->pairs[i].only_drawn;
        }
    if (print_warnings(out, e) && (known || first < e->count))
        fputs("; ", out);
    if (known)
        cause_print_headline(out, &e->cause);
    else if (first < e->count && other_scenes == 0)
        pair_print_rendering(out, e);
    else if (first < e->count && e->recordings)
        fprintf(out, "%s: %s", diff_pair_name(&result->pairs[first]), e->pairs[first].text);
}

static bool make_headline(explanation *e, const diff_result *result, octreel_error *error)
{
    text_stream s;
    if (text_stream_begin(&s))
        print_headline(s.stream, e, result);
    const bool ok = text_stream_end(&s, &e->headline);
    return ok || error_no_memory(error);
}

/* ---- The explanation ------------------------------------------------------------------------------------------- */

/* Return whether a file of this name differs between the sides: only one side has the file, or the bytes of the two
 * files differ. */
static bool file_differs(const diff_side *a, const diff_side *b, const char *name)
{
    return (folder_contains(a->path, name) || folder_contains(b->path, name)) &&
           !have_same_file(a->path, b->path, name);
}

static bool has_difference_to_explain(const diff_side *a, const diff_side *b, const diff_result *result)
{
    for (size_t i = 0; i < result->count; i++)
        if (explain_has_difference(&result->pairs[i]))
            return true;
    return a->kind == DIFF_RECORDING && b->kind == DIFF_RECORDING &&
           (file_differs(a, b, "session.json") || file_differs(a, b, "recording.json") ||
            file_differs(a, b, "ticks.jsonl"));
}

/* The context of examine_pair(), which runs for all pairs in parallel. */
typedef struct examining {
    const explanation *e;
    const diff_result *result;
    pair_look *looks;
} examining;

static void examine_pair(size_t i, void *context)
{
    const examining *l = context;
    const diff_pair *pair = &l->result->pairs[i];
    if (explain_has_difference(pair)) {
        l->looks[i] = pair_examine(l->e, pair);
        l->e->pairs[i].key = pair_find_key(l->e, pair, &l->looks[i]);
    }
}

/* For each differing pair, set the key of its cause. For the first `most` differing pairs, also set the sentence. */
static bool explain_pairs(explanation *e, const diff_result *result, uint64_t most, octreel_error *error)
{
    examining l = {e, result, calloc(result->count + 1, sizeof *l.looks)};
    e->pairs = calloc(result->count + 1, sizeof *e->pairs);
    bool ok = (l.looks && e->pairs) || error_no_memory(error);
    e->count = e->pairs ? result->count : 0;
    if (ok)
        parallel_for(result->count, examine_pair, &l);
    for (size_t i = 0; ok && i < result->count && most > 0; i++) {
        if (!explain_has_difference(&result->pairs[i]))
            continue;
        ok = pair_find_cause(e, &result->pairs[i], &l.looks[i], &e->pairs[i], error);
        most--;
    }
    free(l.looks);
    return ok;
}

static bool explain_all(const diff_side *a, const diff_side *b, const diff_result *result, uint64_t most,
                        explanation *e, octreel_error *error)
{
    e->recordings = a->kind == DIFF_RECORDING && b->kind == DIFF_RECORDING;
    if (e->recordings && !(recorded_open(&e->sides[0], a, error) && recorded_open(&e->sides[1], b, error) &&
                           play_both_sessions(e, result, most, error)))
        return false;
    return explain_pairs(e, result, most, error) && make_headline(e, result, error);
}

bool explain(const diff_side *a, const diff_side *b, const diff_result *result, uint64_t most, explanation *e,
             octreel_error *error)
{
    octreel_error why;
    *e = (explanation){0};
    if (most == 0 || !has_difference_to_explain(a, b, result) || explain_all(a, b, result, most, e, &why))
        return true;
    explanation_release(e);
    e->trouble = strdup(why.text);
    return e->trouble || error_set(error, "%s", why.text);
}
