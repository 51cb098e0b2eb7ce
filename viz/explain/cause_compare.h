/* cause_compare.h - two sessions, two views, two trees, two ticks: in what they differ. Each adds facts; nothing is
 * read or drawn. Where there is no memory for it facts->out_of_memory is set.
 */
#ifndef DIFF_CAUSE_COMPARE_H
#define DIFF_CAUSE_COMPARE_H

#include "cause_facts.h"
#include "view.h"

/* All that a session holds and its kind of player reads: the options first, then points at the start, keys, edits,
 * queries and shapes. Cost: a sort of points and of edits. */
void cause_compare_sessions(const octree_session *a, const octree_session *b, cause_facts *facts);

/* What belongs to a recording and not to its session: the view, and each how many ticks there is a frame. */
typedef struct cause_look {
    view view;
    uint64_t every;
} cause_look;

void cause_compare_looks(const cause_look *a, const cause_look *b, cause_facts *facts);

/* Nodes and points of the trees of two games, but the player, which the tick tells; of trees in unlike worlds the
 * worlds, and points. Nodes that are there because one above them split are not told one by one. Cost: a sort of the
 * points. */
void cause_compare_trees(const octree_game *a, const octree_game *b, cause_facts *facts);

/* All that the ticks say at which two games are. What their trees tell is not told twice. */
void cause_compare_ticks(const octree_game *a, const octree_game *b, cause_facts *facts);

#endif
