/* undo_log.h - the memory that a bulk change has allocated for a tree, or will free.
 *
 * A change to many points builds new nodes beside the old ones and then exchanges the root, so that it either happens
 * or does not. The log frees what was made when it does not, and what was replaced when it does.
 */
#ifndef OCTREE_UNDO_LOG_H
#define OCTREE_UNDO_LOG_H

#include "leaf.h"

typedef struct undo_log {
    store *store;
    list made, replaced; /* node: its own block alone */
} undo_log;

/* A group of sibling nodes, or a leaf with room for `count` points. Null or false when there is no memory. */
node *undo_log_make_group(undo_log *log, unsigned count);
bool undo_log_make_leaf(undo_log *log, node *leaf, uint32_t count);

/* The node's own group or points will not be part of the tree. */
bool undo_log_replace(undo_log *log, const node *n);

/* Replace a node and all below it by a leaf of their points. */
bool undo_log_collapse(undo_log *log, node *n);

/* The change happens, or not: free what was replaced, or what was made. */
void undo_log_commit(undo_log *log);
void undo_log_abandon(undo_log *log);

#endif
