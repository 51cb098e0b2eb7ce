/* SPDX-License-Identifier: MIT */
/* query.h - queries as data: a struct for a query of any kind, a struct for the answer to such a query, and a table of
 * the kinds of queries.
 *
 * Session files, games, audits and pictures work on these structs. A program that only searches a tree calls the
 * functions of octree.h instead.
 */
#ifndef OCTREE_QUERY_H
#define OCTREE_QUERY_H

#include "octree/foreign.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The tables --------------------------------------------------------------------------------------------- */

/* The types of the members in OCTREE_QUERY_MEMBER_MAP. The type of a member decides how the member is checked, read,
 * written, printed and rounded to floats. */
typedef enum octree_member_type {
    OCTREE_MEMBER_BOX,       /* octree_box: six numbers, NaN is refused, infinities are allowed */
    OCTREE_MEMBER_POSITION,  /* double[3]: three finite numbers */
    OCTREE_MEMBER_DIRECTION, /* double[3]: three finite numbers, not all zero */
    OCTREE_MEMBER_COUNT,     /* size_t: any number */
    OCTREE_MEMBER_LENGTH,    /* double: finite, >= 0 */
    OCTREE_MEMBER_BOUNDS,    /* octree_bounds */
    OCTREE_MEMBER_FRUSTUM,   /* octree_frustum */
    OCTREE_MEMBER_EXTENTS,   /* double[3]: three finite numbers >= 0 */
} octree_member_type;

/* Whether points exactly on the boundary of a region belong to the answer. Coordinates and distances are compared as
 * real numbers, without rounding.
 *
 * CLOSED: such points belong to the answer. OPEN: such points do not belong to the answer, as in an index that tests
 * `distance < radius`. EITHER: the answer of a foreign index may contain any of these points; the exact answer contains
 * all of them. */
typedef enum octree_bounds {
    OCTREE_BOUNDS_CLOSED,
    OCTREE_BOUNDS_OPEN,
    OCTREE_BOUNDS_EITHER,
    OCTREE_BOUNDS_KINDS
} octree_bounds;

/* The most half-spaces of a query: the six of a camera's frustum and two planes that clip it. */
#define OCTREE_FRUSTUM_HALF_SPACES 8

/* The intersection of 1 to OCTREE_FRUSTUM_HALF_SPACES half-spaces, such as what a camera sees. */
typedef struct octree_frustum {
    octree_half_space half_spaces[OCTREE_FRUSTUM_HALF_SPACES];
    size_t count;
} octree_frustum;

/* The name of bounds in session files: "closed", "open" or "either". Null for bounds >= OCTREE_BOUNDS_KINDS. */
const char *octree_bounds_name(octree_bounds bounds);

/* The members of octree_query and octree_answer that only some kinds of query read. The columns: the name of the
 * member's constants, the member, its type, its key in session files, and REQUIRED or OPTIONAL: session files may leave
 * out an optional member, which then is 0, and a count is 1. Answers list their members in this order. To add a member,
 * add a row here and a field to both structs. */
#define OCTREE_QUERY_MEMBER_MAP(X)                                                                                     \
    X(BOX, box, BOX, "box", REQUIRED)                                                                                  \
    X(TARGET, target, POSITION, "at", REQUIRED)                                                                        \
    X(DIRECTION, direction, DIRECTION, "ray", REQUIRED)                                                                \
    X(K, k, COUNT, "k", OPTIONAL)                                                                                      \
    X(RADIUS, radius, LENGTH, "radius", REQUIRED)                                                                      \
    X(THICKNESS, thickness, LENGTH, "thickness", OPTIONAL)                                                             \
    X(LENGTH, length, LENGTH, "length", OPTIONAL)                                                                      \
    X(TO, to, POSITION, "sweep", REQUIRED)                                                                             \
    X(HALF, half, EXTENTS, "half", OPTIONAL)                                                                           \
    X(FRUSTUM, frustum, FRUSTUM, "frustum", REQUIRED)                                                                  \
    X(BOUNDS, bounds, BOUNDS, "bounds", OPTIONAL)

