/* SPDX-License-Identifier: MIT */
/* foreign.h - the current nodes of a foreign index, and the errors found in them. Private.
 *
 * The public types are in octree/foreign.h.
 */
#ifndef OCTREE_FOREIGN_STATE_H
#define OCTREE_FOREIGN_STATE_H

#include "judge.h"

/* The id of a node, and the index of the node in foreign.nodes. */
typedef struct foreign_key {
    uint64_t id;
    size_t place;
} foreign_key;

/* The id of a point, and the index of a node that lists the point. */
typedef foreign_key foreign_holding;

/* A comparison function for qsort(): compares ids; for equal ids, compares node indices. */
int foreign_compare_keys(const void *a, const void *b);

/* A point that no node lists. */
typedef struct unlisted_point {
    uint64_t id;
    bool held; /* true: the point lies in the box of a leaf that lists no points, so this leaf holds the point */
} unlisted_point;

/* For one foreign node: whether the current query visited, pruned or hit the node. */
typedef struct foreign_mark {
    /* the number foreign.query of the last query that named the node; if the current query has another number, the
     * other members of the mark are not valid */
    uint64_t query;
    octree_node_visit visit;
    bool reported;
    /* used only in foreign_set_nodes(): the number of children whose points are not yet included in the node's count of
     * points */
    size_t pending;
} foreign_mark;

/* The current nodes of a foreign index, and the errors found in them. If all members except `memory` are zero, there
 * are no nodes yet. */
typedef struct foreign {
    arena *memory;
    /* the part of this state that a tick contains; foreign_update_state() sets its pointers */
    octree_foreign_state state;
    octree_foreign_node *nodes; /* a copy of the nodes; one memory block holds the nodes and the ids of their points */
    size_t size;                /* the size, in bytes, of the memory block of `nodes` */
    list places;                /* a list of octree_foreign_place, in the order of the nodes */
    list keys;                  /* a list of foreign_key, sorted by id */
    list marks;                 /* a list of foreign_mark, one for each node */
    list holdings;              /* a list of foreign_holding, sorted by the point's id and then by node index */
    list kinds;                 /* a list of char[OCTREE_NODE_KIND]: the names of the kinds of nodes */
    list repeated;              /* a list of foreign_holding, one for each point that a node lists more than once */
    list wrong;                 /* a list of octree_wrong_node: the wrong nodes that were found in this tick */
    /* a list of size_t: the indices of the nodes that the queries of the tick named; an index may occur several
     * times */
    list visits;
    list unlisted;   /* a list of unlisted_point: the points that no node lists, sorted by id */
    size_t standing; /* the number of elements at the start of `wrong` that were found without queries */
    size_t standing_counts[OCTREE_WRONG_NODE_KINDS];
    uint64_t query;   /* the number of queries recorded so far; this number identifies the current query in the marks */
    uint64_t version; /* the version of the tree with which the nodes were last checked */
    bool checked;
} foreign;

/* Copy nodes that octree_foreign_check() accepts, and make the copies the current nodes. Returns false if memory runs
 * out. */
bool foreign_set_nodes(foreign *f, const octree_foreign_tree *tree);
void foreign_release(foreign *f);

/* Returns the index of the node with this id, or SIZE_MAX if no node has the id. */
size_t foreign_find_node(const foreign *f, uint64_t id);

/* Returns the index, in f->holdings, of the first holding of a point. The holdings of other nodes that list the point
 * follow. If no node lists the point, the holding at the returned index, if any, has another id. */
size_t foreign_find_first_holding(const foreign *f, uint64_t point);

/* Returns whether a body and the box of a node have a common point. They are compared with the precision of the node.
 */
bool foreign_node_meets(const octree_foreign_node *node, const octree_body *body);

/* Begin a tick: clear everything that was recorded about nodes during the queries of the last tick. */
void foreign_begin_tick(foreign *f);

/* Find the wrong nodes that can be found without queries. Call this function after all changes of a tick. Returns false
 * if memory runs out. Cost: O(1) if neither the nodes nor the tree changed; else O(n log n), where n is the number of
 * nodes, points and listed ids, and one range search for each leaf that lists no points. */
bool foreign_check_nodes(foreign *f, const audited_points *points);

/* Record which nodes a query visited, pruned and hit. Add to the wrong nodes the nodes that the query named although
 * they do not exist, and the nodes that it pruned wrongly. `answer` is the index of the query's answer among the
 * answers of the tick. Returns false if memory runs out. */
bool foreign_record_query(foreign *f, judge *j, const judged_query *about, size_t answer);

/* Set the pointers and counts of f->state. After this call, the lists must not grow before the next tick. */
void foreign_update_state(foreign *f);

#endif
