/* SPDX-License-Identifier: MIT */
/* fuzz_tree.c - libFuzzer entry of sequences of library calls, made on a tree and on a list of points, which must
 * agree. The first bytes choose the tree, and each operation is six bytes. Coordinates are whole numbers, so that a
 * scan is exact. If an operation makes an allocation fail, the tree must be unchanged. Build with clang
 * -fsanitize=fuzzer,address,undefined. */
#include "octree/octree.h"
#include "octree/sample.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { SIDE = 16, PLACES = SIDE + 2, MOST_POINTS = 4096, MOST_OPERATIONS = 200, MOST_NEIGHBORS = 40, IDS = 64 };

/* A tree and the points that it must hold. */
typedef struct model {
    octree *tree;
    octree_point points[MOST_POINTS]; /* in no order */
    size_t count;
    uint16_t (*of)[IDS];    /* by place and id: the index of the point plus 1; 0: it is not stored */
    bool grows;             /* if not set, leaves refuse points, and the statuses say which points are stored */
    size_t until_no_memory; /* allocations that succeed; SIZE_MAX: all */
    uint64_t state;         /* state of the random numbers for batches */
} model;

static void check(bool holds)
{
    if (!holds)
        abort();
}

/* ---- The tree's surroundings -------------------------------------------------------------------------------- */

static void *allocate(size_t size, void *context)
{
    model *m = context;
    if (m->until_no_memory == 0)
        return NULL;
    m->until_no_memory -= m->until_no_memory != SIZE_MAX;
    return malloc(size);
}

static void release(void *memory, size_t size, void *context)
{
    (void)size, (void)context;
    free(memory);
}

static void run_backwards(octree_task *task, size_t count, void *task_context, void *context)
{
    (void)context;
    while (count > 0)
        task(--count, task_context);
}

static void create(model *m, const uint8_t head[4])
{
    static const size_t capacities[] = {1, 2, 3, 8, 64, OCTREE_AUTO};
    octree_def def = octree_def_default();
    static uint16_t of[PLACES * PLACES * PLACES][IDS];
    *m = (model){.of = of, .grows = head[0] & 1, .until_no_memory = SIZE_MAX, .state = head[3]};
    def.world = (octree_box){{0, 0, 0}, {SIDE, SIDE, SIDE}};
    def.leaf_capacity = capacities[head[1] % (m->grows ? 6 : 5)];
    def.max_depth = head[2] % 8;
    def.full_leaf = m->grows ? OCTREE_GROW : OCTREE_REFUSE;
    def.allocator = (octree_allocator){allocate, release, m};
    if (head[0] & 2)
        def.executor.run = run_backwards;
    check(octree_create(&def, &m->tree) == OCTREE_OK);
}

/* ---- The list ----------------------------------------------------------------------------------------------- */

static bool same_point(const octree_point *a, const octree_point *b)
{
    return a->id == b->id && memcmp(a->position, b->position, sizeof a->position) == 0;
}

static uint16_t *entry(model *m, const octree_point *p)
{
    const size_t x = (size_t)p->position[0], y = (size_t)p->position[1], z = (size_t)p->position[2];
    return &m->of[(x * PLACES + y) * PLACES + z][p->id];
}

static octree_point *find(model *m, const octree_point *p)
{
    const uint16_t index = *entry(m, p);
    return index ? &m->points[index - 1] : NULL;
}

static void put(model *m, size_t index, const octree_point *p)
{
    m->points[index] = *p;
    *entry(m, p) = (uint16_t)(index + 1);
}

static void clear(model *m)
{
    while (m->count > 0)
        *entry(m, &m->points[--m->count]) = 0;
}

static bool is_inside(const octree_point *p)
{
    return p->position[0] <= SIDE && p->position[1] <= SIDE && p->position[2] <= SIDE;
}

/* Check the status of an insertion against the statuses that are possible, and insert the point if the tree did. */
static void insert(model *m, const octree_point *p, octree_status status)
{
    const octree_status expected = !is_inside(p) ? OCTREE_OUTSIDE : find(m, p) ? OCTREE_DUPLICATE : OCTREE_OK;
    check(status == expected || (!m->grows && expected == OCTREE_OK && status == OCTREE_FULL));
    if (status == OCTREE_OK)
        put(m, m->count++, p);
}

static void take_out(model *m, const octree_point *p, octree_status status)
{
    octree_point *found = find(m, p);
    check(status == (!is_inside(p) ? OCTREE_OUTSIDE : found ? OCTREE_OK : OCTREE_NOT_FOUND));
    if (status != OCTREE_OK)
        return;
    *entry(m, p) = 0;
    const size_t index = (size_t)(found - m->points);
    if (index < --m->count)
        put(m, index, &m->points[m->count]);
}

