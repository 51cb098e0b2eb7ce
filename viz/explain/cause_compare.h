/* SPDX-License-Identifier: MIT */
/* cause_compare.h - compares two sessions, two views or two ticks and collects the differences as facts.
 *
 * Each is compared in its written form, as JSON, member by member. If memory runs out, facts->out_of_memory is set.
 */
#ifndef EXPLAIN_CAUSE_COMPARE_H
#define EXPLAIN_CAUSE_COMPARE_H

#include "cause_facts.h"
#include "octree/game.h"
#include "session_file.h"
#include "view.h"

/* The place of two values that are compared. */
typedef struct cause_place {
    cause_facts *facts;
    const char *where; /* their path; "" for the outermost object */
    const char *query; /* the name of the query whose answer they belong to; else "" */
    uint64_t tick;     /* the tick to which the values belong, or CAUSE_NO_TICK */
    bool exact;        /* 0 and -0 differ */
} cause_place;

/* Whether two values are equal; null stands for a missing value. If `exact`, 0 and -0 differ, which json_equal() takes
 * for equal. */
bool cause_is_equal(const json_t *a, const json_t *b, bool exact);

/* Compare two objects; null is an empty object. Recurses into objects, except boxes, which are compared as one value.
 * Elements of lists are paired by key, if they have one: an id, a word, or an action with an id. Other elements are
 * paired by similarity (cause_pairs.h). */
void cause_compare_members(const cause_place *place, json_t *a, json_t *b);

/* Compare two sessions, except for members that their kind of player does not use. Cost: writing both sessions and
 * sorting their points. */
void cause_compare_sessions(const session_file *a, const session_file *b, cause_facts *facts);

/* The part of cause_compare_sessions() in cause_values.c: colours, intensities and classes of points that occur in both
 * sessions. */
void cause_compare_values(const session_file *a, const session_file *b, cause_facts *facts);

/* Points in ascending order of their ids, which are unique. */
typedef struct cause_points {
    octree_point *points;
    size_t count;
} cause_points;

void cause_compare_points(cause_facts *facts, const char *where, const cause_points *a, const cause_points *b,
                          bool exact);

/* How a session is drawn. */
typedef struct cause_view {
    view view;
    uint64_t every; /* the interval of frames, in ticks */
} cause_view;

/* Compare every option. Derived values follow from the options and the session: they are compared only if both are the
 * same, which happens if --camera-from has copied those of another session. */
void cause_compare_views(const cause_view *a, const cause_view *b, bool same_session, cause_facts *facts);

/* Compare the nodes and points of two games' trees. The player is left out: cause_compare_ticks() compares it. Nodes of
 * trees with different worlds are not compared. Below a node in which the trees differ nothing is reported. Cost: a
 * sort of the points. */
void cause_compare_trees(const octree_game *a, const octree_game *b, cause_facts *facts);

/* Compare the games' current ticks, except for what cause_compare_trees() reports. */
void cause_compare_ticks(const octree_game *a, const octree_game *b, cause_facts *facts);

#endif
