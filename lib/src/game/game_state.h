/* SPDX-License-Identifier: MIT */
/* game_state.h - the struct octree_game, whose members all files of lib/src/game use. Private. */
#ifndef OCTREE_GAME_STATE_H
#define OCTREE_GAME_STATE_H

#include "game_bodies.h"
#include "../audit/foreign.h"
#include "tree_summary.h"

/* The lists to which octree_tick points. Each row has the name of the list here and in octree_tick, the member of
 * octree_tick that has the number of its items, and the type of its items. */
#define GAME_SHOWN_LISTS(X)                                                                                            \
    X(hits, hit_count, octree_point)                                                                                   \
    X(refusals, refusal_count, octree_refusal)                                                                         \
    X(splits, split_count, octree_address)                                                                             \
    X(merges, merge_count, octree_address)                                                                             \
    X(answers, answer_count, octree_answer)                                                                            \
    X(visits, visit_count, octree_visit)                                                                               \
    X(hit_leaves, hit_leaf_count, octree_address)                                                                      \
    X(shapes, shape_count, octree_shape)                                                                               \
    X(movers, mover_count, octree_game_body)                                                                           \
    X(pairs, pair_count, octree_pair)

/* All lists that are emptied at the start of a tick: GAME_SHOWN_LISTS; hit_from, the positions of the hits before the
 * tick (only with swept collisions); the points and neighbours of all answers; and the lists of the judgement of
 * foreign pairs. */
#define GAME_LISTS(X)                                                                                                  \
    GAME_SHOWN_LISTS(X)                                                                                                \
    X(hit_from, none, double[3])                                                                                       \
    X(found_points, none, octree_point)                                                                                \
    X(found_neighbors, none, octree_neighbor)                                                                          \
    X(given_pairs, none, octree_pair)                                                                                  \
    X(missing_pairs, none, octree_pair)                                                                                \
    X(extra_pairs, none, octree_pair)

struct octree_game {
    const octree_session *session;
    octree *tree;
    arena memory;
    bodies bodies;
    octree_bodies shown; /* the points of the tree as bodies with their half extents, see extent.h */
    /* On each axis, the number of steps that the player made upwards minus the number of steps downwards. These numbers
     * determine the player's position. */
    int64_t steps[3];
    double fastest; /* the largest initial speed of the session's bodies along one axis */
    bool quit;
    bool out_of_memory; /* true: a visitor or tracer ran out of memory, so a hit or a node is missing */
    tree_summary summary;
    foreign foreign;
    judge judge;
    octree_tick tick;
    char gap[OCTREE_GAP_TEXT]; /* the reason of the gap, if the tick is a gap */
#define LIST(name, shown_count, type) list name;
    GAME_LISTS(LIST)
#undef LIST
};

/* Returns whether an id is that of the player that keys move; this player is no body. */
static inline bool is_players_id(const octree_game *game, uint64_t id)
{
    return game->session->player.kind == OCTREE_PLAYER_KEYS && id == game->session->player.id;
}

/* The points of the game after the changes of the tick. Foreign answers and foreign nodes are checked against these
 * points. */
audited_points game_audited_points(const octree_game *game);

#endif
