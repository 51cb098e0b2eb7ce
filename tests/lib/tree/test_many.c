/* SPDX-License-Identifier: MIT */
/* test_many.c - batches of insertions and removals equal single changes: statuses and nodes. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "brute.h"

typedef octree_status (*change_one)(octree *tree, const double position[3], uint64_t id);
typedef octree_status (*change_many)(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                     size_t *done);

typedef struct change {
    change_many many;
    change_one one;
} change;

static const change insertion = {octree_insert_many, octree_insert};
static const change removal = {octree_remove_many, octree_remove};

/* Trees of one definition: one is changed by batches, the other point by point. */
typedef struct twins {
    octree *batched, *stepped;
} twins;

static twins make_twins(octree_box world, size_t capacity, size_t depth, octree_full_leaf full_leaf)
{
    return (twins){make_tree(world, capacity, depth, full_leaf), make_tree(world, capacity, depth, full_leaf)};
}

static void destroy_twins(twins t)
{
    octree_destroy(t.batched);
    octree_destroy(t.stepped);
}

static void assert_twins_equal(twins t)
{
    assert_int_equal(octree_count(t.batched), octree_count(t.stepped));
    assert_true(octree_digest(t.batched) == octree_digest(t.stepped));
    assert_valid(t.batched);
}

/* Change both; the test fails when a status, the number done or what becomes of the trees differs. The arrays have no
 * room to spare, so that a sanitizer sees who reads or writes beyond them. Returns the number done. */
static size_t change_both(twins t, const change *c, const octree_point *points, size_t count)
{
    octree_point *batch = malloc(count * sizeof *batch + 1);
    octree_status *statuses = malloc(count * sizeof *statuses + 1);
    assert_true(batch != NULL && statuses != NULL);
    for (size_t i = 0; i < count; i++) {
        batch[i] = points[i];
        statuses[i] = OCTREE_STATUS_COUNT;
    }
    const uint64_t version = octree_version(t.batched);
    size_t done = SIZE_MAX, expected = 0;
    assert_int_equal(c->many(t.batched, batch, count, statuses, &done), OCTREE_OK);
    for (size_t i = 0; i < count; i++) {
        const octree_status status = c->one(t.stepped, points[i].position, points[i].id);
        assert_int_equal(statuses[i], status);
        expected += status == OCTREE_OK;
    }
    assert_int_equal(done, expected);
    assert_true((octree_version(t.batched) != version) == (expected > 0));
    assert_twins_equal(t);
    free(statuses);
    free(batch);
    return done;
}

/* A coordinate that others are likely to share: on a grid of `steps`, at times an ulp beside it, seldom outside. */
static double coarse(uint64_t *random, double min, double max, uint64_t steps)
{
    const double strays[] = {NAN, INFINITY, -INFINITY, next_down(min), next_up(max), -DBL_MAX, DBL_MAX};
    if (random_below(random, 60) == 0)
        return strays[random_below(random, sizeof strays / sizeof strays[0])];
    const double t = (double)random_below(random, steps + 1) / (double)steps;
    double value = fmin(fmax(min * (1 - t) + max * t, min), max);
    if (random_below(random, 6) == 0)
        value = random_below(random, 2) ? fmin(next_up(value), max) : fmax(next_down(value), min);
    return value == 0 && random_below(random, 2) ? -value : value;
}

enum { most = 48, history = 512 };

/* What one random round plays with. */
typedef struct play {
    uint64_t random;
    octree_box world;
    uint64_t steps;
    twins trees;
    octree_point seen[history]; /* a ring of the latest points */
    size_t seen_count;
} play;

/* A point, new or seen before in this round: so pairs repeat within a batch and meet those that are stored. */
static octree_point pick(play *p)
{
    const size_t seen = p->seen_count < history ? p->seen_count : history;
    if (seen > 0 && random_below(&p->random, 3) == 0)
        return p->seen[random_below(&p->random, seen)];
    octree_point point = {.id = random_below(&p->random, 4)};
    for (int axis = 0; axis < 3; axis++)
        point.position[axis] = coarse(&p->random, p->world.min[axis], p->world.max[axis], p->steps);
    p->seen[p->seen_count++ % history] = point;
    return point;
}

static void play_batch(play *p, const change *c)
{
    octree_point points[most];
    const size_t count = random_below(&p->random, most + 1);
    for (size_t i = 0; i < count; i++)
        points[i] = pick(p);
    change_both(p->trees, c, points, count);
}

