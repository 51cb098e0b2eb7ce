/* SPDX-License-Identifier: MIT */
/* caption.c - the words of a caption.
 *
 * A caption is made of phrases, separated by semicolons: the player's step, moving points, splits and merges, queries,
 * wrong answers. A phrase about a single thing names it. A phrase about several things counts them. */
#include "caption.h"
#include "foreign_nodes.h"
#include "judgement.h"
#include "number.h"
#include "octree/octree.h"
#include "text.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct words {
    char *text;
    size_t used;
} words;

static void append(words *w, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(w->text + w->used, CAPTION_TEXT - w->used, format, arguments);
    va_end(arguments);
    w->used += length > 0 ? (size_t)length : 0;
    w->used = w->used < CAPTION_TEXT ? w->used : CAPTION_TEXT - 1;
}

static void begin_phrase(words *w)
{
    if (w->used)
        append(w, "; ");
}

/* Append the text `before` and a position, such as "(0, 50, 0)". */
static void append_place(words *w, const char *before, const double place[3])
{
    char x[NUMBER_TEXT], y[NUMBER_TEXT], z[NUMBER_TEXT];
    append(w, "%s(%s, %s, %s)", before, number_format(place[0] + 0.0, 6, x), number_format(place[1] + 0.0, 6, y),
           number_format(place[2] + 0.0, 6, z)); /* adding 0.0 turns -0 into 0 */
}

/* Append "point 7", or "3 points". */
static void append_points(words *w, const octree_point *points, size_t count)
{
    if (count == 1)
        append(w, "point %" PRIu64, points->id);
    else
        append(w, "%zu points", count);
}

/* ---- The player ---------------------------------------------------------------------------------------------- */

/* Append the bound of the world that a key press would have crossed: "x = 1000". */
static void append_world_limit(words *w, const layer_source *in)
{
    static const char keys[] = "adswfe"; /* lower and upper direction of each axis */
    const size_t direction = (size_t)(strchr(keys, in->tick->key) - keys);
    char bound[NUMBER_TEXT];
    append(w, "%c = %s", "xyz"[direction / 2],
           number_format((direction % 2 ? in->world.max : in->world.min)[direction / 2], 6, bound));
}

/* Append the step that a key press caused or, if the player did not make the step, the reason. */
static void append_step(words *w, const layer_source *in)
{
    const octree_tick *tick = in->tick;
    append(w, "%c: ", tick->key);
    if (tick->events & OCTREE_EVENT_MOVED) {
        append_place(w, "player to ", tick->player);
    } else if (tick->hit_count) {
        append(w, "step taken back, its box would hit ");
        append_points(w, tick->hits, tick->hit_count);
    } else if (tick->events & OCTREE_EVENT_FULL) {
        append(w, "step taken back, the leaf there is full");
    } else {
        append(w, "step refused, the world ends at ");
        append_world_limit(w, in);
    }
}

/* Append the answer to the query that the key n asks: which point is nearest to the player. */
static void append_nearest_point(words *w, const octree_tick *tick)
{
    char away[NUMBER_TEXT];
    const octree_answer *answer = tick->answers;
    if (tick->answer_count == 0 || !answer->by_key || answer->count == 0)
        append(w, "n: there is no other point");
    else
        append(w, "n: nearest is point %" PRIu64 ", %s away", answer->neighbors->point.id,
               number_format(answer->neighbors->distance, 6, away));
}

static void append_player(words *w, const layer_source *in)
{
    const octree_tick *tick = in->tick;
    const bool steps = tick->key && strchr("wsdaef", tick->key) && in->session->player.kind == OCTREE_PLAYER_KEYS;
    if (steps && tick->has_player) {
        append_step(w, in);
    } else if (tick->key == 'n') {
        append_nearest_point(w, tick);
    } else if (tick->has_player && in->session->player.kind == OCTREE_PLAYER_BODY) {
        append_place(w, "player at ", tick->player);
    }
    if (tick->hit_count == 0 || (steps && !(tick->events & OCTREE_EVENT_MOVED)))
        return;
    begin_phrase(w);
    append_points(w, tick->hits, tick->hit_count);
    append(w, " in the player's box");
}

/* ---- The tree ------------------------------------------------------------------------------------------------ */

/* Append the points that the tick moved, edited or refused. */
static void append_changes_of_points(words *w, const octree_tick *tick)
{
    if (tick->mover_count) {
        begin_phrase(w);
        append(w, "%zu point%s move%s", tick->mover_count, plural_ending(tick->mover_count),
               verb_ending(tick->mover_count));
    }
    if (tick->edit_count) {
        begin_phrase(w);
        append(w, "%zu edit%s", tick->edit_count, plural_ending(tick->edit_count));
    }
    if (tick->refusal_count && (tick->number == 0 || tick->edit_count)) {
        begin_phrase(w);
        if (tick->refusal_count == 1)
            append(w, "point %" PRIu64 " refused, %s", tick->refusals->id,
                   tick->refusals->why == OCTREE_FULL ? "its leaf is full" : octree_status_text(tick->refusals->why));
        else
            append(w, "%zu points refused", tick->refusal_count);
    }
}

