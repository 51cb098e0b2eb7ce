/* SPDX-License-Identifier: MIT */
/* octree.h - a dynamic point octree in double precision.
 *
 * The tree stores points (a position and the caller's 64-bit id) in a closed box, the world. A full leaf splits into
 * octants. Leaves that together hold no more points than the leaf capacity merge. The nodes are a function of the
 * contents and the options: the same points give the same nodes, whatever the order of insertions and removals.
 *
 * Sources: the algorithms of "3D Spatial Partitioning and Collision Detection using Octrees", by their numbers there
 * (Algorithm 1 insert ... 7 nearest helper); D. Meagher, "Geometric Modeling Using Octree Encoding" (1982);
 * H. Samet, "Foundations of Multidimensional and Metric Data Structures" (2006).
 *
 * Conventions
 *   - Positions are arrays of three doubles in x, y, z order, in the caller's units. All boxes are closed.
 *   - Every function that can fail returns an octree_status; octree_status_text() returns a sentence for it. A change
 *     happens completely or leaves the tree as it was, even if memory runs out.
 *   - Functions that take `const octree *` may run on many threads at once. While a function changes a tree, no other
 *     function may use the tree.
 *   - Visitors, tracers and executors may query the tree, but must not change it: on their thread every change of the
 *     tree returns OCTREE_BUSY and does nothing, and octree_destroy does nothing. They must return normally: after
 *     longjmp or a C++ exception, changes on this thread may stay refused.
 *   - D is the depth of the tree (at most 21), M the leaf capacity, n the number of points, k the number of results.
 *   - Answers are the same in every floating-point mode of the calling thread: with subnormals flushed to zero, with
 *     directed rounding, in a program linked with -ffast-math. A function sets the default mode and restores the
 *     caller's mode (some 10 ns). Visitors, tracers, allocators and executors run in the caller's mode and must not
 *     change it. Tasks run in the default mode, whatever mode the executor's threads have.
 *   - -0.0 equals +0.0 in every comparison; stored coordinates keep their bits.
 *   - The points and destinations passed to a change may lie in the tree's own memory, such as the points of an
 *     octree_node.
 */
#ifndef OCTREE_OCTREE_H
#define OCTREE_OCTREE_H

#include "octree/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the sentence of a status, without a final full stop. Never null; static storage. */
const char *octree_status_text(octree_status status);

/* Returns the name of a status as one word, such as "not_found", for files that programs read. Never null; static
 * storage. */
const char *octree_status_name(octree_status status);

/* Returns the default definition: world [-1000, 1000]^3, capacity 64, depth 21, OCTREE_GROW, malloc and free, no other
 * threads. */
octree_def octree_def_default(void);

/* Create an empty tree in *tree. The definition is copied.
 * Errors: NULL_ARGUMENT, BAD_WORLD, BAD_CAPACITY, BAD_OPTION, NO_MEMORY, BAD_BUILD (the library was compiled so that
 * its answers would be wrong); *tree is then null. Cost: O(1). */
octree_status octree_create(const octree_def *def, octree **tree);

/* Free the tree and all of its memory. The tree may be null. Does nothing inside a visitor, tracer or task of the tree.
 * Cost: O(memory blocks). */
void octree_destroy(octree *tree);

/* Remove every point and release the memory of the nodes. Errors: NULL_ARGUMENT. Cost: O(memory blocks). */
octree_status octree_clear(octree *tree);

/* Returns the tree's definition with clamped values. Under OCTREE_AUTO the definition contains the capacity that was
 * chosen last. Returns the default definition for null. */
octree_def octree_definition(const octree *tree);

/* The relative frequencies of the operations on a tree. Only their ratios matter. */
typedef struct octree_mix {
    double changes; /* the share of insertions, removals and finds; a move counts as two of them */
    double nearest; /* the share of searches for the k nearest points */
    size_t k;
    double ranges; /* the share of searches in boxes and balls, and of collision tests */
    size_t hits;   /* the average number of points that a range search finds */
} octree_mix;

/* Returns the default mix: equal shares of changes, of searches for the nearest point, and of range searches with 10
 * hits. */
octree_mix octree_mix_default(void);

