/* SPDX-License-Identifier: MIT */
/* foreign.h - the foreign nodes that are current, and what is wrong with them. Private.
 *
 * The public types are in octree/foreign.h.
 */
#ifndef OCTREE_FOREIGN_STATE_H
#define OCTREE_FOREIGN_STATE_H

#include "judge.h"

/* A node's id and its index. */
typedef struct foreign_key {
    uint64_t id;
    size_t place;
} foreign_key;

/* A point's id and the index of a node that lists it. */
typedef foreign_key foreign_holding;

/* A qsort() comparison: by id, then by node index. */
int foreign_compare_keys(const void *a, const void *b);

/* A point that no node lists. */
typedef struct unlisted_point {
    uint64_t id;
    bool held; /* a leaf that lists no points has it in its box */
} unlisted_point;

/* What the current query did with a node. */
typedef struct foreign_mark {
    uint64_t query; /* the other members count only if this is foreign.query */
    octree_node_visit visit;
    bool reported;
    size_t pending; /* only in foreign_set_nodes(): the number of children whose points are not summed yet */
} foreign_mark;

/* The current nodes and what is known of them. Valid when all zero but `memory`: there are no nodes yet. */
typedef struct foreign {
    arena *memory;
    octree_foreign_state state; /* what a tick shows; foreign_publish() sets its pointers */
    octree_foreign_node *nodes; /* a copy, in one block with the ids of their points */
    size_t size;                /* the size of this block in bytes */
    list places;                /* octree_foreign_place, in the order of the nodes */
    list keys;                  /* foreign_key, sorted by id */
    list marks;                 /* foreign_mark, one for each node */
    list holdings;              /* foreign_holding, sorted by point and then by node index */
    list kinds;                 /* char[OCTREE_NODE_KIND]: the names of the kinds of nodes */
    list repeated;              /* foreign_holding: points that a node lists more than once */
    list wrong;                 /* octree_wrong_node: the faults of the tick */
    list visits;                /* size_t: the nodes that the tick's queries name, some several times */
    list unlisted;              /* unlisted_point: points that no node lists, by id */
    size_t standing;            /* the number of first faults that do not come from queries */
    size_t standing_counts[OCTREE_WRONG_NODE_KINDS];
    uint64_t query;   /* the number of queries that named nodes so far */
    uint64_t version; /* the version of the tree for which the standing faults were found */
    bool checked;
} foreign;

/* Copy nodes and make them current. Returns OK, NO_MEMORY, or an error of octree_foreign_check(). */
octree_status foreign_set_nodes(foreign *f, const octree_foreign_tree *tree);
void foreign_release(foreign *f);

/* The index of the node with an id; SIZE_MAX where there is none. */
size_t foreign_find_node(const foreign *f, uint64_t id);

/* The index of the first holding of a point; its other holdings follow. */
size_t foreign_first_holding(const foreign *f, uint64_t point);

/* Whether a position is in a node's box, with the precision of the node. */
bool foreign_node_contains(const octree_foreign_node *node, const double position[3]);

/* Forget the nodes that the last tick's queries named. */
void foreign_begin_tick(foreign *f);

/* After all changes of a tick: find what is wrong with the nodes apart from queries. False when there is no memory.
 * Cost: nothing if neither the nodes nor the tree changed; else O(n log n) for n nodes, points and listed ids, and one
 * range search for each leaf that lists no points. */
bool foreign_check_nodes(foreign *f, const audited_points *points);

/* Record which nodes a query named, and what is wrong with that. `answer` is the index of the query's answer among
 * those of the tick. False when there is no memory. */
bool foreign_record_query(foreign *f, judge *j, const judged_query *about, size_t answer);

/* Set the pointers and counts of f->state. The lists must not grow any more. */
void foreign_publish(foreign *f);

#endif
