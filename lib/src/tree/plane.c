/* SPDX-License-Identifier: MIT */
/* plane.c - the planes of an axis, the keys of coordinates, and node addresses.
 *
 * Problem: insertion, queries and drawing must agree on every plane to the last bit, in any world from subnormal to
 * near DBL_MAX. Halving boxes repeatedly accumulates rounding, overflows in (min + max), and costs a descent per point.
 *
 * Idea: number the 2^21 + 1 finest planes of an axis. Compute plane k by one closed form, center + half * t with an
 * exact t in -1..1. `center` and `half` are unevaluated sums of a few doubles (double-double arithmetic), so that only
 * the last addition rounds. The key of a coordinate, the largest k with plane(k) <= x, then comes from one
 * multiplication: a guess with a proven error bound. If the guess is farther from an integer than this bound, the key
 * is certain; this holds for nearly all coordinates. Otherwise the planes themselves decide between neighbouring keys.
 * In extreme worlds a binary search finds the key.
 *
 * Guesses are added to 2^21, so that the bits of the double are a fixed-point number (21 bits of key, 31 of fraction)
 * and two coordinates are processed at once with SSE2.
 */
#include "octree/octree.h"
#include "../exact/float_mode.h"
#include "plane.h"

/* Set sum[0] + sum[1] = a + b exactly (Knuth's TwoSum). */
static void add_with_rounding_error(double a, double b, double sum[2])
{
    sum[0] = a + b;
    const double b_part = sum[0] - a;
    sum[1] = (a - (sum[0] - b_part)) + (b - b_part);
}

/* Returns a double with only the 31 most significant bits of `value`. The product of the result and a key, which has 22
 * bits, is exact. */
static double keep_high_31_bits(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    bits &= ~((UINT64_C(1) << 22) - 1);
    memcpy(&value, &bits, sizeof bits);
    return value;
}

/* Set the range of fractions of a guessed key for which the key is certain. Rounding to fixed point adds one more
 * error. In subnormal worlds no guess is certain, because plane_fixed_point_key() does not convert subnormal
 * numbers. */
static void set_range_of_certain_keys(axis *a)
{
    static const double first = (double)PLANE_GRID;
    const double error = a->guess_error * (double)(UINT64_C(1) << PLANE_FRACTION) + 2;
    const int64_t fraction = INT64_C(1) << PLANE_FRACTION;
    memcpy(&a->sure_from, &first, sizeof first);
    if (a->subnormal || !(2 * error < (double)fraction)) /* the condition is also true if `error` is NaN */
        return;
    a->sure_from += (uint64_t)error;
    a->sure_span = (uint64_t)(fraction - 2 * (int64_t)error);
}

axis axis_make(double min, double max)
{
    axis a = {.min = min, .max = max, .unit = 1, .keys_per_unit = (double)PLANE_GRID / (max - min)};
    a.subnormal = fabs(min) < SUBNORMAL_HALF && fabs(max) < SUBNORMAL_HALF;
    /* Small coordinates are multiplied by a power of two, so that half of a coordinate is not subnormal. */
    if (fabs(min) < 0x1p-900 && fabs(max) < 0x1p-900)
        a.unit = a.subnormal ? 0x1p-1074 : 0x1p-100;
    const double low = min / a.unit / 2, high = max / a.unit / 2;
    double half[2];
    add_with_rounding_error(high, low, a.center);
    add_with_rounding_error(high, -low, half);
    a.half[0] = keep_high_31_bits(half[0]);
    a.half[1] = half[0] - a.half[0];
    a.half[2] = half[1];
    a.guess_error = 0x1p-29 + 2 * (fmax(fabs(min), fabs(max)) * 0x1p-52 + 0x1p-1074) * a.keys_per_unit;
    if (a.subnormal) {
        a.keys_per_unit = (double)PLANE_GRID / subnormal_count(max - min);
        a.guess_error = 0x1p-29 + 4 * a.keys_per_unit;
    }
    set_range_of_certain_keys(&a);
    a.plain = a.unit == 1 && a.center[1] == 0 && a.half[1] == 0 && a.half[2] == 0;
    return a;
}

