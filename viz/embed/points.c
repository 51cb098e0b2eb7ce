/* SPDX-License-Identifier: MIT */
/* points.c - stores a program's points by id: see points.h. */
#include "points.h"
#include "array.h"
#include "octree/digest.h"
#include "octree/octree.h"
#include "session_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The radix sort takes one byte of the id at a time, from the lowest byte. Ids below SESSION_ID_LIMIT fit into seven
 * bytes. */
enum { DIGITS = 7, DIGIT_VALUES = 256 };

void points_release(points *p)
{
    free(p->items);
    *p = (points){0};
}

static bool reserve_points_in_list(points *p, size_t count)
{
    return array_grow(&p->items, count, &p->room, sizeof *p->items);
}

static octree_walk_order add_leaf(const octree_node *node, void *context)
{
    points *p = context;
    if (!node->leaf)
        return OCTREE_WALK_ON;
    if (node->count > p->room - p->count)
        return OCTREE_WALK_STOP; /* unreachable: there is room for all points of the tree */
    if (node->count > 0)
        memcpy(p->items + p->count, node->points, node->count * sizeof *p->items);
    p->count += node->count;
    return OCTREE_WALK_ON;
}

static unsigned get_digit(uint64_t id, int digit)
{
    return (unsigned)(id >> (8 * digit)) & (DIGIT_VALUES - 1);
}

/* Sort points by one digit of their ids. The sort is stable. Returns false and moves nothing if all ids have the same
 * digit. */
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
        to[starts[get_digit(from->items[i].id, digit)]++] = from->items[i];
    return true;
}

void points_swap(points *a, points *b)
{
    const points other = *a;
    *a = *b;
    *b = other;
}

/* Sort points whose ids lie close together, as ids of array elements do, in one pass: by the difference from the least
 * id. Returns false and moves nothing if the ids are too far apart or memory runs out. */
static bool sort_dense_ids(points *p, points *spare)
{
    enum { SPARSE = 4 };
    uint64_t least = UINT64_MAX, most = 0;
    for (size_t i = 0; i < p->count; i++) {
        least = p->items[i].id < least ? p->items[i].id : least;
        most = p->items[i].id > most ? p->items[i].id : most;
    }
    uint32_t *starts = most - least < SPARSE * (uint64_t)p->count && p->count <= UINT32_MAX
                           ? calloc((size_t)(most - least) + 2, sizeof *starts)
                           : NULL;
    if (!starts)
        return false;
    for (size_t i = 0; i < p->count; i++)
        starts[p->items[i].id - least + 1]++;
    for (size_t i = 0; i <= most - least; i++)
        starts[i + 1] += starts[i];
    for (size_t i = 0; i < p->count; i++)
        spare->items[starts[p->items[i].id - least]++] = p->items[i];
    free(starts);
    spare->count = p->count;
    points_swap(p, spare);
    return true;
}

static void sort_by_digits(points *p, points *spare)
{
    size_t counts[DIGITS][DIGIT_VALUES] = {{0}};
    for (size_t i = 0; i < p->count; i++)
        for (int digit = 0; digit < DIGITS; digit++)
            counts[digit][get_digit(p->items[i].id, digit)]++;
    for (int digit = 0; digit < DIGITS; digit++) {
        if (!sort_by_digit(p, spare->items, counts[digit], digit))
            continue;
        spare->count = p->count;
        points_swap(p, spare);
    }
}

static void sort_by_id(points *p, points *spare)
{
    if (!sort_dense_ids(p, spare))
        sort_by_digits(p, spare);
}

