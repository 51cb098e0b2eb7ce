/* SPDX-License-Identifier: MIT */
#include "plane.h"

/* sum[0] + sum[1] = a + b, without error (Knuth's TwoSum). */
static void add_exactly(double a, double b, double sum[2])
{
    sum[0] = a + b;
    const double b_seen = sum[0] - a;
    sum[1] = (a - (sum[0] - b_seen)) + (b - b_seen);
}

/* The first 31 bits of a double: their product with the 22 bits of a key is exact. */
static double first_bits(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    bits &= ~((UINT64_C(1) << 22) - 1);
    memcpy(&value, &bits, sizeof bits);
    return value;
}

axis axis_make(double min, double max)
{
    axis a = {.min = min, .max = max, .unit = 1, .keys_per_unit = (double)PLANE_GRID / (max - min)};
    a.subnormal = fabs(min) < SUBNORMAL_HALF && fabs(max) < SUBNORMAL_HALF;
    if (fabs(min) < 0x1p-900 && fabs(max) < 0x1p-900)
        a.unit = a.subnormal ? 0x1p-1074 : 0x1p-100; /* so that halves are not subnormal */
    const double low = min / a.unit / 2, high = max / a.unit / 2;
    double half[2];
    add_exactly(high, low, a.center);
    add_exactly(high, -low, half);
    a.half[0] = first_bits(half[0]);
    a.half[1] = half[0] - a.half[0];
    a.half[2] = half[1];
    a.guess_error = 0x1p-29 + 2 * (fmax(fabs(min), fabs(max)) * 0x1p-52 + 0x1p-1074) * a.keys_per_unit;
    if (a.subnormal) {
        a.keys_per_unit = (double)PLANE_GRID / subnormal_count(max - min);
        a.guess_error = 0x1p-29 + 4 * a.keys_per_unit;
    }
    a.plain = a.unit == 1 && a.center[1] == 0 && a.half[1] == 0 && a.half[2] == 0;
    return a;
}

double plane_precise(const axis *a, double t)
{
    double sum[2];
    add_exactly(a->center[0], a->half[0] * t, sum);
    const double rest = sum[1] + (a->center[1] + (a->half[1] * t + a->half[2] * t));
    return a->subnormal ? subnormal_of(sum[0] + rest) : (sum[0] + rest) * a->unit;
}

/* Binary search for the largest key whose plane is at most x. */
static uint32_t key_search(const axis *a, double x)
{
    uint32_t key = 0;
    for (uint32_t half = PLANE_GRID / 2; half > 0; half /= 2)
        if (plane_at(a, key + half) <= x)
            key += half;
    return key;
}

/* The guess is right up to rounding, so the planes decide between it and its neighbours. Where it is useless (worlds a
 * few ulps wide, extents that overflow) a binary search finds the key. */
uint32_t plane_key_near(const axis *a, double x)
{
    const double guess = plane_guess(a, x);
    if (!(a->keys_per_unit > 0 && a->guess_error < 1 && guess >= 0 && guess < (double)PLANE_GRID))
        return key_search(a, x);
    uint32_t key = (uint32_t)guess;
    while (key > 0 && plane_at(a, key) > x)
        key--;
    while (key + 1 < PLANE_GRID && plane_at(a, key + 1) <= x)
        key++;
    return key;
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

bool cell_divisible(const axis axes[3], cell c)
{
    if (c.depth >= OCTREE_MAX_DEPTH)
        return false;
    const uint32_t half = cell_size(c.depth + 1);
    for (int i = 0; i < 3; i++) {
        const double middle = plane_at(&axes[i], c.low[i] + half);
        if (plane_at(&axes[i], c.low[i]) < middle && middle < plane_at(&axes[i], c.low[i] + 2 * half))
            return true;
    }
    return false;
}

/* ---- Addresses ---------------------------------------------------------------------------------------------- */

int address_compare(const void *a, const void *b)
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
    axis axes[3];
    for (int i = 0; i < 3; i++)
        axes[i] = axis_make(world->min[i], world->max[i]);
    if (!is_address(address))
        address = OCTREE_ROOT;
    return cell_bounds(axes, morton_cell(morton_of_address(address), octree_address_depth(address)));
}