double plane_at_precisely(const axis *a, double t)
{
    double sum[2];
    add_with_rounding_error(a->center[0], a->half[0] * t, sum);
    const double rest = sum[1] + (a->center[1] + (a->half[1] * t + a->half[2] * t));
    return a->subnormal ? subnormal_from_count(sum[0] + rest) : (sum[0] + rest) * a->unit;
}

/* Find the largest key whose plane is at most x, by binary search. */
static uint32_t find_key_by_bisection(const axis *a, double x)
{
    uint32_t key = 0;
    for (uint32_t half = PLANE_GRID / 2; half > 0; half /= 2)
        if (plane_at(a, key + half) <= x)
            key += half;
    return key;
}

/* Returns the correct key of x, near the guessed key. A usable guess is wrong only by rounding errors, so the planes
 * decide between the guess and its neighbours. In worlds that are a few ulps wide, or whose extent overflows, the guess
 * is useless, and a binary search finds the key. */
uint32_t plane_key_near(const axis *a, double x)
{
    const double guess = plane_guess_key(a, x);
    /* The guess needs no test for negative values, because it is never negative. */
    if (!(a->keys_per_unit > 0 && a->guess_error < 1 && guess < (double)PLANE_GRID))
        return find_key_by_bisection(a, x);
    uint32_t key = (uint32_t)guess;
    const double fraction = guess - (double)key;
    if (fraction > a->guess_error && fraction < 1 - a->guess_error)
        return key;
    while (key > 0 && plane_at(a, key) > x)
        key--;
    while (key + 1 < PLANE_GRID && plane_at(a, key + 1) <= x)
        key++;
    return key;
}

#ifdef OCTREE_SSE2

/* One step of bits_spread() for two words at once. */
static inline __m128i spread_bits_step(__m128i x, int shift, uint64_t mask)
{
    return _mm_and_si128(_mm_or_si128(x, _mm_slli_epi64(x, shift)), _mm_set1_epi64x((long long)mask));
}

static inline __m128i spread_bits_of_two_keys(__m128i x)
{
    x = spread_bits_step(x, 32, UINT64_C(0x001f00000000ffff));
    x = spread_bits_step(x, 16, UINT64_C(0x001f0000ff0000ff));
    x = spread_bits_step(x, 8, UINT64_C(0x100f00f00f00f00f));
    x = spread_bits_step(x, 4, UINT64_C(0x10c30c30c30c30c3));
    return spread_bits_step(x, 2, UINT64_C(0x1249249249249249));
}

/* Insert two zero bits before each bit of two numbers, each of at most 8 bits. */
static inline __m128i spread_bits_of_two_bytes(__m128i x)
{
    x = spread_bits_step(x, 8, UINT64_C(0x100f00f00f00f00f));
    x = spread_bits_step(x, 4, UINT64_C(0x10c30c30c30c30c3));
    return spread_bits_step(x, 2, UINT64_C(0x1249249249249249));
}

/* The constants of an axis. Each constant is stored twice, so that SSE2 processes two positions at once. */
typedef struct axis_pair {
    __m128d min, keys_per_unit;
    __m128i sure_from, sure_last;
} axis_pair;

static inline void make_axis_pairs(const axis axes[3], axis_pair pairs[3])
{
    for (int i = 0; i < 3; i++)
        pairs[i] = (axis_pair){_mm_set1_pd(axes[i].min), _mm_set1_pd(axes[i].keys_per_unit),
                               _mm_set1_epi64x((long long)axes[i].sure_from),
                               _mm_set1_epi64x((long long)(axes[i].sure_span - 1))};
}

/* Compute plane_fixed_point_key() of two coordinates at once. In *unsure, the highest bit of each 64-bit half is set as
 * plane_mark_uncertain() sets it. */
static inline __m128i compute_fixed_keys_of_two(const axis_pair *a, double p, double q, __m128i *unsure)
{
    const __m128i fraction = _mm_set1_epi64x((long long)PLANE_FRACTION_MASK);
    const __m128d above = _mm_sub_pd(_mm_set_pd(q, p), a->min);
    const __m128d guess = _mm_add_pd(_mm_mul_pd(above, a->keys_per_unit), _mm_set1_pd((double)PLANE_GRID));
    const __m128i fixed = _mm_sub_epi64(_mm_castpd_si128(guess), a->sure_from);
    const __m128i outside = _mm_sub_epi64(_mm_setzero_si128(), _mm_srli_epi64(fixed, PLANE_FIXED_BITS));
    const __m128i near = _mm_sub_epi64(a->sure_last, _mm_and_si128(fixed, fraction));
    *unsure = _mm_or_si128(*unsure, _mm_or_si128(near, outside));
    return fixed;
}

