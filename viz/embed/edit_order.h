/* SPDX-License-Identifier: MIT */
/* edit_order.h - turns the changes of a tick into edits of a session. Private to this folder. */
#ifndef EMBED_EDIT_ORDER_H
#define EMBED_EDIT_ORDER_H

#include "batch.h"

/* A tick's edits, in an order in which the tree accepts each of them.
 *
 * If leaves grow, any order works. If a full leaf refuses points, a point must leave a leaf before another enters it.
 * Therefore moves that find no room are tried again after the others. Moves that still find none, such as of points
 * that exchange places, become a removal and an insertion; a player among them is swept from its new position.
 *
 * A point outside the world is in no tree. Moving across the world's bounds becomes a removal and an insertion, of
 * which the game refuses the part outside. */
typedef struct edit_order {
    octree_box world;
    octree *tree; /* under OCTREE_REFUSE the tree after the edits so far, else null */
    octree_edit *edits;
    size_t count;
    size_t *waiting; /* indices of changes that found no room */
    size_t waiting_count;
    size_t room; /* capacity of the arrays in changes */
} edit_order;

/* Start with the insertions of a batch in a tree of this definition. False if out of memory. */
bool edit_order_init(edit_order *o, const octree_def *def, const batch *first);
void edit_order_release(edit_order *o);

/* Set o->edits to the edits of a batch at a tick. False if out of memory. */
bool edit_order_make(edit_order *o, const batch *b, uint64_t tick);

#endif
