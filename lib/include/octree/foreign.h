/* SPDX-License-Identifier: MIT */
/* foreign.h - the nodes of a foreign index: a user's own spatial index whose answers and nodes are checked.
 *
 * A kd-tree, an R-tree, a bounding volume hierarchy, an octree and a grid are all boxes with parents. A game shows
 * these nodes (octree_session.foreign, octree_input.foreign), shows which of them queries visited and pruned
 * (octree_query.visits), and lists what is provably wrong with them (octree_foreign_state).
 */
#ifndef OCTREE_FOREIGN_H
#define OCTREE_FOREIGN_H

#include "octree/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The positions for which a foreign index promises to be right. DOUBLES: the positions of points and queries as they
 * are. FLOATS: all positions, bounds and radii rounded to the nearest float first; numbers beyond the range of floats
 * become the largest finite float. FLOATS is for an index that stores floats and computes exactly with them. An index
 * that also computes in floats errs by about 4e-7 of a distance; allow for it with octree_query.epsilon. */
typedef enum octree_precision { OCTREE_DOUBLES, OCTREE_FLOATS, OCTREE_PRECISIONS } octree_precision;

/* "double", "float". Null for precision >= OCTREE_PRECISIONS. */
const char *octree_precision_name(octree_precision precision);

/* Borrowed ids. `ids` may be null if count is 0. */
typedef struct octree_ids {
    const uint64_t *ids;
    size_t count;
} octree_ids;

/* Exclusive upper bound of node ids. JSON numbers hold such ids exactly, and pictures tell them from addresses. */
#define OCTREE_NODE_ID_LIMIT (UINT64_C(1) << 53)

#define OCTREE_NODE_KIND 16

/* A node of a foreign index. A node that is zero except for its id and box is a root without further data. */
typedef struct octree_foreign_node {
    uint64_t id;     /* unique among the nodes, below OCTREE_NODE_ID_LIMIT */
    bool has_parent; /* false: a root. Any number of roots is allowed, as in a grid */
    uint64_t parent; /* the id of a node anywhere in the same array */
    octree_box box;  /* finite and closed. It may be flat, overlap others, and reach outside the world */
    bool has_depth;  /* false: the depth is the parent's plus 1; 0 for a root */
    int depth;       /* >= 0 */
    bool has_points; /* the node lists the points that it holds itself; the list may be empty */
    octree_ids points;
    char kind[OCTREE_NODE_KIND]; /* a short word in printable ASCII, such as "leaf", with its final zero; may be "" */
    octree_precision precision;  /* FLOATS: the box is compared with points and other boxes after rounding to floats */
} octree_foreign_node;

/* All nodes of a foreign index. They are current from this tick until other nodes replace them. */
typedef struct octree_foreign_tree {
    uint64_t tick;
    const octree_foreign_node *nodes; /* in any order; null if node_count is 0: the foreign index is empty */
    size_t node_count;
} octree_foreign_tree;

/* Check that nodes form a forest. The tick is not read. On failure *place, if it is not null, is the index of a wrong
 * node. Errors: NULL_ARGUMENT; BAD_SIZE (id or depth), NOT_FINITE and BAD_RANGE (box), BAD_TEXT (kind), BAD_OPTION
 * (precision), DUPLICATE (id), NOT_FOUND (parent), BAD_PARENT (the node is its own ancestor); NO_MEMORY. Cost:
 * O(n log n) time, and about 100 bytes for each node from malloc() during the call. */
octree_status octree_foreign_check(const octree_foreign_tree *tree, size_t *place);

/* What a query did with a foreign node. */
typedef enum octree_node_visit {
    OCTREE_NODE_VISITED, /* it examined the node */
    OCTREE_NODE_PRUNED,  /* it skipped the node and all its descendants */
    OCTREE_NODE_HIT,     /* it found a result in the node */
    OCTREE_NODE_VISITS
} octree_node_visit;

/* "visited", "pruned", "hit", as in session files. Null for visit >= OCTREE_NODE_VISITS. */
const char *octree_node_visit_name(octree_node_visit visit);

