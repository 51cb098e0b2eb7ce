/* SPDX-License-Identifier: MIT */
/* float_box.h - boxes of floats, of which four are compared at once. Private. */
#ifndef OCTREE_FLOAT_BOX_H
#define OCTREE_FLOAT_BOX_H

#include "../exact/float_rules.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A box whose faces are floats: those of bodies, relative to a world and rounded (see snapshot.c). */
typedef struct float_box {
    float min[3], max[3];
} float_box;

/* The boxes of bodies, as one array for each face. */
typedef struct box_columns {
    float *min[3], *max[3];
} box_columns;

/* The greatest number of boxes that one call of find_meeting_boxes() compares, and how many more it may read. */
enum { BOXES_AT_ONCE = 64, BOX_PADDING = 3 };

static inline float_box make_empty_float_box(void)
{
    return (float_box){{HUGE_VALF, HUGE_VALF, HUGE_VALF}, {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF}};
}

static inline void include_float_box(float_box *around, const float_box *box)
{
    for (int k = 0; k < 3; k++) {
        around->min[k] = box->min[k] < around->min[k] ? box->min[k] : around->min[k];
        around->max[k] = box->max[k] > around->max[k] ? box->max[k] : around->max[k];
    }
}

/* Without branches, because they would be unpredictable. */
static inline bool float_boxes_meet(const float_box *a, const float_box *b)
{
    bool meet = true;
    for (int k = 0; k < 3; k++)
        meet &= (a->min[k] <= b->max[k]) & (b->min[k] <= a->max[k]);
    return meet;
}

static inline float_box box_in_columns(const box_columns *boxes, size_t index)
{
    return (float_box){{boxes->min[0][index], boxes->min[1][index], boxes->min[2][index]},
                       {boxes->max[0][index], boxes->max[1][index], boxes->max[2][index]}};
}

static inline void store_in_columns(box_columns *boxes, size_t index, const float_box *box)
{
    for (int k = 0; k < 3; k++) {
        boxes->min[k][index] = box->min[k];
        boxes->max[k][index] = box->max[k];
    }
}

#ifdef OCTREE_SSE2
static inline uint64_t find_meeting(const box_columns *boxes, size_t first, size_t count, const float_box *box)
{
    uint64_t found = 0;
    __m128 low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = _mm_set1_ps(box->min[k]);
        high[k] = _mm_set1_ps(box->max[k]);
    }
    for (size_t i = 0; i < count; i += 4) {
        __m128 meets = _mm_cmple_ps(_mm_loadu_ps(&boxes->min[0][first + i]), high[0]);
        meets = _mm_and_ps(meets, _mm_cmple_ps(low[0], _mm_loadu_ps(&boxes->max[0][first + i])));
        for (int k = 1; k < 3; k++) {
            meets = _mm_and_ps(meets, _mm_cmple_ps(_mm_loadu_ps(&boxes->min[k][first + i]), high[k]));
            meets = _mm_and_ps(meets, _mm_cmple_ps(low[k], _mm_loadu_ps(&boxes->max[k][first + i])));
        }
        found |= (uint64_t)_mm_movemask_ps(meets) << i;
    }
    return found;
}
#else
static inline uint64_t find_meeting(const box_columns *boxes, size_t first, size_t count, const float_box *box)
{
    uint64_t found = 0;
    for (size_t i = 0; i < count; i++) {
        const float_box other = box_in_columns(boxes, first + i);
        found |= (uint64_t)float_boxes_meet(&other, box) << i;
    }
    return found;
}
#endif

/* Returns a bit mask of the boxes first .. first + count - 1 that meet a box. 1 <= count <= BOXES_AT_ONCE. */
static inline uint64_t find_meeting_boxes(const box_columns *boxes, size_t first, size_t count, const float_box *box)
{
    return find_meeting(boxes, first, count, box) & UINT64_MAX >> (BOXES_AT_ONCE - count);
}

#endif
