/* SPDX-License-Identifier: MIT */
/* bodies.h - a dynamic set of bodies: axis-aligned boxes in double precision, for collision detection.
 *
 * A body is a position (the centre of its box), three half extents and the caller's 64-bit id. Its box is closed and
 * spans the real numbers position - half to position + half, which are not rounded. Each triple (position, half, id) is
 * stored once. The position must lie in the world; the box may reach beyond it. The world of a set stays as it is:
 * choose a large one.
 *
 * How it works (no caller needs to know it). Bodies are divided by size into at most twelve levels, and each level is
 * an octree of their positions (octree.h). Each node of the tree has a box around all bodies in and below it, as in a
 * bounding volume hierarchy, and a query skips a node whose box it does not meet. Without levels, one large body would
 * enlarge the boxes of many small ones. In level 0, of the largest bodies, and for points shown as bodies, this box is
 * the node's cell, extended by the largest half extents of the level, its `reach`. In other levels the box is stored.
 * It is a function of the bodies, as the nodes are; only that of a leaf beyond its capacity, most of whose bodies are
 * at one place, does not shrink when bodies are removed.
 *
 * Bodies that are not large beside the leaves need no levels of their own. A bulk insertion into an empty set,
 * replace_all, compact and a call that changes a third of the bodies choose the size up to which bodies share the last
 * level; a set that has grown fourfold since chooses it again. In a set filled by single insertions the levels depend
 * on the bodies alone, until octree_bodies_compact().
 *
 * All answers are decided by real numbers: no body is missed or added because of rounding. A node is skipped only if a
 * box that contains all of its bodies fails the test by which a body is accepted.
 *
 * Conventions are those of octree.h: statuses, callbacks that must not change what they visit (OCTREE_BUSY), threads,
 * floating-point modes. In addition:
 *   - A change of one body happens completely or not at all. A call that changes many bodies reports the status of
 *     each, and makes the changes whose status is OK.
 *   - The options of a search may be null. Of the rules to skip bodies, OCTREE_SKIP_ID works everywhere, and
 *     OCTREE_SKIP_COINCIDENT only in octree_bodies_nearest(): it compares positions with the target. Elsewhere it skips
 *     none.
 *   - Bodies that visitors receive are valid during the call.
 *   - During a bulk change, the executor must not query the set.
 *   - n is the number of bodies, L the number of levels in use, D and M are the depth and the capacity of a level.
 */
#ifndef OCTREE_BODIES_H
#define OCTREE_BODIES_H

#include "octree/octree.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct octree_bodies octree_bodies;

/* ---- Create and change -------------------------------------------------------------------------------------- */

/* Returns the default definition: that of octree_def_default() with a leaf capacity of 32. */
octree_def octree_bodies_def_default(void);

/* Create an empty set in *bodies. The definition is copied. full_leaf must be OCTREE_GROW: a set refuses no body for
 * lack of room. Errors: those of octree_create, and BAD_OPTION for OCTREE_REFUSE; *bodies is then null. Cost: O(1). */
octree_status octree_bodies_create(const octree_def *def, octree_bodies **bodies);

/* Create a read-only set that shows each point of a tree as a body with these half extents, such as a thickness. All
 * queries of this header then work on points. The tree must outlive the set. Changes of the tree are visible in the
 * set; changes of the set return BAD_OPTION.
 * Errors: NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (half < 0), NO_MEMORY; *bodies is then null. Cost: O(1). */
octree_status octree_bodies_of_points(const octree *tree, const double half[3], octree_bodies **bodies);

/* Free the set and all of its memory. The set may be null. Does nothing inside a callback of the set. */
void octree_bodies_destroy(octree_bodies *bodies);

/* Remove all bodies. Errors: NULL_ARGUMENT, BUSY. Cost: O(memory blocks). */
octree_status octree_bodies_clear(octree_bodies *bodies);

/* Insert a body. Cost: O(D + M); O(n log n) whenever a set that was filled in bulk has grown fourfold, and O(n) once if
 * more than 64 bodies share a leaf, because a hash table then finds bodies. Errors: NULL_ARGUMENT, NOT_FINITE, OUTSIDE
 * (the position), BAD_SIZE (half < 0), DUPLICATE, NO_MEMORY, TOO_MANY, BUSY; the set is then unchanged. */
octree_status octree_bodies_insert(octree_bodies *bodies, const octree_body *body);

/* Remove the body with this position, these half extents and this id. Cost: O(D + M). Errors: those of insertion, and
 * NOT_FOUND; the set is then unchanged. */
octree_status octree_bodies_remove(octree_bodies *bodies, const octree_body *body);

/* Replace a body by another: move it, resize it, or both. Cost: O(D + M). Errors: those of removal; the set is
 * then unchanged. The numbers of both bodies are checked first, and NOT_FOUND comes before DUPLICATE. */
octree_status octree_bodies_move(octree_bodies *bodies, const octree_body *from, const octree_body *to);

