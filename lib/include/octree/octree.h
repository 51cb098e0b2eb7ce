/* SPDX-License-Identifier: MIT */
/* octree.h - a dynamic point octree in double precision.
 *
 * The tree stores points (a position and the caller's 64-bit id) in a closed box, the world. A leaf that is full
 * splits into octants; octants that hold no more than one leaf's worth of points merge again. The nodes are a
 * function of the contents and the options: same points, same nodes, whatever the order of insertions and removals.
 *
 * Sources: the algorithms of "3D Spatial Partitioning and Collision Detection using Octrees", numbered below as
 * there (Algorithm 1 insert ... 7 nearest helper); D. Meagher, "Geometric Modeling Using Octree Encoding" (1982);
 * H. Samet, "Foundations of Multidimensional and Metric Data Structures" (2006).
 *
 * Conventions
 *   - Positions are arrays of three doubles in x, y, z order, in the caller's units. All boxes are closed.
 *   - Every function that can fail returns an octree_status; octree_status_text() gives its sentence. A mutation
 *     either happens or leaves the tree as it was, OCTREE_NO_MEMORY included.
 *   - Functions that take `const octree *` may run from many threads at once; a mutation must run alone.
 *   - D is the depth of the tree (at most 21), M the leaf capacity, n the number of points, k the number of results.
 *   - Answers rest on the default floating-point mode. Where the calling thread has another one (directed rounding, or
 *     subnormals flushed to zero), functions that compute with positions return OCTREE_FLOAT_MODE and do nothing
 *     (octree_digest returns 0, and octree_contains false).
 *   - -0.0 equals +0.0 in every comparison; the bits that were stored are kept.
 *   - Points that are given to a change may be the tree's own, such as those of a leaf (octree_node).
 */
#ifndef OCTREE_OCTREE_H
#define OCTREE_OCTREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One line per status: its name, the word that files use, and its sentence. */
#define OCTREE_STATUS_MAP(X)                                                                                           \
    X(OK, "ok", "done")                                                                                                \
    X(NOT_FOUND, "not_found", "no such point or node is in the tree")                                                  \
    X(DUPLICATE, "duplicate", "this id is taken: at the same position in a tree, anywhere in a game")                  \
    X(FULL, "full", "the leaf is full and cannot be split any further")                                                \
    X(OUTSIDE, "outside", "the position is outside the world")                                                         \
    X(NOT_FINITE, "not_finite", "a number is NaN or infinite")                                                         \
    X(NULL_ARGUMENT, "null_argument", "a required pointer is null")                                                    \
    X(BAD_WORLD, "bad_world", "the world must have finite corners with min below max on every axis")                   \
    X(BAD_CAPACITY, "bad_capacity", "the leaf capacity must be at least 1; OCTREE_AUTO needs OCTREE_GROW")             \
    X(BAD_RANGE, "bad_range", "the box's min is above its max")                                                        \
    X(BAD_SIZE, "bad_size", "a size must not be negative")                                                             \
    X(BAD_KEY, "bad_key", "the key is not one of w a s d e f n q .")                                                   \
    X(BAD_OPTION, "bad_option", "an enumeration has an unlisted value, or one allocator function lacks the other")     \
    X(BAD_TEXT, "bad_text", "a text must be printable ASCII that ends within its room")                                \
    X(BAD_ORDER, "bad_order", "edits, queries and shapes must be in ascending order of their ticks")                   \
    X(BAD_PARENT, "bad_parent", "a node of the program's tree is its own ancestor")                                    \
    X(FLOAT_MODE, "float_mode", "the thread's floating-point mode is not the default: nearest rounding, subnormals")   \
    X(NO_MEMORY, "no_memory", "the allocator returned null")                                                           \
    X(TOO_MANY, "too_many", "the tree holds 4294967295 points, which is its limit")

typedef enum octree_status {
#define OCTREE_STATUS_ENUM(name, word, text) OCTREE_##name,
    OCTREE_STATUS_MAP(OCTREE_STATUS_ENUM)
#undef OCTREE_STATUS_ENUM
        OCTREE_STATUS_COUNT
} octree_status;

/* The sentence for a status, without a final stop. Never null; static storage. */
const char *octree_status_text(octree_status status);

