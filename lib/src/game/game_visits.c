/* game_visits.c - what a tick's questions met: the collision test's and the queries' nodes, and the leaves of what was
 * found.
 */
#include "game_state.h"
#include "tree.h"

#include <stdlib.h>

static void note_visit(octree_address node, octree_touch touch, void *context)
{
    octree_game *game = context;
    octree_visit *visit = list_append(&game->memory, &game->visits, sizeof *visit);
    if (visit)
        *visit = (octree_visit){node, touch, touch == OCTREE_TOUCH_TAKEN};
    else
        game->lost_visits = true;
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
    tick->visits = visits;
    tick->visit_count = game->visits.count = kept;
}

static bool add_leaf_of(octree_game *game, const octree_point *point)
{
    const uint64_t code = morton_code(game->tree->axes, point->position);
    octree_address *leaf = list_append(&game->memory, &game->hit_leaves, sizeof *leaf);
    if (leaf)
        *leaf = morton_address(code, path_to(game->tree, code).depth);
    return leaf != NULL;
}

static bool add_leaves(octree_game *game)
{
    const octree_tick *tick = &game->tick;
    bool ok = true;
    for (size_t i = 0; ok && i < tick->hit_count; i++)
        ok = add_leaf_of(game, &tick->hits[i]);
    for (size_t a = 0; ok && a < tick->answer_count; a++) {
        const octree_answer *answer = &tick->answers[a];
        for (size_t i = 0; ok && i < answer->count; i++)
            ok = add_leaf_of(game, answer->points ? &answer->points[i] : &answer->neighbors[i].point);
    }
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
    game->tick.hit_leaves = leaves;
    game->tick.hit_leaf_count = game->hit_leaves.count = kept;
}

octree_status game_finish_visits(octree_game *game)
{
    if (game->lost_visits || !add_leaves(game))
        return OCTREE_NO_MEMORY;
    sort_visits(game);
    sort_leaves(game);
    return OCTREE_OK;
}
