/* SPDX-License-Identifier: MIT */
/* foreign.h - the current nodes of a foreign index, and how they are wrong. Private.
 *
 * The public types are in octree/foreign.h.
 */
#ifndef OCTREE_FOREIGN_STATE_H
#define OCTREE_FOREIGN_STATE_H

#include "judge.h"

/* A node's id, and its index in foreign.nodes. */
typedef struct foreign_key {
    uint64_t id;
    size_t place;
} foreign_key;

/* A point's id and the index of a node that lists it. */
typedef foreign_key foreign_holding;

/* A comparison function for qsort(): by id, then by node index. */
int foreign_compare_keys(const void *a, const void *b);

/* A point that no node lists. */
typedef struct unlisted_point {
    uint64_t id;
    bool held; /* true: the point is in the box of a leaf that lists no points */
} unlisted_point;

/* What the current query did with a foreign node. */
typedef struct foreign_mark {
    /* foreign.query of the query that last named the node; if it differs, the other members are not valid */
    uint64_t query;
    octree_node_visit visit;
    bool reported;
    size_t pending; /* used only in foreign_set_nodes(): the number of children whose points are not added yet */
} foreign_mark;

/* The current nodes of a foreign index, and what was found out about them. If all members except `memory` are zero,
 * there are no nodes yet. */
typedef struct foreign {
    arena *memory;
    octree_foreign_state state; /* the part that a tick shows; foreign_update_state() sets its pointers */
    octree_foreign_node *nodes; /* a copy of the nodes, in one memory block with the ids of their points */
    size_t size;                /* the size of this memory block in bytes */
    list places;                /* a list of octree_foreign_place, in the order of the nodes */
    list keys;                  /* a list of foreign_key, sorted by id */
    list marks;                 /* a list of foreign_mark, one for each node */
    list holdings;              /* a list of foreign_holding, sorted by point and then by node index */
    list kinds;                 /* a list of char[OCTREE_NODE_KIND]: the names of the kinds of nodes */
    list repeated;              /* a list of foreign_holding: the points that a node lists more than once */
    list wrong;                 /* a list of octree_wrong_node: the wrong nodes of the tick */
    list visits; /* a list of size_t: the indices of the nodes that the tick's queries name; an index may occur several
                    times */
    list unlisted;   /* a list of unlisted_point: the points that no node lists, sorted by id */
    size_t standing; /* the number of elements of `wrong`, from the first on, that were found without queries */
    size_t standing_counts[OCTREE_WRONG_NODE_KINDS];
    uint64_t query;   /* the number of recorded queries so far; it identifies the current query in the marks */
    uint64_t version; /* the version of the tree with which the nodes were last checked */
    bool checked;
} foreign;

/* Copy nodes that octree_foreign_check() accepts, and make the copies the current nodes. False when there is no memory.
 */
bool foreign_set_nodes(foreign *f, const octree_foreign_tree *tree);
void foreign_release(foreign *f);

/* The index of the node that has an id; SIZE_MAX if no node has it. */
size_t foreign_find_node(const foreign *f, uint64_t id);

/* The index, in f->holdings, of the first node that lists a point. The other nodes that list it follow. */
size_t foreign_first_holding(const foreign *f, uint64_t point);

/* Whether a position is in a node's box, with the precision of the node. */
bool foreign_node_contains(const octree_foreign_node *node, const double position[3]);

/* Start a tick: reset what the last tick's queries recorded about nodes. */
void foreign_begin_tick(foreign *f);

/* Find the wrong nodes that can be found without queries. Call it after all changes of a tick. False when there is no
 * memory. Cost: nothing if neither the nodes nor the tree changed; else O(n log n) for n nodes, points and listed ids,
 * and one range search for each leaf that lists no points. */
bool foreign_check_nodes(foreign *f, const audited_points *points);

/* Record which nodes a query visited, pruned and hit, and report the nodes that it names wrongly or prunes wrongly.
 * `answer` is the index of the query's answer among those of the tick. False when there is no memory. */
bool foreign_record_query(foreign *f, judge *j, const judged_query *about, size_t answer);

/* Set the pointers and counts of f->state. The lists must not grow after this call until the next tick. */
void foreign_update_state(foreign *f);

#endif