/* The status in one word, such as "not_found": for files that programs read. Never null; static storage. */
const char *octree_status_name(octree_status status);

/* The deepest level of a node. The root is at depth 0; an address of 21 octants fits 64 bits. */
#define OCTREE_MAX_DEPTH 21

/* A node's address: a leading 1 bit, then three bits an octant from the root down (Morton order). The root is 1. */
typedef uint64_t octree_address;
#define OCTREE_ROOT ((octree_address)1)

typedef struct octree octree;

/* A closed axis-aligned box. */
typedef struct octree_box {
    double min[3];
    double max[3];
} octree_box;

/* A stored point. Ids need not be unique; a pair (position, id) is. */
typedef struct octree_point {
    double position[3];
    uint64_t id;
} octree_point;

/* What happens when a point meets a full leaf that cannot be split: the paper's refusal, or a leaf beyond its capacity.
 */
typedef enum octree_full_leaf {
    OCTREE_REFUSE,
    OCTREE_GROW,
} octree_full_leaf;

/* Where a tree takes its memory. `allocate` returns memory aligned as malloc's, or null. `release` is told the size
 * that was asked for, and is never given null. One without the other is BAD_OPTION. The context must outlive the tree.
 * A tree calls it from one thread at a time; but octree_nearest_batch and, of a game, octree_query_answer, which may
 * run from many threads at once, take memory in each: where they do, it must be safe for threads, as malloc is. */
typedef struct octree_allocator {
    void *(*allocate)(size_t size, void *context);
    void (*release)(void *memory, size_t size, void *context);
    void *context;
} octree_allocator;

typedef void octree_task(size_t number, void *context);

/* Threads of the caller's: `run` calls the task once with each number below `count`, at most 64, on any threads and in
 * any order, and returns when all have returned. Bulk changes, octree_nearest_batch, octree_digest and octree_check of
 * some thousand points and more are divided into tasks; nodes, statuses, answers and digests are the same for any
 * number of threads, and how much memory is taken nearly so: which task takes free blocks first is chance. Tasks call
 * the allocator, one at a time. Null: the calling thread. The context outlives the tree.
 */
typedef struct octree_executor {
    void (*run)(octree_task *task, size_t count, void *task_context, void *context);
    void *context;
} octree_executor;

/* The leaf capacity is chosen by octree_tune, with the default mix or the last one it was given: when a tree has 1024
 * points and then whenever it has twice as many as the last time. Under OCTREE_GROW alone: what a leaf refuses must not
 * depend on a choice. The nodes then follow from the contents and from the capacity in force. */
#define OCTREE_AUTO (SIZE_MAX - 1)

/* All that defines an empty tree. Start from octree_def_default() and change what you need. */
typedef struct octree_def {
    octree_box world;     /* min < max on every axis; any finite doubles, ±DBL_MAX included */
    size_t leaf_capacity; /* points a leaf holds before it splits; at least 1, clamped to 2^32 - 1; or OCTREE_AUTO */
    size_t max_depth;     /* clamped to OCTREE_MAX_DEPTH; 0 keeps the root a leaf */
    octree_full_leaf full_leaf; /* what a full leaf at the maximum depth does */
    octree_allocator allocator; /* null functions mean malloc and free */
    octree_executor executor;   /* a null function means the calling thread */
} octree_def;

/* World [-1000, 1000]^3, capacity 64, depth 21, OCTREE_REFUSE, malloc, the calling thread. */
octree_def octree_def_default(void);

/* Make an empty tree into *tree. The definition is copied.
 * Errors: NULL_ARGUMENT, BAD_WORLD, BAD_CAPACITY, BAD_OPTION, NO_MEMORY; *tree is then null. Cost: O(1). */
octree_status octree_create(const octree_def *def, octree **tree);

/* Free the tree and all of its memory. Null is allowed. Cost: O(memory blocks). */
void octree_destroy(octree *tree);

/* Remove every point; the memory goes back to the allocator. Cost: O(memory blocks). */
octree_status octree_clear(octree *tree);

/* The definition in force, after clamping; under OCTREE_AUTO with the capacity that was chosen. For null the default.
 */
octree_def octree_definition(const octree *tree);

