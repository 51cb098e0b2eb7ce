/* SPDX-License-Identifier: MIT */
/* game_state.h - a game's insides, which its files share. Private. */
#ifndef OCTREE_GAME_STATE_H
#define OCTREE_GAME_STATE_H

#include "bodies.h"
#include "foreign.h"
#include "judge.h"
#include "tree_summary.h"

/* The lists that a tick shows: as in octree_tick, their counts there, and their items. */
#define GAME_SHOWN_LISTS(X)                                                                                            \
    X(hits, hit_count, octree_point)                                                                                   \
    X(refusals, refusal_count, octree_refusal)                                                                         \
    X(splits, split_count, octree_address)                                                                             \
    X(merges, merge_count, octree_address)                                                                             \
    X(answers, answer_count, octree_answer)                                                                            \
    X(visits, visit_count, octree_visit)                                                                               \
    X(hit_leaves, hit_leaf_count, octree_address)                                                                      \
    X(shapes, shape_count, octree_shape)                                                                               \
    X(movers, mover_count, octree_body)

/* And those after them: where each hit was, when swept; the points and the neighbours of all answers; of those that are
 * judged the ids given, and the points missed and extra, and room for judging one. */
#define GAME_LISTS(X)                                                                                                  \
    GAME_SHOWN_LISTS(X)                                                                                                \
    X(hit_from, none, double[3])                                                                                       \
    X(found, none, octree_point)                                                                                       \
    X(near, none, octree_neighbor)                                                                                     \
    X(given, none, uint64_t)                                                                                           \
    X(accused, none, octree_point)                                                                                     \
    X(named, none, judged_point)                                                                                       \
    X(truth, none, judged_point)

struct octree_game {
    const octree_session *session;
    octree *tree;
    arena memory;
    bodies bodies;
    int64_t steps[3]; /* the player's net steps on each axis: its place is computed from them */
    double fastest;   /* of the session's bodies, along one axis */
    bool quit;
    bool lost_visits; /* there was no memory for one of them */
    tree_summary summary;
    foreign foreign;
    octree_tick tick;
    char gap[OCTREE_GAP_TEXT]; /* of the tick, where it is one */
#define LIST(name, shown_count, type) list name;
    GAME_LISTS(LIST)
#undef LIST
};

#endif