/* Choose the leaf capacity, a power of two from 4 to 256, and rebuild the leaves. The choice depends on the points in
 * the tree and on the mix of operations; if `mix` is null, it is the default mix.
 *
 * Each capacity is tried on a sample of whole cells, with 128 operations of each kind in the mix. The capacity with the
 * least weighted count of visited nodes and points is chosen. Nothing is timed, so the choice is the same on every
 * machine. A tree without points gets the capacity 64.
 *
 * Errors: NULL_ARGUMENT, BAD_CAPACITY (the tree is under OCTREE_REFUSE), NOT_FINITE, BAD_SIZE (a negative share, or all
 * shares zero), NO_MEMORY; the tree is then unchanged.
 *
 * Cost: seven bulk builds of at most about 40,000 points, and one of all points. */
octree_status octree_tune(octree *tree, const octree_mix *mix);

/* ---- Change ------------------------------------------------------------------------------------------------- */

/* Algorithm 1. Insert a point. Cost: O(D + M); under OCTREE_AUTO, also the cost of octree_tune each time the number of
 * points has doubled. Errors: NULL_ARGUMENT, NOT_FINITE, OUTSIDE, DUPLICATE (same position and id), FULL (under
 * OCTREE_REFUSE), NO_MEMORY, TOO_MANY; the tree is then unchanged. */
octree_status octree_insert(octree *tree, const double position[3], uint64_t id);

/* Algorithm 2. Remove the point with this position and id. Nodes whose points now fit one leaf merge. Cost: O(D + M).
 * Errors: NULL_ARGUMENT, NOT_FINITE, OUTSIDE, NOT_FOUND, NO_MEMORY (a merge must allocate a leaf); the tree is then
 * unchanged. */
octree_status octree_remove(octree *tree, const double position[3], uint64_t id);

/* Move a point. The result is the same as that of a removal and an insertion. On an error the point stays where it was.
 * A move within one leaf can fail only with DUPLICATE. Cost: O(D + M). Errors: those of octree_insert for `to` and of
 * octree_remove for `from`. */
octree_status octree_move(octree *tree, const double from[3], uint64_t id, const double to[3]);

/* Insert many points at once; into an empty tree this is a bulk build. The result is the same as calling octree_insert
 * for each point in the given order: a full leaf that refuses points keeps the first points. statuses[i] receives the
 * status of points[i], and *inserted the number of points with the status OK. `statuses` and `inserted` may be null.
 *
 * Errors: NULL_ARGUMENT, TOO_MANY, NO_MEMORY; the tree is then unchanged, and the statuses are undefined.
 *
 * Cost: for fewer points than a twentieth of the stored points (an eighth if fewer than 300,000 points are stored), the
 * cost of single insertions, but several leaves are loaded from memory at once. For more, O(count + points of the
 * changed leaves) time and about fifty bytes a point during the call. The time is half of that if points are spread
 * evenly and their ids ascend.
 */
octree_status octree_insert_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *inserted);

/* Remove many points at once, with the same result as calling octree_remove for each point in the given order.
 * statuses[i] receives the status of points[i], and *removed the number of points with the status OK. `statuses` and
 * `removed` may be null.
 *
 * Errors: NULL_ARGUMENT, TOO_MANY, NO_MEMORY; the tree is then unchanged, and the statuses are undefined. Cost: as
 * octree_insert_many. */
octree_status octree_remove_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *removed);

/* Replace all points of the tree by these points. The result is the same as that of octree_clear and
 * octree_insert_many, but on an error the tree is unchanged. The points may be those of an octree_node of the tree. For
 * a simulation in which nearly all points move at each step, this is the fastest change: no point is looked up.
 *
 * statuses[i] receives the status of points[i], and *inserted the number of points with the status OK. `statuses` and
 * `inserted` may be null. Errors: NULL_ARGUMENT, TOO_MANY, NO_MEMORY, BUSY. The change log is discarded, as by
 * octree_clear.
 *
 * Cost: that of building the tree by octree_insert_many (octree-bench --op frame_100%). Old and new points are in
 * memory at the same time. */
octree_status octree_replace_all(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *inserted);