static void play_singles(play *p)
{
    octree *a = p->trees.batched, *b = p->trees.stepped;
    for (int i = 0; i < 8; i++) {
        const octree_point point = pick(p), to = pick(p);
        assert_int_equal(octree_move(a, point.position, point.id, to.position),
                         octree_move(b, point.position, point.id, to.position));
        assert_int_equal(octree_insert(a, to.position, to.id), octree_insert(b, to.position, to.id));
        assert_int_equal(octree_remove(a, point.position, point.id), octree_remove(b, point.position, point.id));
    }
    assert_twins_equal(p->trees);
}

static void play_round(uint64_t seed, octree_box world, size_t capacity, size_t depth, octree_full_leaf full_leaf)
{
    play p = {.random = seed, .world = world, .trees = make_twins(world, capacity, depth, full_leaf)};
    p.steps = 1 + random_below(&p.random, 6);
    for (int i = 0; i < 8; i++) {
        play_batch(&p, random_below(&p.random, 5) < 3 ? &insertion : &removal);
        if (random_below(&p.random, 4) == 0)
            play_singles(&p);
    }
    destroy_twins(p.trees);
}

static void batches_equal_single_changes(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 8; seed++)
        for (size_t capacity = 1; capacity <= 8; capacity++)
            for (size_t depth = 0; depth <= 8; depth++) {
                play_round(seed * 1000 + capacity * 10 + depth, cube(-4, 4), capacity, depth, OCTREE_REFUSE);
                play_round(seed * 1000 + capacity * 10 + depth, cube(-4, 4), capacity, depth, OCTREE_GROW);
            }
}

static const octree_box extreme_worlds[] = {
    {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}},
    {{1e15, 0, 0}, {1e15 + 1, 1000, 1000}}, /* x is exhausted after three levels */
    {{1e15, 1e15, 1e15}, {1e15 + 1, 1e15 + 1, 1e15 + 1}},
    {{5e-324, 5e-324, 5e-324}, {1e-310, 1e-310, 1e-310}},
    {{0, 0, 0}, {5e-324, 5e-324, 5e-324}}, /* no plane inside */
    {{-5e-324, 0, -1}, {5e-324, 5e-324, 1}},
    {{-1e200, -1e-200, 1}, {1e200, 1e-200, 1 + DBL_EPSILON}},
};

static void batches_equal_single_changes_in_extreme_worlds(void **state)
{
    (void)state;
    static const size_t depths[] = {0, 1, 3, 8, 21};
    for (size_t w = 0; w < sizeof extreme_worlds / sizeof extreme_worlds[0]; w++)
        for (size_t d = 0; d < sizeof depths / sizeof depths[0]; d++)
            for (uint64_t seed = 0; seed < 6; seed++) {
                const uint64_t id = (w * 10 + d) * 100 + seed;
                play_round(id, extreme_worlds[w], 1 + seed % 8, depths[d], OCTREE_REFUSE);
                play_round(id, extreme_worlds[w], 1 + seed % 8, depths[d], OCTREE_GROW);
            }
}

static void large_batches_equal_single_changes(void **state)
{
    (void)state;
    /* Leaves beyond 64 points, and thousands of points on a few places. */
    static const size_t capacities[] = {1, 2, 16, 63, 64, 65, 200, SIZE_MAX};
    static octree_point points[6000];
    for (size_t c = 0; c < sizeof capacities / sizeof capacities[0]; c++)
        for (int grow = 0; grow < 2; grow++) {
            const twins t = make_twins(cube(-1, 1), capacities[c], 21, grow ? OCTREE_GROW : OCTREE_REFUSE);
            uint64_t random = c;
            for (size_t i = 0; i < 6000; i++) {
                points[i].id = random_below(&random, 400);
                for (int axis = 0; axis < 3; axis++)
                    points[i].position[axis] = i % 3 ? 0.25 * (double)(i % 5) : random_between(&random, -1, next_up(1));
            }
            change_both(t, &insertion, points, 1500);
            change_both(t, &insertion, points + 1000, 4000);
            change_both(t, &removal, points + 500, 2500);
            change_both(t, &insertion, points, 6000);
            change_both(t, &removal, points, 6000);
            assert_int_equal(octree_count(t.batched), 0);
            assert_int_equal(node_count(t.batched), 1);
            destroy_twins(t);
        }
}