enum {
#define OCTREE_QUERY_MEMBER_INDEX(member, ...) OCTREE_QUERY_MEMBER_##member,
    OCTREE_QUERY_MEMBER_MAP(OCTREE_QUERY_MEMBER_INDEX)
#undef OCTREE_QUERY_MEMBER_INDEX
        OCTREE_QUERY_MEMBERS
};

/* One bit for each row of OCTREE_QUERY_MEMBER_MAP. The set of members that a kind of query reads is an OR of such
 * bits. */
typedef enum octree_query_member {
#define OCTREE_QUERY_MEMBER_BIT(member, ...) OCTREE_QUERY_HAS_##member = 1 << OCTREE_QUERY_MEMBER_##member,
    OCTREE_QUERY_MEMBER_MAP(OCTREE_QUERY_MEMBER_BIT)
#undef OCTREE_QUERY_MEMBER_BIT
} octree_query_member;

/* A row of OCTREE_QUERY_MEMBER_MAP. */
typedef struct octree_query_member_traits {
    octree_query_member bit;
    octree_member_type type;
    const char *key;  /* the member's key in session files */
    bool optional;    /* session files may leave the member out, unless the kind bears its name */
    size_t in_query;  /* the member's offset in octree_query, in bytes */
    size_t in_answer; /* the member's offset in octree_answer, in bytes */
} octree_query_member_traits;

/* Returns row `index` of OCTREE_QUERY_MEMBER_MAP, in static storage. Returns null for index >= OCTREE_QUERY_MEMBERS. */
const octree_query_member_traits *octree_query_member_at(size_t index);

/* One row for each kind of query. The columns: the kind's name; the members of octree_query that the kind reads; the
 * member whose key in a session file is the kind's name; POINTS or NEIGHBORS, the array of octree_answer that holds the
 * result; the kind's meaning in a few words; a noun for the searched region; the keys of the target and of
 * octree_neighbor.distance in ticks.jsonl.
 *
 * To add a kind: a row here; a file lib/src/ask/kind_NAME.c, which defines the functions of query_rules in
 * lib/src/ask/kind.h; a row of viz/scene/query_looks.h; a layer_NAME in viz/layers; a test. If one of these is missing,
 * the program does not compile or link. */
#define OCTREE_QUERY_MAP(X)                                                                                            \
    X(RANGE, range, OCTREE_QUERY_HAS_BOX | OCTREE_QUERY_HAS_BOUNDS, OCTREE_QUERY_HAS_BOX, POINTS,                      \
      "the points in a box", "box", "center", "distance")                                                              \
    X(NEAREST, nearest, OCTREE_QUERY_HAS_TARGET, OCTREE_QUERY_HAS_TARGET, NEIGHBORS, "the point nearest to a place",   \
      "space", "target", "distance")                                                                                   \
    X(KNEAREST, knearest, OCTREE_QUERY_HAS_TARGET | OCTREE_QUERY_HAS_K, OCTREE_QUERY_HAS_K, NEIGHBORS,                 \
      "the k points nearest to a place", "space", "target", "distance")                                                \
    X(RADIUS, radius, OCTREE_QUERY_HAS_TARGET | OCTREE_QUERY_HAS_RADIUS | OCTREE_QUERY_HAS_BOUNDS,                     \
      OCTREE_QUERY_HAS_RADIUS, POINTS, "the points in a ball", "ball", "center", "distance")                           \
    X(RAY, ray,                                                                                                        \
      OCTREE_QUERY_HAS_TARGET | OCTREE_QUERY_HAS_DIRECTION | OCTREE_QUERY_HAS_K | OCTREE_QUERY_HAS_THICKNESS |         \
          OCTREE_QUERY_HAS_LENGTH,                                                                                     \
      OCTREE_QUERY_HAS_DIRECTION, NEIGHBORS, "the first k points that a ray hits", "ray", "origin", "t")               \
    X(FRUSTUM, frustum, OCTREE_QUERY_HAS_FRUSTUM | OCTREE_QUERY_HAS_BOUNDS, OCTREE_QUERY_HAS_FRUSTUM, POINTS,          \
      "the points that no half-space excludes", "frustum", "center", "distance")                                       \
    X(SWEEP, sweep, OCTREE_QUERY_HAS_TARGET | OCTREE_QUERY_HAS_TO | OCTREE_QUERY_HAS_HALF | OCTREE_QUERY_HAS_K,        \
      OCTREE_QUERY_HAS_TO, NEIGHBORS, "the first k points that a moving box hits", "moving box", "from", "t")

