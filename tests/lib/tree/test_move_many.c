/* SPDX-License-Identifier: MIT */
/* test_move_many.c - batches of moves equal single moves: statuses, nodes and points. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "counting_allocator.h"

enum { MOST = 400 };

/* A batch, what became of it, and what it is drawn from. */
typedef struct moves {
    octree_point points[MOST];
    double to[MOST][3];
    octree_status statuses[MOST];
    size_t count;
} moves;

/* All points with all their bits, which the digest of a zero leaves out. */
static brute points_of(const octree *tree)
{
    brute all = {0};
    const octree_box world = octree_definition(tree).world;
    assert_int_equal(octree_range(tree, &world, brute_collect, &all), OCTREE_OK);
    if (all.count)
        qsort(all.points, all.count, sizeof *all.points, octree_compare_points);
    return all;
}

static void assert_trees_equal(const octree *a, const octree *b)
{
    assert_int_equal(octree_count(a), octree_count(b));
    assert_true(octree_digest(a) == octree_digest(b));
    assert_valid(a);
    brute p = points_of(a), q = points_of(b);
    assert_int_equal(p.count, q.count);
    if (p.count)
        assert_memory_equal(p.points, q.points, p.count * sizeof *p.points);
    brute_free(&p);
    brute_free(&q);
}

/* Move all at once in one tree and one after the other in its twin. Returns how many moved. */
static size_t move_both(octree *batched, octree *stepped, moves *m)
{
    /* No room to spare, so that a sanitizer sees who reads beyond it. */
    octree_point *points = malloc(m->count * sizeof *points + 1);
    double(*to)[3] = malloc(m->count * sizeof *to + 1);
    assert_true(points && to);
    memcpy(points, m->points, m->count * sizeof *points);
    memcpy(to, m->to, m->count * sizeof *to);
    const uint64_t version = octree_version(batched);
    size_t moved = SIZE_MAX, expected = 0;
    assert_int_equal(octree_move_many(batched, points, (const double(*)[3])to, m->count, m->statuses, &moved),
                     OCTREE_OK);
    for (size_t i = 0; i < m->count; i++) {
        const octree_status status = octree_move(stepped, points[i].position, points[i].id, to[i]);
        assert_int_equal(m->statuses[i], status);
        expected += status == OCTREE_OK;
    }
    free(points);
    free(to);
    assert_int_equal(moved, expected);
    assert_true((octree_version(batched) != version) == (expected > 0));
    assert_trees_equal(batched, stepped);
    return moved;
}

/* How a round draws its points. */
typedef struct play {
    uint64_t random;
    octree_box world;
    uint64_t steps, ids;
    octree *batched, *stepped;
} play;

static double coarse(play *p, int axis)
{
    const double min = p->world.min[axis], max = p->world.max[axis];
    const double strays[] = {NAN, INFINITY, next_down(min), next_up(max), -DBL_MAX};
    if (random_below(&p->random, 200) == 0)
        return strays[random_below(&p->random, sizeof strays / sizeof strays[0])];
    const double t = (double)random_below(&p->random, p->steps + 1) / (double)p->steps;
    double value = fmin(fmax(min * (1 - t) + max * t, min), max);
    if (random_below(&p->random, 6) == 0)
        value = random_below(&p->random, 2) ? fmin(next_up(value), max) : fmax(next_down(value), min);
    return value == 0 && random_below(&p->random, 2) ? -value : value;
}

static octree_point any_point(play *p)
{
    octree_point point = {.id = random_below(&p->random, p->ids)};
    for (int axis = 0; axis < 3; axis++)
        point.position[axis] = coarse(p, axis);
    return point;
}

/* From where a point is stored, mostly; to any place, or by a small step, or where another one comes from. Under
 * `apart` no id comes twice. */
