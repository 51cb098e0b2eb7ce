/* journal.h - blocks that a change has taken from the tree's pools, or will give back. Private.
 *
 * A change to many points makes what is new beside what is old, and then puts it in its place: so it either happens or
 * does not. The journal gives back what was made when it does not, and what was replaced when it does.
 */
#ifndef OCTREE_JOURNAL_H
#define OCTREE_JOURNAL_H

#include "list.h"
#include "tree.h"

typedef struct journal {
    octree *tree;
    list made, replaced; /* of journal entries */
} journal;

/* A group of sibling nodes, or a leaf with room for `count` points. Null or false when there is no memory. */
node *journal_make_group(journal *j, unsigned count);
bool journal_make_leaf(journal *j, node *leaf, uint32_t count);

/* The node's own group or points will not be part of the tree. */
bool journal_replace(journal *j, const node *n);

/* A leaf of all points in and below a node, in its place; what was below it is replaced. */
bool journal_collapse(journal *j, node *n);

/* The root that all of this was for. */
void journal_commit(journal *j, node root);
void journal_abandon(journal *j);

#endif
