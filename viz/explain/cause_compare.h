/* SPDX-License-Identifier: MIT */
/* cause_compare.h - two objects of JSON are compared member by member; two sessions, two views and two ticks are
 * compared as the objects that are written of them. Each adds facts; where there is no memory for it
 * facts->out_of_memory is set.
 */
#ifndef EXPLAIN_CAUSE_COMPARE_H
#define EXPLAIN_CAUSE_COMPARE_H

#include "cause_facts.h"
#include "octree/game.h"
#include "session_file.h"
#include "view.h"

/* How two values are compared, and where they are. */
typedef struct cause_place {
    cause_facts *facts;
    const char *where; /* the path of the object that holds them; "": it is the outermost */
    const char *query; /* of an answer; else "" */
    uint64_t tick;     /* or CAUSE_NO_TICK */
    bool exact;        /* the sign of zero counts */
} cause_place;

/* Whether two values, which may be null for none, are the same. json_equal() takes 0 and -0 for equal; where `exact`
 * they differ, as their texts do. */
bool cause_same(const json_t *a, const json_t *b, bool exact);

/* Compare objects, null for empty ones. Objects are descended into, but for boxes, which are values. Of lists whose
 * elements have a key - an id, a word, or what is done to which id - those of the same key are compared; of other lists
 * those that ask or show the same or most nearly the same (cause_pairs.h). */
void cause_compare_members(const cause_place *place, json_t *a, json_t *b);

/* All that a session holds and its kind of player reads. Cost: that of writing both, and a sort of the points. */
void cause_compare_sessions(const session_file *a, const session_file *b, cause_facts *facts);

/* The part of that in cause_values.c: the values of the points that both ever have. */
void cause_compare_values(const session_file *a, const session_file *b, cause_facts *facts);

/* Points in ascending order of their ids, which are unique. */
typedef struct cause_points {
    octree_point *points;
    size_t count;
} cause_points;

void cause_compare_points(cause_facts *facts, const char *where, const cause_points *a, const cause_points *b,
                          bool exact);

/* What belongs to a recording and not to its session: the view, and each how many ticks there is a frame. */
typedef struct cause_view {
    view view;
    uint64_t every;
} cause_view;

/* Compare every option. Derived values follow from the options and the session: they are compared only if both are the
 * same, which happens if --camera-from has copied those of another session. */
void cause_compare_views(const cause_view *a, const cause_view *b, bool same_session, cause_facts *facts);

/* Nodes and points of the trees of two games, except the player, which is compared with the tick; of trees in different
 * worlds only the points. Nodes below one that split or merged are not reported. Cost: a sort of the
 * points. */
void cause_compare_trees(const octree_game *a, const octree_game *b, cause_facts *facts);

/* All facts of the games' current ticks, except what cause_compare_trees() reports. */
void cause_compare_ticks(const octree_game *a, const octree_game *b, cause_facts *facts);

#endif
