/* SPDX-License-Identifier: MIT */
/* foreign.h - the nodes and the pairs of a foreign index: a user's own spatial index whose answers are checked.
 *
 * The nodes of a kd-tree, an R-tree, a bounding volume hierarchy, an octree or a grid are all boxes with parents. A
 * game shows these nodes (octree_session.foreign, octree_input.foreign), and shows which nodes queries visited and
 * pruned (octree_query.visits). It also lists the nodes that are provably wrong (octree_foreign_state). A game compares
 * the overlapping pairs that the index found (octree_session.foreign_pairs) with the exact pairs.
 */
#ifndef OCTREE_FOREIGN_H
#define OCTREE_FOREIGN_H

#include "octree/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The precision of the positions for which a foreign index promises right answers.
 *
 * DOUBLES: answers are judged for the positions of points and queries as they are. FLOATS: before an answer is judged,
 * all positions, bounds and radii are rounded to the nearest float; a number beyond the range of floats becomes the
 * largest finite float.
 *
 * FLOATS is for an index that stores floats and computes exactly with them. An index that also computes in floats has a
 * relative error of about 4e-7 in its distances; octree_query.epsilon can allow this error. */
typedef enum octree_precision { OCTREE_DOUBLES, OCTREE_FLOATS, OCTREE_PRECISIONS } octree_precision;

/* Returns the name of a precision: "double" or "float". Returns null for precision >= OCTREE_PRECISIONS. */
const char *octree_precision_name(octree_precision precision);

/* An array of ids that the caller owns. `ids` may be null if count is 0. */
typedef struct octree_ids {
    const uint64_t *ids;
    size_t count;
} octree_ids;

/* Exclusive upper bound of the ids of foreign nodes. Session files store ids as JSON numbers (doubles), which represent
 * every integer below this bound exactly. */
#define OCTREE_NODE_ID_LIMIT (UINT64_C(1) << 53)

#define OCTREE_NODE_KIND 16

/* A node of a foreign index. If all members except the id and the box are zero, the node is a root that lists no
 * points. */
typedef struct octree_foreign_node {
    uint64_t id; /* unique among the nodes of the array, below OCTREE_NODE_ID_LIMIT */
    /* false: the node is a root. An index may have any number of roots; in a grid, each cell is a root */
    bool has_parent;
    uint64_t parent; /* the id of the parent node, which may be anywhere in the same array */
    /* a closed box with finite corners. It may be flat, overlap other boxes, and reach outside the world */
    octree_box box;
    bool has_depth; /* false: the depth is the parent's depth plus 1, or 0 for a root */
    int depth;      /* the node's depth, >= 0; read only if has_depth is true */
    /* true: `points` lists the points that the node itself holds, without the points of its descendants; the list may
     * be empty */
    bool has_points;
    octree_ids points;
    char kind[OCTREE_NODE_KIND]; /* a word in printable ASCII with its final zero, such as "leaf"; may be "" */
    /* FLOATS: points and other boxes are rounded to floats before they are compared with this box */
    octree_precision precision;
} octree_foreign_node;

/* All nodes of a foreign index, as they are from tick `tick` until the next tick for which the session gives nodes. */
typedef struct octree_foreign_tree {
    uint64_t tick;
    /* the nodes in any order; null if node_count is 0, which means that the foreign index is empty */
    const octree_foreign_node *nodes;
    size_t node_count;
} octree_foreign_tree;

/* Check that nodes form a forest: one or more trees. tree->tick is not read. On failure *place, if `place` is not null,
 * receives the index of a wrong node.
 *
 * Errors: NULL_ARGUMENT; BAD_SIZE (id or depth), NOT_FINITE and BAD_RANGE (box), BAD_TEXT (kind), BAD_OPTION
 * (precision), DUPLICATE (id), NOT_FOUND (parent), BAD_PARENT (the node is its own ancestor); NO_MEMORY.
 *
 * Cost: O(n log n) time, and about 100 bytes for each node from malloc() during the call. */
octree_status octree_foreign_check(const octree_foreign_tree *tree, size_t *place);

/* What a query of the foreign index did with a foreign node. */
typedef enum octree_node_visit {
    OCTREE_NODE_VISITED, /* the query examined the node */
    OCTREE_NODE_PRUNED,  /* the query skipped the node and all its descendants */
    OCTREE_NODE_HIT,     /* the query found a result in the node */
    OCTREE_NODE_VISITS
} octree_node_visit;

/* Returns the name of a visit in session files: "visited", "pruned" or "hit". Returns null for visit >=
 * OCTREE_NODE_VISITS. */
const char *octree_node_visit_name(octree_node_visit visit);

/* How a foreign node is provably wrong. In these rules, a node holds the points that it lists, and a leaf whose
 * has_points is false holds all points in its box. */
