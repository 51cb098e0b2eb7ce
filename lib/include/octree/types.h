/* SPDX-License-Identifier: MIT */
/* types.h - the plain values that the tree, the game and the recorder exchange.
 *
 * This header declares types only. octree.h declares the functions of the tree, game.h the functions of the game.
 */
#ifndef OCTREE_TYPES_H
#define OCTREE_TYPES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One row for each status: the status, its name in files, and its sentence. */
#define OCTREE_STATUS_MAP(X)                                                                                           \
    X(OK, "ok", "done")                                                                                                \
    X(NOT_FOUND, "not_found", "the tree has no such point or node")                                                    \
    X(DUPLICATE, "duplicate",                                                                                          \
      "a point with this id already exists (in a tree: at the same position; in a set of bodies: this body)")          \
    X(FULL, "full", "the leaf is full and cannot be split any further")                                                \
    X(OUTSIDE, "outside", "the position is outside the world")                                                         \
    X(NOT_FINITE, "not_finite", "a number is NaN or infinite")                                                         \
    X(NULL_ARGUMENT, "null_argument", "a required pointer is null")                                                    \
    X(BAD_WORLD, "bad_world", "the world must have finite corners with min below max on every axis")                   \
    X(BAD_CAPACITY, "bad_capacity", "the leaf capacity must be at least 1; OCTREE_AUTO needs OCTREE_GROW")             \
    X(BAD_RANGE, "bad_range", "the box's min is above its max")                                                        \
    X(BAD_SIZE, "bad_size", "a size must not be negative, nor a direction zero")                                       \
    X(BAD_KEY, "bad_key", "the key is not one of w a s d e f n q .")                                                   \
    X(BAD_OPTION, "bad_option",                                                                                        \
      "an option has an unknown value, or one that does not fit here (of the allocator functions, set both or none)")  \
    X(BAD_TEXT, "bad_text", "text must be printable ASCII and end with a zero byte within its array")                  \
    X(BAD_ORDER, "bad_order", "edits, queries and shapes must be in ascending order of their ticks")                   \
    X(BAD_PARENT, "bad_parent", "a foreign node is its own ancestor")                                                  \
    X(NO_MEMORY, "no_memory", "the allocator returned null")                                                           \
    X(TOO_MANY, "too_many", "the tree would exceed its limit of 4294967295 points")                                    \
    X(BUSY, "busy", "the tree cannot be changed inside its own visitor, tracer or task")                               \
    X(BAD_BUILD, "bad_build",                                                                                          \
      "the library was compiled with options that change arithmetic, such as -ffp-contract=fast or "                   \
      "-funsafe-math-optimizations; compile it without them")                                                          \
    X(BAD_PAIR, "bad_pair", "a pair must consist of two different ids")

typedef enum octree_status {
#define OCTREE_STATUS_ENUM(name, word, text) OCTREE_##name,
    OCTREE_STATUS_MAP(OCTREE_STATUS_ENUM)
#undef OCTREE_STATUS_ENUM
        OCTREE_STATUS_COUNT
} octree_status;

/* ---- Points, boxes and nodes -------------------------------------------------------------------------------- */

/* A closed axis-aligned box. */
typedef struct octree_box {
    double min[3];
    double max[3];
} octree_box;

/* A stored point. Each pair (position, id) occurs once in a tree. Points at different positions may share an id. */
typedef struct octree_point {
    double position[3];
    uint64_t id;
} octree_point;

/* A body: a closed box with the caller's 64-bit id (bodies.h). Its box spans the real numbers position - half to
 * position + half, which are not rounded. */
typedef struct octree_body {
    double position[3]; /* the centre of the box */
    double half[3];     /* the half extents of the box on the three axes: finite, >= 0 */
    uint64_t id;
} octree_body;

/* The half-space normal . x <= offset. */
typedef struct octree_half_space {
    double normal[3]; /* finite, not zero; it need not have length 1 */
    double offset;    /* finite */
} octree_half_space;

/* The greatest depth of a node; the root has depth 0. An address has three bits for each of its 21 octants and a
 * leading 1 bit, so it fits into 64 bits. */
#define OCTREE_MAX_DEPTH 21