/* Move many points at once: points[i] to position to[i], with the same result as calling octree_move for each point in
 * the given order. statuses[i] receives the status of points[i], and *moved the number of points with the status OK.
 * `statuses` and `moved` may be null.
 *
 * Errors: NULL_ARGUMENT, TOO_MANY, NO_MEMORY; the tree is then unchanged, and the statuses are undefined.
 *
 * Cost: if less than a sixteenth of the points move (three tenths if fewer than 30,000 points are stored), the cost of
 * single moves, but several leaves are loaded from memory at once; above 32 moves, about 90 bytes a move during the
 * call. For more moves, as octree_remove_many. For three tenths of the points or more, one pass over all points and a
 * bulk build, with 90 to 140 bytes a point during the call.
 *
 * Measured with 1e3 to 1e6 points (octree-bench --op move_1%,move_5%,move_20%,move_30%,move_50%,move_100%): for 1 to 20
 * % of the points, a call takes 0.6 to 1.15 of the time of a loop of octree_move; for 30, 50 and 100 % at most 0.8, 0.5
 * and 0.35. Calls of 2 to 200 moves take 0.6 to 1.1 of the time of the loop. The first call takes up to twice as long
 * as later calls, because its memory is new: with 1e4 points up to 1.8 of the time of the loop, with 1e6 points less
 * than the loop.
 *
 * In a batch too large for single moves, moves may depend on one another: an id occurs twice in the batch or among the
 * stored points, a pair (position, id) would occur twice, or a leaf may be full under OCTREE_REFUSE. Such a batch is
 * first simulated move by move in a hash table, with about 250 bytes a move. */
octree_status octree_move_many(octree *tree, const octree_point *points, const double (*to)[3], size_t count,
                               octree_status *statuses, size_t *moved);

/* Give the tree another world. Points and options stay the same. Errors: NULL_ARGUMENT, BAD_WORLD, OUTSIDE (a point
 * would be outside), FULL (a point would be refused), NO_MEMORY; the tree is then unchanged. Cost: a bulk build. */
octree_status octree_reworld(octree *tree, const octree_box *world);

/* Rebuild the tree as a bulk build does, and release unused memory. Many changes scatter the leaves in memory, and
 * leave freed blocks for later insertions. octree_compact then makes queries faster, or halves the memory. Nodes and
 * answers stay the same. Errors: NULL_ARGUMENT, NO_MEMORY; the tree is then unchanged. Cost: a bulk build. */
octree_status octree_compact(octree *tree);

/* ---- Follow ------------------------------------------------------------------------------------------------- */

typedef enum octree_change_kind { OCTREE_INSERTED, OCTREE_REMOVED, OCTREE_MOVED } octree_change_kind;

/* A change of a point of a tree. */
typedef struct octree_change {
    octree_change_kind kind;
    uint64_t id;
    double from[3], to[3]; /* the positions before and after the change, bit for bit as stored. `from` of an insertion
                              and `to` of a removal are 0 */
} octree_change;

/* A function that is called with each change since a cursor. The change is valid during the call. Changes of the tree
 * inside the visitor return OCTREE_BUSY. */
typedef void (*octree_change_visitor)(const octree_change *change, void *context);

/* Visit the changes since the cursor, in the order in which they were made, and advance the cursor past the last
 * change. The changes of a batch have the order of the batch. Returns true if the changes since the cursor were known
 * and visited.
 *
 * Returns false if the changes are not known. Nothing is visited, but the cursor advances, and from now on the tree
 * logs its changes. The caller should then read the whole tree. Changes are not known: for a zero cursor or a cursor of
 * another tree; after octree_clear, octree_replace_all, octree_tune, octree_reworld and octree_compact; after a
 * shortage of memory; and if the number of changes since the last call is above 1024 and above a quarter of the number
 * of points. So many changes also turn logging off until the next call.
 *
 * `log_name` becomes the name of the log if this call starts one. The name distinguishes this log from all other logs,
 * also from the log of a tree that is created later at the same address. Give a number other than 0 that no log had
 * before, such as the next number of a sequence with a random start.
 *
 * A tree logs nothing until the first call. Calls may run beside queries and on many threads, each with its own cursor.
 * Returns false for null. Cost: O(changes visited). A logged change costs some nanoseconds and 64 bytes, or up to 256
 * bytes while the log grows. */
