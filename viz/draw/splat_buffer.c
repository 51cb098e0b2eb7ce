/* SPDX-License-Identifier: MIT */
/* splat_buffer.c - draws discs into a buffer of depths, and computes the light from the depths.
 *
 * A cloud of a million points has 25 million samples of discs in a picture, so the loops over samples decide how fast a
 * view turns. These loops have no branches, and compilers turn them into vector instructions:
 *    - Discs of the same diameter differ only in their position, so one table holds the depths of all of them. The
 *      rows of the table are padded to whole vectors, with depths that lie behind everything.
 *    - A sample without a disc has the depth EMPTY_DEPTH, behind every disc.
 *    - Two discs seldom have the same depth at a sample. A row of a disc is first drawn as if the disc lost every
 *      tie. If there was a tie, the row is visited again, and the view depths of the two points decide.
 *    - The margin around the picture has samples without discs, so that light is computed without a test for the
 *      picture's border. */
#include "splat_buffer.h"
#include "array.h"
#include "camera.h"

#include <stdlib.h>
#include <string.h>

/* EMPTY_DEPTH is the depth of a sample without a disc. OUTSIDE is a table's entry for a sample outside the disc. For
 * the depth d of every disc: d < EMPTY_DEPTH < d + OUTSIDE. */
#define EMPTY_DEPTH ((3 << 28) - 1)
#define OUTSIDE (5 << 28)

/* The number of samples to which rows of tables are padded. */
#define VECTOR 4

/* ---- Memory --------------------------------------------------------------------------------------------------- */

/* The two distances, in samples, at which a sample is compared with its neighbours. */
static int find_near_reach(const scene *s)
{
    return s->unit * s->view.aa;
}

static int find_far_reach(const scene *s)
{
    return 4 * find_near_reach(s);
}

void splat_buffer_release(splat_buffer *b)
{
    free(b->depths);
    free(b->owners);
    for (int side = 0; side <= MOST_TABLE_SIDE; side++)
        free(b->tables[side]);
    *b = (splat_buffer){0};
}

bool splat_buffer_clear(splat_buffer *b, const scene *s)
{
    b->width = s->view.width;
    b->height = s->view.height;
    b->margin = s->view.shade == SHADE_EDL ? find_far_reach(s) : 0;
    b->stride = (size_t)(b->width + 2 * b->margin);
    const size_t size = b->stride * (size_t)(b->height + 2 * b->margin);
    if (!array_grow(&b->depths, size, &b->depth_room, sizeof *b->depths) ||
        !array_grow(&b->owners, size, &b->owner_room, sizeof *b->owners))
        return false;
    for (size_t i = 0; i < size; i++)
        b->depths[i] = EMPTY_DEPTH;
    memset(b->owners, 0, size * sizeof *b->owners);
    return true;
}

/* ---- Discs ---------------------------------------------------------------------------------------------------- */

/* Returns whether a sample is inside a disc of diameter `side`. `far` is the square of the sample's distance from the
 * disc's centre, in half samples. */
static bool is_in_disc(int side, int far)
{
    return side <= 2 || far <= side * side;
}

bool find_disc_depth(const splat_square *q, int x, int y, int32_t depth, int32_t *at)
{
    const int dx = 2 * (x - q->left) - q->side + 1, dy = 2 * (y - q->top) - q->side + 1, far = dx * dx + dy * dy;
    *at = depth + far / (4 * q->side);
    return is_in_disc(q->side, far);
}

/* Returns the number of samples in a row of a table. */
static int find_table_stride(int side)
{
    return (side + VECTOR - 1) / VECTOR * VECTOR;
}

/* Returns the table for discs of diameter `side`, which is made at the first call. An entry says how much deeper a
 * sample is than the disc's centre; rows come from the top down. Returns null if memory runs out. */
static const int32_t *find_or_make_table(splat_buffer *b, int side)
{
    const int stride = find_table_stride(side);
    if (b->tables[side])
        return b->tables[side];
    int32_t *table = malloc((size_t)(side * stride) * sizeof *table);
    for (int i = 0; table && i < side * stride; i++)
        if (i % stride >= side || !find_disc_depth(&(splat_square){.side = side}, i % stride, i / stride, 0, &table[i]))
            table[i] = OUTSIDE;
    return b->tables[side] = table;
}

/* Returns whether point a is nearer than point b. The caller has found that the integer depths of both are equal. If
 * their view depths are equal too, the point with the lower id counts as nearer. */
static bool is_nearer(const scene *s, size_t a, size_t b)
{
    double seen[2][3];
    camera_transform(&s->camera, s->markers.items[a].at, seen[0]);
    camera_transform(&s->camera, s->markers.items[b].at, seen[1]);
    if (seen[0][2] != seen[1][2])
        return seen[0][2] < seen[1][2];
    return s->markers.items[a].id < s->markers.items[b].id;
}

/* Draw one sample of a disc. `at` is the depth of the disc at the sample. */
static void draw_sample(const scene *s, int32_t *depth, uint32_t *owner, int32_t at, uint32_t own)
{
    if (at > *depth || (at == *depth && (*owner == own || !is_nearer(s, own - 1, *owner - 1))))
        return;
    *depth = at;
    *owner = own;
}

/* Draw a row of a disc, except samples where another disc has the same depth. Returns whether there are such
 * samples. */
