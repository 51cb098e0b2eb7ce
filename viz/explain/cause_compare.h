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

/* The place at which two values are compared, and where facts about them go. */
typedef struct cause_place {
    cause_facts *facts;
    const char *where; /* the path of both values; "" for the outermost object */
    const char *query; /* the name of the query to whose answer the values belong; else "" */
    uint64_t tick;     /* the tick to which the values belong, or CAUSE_NO_TICK */
    bool exact;        /* 0 and -0 are treated as different */
} cause_place;

/* Return whether two values are equal. A null pointer stands for a missing value. With `exact`, 0 and -0 differ;
 * json_equal() treats them as equal. */
bool cause_is_equal(const json_t *a, const json_t *b, bool exact);

/* Compare two objects; a null pointer stands for an empty object. Objects within them are compared member by member,
 * but a box is compared as one value. Elements of lists are paired by key if they have one: an id, a word, or an
 * action with an id. Other elements are paired by similarity (cause_pairs.h). */
void cause_compare_members(const cause_place *place, json_t *a, json_t *b);

/* Compare two sessions. Members that the session's kind of player does not use are skipped. Cost: writing both
 * sessions and sorting their points. */
void cause_compare_sessions(const session_file *a, const session_file *b, cause_facts *facts);

/* Compare the colours, intensities and classes of the points that both sessions have. cause_compare_sessions() calls
 * this function. */
void cause_compare_values(const session_file *a, const session_file *b, cause_facts *facts);

/* Points in ascending order of their ids. Each id occurs once. */
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

/* Compare every option of two views. The derived values follow from the options and the session. They are compared
 * only if options and session are equal; they can still differ then, because --camera-from copies derived values of
 * another session. */
void cause_compare_views(const cause_view *a, const cause_view *b, bool same_session, cause_facts *facts);

/* Compare the nodes and points of two games' trees. The player's point is left out, because cause_compare_ticks()
 * compares it. Nodes are compared only if both trees have the same world. Below a node in which the trees differ,
 * nothing is reported. Cost: a sort of the points. */
void cause_compare_trees(const octree_game *a, const octree_game *b, cause_facts *facts);

/* Compare the games' current ticks. Differences that cause_compare_trees() reports are left out. */
void cause_compare_ticks(const octree_game *a, const octree_game *b, cause_facts *facts);

#endif