bool octree_changes_since(const octree *tree, size_t log_name, octree_cursor *cursor, octree_change_visitor visit,
                          void *context);

/* ---- Ask ---------------------------------------------------------------------------------------------------- */

/* A function that is called with each point that matches a query. The tree owns the point, which is valid during the
 * call. The visitor returns true to continue, false to stop. Changes of the tree inside the visitor return OCTREE_BUSY:
 * collect the points first, for example with octree_range_collect. */
typedef bool (*octree_point_visitor)(const octree_point *point, void *context);

/* Algorithm 3. Find a point by its coordinates. *id receives the lowest id that is stored at exactly this position;
 * `id` may be null. Errors: NULL_ARGUMENT, NOT_FINITE, OUTSIDE, NOT_FOUND. Cost: O(D + M). */
octree_status octree_find(const octree *tree, const double position[3], uint64_t *id);

/* Returns whether the pair (position, id) is stored. Cost: O(D + M). */
bool octree_contains(const octree *tree, const double position[3], uint64_t id);

/* Algorithm 4. Visit every point in a closed box, in no stated order. The box may reach beyond the world; infinite
 * corners are allowed. Errors: NULL_ARGUMENT, NOT_FINITE (a NaN), BAD_RANGE (min > max).
 * Cost: O(nodes that meet the box + points in their leaves). */
octree_status octree_range(const octree *tree, const octree_box *box, octree_point_visitor visit, void *context);

/* Visit points as octree_range does, with search options. With epsilon > 0 every point in the box is visited, and
 * possibly points that are at most epsilon outside the box on each axis.
 *
 * Proof: all points of a node are visited without comparison only if the node's cell lies in the box whose faces are
 * moved out by epsilon and rounded inwards. Every other point is compared with the box itself.
 *
 * Errors: those of octree_range, and BAD_SIZE (epsilon < 0), NOT_FINITE, BAD_OPTION. */
octree_status octree_range_search(const octree *tree, const octree_box *box, const octree_search *how,
                                  octree_point_visitor visit, void *context);

/* Store the number of points in a closed box in *count; on an error store 0. The points of a node inside the box are
 * counted without visiting the node's children. Errors and cost: those of octree_range. */
octree_status octree_range_count(const octree *tree, const octree_box *box, size_t *count);

/* Visit every point at a distance of at most `radius` from a centre, in no stated order. The centre may be outside the
 * world. With epsilon > 0 every point within `radius` is visited, and no point beyond radius + epsilon is visited. In
 * FAST mode, the distance that is compared with the radius may be wrong by a factor of 1 + 2^-50 or by 2^-490 of the
 * world's extent, whichever is more.
 *
 * Errors: NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (radius or epsilon < 0), BAD_OPTION. Cost: O(nodes that meet the ball +
 * points in their leaves). */
octree_status octree_radius(const octree *tree, const double center[3], double radius, const octree_search *how,
                            octree_point_visitor visit, void *context);

/* Store the points in a closed box in points[0 .. room - 1], in no stated order. *count receives the number of points
 * in the box, or 0 on an error; points beyond `room` are counted but not stored. Errors and cost: those of
 * octree_range_search. */
octree_status octree_range_collect(const octree *tree, const octree_box *box, const octree_search *how,
                                   octree_point *points, size_t room, size_t *count);

/* Store points as octree_range_collect does, sorted by id and then by position. If the box contains more than `room`
 * points, the first `room` points in this order are stored. */
octree_status octree_range_collect_sorted(const octree *tree, const octree_box *box, const octree_search *how,
                                          octree_point *points, size_t room, size_t *count);

/* Algorithm 5. Visit every point p with |p - center| <= box_size on each axis. The comparison is that of real numbers,
 * without rounding. `self` is a pair (position, id) that is not visited; it may be null.
 *
 * The tree is not changed. (The paper inserts the moving point and removes it again, which fails in a full leaf.)
 * Errors: NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (box_size < 0). Cost: as octree_range. */
octree_status octree_collide(const octree *tree, const double center[3], double box_size, const octree_point *self,
                             octree_point_visitor visit, void *context);

/* Visit points as octree_collide does, with search options. With epsilon > 0 every point within box_size is visited,
 * and also some points within box_size + epsilon on each axis. Errors: those of octree_collide and of
 * octree_range_search. */
