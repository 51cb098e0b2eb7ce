/* SPDX-License-Identifier: MIT */
/* test_grid_fill.c - trees built by a grid equal trees of single insertions: statuses, nodes and points. */
#include "fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "counting_allocator.h"

enum { COUNT = 640 }; /* in cells of which a leaf of two points or more takes most */

static const size_t capacities[] = {1, 2, 3, 8, 64, 100};
enum { CAPACITIES = sizeof capacities / sizeof capacities[0] };

/* Points of which one in `crowd` lies at one place, alone in an octant, and one in `stray` nowhere in the world. Ids
 * are counted. */
static void draw(octree_point points[COUNT], octree_sample_kind kind, size_t crowd, size_t stray)
{
    brute all = {0};
    const octree_box world = cube(-1, 1);
    brute_sample(&all, kind, 5, &world, COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        points[i] = all.points[i];
        points[i].id = 10 + 3 * i;
        const double *at = points[i].position;
        if (crowd < COUNT && at[0] >= 0 && at[1] >= 0 && at[2] >= 0)
            points[i].position[0] = -0.5 - at[0] / 2;
        for (int axis = 0; axis < 3 && i % crowd == 0; axis++)
            points[i].position[axis] = 0.3;
        if (i % stray == stray - 1)
            points[i].position[i % 3] = i % 2 ? NAN : 1.5;
    }
    brute_free(&all);
}

static void assert_alike(const octree *a, const octree *b)
{
    assert_int_equal(octree_count(a), octree_count(b));
    assert_true(octree_digest(a) == octree_digest(b));
    assert_valid(a);
}

static void assert_inserted_alike(const octree_point points[COUNT], size_t capacity, size_t depth,
                                  octree_full_leaf full_leaf)
{
    octree *batched = make_tree(cube(-1, 1), capacity, depth, full_leaf);
    octree *stepped = make_tree(cube(-1, 1), capacity, depth, full_leaf);
    octree_status statuses[COUNT];
    size_t done, expected = 0;
    assert_int_equal(octree_insert_many(batched, points, COUNT, statuses, &done), OCTREE_OK);
    for (size_t i = 0; i < COUNT; i++) {
        const octree_status status = octree_insert(stepped, points[i].position, points[i].id);
        assert_int_equal(statuses[i], status);
        expected += status == OCTREE_OK;
    }
    assert_int_equal(done, expected);
    assert_alike(batched, stepped);
    octree_destroy(batched);
    octree_destroy(stepped);
}

static void a_tree_filled_by_a_grid_equals_one_of_single_insertions(void **state)
{
    (void)state;
    static octree_point points[COUNT];
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++)
        for (size_t crowd = 30; crowd <= 3000; crowd *= 100) {
            draw(points, (octree_sample_kind)kind, crowd, 70);
            for (int c = 0; c < CAPACITIES; c++)
                for (int full_leaf = OCTREE_REFUSE; full_leaf <= OCTREE_GROW; full_leaf++) {
                    assert_inserted_alike(points, capacities[c], 21, (octree_full_leaf)full_leaf);
                    assert_inserted_alike(points, capacities[c], 3, (octree_full_leaf)full_leaf);
                }
        }
    draw(points, OCTREE_SAMPLE_UNIFORM, COUNT, 1); /* none in the world */
    assert_inserted_alike(points, 8, 21, OCTREE_GROW);
}

/* ---- Moves -------------------------------------------------------------------------------------------------- */

typedef struct moves {
    octree_point points[COUNT];
    double to[COUNT][3];
    size_t count;
} moves;

/* Of some points every one but those whose number ends in `stays`, a little; some are told from where they are not,
 * some leave the world, and some ids are not stored. */
static void draw_moves(moves *m, const octree_point points[COUNT], size_t stays, bool errs)
{
    uint64_t random = 3;
    m->count = 0;
    for (size_t i = 0; i < COUNT; i++) {
        if (i % 10 == stays)
            continue;
        octree_point *from = &m->points[m->count];
        double *to = m->to[m->count++];
        *from = points[i];
        for (int axis = 0; axis < 3; axis++)
            to[axis] = fmin(fmax(from->position[axis] + (double)random_below(&random, 401) / 1000 - 0.2, -1), 1);
        if (errs && i % 50 == 3)
            from->position[1] = -from->position[1] / 2;
        if (errs && i % 50 == 13)
            to[2] = i % 100 == 13 ? INFINITY : -1.25;
        if (errs && i % 50 == 23)
            from->id++;
    }
}