/* The address of a node: a leading 1 bit, then three bits per octant from the root down (Morton order). */
typedef uint64_t octree_address;
#define OCTREE_ROOT ((octree_address)1)

/* A read-only description of one node. */
typedef struct octree_node {
    octree_address address;
    unsigned depth;
    bool leaf;
    uint8_t octants; /* bit i is set if octant i has a node; 0 for a leaf */
    /* the box of the node's cell. The faces of this box inside the world are the planes with which insertion compares
     * coordinates */
    octree_box box;
    size_t count; /* the number of points in and below this node */
    /* The points of a leaf. The tree owns the points, and they are valid until the tree's next change. Null for an
     * inner node and for the root of an empty tree. The order of the points is unspecified: trees with equal contents
     * can have different orders. If the order matters, sort the points, for example by octree_compare_points. */
    const octree_point *points;
} octree_node;

typedef struct octree_stats {
    size_t points;
    size_t nodes;
    size_t leaves;
    unsigned depth;      /* the depth of the deepest node */
    size_t largest_leaf; /* the number of points in the fullest leaf */
    size_t nodes_at_depth[OCTREE_MAX_DEPTH + 1];
    size_t leaves_at_depth[OCTREE_MAX_DEPTH + 1];
    size_t memory; /* the number of bytes that the tree has allocated and not yet released */
} octree_stats;

/* ---- Definition of a tree ----------------------------------------------------------------------------------- */

typedef struct octree octree;

/* The treatment of a new point whose leaf is full and cannot split. OCTREE_REFUSE, as in the paper: the tree refuses
 * the point with OCTREE_FULL. OCTREE_GROW, the default: the leaf grows beyond its capacity. */
typedef enum octree_full_leaf {
    OCTREE_REFUSE,
    OCTREE_GROW,
} octree_full_leaf;

/* The memory functions of a tree. `allocate` returns memory with the alignment of malloc, or null. `release` receives a
 * pointer that is not null, and the size that was requested from `allocate`. Setting only one of the two functions is
 * BAD_OPTION. The context must outlive the tree.
 *
 * Changes of a tree call the allocator from one thread at a time. octree_nearest_batch and octree_query_answer
 * (query.h) also allocate: a program that runs them on several threads at once needs a thread-safe allocator, such as
 * malloc. */
typedef struct octree_allocator {
    void *(*allocate)(size_t size, void *context);
    void (*release)(void *memory, size_t size, void *context);
    void *context;
} octree_allocator;

typedef void octree_task(size_t number, void *context);

/* The caller's threads. `run` calls the task once for each number below `count` (at most 64), on any threads and in any
 * order. It returns when all calls have returned; it must not call the task later. If `run` omits a number, the task
 * with this number runs on the calling thread. If `run` repeats a number, its task runs only once. A number >= count is
 * ignored. Inside `run`, changes of the tree on the calling thread return OCTREE_BUSY.
 *
 * Bulk changes, octree_nearest_batch, octree_digest and octree_check divide large work, of some thousand points or
 * more, into tasks. Nodes, statuses, answers and digests do not depend on the number of threads. Memory use may differ
 * slightly, because tasks compete for free blocks. Tasks call the allocator one at a time.
 *
 * A null function means that all work runs on the calling thread. The context must outlive the tree. */
typedef struct octree_executor {
    void (*run)(octree_task *task, size_t count, void *task_context, void *context);
    void *context;
} octree_executor;

/* The value of leaf_capacity with which the tree chooses its capacity itself, as octree_tune does: first when the tree
 * reaches 1024 points, then each time the number of points has doubled. The mix of operations (octree_mix) is the mix
 * that was last given to octree_tune, or the default mix. OCTREE_AUTO requires OCTREE_GROW, because a chosen capacity
 * must not cause the tree to refuse a point. The contents of the tree and the chosen capacity determine the nodes. */
#define OCTREE_AUTO (SIZE_MAX - 1)