typedef enum octree_query_kind {
#define OCTREE_QUERY_ENUM(kind, ...) OCTREE_QUERY_##kind,
    OCTREE_QUERY_MAP(OCTREE_QUERY_ENUM)
#undef OCTREE_QUERY_ENUM
        OCTREE_QUERY_KINDS
} octree_query_kind;

/* A row of OCTREE_QUERY_MAP. */
typedef struct octree_query_traits {
    const char *name;             /* the kind's name in session files and ticks.jsonl, such as "range" */
    unsigned members;             /* bit mask of octree_query_member: the members of octree_query that the kind reads */
    octree_query_member named_by; /* the member whose key in a session file is the kind's name */
    /* true: octree_answer.neighbors holds the result; false: octree_answer.points holds it */
    bool neighbors;
    const char *words;   /* the meaning of the kind, such as "the points in a box" */
    const char *region;  /* a noun for the searched region, such as "box" */
    const char *place;   /* the key of the target in ticks.jsonl: "target", "center" or "origin" */
    const char *measure; /* the key of octree_neighbor.distance in ticks.jsonl: "distance" or "t" */
} octree_query_traits;

/* Returns the table row of a kind of query, in static storage. Returns null for kind >= OCTREE_QUERY_KINDS. */
const octree_query_traits *octree_query_about(octree_query_kind kind);

/* Returns the name of a kind of query, such as "range". Returns null for kind >= OCTREE_QUERY_KINDS. */
const char *octree_query_name(octree_query_kind kind);

/* ---- Queries ------------------------------------------------------------------------------------------------ */

#define OCTREE_EVERY_TICK UINT64_MAX

/* A query. A game asks the query at the end of a tick, after all changes of the tree. Queries for neighbours with
 * at_player skip the game's player; other queries find the player like any other point. In a tick without a player,
 * queries with at_player are not asked. */
typedef struct octree_query {
    uint64_t tick; /* the number of the tick at which the query is asked, or OCTREE_EVERY_TICK */
    octree_query_kind kind;
    /* true: the player's position is the target, and `box`, `to` and `frustum` are relative to this position */
    bool at_player;
    octree_box box; /* the box of a range query */
    /* the position whose neighbours are searched, the center of the ball, the origin of the ray, or the first position
     * of the moving box. Not read if at_player is true */
    double target[3];
    double direction[3]; /* the ray is target + t * direction for t >= 0; it need not have length 1 */
    size_t k;            /* the number of neighbours or hits to find; if there are fewer, all are found */
    double radius;       /* the radius of the ball, >= 0 */
    double thickness;    /* the half extent of the ray on each axis, >= 0; without it, a ray rarely hits a point */
    double length;       /* the largest parameter t of the ray; 0: the ray has no end */
    double to[3];        /* the last position of the moving box, whose first position is the target */
    double half[3];      /* the half extents of the moving box */
    /* a point or body belongs to the answer unless a half-space has all of it outside (octree_region in bodies.h) */
    octree_frustum frustum;
    octree_bounds bounds; /* read for regions: whether the boundary belongs to the answer */
    /* the points that no answer may contain. NONE: no point is skipped, except the game's player in a query for
     * neighbours with at_player. COINCIDENT: points at the target are skipped; this is an error in a query without a
     * target */
    octree_skip skip;
    uint64_t skip_id; /* the id of the skipped points; read only with OCTREE_SKIP_ID */
    double epsilon; /* the permitted error of the answer, finite and >= 0: a ratio for neighbours, a length for regions;
                       see octree_search.epsilon */
    /* true: the session has the answer of a foreign index to this query. The game compares it with the exact answer,
     * for which it ignores epsilon */
    bool answered;
    /* read if `answered` is true: the precision for which the foreign index promises right answers */
    octree_precision precision;
    const uint64_t *answer; /* read if `answered` is true: the ids that the foreign index returned, in any order; null
                               if answer_count is 0 */
    size_t answer_count;
    /* visits[v]: the ids of the foreign nodes that the query visited, pruned or hit. A game compares with the exact
     * answer to check whether the query was wrong to prune a node; the check allows for precision and epsilon */
    octree_ids visits[OCTREE_NODE_VISITS];
} octree_query;

