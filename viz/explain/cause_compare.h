/* SPDX-License-Identifier: MIT */
/* cause_compare.h - compares two sessions, two views or two ticks and collects the differences as facts.
 *
 * The two things to compare are written as JSON objects, which are compared member by member. If memory runs out,
 * facts->out_of_memory is set.
 */
#ifndef EXPLAIN_CAUSE_COMPARE_H
#define EXPLAIN_CAUSE_COMPARE_H

#include "cause_facts.h"
#include "octree/game.h"
#include "session_file.h"
#include "view.h"

/* Where two values are compared: their path, their query and their tick. `facts` receives the differences. */
typedef struct cause_place {
    cause_facts *facts;
    const char *where; /* the path of both values; "" for the outermost object */
    const char *query; /* if the values belong to an answer, the name of its query; else "" */
    uint64_t tick;     /* the tick to which the values belong, or CAUSE_NO_TICK */
    bool exact;        /* true: 0 and -0 are different values */
} cause_place;

/* Return whether two values are equal. A null pointer stands for a missing value. With `exact`, 0 and -0 differ;
 * json_equal() treats them as equal. */
bool cause_values_are_equal(const json_t *a, const json_t *b, bool exact);

/* Compare two objects member by member; a null pointer stands for an empty object. Nested objects are also compared
 * member by member, but a box is compared as one value. The elements of two lists are paired by key if they have a
 * key: an id, a word, or an action with an id. Elements without a key are paired by similarity (cause_pairs.h). */
void cause_compare_members(const cause_place *place, json_t *a, json_t *b);

/* Compare two sessions. Members that the session's kind of player does not use are skipped. Cost: the time to write
 * both sessions as JSON and to sort their points. */
void cause_compare_sessions(const session_file *a, const session_file *b, cause_facts *facts);

/* Compare the colours, intensities and classes of the points that both sessions have. cause_compare_sessions() calls
 * this function. */
void cause_compare_values(const session_file *a, const session_file *b, cause_facts *facts);

/* Points in ascending order of their ids. Each id occurs once. */
typedef struct cause_points {
    octree_point *points;
    size_t count;
} cause_points;

/* Compare two lists of points by id. Add a fact at the place `where` for each point that only one list has, or whose
 * positions differ. With `exact`, 0 and -0 differ. Cost: O(n). */
void cause_compare_points(cause_facts *facts, const char *where, const cause_points *a, const cause_points *b,
                          bool exact);

/* The view with which a session is drawn, and the interval of its frames. */
typedef struct cause_view {
    view view;
    uint64_t every; /* the number of ticks from one frame to the next */
} cause_view;

/* Compare every option of two views. The values derived from options and session are compared only if options and
 * sessions are equal. Such derived values can still differ, because --camera-from copies derived values of another
 * session. */
void cause_compare_views(const cause_view *a, const cause_view *b, bool same_session, cause_facts *facts);

/* Compare the nodes and points of the trees of two games. The player's point is skipped, because
 * cause_compare_ticks() compares it. Nodes are compared only if both trees have the same world. If a node differs,
 * the nodes below it are not reported. Cost: a walk over both trees and a sort of the points. */
void cause_compare_trees(const octree_game *a, const octree_game *b, cause_facts *facts);

/* Compare the current ticks of two games. Differences that cause_compare_trees() reports are left out. */
void cause_compare_ticks(const octree_game *a, const octree_game *b, cause_facts *facts);

#endif