static void move(model *m, const octree_point *p, const double to[3], octree_status status)
{
    octree_point there = {.id = p->id};
    memcpy(there.position, to, sizeof there.position);
    octree_point *found = find(m, p);
    const bool outside = !is_inside(p) || !is_inside(&there),
               taken = found && !same_point(p, &there) && find(m, &there);
    const octree_status expected = outside  ? OCTREE_OUTSIDE
                                   : !found ? OCTREE_NOT_FOUND
                                   : taken  ? OCTREE_DUPLICATE
                                            : OCTREE_OK;
    check(status == expected || (!m->grows && expected == OCTREE_OK && status == OCTREE_FULL));
    if (status != OCTREE_OK)
        return;
    *entry(m, p) = 0;
    put(m, (size_t)(found - m->points), &there);
}

/* ---- Changes ------------------------------------------------------------------------------------------------ */

static uint64_t below(model *m, uint64_t most)
{
    return octree_random(&m->state) % most;
}

/* A random point, sometimes just outside the world. */
static octree_point random_point(model *m)
{
    octree_point p = {.id = below(m, IDS)};
    for (int axis = 0; axis < 3; axis++)
        p.position[axis] = (double)below(m, below(m, 50) ? SIDE + 1 : SIDE + 2);
    return p;
}

/* Mostly a stored point. */
static octree_point known_point(model *m)
{
    return m->count > 0 && below(m, 8) ? m->points[below(m, m->count)] : random_point(m);
}

static void change_one(model *m, unsigned what)
{
    const octree_point p = what == 0 ? random_point(m) : known_point(m), to = random_point(m);
    const octree_status status = what == 0   ? octree_insert(m->tree, p.position, p.id)
                                 : what == 1 ? octree_remove(m->tree, p.position, p.id)
                                             : octree_move(m->tree, p.position, p.id, to.position);
    if (status == OCTREE_NO_MEMORY)
        return;
    if (what == 0)
        insert(m, &p, status);
    else if (what == 1)
        take_out(m, &p, status);
    else
        move(m, &p, to.position, status);
}

static void change_many(model *m, unsigned what, size_t count)
{
    static octree_point points[MOST_POINTS];
    static double to[MOST_POINTS][3];
    static octree_status statuses[MOST_POINTS];
    size_t made, ok = 0;
    for (size_t i = 0; i < count; i++) {
        points[i] = what == 0 ? random_point(m) : known_point(m);
        const octree_point there = random_point(m);
        memcpy(to[i], there.position, sizeof to[i]);
    }
    const octree_status status = what == 0   ? octree_insert_many(m->tree, points, count, statuses, &made)
                                 : what == 1 ? octree_remove_many(m->tree, points, count, statuses, &made)
                                             : octree_move_many(m->tree, points, to, count, statuses, &made);
    if (status == OCTREE_NO_MEMORY)
        return;
    check(status == OCTREE_OK);
    for (size_t i = 0; i < count; i++) {
        ok += statuses[i] == OCTREE_OK;
        if (what == 0)
            insert(m, &points[i], statuses[i]);
        else if (what == 1)
            take_out(m, &points[i], statuses[i]);
        else
            move(m, &points[i], to[i], statuses[i]);
    }
    check(made == ok);
}

static void change_all(model *m, unsigned what)
{
    const octree_box worlds[] = {{{0, 0, 0}, {SIDE, SIDE, SIDE}}, {{-1, -3, -7}, {2 * SIDE, SIDE, SIDE + 1}}};
    octree_status status = OCTREE_OK;
    if (what == 0)
        status = octree_clear(m->tree);
    if (what == 0 && status == OCTREE_OK)
        clear(m);
    if (what == 1)
        status = octree_compact(m->tree);
    else if (what == 2)
        status = m->grows ? octree_tune(m->tree, NULL) : OCTREE_OK;
    else if (what == 3 && m->grows) /* change the world and restore it, because the list has only one world */
        for (int i = 1; i >= 0 && status != OCTREE_NO_MEMORY; i--, m->until_no_memory = SIZE_MAX)
            status = octree_reworld(m->tree, &worlds[i]);
    check(status == OCTREE_OK || status == OCTREE_NO_MEMORY);
}

/* ---- Queries ------------------------------------------------------------------------------------------------ */

static double squared_distance(const double a[3], const double b[3])
{
    return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);
}

static bool is_in_box(const octree_box *box, const double p[3])
{
    bool inside = true;
    for (int axis = 0; axis < 3; axis++)
        inside = inside && p[axis] >= box->min[axis] && p[axis] <= box->max[axis];
    return inside;
}