typedef enum octree_wrong_node_kind {
    OCTREE_NODE_OUTSIDE_PARENT, /* the node's box reaches outside its parent's box */
    OCTREE_NODE_UNKNOWN_POINT,  /* the node lists an id that no point has at this tick */
    OCTREE_NODE_OUTSIDE_POINT,  /* the node lists a point that is outside the node's box */
    OCTREE_NODE_REPEATED_POINT, /* the node lists a point more than once */
    /* no node holds the point. This is no error for a player that key presses move */
    OCTREE_NODE_LOST_POINT,
    OCTREE_NODE_UNKNOWN_NODE, /* a query names the id of a foreign node that does not exist */
    /* A query pruned all nodes that hold a point, although every right answer contains the point. A node counts as
     * pruned if the query names it as pruned and not as visited. A node that the query does not name counts as pruned
     * if its nearest named ancestor counts as pruned. */
    OCTREE_NODE_PRUNED_POINT,
    OCTREE_WRONG_NODE_KINDS
} octree_wrong_node_kind;

/* Returns the name of a kind: "outside_parent", "unknown_point", "outside_point", "repeated_point", "lost_point",
 * "unknown_node" or "pruned_point". Returns null for kind >= OCTREE_WRONG_NODE_KINDS. */
const char *octree_wrong_node_name(octree_wrong_node_kind kind);

/* Returns a description of a few words, such as "its box extends outside its parent's box". Returns null for kind >=
 * OCTREE_WRONG_NODE_KINDS. */
const char *octree_wrong_node_words(octree_wrong_node_kind kind);

typedef struct octree_wrong_node {
    octree_wrong_node_kind kind;
    uint64_t node;  /* the id of the wrong node; 0 for LOST_POINT, because no node holds the point */
    uint64_t point; /* the id of the point; 0 for OUTSIDE_PARENT and UNKNOWN_NODE, which concern no point */
    /* for UNKNOWN_NODE and PRUNED_POINT: the index in octree_tick.answers of the answer to the query; else 0 */
    size_t answer;
} octree_wrong_node;

/* A foreign node at a tick, and its relation to the other nodes. */
typedef struct octree_foreign_place {
    const octree_foreign_node *node;
    size_t parent;   /* index of the parent node in octree_foreign_state.nodes; SIZE_MAX for a root */
    unsigned depth;  /* the node's own depth if has_depth is true; else the parent's depth plus 1, or 0 for a root */
    unsigned kind;   /* index of the node's kind in octree_foreign_state.kinds */
    bool leaf;       /* true: the node has no children */
    size_t points;   /* the sum of the numbers of points that the node and all its descendants list */
    unsigned visits; /* bit mask, bit 1 << octree_node_visit: what the tick's queries did with the node */
    unsigned wrong;  /* bit mask, bit 1 << octree_wrong_node_kind: how the node is wrong at this tick */
} octree_foreign_place;

/* The maximum number of wrong nodes that a tick lists. Further wrong nodes are counted but not listed. */
#define OCTREE_LISTED_WRONG_NODES 100

/* The maximum number of different kinds of nodes. Nodes of all further kinds count as nodes of the last kind. */
#define OCTREE_NODE_KINDS 10

/* The nodes of the foreign index at a tick, and the errors in these nodes. */
typedef struct octree_foreign_state {
    bool given; /* true: the session gave foreign nodes at this tick or earlier. If false, all members are 0 */
    bool fresh; /* true: the session gave foreign nodes at this tick */
    /* the foreign nodes that are valid at this tick, in the order in which the session gave them */
    const octree_foreign_place *nodes;
    size_t node_count, leaf_count;
    unsigned depth;  /* the greatest depth of a foreign node */
    uint64_t digest; /* the digest of the foreign nodes as the session gave them */
    /* visits[v], with v an octree_node_visit: the number of nodes that the tick's queries visited, pruned or hit */
    size_t visits[OCTREE_NODE_VISITS];
    size_t wrong[OCTREE_WRONG_NODE_KINDS]; /* the number of wrong nodes of each kind */
    /* the first wrong nodes, at most OCTREE_LISTED_WRONG_NODES. Errors of the nodes themselves come first, sorted by
     * node and point; errors of queries follow, in the order of the queries */
    const octree_wrong_node *listed;
    size_t listed_count, wrong_count;      /* wrong_count is the number of all wrong nodes, whether listed or not */
    const char (*kinds)[OCTREE_NODE_KIND]; /* the kinds of all nodes up to this tick, in the order in which they first
                                              appeared */
    size_t kind_count;
} octree_foreign_state;

/* Two bodies whose boxes have a common point. The player of OCTREE_PLAYER_KEYS is in no pair: octree_tick.hits lists
 * what its box touches. */
typedef struct octree_pair {
    uint64_t a, b; /* their ids, a < b */
} octree_pair;

/* All pairs of bodies that overlap at tick `tick`, as a foreign index found them. The boxes are closed: boxes that only
 * touch overlap, too. */
typedef struct octree_foreign_pairs {
    uint64_t tick;
    /* the pairs in any order; here `a` may also be the greater id. Null if pair_count is 0, which means that no bodies
     * overlap */
    const octree_pair *pairs;
    size_t pair_count;
} octree_foreign_pairs;

#ifdef __cplusplus
}
#endif

#endif
