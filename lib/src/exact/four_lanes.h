/* SPDX-License-Identifier: MIT */
/* four_lanes.h - the operations of lanes.h in AVX2, for source files that define OCTREE_FOUR_LANES. Private. */
#ifndef OCTREE_FOUR_LANES_H
#define OCTREE_FOUR_LANES_H

#include "float_rules.h"
#include "octree/types.h"

#include <immintrin.h>

enum { LANES = 4 };

typedef __m256d lanes;
typedef __m256i lane_bits; /* four unsigned integers of 64 bits */

static inline lanes lanes_all(double a)
{
    return _mm256_set1_pd(a);
}

static inline lanes lanes_add(lanes a, lanes b)
{
    return _mm256_add_pd(a, b);
}

static inline lanes lanes_subtract(lanes a, lanes b)
{
    return _mm256_sub_pd(a, b);
}

static inline lanes lanes_multiply(lanes a, lanes b)
{
    return _mm256_mul_pd(a, b);
}

static inline lanes lanes_absolute(lanes a)
{
    return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a);
}

static inline lanes lanes_larger(lanes a, lanes b)
{
    return _mm256_max_pd(a, b);
}

static inline lanes lanes_smaller(lanes a, lanes b)
{
    return _mm256_min_pd(a, b);
}

static inline unsigned lanes_less(lanes a, lanes b)
{
    return (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OS));
}

static inline void lanes_store(double *to, lanes a)
{
    _mm256_storeu_pd(to, a);
}

static inline lanes lanes_of_bits(lane_bits bits, uint64_t mask)
{
    const lanes from = _mm256_set1_pd(0x1p52);
    const __m256i kept = _mm256_and_si256(bits, _mm256_set1_epi64x((long long)mask));
    return _mm256_sub_pd(_mm256_or_pd(_mm256_castsi256_pd(kept), from), from);
}

/* Transpose four rows of four doubles. */
static inline void lanes_load_columns(lanes to[4], const double *a, const double *b, const double *c, const double *d)
{
    const lanes row_a = _mm256_loadu_pd(a), row_b = _mm256_loadu_pd(b);
    const lanes row_c = _mm256_loadu_pd(c), row_d = _mm256_loadu_pd(d);
    const lanes even_ab = _mm256_unpacklo_pd(row_a, row_b), odd_ab = _mm256_unpackhi_pd(row_a, row_b);
    const lanes even_cd = _mm256_unpacklo_pd(row_c, row_d), odd_cd = _mm256_unpackhi_pd(row_c, row_d);
    to[0] = _mm256_permute2f128_pd(even_ab, even_cd, 0x20);
    to[1] = _mm256_permute2f128_pd(odd_ab, odd_cd, 0x20);
    to[2] = _mm256_permute2f128_pd(even_ab, even_cd, 0x31);
    to[3] = _mm256_permute2f128_pd(odd_ab, odd_cd, 0x31);
}

static inline void lanes_load_points(lanes position[3], lane_bits *ids, const octree_point *const points[LANES])
{
    lanes columns[4];
    lanes_load_columns(columns, (const double *)points[0], (const double *)points[1], (const double *)points[2],
                       (const double *)points[3]);
    for (int i = 0; i < 3; i++)
        position[i] = columns[i];
    *ids = _mm256_castpd_si256(columns[3]);
}

static inline lanes lanes_of_halves(const double low[2], const double high[2])
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high), 1);
}

/* The first column of the upper faces is loaded with the lower faces. */
static inline void lanes_load_boxes(lanes min[3], lanes max[3], const octree_box *const boxes[LANES])
{
    lanes columns[4];
    lanes_load_columns(columns, (const double *)boxes[0], (const double *)boxes[1], (const double *)boxes[2],
                       (const double *)boxes[3]);
    for (int i = 0; i < 3; i++)
        min[i] = columns[i];
    max[0] = columns[3];
    const lanes ac = lanes_of_halves(&boxes[0]->max[1], &boxes[2]->max[1]);
    const lanes bd = lanes_of_halves(&boxes[1]->max[1], &boxes[3]->max[1]);
    max[1] = _mm256_unpacklo_pd(ac, bd);
    max[2] = _mm256_unpackhi_pd(ac, bd);
}

#endif