static void draw_moves(play *p, moves *m, size_t most, bool apart)
{
    brute all = points_of(p->batched);
    m->count = 0;
    for (size_t i = random_below(&p->random, most + 1); i > 0; i--) {
        octree_point point = any_point(p), to = any_point(p);
        if (all.count && random_below(&p->random, 8))
            point = all.points[random_below(&p->random, all.count)];
        else if (m->count && random_below(&p->random, 2))
            memcpy(point.position, m->to[random_below(&p->random, m->count)], sizeof point.position);
        const size_t which = random_below(&p->random, 6);
        if (which == 0 && all.count)
            to = all.points[random_below(&p->random, all.count)];
        for (int axis = 0; which < 4 && which > 0 && axis < 3; axis++)
            to.position[axis] = which == 1 ? point.position[axis] : next_up(point.position[axis]);
        bool known = false;
        for (size_t j = 0; j < m->count; j++)
            known = known || m->points[j].id == point.id;
        if (apart && known)
            continue;
        m->points[m->count] = point;
        memcpy(m->to[m->count++], to.position, sizeof to.position);
    }
    brute_free(&all);
}

static void play_round(uint64_t seed, octree_box world, size_t capacity, size_t depth, octree_full_leaf full_leaf)
{
    static moves m;
    play p = {.random = seed, .world = world};
    p.steps = 1 + random_below(&p.random, 9);
    p.ids = random_below(&p.random, 2) ? 4 : 100000;
    p.batched = make_tree(world, capacity, depth, full_leaf);
    p.stepped = make_tree(world, capacity, depth, full_leaf);
    for (size_t i = random_below(&p.random, seed % 3 ? 120 : 800); i > 0; i--) { /* 12 moves are few among 800 points */
        const octree_point point = any_point(&p);
        assert_int_equal(octree_insert(p.batched, point.position, point.id),
                         octree_insert(p.stepped, point.position, point.id));
    }
    for (int i = 0; i < 6; i++) {
        draw_moves(&p, &m, i % 2 ? 12 : 150, random_below(&p.random, 2));
        move_both(p.batched, p.stepped, &m);
    }
    octree_destroy(p.batched);
    octree_destroy(p.stepped);
}

static void batched_moves_equal_single_moves(void **state)
{
    (void)state;
    static const size_t capacities[] = {1, 2, 3, 5, 8, 64}, depths[] = {0, 1, 2, 4, 21};
    for (size_t c = 0; c < sizeof capacities / sizeof capacities[0]; c++)
        for (size_t d = 0; d < sizeof depths / sizeof depths[0]; d++)
            for (uint64_t seed = 0; seed < 10; seed++) {
                play_round(seed * 100 + c * 10 + d, cube(-4, 4), capacities[c], depths[d], OCTREE_REFUSE);
                play_round(seed * 100 + c * 10 + d, cube(-4, 4), capacities[c], depths[d], OCTREE_GROW);
            }
}

static void batched_moves_equal_single_moves_in_extreme_worlds(void **state)
{
    (void)state;
    static const octree_box worlds[] = {
        {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}},
        {{1e15, 0, 0}, {1e15 + 1, 1000, 1000}}, /* x is exhausted after three levels */
        {{0, 0, 0}, {5e-324, 5e-324, 5e-324}},  /* no plane inside */
        {{-5e-324, 0, -1}, {5e-324, 5e-324, 1}},
    };
    for (size_t w = 0; w < sizeof worlds / sizeof worlds[0]; w++)
        for (uint64_t seed = 0; seed < 12; seed++) {
            play_round(seed, worlds[w], 1 + seed % 5, seed % 3 ? 21 : 3, OCTREE_REFUSE);
            play_round(seed, worlds[w], 1 + seed % 5, seed % 3 ? 21 : 3, OCTREE_GROW);
        }
}

static void drift(uint64_t *random, const octree_point *from, double step, double to[3])
{
    for (int axis = 0; axis < 3; axis++)
        to[axis] = fmin(fmax(from->position[axis] + random_between(random, -step, step), -1), 1);
}