static void ask_range(model *m)
{
    static octree_point found[MOST_POINTS];
    const octree_point a = random_point(m), b = random_point(m);
    octree_box box;
    size_t count, expected = 0, counted;
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = a.position[axis] < b.position[axis] ? a.position[axis] : b.position[axis];
        box.max[axis] = a.position[axis] < b.position[axis] ? b.position[axis] : a.position[axis];
    }
    for (size_t i = 0; i < m->count; i++)
        expected += is_in_box(&box, m->points[i].position);
    check(octree_range_collect_sorted(m->tree, &box, NULL, found, MOST_POINTS, &count) == OCTREE_OK);
    check(octree_range_count(m->tree, &box, &counted) == OCTREE_OK && count == expected && counted == expected);
    for (size_t i = 0; i < count; i++) {
        check(is_in_box(&box, found[i].position) && find(m, &found[i]));
        check(i == 0 || octree_compare_points(&found[i - 1], &found[i]) < 0);
    }
}

static bool count_point(const octree_point *point, void *context)
{
    (void)point;
    ++*(size_t *)context;
    return true;
}

static void ask_radius(model *m)
{
    const octree_point center = random_point(m);
    const double radius = (double)below(m, SIDE);
    size_t found = 0, expected = 0;
    for (size_t i = 0; i < m->count; i++)
        expected += squared_distance(m->points[i].position, center.position) <= radius * radius;
    check(octree_radius(m->tree, center.position, radius, NULL, count_point, &found) == OCTREE_OK);
    check(found == expected);
}

/* The number of points before a neighbour: by distance, then by id, then by position. */
static size_t rank_of(const model *m, const double target[3], const octree_point *p)
{
    const double distance = squared_distance(p->position, target);
    size_t rank = 0;
    for (size_t i = 0; i < m->count; i++) {
        const double d = squared_distance(m->points[i].position, target);
        rank += d < distance || (d == distance && octree_compare_points(&m->points[i], p) < 0);
    }
    return rank;
}

static void ask_neighbors(model *m, size_t k)
{
    octree_neighbor found[MOST_NEIGHBORS];
    const octree_point target = random_point(m);
    size_t count;
    check(octree_nearest_k(m->tree, target.position, k, NULL, found, &count) == OCTREE_OK);
    check(count == (k < m->count ? k : m->count));
    for (size_t i = 0; i < count; i++)
        check(rank_of(m, target.position, &found[i].point) == i && find(m, &found[i].point));
}

static void ask_batch(model *m, size_t count)
{
    static double targets[MOST_POINTS][3];
    static octree_neighbor found[MOST_POINTS];
    static bool any[MOST_POINTS];
    for (size_t i = 0; i < count; i++) {
        const octree_point target = random_point(m);
        memcpy(targets[i], target.position, sizeof targets[i]);
    }
    if (octree_nearest_batch(m->tree, (const double(*)[3])targets, count, NULL, found, any) == OCTREE_NO_MEMORY)
        return;
    for (size_t i = 0; i < count; i += 1 + count / 16) /* each check is a scan */
        check(any[i] == (m->count > 0) && (!any[i] || rank_of(m, targets[i], &found[i].point) == 0));
}

/* ---- A sequence --------------------------------------------------------------------------------------------- */

/* Room for `wanted` further points. */
static size_t room(const model *m, size_t wanted)
{
    return wanted < MOST_POINTS - m->count ? wanted : MOST_POINTS - m->count;
}

static void check_tree(model *m)
{
    check(octree_count(m->tree) == m->count && octree_check(m->tree, NULL) == NULL);
}

static void operate(model *m, const uint8_t *at)
{
    const size_t many = at[1] | (size_t)(at[2] & 15) << 8;
    const unsigned kind = at[0] % 12;
    m->state = m->state << 8 ^ at[3] ^ (uint64_t)at[4] << 16;
    m->until_no_memory = at[5] & 128 ? at[5] & 127 : SIZE_MAX;
    if (kind < 3 && (kind > 0 || room(m, 1)))
        change_one(m, kind);
    else if (kind >= 3 && kind < 6)
        change_many(m, kind - 3, kind == 3 ? room(m, many) : many);
    else if (kind == 6)
        change_all(m, at[1] % 4);
    else if (kind == 7)
        ask_range(m);
    else if (kind == 8)
        ask_radius(m);
    else if (kind == 9)
        ask_neighbors(m, at[1] % (MOST_NEIGHBORS + 1));
    else if (kind == 10)
        ask_batch(m, many);
    m->until_no_memory = SIZE_MAX;
    check_tree(m);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    enum { HEAD = 4, OPERATION = 6 };
    static model m;
    if (size < HEAD)
        return 0;
    create(&m, data);
    for (size_t i = 0, at = HEAD; at + OPERATION <= size && i < MOST_OPERATIONS; i++, at += OPERATION)
        operate(&m, data + at);
    octree_destroy(m.tree);
    clear(&m);
    return 0;
}