static void small_batches_equal_single_changes(void **state)
{
    (void)state;
    static const size_t capacities[] = {1, 2, 8, 64, 200};
    static octree_point points[2000];
    for (size_t c = 0; c < 10; c++) {
        const twins t = make_twins(cube(-1, 1), capacities[c / 2], c % 3 ? 21 : 3, c % 2 ? OCTREE_GROW : OCTREE_REFUSE);
        uint64_t random = c;
        for (size_t i = 0; i < 2000; i++) {
            points[i].id = random_below(&random, 3);
            for (int axis = 0; axis < 3; axis++)
                points[i].position[axis] = coarse(&random, -1, 1, i % 3 ? 12 : 2);
        }
        change_both(t, &insertion, points, 1000);
        for (size_t at = 0, size; at < 1900; at += size) {
            size = 1 + random_below(&random, 20);
            change_both(t, &insertion, points + at, size);
            if (random_below(&random, 4) == 0)
                change_both(t, &removal, points + at / 2, size);
        }
        destroy_twins(t);
    }
}

static void a_full_leaf_takes_the_first_in_input_order(void **state)
{
    (void)state;
    static const octree_point points[] = {
        {{0.9, 0.9, 0.9}, 7}, {{0.1, 0.1, 0.1}, 6}, {{0.9, 0.9, 0.9}, 7}, {{0.2, 0.1, 0.1}, 5},
        {{0.9, 0.9, 0.9}, 1}, {{0.2, 0.1, 0.1}, 5}, {{-0.5, 0, 0}, 4},    {{0.1, 0.1, 0.1}, 6},
    };
    static const octree_status expected[] = {OCTREE_OK,   OCTREE_OK,   OCTREE_DUPLICATE, OCTREE_FULL,
                                             OCTREE_FULL, OCTREE_FULL, OCTREE_OK,        OCTREE_DUPLICATE};
    octree *tree = make_tree(cube(-1, 1), 2, 1, OCTREE_REFUSE);
    octree_status statuses[8];
    size_t inserted = 0;
    assert_int_equal(octree_insert_many(tree, points, 8, statuses, &inserted), OCTREE_OK);
    assert_int_equal(inserted, 3);
    for (int i = 0; i < 8; i++)
        assert_int_equal(statuses[i], expected[i]);
    assert_true(octree_contains(tree, points[0].position, 7) && octree_contains(tree, points[1].position, 6));
    octree_destroy(tree);
}

static void what_is_stored_stays_when_a_batch_meets_a_full_leaf(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 2, 1, OCTREE_REFUSE);
    insert_all(tree, (const double[][3]){{0.9, 0.9, 0.9}}, 1);
    const octree_point points[] = {{{0.5, 0.5, 0.5}, 9}, {{0.1, 0.1, 0.1}, 8}, {{0.9, 0.9, 0.9}, 1}};
    octree_status statuses[3];
    assert_int_equal(octree_insert_many(tree, points, 3, statuses, NULL), OCTREE_OK);
    assert_int_equal(statuses[0], OCTREE_OK);
    assert_int_equal(statuses[1], OCTREE_FULL);
    assert_int_equal(statuses[2], OCTREE_DUPLICATE);
    assert_true(octree_contains(tree, points[2].position, 1) && octree_contains(tree, points[0].position, 9));
    octree_destroy(tree);
}

static void zeros_of_both_signs_are_one_position_and_the_first_bits_are_kept(void **state)
{
    (void)state;
    for (int negative = 0; negative < 2; negative++) {
        const double first = negative ? -0.0 : 0.0;
        const octree_point points[] = {{{first, first, first}, 1}, {{-first, -first, -first}, 1}};
        octree *tree = make_tree(cube(-1, 1), 4, 21, OCTREE_REFUSE);
        octree_status statuses[2];
        assert_int_equal(octree_insert_many(tree, points, 2, statuses, NULL), OCTREE_OK);
        assert_int_equal(statuses[1], OCTREE_DUPLICATE);
        octree_node root;
        assert_int_equal(octree_node_at(tree, OCTREE_ROOT, &root), OCTREE_OK);
        for (int axis = 0; axis < 3; axis++)
            assert_true((signbit(root.points[0].position[axis]) != 0) == negative);
        assert_int_equal(octree_remove_many(tree, points + 1, 1, statuses, NULL), OCTREE_OK);
        assert_int_equal(statuses[0], OCTREE_OK);
        octree_destroy(tree);
    }
}

