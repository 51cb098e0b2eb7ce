/* SPDX-License-Identifier: MIT */
/* queries.c - what can be asked of a tree: the table of kinds, checking, asking, and the queries of a tick.
 */
#include "queries.h"
#include "game_state.h"
#include "search.h"

#include <stdlib.h>
#include <string.h>

const octree_query_traits *octree_query_about(octree_query_kind kind)
{
#define TRAITS(kind, name, members, named_by, neighbors, words) {#name, members, named_by, neighbors, words},
    static const octree_query_traits table[] = {OCTREE_QUERY_MAP(TRAITS)};
#undef TRAITS
    return (unsigned)kind < OCTREE_QUERY_KINDS ? &table[kind] : NULL;
}

const char *octree_query_name(octree_query_kind kind)
{
    const octree_query_traits *about = octree_query_about(kind);
    return about ? about->name : NULL;
}

static octree_status check_answer(const octree_query *query)
{
    if (query->answered && !query->answer && query->answer_count)
        return OCTREE_NULL_ARGUMENT;
    return (unsigned)query->precision < OCTREE_PRECISIONS ? OCTREE_OK : OCTREE_BAD_OPTION;
}

static octree_status check_met(const octree_ids *met)
{
    if (met->count && !met->ids)
        return OCTREE_NULL_ARGUMENT;
    for (size_t i = 0; i < met->count; i++)
        if (met->ids[i] >= OCTREE_NODE_ID_LIMIT)
            return OCTREE_BAD_SIZE;
    return OCTREE_OK;
}

octree_status octree_query_check(const octree_query *query)
{
    if (!query)
        return OCTREE_NULL_ARGUMENT;
    const octree_query_traits *about = octree_query_about(query->kind);
    if (!about)
        return OCTREE_BAD_OPTION;
    const bool has_target = about->members & OCTREE_QUERY_HAS_TARGET;
    if (query->skip == OCTREE_SKIP_COINCIDENT && !has_target)
        return OCTREE_BAD_OPTION;
    octree_status status = check_search(&(octree_search){.skip = query->skip, .epsilon = query->epsilon});
    if (status == OCTREE_OK && about->members & OCTREE_QUERY_HAS_RADIUS)
        status = check_length(query->radius);
    if (status == OCTREE_OK && about->members & OCTREE_QUERY_HAS_BOX)
        status = check_box(&query->box);
    if (status == OCTREE_OK && has_target && !query->at_player)
        status = check_finite(query->target);
    if (status == OCTREE_OK && query_is_judged(query))
        status = check_answer(query);
    for (int met = 0; status == OCTREE_OK && met < OCTREE_MET_KINDS; met++)
        status = check_met(&query->met[met]);
    return status;
}

/* ---- Asking ------------------------------------------------------------------------------------------------- */

bool collect_point(const octree_point *point, void *context)
{
    point_collector *c = context;
    c->failed = !list_push(c->memory, c->points, point, sizeof *point);
    return !c->failed;
}

void sort_points(list *points, size_t first)
{
    if (points->count > first)
        qsort((octree_point *)points->items + first, points->count - first, sizeof(octree_point),
              octree_compare_points);
}

/* A tree that is asked, and the lists that what it finds is appended to. */
typedef struct asking {
    const octree *tree;
    octree_search how;
    point_collector points;
    list *neighbors;
    const octree_answer *asked;
} asking;

/* A visitor that appends the points that the query does not skip. */
static bool keep_point(const octree_point *point, void *context)
{
    asking *a = context;
    const octree_answer *asked = a->asked;
    const bool skipped = (asked->skip == OCTREE_SKIP_ID && point->id == asked->skip_id) ||
                         (asked->skip == OCTREE_SKIP_COINCIDENT && same_position(point->position, asked->target));
    return skipped || collect_point(point, &a->points);
}

static octree_status ask_range(asking *a, octree_answer *answer)
{
    return octree_range_search(a->tree, &answer->box, &a->how, keep_point, a);
}

static octree_status ask_radius(asking *a, octree_answer *answer)
{
    return octree_radius(a->tree, answer->target, answer->radius, &a->how, keep_point, a);
}

static octree_status ask_knearest(asking *a, octree_answer *answer)
{
    const size_t first = a->neighbors->count, all = octree_count(a->tree);
    const size_t k = answer->k < all ? answer->k : all;
    while (a->neighbors->count < first + k)
        if (!list_append(a->points.memory, a->neighbors, sizeof(octree_neighbor)))
            return OCTREE_NO_MEMORY;
    octree_neighbor *neighbors = k ? (octree_neighbor *)a->neighbors->items + first : NULL;
    size_t found;
    const octree_status status = octree_nearest_k(a->tree, answer->target, k, &a->how, neighbors, &found);
    a->neighbors->count = first + found;
    return status;
}

static octree_status ask_nearest(asking *a, octree_answer *answer)
{
    answer->k = 1;
    return ask_knearest(a, answer);
}