/* What a tree is asked, in shares of which only the ratios matter. */
typedef struct octree_mix {
    double changes; /* insertions, removals and finds; a move is two */
    double nearest; /* searches for the k nearest */
    size_t k;
    double ranges; /* boxes, balls, collisions */
    size_t hits;   /* points that a range finds, on average */
} octree_mix;

/* As many changes as searches for the nearest point as ranges of 10 points. */
octree_mix octree_mix_default(void);

/* Choose the leaf capacity, a power of two from 4 to 256, for the points in the tree and a mix (null: the default one),
 * and divide the leaves anew. Each capacity is tried on a sample of whole cells with 128 operations of each kind of the
 * mix, and what they visited is weighed; nothing is timed, so that the choice is the same on every machine.
 * Errors: NULL_ARGUMENT, BAD_CAPACITY (the tree is under OCTREE_REFUSE), NOT_FINITE and BAD_SIZE (a share; all of them
 * zero), NO_MEMORY; the tree is then unchanged. Cost: seven bulk builds of at most some 40,000 points, and one of all.
 */
octree_status octree_tune(octree *tree, const octree_mix *mix);

/* ---- Change ------------------------------------------------------------------------------------------------- */

/* Algorithm 1. Insert a point. Cost: O(D + M); under OCTREE_AUTO that of octree_tune where the tree has doubled.
 * Errors: NULL_ARGUMENT, NOT_FINITE, OUTSIDE, DUPLICATE (same position and id), FULL (under OCTREE_REFUSE),
 * NO_MEMORY, TOO_MANY; the tree is then unchanged. */
octree_status octree_insert(octree *tree, const double position[3], uint64_t id);

/* Algorithm 2. Remove the point with this position and id; nodes that now fit one leaf merge. Cost: O(D + M).
 * Errors: NULL_ARGUMENT, NOT_FINITE, OUTSIDE, NOT_FOUND, NO_MEMORY (a merge needs a new leaf); unchanged then. */
octree_status octree_remove(octree *tree, const double position[3], uint64_t id);

/* Move a point. As if removed and inserted, but it either arrives or stays; within one leaf it always succeeds
 * (but for DUPLICATE). Cost: O(D + M). Errors: those of insert for `to` and of remove for `from`. */
octree_status octree_move(octree *tree, const double from[3], uint64_t id, const double to[3]);

/* Insert many points in one restructuring, in Morton order; into an empty tree this is a bulk build. The result is that
 * of octree_insert one after the other: where a leaf refuses, the first in input order are taken. statuses[i] (may be
 * null) receives what octree_insert would have returned for points[i], and *inserted (may be null) the number of OKs.
 * Errors: NULL_ARGUMENT, TOO_MANY, NO_MEMORY; the tree is then unchanged, and the statuses are undefined.
 * Cost: that of single insertions, some dozens of leaves loaded at once, where fewer than a twentieth of the stored
 * points arrive, an eighth of less than 300,000; of more O(count + points of the leaves touched), half of that where
 * points are spread evenly and their ids ascend, and some fifty bytes a point while it runs. */
octree_status octree_insert_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *inserted);

/* Remove many points at once. statuses[i] (may be null) receives what octree_remove would have returned for points[i],
 * and *removed (may be null) the number of OKs. Errors: NULL_ARGUMENT, TOO_MANY, NO_MEMORY; the tree is then unchanged,
 * and the statuses are undefined. Cost: as octree_insert_many. */
octree_status octree_remove_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *removed);

/* Move many points in one restructuring: the pair points[i] to position to[i], as octree_move one after the other in
 * the order given. statuses[i] (may be null) receives what octree_move would have returned, and *moved (may be null)
 * the number of OKs. Errors: NULL_ARGUMENT, TOO_MANY, NO_MEMORY; the tree is then unchanged, and the statuses are
 * undefined. Cost: of fewer than a fifth as many moves as points are stored (three tenths where those are not spread
 * evenly, or under OCTREE_REFUSE with a depth below 13) as octree_remove_many, and a point that stays in its leaf is
 * written in place; of more one look at all points and a bulk build, some 90 to 140 bytes a point while it runs. Where
 * an id comes twice in a batch or among the stored points, where a pair would be there twice, and where a leaf may be
 * full under OCTREE_REFUSE, the moves are first followed one by one in a hash table, with some 250 bytes a move. */