static void a_batch_that_does_nothing_leaves_the_version(void **state)
{
    (void)state;
    static const octree_point refused[] = {{{NAN, 0, 0}, 1}, {{0, 0, INFINITY}, 1}, {{0, 2, 0}, 1}, {{1, 1, 1}, 1},
                                           {{1, 1, 1}, 2},   {{1, 1, 1}, 3},        {{1, 1, 1}, 3}};
    static const octree_point absent[] = {{{1, 1, 1}, 9}, {{-1, -1, -1}, 1}, {{0, 5, 0}, 1}, {{0, NAN, 0}, 1}};
    const twins t = make_twins(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    change_both(t, &removal, absent, 4);
    change_both(t, &insertion, NULL, 0);
    change_both(t, &removal, NULL, 0);
    change_both(t, &insertion, refused, 3);
    assert_true(octree_version(t.batched) == octree_version(t.stepped));
    assert_int_equal(change_both(t, &insertion, refused + 3, 1), 1);
    const uint64_t version = octree_version(t.batched);
    assert_int_equal(change_both(t, &insertion, refused, 7), 0);
    assert_int_equal(change_both(t, &removal, absent, 4), 0);
    assert_true(octree_version(t.batched) == version);
    destroy_twins(t);
}

static void statuses_and_counters_may_be_left_out(void **state)
{
    (void)state;
    static const octree_point points[] = {
        {{0.5, 0.5, 0.5}, 1}, {{2, 0, 0}, 2}, {{-0.5, 0, 0}, 3}, {{0.5, 0.5, 0.5}, 1}};
    static const change_many changes[] = {octree_insert_many, octree_remove_many};
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    for (int with = 0; with < 4; with++)
        for (int c = 0; c < 2; c++) {
            octree_status statuses[4] = {OCTREE_STATUS_COUNT};
            size_t done = SIZE_MAX;
            assert_int_equal(changes[c](tree, points, 4, with & 1 ? statuses : NULL, with & 2 ? &done : NULL),
                             OCTREE_OK);
            assert_int_equal(octree_count(tree), c == 0 ? 2 : 0);
            assert_true(done == (with & 2 ? 2 : SIZE_MAX));
            assert_int_equal(statuses[0], with & 1 ? OCTREE_OK : OCTREE_STATUS_COUNT);
        }
    octree_destroy(tree);
}

static void null_and_oversized_arrays_are_refused(void **state)
{
    (void)state;
    static const octree_point point = {{0, 0, 0}, 2};
    static const change_many changes[] = {octree_insert_many, octree_remove_many};
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_REFUSE);
    insert_all(tree, (const double[][3]){{0, 0, 0}}, 1);
    const uint64_t digest = octree_digest(tree), version = octree_version(tree);
    for (int c = 0; c < 2; c++) {
        octree_status status;
        size_t done = SIZE_MAX;
        assert_int_equal(changes[c](NULL, &point, 1, &status, &done), OCTREE_NULL_ARGUMENT);
        assert_int_equal(changes[c](NULL, NULL, 0, NULL, NULL), OCTREE_NULL_ARGUMENT);
        assert_int_equal(changes[c](tree, NULL, 1, &status, &done), OCTREE_NULL_ARGUMENT);
        assert_int_equal(changes[c](tree, &point, SIZE_MAX, NULL, NULL), OCTREE_TOO_MANY);
        assert_int_equal(changes[c](tree, &point, SIZE_MAX / sizeof point, NULL, NULL), OCTREE_TOO_MANY);
        assert_int_equal(changes[c](tree, NULL, 0, NULL, &done), OCTREE_OK);
        assert_int_equal(done, 0);
    }
    assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
    octree_destroy(tree);
}

static void shuffle(uint64_t *random, brute *all)
{
    for (size_t i = all->count; i > 1; i--) {
        const size_t j = random_below(random, i);
        const octree_point kept = all->points[i - 1];
        all->points[i - 1] = all->points[j];
        all->points[j] = kept;
    }
}

/* Insert all in batches of random sizes. */
static void insert_in_pieces(octree *tree, uint64_t *random, const brute *all)
{
    for (size_t at = 0, size; at < all->count; at += size) {
        size = 1 + random_below(random, all->count - at);
        size_t inserted;
        assert_int_equal(octree_insert_many(tree, all->points + at, size, NULL, &inserted), OCTREE_OK);
        assert_int_equal(inserted, size);
    }
}