static bool draw_row(int32_t *restrict depths, uint32_t *restrict owners, const int32_t *restrict table, int count,
                     int32_t depth, uint32_t own)
{
    uint32_t ties = 0;
    for (int x = 0; x < count; x++) {
        const int32_t at = depth + table[x], now = depths[x];
        const uint32_t nearer = at < now ? UINT32_MAX : 0;
        ties |= at == now ? UINT32_MAX : 0;
        depths[x] = at < now ? at : now;
        owners[x] = (own & nearer) | (owners[x] & ~nearer);
    }
    return ties != 0;
}

static void draw_ties(const scene *s, int32_t *depths, uint32_t *owners, const int32_t *table, int count, int32_t depth,
                      uint32_t own)
{
    for (int x = 0; x < count; x++)
        if (depths[x] == depth + table[x])
            draw_sample(s, &depths[x], &owners[x], depth + table[x], own);
}

/* Draw a disc that may reach beyond the picture, or that is too large for a table. */
static void draw_clipped_disc(splat_buffer *b, const scene *s, uint32_t own, const splat_square *q, int32_t depth)
{
    const int right = q->left + q->side, bottom = q->top + q->side;
    const int left = q->left > 0 ? q->left : 0, end = right < b->width ? right : b->width;
    for (int y = q->top > 0 ? q->top : 0; y < bottom && y < b->height; y++) {
        const size_t row = (size_t)(y + b->margin) * b->stride + (size_t)b->margin;
        for (int x = left; x < end; x++) {
            int32_t at;
            if (find_disc_depth(q, x, y, depth, &at))
                draw_sample(s, &b->depths[row + (size_t)x], &b->owners[row + (size_t)x], at, own);
        }
    }
}

bool splat_buffer_draw_disc(splat_buffer *b, const scene *s, size_t index, const splat_square *q, int32_t depth)
{
    const int stride = find_table_stride(q->side);
    const bool inside = q->left >= 0 && q->top >= 0 && q->left + stride <= b->width && q->top + q->side <= b->height;
    const uint32_t own = (uint32_t)index + 1;
    if (!inside || q->side > MOST_TABLE_SIDE) {
        draw_clipped_disc(b, s, own, q, depth);
        return true;
    }
    const int32_t *table = find_or_make_table(b, q->side);
    size_t at = (size_t)(q->top + b->margin) * b->stride + (size_t)(q->left + b->margin);
    for (int y = 0; table && y < q->side; y++, at += b->stride)
        if (draw_row(b->depths + at, b->owners + at, table + y * stride, stride, depth, own))
            draw_ties(s, b->depths + at, b->owners + at, table + y * stride, stride, depth, own);
    return table;
}

/* ---- Light ---------------------------------------------------------------------------------------------------- */

/* A sample gets half of the full light if the sum of its slopes is this number, in units of depth per sample. */
#define HALF_LIGHT 160

/* The steepest slope that is counted, in units of depth per sample. If a slope is steeper, the neighbour belongs to
 * another object. */
#define STEEPEST (4 * DEPTH_PARTS)

/* Returns how much nearer than `depth` a neighbour is, limited to -most..most. Returns 0 if the neighbour has no
 * disc. */
static int32_t find_slope(int32_t depth, int32_t neighbor, int32_t most)
{
    const int32_t slope = neighbor == EMPTY_DEPTH ? 0 : depth - neighbor, low = slope < -most ? -most : slope;
    return low > most ? most : low;
}

/* Returns a / b rounded down, for 0 <= a < 2^23 and 0 < b: the quotient of floats is then never rounded up to a whole
 * number. Floats are divided because there are no vector instructions that divide integers. */
static int32_t divide_small(int32_t a, int32_t b)
{
    return (int32_t)((float)a / (float)b);
}

/* Add to sums[x] how much deeper sample x of the row is than its two neighbours, `step` samples before and after it. A
 * negative sum of the two differences counts as 0. On a plane the two differences cancel, so that a plane is lit
 * evenly, however steep the plane is. */
static void add_slopes(const int32_t *restrict row, int count, ptrdiff_t step, int32_t most, int32_t *restrict sums)
{
    const int32_t *before = row - step, *after = row + step;
    for (int x = 0; x < count; x++) {
        const int32_t both = find_slope(row[x], before[x], most) + find_slope(row[x], after[x], most);
        sums[x] += both > 0 ? both : 0;
    }
}

/* Add to depths[x] how much deeper sample x of the row is than the eight samples around it at the distance `reach`, in
 * units of depth per sample. `down` is the distance from a row to the next, in samples. `sums` is scratch space. */
static void add_depth_below_neighbors(const int32_t *row, int count, ptrdiff_t down, int reach, int32_t *restrict sums,
                                      int32_t *restrict depths)
{
    const ptrdiff_t steps[4] = {reach, reach * down, reach * (down + 1), reach * (down - 1)};
    memset(sums, 0, (size_t)count * sizeof *sums);
    for (int i = 0; i < 4; i++)
        add_slopes(row, count, steps[i], STEEPEST * reach, sums);
    for (int x = 0; x < count; x++)
        depths[x] += divide_small(sums[x], reach);
}

/* Eye-dome lighting at two distances shows both fine and large shapes. */
void splat_buffer_find_light(const splat_buffer *b, const scene *s, int y, int32_t *light)
{
    const int count = b->width;
    const ptrdiff_t down = (ptrdiff_t)b->stride;
    const int32_t *row = b->depths + (y + b->margin) * down + b->margin;
    memset(light, 0, (size_t)count * sizeof *light);
    add_depth_below_neighbors(row, count, down, find_near_reach(s), light + count, light);
    add_depth_below_neighbors(row, count, down, find_far_reach(s), light + count, light);
    for (int x = 0; x < count; x++)
        light[x] = divide_small(256 * HALF_LIGHT, HALF_LIGHT + light[x]);
}