octree_status octree_move_many(octree *tree, const octree_point *points, const double (*to)[3], size_t count,
                               octree_status *statuses, size_t *moved);

/* Give the tree another world, with the same points and options. Errors: NULL_ARGUMENT, BAD_WORLD, OUTSIDE (a point
 * would be outside), FULL (a point would be refused), NO_MEMORY; the tree is then unchanged. Cost: a bulk build. */
octree_status octree_reworld(octree *tree, const octree_box *world);

/* Rebuild the tree as a bulk build does, and return its unused memory to the allocator. After many changes the leaves
 * are scattered, and freed memory is kept for later insertions: then this halves the memory or makes queries faster.
 * Nodes and answers stay the same. Errors: NULL_ARGUMENT, NO_MEMORY; the tree is then unchanged. Cost: a bulk build. */
octree_status octree_compact(octree *tree);

/* ---- Follow ------------------------------------------------------------------------------------------------- */

typedef enum octree_change_kind { OCTREE_INSERTED, OCTREE_REMOVED, OCTREE_MOVED } octree_change_kind;

/* A change that was made. */
typedef struct octree_change {
    octree_change_kind kind;
    uint64_t id;
    double from[3], to[3]; /* by value; 0 where there is none */
} octree_change;

/* Where somebody has got to in the changes of a tree. All zero: nowhere yet. */
typedef struct octree_mark {
    size_t log;
    uint64_t at;
} octree_mark;

typedef void (*octree_change_visitor)(const octree_change *change, void *context);

/* Visit the changes of the contents since a mark was set, in the order in which they were made, those of a batch in the
 * order given, and set the mark to now. False, with nothing visited, where they are not known: then look at the whole
 * tree; from the new mark on the tree keeps its changes, so that the next call can tell them. They are not known with a
 * mark that is zero or another tree's; after octree_clear, octree_tune, octree_reworld and octree_compact; when memory
 * was short; and when they were more than a quarter of the points (or 1024) since anybody asked: the tree then keeps
 * none until it is asked again. `name` is that of the log where the tree has none yet: not 0, and one that was never
 * given before, say the next of a series that starts at random; it tells a tree from others, and from one that comes to
 * its address later.
 *
 * A tree that nobody asks keeps nothing. It may be asked beside queries and from many threads, each with a mark of its
 * own. False for null. Cost: O(changes visited); of a change that is kept 64 bytes, up to four times as many while it
 * grows, and some nanoseconds. */
bool octree_changes_since(const octree *tree, size_t name, octree_mark *mark, octree_change_visitor visit,
                          void *context);

/* ---- Ask ---------------------------------------------------------------------------------------------------- */

/* Called with each point that answers a query. The point is owned by the tree and valid during the call. Return
 * true to go on, false to stop. The visitor must not change the tree. */
typedef bool (*octree_point_visitor)(const octree_point *point, void *context);

/* Algorithm 3. Find by coordinates: *id (may be null) receives the lowest id stored at exactly this position.
 * Errors: NULL_ARGUMENT, NOT_FINITE, OUTSIDE, NOT_FOUND. Cost: O(D + M). */
octree_status octree_find(const octree *tree, const double position[3], uint64_t *id);

/* True when the pair (position, id) is stored; false in another floating-point mode than the default. Cost: O(D + M).
 */
bool octree_contains(const octree *tree, const double position[3], uint64_t id);

/* Which points do not count as neighbours of a target. */
typedef enum octree_skip {
    OCTREE_SKIP_NONE,       /* every point counts */
    OCTREE_SKIP_ID,         /* leave out points with the given id: "not the target itself" */
    OCTREE_SKIP_COINCIDENT, /* leave out points at the target's coordinates: the paper's rule */
} octree_skip;

/* What distances are decided by: the real numbers, or doubles alone. */
typedef enum octree_mode {
    OCTREE_EXACT,
    OCTREE_FAST,
} octree_mode;

/* What a query did, in counts that are the same on every machine. Counts are added to, so that one report can take in
 * many queries. */
typedef struct octree_cost {
    uint64_t nodes;  /* visited, leaves included */
    uint64_t leaves; /* visited */
    uint64_t points; /* compared with the query one by one */
    uint64_t pruned; /* nodes left out by their box, with all below them */
    uint64_t taken;  /* nodes taken whole, with all below them: these are in no other count */
} octree_cost;

