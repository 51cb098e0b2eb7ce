/* explain.c - see explain.h. */
#include "explain.h"
#include "cause_words.h"
#include "explain_pair.h"
#include "frame_file.h"
#include "same_bytes.h"
#include "sentence.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool explain_is_unlike(const diff_pair *pair)
{
    return pair->finding != FOUND_SAME_BYTES && pair->finding != FOUND_SAME_PIXELS && pair->finding != FOUND_UNREADABLE;
}

void explanation_free(explanation *e)
{
    if (!e)
        return;
    recorded_close(&e->sides[0]);
    recorded_close(&e->sides[1]);
    cause_release(&e->cause);
    free(e);
}

/* ---- Playing both -------------------------------------------------------------------------------------------- */

/* Lines that are the same, of ticks that are the same, are both right or both wrong. */
static bool check_lines(void *context, const octree_game *const games[2], bool differs, record_error *error)
{
    explanation *e = context;
    recorded *const sides[2] = {&e->sides[0], &e->sides[1]};
    const uint64_t tick = octree_game_tick(games[0])->number;
    if (!recorded_read_line(sides[0], tick, error) || !recorded_read_line(sides[1], tick, error))
        return false;
    const line_reader *x = &sides[0]->lines, *y = &sides[1]->lines;
    const bool both = sides[0]->reading && sides[1]->reading;
    if (both && !differs && x->size == y->size && memcmp(x->line, y->line, x->size) == 0)
        return true;
    return recorded_check_line(sides[0], games[0], error) && recorded_check_line(sides[1], games[1], error);
}

static int by_number(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* The ticks of the first pairs that differ, in ascending order. */
static uint64_t *list_ticks(const diff_result *result, uint64_t most, size_t *count)
{
    uint64_t *ticks = malloc((result->count + 1) * sizeof *ticks);
    *count = 0;
    for (size_t i = 0; ticks && i < result->count && *count < most; i++)
        if (explain_is_unlike(&result->pairs[i]) && frame_parse_name(diff_pair_name(&result->pairs[i]), &ticks[*count]))
            ++*count;
    if (ticks)
        qsort(ticks, *count, sizeof *ticks, by_number);
    return ticks;
}

static bool play_both(explanation *e, const diff_result *result, uint64_t most, record_error *error)
{
    cause_wanted wanted = {.first = most < SIZE_MAX ? (size_t)most : SIZE_MAX};
    uint64_t *ticks = list_ticks(result, most, &wanted.count);
    if (!ticks)
        return record_fail(error, "there is no memory for %zu ticks", result->count);
    wanted.ticks = ticks;
    const cause_look looks[2] = {e->sides[0].look, e->sides[1].look};
    const bool ok = cause_find(&e->sides[0].session.session, &e->sides[1].session.session, looks, &wanted, check_lines,
                               e, &e->cause, error);
    free(ticks);
    return ok;
}

/* ---- The headline -------------------------------------------------------------------------------------------- */

/* All of the pairs that were explained, when each is the same picture drawn otherwise. */
static const diff_pair *only_drawn(const diff_result *result)
{
    const diff_pair *first = NULL;
    for (size_t i = 0; i < result->count; i++) {
        const diff_pair *pair = &result->pairs[i];
        if (!explain_is_unlike(pair))
            continue;
        if (!pair->only_drawn)
            return NULL;
        first = first ? first : pair;
    }
    return first;
}

/* The first pair that has a cause, where nothing can be said of all. */
static const diff_pair *first_explained(const diff_result *result)
{
    for (size_t i = 0; i < result->count; i++)
        if (result->pairs[i].cause)
            return &result->pairs[i];
    return NULL;
}

static void print_doubts(FILE *out, const explanation *e)
{
    bool any = false;
    for (int side = 0; e && side < 2; side++)
        for (size_t i = 0; i < e->sides[side].doubt_count; i++) {
            fprintf(out, "%s%s", any ? "; " : "", e->sides[side].doubts[i]);
            any = true;
        }
}

static bool any_doubt(const explanation *e)
{
    return e && e->sides[0].doubt_count + e->sides[1].doubt_count > 0;
}

/* What nobody changed comes from who drew it, and what files say is doubted before it is believed. */
static void print_headline(FILE *out, const diff_result *result)
{
    const explanation *e = result->explanation;
    const bool known = e && (cause_any(&e->cause.session) || cause_any(&e->cause.look));
    const diff_pair *drawn = only_drawn(result), *first = first_explained(result);
    print_doubts(out, e);
    if (any_doubt(e) && (known || first))
        fputs("; ", out);
    if (known)
        cause_print_headline(out, &e->cause);
    else if (drawn)
        fputs(drawn->cause, out);
    else if (first && e)
        fprintf(out, "%s: %s", diff_pair_name(first), first->cause);
}

static bool say(diff_result *result, record_error *error)
{
    sentence s;
    if (sentence_begin(&s))
        print_headline(s.stream, result);
    const bool ok = sentence_end(&s, &result->headline);
    return ok || record_fail(error, "there is no memory for a headline");
}

/* ---- Both kinds of sides ------------------------------------------------------------------------------------- */

/* Whether a file is in one of them alone, or not the same in both. */
static bool file_differs(const diff_side *a, const diff_side *b, const char *name)
{
    char *paths[2] = {folder_path(a->path, name), folder_path(b->path, name)};
    const bool there = paths[0] && paths[1] && (access(paths[0], F_OK) == 0 || access(paths[1], F_OK) == 0);
    const bool differs = there && !same_bytes(paths[0], paths[1]);
    free(paths[0]);
    free(paths[1]);
    return differs;
}

static bool any_to_explain(const diff_side *a, const diff_side *b, const diff_result *result)
{
    for (size_t i = 0; i < result->count; i++)
        if (explain_is_unlike(&result->pairs[i]))
            return true;
    return a->kind == DIFF_RECORDING && b->kind == DIFF_RECORDING &&
           (file_differs(a, b, "session.json") || file_differs(a, b, "recording.json") ||
            file_differs(a, b, "ticks.jsonl"));
}

static bool explain_pairs(diff_result *result, uint64_t most, record_error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && i < result->count && most > 0; i++) {
        if (!explain_is_unlike(&result->pairs[i]))
            continue;
        ok = explain_pair(result->explanation, &result->pairs[i], error);
        most--;
    }
    return ok;
}

static bool explain(const diff_side *a, const diff_side *b, uint64_t most, diff_result *result, record_error *error)
{
    explanation *e = NULL;
    bool ok = true;
    if (a->kind == DIFF_RECORDING && b->kind == DIFF_RECORDING) {
        e = result->explanation = calloc(1, sizeof *e);
        ok = e || record_fail(error, "there is no memory");
        ok = ok && recorded_open(&e->sides[0], a, error) && recorded_open(&e->sides[1], b, error) &&
             play_both(e, result, most, error);
    }
    return ok && explain_pairs(result, most, error) && say(result, error);
}

bool diff_explain(const diff_side *a, const diff_side *b, uint64_t most, diff_result *result, record_error *error)
{
    record_error why;
    if (most == 0 || !any_to_explain(a, b, result) || explain(a, b, most, result, &why))
        return true;
    explanation_free(result->explanation);
    result->explanation = NULL;
    result->verdict = DIFF_TROUBLE;
    result->trouble = strdup(why.text);
    return result->trouble || record_fail(error, "%s", why.text);
}