/* For each 64-bit half of a vector: set all bits if the half's highest bit is set, else clear all bits. */
static inline __m128i fill_lanes_if_uncertain(__m128i unsure)
{
    return _mm_sub_epi64(_mm_setzero_si128(), _mm_srli_epi64(unsure, 63));
}

/* Compute the Morton codes of two positions. A code is MORTON_UNSURE if a guessed key of the position is not
 * certain. */
static inline void compute_codes_of_two_points(const axis_pair axes[3], const double *p, const double *q,
                                               uint64_t codes[2])
{
    __m128i sums = _mm_setzero_si128(), unsure = sums;
    for (int i = 0; i < 3; i++) {
        const __m128i fixed = compute_fixed_keys_of_two(&axes[i], p[i], q[i], &unsure);
        sums = _mm_or_si128(_mm_slli_epi64(sums, 1), spread_bits_of_two_keys(_mm_srli_epi64(fixed, PLANE_FRACTION)));
    }
    _mm_storeu_si128((__m128i *)codes, _mm_or_si128(sums, fill_lanes_if_uncertain(unsure)));
}

/* Compute the grid cells of two positions, from the most significant bits of each key. A cell is GRID_UNSURE if a
 * guessed key of the position is not certain. */
static inline void compute_cells_of_two_points(const axis_pair axes[3], unsigned depth, const double *p,
                                               const double *q, uint32_t cells[2])
{
    const __m128i shift = _mm_cvtsi32_si128((int)(PLANE_FIXED_BITS - depth));
    __m128i sums = _mm_setzero_si128(), unsure = sums;
    for (int i = 0; i < 3; i++) {
        const __m128i fixed = compute_fixed_keys_of_two(&axes[i], p[i], q[i], &unsure);
        sums = _mm_or_si128(_mm_slli_epi64(sums, 1), spread_bits_of_two_bytes(_mm_srl_epi64(fixed, shift)));
    }
    const __m128i both = _mm_or_si128(sums, fill_lanes_if_uncertain(unsure));
    _mm_storel_epi64((__m128i *)cells, _mm_shuffle_epi32(both, _MM_SHUFFLE(3, 3, 2, 0)));
}

#else

static inline uint64_t compute_code_if_certain(const axis axes[3], const double p[3])
{
    uint64_t code = 0, unsure = 0;
    for (int i = 0; i < 3; i++) {
        const uint64_t fixed = plane_fixed_point_key(&axes[i], p[i]);
        unsure |= plane_mark_uncertain(axes[i].sure_span, fixed);
        code = code << 1 | bits_spread(fixed >> PLANE_FRACTION);
    }
    return code | (0 - (unsure >> 63));
}

typedef axis axis_pair;

static inline void make_axis_pairs(const axis axes[3], axis_pair pairs[3])
{
    memcpy(pairs, axes, 3 * sizeof *pairs);
}

static inline void compute_codes_of_two_points(const axis axes[3], const double *p, const double *q, uint64_t codes[2])
{
    codes[0] = compute_code_if_certain(axes, p);
    codes[1] = compute_code_if_certain(axes, q);
}

static inline void compute_cells_of_two_points(const axis axes[3], unsigned depth, const double *p, const double *q,
                                               uint32_t cells[2])
{
    const unsigned shift = 3 * (OCTREE_MAX_DEPTH - depth);
    const uint64_t codes[2] = {compute_code_if_certain(axes, p), compute_code_if_certain(axes, q)};
    for (int i = 0; i < 2; i++)
        cells[i] = codes[i] == MORTON_UNSURE ? GRID_UNSURE : (uint32_t)(codes[i] >> shift);
}

#endif