/* How a query met a node. */
typedef enum octree_touch {
    OCTREE_TOUCH_VISITED, /* its children or its points were looked at one by one */
    OCTREE_TOUCH_PRUNED,  /* left out by its box, with all below it */
    OCTREE_TOUCH_TAKEN,   /* its box is inside the range: all below it was taken without looking */
    OCTREE_TOUCH_KINDS
} octree_touch;

/* Called with each node that a query met. It must not change the tree. */
typedef void (*octree_tracer)(octree_address node, octree_touch touch, void *context);

/* How a query is answered: what trades accuracy for speed. All zero, which is also what a null pointer stands for, is
 * exact and counts every point. */
typedef struct octree_search {
    octree_skip skip;    /* nearest neighbours only */
    uint64_t skip_id;    /* read under OCTREE_SKIP_ID alone */
    octree_mode mode;    /* distances only; boxes are exact in both modes */
    double epsilon;      /* finite, >= 0; for neighbours a ratio, for ranges a length: see each function */
    octree_cost *cost;   /* null: not counted */
    octree_tracer trace; /* null: not traced */
    void *trace_context;
} octree_search;

/* Algorithm 4. Visit every point in a closed box, in no stated order. The box may reach beyond the world; infinite
 * corners are allowed. Errors: NULL_ARGUMENT, NOT_FINITE (a NaN), BAD_RANGE (min > max).
 * Cost: O(nodes that meet the box + points in those leaves). */
octree_status octree_range(const octree *tree, const octree_box *box, octree_point_visitor visit, void *context);

/* The same with a choice of accuracy. With epsilon > 0 nothing in the box is missed, and nothing is visited that is
 * farther than epsilon outside it on any axis. Proof: a node is taken whole only when its cell lies in the box whose
 * faces are moved out by epsilon and rounded inwards; every other point is compared with the box itself.
 * Errors: those of octree_range, and BAD_SIZE (epsilon < 0), NOT_FINITE, BAD_OPTION. */
octree_status octree_range_search(const octree *tree, const octree_box *box, const octree_search *how,
                                  octree_point_visitor visit, void *context);

/* The number of points in a closed box, into *count, which is 0 on an error. Errors and cost as octree_range; nodes
 * inside the box are counted without being entered. */
octree_status octree_range_count(const octree *tree, const octree_box *box, size_t *count);

/* Visit every point at a distance of at most `radius` from a centre, in no stated order. The centre may be outside the
 * world. With epsilon > 0 nothing within `radius` is missed and nothing beyond radius + epsilon is visited. In FAST
 * mode both hold for distances that are off by a factor of at most 1 + 2^-50, or by 2^-490 of the world's extent.
 * Errors: NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (radius or epsilon < 0), BAD_OPTION.
 * Cost: O(nodes that meet the ball + points in those leaves). */
octree_status octree_radius(const octree *tree, const double center[3], double radius, const octree_search *how,
                            octree_point_visitor visit, void *context);

/* The points in a closed box into points[0 .. room - 1], in no stated order. *count receives how many there are, 0 on
 * an error; where that is more than `room`, the rest is left out. Errors and cost as octree_range_search. */
octree_status octree_range_collect(const octree *tree, const octree_box *box, const octree_search *how,
                                   octree_point *points, size_t room, size_t *count);

/* The same, sorted by id and then by position. Where there are more than `room`, the first `room` of them in that
 * order. */
octree_status octree_range_collect_sorted(const octree *tree, const octree_box *box, const octree_search *how,
                                          octree_point *points, size_t room, size_t *count);

/* Algorithm 5. Visit every point p with |p - center| <= box_size on each axis, decided by the real numbers and not by
 * rounded sums. The tree is not changed (the paper inserts the moving point and takes it out again, which fails when
 * its leaf is full): `self`, which may be null, is the one pair (position, id) to leave out.
 * Errors: NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (box_size < 0). Cost: as octree_range. */
octree_status octree_collide(const octree *tree, const double center[3], double box_size, const octree_point *self,
                             octree_point_visitor visit, void *context);

/* The same with a choice of accuracy, a count of its cost and a trace: with epsilon > 0 nothing within box_size is
 * missed, and nothing is visited that is farther than box_size + epsilon on any axis.
 * Errors: those of octree_collide and of octree_range_search. */
