/* morton_sort.c - a radix sort from the highest digit down: what shares its first digits soon fits a cache. */
#include "morton_sort.h"

#include <string.h>

#define DIGIT_BITS 8
#define DIGITS (1u << DIGIT_BITS)
#define FEW 32 /* sorted by insertion */

static unsigned digit_of(const morton_item *item, unsigned shift)
{
    return (unsigned)(item->code << 1 >> shift) & (DIGITS - 1); /* 63 bits */
}

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

/* Move the items to where their digit begins. ends[d] becomes the end of digit d. */
static void scatter(const morton_item *from, morton_item *to, size_t count, unsigned shift, uint32_t ends[DIGITS])
{
    uint32_t next = 0;
    for (unsigned digit = 0; digit < DIGITS; digit++) {
        const uint32_t here = ends[digit];
        ends[digit] = next;
        next += here;
    }
    for (size_t i = 0; i < count; i++)
        to[ends[digit_of(&from[i], shift)]++] = from[i];
}

/* Sort by the digits from `shift` down, into `to` or in place. */
static void sort(morton_item *items, morton_item *other, size_t count, unsigned shift, bool in_place)
{
    if (count <= FEW) {
        insertion_sort(items, count);
        if (!in_place)
            memcpy(other, items, count * sizeof *items);
        return;
    }
    uint32_t ends[DIGITS] = {0};
    for (size_t i = 0; i < count; i++)
        ends[digit_of(&items[i], shift)]++;
    if (ends[digit_of(&items[0], shift)] == count) { /* all alike */
        if (shift > 0)
            sort(items, other, count, shift - DIGIT_BITS, in_place);
        else if (!in_place)
            memcpy(other, items, count * sizeof *items);
        return;
    }
    scatter(items, other, count, shift, ends);
    uint32_t start = 0;
    for (unsigned digit = 0; digit < DIGITS; digit++) {
        if (shift > 0)
            sort(other + start, items + start, ends[digit] - start, shift - DIGIT_BITS, !in_place);
        else if (in_place)
            memcpy(items + start, other + start, (ends[digit] - start) * sizeof *items);
        start = ends[digit];
    }
}

void morton_sort(morton_item *items, morton_item *spare, size_t count)
{
    sort(items, spare, count, 64 - DIGIT_BITS, true);
}