static octreel_status check_ids_and_sort(points *p, points *spare, uint64_t *clash)
{
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

octreel_status points_read(points *p, points *spare, const octree *tree, const octree_point *list, size_t count,
                           uint64_t *clash)
{
    p->count = 0;
    if (count == 0)
        return OCTREEL_OK;
    if (!reserve_points_in_list(p, count) || !reserve_points_in_list(spare, count))
        return OCTREEL_NO_MEMORY;
    if (tree)
        octree_walk(tree, add_leaf, p); /* octree_walk() cannot fail here, because its arguments are valid */
    else
        memcpy(p->items, list, count * sizeof *list);
    p->count = count;
    return check_ids_and_sort(p, spare, clash);
}

typedef struct body_lists {
    points *positions, *extents;
} body_lists;

static void add_vector(points *p, uint64_t id, const double vector[3])
{
    octree_point *added = &p->items[p->count++];
    memcpy(added->position, vector, sizeof added->position);
    added->id = id;
}

static bool add_body(const octree_body *body, void *context)
{
    const body_lists *lists = context;
    add_vector(lists->positions, body->id, body->position);
    if (has_extents(body->half))
        add_vector(lists->extents, body->id, body->half);
    return true;
}

octreel_status points_read_bodies(points *p, points *extents, points *spare, const octree_bodies *set,
                                  const octree_body *list, size_t count, uint64_t *clash)
{
    const octree_region everywhere = {.box = {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}}};
    body_lists lists = {p, extents};
    p->count = extents->count = 0;
    if (!reserve_points_in_list(p, count) || !reserve_points_in_list(extents, count) ||
        !reserve_points_in_list(spare, count))
        return OCTREEL_NO_MEMORY;
    if (set)
        octree_bodies_search(set, &everywhere, NULL, add_body, &lists); /* cannot fail: its arguments are valid */
    for (size_t i = 0; !set && i < count; i++)
        add_body(&list[i], &lists);
    if (extents->count > 0)
        sort_by_id(extents, spare);
    return p->count > 0 ? check_ids_and_sort(p, spare, clash) : OCTREEL_OK;
}

/* ---- The table ----------------------------------------------------------------------------------------------
 *
 * The hash table uses open addressing with linear probing, and at most three quarters of its slots are full. A removal
 * moves later points of the cluster up and leaves no tombstone, so long runs with many removals stay fast. */

static const uint64_t NO_ID = UINT64_MAX;
enum { SMALLEST_TABLE = 16 };

void point_table_release(point_table *t)
{
    free(t->slots);
    *t = (point_table){0};
}

static size_t find_home_slot(const point_table *t, uint64_t id)
{
    return (size_t)octree_digest_word(0, id) & (t->size - 1);
}

/* Returns the slot that holds the id. If the id is missing, returns the empty slot where it can be inserted. */
static size_t find_slot(const point_table *t, uint64_t id)
{
    size_t slot = find_home_slot(t, id);
    while (t->slots[slot].id != id && t->slots[slot].id != NO_ID)
        slot = (slot + 1) & (t->size - 1);
    return slot;
}

bool point_table_reserve(point_table *t, size_t count)
{
    if (count <= t->size / 4 * 3)
        return true;
    point_table grown = {.size = t->size ? t->size : SMALLEST_TABLE};
    while (grown.size / 4 * 3 < count && grown.size <= SIZE_MAX / sizeof *grown.slots / 2)
        grown.size *= 2;
    if (grown.size / 4 * 3 < count || !(grown.slots = malloc(grown.size * sizeof *grown.slots)))
        return false;
    for (size_t i = 0; i < grown.size; i++)
        grown.slots[i].id = NO_ID;
    for (size_t i = 0; i < t->size; i++)
        if (t->slots[i].id != NO_ID)
            point_table_set(&grown, &t->slots[i]);
    point_table_release(t);
    *t = grown;
    return true;
}

const octree_point *point_table_find(const point_table *t, uint64_t id)
{
    const octree_point *at = t->size ? &t->slots[find_slot(t, id)] : NULL;
    return at && at->id == id ? at : NULL;
}

void point_table_set(point_table *t, const octree_point *point)
{
    octree_point *at = &t->slots[find_slot(t, point->id)];
    t->count += at->id == NO_ID;
    *at = *point;
}

/* Remove a point from the hash table, which uses linear probing, and close the hole that the point leaves. Each later
 * point of the run of used slots moves into the hole, unless the hole lies before the slot to which the point's id
 * hashes. */
void point_table_remove(point_table *t, uint64_t id)
{
    const size_t mask = t->size - 1;
    size_t hole = find_slot(t, id);
    for (size_t next = (hole + 1) & mask; t->slots[next].id != NO_ID; next = (next + 1) & mask) {
        const size_t home = find_home_slot(t, t->slots[next].id);
        if (((next - home) & mask) < ((next - hole) & mask))
            continue;
        t->slots[hole] = t->slots[next];
        hole = next;
    }
    t->slots[hole].id = NO_ID;
    t->count--;
}

bool point_table_list(const point_table *t, points *p, points *spare)
{
    p->count = 0;
    if (t->count == 0)
        return true;
    if (!reserve_points_in_list(p, t->count) || !reserve_points_in_list(spare, t->count))
        return false;
    for (size_t i = 0; i < t->size; i++)
        if (t->slots[i].id != NO_ID)
            p->items[p->count++] = t->slots[i];
    sort_by_id(p, spare);
    return true;
}