static octree *make_filled(const octree_point points[COUNT], size_t capacity, octree_full_leaf full_leaf)
{
    octree *tree = make_tree(cube(-1, 1), capacity, 21, full_leaf);
    assert_int_equal(octree_insert_many(tree, points, COUNT, NULL, NULL), OCTREE_OK);
    return tree;
}

static void assert_moved_alike(const octree_point points[COUNT], const moves *m, size_t capacity,
                               octree_full_leaf full_leaf)
{
    octree *batched = make_filled(points, capacity, full_leaf), *stepped = make_filled(points, capacity, full_leaf);
    octree_status statuses[COUNT];
    size_t done, expected = 0;
    assert_int_equal(octree_move_many(batched, m->points, (const double(*)[3])m->to, m->count, statuses, &done),
                     OCTREE_OK);
    for (size_t i = 0; i < m->count; i++) {
        const octree_status status = octree_move(stepped, m->points[i].position, m->points[i].id, m->to[i]);
        assert_int_equal(statuses[i], status);
        expected += status == OCTREE_OK;
    }
    assert_int_equal(done, expected);
    assert_alike(batched, stepped);
    octree_destroy(batched);
    octree_destroy(stepped);
}

static void a_tree_rebuilt_by_moves_equals_one_of_single_moves(void **state)
{
    (void)state;
    static octree_point points[COUNT];
    static moves m;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++)
        for (size_t stays = 7; stays <= 10; stays += 3)
            for (int errs = 0; errs < 2; errs++) {
                draw(points, (octree_sample_kind)kind, COUNT, COUNT + 1);
                draw_moves(&m, points, stays, errs);
                for (int c = 0; c < CAPACITIES; c++)
                    for (int full_leaf = OCTREE_REFUSE; full_leaf <= OCTREE_GROW; full_leaf++)
                        assert_moved_alike(points, &m, capacities[c], (octree_full_leaf)full_leaf);
            }
}

/* The last move first. */
static void turn_round(moves *m)
{
    for (size_t i = 0, k = m->count - 1; i < k; i++, k--) {
        const octree_point from = m->points[i];
        double to[3];
        memcpy(to, m->to[i], sizeof to);
        m->points[i] = m->points[k];
        memcpy(m->to[i], m->to[k], sizeof to);
        m->points[k] = from;
        memcpy(m->to[k], to, sizeof to);
    }
}

/* Some go where others are already, who leave it at the same time: sooner or later, so that the leaf there is full or
 * has room. Or they are the first in their octant. */
static void moves_that_rebuild_meet_full_leaves_in_the_given_order(void **state)
{
    (void)state;
    static octree_point points[COUNT];
    static moves m;
    static const double places[2][3] = {{0.3, 0.3, 0.3}, {0.3, 0.3, 0.3 + 0x1p-22}};
    static const size_t one_in[] = {12, 60, 150, 250, 400, 900};
    for (int all = 0; all < 6 * 6 * CAPACITIES; all++) {
        const size_t here = one_in[all % 6], come = one_in[all / 6 % 6];
        const int c = all / 36;
        draw(points, OCTREE_SAMPLE_UNIFORM, here, COUNT + 1);
        draw_moves(&m, points, 7, false);
        for (size_t i = 1; i < m.count; i += come)
            memcpy(m.to[i], places[(i / come + all) % 2], sizeof m.to[i]);
        assert_moved_alike(points, &m, capacities[c], OCTREE_REFUSE);
        turn_round(&m);
        assert_moved_alike(points, &m, capacities[c], OCTREE_REFUSE);
        for (size_t i = 0; i < COUNT; i += here)
            points[i].position[0] = -0.3;
        assert_moved_alike(points, &m, capacities[c], OCTREE_REFUSE);
    }
}

/* One point in each of 8^3 cells. As many as the capacity move beside the first, into the cell that cannot be divided,
 * and then that one leaves it: too late for the last of them. */
static void each_point_counts_where_a_leaf_may_be_full(void **state)
{
    (void)state;
    static octree_point points[COUNT];
    static moves m;
    for (size_t capacity = 2; capacity <= 4; capacity++) {
        m.count = 0;
        for (size_t i = 0; i < COUNT; i++) {
            points[i] = (octree_point){.id = i, .position = {NAN, 0, 0}};
            for (int axis = 0; axis < 3 && i < 512; axis++)
                points[i].position[axis] = (double)(i >> 3 * axis & 7) / 4 - 0.875;
        }
        for (size_t i = 512; i-- > 0; m.count++) {
            m.points[m.count] = points[i];
            memcpy(m.to[m.count], points[i > 0 && i <= capacity ? 0 : i].position, sizeof m.to[0]);
            m.to[m.count][0] += i > 0 && i <= capacity ? (double)(i - 1) * 0x1p-22 : 0.01;
        }
        assert_moved_alike(points, &m, capacity, OCTREE_REFUSE);
    }
}