void compute_morton_codes(const axis axes[3], const double *positions, size_t stride, size_t count, uint64_t *codes)
{
    axis_pair pairs[3];
    uint64_t last[2];
    make_axis_pairs(axes, pairs);
    for (; count >= 2; count -= 2, codes += 2, positions += 2 * stride)
        compute_codes_of_two_points(pairs, positions, positions + stride, codes);
    if (count > 0) {
        compute_codes_of_two_points(pairs, positions, positions, last);
        codes[0] = last[0];
    }
}

void compute_grid_cells(const axis axes[3], unsigned depth, const double *positions, size_t stride, size_t count,
                        uint32_t *cells)
{
    axis_pair pairs[3];
    uint32_t last[2];
    make_axis_pairs(axes, pairs);
    for (; count >= 2; count -= 2, cells += 2, positions += 2 * stride)
        compute_cells_of_two_points(pairs, depth, positions, positions + stride, cells);
    if (count > 0) {
        compute_cells_of_two_points(pairs, depth, positions, positions, last);
        cells[0] = last[0];
    }
}

octree_box cell_bounds(const axis axes[3], cell c)
{
    octree_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = plane_at(&axes[i], c.low[i]);
        box.max[i] = plane_at(&axes[i], c.low[i] + cell_size(c.depth));
    }
    return box;
}

cell morton_cell(uint64_t code, unsigned depth)
{
    cell c = root_cell();
    while (c.depth < depth)
        c = cell_child(c, morton_octant(code, c.depth));
    return c;
}

bool is_cell_divisible(const axis axes[3], cell c)
{
    const uint32_t half = cell_size(c.depth + 1);
    for (int i = 0; i < 3; i++) {
        const double middle = plane_at(&axes[i], c.low[i] + half);
        if (plane_at(&axes[i], c.low[i]) < middle && middle < plane_at(&axes[i], c.low[i] + 2 * half))
            return true;
    }
    return false;
}

/* ---- Addresses ---------------------------------------------------------------------------------------------- */

int compare_addresses(const void *a, const void *b)
{
    const octree_address p = *(const octree_address *)a, q = *(const octree_address *)b;
    const uint64_t p_corner = p << (63 - bits_highest(p)), q_corner = q << (63 - bits_highest(q));
    return p_corner != q_corner ? (p_corner < q_corner ? -1 : 1) : (p > q) - (p < q);
}

bool is_address(octree_address address)
{
    return address != 0 && bits_highest(address) % 3 == 0;
}

unsigned octree_address_depth(octree_address address)
{
    return address ? bits_highest(address) / 3 : 0;
}

unsigned octree_address_octant(octree_address address, unsigned level)
{
    const unsigned depth = octree_address_depth(address);
    return level < depth ? (unsigned)(address >> 3 * (depth - 1 - level)) & 7 : 0;
}

char *octree_address_format(octree_address address, char text[OCTREE_ADDRESS_TEXT])
{
    const unsigned depth = octree_address_depth(address);
    char *at = text;
    for (unsigned level = 0; level < depth; level++) {
        if (level > 0)
            *at++ = '/';
        *at++ = (char)('0' + octree_address_octant(address, level));
    }
    *at = 0;
    return depth ? text : strcpy(text, "root");
}

bool octree_address_parse(const char *text, octree_address *address)
{
    if (!text || !address)
        return false;
    *address = OCTREE_ROOT;
    if (strcmp(text, "root") == 0 || strcmp(text, "/") == 0)
        return true;
    octree_address parsed = OCTREE_ROOT;
    for (unsigned depth = 0; depth < OCTREE_MAX_DEPTH; depth++, text += 2) {
        if (text[0] < '0' || text[0] > '7')
            return false;
        parsed = parsed << 3 | (octree_address)(text[0] - '0');
        if (text[1] == 0) {
            *address = parsed;
            return true;
        }
        if (text[1] != '/')
            return false;
    }
    return false;
}

octree_box octree_cell_box(const octree_box *world, octree_address address)
{
    RETURN_IN_DEFAULT_MODE(octree_box, octree_cell_box, world, address);
    axis axes[3];
    for (int i = 0; i < 3; i++)
        axes[i] = axis_make(world->min[i], world->max[i]);
    if (!is_address(address))
        address = OCTREE_ROOT;
    return cell_bounds(axes, morton_cell(morton_of_address(address), octree_address_depth(address)));
}
