/* SPDX-License-Identifier: MIT */
/* extent.c - the bodies of a game as boxes.
 *
 * A game has one tree, that of the positions, whatever the sizes of the bodies: frames draw it, and a session of points
 * must have the same nodes as ever. So the bodies are not a set of their own with a level for each size (bodies.h), but
 * one level above the game's tree, whose reach are the largest half extents of the game. A single large body makes all
 * queries visit more nodes, which is what the frames then show.
 */
#include "extent.h"
#include "../audit/judge_pairs.h"
#include "motion.h"

#include <stdlib.h>

/* A half_lookup. The player that keys move is no body, and has no extent. */
static void find_half_extents(const void *context, const octree_point *point, double half[3])
{
    const octree_game *game = context;
    const moving_body *body = game->bodies.extended ? bodies_find(&game->bodies, point->id) : NULL;
    static const double none[3] = {0, 0, 0};
    memcpy(half, body ? body->half : none, sizeof(double[3]));
}

void game_show_bodies(octree_game *game)
{
    game->shown = show_points_as_bodies(game->tree, (double[3]){0, 0, 0});
    game_update_reach(game);
}

void game_update_reach(octree_game *game)
{
    bodies *b = &game->bodies;
    for (int axis = 0; b->reach_stale && axis < 3; axis++) {
        b->reach[axis] = 0;
        for (size_t i = 0; i < b->items.count; i++)
            b->reach[axis] = fmax(b->reach[axis], bodies_items(b)[i].half[axis]);
    }
    b->reach_stale = false;
    set_half_extents(&game->shown, b->reach, find_half_extents, game);
}

/* ---- Pairs -------------------------------------------------------------------------------------------------- */

/* An octree_pair_visitor that lists a pair. Within a set, `a` is the body of the lower id. */
static bool list_pair(const octree_body *a, const octree_body *b, void *context)
{
    octree_game *game = context;
    const octree_pair pair = {a->id, b->id};
    if (!is_players_id(game, a->id) && !is_players_id(game, b->id))
        game->out_of_memory |= !list_push(&game->memory, &game->pairs, &pair, sizeof pair);
    return !game->out_of_memory;
}

/* Judge the pairs of a foreign index by the exact pairs, which game->pairs lists. Returns false if memory runs out. */
static bool judge_foreign_pairs(octree_game *game, const octree_foreign_pairs *given)
{
    const audited_points points = game_audited_points(game);
    const pair_lists lists = {&game->memory, &game->given_pairs, &game->missing_pairs, &game->extra_pairs};
    if (!judge_pairs(&lists, &points, given, &game->pairs, &game->tick.foreign_pairs))
        return false;
    game->tick.judged = true;
    if (game->tick.foreign_pairs.wrong)
        game->tick.events |= OCTREE_EVENT_WRONG;
    return true;
}

bool game_list_pairs(octree_game *game, const octree_foreign_pairs *given)
{
    game->pairs.count = 0;
    if (!game->session->pairs && !given)
        return true;
    game_update_reach(game);
    if (octree_bodies_pairs(&game->shown, NULL, list_pair, game) != OCTREE_OK || game->out_of_memory)
        return false;
    list_sort(&game->pairs, sizeof(octree_pair), compare_pairs);
    if (given && !judge_foreign_pairs(game, given))
        return false;
    if (!game->session->pairs)
        game->pairs.count = 0;
    else if (game->pairs.count)
        game->tick.events |= OCTREE_EVENT_OVERLAPPED;
    return true;
}
