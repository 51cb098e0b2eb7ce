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
 * A move keeps a body's extents. A body whose extents change is therefore removed and inserted again where it is, and
 * then moved.
 *
 * A point outside the world is in no tree. A move out of the world becomes a removal and an insertion, which the game
 * refuses. A move into the world, or from one place outside to another, becomes an insertion. */
typedef struct edit_order {
    octree_box world;
    /* if full leaves refuse points (OCTREE_REFUSE), a tree to which all edits made so far were applied; else null */
    octree *tree;
    /* the half extents of all points after the tick, because insertions need the extents of points that come back into
     * the world */
    point_table extents;
    octree_edit *edits;
    size_t count;
    size_t *waiting; /* indices of changes that are not yet complete: a full leaf had no room for the point, or the
                      * point is removed and is still to be inserted */
    size_t waiting_count;
    size_t room; /* number of changes of both tracks for which `edits` and `waiting` have room */
} edit_order;

/* Initialize *o. If full leaves refuse points (OCTREE_REFUSE), make a tree and insert the points that the batch `first`
 * inserts. Returns false if memory runs out. */
bool edit_order_init(edit_order *o, const octree_def *def, const batch *first);
void edit_order_release(edit_order *o);

/* Returns the body that is inserted at a position. */
octree_game_body edit_order_make_body(const edit_order *o, uint64_t id, const double at[3]);

/* Set o->edits to the edits that make the changes of a batch at a tick. `game` has played the tick before. Returns
 * false if memory runs out. */
bool edit_order_make(edit_order *o, const octree_game *game, const batch *b, uint64_t tick);

#endif