/* Insert, remove or move many bodies, with the same result as single calls in the given order. statuses[i] receives the
 * status of bodies[i], and *changed the number of statuses OK; both may be null. If memory runs out, the bodies whose
 * status is OK are changed, and all others are as before.
 * Errors: NULL_ARGUMENT, BUSY, NO_MEMORY, TOO_MANY. Cost: O(n log n) for a call that inserts into an empty set, or
 * changes a third of the bodies or more: it fills the set anew, while the old bodies and two copies are in memory. That
 * of single calls for others, and for a change for whose copies memory is too short. */
octree_status octree_bodies_insert_many(octree_bodies *bodies, const octree_body *added, size_t count,
                                        octree_status *statuses, size_t *changed);
octree_status octree_bodies_remove_many(octree_bodies *bodies, const octree_body *removed, size_t count,
                                        octree_status *statuses, size_t *changed);
octree_status octree_bodies_move_many(octree_bodies *bodies, const octree_body *from, const octree_body *to,
                                      size_t count, octree_status *statuses, size_t *changed);

/* Replace all bodies by these bodies. For a game in which nearly all bodies move in each tick, this is the fastest
 * change. A body that is refused is in the set no longer: compare *changed with `count`. If the call itself returns an
 * error, the set is unchanged. Errors and results: those of octree_bodies_insert_many. Old and new bodies are in memory
 * at the same time. */
octree_status octree_bodies_replace_all(octree_bodies *bodies, const octree_body *added, size_t count,
                                        octree_status *statuses, size_t *changed);

/* Store neighbouring bodies together, divide them by size again, and release unused memory. Queries are then faster.
 * Answers stay the same. Errors: NULL_ARGUMENT, BUSY, NO_MEMORY; the set is then unchanged. Cost: O(n log n). */
octree_status octree_bodies_compact(octree_bodies *bodies);

/* ---- Read --------------------------------------------------------------------------------------------------- */

/* Returns the number of bodies, in O(1). Returns 0 for null. */
size_t octree_bodies_count(const octree_bodies *bodies);

/* Returns the definition of the set: that of octree_definition(). */
octree_def octree_bodies_definition(const octree_bodies *bodies);

/* Returns whether the set holds this body. Cost: O(1); O(D + M) in a set that shows points. */
bool octree_bodies_contain(const octree_bodies *bodies, const octree_body *body);

/* Returns a digest of the definition and the bodies, whatever the order of changes. Returns 0 for null. Cost: O(n). */
uint64_t octree_bodies_digest(const octree_bodies *bodies);

/* Check the invariants of the set and of its levels. Returns null if all hold, and otherwise a sentence in static
 * storage about the first violation. Cost: O(n * M). */
const char *octree_bodies_check(const octree_bodies *bodies);

/* Returns the number of bytes that the set has allocated, trees included. Returns 0 for null. Cost: O(1). */
size_t octree_bodies_memory(const octree_bodies *bodies);

/* The number of levels: level 0 has the largest bodies. */
#define OCTREE_BODY_LEVELS 12

/* Returns the tree of a level, for reading its nodes (octree_walk, octree_statistics). The id of a point of this tree
 * is the argument of octree_bodies_at(). reach[] receives upper bounds of the half extents: in level 0 close to those
 * of its bodies, in other levels the upper end of its sizes; `reach` may be null. The tree may be empty. Returns null
 * if the level has no tree yet, and for level >= OCTREE_BODY_LEVELS. */
const octree *octree_bodies_level(const octree_bodies *bodies, unsigned level, double reach[3]);

/* Store the body of a point of a level in *body. The point must be one that the level's tree holds. */
void octree_bodies_at(const octree_bodies *bodies, const octree_point *point, octree_body *body);

/* ---- Ask ---------------------------------------------------------------------------------------------------- */

/* A function that is called with each body that matches a query. Returns true to continue, false to stop. */
typedef bool (*octree_body_visitor)(const octree_body *body, void *context);

#define OCTREE_MAX_HALF_SPACES 32

typedef enum octree_region_kind {
    OCTREE_REGION_BOX,         /* a closed box; its corners may be infinite */
    OCTREE_REGION_BALL,        /* a closed ball */
    OCTREE_REGION_HALF_SPACES, /* the intersection of 1 to 32 closed half-spaces, such as a camera's frustum */
    OCTREE_REGION_SWEPT,       /* all places that a box covers while it moves straight from one position to another */
    OCTREE_REGION_RAY,         /* the points origin + t * direction for 0 <= t <= length */
    OCTREE_REGION_KINDS
} octree_region_kind;

/* A region of space. Only the members of its kind are read. If all members are zero, it is a box at the origin.
 *
 * A body matches if its box and the region have a common point. For half-spaces a body matches if no half-space has its
 * whole box outside: this is the test of frustum culling. It accepts every body that meets the region, every body of
 * extent zero exactly, and near the edges of the region some boxes that no single half-space separates from it. Normals
 * point out of the region: an engine's plane a x + b y + c z + d >= 0 is the normal (-a, -b, -c) and the offset d. */