/* What is asked, in world coordinates. */
static octree_answer pose(const octree_query *query, const double player[3])
{
    octree_answer answer = {.kind = query->kind,
                            .box = query->box,
                            .k = query->k,
                            .radius = query->radius,
                            .skip = query->skip,
                            .skip_id = query->skip_id,
                            .epsilon = query->epsilon,
                            .precision = query_is_judged(query) ? query->precision : OCTREE_DOUBLES};
    memcpy(answer.target, query->at_player ? player : query->target, sizeof answer.target);
    for (int i = 0; query->at_player && i < 3; i++) {
        answer.box.min[i] += player[i];
        answer.box.max[i] += player[i];
    }
    return answer;
}

/* The answer says how many were appended to which list; its pointers are still null. */
static octree_status ask(asking *a, const octree_query *query, const double player[3], octree_answer *answer)
{
#define ASK(kind, name, members, named_by, neighbors, words) ask_##name,
    static octree_status (*const functions[])(asking *, octree_answer *) = {OCTREE_QUERY_MAP(ASK)};
#undef ASK
    const bool neighbors = octree_query_about(query->kind)->neighbors;
    const list *found = neighbors ? a->neighbors : a->points.points;
    const size_t first = found->count;
    *answer = pose(query, player);
    a->asked = answer;
    a->how.cost = &answer->cost;
    if (query->skip != OCTREE_SKIP_NONE) {
        a->how.skip = query->skip;
        a->how.skip_id = query->skip_id;
    }
    if (query_is_judged(query))
        a->how.epsilon = 0; /* it is the program's, which is judged by the truth */
    else if (query->epsilon > 0)
        a->how.epsilon = query->epsilon;
    octree_status status = functions[query->kind](a, answer);
    if (a->points.failed)
        status = OCTREE_NO_MEMORY;
    answer->count = found->count - first;
    if (status == OCTREE_OK && !neighbors)
        sort_points(a->points.points, first);
    return status;
}

/* ---- Outside of a game -------------------------------------------------------------------------------------- */

/* The items of a list in a block of just their size; null for none, and when there is no memory. */
static void *take_items(arena *memory, list *l, size_t item_size)
{
    void *items = l->count ? arena_take(memory, l->count * item_size) : NULL;
    if (items)
        memcpy(items, l->items, l->count * item_size);
    list_release(memory, l, item_size);
    return items;
}

octree_status octree_query_answer(const octree *tree, const octree_query *query, const double player[3],
                                  const octree_search *how, octree_answer *answer)
{
    if (!answer)
        return OCTREE_NULL_ARGUMENT;
    *answer = (octree_answer){0};
    octree_status status = tree ? octree_query_check(query) : OCTREE_NULL_ARGUMENT;
    if (status == OCTREE_OK && query->at_player && !player)
        status = OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return status;
    arena memory = {.allocator = tree->def.allocator};
    list points = {0}, neighbors = {0};
    asking a = {tree, search_or_default(how), {&memory, &points, false}, &neighbors, NULL};
    octree_answer made;
    status = ask(&a, query, player, &made);
    made.points = take_items(&memory, &points, sizeof(octree_point));
    made.neighbors = take_items(&memory, &neighbors, sizeof(octree_neighbor));
    if (status == OCTREE_OK && made.count && !made.points && !made.neighbors)
        status = OCTREE_NO_MEMORY;
    if (status == OCTREE_OK)
        *answer = made;
    else
        octree_answer_release(tree, &made);
    return status;
}

void octree_answer_release(const octree *tree, octree_answer *answer)
{
    if (!tree || !answer)
        return;
    arena memory = {.allocator = tree->def.allocator};
    arena_give(&memory, (void *)answer->points, answer->count * sizeof *answer->points);
    arena_give(&memory, (void *)answer->neighbors, answer->count * sizeof *answer->neighbors);
    *answer = (octree_answer){0};
}

/* ---- The queries of a tick ---------------------------------------------------------------------------------- */

/* What a program says of an answer of its own, of which our own is the last. */
static octree_status judge_program(octree_game *game, const octree_query *query, const octree_search *how,
                                   size_t points, size_t neighbors)
{
    octree_answer *answer = (octree_answer *)game->answers.items + game->answers.count - 1;
    const bool near = octree_query_about(query->kind)->neighbors, none = answer->count == 0;
    const judging j = {.game = game,
                       .query = query,
                       .answer = answer,
                       .points = near || none ? NULL : (const octree_point *)game->found.items + points,
                       .neighbors = near && !none ? (const octree_neighbor *)game->near.items + neighbors : NULL,
                       .skip = near ? how->skip : query->skip,
                       .skip_id = near ? how->skip_id : query->skip_id};
    game->tick.judged |= query->answered;
    octree_status status = query->answered ? judge(&j, &answer->judgement) : OCTREE_OK;
    if (answer->judgement.fault)
        game->tick.events |= OCTREE_EVENT_WRONG;
    return status == OCTREE_OK ? foreign_meet(&j) : status;
}

