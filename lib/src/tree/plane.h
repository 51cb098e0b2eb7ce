/* SPDX-License-Identifier: MIT */
/* plane.h - computes planes, cells, Morton codes and addresses. Insertion, queries and drawing all use the same closed
 * form.
 *
 * Each axis of the world has 2^21 + 1 grid planes. On each axis, a cell of depth d spans 2^(21-d) of the gaps between
 * these planes. The key of a coordinate is the number of the gap that contains it: the largest k with plane(k) <= x.
 * The Morton code of a point consists of the interleaved bits of its three keys. The code's groups of three bits, from
 * the highest group on, are the octants on the path from the root to the point.
 */
#ifndef OCTREE_PLANE_H
#define OCTREE_PLANE_H

#include "../exact/bits.h"
#include "../exact/float_rules.h"
#include "octree/octree.h"
#include "octree/types.h"

#define PLANE_GRID (1u << OCTREE_MAX_DEPTH)

typedef struct axis {
    double min, max;
    double unit;      /* a power of two: the unit in which `center` and `half` are stored */
    double center[2]; /* (min + max) / 2, as an unevaluated sum of two terms */
    double half[3];   /* (max - min) / 2, as an unevaluated sum of three terms; the first term has 31 bits */
    bool plain;       /* true: the first terms of `center` and `half` are exact, and the other terms are 0 */
    bool subnormal;   /* true: all coordinates of the world and their differences are subnormal */
    /* the number of grid planes per unit of length, rounded; may be 0 or infinite in extreme worlds */
    double keys_per_unit;
    double guess_error; /* an error bound of a guessed key, as a number of keys; may be infinite or NaN */
    /* the bits of the double 2^21, plus guess_error in fixed point; plane_fixed_point_key() subtracts this word */
    uint64_t sure_from;
    /* in fixed point: the length of the range of fractions for which a guessed key is certain; 0: no guess is
     * certain */
    uint64_t sure_span;
} axis;

axis axis_make(double min, double max);

/* Returns the plane at center + half * t for t in -1 .. 1, computed from all terms of `center` and `half`. */
double plane_at_precisely(const axis *a, double t);

/* Returns the plane at center + half * t, clamped to the world. Only the first terms of `center` and `half` are used if
 * they are exact. Not valid for the faces of the world. */
static inline double plane_inside(const axis *a, double t)
{
    const double plane = a->plain ? a->center[0] + a->half[0] * t : plane_at_precisely(a, t);
    if (!(plane < a->max))
        return a->max;
    return plane > a->min ? plane : a->min;
}

/* Returns the k-th grid plane, 0 <= k <= PLANE_GRID: center + half * t with the exact t = k / 2^20 - 1. The terms of
 * center and half are summed with about 80 bits and rounded once.
 *
 * So a plane equals the result of the paper's repeated (min + max) / 2 wherever the exact result is a double. Planes
 * ascend with k, because neighbours are 2^-21 of the extent apart. Nothing overflows. */
static inline double plane_at(const axis *a, uint32_t k)
{
    return k == 0 ? a->min : k == PLANE_GRID ? a->max : plane_inside(a, (double)k * 0x1p-20 - 1);
}

/* Returns a guess of a coordinate's key, as a double with a fraction. The guess differs from the real value only by
 * rounding errors. */
static inline double plane_guess_key(const axis *a, double x)
{
    const double above = x - a->min;
    return (a->subnormal ? subnormal_count(above) : above) * a->keys_per_unit;
}

/* Returns the key of a coordinate near a plane, where the guessed key may be wrong. plane_key() calls this function. */
uint32_t plane_key_near(const axis *a, double x);

/* A fixed-point number has 21 bits of a key and PLANE_FRACTION bits of fraction. Together they are the mantissa of a
 * double in [2^21, 2^22). */
#define PLANE_FRACTION 31
#define PLANE_FRACTION_MASK ((UINT64_C(1) << PLANE_FRACTION) - 1)
#define PLANE_FIXED_BITS (OCTREE_MAX_DEPTH + PLANE_FRACTION)

/* Returns the guessed key in fixed point, minus its possible error. */
static inline uint64_t plane_fixed_point_key(const axis *a, double x)
{
    const double guess = (x - a->min) * a->keys_per_unit + (double)PLANE_GRID;
    uint64_t bits;
    memcpy(&bits, &guess, sizeof bits);
    return bits - a->sure_from;
}

/* Returns a word whose highest bit is set if the guessed key is not certain; the other bits mean nothing. The highest
 * bit is always set for a coordinate outside the world. `span` is the axis's sure_span, `fixed` the result of
 * plane_fixed_point_key(). */
static inline uint64_t plane_mark_uncertain(uint64_t span, uint64_t fixed)
{
    return (span - 1 - (fixed & PLANE_FRACTION_MASK)) | (0 - (fixed >> PLANE_FIXED_BITS));
}

/* Returns the key of a coordinate inside the world, 0 <= key < PLANE_GRID.
 *
 * The guessed key is certain if it is farther from an integer than its error. The error has two parts: four roundings
 * of a number below 2^21, less than 2^-29 in all; and the distance of a plane from its ideal position, at most one ulp
 * of the world's coordinates. */
