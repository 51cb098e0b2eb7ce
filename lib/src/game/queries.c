/* SPDX-License-Identifier: MIT */
/* queries.c - asks the queries of a tick, judges foreign answers, and lists the nodes that the searches visited. */
#include "queries.h"
#include "game_state.h"
#include "../query/search.h"

#include <string.h>

/* ---- The queries of a tick ---------------------------------------------------------------------------------- */

/* Judge the foreign answer and the foreign nodes of a query. The exact answer is the last answer in game->answers.
 * `points` and `neighbors` are the lengths that the two lists of results had before the exact answer was appended.
 * Returns false if memory runs out. */
static bool judge_foreign_query(octree_game *game, const octree_query *query, const octree_search *how, size_t points,
                                size_t neighbors)
{
    octree_answer *answer = (octree_answer *)game->answers.items + game->answers.count - 1;
    const bool near = octree_query_about(query->kind)->neighbors, none = answer->count == 0;
    const audited_points all = game_audited_points(game);
    const judged_query about = {
        .points = &all,
        .query = query,
        .answer = answer,
        .exact_points = near || none ? NULL : (const octree_point *)game->found_points.items + points,
        .exact_neighbors = near && !none ? (const octree_neighbor *)game->found_neighbors.items + neighbors : NULL,
        .skip = near ? how->skip : query->skip,
        .skip_id = near ? how->skip_id : query->skip_id};
    game->tick.judged |= query->answered;
    if (query->answered && !judge_answer(&game->judge, &about, &answer->judgement))
        return false;
    if (answer->judgement.wrong)
        game->tick.events |= OCTREE_EVENT_WRONG;
    return foreign_record_query(&game->foreign, &game->judge, &about, game->answers.count - 1);
}

static bool run_game_query(octree_game *game, const octree_query *query, bool by_key)
{
    if (query->at_player && !game->tick.has_player)
        return true;
    octree_answer *answer = list_append(&game->memory, &game->answers, sizeof *answer);
    if (!answer)
        return false;
    query_run run = {.tree = game->tree,
                     .bodies = &game->shown,
                     .extended = game->bodies.extended > 0,
                     .how = game_make_search_options(game, NULL),
                     .memory = &game->memory};
    run.points = &game->found_points;
    run.neighbors = &game->found_neighbors;
    run.how.skip = query->at_player ? OCTREE_SKIP_ID : OCTREE_SKIP_NONE;
    run.how.skip_id = game->session->player.id;
    const size_t points = game->found_points.count, neighbors = game->found_neighbors.count;
    const octree_status status = run_query(&run, query, game->tick.player, answer);
    answer->by_key = by_key;
    return status == OCTREE_OK && judge_foreign_query(game, query, &run.how, points, neighbors);
}

bool game_run_queries(octree_game *game, const octree_query *queries, size_t count)
{
    bool ok = true;
    for (size_t i = 0; ok && i < count; i++)
        ok = run_game_query(game, &queries[i], false);
    return ok;
}

bool game_run_query_of_key(octree_game *game)
{
    const octree_query nearest = {.kind = OCTREE_QUERY_NEAREST, .at_player = true};
    return game->tick.key != 'n' || run_game_query(game, &nearest, true);
}

/* Set the pointers of each answer to its part of the lists of results. The lists must not grow any more in this
 * tick. */
static void assign_results_to_answers(octree_game *game)
{
    const octree_point *points = game->found_points.items;
    const octree_neighbor *neighbors = game->found_neighbors.items;
    octree_answer *answers = game->answers.items;
    for (size_t i = 0; i < game->answers.count; i++) {
        octree_answer *answer = &answers[i];
        if (answer->count == 0)
            continue;
        if (octree_query_about(answer->kind)->neighbors) {
            answer->neighbors = neighbors;
            neighbors += answer->count;
        } else {
            answer->points = points;
            points += answer->count;
        }
    }
    judge_assign_lists(&game->judge, answers, game->answers.count);
}

/* ---- Visited nodes ------------------------------------------------------------------------------------------ */

static void record_visit(octree_address node, octree_trace_kind touch, void *context)
{
    octree_game *game = context;
    const octree_visit visit = {node, touch, touch == OCTREE_TRACE_TAKEN};
    game->out_of_memory |= !list_push(&game->memory, &game->visits, &visit, sizeof visit);
}

octree_search game_make_search_options(octree_game *game, octree_cost *cost)
{
    return (octree_search){.cost = cost, .trace = record_visit, .trace_context = game};
}

/* Compare two visits by their nodes. Of the visits of one node, those that visited the node come first, then those that
 * took it whole, then those that pruned it. */
static int compare_visits(const void *a, const void *b)
{
    static const int weakness[OCTREE_TRACE_KINDS] = {
        [OCTREE_TRACE_VISITED] = 0, [OCTREE_TRACE_TAKEN] = 1, [OCTREE_TRACE_PRUNED] = 2};
    const octree_visit *p = a, *q = b;
    return p->node == q->node ? weakness[p->touch] - weakness[q->touch] : compare_addresses(&p->node, &q->node);
}

static void sort_and_merge_visits(octree_game *game)
{
    octree_tick *tick = &game->tick;
    octree_visit *visits = game->visits.items;
    size_t kept = 0;
    list_sort(&game->visits, sizeof *visits, compare_visits);
    for (int touch = 0; touch < OCTREE_TRACE_KINDS; touch++)
        tick->touched[touch] = 0;
    for (size_t i = 0; i < game->visits.count; i++) {
        if (kept && visits[i].node == visits[kept - 1].node) {
            visits[kept - 1].taken |= visits[i].taken;
            continue;
        }
        tick->touched[visits[i].touch]++;
        visits[kept++] = visits[i];
    }
    game->visits.count = kept;
}

static bool add_leaf_of_point(octree_game *game, const octree_point *point)
{
    const uint64_t code = morton_code(game->tree->axes, point->position);
    const octree_address leaf = morton_address(code, find_path(game->tree, code).depth);
    return list_push(&game->memory, &game->hit_leaves, &leaf, sizeof leaf);
}

static bool add_result_leaves(octree_game *game)
{
    const octree_point *hits = game->hits.items, *found = game->found_points.items;
    const octree_neighbor *near = game->found_neighbors.items;
    bool ok = true;
    for (size_t i = 0; ok && i < game->hits.count; i++)
        ok = add_leaf_of_point(game, &hits[i]);
    for (size_t i = 0; ok && i < game->found_points.count; i++)
        ok = add_leaf_of_point(game, &found[i]);
    for (size_t i = 0; ok && i < game->found_neighbors.count; i++)
        ok = add_leaf_of_point(game, &near[i].point);
    return ok;
}

static void sort_and_merge_leaves(octree_game *game)
{
    octree_address *leaves = game->hit_leaves.items;
    size_t kept = 0;
    list_sort(&game->hit_leaves, sizeof *leaves, compare_addresses);
    for (size_t i = 0; i < game->hit_leaves.count; i++)
        if (kept == 0 || leaves[i] != leaves[kept - 1])
            leaves[kept++] = leaves[i];
    game->hit_leaves.count = kept;
}

bool game_finish_queries(octree_game *game)
{
    if (game->out_of_memory || !add_result_leaves(game))
        return false;
    assign_results_to_answers(game);
    sort_and_merge_visits(game);
    sort_and_merge_leaves(game);
    return true;
}
