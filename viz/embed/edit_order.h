/* SPDX-License-Identifier: MIT */
/* edit_order.h - turns the changes of a tick into edits of a session. Private to viz/embed. */
#ifndef EMBED_EDIT_ORDER_H
#define EMBED_EDIT_ORDER_H

#include "batch.h"

/* The edits of a tick, in an order in which the tree accepts each edit.
 *
 * If leaves grow, any order works. If full leaves refuse points, a point must leave a leaf before another point enters
 * it. Moves that find no room are therefore tried again after all other moves. If a move still finds no room, for
 * example because two points exchange places, it becomes a removal and an insertion. A player that is moved in this way
 * is swept from its new position.
 *
 * A point outside the world is in no tree. A move across the world's bounds becomes a removal and an insertion, and the
 * game refuses the one that is outside. */
typedef struct edit_order {
    octree_box world;
    octree *tree; /* under OCTREE_REFUSE, a tree to which the edits so far were applied; else null */
    octree_edit *edits;
    size_t count;
    size_t *waiting; /* indices of changes that found no room in a full leaf */
    size_t waiting_count;
    size_t room; /* number of changes for which the arrays have room */
} edit_order;

/* Initialize *o. Under OCTREE_REFUSE a tree is made, and the points that the batch inserts are inserted into it.
 * Returns false if memory runs out. */
bool edit_order_init(edit_order *o, const octree_def *def, const batch *first);
void edit_order_release(edit_order *o);

/* Set o->edits to the edits that make the changes of a batch at a tick. Returns false if memory runs out. */
bool edit_order_make(edit_order *o, const batch *b, uint64_t tick);

#endif