/* Check whether a query can be asked. The member `tick` is not read. Errors: NULL_ARGUMENT (an array of ids may be null
 * only if its count is 0); BAD_OPTION (kind, bounds, precision or skip is invalid, or COINCIDENT without a target);
 * NOT_FINITE, BAD_RANGE, BAD_SIZE (epsilon, or a member that the kind reads, such as the count of half-spaces);
 * BAD_SIZE (the id of a foreign node is not below OCTREE_NODE_ID_LIMIT). */
octree_status octree_query_check(const octree_query *query);

/* ---- Answers ------------------------------------------------------------------------------------------------ */

/* How the answer of a foreign index is wrong. If an answer is wrong in several ways, the lowest of the values is
 * reported. */
typedef enum octree_wrong_kind {
    OCTREE_WRONG_NONE,
    /* the answer contains an id that no point has at this tick, such as the id of a removed point */
    OCTREE_WRONG_UNKNOWN,
    OCTREE_WRONG_DUPLICATE, /* the answer contains a point or a pair twice */
    OCTREE_WRONG_SKIPPED,   /* the answer contains a point that the query skips */
    /* only for neighbours: the number of neighbours is neither k nor, in a smaller tree, the number of points. For
     * rays and moving boxes, only if this is also true without the points that they miss */
    OCTREE_WRONG_COUNT,
    /* only for neighbours: at some rank, the neighbour is farther than the exact neighbour of this rank */
    OCTREE_WRONG_FARTHER,
    /* only for regions: a point in the region is not in the answer. The query's bounds decide about points on the
     * boundary, here and for EXTRA */
    OCTREE_WRONG_MISSING,
    OCTREE_WRONG_EXTRA, /* only for regions, rays and moving boxes: a point of the answer is outside, or is missed
                         */
    OCTREE_WRONG_KINDS
} octree_wrong_kind;

/* Returns the name of a kind of error: "none", "unknown", "duplicate", "skipped", "count", "farther", "missing" or
 * "extra". Returns null for wrong >= OCTREE_WRONG_KINDS. */
const char *octree_wrong_name(octree_wrong_kind wrong);

/* The result of comparing the answer of a foreign index with the exact answer.
 *
 * Regions (a box, a ball, a frustum) are compared as sets of points. Neighbours are sorted by distance, hits by t,
 * whatever their order in the answer, and compared rank by rank; if several have the same, each of them is right. Real
 * numbers decide all comparisons. An epsilon above 0 allows extra points that are within epsilon of the region, and
 * neighbours up to 1 + epsilon times as far as the exact ones; because of rounding, a ratio within 2^-46 of that limit
 * counts as right. */
typedef struct octree_judgement {
    bool judged; /* false: the query has no foreign answer, and the other members are 0 */
    octree_wrong_kind wrong;
    uint64_t wrong_id;     /* for UNKNOWN, DUPLICATE and SKIPPED: the lowest id that is wrong in this way */
    const uint64_t *given; /* the ids of the foreign answer, in the order of this answer */
    size_t given_count;
    size_t expected; /* the number of points in the exact answer */
    /* points that every right answer contains but the foreign answer does not; sorted by id for regions, by distance
     * for neighbours */
    const octree_point *missing;
    /* the number of missing points; the recall of the answer is 1 - missing_count / expected */
    size_t missing_count;
    /* points that are in the foreign answer but in no right answer; sorted like `missing`. Ids that are UNKNOWN and
     * points that are SKIPPED are not in this list */
    const octree_point *extra;
    size_t extra_count;
    /* only for regions: MISSING if points are missing and all of them lie exactly on the boundary of the region; EXTRA
     * if the same is true of extra points; else NONE */
    octree_wrong_kind on_boundary;
    /* read if on_boundary is not NONE: the bounds with which the foreign answer would be right on the boundary */
    octree_bounds accepting;
    /* only for neighbours: the first rank at which the neighbour is wrong. The nearest neighbour has rank 1; 0: no rank
     * is wrong */
    size_t rank;
    /* only for neighbours: the largest ratio, over all ranks, of the foreign distance to the exact distance. 1 for an
     * exact answer; infinite if an exact distance is 0 or if the answer is empty */
    double ratio;
} octree_judgement;