/* Thousands of points through leaves of all sizes, hashed ones too; any share of them, by small steps and by large. */
static void every_share_moves_the_same(void **state)
{
    (void)state;
    enum { COUNT = 3000 };
    static octree_point points[COUNT], batch[COUNT];
    static double to[COUNT][3];
    static octree_status statuses[COUNT];
    static const size_t capacities[] = {1, 16, 64, 100, SIZE_MAX}, shares[] = {1, 10, 50, 100};
    uint64_t random = 3;
    for (size_t c = 0; c < sizeof capacities / sizeof capacities[0]; c++)
        for (size_t s = 0; s < 8; s++) {
            const octree_full_leaf full_leaf = (c + s) % 2 ? OCTREE_GROW : OCTREE_REFUSE;
            octree *batched = make_tree(cube(-1, 1), capacities[c], 21, full_leaf);
            octree *stepped = make_tree(cube(-1, 1), capacities[c], 21, full_leaf);
            for (size_t i = 0; i < COUNT; i++) {
                points[i].id = i;
                drift(&random, &(octree_point){.id = 0}, i % 3 ? 1 : 0.01, points[i].position);
                octree_insert(batched, points[i].position, points[i].id);
                octree_insert(stepped, points[i].position, points[i].id);
            }
            for (int tick = 0; tick < 3; tick++) {
                size_t count = 0;
                for (size_t i = 0; i < COUNT; i++) {
                    if (random_below(&random, 100) >= shares[s / 2])
                        continue;
                    drift(&random, &points[i], s % 2 ? 1.5 : 0.02, to[count]);
                    batch[count++] = points[i];
                }
                assert_int_equal(octree_move_many(batched, batch, (const double(*)[3])to, count, statuses, NULL),
                                 OCTREE_OK);
                for (size_t i = 0; i < count; i++) {
                    assert_int_equal(octree_move(stepped, batch[i].position, batch[i].id, to[i]), statuses[i]);
                    if (statuses[i] == OCTREE_OK)
                        memcpy(points[batch[i].id].position, to[i], sizeof to[i]);
                }
                assert_trees_equal(batched, stepped);
            }
            octree_destroy(batched);
            octree_destroy(stepped);
        }
}

/* Few neighbours move through one another's leaves, which fill, split and merge. Each id is stored twice, and some
 * points move to where the other point of their id was. */
static void few_moves_of_neighbours_equal_single_moves(void **state)
{
    (void)state;
    enum { IDS = 500, FEW = 30 };
    static moves m;
    static double at[2][IDS][3];
    static octree_neighbor near[FEW];
    for (uint64_t seed = 0; seed < 200; seed++) {
        uint64_t random = seed;
        const octree_full_leaf full_leaf = seed % 2 ? OCTREE_GROW : OCTREE_REFUSE;
        octree *batched = make_tree(cube(-1, 1), 2 + seed % 12, seed % 3 ? 3 : 21, full_leaf);
        octree *stepped = make_tree(cube(-1, 1), 2 + seed % 12, seed % 3 ? 3 : 21, full_leaf);
        for (uint64_t i = 0; i < (uint64_t)2 * IDS; i++) {
            double *position = at[i % 2][i / 2];
            drift(&random, &(octree_point){.id = 0}, 1, position);
            assert_int_equal(octree_insert(batched, position, i / 2), octree_insert(stepped, position, i / 2));
        }
        for (int tick = 0; tick < 8; tick++) {
            drift(&random, &(octree_point){.id = 0}, 1, m.to[0]);
            assert_int_equal(octree_nearest_k(batched, m.to[0], FEW, NULL, near, &m.count), OCTREE_OK);
            for (size_t i = 0; i < m.count; i++) {
                m.points[i] = near[i].point;
                drift(&random, &m.points[i], 0.3, m.to[i]);
                if (random_below(&random, 40) == 0)
                    memcpy(m.to[i], at[random_below(&random, 2)][m.points[i].id], sizeof m.to[i]);
            }
            move_both(batched, stepped, &m);
        }
        octree_destroy(batched);
        octree_destroy(stepped);
    }
}

/* Ids that are dense or far apart, in any order; every seventh is stored at a second place, which stays or where its
 * other point goes; every ninth is not stored where it is said to be. */
/* Leaves of 64 points become hashed leaves when points arrive, and other points leave them. The last move goes to a
 * stored pair in another leaf, so the batch reverts all moves and makes them in order. */
