/* SPDX-License-Identifier: MIT */
/* points.c - the points of a tree, by id. */
#include "points.h"
#include "array.h"
#include "session_file.h"

#include <stdlib.h>
#include <string.h>

/* Ids are sorted byte by byte, from the lowest: the bytes of those below SESSION_ID_LIMIT. */
enum { DIGITS = 7, DIGIT_VALUES = 256 };

void points_release(points *p)
{
    free(p->items);
    *p = (points){0};
}

bool points_reserve(points *p, size_t count)
{
    octree_point *items = array_reserve(p->items, count, &p->room, sizeof *items);
    p->items = items ? items : p->items;
    return items || count == 0;
}

static octree_walk_order add_leaf(const octree_node *node, void *context)
{
    points *p = context;
    if (!node->leaf)
        return OCTREE_WALK_ON;
    if (node->count > p->room - p->count)
        return OCTREE_WALK_STOP; /* cannot happen: there is room for all */
    if (node->count > 0)
        memcpy(p->items + p->count, node->points, node->count * sizeof *p->items);
    p->count += node->count;
    return OCTREE_WALK_ON;
}

static unsigned digit_of(uint64_t id, int digit)
{
    return (unsigned)(id >> (8 * digit)) & (DIGIT_VALUES - 1);
}

/* Order by one digit, equal ones as they were. False when all points have the same: nothing is moved then. */
static bool sort_by_digit(const points *from, octree_point *to, const size_t counts[DIGIT_VALUES], int digit)
{
    size_t starts[DIGIT_VALUES], sum = 0;
    for (int i = 0; i < DIGIT_VALUES; i++) {
        if (counts[i] == from->count)
            return false;
        starts[i] = sum;
        sum += counts[i];
    }
    for (size_t i = 0; i < from->count; i++)
        to[starts[digit_of(from->items[i].id, digit)]++] = from->items[i];
    return true;
}

void points_swap(points *a, points *b)
{
    const points other = *a;
    *a = *b;
    *b = other;
}

static void sort_by_id(points *p, points *spare)
{
    size_t counts[DIGITS][DIGIT_VALUES] = {{0}};
    for (size_t i = 0; i < p->count; i++)
        for (int digit = 0; digit < DIGITS; digit++)
            counts[digit][digit_of(p->items[i].id, digit)]++;
    for (int digit = 0; digit < DIGITS; digit++) {
        if (!sort_by_digit(p, spare->items, counts[digit], digit))
            continue;
        spare->count = p->count;
        points_swap(p, spare);
    }
}

octreel_status points_read(points *p, points *spare, const octree *tree, uint64_t *clash)
{
    const size_t count = octree_count(tree);
    p->count = 0;
    if (count == 0)
        return OCTREEL_OK;
    if (!points_reserve(p, count) || !points_reserve(spare, count))
        return OCTREEL_NO_MEMORY;
    if (octree_walk(tree, add_leaf, p) != OCTREE_OK)
        return OCTREEL_FLOAT_MODE;
    for (size_t i = 0; i < p->count; i++) {
        *clash = p->items[i].id;
        if (*clash >= SESSION_ID_LIMIT)
            return OCTREEL_BAD_ID;
    }
    sort_by_id(p, spare);
    for (size_t i = 1; i < p->count; i++) {
        *clash = p->items[i].id;
        if (*clash == p->items[i - 1].id)
            return OCTREEL_DUPLICATE_ID;
    }
    return OCTREEL_OK;
}