/* Everything that defines an empty tree. Start from octree_def_default() and change some members. */
typedef struct octree_def {
    /* the bounds of all points: min < max on every axis; any finite doubles, +-DBL_MAX included */
    octree_box world;
    /* the number of points in a leaf above which the leaf splits; at least 1, clamped to 2^32 - 1; or OCTREE_AUTO */
    size_t leaf_capacity;
    size_t max_depth; /* the greatest depth of a node, clamped to OCTREE_MAX_DEPTH; 0: the root never splits */
    octree_full_leaf full_leaf; /* the treatment of points whose leaf is full and cannot split */
    octree_allocator allocator; /* the memory functions of the tree; null functions mean malloc and free */
    /* the caller's threads; a null function means that all work runs on the calling thread */
    octree_executor executor;
} octree_def;

/* A reader's position in a tree's change log. If all members are zero, the reader has read nothing yet. */
typedef struct octree_cursor {
    size_t log;        /* the number that identifies the log which the reader has read; 0: none */
    uint64_t position; /* the number of the first change that the reader has not read */
} octree_cursor;

/* ---- Queries ------------------------------------------------------------------------------------------------ */

/* The points that a search for neighbours of a target skips. */
typedef enum octree_skip {
    OCTREE_SKIP_NONE,       /* skip no point */
    OCTREE_SKIP_ID,         /* skip points with the id skip_id, such as the target's own point */
    OCTREE_SKIP_COINCIDENT, /* skip points whose coordinates equal the target's, as in the paper */
} octree_skip;

/* How distances are compared. EXACT compares distances as real numbers, FAST compares them as doubles. If two distances
 * differ by less than a rounding error, FAST may treat the farther point as the nearer one. FAST needs half the
 * instructions where many distances are equal and several neighbours are searched, as on a lattice. For other points
 * FAST is about as fast as EXACT. */
typedef enum octree_mode {
    OCTREE_EXACT,
    OCTREE_FAST,
} octree_mode;

/* The work of a query, as counts that are the same on every machine. A query adds its work to the counts, so that one
 * struct can sum the work of many queries. */
typedef struct octree_cost {
    uint64_t nodes;  /* the number of visited nodes, leaves included */
    uint64_t leaves; /* the number of visited leaves */
    uint64_t points; /* the number of points that were compared with the query one by one */
    /* the number of nodes that were skipped because their box is out of reach; their descendants are not counted */
    uint64_t pruned;
    /* the number of nodes whose box is inside the range, so that all their points match without comparison. The other
     * counts do not include these nodes, their descendants and their points */
    uint64_t taken;
} octree_cost;

/* What a query did with a node. */
typedef enum octree_trace_kind {
    OCTREE_TRACE_VISITED, /* the query examined the node's children, or its points one by one */
    OCTREE_TRACE_PRUNED,  /* the query skipped the node and all nodes below it, because its box is out of reach */
    OCTREE_TRACE_TAKEN,   /* the query accepted all points below the node without comparison, because its box is inside
                             the range */
    OCTREE_TRACE_KINDS
} octree_trace_kind;

/* A function that is called for each node that a query visits, prunes or takes whole. Changes of the tree inside the
 * tracer return OCTREE_BUSY. */
typedef void (*octree_tracer)(octree_address node, octree_trace_kind kind, void *context);

/* Options of a search. A struct whose members are all zero, or a null pointer instead of the options, means an exact
 * search that skips no point. */
typedef struct octree_search {
    octree_skip skip; /* the points to skip; read only by searches for neighbours, and those of bodies (bodies.h) */
    uint64_t skip_id; /* the id of the skipped points; read only with OCTREE_SKIP_ID */
    octree_mode mode; /* how distances are compared; boxes are compared exactly in both modes */
    /* the permitted error, finite and >= 0: a ratio for neighbours, a length for ranges; each search function explains
     * what epsilon means */
    double epsilon;
    octree_cost *cost;   /* the counts to which the work of the search is added; null: do not count */
    octree_tracer trace; /* the function to call for each node that the search reaches; null: do not trace */
    void *trace_context;
} octree_search;

typedef struct octree_neighbor {
    octree_point point;
    /* the Euclidean distance, within 4 ulp, computed without overflow or underflow. The distance is rounded, so a
     * search with this distance as its radius may miss this very point */
    double distance;
} octree_neighbor;

#endif