octree_status octree_collide_search(const octree *tree, const double center[3], double box_size,
                                    const octree_point *self, const octree_search *how, octree_point_visitor visit,
                                    void *context);

/* Collision on the way: visit every point that the box position +- box_size touches somewhere between two places, both
 * included, decided by the real numbers. Nothing is missed, however long the step is; a test at both ends alone is sure
 * to miss nothing only where the step is at most 2 * box_size along one axis. `self` as in octree_collide; the answer
 * is exact whatever `how` says. Errors: as octree_collide_search. Cost: O(nodes that the box touches on its way +
 * points in those leaves). */
octree_status octree_collide_swept(const octree *tree, const double from[3], const double to[3], double box_size,
                                   const octree_point *self, const octree_search *how, octree_point_visitor visit,
                                   void *context);

/* The box that octree_collide asks for: the smallest and largest doubles within box_size of the centre. Errors:
 * NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (box_size < 0); *box is then unchanged. Cost: O(1). */
octree_status octree_collision_box(const double center[3], double box_size, octree_box *box);

typedef struct octree_neighbor {
    octree_point point;
    double distance; /* Euclidean, within 4 ulp, without overflow or underflow on the way. As a radius it may be short
                        of its own point: that is decided by the real numbers */
} octree_neighbor;

/* Algorithms 6 and 7. The nearest point to any finite target, inside the world or not: the true minimum of the real
 * distance (not of a rounded one), ties to the lowest id. `skip_id` is read under OCTREE_SKIP_ID alone.
 * Errors: NULL_ARGUMENT, NOT_FINITE, BAD_OPTION, NOT_FOUND (nothing but what is skipped).
 * Cost: O(D + M) on average for points of bounded density, O(n) at worst. */
octree_status octree_nearest(const octree *tree, const double target[3], octree_skip skip, uint64_t skip_id,
                             octree_neighbor *nearest);

/* The k nearest points into neighbors[0 .. *count - 1], *count = min(k, points that count): by distance, then by id,
 * then by position. There must be room for that many; null will do for k = 0. *count is 0 on an error. Each is the true
 * one, by the real numbers; the i-th distance in FAST mode is at most 1 + 2^-50 times the true i-th, or 2^-490 of the
 * world's extent more. With epsilon > 0 it is at most (1 + epsilon) times the true i-th. Proof: a node is left out only
 * when its box is farther than the k-th best found, divided by 1 + epsilon; so is then all that is in it, and the best
 * found only get nearer. Errors: NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (epsilon < 0), BAD_OPTION. k = 0 and an empty tree
 * give none. Cost: O(D + M + k log k) on average for points of bounded density, O(n log k) at worst. */
octree_status octree_nearest_k(const octree *tree, const double target[3], size_t k, const octree_search *how,
                               octree_neighbor *neighbors, size_t *count);

/* The nearest point of each of `count` targets, rows of three doubles, into neighbors[i]; found[i] (may be null) tells
 * whether there is one, and neighbors[i] is untouched where there is none. The targets are asked in Morton order, so
 * that those close by share what is in the cache. Errors: as octree_nearest_k, TOO_MANY and NO_MEMORY; a target that is
 * not finite is NOT_FINITE before anything is written. Cost: `count` searches, and 32 bytes a target while it runs. */
octree_status octree_nearest_batch(const octree *tree, const double (*targets)[3], size_t count,
                                   const octree_search *how, octree_neighbor *neighbors, bool *found);

/* The nearest point at a distance of at most `radius`, decided by the real numbers (in FAST mode as octree_radius
 * does); epsilon as in octree_nearest_k. Errors: those of octree_nearest_k, BAD_SIZE for a negative radius, and
 * NOT_FOUND. */
octree_status octree_nearest_within(const octree *tree, const double target[3], double radius, const octree_search *how,
                                    octree_neighbor *nearest);

/* For qsort: by id, then by position; the order of "sorted" results. */
int octree_compare_points(const void *a, const void *b);

/* ---- Look --------------------------------------------------------------------------------------------------- */

/* One node as the tree sees it. `points` holds a leaf's points, in no stated order, and is null for inner nodes and for
 * the root of an empty tree; it is owned by the tree and valid until the next change. */