static void reverted_moves_leave_hashed_leaves_whole(void **state)
{
    (void)state;
    enum { FEW = 30, LEAVES = 8, FULL = 64 };
    static moves m;
    static octree_point points[LEAVES * FULL + 2];
    for (uint64_t seed = 0; seed < 40; seed++) {
        uint64_t random = seed;
        octree *batched = make_tree(cube(-1, 1), 128, 3, OCTREE_GROW);
        octree *stepped = make_tree(cube(-1, 1), 128, 3, OCTREE_GROW);
        const size_t count = sizeof points / sizeof *points;
        for (size_t i = 0; i < count; i++) {
            points[i].id = i < count - 1 ? i : 0; /* the last point has the id of the first */
            for (unsigned axis = 0; axis < 3; axis++)
                points[i].position[axis] =
                    (i % LEAVES >> axis & 1 ? 1 : -1) * (0.1 + 0.8 * random_between(&random, 0, 1));
            assert_int_equal(octree_insert(batched, points[i].position, points[i].id), OCTREE_OK);
            assert_int_equal(octree_insert(stepped, points[i].position, points[i].id), OCTREE_OK);
        }
        m.count = FEW;
        for (size_t i = 0; i < FEW; i++) {
            m.points[i] = points[i * 17 % count];
            drift(&random, &m.points[i], 1, m.to[i]);
        }
        m.points[FEW - 1] = points[0];
        m.points[0] = points[17 * FEW % count];
        memcpy(m.to[FEW - 1], points[count - 1].position, sizeof m.to[0]);
        move_both(batched, stepped, &m);
        brute all = points_of(batched);
        for (size_t i = 0; i < all.count; i++)
            assert_true(octree_contains(batched, all.points[i].position, all.points[i].id));
        brute_free(&all);
        octree_destroy(batched);
        octree_destroy(stepped);
    }
}

static void many_moves_find_their_own_among_points_of_one_id(void **state)
{
    (void)state;
    enum { COUNT = 2000 };
    static const uint64_t factors[] = {1, 50, 0x9e3779b97f4a7c15u, UINT64_C(1) << 40};
    static octree_point batch[COUNT];
    static double to[COUNT][3];
    static octree_status statuses[COUNT];
    uint64_t random = 12;
    for (size_t f = 0; f < 8; f++) {
        octree *batched = make_tree(cube(-1, 1), 1 + 7 * f, 21, f % 2 ? OCTREE_GROW : OCTREE_REFUSE);
        octree *stepped = make_tree(cube(-1, 1), 1 + 7 * f, 21, f % 2 ? OCTREE_GROW : OCTREE_REFUSE);
        for (size_t i = 0; i < COUNT; i++) {
            const size_t at = random_below(&random, i + 1);
            octree_point made = {.id = i * factors[f / 2]}, *point = &batch[at];
            double other[3];
            drift(&random, &made, 1, made.position);
            drift(&random, &made, 0.1, other);
            for (octree *tree = batched; tree; tree = tree == batched ? stepped : NULL) {
                octree_insert(tree, made.position, made.id);
                if (i % 7 == 0 && f < 6)
                    octree_insert(tree, other, made.id);
            }
            memcpy(to[i], to[at], sizeof to[i]);
            batch[i] = *point;
            *point = made;
            drift(&random, &made, 0.1, to[at]);
            if (i % 14 == 0 && f % 2 == 0 && f < 6)
                memcpy(to[at], other, sizeof other);
            if (i % 9 == 0)
                point->position[1] = -point->position[1];
        }
        size_t of[OCTREE_STATUS_COUNT] = {0};
        assert_int_equal(octree_move_many(batched, batch, (const double(*)[3])to, COUNT, statuses, NULL), OCTREE_OK);
        for (size_t i = 0; i < COUNT; i++, of[statuses[i - 1]]++)
            assert_int_equal(octree_move(stepped, batch[i].position, batch[i].id, to[i]), statuses[i]);
        assert_trees_equal(batched, stepped);
        assert_true(of[OCTREE_OK] > COUNT / 2 && of[OCTREE_NOT_FOUND] > COUNT / 20);
        assert_true((of[OCTREE_DUPLICATE] > 0) == (f % 2 == 0 && f < 6));
        octree_destroy(batched);
        octree_destroy(stepped);
    }
}

static void batched_moves_meet_full_leaves_in_the_given_order(void **state)
{
    (void)state;
    /* One leaf of two: what comes first takes the place that was left before it, and not the one that is left after. */
    static const octree_point points[] = {
        {{-0.5, -0.5, -0.5}, 1}, {{0.1, 0.1, 0.1}, 2}, {{-0.4, -0.5, -0.5}, 3}, {{-0.5, 0.5, -0.5}, 4}};
    static const double to[][3] = {{0.5, 0.5, 0.5}, {0.5, -0.5, 0.5}, {0.6, 0.5, 0.5}, {0.7, 0.5, 0.5}};
    static const octree_status expected[] = {OCTREE_FULL, OCTREE_OK, OCTREE_OK, OCTREE_FULL};
    octree *tree = make_tree(cube(-1, 1), 2, 1, OCTREE_REFUSE);
    for (int i = 0; i < 4; i++)
        assert_int_equal(octree_insert(tree, points[i].position, points[i].id), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){0.9, 0.9, 0.9}, 5), OCTREE_OK);
    octree_status statuses[4];
    size_t moved = 0;
    assert_int_equal(octree_move_many(tree, points, to, 4, statuses, &moved), OCTREE_OK);
    for (int i = 0; i < 4; i++)
        assert_int_equal(statuses[i], expected[i]);
    assert_int_equal(moved, 2);
    assert_valid(tree);
    octree_destroy(tree);
}