static octree_status ask_in_game(octree_game *game, const octree_query *query, bool by_key)
{
    if (query->at_player && !game->tick.has_player)
        return OCTREE_OK;
    octree_answer *answer = list_append(&game->memory, &game->answers, sizeof *answer);
    if (!answer)
        return OCTREE_NO_MEMORY;
    asking a = {game->tree, game_search(game, NULL), {&game->memory, &game->found, false}, &game->near, NULL};
    a.how.skip = query->at_player ? OCTREE_SKIP_ID : OCTREE_SKIP_NONE;
    a.how.skip_id = game->session->player.id;
    const size_t points = game->found.count, neighbors = game->near.count;
    const octree_status status = ask(&a, query, game->tick.player, answer);
    answer->by_key = by_key;
    game->tick.asked |= 1u << query->kind;
    return status == OCTREE_OK ? judge_program(game, query, &a.how, points, neighbors) : status;
}

octree_status game_ask(octree_game *game, const octree_query *queries, size_t count)
{
    octree_status status = OCTREE_OK;
    for (size_t i = 0; status == OCTREE_OK && i < count; i++)
        status = ask_in_game(game, &queries[i], false);
    return status;
}

octree_status game_ask_by_key(octree_game *game)
{
    const octree_query nearest = {.kind = OCTREE_QUERY_NEAREST, .at_player = true};
    return game->tick.key == 'n' ? ask_in_game(game, &nearest, true) : OCTREE_OK;
}

/* Point each answer to its part of the lists, which do not grow any more. */
static void assign_results(octree_game *game)
{
    const octree_point *points = game->found.items;
    const octree_neighbor *neighbors = game->near.items;
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
    judge_assign(game);
}

/* ---- What a tick's searches met ----------------------------------------------------------------------------- */

static void note_visit(octree_address node, octree_touch touch, void *context)
{
    octree_game *game = context;
    const octree_visit visit = {node, touch, touch == OCTREE_TOUCH_TAKEN};
    game->lost_visits |= !list_push(&game->memory, &game->visits, &visit, sizeof visit);
}

octree_search game_search(octree_game *game, octree_cost *cost)
{
    return (octree_search){.cost = cost, .trace = note_visit, .trace_context = game};
}

/* By node, and of one node the strongest touch first. */
static int compare_visits(const void *a, const void *b)
{
    static const int weakness[OCTREE_TOUCH_KINDS] = {
        [OCTREE_TOUCH_VISITED] = 0, [OCTREE_TOUCH_TAKEN] = 1, [OCTREE_TOUCH_PRUNED] = 2};
    const octree_visit *p = a, *q = b;
    return p->node == q->node ? weakness[p->touch] - weakness[q->touch] : address_compare(&p->node, &q->node);
}

static void sort_visits(octree_game *game)
{
    octree_tick *tick = &game->tick;
    octree_visit *visits = game->visits.items;
    size_t kept = 0;
    if (game->visits.count > 1)
        qsort(visits, game->visits.count, sizeof *visits, compare_visits);
    for (int touch = 0; touch < OCTREE_TOUCH_KINDS; touch++)
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

static bool add_leaf_of(octree_game *game, const octree_point *point)
{
    const uint64_t code = morton_code(game->tree->axes, point->position);
    const octree_address leaf = morton_address(code, path_to(game->tree, code).depth);
    return list_push(&game->memory, &game->hit_leaves, &leaf, sizeof leaf);
}

static bool add_leaves(octree_game *game)
{
    const octree_point *hits = game->hits.items, *found = game->found.items;
    const octree_neighbor *near = game->near.items;
    bool ok = true;
    for (size_t i = 0; ok && i < game->hits.count; i++)
        ok = add_leaf_of(game, &hits[i]);
    for (size_t i = 0; ok && i < game->found.count; i++)
        ok = add_leaf_of(game, &found[i]);
    for (size_t i = 0; ok && i < game->near.count; i++)
        ok = add_leaf_of(game, &near[i].point);
    return ok;
}

static void sort_leaves(octree_game *game)
{
    octree_address *leaves = game->hit_leaves.items;
    size_t kept = 0;
    if (game->hit_leaves.count > 1)
        qsort(leaves, game->hit_leaves.count, sizeof *leaves, address_compare);
    for (size_t i = 0; i < game->hit_leaves.count; i++)
        if (kept == 0 || leaves[i] != leaves[kept - 1])
            leaves[kept++] = leaves[i];
    game->hit_leaves.count = kept;
}

octree_status game_finish_asking(octree_game *game)
{
    if (game->lost_visits || !add_leaves(game))
        return OCTREE_NO_MEMORY;
    assign_results(game);
    sort_visits(game);
    sort_leaves(game);
    return OCTREE_OK;
}