octree_status octree_collide_search(const octree *tree, const double center[3], double box_size,
                                    const octree_point *self, const octree_search *how, octree_point_visitor visit,
                                    void *context);

/* Swept collision: visit every point that a moving box touches. The box is position +- box_size, and moves in a
 * straight line from the position `from` to the position `to`, both included. Coordinates are compared as real numbers.
 * No point is missed, however far the box moves.
 *
 * A collision test at the two ends alone finds every point only if the box moves along one axis, by at most 2 *
 * box_size. `self` means the same as in octree_collide. The answer is always exact: epsilon and the mode are not used.
 *
 * Errors: as octree_collide_search. Cost: O(nodes that the box touches on its way + points in their leaves). */
octree_status octree_collide_swept(const octree *tree, const double from[3], const double to[3], double box_size,
                                   const octree_point *self, const octree_search *how, octree_point_visitor visit,
                                   void *context);

/* Store in *box the box that octree_collide searches. On each axis the box extends from the smallest to the largest
 * double that is within box_size of the centre. Errors: NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (box_size < 0); *box is
 * then unchanged. Cost: O(1). */
octree_status octree_collision_box(const double center[3], double box_size, octree_box *box);

/* Algorithms 6 and 7. Find the point nearest to a finite target, which may be outside the world. Distances are compared
 * as real numbers, without rounding; of several points at the same distance, the point with the lowest id is nearest.
 * `skip_id` is read only with OCTREE_SKIP_ID.
 *
 * Errors: NULL_ARGUMENT, NOT_FINITE, BAD_OPTION, NOT_FOUND (no point, or skipped points only). Cost: O(D + M) on
 * average for points of bounded density, O(n) at worst. */
octree_status octree_nearest(const octree *tree, const double target[3], octree_skip skip, uint64_t skip_id,
                             octree_neighbor *nearest);

/* Store the k nearest points in neighbors[0 .. *count - 1], ordered by distance, then id, then position. *count is the
 * smaller of k and the number of points that are not skipped; 0 on an error. The array `neighbors` must have room for
 * this number; it may be null if k is 0.
 *
 * In EXACT mode real distances determine each neighbour. In FAST mode, the i-th distance is at most the greater of two
 * bounds: 1 + 2^-50 times the true i-th distance, and the true i-th distance plus 2^-490 of the world's extent.
 *
 * With epsilon > 0 the i-th distance is at most (1 + epsilon) times the true i-th distance. Proof: a node is pruned
 * only if its box is farther than the k-th best distance so far divided by 1 + epsilon. Every point in the node is then
 * at least as far as the box, and the k-th best distance only decreases.
 *
 * Errors: NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (epsilon < 0), BAD_OPTION. k = 0 and an empty tree are no errors. Cost:
 * O(D + M + k log k) on average for points of bounded density, O(n log k) at worst. */
octree_status octree_nearest_k(const octree *tree, const double target[3], size_t k, const octree_search *how,
                               octree_neighbor *neighbors, size_t *count);

/* Find the nearest point of each of `count` targets. Each row of `targets` is a position. neighbors[i] receives the
 * nearest point of target i. found[i] is false if no point was found for target i; neighbors[i] is then not written.
 * `found` may be null. The targets are processed in Morton order, so that close targets share cached nodes.
 *
 * Errors: those of octree_nearest_k, TOO_MANY and NO_MEMORY. A target that is not finite is reported as NOT_FINITE
 * before anything is written. Cost: `count` searches, and 32 bytes a target during the call. */
octree_status octree_nearest_batch(const octree *tree, const double (*targets)[3], size_t count,
                                   const octree_search *how, octree_neighbor *neighbors, bool *found);

/* Find the nearest point among the points at a distance of at most `radius`. The radius is compared as in
 * octree_radius. epsilon means the same as in octree_nearest_k. Errors: those of octree_nearest_k, BAD_SIZE (radius <
 * 0), and NOT_FOUND. */
octree_status octree_nearest_within(const octree *tree, const double target[3], double radius, const octree_search *how,
                                    octree_neighbor *nearest);

/* A comparison function for qsort(): by id, then by position. All sorted results of this library have this order. */
int octree_compare_points(const void *a, const void *b);