static inline uint32_t plane_key(const axis *a, double x)
{
    const uint64_t fixed = plane_fixed_point_key(a, x);
    return plane_mark_uncertain(a->sure_span, fixed) >> 63 ? plane_key_near(a, x) : (uint32_t)(fixed >> PLANE_FRACTION);
}

/* Compute the keys of a position, shifted to the left so that the highest bit of each key is bit 63. Returns false if a
 * guessed key is not certain, or if the position is outside the world. */
static inline bool compute_shifted_keys(const axis axes[3], const double position[3], uint64_t keys[3])
{
    uint64_t unsure = 0, all = 0;
    for (int i = 0; i < 3; i++) {
        const uint64_t fixed = plane_fixed_point_key(&axes[i], position[i]);
        unsure |= axes[i].sure_span - 1 - (fixed & PLANE_FRACTION_MASK);
        all |= fixed;
        keys[i] = fixed << (64 - PLANE_FIXED_BITS);
    }
    return !((unsure >> 63) | (all >> PLANE_FIXED_BITS));
}

/* A cell: the number of its lowest grid plane on each axis, and its depth. */
typedef struct cell {
    uint32_t low[3];
    unsigned depth;
} cell;

static inline uint32_t cell_size(unsigned depth)
{
    return PLANE_GRID >> depth;
}

static inline cell root_cell(void)
{
    return (cell){{0, 0, 0}, 0};
}

static inline cell cell_child(cell parent, unsigned octant)
{
    const uint32_t half = cell_size(parent.depth + 1);
    for (int i = 0; i < 3; i++)
        parent.low[i] += octant & (4u >> i) ? half : 0;
    parent.depth++;
    return parent;
}

octree_box cell_bounds(const axis axes[3], cell c);

/* Returns whether at least one of the cell's three splitting planes lies strictly inside the cell. The cell's depth
 * must be less than OCTREE_MAX_DEPTH. */
bool is_cell_divisible(const axis axes[3], cell c);

/* Returns the Morton code of three keys: 63 bits, with the bit of x as the highest bit of each group of three. */
static inline uint64_t morton_interleave(const uint32_t keys[3])
{
    return bits_spread(keys[0]) << 2 | bits_spread(keys[1]) << 1 | bits_spread(keys[2]);
}

/* Returns the Morton code of a position inside the world. */
static inline uint64_t morton_code(const axis axes[3], const double position[3])
{
    const uint32_t keys[3] = {plane_key(&axes[0], position[0]), plane_key(&axes[1], position[1]),
                              plane_key(&axes[2], position[2])};
    return morton_interleave(keys);
}

/* This value replaces a Morton code if the guessed keys of the position are not certain, or if the position is outside
 * the world. */
#define MORTON_UNSURE UINT64_MAX

/* Compute the Morton codes of `count` positions, which are `stride` doubles apart. A position whose code is not certain
 * gets MORTON_UNSURE. If such a position lies in the world, call morton_code() for it. */
void compute_morton_codes(const axis axes[3], const double *positions, size_t stride, size_t count, uint64_t *codes);

/* The maximum depth of a grid; such a grid has 2 million cells. A cell's number consists of the most significant bits
 * of its points' Morton codes. */
#define GRID_DEEPEST 7
#define GRID_UNSURE UINT32_MAX

/* Compute the grid cells of `count` positions, which are `stride` doubles apart. A position whose cell is not certain
 * gets GRID_UNSURE. */
void compute_grid_cells(const axis axes[3], unsigned depth, const double *positions, size_t stride, size_t count,
                        uint32_t *cells);

/* Returns the grid cell of one position inside the world. */
static inline uint32_t compute_grid_cell(const axis axes[3], unsigned depth, const double position[3])
{
    return (uint32_t)(morton_code(axes, position) >> 3 * (OCTREE_MAX_DEPTH - depth));
}

/* Returns the octant, in a node of this depth, that contains a Morton code. */
static inline unsigned morton_octant(uint64_t code, unsigned depth)
{
    return (unsigned)(code >> (3 * (OCTREE_MAX_DEPTH - 1 - depth))) & 7;
}

/* Conversions between Morton codes and cells. morton_cell() returns the cell of this depth that contains a code, and
 * morton_address() returns the address of that cell. morton_of_address() returns the lowest code in the cell at an
 * address. */
cell morton_cell(uint64_t code, unsigned depth);

static inline octree_address morton_address(uint64_t code, unsigned depth)
{
    return (UINT64_C(1) << 3 * depth) | code >> (3 * (OCTREE_MAX_DEPTH - depth));
}

static inline uint64_t morton_of_address(octree_address address)
{
    const unsigned depth = octree_address_depth(address);
    return (address ^ UINT64_C(1) << 3 * depth) << 3 * (OCTREE_MAX_DEPTH - depth);
}

/* A comparison function for qsort(). It sorts addresses in the order in which octree_walk() visits their nodes: parents
 * before children. */
int compare_addresses(const void *a, const void *b);

/* Returns whether a word is a valid address: the position of its leading 1 bit is a multiple of three. */
bool is_address(octree_address address);

#endif
