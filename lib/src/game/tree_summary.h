/* survey.h - what a game tells of its tree after each tick: its digest, its numbers, and its inner nodes. Private.
 *
 * A tick touches few places, and all that it changes lies on the way from the root to them. So the tree is seen as
 * parts, subtrees of a few hundred points, and the nodes above them; what is known of a part stays, unless a place in
 * its cell was touched.
 */
#ifndef OCTREE_SURVEY_H
#define OCTREE_SURVEY_H

#include "pool.h"
#include "tree.h"

typedef struct survey {
    bool known; /* of the tree at this version, with this capacity */
    uint64_t version;
    size_t capacity;
    list touched;             /* uint64_t: Morton codes of the places since then */
    list parts, parts_before; /* private to survey.c; in pre-order */
    list inner, inner_before; /* octree_address: the inner nodes, in pre-order */
    octree_stats stats;
    uint64_t digest;
} survey;

/* A point came to a place, or went from it. What cannot be noted makes the next survey a whole one. */
void survey_touch(survey *s, arena *memory, const octree *tree, const double place[3]);

/* Look at what has changed. The lists of before are then those of the last call. NO_MEMORY, after which nothing is
 * known, or OK. Cost: O(parts + nodes and points of those that were touched). */
octree_status survey_update(survey *s, arena *memory, const octree *tree);

void survey_release(survey *s, arena *memory);

#endif