typedef struct octree_node {
    octree_address address;
    unsigned depth;
    bool leaf;
    uint8_t octants; /* bit i is set when octant i is occupied; 0 for a leaf */
    octree_box box;  /* its faces are the planes that insertion compares with */
    size_t count;    /* points in and below this node */
    const octree_point *points;
} octree_node;

typedef enum octree_walk_order {
    OCTREE_WALK_ON,   /* go on, into this node's children first */
    OCTREE_WALK_SKIP, /* go on, but not into this node */
    OCTREE_WALK_STOP,
} octree_walk_order;

typedef octree_walk_order (*octree_node_visitor)(const octree_node *node, void *context);

/* Visit the nodes in pre-order, children by octant: ascending Morton order within a level. Only occupied octants
 * have nodes; an empty tree has its root. Errors: NULL_ARGUMENT. Cost: O(nodes). */
octree_status octree_walk(const octree *tree, octree_node_visitor visit, void *context);

/* The node at an address, into *node. Errors: NULL_ARGUMENT, NOT_FOUND. Cost: O(D). */
octree_status octree_node_at(const octree *tree, octree_address address, octree_node *node);

/* The leaf in whose cell a position lies or would be inserted. When its octant is not occupied, the deepest node on
 * the way. Errors: NULL_ARGUMENT, NOT_FINITE, OUTSIDE. Cost: O(D). */
octree_status octree_locate(const octree *tree, const double position[3], octree_node *node);

typedef struct octree_stats {
    size_t points;
    size_t nodes;
    size_t leaves;
    unsigned depth;      /* of the deepest node */
    size_t largest_leaf; /* points in the fullest leaf */
    size_t nodes_at_depth[OCTREE_MAX_DEPTH + 1];
    size_t leaves_at_depth[OCTREE_MAX_DEPTH + 1];
    size_t memory; /* bytes taken from the allocator and not yet given back */
} octree_stats;

/* Count the nodes. Errors: NULL_ARGUMENT. Cost: O(nodes). */
octree_status octree_statistics(const octree *tree, octree_stats *stats);

/* The number of points, in O(1); 0 for null. */
size_t octree_count(const octree *tree);

/* A number that changes with every change of the contents: to know that nothing happened. 0 for null. */
uint64_t octree_version(const octree *tree);

/* A digest of the world, the nodes and the points, the same for the same contents and options whatever the order of
 * changes, on every machine; under OCTREE_AUTO also of the capacity in force, by which the nodes follow from them.
 * 0 for null. Cost: O(nodes + n). */
uint64_t octree_digest(const octree *tree);

/* Walk every invariant: counts add up, leaves hold their points, no leaf is over its capacity that could split, no
 * inner node would fit a leaf, no pair is stored twice. Null when all hold, else a sentence that names the first one
 * that does not, in static storage; *where (may be null) is the node. Cost: O(nodes + n * M). */
const char *octree_check(const octree *tree, octree_address *where);

/* ---- Addresses and planes ----------------------------------------------------------------------------------- */

/* Depth of a valid address: the number of its octants. Cost: O(1). */
unsigned octree_address_depth(octree_address address);

/* Octant (0..7) that an address takes at level 0..depth-1: (x >= cx ? 4 : 0) + (y >= cy ? 2 : 0) + (z >= cz ? 1 : 0).
 */
unsigned octree_address_octant(octree_address address, unsigned level);

/* The longest text of an address, with its final zero. */
#define OCTREE_ADDRESS_TEXT 48

/* "root" for the root, else the octants from the root down, as in "0/3/7". Returns `text`. */
char *octree_address_format(octree_address address, char text[OCTREE_ADDRESS_TEXT]);

/* The inverse: "root", "/" or octants with slashes between. False when the text is none of these. */
bool octree_address_parse(const char *text, octree_address *address);

/* The box of the cell at an address in a world, whether or not a node is there. The plane at k/2^d of an axis is a
 * closed form that is monotone in k and never overflows; where its steps are exact, as in [-1000, 1000], it is the
 * paper's (min + max) / 2. Cost: O(D). */
octree_box octree_cell_box(const octree_box *world, octree_address address);

#ifdef __cplusplus
}
#endif

#endif
