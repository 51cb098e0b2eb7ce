/* SPDX-License-Identifier: MIT */
/* groups.c - groups pairs by cause and prints the sentences of reports.
 *
 * The pairs of frames that a report lists are sorted by the key of their cause and then by index. Each run of equal
 * keys becomes one group. The first pair of a group has the lowest index in the group. A second pass numbers the
 * groups in the order of their first pairs, so that a report lists groups in the order of frames. If all frames of a
 * group are frames of ticks, a report names them by ranges of ticks. Cost: O(n log n).
 */
#include "groups.h"
#include "diff_words.h"
#include "text.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Sentences ----------------------------------------------------------------------------------------------- */

static bool are_frames_of_ticks(const frame_groups *g, const diff_result *result, size_t group)
{
    for (size_t i = g->groups[group].first; i <= g->groups[group].last; i++)
        if (g->of[i] == group && diff_pair_tick(&result->pairs[i]) == DIFF_NO_TICK)
            return false;
    return true;
}

static void print_frame_name(FILE *out, const diff_pair *pair, bool ticks)
{
    if (ticks)
        fprintf(out, "%" PRIu64, diff_pair_tick(pair));
    else
        write_escaped(out, diff_pair_name(pair), escape_nothing);
}

/* Print the names of a group's frames. With `others`, leave out the group's first frame. */
static void print_frame_names(FILE *out, const frame_groups *g, const diff_result *result, size_t group, bool others)
{
    const bool ticks = are_frames_of_ticks(g, result, group);
    const size_t last = g->groups[group].last, all = g->groups[group].count - others;
    size_t runs = 0, shown = 0;
    if (ticks)
        fputs(all == 1 ? "tick " : "ticks ", out);
    for (size_t i = g->groups[group].first + others, end; i <= last && runs < GROUP_RUNS; i = end) {
        for (end = i; end <= last && g->of[end] == group;)
            end++;
        if (end > i) {
            fputs(runs++ ? ", " : "", out);
            print_frame_name(out, &result->pairs[i], ticks);
            if (end - i > 1)
                fputs(end - i > 2 ? " to " : ", ", out);
            if (end - i > 1)
                print_frame_name(out, &result->pairs[end - 1], ticks);
        }
        shown += end - i;
        end += end == i;
    }
    if (shown < all)
        fprintf(out, " and %zu more", all - shown);
}

/* Return the zero-terminated text at *at, and move *at to the text after it. */
static const char *take_next_text(const char **at)
{
    const char *text = *at;
    *at += strlen(text) + 1;
    return text;
}

/* Print all sentences of the groups into one block of memory. A zero byte ends each sentence. */
static bool print_sentences(frame_groups *g, const diff_result *result, const explanation *why)
{
    text_stream s;
    if (!text_stream_begin(&s))
        return false;
    diff_print_verdict(s.stream, result, explanation_verdict(why, result));
    putc(0, s.stream);
    diff_print_tolerance(s.stream, result);
    putc(0, s.stream);
    for (size_t i = 0; i < g->count; i++) {
        diff_print_pair(s.stream, &result->pairs[g->groups[i].first]);
        putc(0, s.stream);
        diff_print_difference(s.stream, &result->pairs[g->groups[i].first]);
        putc(0, s.stream);
        print_frame_names(s.stream, g, result, i, false);
        putc(0, s.stream);
        if (g->groups[i].count > 1)
            print_frame_names(s.stream, g, result, i, true);
        putc(0, s.stream);
    }
    if (!text_stream_end(&s, &g->sentences))
        return false;
    const char *at = g->sentences;
    g->verdict = take_next_text(&at);
    g->tolerance = take_next_text(&at);
    for (size_t i = 0; i < g->count; i++) {
        g->groups[i].cause = explanation_cause(why, g->groups[i].first);
        g->groups[i].line = take_next_text(&at);
        g->groups[i].difference = take_next_text(&at);
        g->groups[i].frames = take_next_text(&at);
        g->groups[i].others = take_next_text(&at);
    }
    return true;
}

/* ---- Groups -------------------------------------------------------------------------------------------------- */

/* A pair of frames, and the key of its cause. Pairs are sorted by this key. */
typedef struct keyed_pair {
    const char *key;
    size_t pair;
} keyed_pair;

static int compare_by_key(const void *a, const void *b)
{
    const keyed_pair *x = a, *y = b;
    const int order = strcmp(x->key, y->key);
    return order ? order : (x->pair > y->pair) - (x->pair < y->pair);
}

/* Number the groups in the order of their first pairs, and count their pairs. first[i] is the index of the first pair
 * in the group of pair i, or GROUP_NONE. */
static void number_groups(frame_groups *g, size_t pairs, const size_t *first)
{
    for (size_t i = 0; i < pairs; i++) {
        if (first[i] == GROUP_NONE)
            continue;
        if (first[i] == i)
            g->groups[g->count++] = (frame_group){.first = i};
        g->of[i] = first[i] == i ? g->count - 1 : g->of[first[i]];
        g->groups[g->of[i]].last = i;
        g->groups[g->of[i]].count++;
    }
}

bool frame_groups_make(frame_groups *g, const diff_result *result, const explanation *why, bool each,
                       octreel_error *error)
{
    const size_t pairs = result->count;
    size_t count = 0, *first = malloc((pairs + 1) * sizeof *first);
    keyed_pair *keyed = malloc((pairs + 1) * sizeof *keyed);
    *g = (frame_groups){.groups = malloc((pairs + 1) * sizeof *g->groups), .of = malloc((pairs + 1) * sizeof *g->of)};
    const bool ok = (first && keyed && g->groups && g->of) || error_no_memory(error);
    for (size_t i = 0; ok && i < pairs; i++) {
        const bool listed = diff_is_listed(result->pairs[i].finding);
        const char *key = each || !why->pairs ? NULL : why->pairs[i].key;
        g->of[i] = GROUP_NONE;
        first[i] = listed ? i : GROUP_NONE;
        if (listed && key)
            keyed[count++] = (keyed_pair){key, i};
    }
    if (ok && count > 0)
        qsort(keyed, count, sizeof *keyed, compare_by_key);
    for (size_t i = 1; ok && i < count; i++)
        if (strcmp(keyed[i].key, keyed[i - 1].key) == 0)
            first[keyed[i].pair] = first[keyed[i - 1].pair];
    if (ok)
        number_groups(g, pairs, first);
    free(keyed);
    free(first);
    return ok && (print_sentences(g, result, why) || error_no_memory(error));
}

void frame_groups_release(frame_groups *g)
{
    free(g->groups);
    free(g->of);
    free(g->sentences);
    *g = (frame_groups){0};
}

bool frame_groups_is_first(const frame_groups *g, size_t pair)
{
    return g->of[pair] != GROUP_NONE && g->groups[g->of[pair]].first == pair;
}

bool frame_group_fails(const frame_group *group, const diff_result *result)
{
    return diff_finding_verdict(result->pairs[group->first].finding) != DIFF_SAME;
}

size_t frame_groups_count_failing(const frame_groups *g, const diff_result *result)
{
    size_t count = 0;
    for (size_t i = 0; i < g->count; i++)
        count += frame_group_fails(&g->groups[i], result);
    return count;
}