typedef struct octree_region {
    octree_region_kind kind;
    /* read for BOX, BALL and HALF_SPACES. true: a body matches only if its whole box is in the region */
    bool contained;
    octree_box box;                       /* BOX */
    double center[3];                     /* BALL */
    double radius;                        /* BALL: finite, >= 0 */
    const octree_half_space *half_spaces; /* HALF_SPACES */
    size_t half_space_count;
    double from[3], to[3]; /* SWEPT: the first and the last position of the box */
    double half[3];   /* SWEPT: the half extents of the moving box. RAY: half the thickness of the ray on each axis */
    double origin[3]; /* RAY */
    double direction[3]; /* RAY: not zero; need not have length 1 */
    double length; /* RAY: the largest parameter t, a distance if the direction has length 1. HUGE_VAL: no end; 0: only
                      the origin */
} octree_region;

/* Check a region. Returns OK, NULL_ARGUMENT, NOT_FINITE, BAD_RANGE (min > max), BAD_SIZE (a negative size, a zero
 * direction or normal, or not 1 to 32 half-spaces) or BAD_OPTION (the kind). */
octree_status octree_region_check(const octree_region *region);

/* Visit every body that matches a region, in no stated order. The options count and trace nodes; levels are searched in
 * ascending order, and the trace of each level begins with its root. The answer is exact whatever mode and epsilon say.
 * Errors: NULL_ARGUMENT, those of octree_region_check, and BAD_OPTION. Cost: O(nodes whose boxes meet the region +
 * bodies in their leaves). */
octree_status octree_bodies_search(const octree_bodies *bodies, const octree_region *region, const octree_search *how,
                                   octree_body_visitor visit, void *context);

/* A body that a search in order has found. */
typedef struct octree_hit {
    octree_body body;
    /* For neighbours: the distance from the target to the box; 0 inside. For rays: the parameter t of the first common
     * point. For moving boxes: the share of the way before the first contact, 0 to 1. If a ray or a moving box starts
     * inside the body: 0. Within 4 ulp; infinite beyond DBL_MAX. */
    double at;
} octree_hit;

/* Store the k bodies nearest to a target in hits[0 .. *count - 1], ordered by the distance to their box, then by id,
 * position and half extents. Only bodies within `radius` count; HUGE_VAL: all. If `accept` is not null, only bodies for
 * which it returns true count. With an epsilon above 0, each distance is at most (1 + epsilon) times that of the exact
 * answer.
 *
 * *count is the smaller of k and the number of bodies that count, so 0 is no error; it is 0 after an error, too. hits[]
 * must have room for *count bodies; it may be null if k is 0.
 * Errors: NULL_ARGUMENT, NOT_FINITE, BAD_SIZE (radius or epsilon < 0), BAD_OPTION. Cost: O(L (D + M) + k log k) on
 * average for bodies of bounded density, O(n log k) at worst. */
octree_status octree_bodies_nearest(const octree_bodies *bodies, const double target[3], size_t k, double radius,
                                    const octree_search *how, octree_body_visitor accept, void *context,
                                    octree_hit *hits, size_t *count);

/* Store the first k bodies that a ray or a moving box (a region of kind RAY or SWEPT) hits in hits[0 .. *count - 1],
 * ordered by the parameter of the first common point, then by id, position and half extents. The first hit has k = 1.
 * If `accept` is not null, only bodies for which it returns true count. *count and hits[] are those of
 * octree_bodies_nearest().
 * Errors: NULL_ARGUMENT, those of octree_region_check, and BAD_OPTION (another kind of region). Cost: O(nodes along the
 * way to the last hit + bodies in their leaves). */
octree_status octree_bodies_cast(const octree_bodies *bodies, const octree_region *ray, size_t k,
                                 const octree_search *how, octree_body_visitor accept, void *context, octree_hit *hits,
                                 size_t *count);

/* A function that is called with each pair of overlapping bodies. Returns true to continue, false to stop. */
typedef bool (*octree_pair_visitor)(const octree_body *a, const octree_body *b, void *context);

/* Visit all pairs of bodies whose boxes have a common point, each pair once. If `other` is null, the pairs within the
 * set are visited, with `a` before `b` in the order of octree_compare_bodies(); otherwise the pairs of one body of each
 * set, `a` from the first; if both are the same set, each body meets itself, and each pair is visited twice. The order
 * of the pairs is a function of the bodies, the definitions and, for sets filled in bulk, the calls that filled them.
 * Errors: NULL_ARGUMENT, and NO_MEMORY. Cost: O(n M) for bodies of bounded density, plus the number of pairs; about 40
 * bytes of memory a body during the call, and 95 for points shown as bodies. The executor is not used. */
octree_status octree_bodies_pairs(const octree_bodies *bodies, const octree_bodies *other, octree_pair_visitor visit,
                                  void *context);

/* A comparison function for qsort(): by id, then by position, then by half extents. */
int octree_compare_bodies(const void *a, const void *b);

#ifdef __cplusplus
}
#endif

#endif
