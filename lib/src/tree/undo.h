/* SPDX-License-Identifier: MIT */
/* undo.h - single moves that can be reverted.
 *
 * Problem: a batch of moves happens completely or not at all. The way back must not need memory, because a batch is
 * reverted when memory runs out.
 *
 * Idea: each change of a node is a step that keeps the memory which the node no longer needs. The blocks of the old
 * node are not freed, and a leaf that becomes empty stays. So a step is reverted by writing the old node back. The last
 * step is reverted first, so that the revert of a step finds the nodes above as they were just after the step. When all
 * moves of the batch are made, finish_move() frees the memory that the steps kept.
 *
 * Cost: 24 bytes a step, two steps a move.
 */
#ifndef OCTREE_UNDO_H
#define OCTREE_UNDO_H

#include "tree.h"

typedef enum step_kind {
    STEP_NONE,
    STEP_OVERWRITTEN, /* a point moved within its leaf */
    STEP_APPENDED,    /* a point was appended to a leaf */
    STEP_REMOVED,     /* a point was removed from a leaf */
    STEP_REPLACED,    /* a node was replaced by another version, which shares no memory with it */
    STEP_REGROUPED,   /* an inner node got a copy of the group of its children, with one more leaf */
} step_kind;

typedef struct step {
    node old;       /* the node before the step; not set for STEP_OVERWRITTEN and STEP_APPENDED */
    uint32_t index; /* the index of a removed point in its leaf */
    uint8_t depth;  /* the depth of the changed node */
    uint8_t kind;   /* a step_kind */
} step;

typedef struct single_move {
    octree_point old, moved; /* the point before and after the move */
    uint64_t from, to;       /* the Morton codes of the two positions */
} single_move;

/* Move a point that was found to a position where it is not stored yet; its id may change too. `to` is the path of that
 * position. `undo` may be null. Otherwise undo[0] and undo[1] must be STEP_NONE before the call. undo[0] receives the
 * arrival of the point or its move within a leaf, undo[1] its departure. Returns the statuses of insert_point() but
 * DUPLICATE. The change log must be off. */
octree_status move_found_point(octree *tree, const single_move *m, found_point *found, const path *to, step *undo);

/* Move a point. found->path and `to` are the paths of the two positions; found->index is not read. m->old.position
 * becomes the position as it was stored. `undo` is that of move_found_point(). Returns the statuses of octree_move().
 */
octree_status move_along_paths(octree *tree, single_move *m, found_point *found, const path *to, step *undo);

/* Returns whether a move has moved or replaced inner nodes, so that the paths of other points may be wrong. If the
 * result is false, each path still ends at the same node, which may have been split. */
static inline bool has_changed_paths(const step undo[2])
{
    return undo[0].kind == STEP_REGROUPED || undo[1].kind == STEP_REPLACED;
}

/* revert_move() restores the tree as it was before a move, after which nothing else has changed. finish_move() frees
 * the memory that the steps of a move kept; `old` is the point before the move. After finish_move(), no move can be
 * reverted any more. Neither function allocates memory. */
void revert_move(octree *tree, const single_move *m, const step undo[2]);
void finish_move(octree *tree, const octree_point *old, const step undo[2]);

#endif