static void the_order_and_sizes_of_batches_do_not_matter_under_grow(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 200; seed++) {
        uint64_t random = seed;
        brute all = {0};
        brute_scatter(&all, &random, 300, 1 + seed % 10, 5);
        octree *expected = brute_tree(&all, cube(-16, 16), 1 + seed % 9, seed % 22);
        for (int order = 0; order < 3; order++) {
            octree *tree = make_tree(cube(-16, 16), 1 + seed % 9, seed % 22, OCTREE_GROW);
            shuffle(&random, &all);
            insert_in_pieces(tree, &random, &all);
            assert_true(octree_digest(tree) == octree_digest(expected));
            assert_valid(tree);
            octree_destroy(tree);
        }
        octree_destroy(expected);
        brute_free(&all);
    }
}

static void removing_everything_leaves_the_empty_tree(void **state)
{
    (void)state;
    octree *empty = make_tree(cube(-16, 16), 2, 21, OCTREE_GROW);
    for (uint64_t seed = 0; seed < 50; seed++) {
        uint64_t random = seed;
        brute all = {0};
        brute_scatter(&all, &random, 400, seed % 17, 20);
        octree *tree = brute_tree(&all, cube(-16, 16), 2, 21);
        shuffle(&random, &all);
        size_t removed = 0;
        assert_int_equal(octree_remove_many(tree, all.points, all.count, NULL, &removed), OCTREE_OK);
        assert_int_equal(removed, all.count);
        assert_true(octree_digest(tree) == octree_digest(empty));
        assert_valid(tree);
        insert_in_pieces(tree, &random, &all); /* and it is as good as new */
        assert_int_equal(octree_count(tree), all.count);
        assert_valid(tree);
        octree_destroy(tree);
        brute_free(&all);
    }
    octree_destroy(empty);
}

/* What a batch leaves free is taken by the next. */
/* The tree's own points may be passed, in the memory of a leaf. Some points are outside the world, repeated or
 * refused. */
static void replacing_all_points_equals_clearing_and_inserting(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 60; seed++) {
        uint64_t random = seed;
        brute old = {0}, all = {0};
        octree_status expected[400], statuses[400];
        brute_scatter(&old, &random, 300, seed % 17, 20);
        brute_scatter(&all, &random, 400, seed % 13, 20);
        all.points[0].position[1] = 17;
        all.points[7] = all.points[3];
        const twins t = make_twins(cube(-16, 16), 2, 21, seed % 2 ? OCTREE_REFUSE : OCTREE_GROW);
        assert_int_equal(octree_insert_many(t.batched, old.points, old.count, NULL, NULL), OCTREE_OK);
        size_t inserted = 0, stepped = 0;
        assert_int_equal(octree_replace_all(t.batched, all.points, all.count, statuses, &inserted), OCTREE_OK);
        assert_int_equal(octree_insert_many(t.stepped, all.points, all.count, expected, &stepped), OCTREE_OK);
        assert_int_equal(inserted, stepped);
        assert_memory_equal(statuses, expected, all.count * sizeof *statuses);
        assert_twins_equal(t);
        destroy_twins(t);
        brute_free(&old);
        brute_free(&all);
    }
}

