/* SPDX-License-Identifier: MIT */
/* foreign.h - a tree that is not Octreel's: the nodes of a program's own index, as the program says them.
 *
 * A kd-tree, an R-tree, a hierarchy of bounding volumes, an octree and a grid are all boxes with parents. A game shows
 * them (octree_session.foreign, octree_input.foreign), says how queries met them (octree_query.met), and lists what can
 * be proved wrong about them (octree_foreign_state).
 */
#ifndef OCTREE_FOREIGN_H
#define OCTREE_FOREIGN_H

#include "octree/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Which positions what a program says is right for: those of points and queries as they are, or all of them rounded to
 * the nearest float first, each coordinate, bound and radius by itself (the last finite float beyond those).
 * FLOATS is for an index that holds floats and is exact for them. One that computes in floats too errs by some 4e-7 of
 * a distance beyond that: an epsilon of its queries says so. */
typedef enum octree_precision { OCTREE_DOUBLES, OCTREE_FLOATS, OCTREE_PRECISIONS } octree_precision;

/* "double", "float". Null from OCTREE_PRECISIONS on. */
const char *octree_precision_name(octree_precision precision);

/* Ids, borrowed. `ids` may be null where there are none. */
typedef struct octree_ids {
    const uint64_t *ids;
    size_t count;
} octree_ids;

/* Ids of nodes are below this: files keep them exactly, and pictures tell them from addresses. */
#define OCTREE_NODE_ID_LIMIT (UINT64_C(1) << 53)

#define OCTREE_NODE_KIND 16

/* A node of a program's tree. All zero but id and box is a root of which nothing else is said. */
typedef struct octree_foreign_node {
    uint64_t id;     /* unique among the nodes of its tree, below OCTREE_NODE_ID_LIMIT */
    bool has_parent; /* false: a root. There may be any number of them, as in a grid */
    uint64_t parent; /* the id of a node that stands anywhere among them */
    octree_box box;  /* finite and closed. It may be flat, overlap others, and leave the world */
    bool has_depth;  /* false: one more than its parent's, 0 of a root */
    int depth;       /* >= 0 */
    bool has_points; /* the program says which points it holds itself, be it none */
    octree_ids points;
    char kind[OCTREE_NODE_KIND]; /* a short word of printable ASCII, such as "leaf", with its final zero; may be "" */
    octree_precision precision;  /* of its box: FLOATS compares it with points and with its parent's after rounding */
} octree_foreign_node;

/* All nodes of a program's tree, from a tick on until others replace them. */
typedef struct octree_foreign_tree {
    uint64_t tick;
    const octree_foreign_node *nodes; /* in any order; null where there are none: the program's tree is empty */
    size_t node_count;
} octree_foreign_tree;

/* Whether these nodes can be a tree. *place, which may be null, is that of the node at fault. Errors: NULL_ARGUMENT,
 * and of a node BAD_SIZE (its id or depth), NOT_FINITE and BAD_RANGE (its box), BAD_TEXT (its kind), BAD_OPTION (its
 * precision), DUPLICATE (its id), NOT_FOUND (its parent), BAD_PARENT (it is its own ancestor); NO_MEMORY. The tick is
 * not read. Cost: O(n log n), and some 100 bytes a node of malloc's while it runs. */
octree_status octree_foreign_check(const octree_foreign_tree *tree, size_t *place);

/* How a query of the program met a node. */
typedef enum octree_met {
    OCTREE_MET_VISITED, /* it looked into the node */
    OCTREE_MET_PRUNED,  /* it left the node out, with all below it */
    OCTREE_MET_HIT,     /* it found something there */
    OCTREE_MET_KINDS
} octree_met;

/* "visited", "pruned", "hit": as in session files. Null from OCTREE_MET_KINDS on. */
const char *octree_met_name(octree_met met);

/* What can be proved wrong about a program's nodes. A node holds the points that it lists; a leaf that lists none, not
 * even that there are none, holds those in its box. */
typedef enum octree_node_fault_kind {
    OCTREE_NODE_OUTSIDE_PARENT, /* its box leaves that of its parent */
    OCTREE_NODE_UNKNOWN_POINT,  /* it lists an id that no point has at that tick */
    OCTREE_NODE_OUTSIDE_POINT,  /* it lists a point that is outside its box */
    OCTREE_NODE_REPEATED_POINT, /* it lists a point more than once */
    OCTREE_NODE_LOST_POINT,     /* no node holds the point; the player whom keys move need not be held */
    OCTREE_NODE_UNKNOWN_NODE,   /* a query met an id that no node has */
    OCTREE_NODE_PRUNED_POINT,   /* a query pruned it, and it or a node below alone holds a point without which no answer
                                   can be right. Of the nodes from that point's up, the first that the query met
                                   counts: below one that it visited nothing was pruned */
    OCTREE_NODE_FAULTS
} octree_node_fault_kind;

/* "outside_parent", "unknown_point", "outside_point", "repeated_point", "lost_point", "unknown_node", "pruned_point".
 * Null from OCTREE_NODE_FAULTS on. */
const char *octree_node_fault_name(octree_node_fault_kind kind);

/* In some words, such as "its box leaves its parent's". Null from OCTREE_NODE_FAULTS on. */
const char *octree_node_fault_words(octree_node_fault_kind kind);

typedef struct octree_node_fault {
    octree_node_fault_kind kind;
    uint64_t node;  /* LOST_POINT: 0, and nothing is said by it */
    uint64_t point; /* 0 and nothing said by it for OUTSIDE_PARENT and UNKNOWN_NODE */
    size_t answer;  /* UNKNOWN_NODE, PRUNED_POINT: the place of the query's answer among the tick's; else 0 */
} octree_node_fault;

/* A node as it is at a tick. */
typedef struct octree_foreign_place {
    const octree_foreign_node *node;
    size_t parent;   /* the place of its parent; SIZE_MAX for a root */
    unsigned depth;  /* as said, or one more than the parent's */
    unsigned kind;   /* the place of its kind among octree_foreign_state.kinds */
    bool leaf;       /* it is nobody's parent */
    size_t points;   /* listed by it and by all below it */
    unsigned met;    /* bits 1 << octree_met: by the tick's queries */
    unsigned faults; /* bits 1 << octree_node_fault_kind: at this tick */
} octree_foreign_place;

/* The most faults that a tick lists; all are counted. */
#define OCTREE_LISTED_NODE_FAULTS 100

/* Kinds of nodes are told apart up to so many. */
#define OCTREE_NODE_KINDS 10

/* A program's tree at a tick, and what is wrong with it. */
typedef struct octree_foreign_state {
    bool given;                        /* the program has said its nodes, at this tick or before; else all is 0 */
    bool fresh;                        /* at this tick */
    const octree_foreign_place *nodes; /* those in force, in their order */
    size_t node_count, leaf_count;
    unsigned depth;               /* the greatest */
    uint64_t digest;              /* of the nodes as they were said */
    size_t met[OCTREE_MET_KINDS]; /* how many of them the tick's queries met in each way */
    size_t faults[OCTREE_NODE_FAULTS];
    const octree_node_fault *listed;  /* the first of them: by node, by point, then those of queries in their order */
    size_t listed_count, fault_count; /* fault_count: of all kinds together */
    const char (
        *kinds)[OCTREE_NODE_KIND]; /* of all nodes up to this tick, as they came; the last stands for the rest */
    size_t kind_count;
} octree_foreign_state;

#ifdef __cplusplus
}
#endif

#endif