/* Ids far apart, and two points of one id of which one moves. */
static void ids_of_any_kind_move(void **state)
{
    (void)state;
    static octree_point points[COUNT];
    static moves m;
    draw(points, OCTREE_SAMPLE_UNIFORM, COUNT, COUNT + 1);
    for (size_t i = 0; i < COUNT; i++)
        points[i].id *= UINT64_C(0x9e3779b97f4a7c15);
    draw_moves(&m, points, 10, true);
    assert_moved_alike(points, &m, 8, OCTREE_GROW);
    points[0].id = UINT64_MAX; /* the window of ids reaches beyond 0 */
    for (size_t i = 1; i < COUNT; i++)
        points[i].id = i;
    draw_moves(&m, points, 10, true);
    assert_moved_alike(points, &m, 8, OCTREE_GROW);
    points[17].id = points[16].id; /* 17 stays */
    draw_moves(&m, points, 7, false);
    assert_moved_alike(points, &m, 8, OCTREE_GROW);
}

/* Where two tasks write what one of them reads, ThreadSanitizer says so in test_executor. */
static void filling_survives_the_failure_of_each_allocation(void **state)
{
    (void)state;
    static octree_point points[COUNT];
    static moves m;
    draw(points, OCTREE_SAMPLE_UNIFORM, 30, COUNT + 1);
    draw_moves(&m, points, 7, true);
    for (size_t n = 0, failed = 1; failed; n++) {
        counting_allocator counts = {0};
        octree *tree = make_counted_tree(&counts, cube(-1, 1), 8, 21, OCTREE_GROW);
        counting_allocator_fail_at(&counts, n);
        octree_status status = octree_insert_many(tree, points, COUNT, NULL, NULL);
        failed = status == OCTREE_NO_MEMORY;
        assert_int_equal(octree_count(tree), failed ? 0 : COUNT);
        counting_allocator_stop_failing(&counts);
        assert_int_equal(octree_insert_many(tree, points, COUNT, NULL, NULL), OCTREE_OK);
        const uint64_t digest = octree_digest(tree);
        counting_allocator_fail_at(&counts, n);
        status = octree_move_many(tree, m.points, (const double(*)[3])m.to, m.count, NULL, NULL);
        assert_true((status == OCTREE_NO_MEMORY) == (octree_digest(tree) == digest));
        failed |= status == OCTREE_NO_MEMORY;
        counting_allocator_stop_failing(&counts);
        assert_valid(tree);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
}

/* The most bytes while a tree is filled of points of which all but a few crowd in one corner. */
static size_t peak_of_corner(bool upper)
{
    static octree_point points[COUNT];
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 8, 21, OCTREE_GROW);
    uint64_t random = 6;
    for (size_t i = 0; i < COUNT; i++) {
        points[i].id = i;
        for (int axis = 0; axis < 3; axis++) {
            const double from_corner = octree_random_unit(&random) * (i % 50 ? 1.0 / 64 : 2);
            points[i].position[axis] = upper ? 1 - from_corner : from_corner - 1;
        }
    }
    assert_int_equal(octree_insert_many(tree, points, COUNT, NULL, NULL), OCTREE_OK);
    octree_destroy(tree);
    assert_all_returned(&counts);
    return counts.peak;
}

/* Whether a grid is worth it is asked of all of its cells. */
static void a_crowd_costs_the_same_in_either_corner(void **state)
{
    (void)state;
    assert_int_equal(peak_of_corner(false), peak_of_corner(true));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tree_filled_by_a_grid_equals_one_of_single_insertions),
        cmocka_unit_test(a_tree_rebuilt_by_moves_equals_one_of_single_moves),
        cmocka_unit_test(moves_that_rebuild_meet_full_leaves_in_the_given_order),
        cmocka_unit_test(each_point_counts_where_a_leaf_may_be_full),
        cmocka_unit_test(ids_of_any_kind_move),
        cmocka_unit_test(a_crowd_costs_the_same_in_either_corner),
        cmocka_unit_test(filling_survives_the_failure_of_each_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
