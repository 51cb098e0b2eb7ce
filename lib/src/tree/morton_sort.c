/* SPDX-License-Identifier: MIT */
/* A radix sort from the world down to small cells, whose items soon fit a cache. */
#include "morton_sort.h"
#include "plane.h"

#include <string.h>

#define FEW 16   /* sorted by insertion */
#define LEVELS 3 /* of cells a pass goes down, at most: it scatters to 8^3 places */

typedef struct sorter {
    size_t unsorted;
    bool repeated; /* some items may have one code */
} sorter;

static void insertion_sort(morton_item *items, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        const morton_item item = items[i];
        size_t at = i;
        for (; at > 0 && items[at - 1].code > item.code; at--)
            items[at] = items[at - 1];
        items[at] = item;
    }
}

static bool is_among(const morton_item *items, size_t count, uint64_t code)
{
    for (size_t i = 0; i < count; i++)
        if (items[i].code == code)
            return true;
    return false;
}

/* Whether two of up to MORTON_UNSORTED items have the same code. A filter of 12 bits of a product (Knuth's
 * multiplicative hash) rarely finds two alike, so that most often nothing is compared. */
static bool has_repetition(const morton_item *items, size_t count)
{
    uint64_t filter[(1u << 12) / 64] = {0};
    for (size_t i = 0; i < count; i++) {
        const unsigned hash = (unsigned)(items[i].code * UINT64_C(0x9e3779b97f4a7c15) >> 52);
        const uint64_t bit = UINT64_C(1) << hash % 64;
        if ((filter[hash / 64] & bit) && is_among(items, i, items[i].code))
            return true;
        filter[hash / 64] |= bit;
    }
    return false;
}

/* The items of a cell with `left` levels below it that is not divided any further. */
static void finish(sorter *s, morton_item *items, size_t count, unsigned left)
{
    if (left > 0 && count <= s->unsorted && !has_repetition(items, count))
        return;
    s->repeated = true;
    if (left > 0)
        insertion_sort(items, count);
}

/* As many levels as leave a few items in each cell. */
static unsigned levels_for(const sorter *s, size_t count, unsigned left)
{
    const size_t wanted = s->unsorted > 4 ? s->unsorted : 4;
    unsigned levels = 1;
    while (levels < left && levels < LEVELS && count >> 3 * levels > wanted)
        levels++;
    return levels;
}

/* Move the items to where those of their digit begin. ends[d], the number of items with digit d, becomes their end. */
static void scatter(const morton_item *from, morton_item *to, size_t count, unsigned shift, unsigned digits,
                    uint32_t ends[])
{
    uint32_t next = 0;
    for (unsigned digit = 0; digit < digits; digit++) {
        const uint32_t here = ends[digit];
        ends[digit] = next;
        next += here;
    }
    for (size_t i = 0; i < count; i++)
        to[ends[from[i].code >> shift & (digits - 1)]++] = from[i];
}

/* Sort the items of a cell with `left` levels below it, into `other` or in place. */
static void sort(sorter *s, morton_item *items, morton_item *other, size_t count, unsigned left, bool in_place,
                 uint32_t ends[])
{
    if (left == 0 || count <= FEW || count <= s->unsorted) {
        finish(s, items, count, left);
        if (!in_place)
            memcpy(other, items, count * sizeof *items);
        return;
    }
    const unsigned levels = levels_for(s, count, left), digits = 1u << 3 * levels, shift = 3 * (left - levels);
    memset(ends, 0, digits * sizeof *ends);
    for (size_t i = 0; i < count; i++)
        ends[items[i].code >> shift & (digits - 1)]++;
    if (ends[items[0].code >> shift & (digits - 1)] == count) { /* all in one cell */
        sort(s, items, other, count, left - levels, in_place, ends);
        return;
    }
    scatter(items, other, count, shift, digits, ends);
    for (uint32_t digit = 0, start = 0; digit < digits; start = ends[digit++])
        if (ends[digit] > start)
            sort(s, other + start, items + start, ends[digit] - start, left - levels, !in_place, ends + digits);
}

bool morton_sort(morton_item *items, morton_item *spare, size_t count, unsigned depth, size_t unsorted)
{
    uint32_t ends[OCTREE_MAX_DEPTH / LEVELS << 3 * LEVELS]; /* a section for each pass in progress */
    sorter s = {.unsorted = unsorted};
    sort(&s, items, spare, count, OCTREE_MAX_DEPTH - depth, true, ends);
    return s.repeated;
}