/* The first arrives where two are, one of which then moves on within the leaf: with whatever allocation fails. */
static void a_leaf_is_full_of_what_moves_within_it_later(void **state)
{
    (void)state;
    static const octree_point points[] = {
        {{-0.6, -0.6, -0.6}, 1}, {{0.6, 0.6, 0.6}, 2}, {{0.7, 0.7, 0.7}, 3}, {{-0.4, -0.4, -0.4}, 4}};
    static const double to[][3] = {{0.8, 0.8, 0.8}, {0.2, 0.2, 0.2}};
    octree_status done = OCTREE_NO_MEMORY;
    for (size_t n = 0; done != OCTREE_OK; n++) {
        counting_allocator counts = {0};
        octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 2, OCTREE_REFUSE);
        assert_int_equal(octree_insert_many(tree, points, 4, NULL, NULL), OCTREE_OK);
        octree_status statuses[2] = {OCTREE_OK, OCTREE_OK};
        counting_allocator_fail_at(&counts, n);
        done = octree_move_many(tree, points, to, 2, statuses, NULL);
        assert_true(done == OCTREE_NO_MEMORY || (statuses[0] == OCTREE_FULL && statuses[1] == OCTREE_OK));
        assert_valid(tree);
        octree_destroy(tree);
    }
}

static void a_pair_moves_on_within_one_batch(void **state)
{
    (void)state;
    static const octree_point points[] = {{{-0.5, 0, 0}, 1}, {{0.5, 0, 0}, 1}, {{0.5, 0, 0}, 1}};
    static const double to[][3] = {{0.5, 0, 0}, {0.5, 0.5, 0}, {0, 0, 0}};
    static const octree_status expected[] = {OCTREE_OK, OCTREE_OK, OCTREE_NOT_FOUND};
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    assert_int_equal(octree_insert(tree, points[0].position, 1), OCTREE_OK);
    octree_status statuses[3];
    assert_int_equal(octree_move_many(tree, points, to, 3, statuses, NULL), OCTREE_OK);
    for (int i = 0; i < 3; i++)
        assert_int_equal(statuses[i], expected[i]);
    assert_true(octree_contains(tree, to[1], 1));
    assert_int_equal(octree_count(tree), 1);
    octree_destroy(tree);
}