/* Append the overlapping pairs of a tick. */
static void append_pairs(words *w, const octree_tick *tick)
{
    if (tick->pair_count == 0)
        return;
    begin_phrase(w);
    if (tick->pair_count == 1)
        append(w, "bodies %" PRIu64 " and %" PRIu64 " overlap", tick->pairs->a, tick->pairs->b);
    else
        append(w, "%zu pairs of bodies overlap", tick->pair_count);
}

/* Append the splits and merges of a tick. */
static void append_changes_of_nodes(words *w, const layer_source *in)
{
    const octree_tick *tick = in->tick;
    char address[OCTREE_ADDRESS_TEXT];
    octree_node node;
    if (tick->split_count == 1 && octree_node_at(in->tree, tick->splits[0], &node) == OCTREE_OK) {
        begin_phrase(w);
        append(w, "leaf %s splits, %zu points for capacity %zu", octree_address_format(tick->splits[0], address),
               node.count, octree_definition(in->tree).leaf_capacity);
    } else if (tick->split_count) {
        begin_phrase(w);
        append(w, "%zu leaves split", tick->split_count);
    }
    if (tick->merge_count == 1) {
        begin_phrase(w);
        append(w, "node %s merges", octree_address_format(tick->merges[0], address));
    } else if (tick->merge_count) {
        begin_phrase(w);
        append(w, "%zu nodes merge", tick->merge_count);
    }
}

/* ---- Queries ------------------------------------------------------------------------------------------------- */

static void append_single_answer(words *w, const layer_source *in, const octree_answer *answer)
{
    octree_stats stats;
    if (in->tick)
        stats = in->tick->stats;
    else
        octree_statistics(in->tree, &stats);
    const octree_query_traits *about = octree_query_about(answer->kind);
    if (about->members & (OCTREE_QUERY_HAS_DIRECTION | OCTREE_QUERY_HAS_TO))
        append(w, "%zu hit%s of the %s", answer->count, plural_ending(answer->count), about->region);
    else if (!about->neighbors)
        append(w, "%zu point%s in the %s", answer->count, plural_ending(answer->count), about->region);
    else
        append_place(w, answer->k == 1 ? "nearest to " : "nearest points to ", answer->target);
    append(w, ": %" PRIu64 " of %zu nodes visited", answer->cost.nodes, stats.nodes);
}

static void append_answers(words *w, const layer_source *in)
{
    const size_t keyed = in->answer_count && in->answers[0].by_key, count = in->answer_count - keyed;
    size_t worst;
    uint64_t visited = 0;
    for (size_t i = keyed; i < in->answer_count; i++)
        visited += in->answers[i].cost.nodes;
    if (count) {
        begin_phrase(w);
        if (count == 1)
            append_single_answer(w, in, &in->answers[keyed]);
        else
            append(w, "%zu queries visit %" PRIu64 " nodes", count, visited);
    }
    const size_t wrong = judgement_count_wrong(in->answers, in->answer_count, &worst);
    if (wrong) {
        begin_phrase(w);
        append(w, "%zu foreign answer%s wrong", wrong, wrong == 1 ? " is" : "s are");
    }
    if (in->tick && in->tick->foreign_pairs.wrong) {
        char words[JUDGEMENT_TEXT];
        begin_phrase(w);
        append(w, "foreign pairs: %s", pair_judgement_text(&in->tick->foreign_pairs, words));
    }
}

/* ---- A caption ----------------------------------------------------------------------------------------------- */

static void append_tree(words *w, const octree_stats *stats, size_t capacity)
{
    append(w, "%zu point%s in %zu %s of capacity %zu, ", stats->points, plural_ending(stats->points), stats->leaves,
           stats->leaves == 1 ? "leaf" : "leaves", capacity);
    if (stats->depth == 0)
        append(w, "the root");
    else
        append(w, "at most %u level%s deep", stats->depth, plural_ending(stats->depth));
}

static void append_initial_tree(words *w, const layer_source *in)
{
    octree_stats stats;
    octree_statistics(in->tree, &stats);
    append_tree(w, &stats, octree_definition(in->tree).leaf_capacity);
}

void caption_write(const layer_source *in, char text[CAPTION_TEXT])
{
    words w = {.text = text};
    text[0] = 0;
    if (in->tick && in->tick->gap) {
        append(&w, "gap: %s", in->tick->gap);
        return;
    }
    if (in->tick && in->tick->number) {
        append_player(&w, in);
        append_changes_of_points(&w, in->tick);
        if (shows_octreel_nodes(in))
            append_changes_of_nodes(&w, in);
    } else if (shows_octreel_nodes(in)) {
        append_initial_tree(&w, in);
        if (in->tick)
            append_changes_of_points(&w, in->tick);
    }
    if (in->tick)
        append_pairs(&w, in->tick);
    append_answers(&w, in);
    if (w.used == 0 && in->tick)
        append(&w, "%s", in->session->player.kind == OCTREE_PLAYER_KEYS ? "the player waits" : "nothing changes");
}
