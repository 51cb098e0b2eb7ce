/* SPDX-License-Identifier: MIT */
/* edit_order.h - the changes of a tick become a session's edits. Private to this folder. */
#ifndef EMBED_EDIT_ORDER_H
#define EMBED_EDIT_ORDER_H

#include "batch.h"

/* The edits that a tick's changes become, in an order in which every one of them is accepted.
 *
 * Where leaves grow any order will do. Where a full leaf refuses points, one that comes must not come before one that
 * goes: moves that find no room are tried again after the others, and what is left then (points that change places) is
 * taken out and put back in; a player that is such a point is swept from where it is put.
 *
 * A point outside the world is in no tree: what comes or goes there is taken out and inserted, which the game refuses.
 */
typedef struct edit_order {
    octree_box world;
    octree *tree; /* under OCTREE_REFUSE the tree as it is so far; else null */
    octree_edit *edits;
    size_t count;
    size_t *waiting; /* changes that found no room */
    size_t room;     /* changes that the arrays are large enough for */
} edit_order;

/* For trees of this definition, with these points so far. False when there is no memory. */
bool edit_order_init(edit_order *o, const octree_def *def, const points *now);
void edit_order_release(edit_order *o);

/* Let o->edits be those of a batch, at a tick. False when there is no memory. */
bool edit_order_make(edit_order *o, const batch *b, uint64_t tick);

#endif