/* What is provably wrong with a foreign node. A node holds the points that it lists. A leaf without a list, not even an
 * empty one, holds all points in its box. */
typedef enum octree_wrong_node_kind {
    OCTREE_NODE_OUTSIDE_PARENT, /* its box reaches outside its parent's box */
    OCTREE_NODE_UNKNOWN_POINT,  /* it lists an id that no point has at this tick */
    OCTREE_NODE_OUTSIDE_POINT,  /* it lists a point that is outside its box */
    OCTREE_NODE_REPEATED_POINT, /* it lists a point more than once */
    OCTREE_NODE_LOST_POINT,     /* no node holds a point. A player moved by keys need not be in any node */
    OCTREE_NODE_UNKNOWN_NODE,   /* a query names a node id that does not exist */
    OCTREE_NODE_PRUNED_POINT,   /* a query pruned it, although only it and its descendants hold a point that every right
                                   answer contains. Between the node that holds the point and its root, the first node
                                   that the query names counts: nothing is pruned below a node that was visited */
    OCTREE_WRONG_NODE_KINDS
} octree_wrong_node_kind;

/* "outside_parent", "unknown_point", "outside_point", "repeated_point", "lost_point", "unknown_node", "pruned_point".
 * Null for kind >= OCTREE_WRONG_NODE_KINDS. */
const char *octree_wrong_node_name(octree_wrong_node_kind kind);

/* A few words, such as "its box leaves its parent's". Null for kind >= OCTREE_WRONG_NODE_KINDS. */
const char *octree_wrong_node_words(octree_wrong_node_kind kind);

typedef struct octree_wrong_node {
    octree_wrong_node_kind kind;
    uint64_t node;  /* 0 and not meaningful for LOST_POINT */
    uint64_t point; /* 0 and not meaningful for OUTSIDE_PARENT and UNKNOWN_NODE */
    size_t answer;  /* UNKNOWN_NODE, PRUNED_POINT: the index of the query's answer in the tick; else 0 */
} octree_wrong_node;

/* A foreign node at a tick. */
typedef struct octree_foreign_place {
    const octree_foreign_node *node;
    size_t parent;   /* the index of its parent; SIZE_MAX for a root */
    unsigned depth;  /* as given, or the parent's plus 1 */
    unsigned kind;   /* the index of its kind in octree_foreign_state.kinds */
    bool leaf;       /* no node has it as parent */
    size_t points;   /* the number of points listed by it and all its descendants */
    unsigned visits; /* bits 1 << octree_node_visit: what the tick's queries did with it */
    unsigned wrong;  /* bits 1 << octree_wrong_node_kind: what is wrong at this tick */
} octree_foreign_place;

/* The largest number of wrong nodes that a tick lists. All are counted. */
#define OCTREE_LISTED_WRONG_NODES 100

/* The largest number of kinds of nodes. Further kinds count as the last one. */
#define OCTREE_NODE_KINDS 10

/* The foreign index at a tick, and what is wrong with its nodes. */
typedef struct octree_foreign_state {
    bool given;                        /* nodes were given at this tick or before; if not, all members are 0 */
    bool fresh;                        /* nodes were given at this tick */
    const octree_foreign_place *nodes; /* the current nodes, in the order in which they were given */
    size_t node_count, leaf_count;
    unsigned depth;                        /* the largest */
    uint64_t digest;                       /* of the nodes as they were given */
    size_t visits[OCTREE_NODE_VISITS];     /* the number of nodes that the tick's queries visited, pruned and hit */
    size_t wrong[OCTREE_WRONG_NODE_KINDS]; /* the number of wrong nodes of each kind */
    const octree_wrong_node *listed;  /* the first of them: sorted by node and point, then those of queries in order */
    size_t listed_count, wrong_count; /* wrong_count: of all kinds together, listed or not */
    const char (*kinds)[OCTREE_NODE_KIND]; /* of all nodes up to this tick, in the order in which they appeared */
    size_t kind_count;
} octree_foreign_state;

#ifdef __cplusplus
}
#endif

#endif
