/* SPDX-License-Identifier: MIT */
/* morton_sort.c - a radix sort from the world down to small cells, whose items soon fit a cache. */
#include "morton_sort.h"
#include "tasks.h"

#include <string.h>

#define FEW 16   /* sorted by insertion */
#define LEVELS 3 /* of cells a pass goes down, at most: it scatters to 8^3 places */

typedef struct sorter {
    size_t unsorted;
    bool differ;   /* no two items are one point, whatever their codes: repetitions are not looked for */
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
    if (left > 0 && count <= s->unsorted && (s->differ || !has_repetition(items, count)))
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

static bool sort_alone(morton_item *items, morton_item *other, size_t count, unsigned left, bool in_place,
                       size_t unsorted, bool differ)
{
    uint32_t ends[OCTREE_MAX_DEPTH / LEVELS << 3 * LEVELS]; /* a section for each pass in progress */
    sorter s = {.unsorted = unsorted, .differ = differ};
    sort(&s, items, other, count, left, in_place, ends);
    return s.repeated;
}

bool morton_sort(morton_item *items, morton_item *spare, size_t count, unsigned depth, size_t unsorted)
{
    return sort_alone(items, spare, count, OCTREE_MAX_DEPTH - depth, true, unsorted, false);
}

/* ---- By tasks ----------------------------------------------------------------------------------------------- */

enum { DIGITS = 1 << 3 * LEVELS };

/* One pass, and the cells that it leaves. */
typedef struct pass {
    const octree *tree;
    uint32_t (*counts)[DIGITS]; /* of each task: of items with a digit, then where its next one goes */
    morton_item *from, *to;
    size_t count, unsorted;
    unsigned tasks, left, shift; /* levels below the cells */
    bool differ;
    bool in_place;           /* the cells end up where they are */
    size_t ends[DIGITS + 1]; /* of the cells; that of the first is at 1 */
    unsigned cells[TASKS_AT_MOST + 1];
    bool repeated[TASKS_AT_MOST];
} pass;

static size_t digit_of(const pass *p, const morton_item *item)
{
    return (size_t)(item->code >> p->shift) & (DIGITS - 1);
}

static void count_digits(size_t number, void *context)
{
    const pass *p = context;
    uint32_t *counts = p->counts[number];
    memset(counts, 0, sizeof p->counts[number]);
    for (size_t i = tasks_share(p->count, p->tasks, number); i < tasks_share(p->count, p->tasks, number + 1); i++)
        counts[digit_of(p, &p->from[i])]++;
}

static void scatter_share(size_t number, void *context)
{
    const pass *p = context;
    uint32_t *next = p->counts[number];
    for (size_t i = tasks_share(p->count, p->tasks, number); i < tasks_share(p->count, p->tasks, number + 1); i++)
        p->to[next[digit_of(p, &p->from[i])]++] = p->from[i];
}

static void place_digits(pass *p)
{
    uint32_t next = 0;
    p->ends[0] = 0;
    for (unsigned digit = 0; digit < DIGITS; digit++) {
        for (unsigned task = 0; task < p->tasks; task++) {
            const uint32_t here = p->counts[task][digit];
            p->counts[task][digit] = next;
            next += here;
        }
        p->ends[digit + 1] = next;
    }
}

/* Such a cell is divided into tasks in its turn. */
static bool is_large(const pass *p, unsigned digit)
{
    return p->left > 0 && p->ends[digit + 1] - p->ends[digit] > p->count / 8 && tasks_for(p->tree, p->count / 8) > 1;
}

static void sort_cells(size_t number, void *context)
{
    pass *p = context;
    uint32_t ends[OCTREE_MAX_DEPTH / LEVELS << 3 * LEVELS];
    sorter s = {.unsorted = p->unsorted, .differ = p->differ};
    for (unsigned digit = p->cells[number]; digit < p->cells[number + 1]; digit++) {
        const size_t start = p->ends[digit], count = p->ends[digit + 1] - start;
        if (count > 0 && !is_large(p, digit))
            sort(&s, p->to + start, p->from + start, count, p->left, p->in_place, ends);
    }
    p->repeated[number] = s.repeated;
}

static void share_cells(pass *p)
{
    unsigned digit = 0;
    for (unsigned task = 0; task < p->tasks; task++) {
        p->cells[task] = digit;
        while (digit < DIGITS && p->ends[digit + 1] <= tasks_share(p->count, p->tasks, task + 1))
            digit++;
    }
    p->cells[p->tasks] = DIGITS;
}

/* Sort the items of a cell with `left` levels below it, into `other` or in place; without memory for the counts on one
 * thread. */
static bool sort_by_tasks(const octree *tree, arena *memory, morton_item *items, morton_item *other, size_t count,
                          unsigned left, bool in_place, size_t unsorted, bool differ)
{
    pass p = {.tree = tree, .from = items, .to = other, .count = count, .unsorted = unsorted, .differ = differ};
    p.tasks = tasks_for(tree, count);
    p.left = left - LEVELS;
    p.shift = 3 * p.left;
    p.in_place = !in_place;
    p.counts = arena_take(memory, p.tasks * sizeof *p.counts);
    if (!p.counts)
        return sort_alone(items, other, count, left, in_place, unsorted, differ);
    tasks_run(tree, count_digits, p.tasks, &p);
    place_digits(&p);
    tasks_run(tree, scatter_share, p.tasks, &p);
    arena_give(memory, p.counts, p.tasks * sizeof *p.counts);
    share_cells(&p);
    tasks_run(tree, sort_cells, p.tasks, &p);
    bool repeated = false;
    for (unsigned task = 0; task < p.tasks; task++)
        repeated |= p.repeated[task];
    for (unsigned digit = 0; digit < DIGITS; digit++)
        if (is_large(&p, digit))
            repeated |= sort_by_tasks(tree, memory, other + p.ends[digit], items + p.ends[digit],
                                      p.ends[digit + 1] - p.ends[digit], p.left, p.in_place, unsorted, differ);
    return repeated;
}

bool morton_sort_tasks(const octree *tree, arena *memory, morton_item *items, morton_item *spare, size_t count,
                       size_t unsorted, bool differ)
{
    if (tasks_for(tree, count) == 1)
        return sort_alone(items, spare, count, OCTREE_MAX_DEPTH, true, unsorted, differ);
    return sort_by_tasks(tree, memory, items, spare, count, OCTREE_MAX_DEPTH, true, unsorted, differ);
}