/* The result of comparing the pairs that a foreign index found with the exact pairs, as sets. All lists are sorted by
 * `a` and then `b`, with a < b. */
typedef struct octree_pair_judgement {
    bool judged;             /* false: the foreign index gave no pairs at this tick, and the other members are 0 */
    octree_wrong_kind wrong; /* NONE, UNKNOWN, DUPLICATE, MISSING or EXTRA */
    /* for UNKNOWN: `a` is the lowest id that no body has, and `b` the id beside it; the player of OCTREE_PLAYER_KEYS is
     * no body. For DUPLICATE: the lowest pair that is given twice, in whatever order of its ids */
    octree_pair wrong_pair;
    const octree_pair *given; /* the pairs of the foreign index */
    size_t given_count;
    size_t expected;            /* the number of exact pairs */
    const octree_pair *missing; /* the exact pairs that are not given */
    size_t missing_count;
    const octree_pair *extra; /* the given pairs whose bodies do not overlap, each once; UNKNOWN pairs are left out */
    size_t extra_count;
} octree_pair_judgement;

typedef struct octree_answer {
    octree_query_kind kind;
    bool by_key;    /* true: the query was asked by the key n, not by the session */
    octree_box box; /* the members of octree_query that the kind reads, in world coordinates */
    double target[3];
    double direction[3];
    size_t k; /* the number of neighbours that the query asked for; 1 for a query of kind nearest */
    double radius;
    double thickness;
    double length;
    double to[3];
    double half[3];
    octree_frustum frustum;
    octree_bounds bounds;
    octree_skip skip; /* skip, skip_id and epsilon of the query; skip is NONE if only the player is skipped */
    uint64_t skip_id;
    double epsilon;
    const octree_point *points; /* the result of a kind whose result is points, sorted by id */
    /* the result of a kind whose result is neighbours, sorted by distance, then by id. For a ray, the distance is the
     * parameter t of the first point of the ray that is in the body's box; for a moving box, t goes from 0 to 1 */
    const octree_neighbor *neighbors;
    size_t count; /* the number of points or neighbours */
    octree_cost cost;
    octree_precision precision;
    octree_judgement judgement; /* only in a game: the judgement of the foreign answer, if the query has one */
} octree_answer;

/* Answer a query outside a game. `player` is the player's position, for a query with at_player; it may be null for
 * other queries. `how` may be null; how->skip applies if the query's skip is NONE, and how->epsilon if the query's
 * epsilon is 0. A foreign answer is not judged. The cost is stored in answer->cost; how->cost is not used. Release the
 * answer with octree_answer_release.
 *
 * Errors: those of octree_query_check and octree_range_search, NULL_ARGUMENT, NO_MEMORY; the answer is then empty. The
 * memory comes from the tree's allocator, which must be safe to call from this thread. */
octree_status octree_query_answer(const octree *tree, const octree_query *query, const double player[3],
                                  const octree_search *how, octree_answer *answer);
void octree_answer_release(const octree *tree, octree_answer *answer);

/* Store in *bound a box that contains the region of an answer. Returns false if the result is neighbours, which may lie
 * anywhere. The box of a large ball may be infinite, and that of a frustum is. */
bool octree_answer_bound(const octree_answer *answer, octree_box *bound);

#ifdef __cplusplus
}
#endif

#endif