/* ---- Read the nodes ----------------------------------------------------------------------------------------- */

typedef enum octree_walk_order {
    OCTREE_WALK_ON,   /* continue with this node's children */
    OCTREE_WALK_SKIP, /* continue, but skip this node's descendants */
    OCTREE_WALK_STOP, /* end the walk */
} octree_walk_order;

/* A function that is called with each node. The node is valid during the call. Changes of the tree inside the visitor
 * return OCTREE_BUSY. */
typedef octree_walk_order (*octree_node_visitor)(const octree_node *node, void *context);

/* Visit the nodes in pre-order: parents first, children in the order of their octants. Only occupied octants have
 * nodes; an empty tree has a root. Errors: NULL_ARGUMENT. Cost: O(nodes). */
octree_status octree_walk(const octree *tree, octree_node_visitor visit, void *context);

/* Store in *node a description of the node at an address. Errors: NULL_ARGUMENT, NOT_FOUND. Cost: O(D). */
octree_status octree_node_at(const octree *tree, octree_address address, octree_node *node);

/* Store in *node a description of the leaf whose cell contains a position; no point needs to be stored at the position.
 * If there is no such leaf, describe the deepest node whose cell contains the position. Errors: NULL_ARGUMENT,
 * NOT_FINITE, OUTSIDE. Cost: O(D). */
octree_status octree_locate(const octree *tree, const double position[3], octree_node *node);

/* Count the tree's points, nodes, leaves and bytes. Errors: NULL_ARGUMENT. Cost: O(nodes). */
octree_status octree_statistics(const octree *tree, octree_stats *stats);

/* Returns the number of points, in O(1). Returns 0 for null. */
size_t octree_count(const octree *tree);

/* Returns the version of the tree, a number that every change of the contents changes. If two calls return the same
 * number, nothing has changed between the calls. Returns 0 for null. */
uint64_t octree_version(const octree *tree);

/* Returns a digest of the world, the options, the nodes and the points. Equal contents and options give equal digests
 * on every machine, whatever the order of changes. Under OCTREE_AUTO the options include the capacity in force. Returns
 * 0 for null. Cost: O(nodes + n). */
uint64_t octree_digest(const octree *tree);

/* Check the tree's invariants: counts add up, points lie in their leaf's cell, a leaf that can split is within its
 * capacity, the points of an inner node do not fit one leaf, and each pair (position, id) is stored once. Returns null
 * if all invariants hold. Otherwise returns a sentence in static storage about the first violation, and *where receives
 * the address of its node; `where` may be null. Cost: O(nodes + n * M). */
const char *octree_check(const octree *tree, octree_address *where);

/* ---- Addresses and planes ----------------------------------------------------------------------------------- */

/* Returns the depth of a valid address, which is the number of its octants. Cost: O(1). */
unsigned octree_address_depth(octree_address address);

/* Returns the octant (0..7) in an address at a level from 0 to depth - 1. If (cx, cy, cz) is the center of the cell at
 * that level, the octant of a point is (x >= cx ? 4 : 0) + (y >= cy ? 2 : 0) + (z >= cz ? 1 : 0). */
unsigned octree_address_octant(octree_address address, unsigned level);

/* The size in bytes of the longest text of an address, including its final zero. */
#define OCTREE_ADDRESS_TEXT 48

/* Write an address as text: "root" for the root, and otherwise the node's octants from the root down, as in "0/3/7".
 * Returns `text`. */
char *octree_address_format(octree_address address, char text[OCTREE_ADDRESS_TEXT]);

/* Parse a text into an address. The text is "root", "/", or octants separated by slashes. Returns false if the text has
 * none of these forms. */
bool octree_address_parse(const char *text, octree_address *address);

/* Returns the box of the cell at an address, whether or not a node exists there. At depth d, an axis is divided by the
 * planes 0 to 2^d. Plane k is computed by a closed form, which increases with k and never overflows. If all steps of
 * the computation are exact, as in the world [-1000, 1000], the planes are the same as with the paper's (min + max) /
 * 2. Cost: O(D). */
octree_box octree_cell_box(const octree_box *world, octree_address address);

#ifdef __cplusplus
}
#endif

#endif