static void null_and_oversized_arrays_are_refused(void **state)
{
    (void)state;
    static const octree_point point = {{0, 0, 0}, 1};
    static const double to[1][3] = {{1, 1, 1}};
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    insert_all(tree, (const double[][3]){{0, 0, 0}}, 1);
    const uint64_t version = octree_version(tree);
    size_t moved = SIZE_MAX;
    assert_int_equal(octree_move_many(NULL, &point, to, 1, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_move_many(tree, NULL, to, 1, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_move_many(tree, &point, NULL, 1, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_move_many(tree, &point, to, SIZE_MAX, NULL, NULL), OCTREE_TOO_MANY);
    assert_int_equal(octree_move_many(tree, &point, to, UINT32_MAX, NULL, NULL), OCTREE_TOO_MANY);
    assert_int_equal(octree_move_many(tree, NULL, NULL, 0, NULL, &moved), OCTREE_OK);
    assert_int_equal(moved, 0);
    assert_true(octree_version(tree) == version);
    assert_int_equal(octree_move_many(tree, &point, to, 1, NULL, NULL), OCTREE_OK);
    assert_true(octree_contains(tree, to[0], 1));
    octree_destroy(tree);
}

/* Let the n-th allocation of a batch fail. Returns whether there was one. One that only looks whether moves depend on
 * each other is not needed. */
static bool fails_without_a_trace(size_t n, octree_full_leaf full_leaf, size_t capacity, uint64_t ids, double step,
                                  size_t count)
{
    static moves m;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), capacity, 6, full_leaf);
    uint64_t random = 9;
    for (m.count = 0; m.count < MOST; m.count++) {
        octree_point *point = &m.points[m.count];
        point->id = m.count % ids;
        drift(&random, &(octree_point){.id = 0}, 1, point->position);
        octree_insert(tree, point->position, point->id);
        drift(&random, point, step, m.to[m.count]);
    }
    brute before = points_of(tree);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    counting_allocator_fail_at(&counts, n);
    const octree_status status = octree_move_many(tree, m.points, (const double(*)[3])m.to, count, NULL, NULL);
    const bool failed = counts.calls > counts.fail_from;
    counting_allocator_stop_failing(&counts);
    assert_true(status == OCTREE_OK || (failed && status == OCTREE_NO_MEMORY));
    assert_valid(tree);
    if (status == OCTREE_OK) {
        octree *stepped = make_tree(cube(-1, 1), capacity, 6, full_leaf);
        for (size_t i = 0; i < MOST; i++)
            octree_insert(stepped, m.points[i].position, m.points[i].id);
        for (size_t i = 0; i < count; i++)
            octree_move(stepped, m.points[i].position, m.points[i].id, m.to[i]);
        assert_trees_equal(tree, stepped);
        octree_destroy(stepped);
    } else {
        brute after = points_of(tree);
        assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
        assert_int_equal(after.count, before.count);
        assert_memory_equal(after.points, before.points, before.count * sizeof *before.points);
        brute_free(&after);
    }
    brute_free(&before);
    octree_destroy(tree);
    assert_all_returned(&counts);
    return failed;
}

static void moves_of_absent_points_change_nothing(void **state)
{
    (void)state;
    enum { STORED = 200 };
    octree_point points[STORED];
    double to[STORED][3];
    octree *tree = make_tree(cube(-1, 1), 2, 21, OCTREE_GROW);
    for (uint64_t i = 0; i < STORED; i++) {
        points[i] = (octree_point){{(double)i / STORED, 0, 0}, i};
        memset(to[i], 0, sizeof to[i]);
    }
    assert_int_equal(octree_insert_many(tree, points, STORED, NULL, NULL), OCTREE_OK);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    for (size_t count = 10; count <= STORED; count += STORED - 10) { /* a few, and so many that it may be built anew */
        octree_status statuses[STORED];
        size_t moved = 77;
        for (size_t i = 0; i < STORED; i++)
            points[i].id = STORED + i;
        assert_int_equal(octree_move_many(tree, points, (const double(*)[3])to, count, statuses, &moved), OCTREE_OK);
        assert_int_equal(moved, 0);
        for (size_t i = 0; i < count; i++)
            assert_int_equal(statuses[i], OCTREE_NOT_FOUND);
        assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
    }
    octree_destroy(tree);
}

static void moves_survive_the_failure_of_each_allocation(void **state)
{
    (void)state;
    size_t reverted = 0; /* calls of few moves that failed */
    for (int grow = 0; grow < 2; grow++)
        for (int ids = 0; ids < 2; ids++)
            for (int far = 0; far < 2; far++)
                for (size_t capacity = 2; capacity <= 128; capacity *= 4) {
                    const octree_full_leaf full_leaf = grow ? OCTREE_GROW : OCTREE_REFUSE;
                    size_t n = 0;
                    while (fails_without_a_trace(n, full_leaf, capacity, ids ? 50 : MOST, far ? 1 : 0.1, MOST))
                        n++;
                    assert_true(n > 2);
                    for (size_t count = 7; count < MOST / 4; count += 7) {
                        n = 0;
                        while (fails_without_a_trace(n, full_leaf, capacity, ids ? 50 : MOST, far ? 1 : 0.1, count))
                            n++;
                        reverted += n;
                    }
                }
    assert_true(reverted > 100);
}

enum { WALKERS = 600, FILLERS = 3000, STEPPING = 20 };

/* Points that move to and fro, and points that fill the free memory of a tree. */
typedef struct walk {
    octree *tree;
    counting_allocator counts;
    uint64_t random;
    octree_point points[WALKERS], fillers[FILLERS];
    size_t failures;
} walk;

static void begin_walk(walk *w, size_t capacity)
{
    *w = (walk){.random = 4};
    w->tree = make_counted_tree(&w->counts, cube(-1, 1), capacity, 6, OCTREE_GROW);
    for (size_t i = 0; i < FILLERS; i++) {
        w->fillers[i].id = WALKERS + i;
        drift(&w->random, &(octree_point){.id = 0}, 1, w->fillers[i].position);
    }
    for (size_t i = 0; i < WALKERS; i++) {
        w->points[i].id = i;
        drift(&w->random, &(octree_point){.id = 0}, 1, w->points[i].position);
        assert_int_equal(octree_insert(w->tree, w->points[i].position, i), OCTREE_OK);
    }
}

/* Move some points. They stay where they are if memory runs out. */
static void step_walk(walk *w, size_t tick)
{
    octree_point batch[STEPPING];
    double to[STEPPING][3];
    for (size_t i = 0; i < STEPPING; i++) {
        batch[i] = w->points[(tick * 7 + i * 29) % WALKERS];
        drift(&w->random, &(octree_point){.id = 0}, tick / 50 % 2 ? 0.1 : 1, to[i]);
    }
    const uint64_t digest = octree_digest(w->tree);
    const octree_status status = octree_move_many(w->tree, batch, (const double(*)[3])to, STEPPING, NULL, NULL);
    if (status == OCTREE_OK) {
        for (size_t i = 0; i < STEPPING; i++)
            memcpy(w->points[batch[i].id].position, to[i], sizeof to[i]);
        return;
    }
    assert_int_equal(status, OCTREE_NO_MEMORY);
    assert_true(octree_digest(w->tree) == digest);
    w->failures++;
}

/* A step while no memory is to be had: points have filled the free memory of the tree before. */
static void step_walk_without_memory(walk *w, size_t tick)
{
    size_t filled = 0;
    counting_allocator_fail_at(&w->counts, 0);
    w->counts.fail_until = SIZE_MAX;
    while (filled < FILLERS && octree_insert(w->tree, w->fillers[filled].position, WALKERS + filled) == OCTREE_OK)
        filled++;
    step_walk(w, tick);
    counting_allocator_stop_failing(&w->counts);
    while (filled-- > 0)
        assert_int_equal(octree_remove(w->tree, w->fillers[filled].position, WALKERS + filled), OCTREE_OK);
}

/* Few points move for a long time between leaves of all sizes, and every second call finds no memory. */
static void few_moves_and_reverted_moves_do_not_leak(void **state)
{
    (void)state;
    static walk w;
    static const size_t capacities[] = {2, 8, 64, 200};
    for (size_t c = 0; c < sizeof capacities / sizeof capacities[0]; c++) {
        begin_walk(&w, capacities[c]);
        size_t limit = 0;
        for (size_t tick = 0; tick < 1200; tick++) {
            if (tick % 2)
                step_walk_without_memory(&w, tick);
            else
                step_walk(&w, tick);
            if (tick == 200)
                limit = w.counts.bytes * 3 / 2;
            assert_true(limit == 0 || w.counts.bytes <= limit);
        }
        assert_int_equal(octree_count(w.tree), WALKERS);
        assert_valid(w.tree);
        assert_true(w.failures > 50);
        octree_destroy(w.tree);
        assert_all_returned(&w.counts);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(batched_moves_equal_single_moves),
        cmocka_unit_test(batched_moves_equal_single_moves_in_extreme_worlds),
        cmocka_unit_test(every_share_moves_the_same),
        cmocka_unit_test(few_moves_of_neighbours_equal_single_moves),
        cmocka_unit_test(reverted_moves_leave_hashed_leaves_whole),
        cmocka_unit_test(many_moves_find_their_own_among_points_of_one_id),
        cmocka_unit_test(batched_moves_meet_full_leaves_in_the_given_order),
        cmocka_unit_test(a_leaf_is_full_of_what_moves_within_it_later),
        cmocka_unit_test(a_pair_moves_on_within_one_batch),
        cmocka_unit_test(null_and_oversized_arrays_are_refused),
        cmocka_unit_test(moves_of_absent_points_change_nothing),
        cmocka_unit_test(moves_survive_the_failure_of_each_allocation),
        cmocka_unit_test(few_moves_and_reverted_moves_do_not_leak),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