static void a_tree_may_be_replaced_by_points_of_its_own_leaf(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-16, 16), 64, 21, OCTREE_GROW);
    octree_node leaf;
    for (uint64_t id = 0; id < 40; id++)
        assert_int_equal(octree_insert(tree, (double[3]){(double)id / 4, 1, 2}, id), OCTREE_OK);
    const uint64_t version = octree_version(tree);
    assert_int_equal(octree_node_at(tree, 1, &leaf), OCTREE_OK);
    assert_int_equal(octree_replace_all(tree, leaf.points + 10, 20, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_count(tree), 20);
    assert_true(octree_contains(tree, (double[3]){2.5, 1, 2}, 10));
    assert_true(octree_version(tree) > version);
    assert_valid(tree);
    assert_int_equal(octree_replace_all(tree, NULL, 0, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_count(tree), 0);
    assert_int_equal(octree_replace_all(tree, NULL, 1, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_replace_all(NULL, NULL, 0, NULL, NULL), OCTREE_NULL_ARGUMENT);
    octree_destroy(tree);
}

static void batches_one_after_the_other_take_no_more_memory(void **state)
{
    (void)state;
    uint64_t random = 1;
    brute all = {0};
    brute_scatter(&all, &random, 5000, 16, 5000);
    octree *tree = make_tree(cube(-16, 16), 4, 21, OCTREE_GROW);
    size_t most[2] = {0};
    for (int round = 0; round < 40; round++) {
        octree_stats stats;
        assert_int_equal(octree_insert_many(tree, all.points, all.count, NULL, NULL), OCTREE_OK);
        shuffle(&random, &all);
        assert_int_equal(octree_remove_many(tree, all.points, all.count - 500, NULL, NULL), OCTREE_OK);
        assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
        size_t *so_far = &most[round / 20];
        *so_far = stats.memory > *so_far ? stats.memory : *so_far;
    }
    assert_true(most[1] <= most[0] + most[0] / 4);
    octree_destroy(tree);
    brute_free(&all);
}

/* Points that are stored, and as many that are not, removed at once. */
static void remove_half(octree *tree, uint64_t *random, brute *all)
{
    shuffle(random, all);
    const size_t half = all->count / 2;
    brute batch = {0};
    for (size_t i = 0; i < half; i++) {
        const octree_point *point = &all->points[all->count - 1 - i];
        brute_insert(&batch, point->position, point->id);
        brute_insert(&batch, point->position, point->id + 1000);
    }
    size_t removed = 0;
    assert_int_equal(octree_remove_many(tree, batch.points, batch.count, NULL, &removed), OCTREE_OK);
    assert_int_equal(removed, half);
    all->count -= half;
    brute_free(&batch);
}

static void assert_answers(const octree *tree, uint64_t *random, const brute *all)
{
    for (int i = 0; i < 30; i++) {
        double target[3];
        octree_box box;
        for (int axis = 0; axis < 3; axis++) {
            target[axis] = (double)random_below(random, 41) - 20;
            box.min[axis] = (double)random_below(random, 33) - 16;
            box.max[axis] = box.min[axis] + (double)random_below(random, 17);
        }
        brute found = {0}, truth = {0};
        assert_int_equal(octree_range(tree, &box, brute_collect, &found), OCTREE_OK);
        brute_range(all, &box, &truth);
        assert_true(brute_equal(&found, &truth));
        octree_neighbor nearest, best;
        assert_true(brute_nearest(all, target, OCTREE_SKIP_NONE, 0, &best));
        assert_int_equal(octree_nearest(tree, target, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_OK);
        assert_true(nearest.point.id == best.point.id && nearest.distance == best.distance);
        brute_free(&found);
        brute_free(&truth);
    }
}

static void queries_are_right_after_batches(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 60; seed++) {
        uint64_t random = seed;
        octree *tree = make_tree(cube(-16, 16), 1 + seed % 5, seed % 22, OCTREE_GROW);
        brute all = {0};
        for (int round = 0; round < 3; round++) {
            const size_t before = all.count;
            brute_scatter(&all, &random, 200, 16, 1000);
            const brute added = {all.points + before, all.count - before, 0};
            insert_in_pieces(tree, &random, &added);
            assert_answers(tree, &random, &all);
            remove_half(tree, &random, &all);
            assert_answers(tree, &random, &all);
        }
        assert_int_equal(octree_count(tree), all.count);
        assert_valid(tree);
        octree_destroy(tree);
        brute_free(&all);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(batches_equal_single_changes),
        cmocka_unit_test(batches_equal_single_changes_in_extreme_worlds),
        cmocka_unit_test(large_batches_equal_single_changes),
        cmocka_unit_test(small_batches_equal_single_changes),
        cmocka_unit_test(a_full_leaf_takes_the_first_in_input_order),
        cmocka_unit_test(what_is_stored_stays_when_a_batch_meets_a_full_leaf),
        cmocka_unit_test(zeros_of_both_signs_are_one_position_and_the_first_bits_are_kept),
        cmocka_unit_test(a_batch_that_does_nothing_leaves_the_version),
        cmocka_unit_test(statuses_and_counters_may_be_left_out),
        cmocka_unit_test(null_and_oversized_arrays_are_refused),
        cmocka_unit_test(the_order_and_sizes_of_batches_do_not_matter_under_grow),
        cmocka_unit_test(removing_everything_leaves_the_empty_tree),
        cmocka_unit_test(replacing_all_points_equals_clearing_and_inserting),
        cmocka_unit_test(a_tree_may_be_replaced_by_points_of_its_own_leaf),
        cmocka_unit_test(batches_one_after_the_other_take_no_more_memory),
        cmocka_unit_test(queries_are_right_after_batches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
