/* SPDX-License-Identifier: MIT */
/* test_memory.c - the allocator contract: all memory is released, and every failure leaves the tree as it was. */
#include "fixture.h"

#include "brute.h"
#include "counting_allocator.h"
#include "octree/game.h"

static size_t memory_of(const octree *tree)
{
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    return stats.memory;
}

static void create_survives_the_failure_of_each_allocation(void **state)
{
    (void)state;
    size_t n = 0;
    octree_status status = OCTREE_NO_MEMORY;
    for (; status == OCTREE_NO_MEMORY; n++) {
        counting_allocator counts = {0};
        octree_def def = define(cube(-1, 1), 2, 5, OCTREE_REFUSE);
        def.allocator = counting_allocator_use(&counts);
        counting_allocator_fail_at(&counts, n);
        octree *tree = (octree *)&def;
        status = octree_create(&def, &tree);
        assert_true(status == OCTREE_OK || (status == OCTREE_NO_MEMORY && tree == NULL));
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
    assert_true(n >= 2); /* it did take memory from the allocator */
}

typedef enum change_kind { CHANGE_INSERT, CHANGE_REMOVE, CHANGE_MOVE } change_kind;

typedef struct change {
    change_kind kind;
    octree_point point;
    double to[3];
} change;

static octree_status apply(octree *tree, const change *c)
{
    if (c->kind == CHANGE_INSERT)
        return octree_insert(tree, c->point.position, c->point.id);
    if (c->kind == CHANGE_REMOVE)
        return octree_remove(tree, c->point.position, c->point.id);
    return octree_move(tree, c->point.position, c->point.id, c->to);
}

/* Do a change with its n-th allocation failing, n = 0, 1, 2 ... until it needs no more; the test fails when a failure
 * leaves a trace. Returns the number of failures that were survived. */
static size_t apply_under_failures(octree *tree, counting_allocator *counts, const change *c)
{
    const uint64_t before = octree_version(tree);
    size_t n = 0;
    for (;; n++) {
        uint64_t digest = octree_digest(tree), version = octree_version(tree);
        size_t points = octree_count(tree);
        counting_allocator_fail_at(counts, n);
        octree_status status = apply(tree, c);
        counting_allocator_stop_failing(counts);
        assert_int_equal(memory_of(tree), counts->bytes);
        if (status == OCTREE_OK)
            break;
        assert_int_equal(status, OCTREE_NO_MEMORY);
        assert_true(octree_digest(tree) == digest);
        assert_true(octree_version(tree) == version);
        assert_int_equal(octree_count(tree), points);
        assert_valid(tree);
    }
    assert_true(octree_version(tree) > before); /* it only grows */
    assert_valid(tree);
    return n;
}

static void random_position(uint64_t *random, double at[3])
{
    bool crowded = random_below(random, 3) == 0;
    for (int axis = 0; axis < 3; axis++)
        at[axis] = crowded ? 0.5 : (double)random_below(random, 4097) / 2048 - 1;
}

static change random_insertion(uint64_t *random, brute *all, uint64_t id)
{
    change c = {.kind = CHANGE_INSERT, .point.id = id};
    random_position(random, c.point.position);
    brute_insert(all, c.point.position, id);
    return c;
}

static change random_change(uint64_t *random, brute *all, uint64_t id)
{
    change c = {.kind = (change_kind)random_below(random, 3)};
    if (all->count == 0 || random_below(random, 3) == 0 || c.kind == CHANGE_INSERT)
        return random_insertion(random, all, id);
    c.point = all->points[random_below(random, all->count)];
    random_position(random, c.to);
    assert_true(brute_remove(all, c.point.position, c.point.id));
    if (c.kind == CHANGE_MOVE)
        brute_insert(all, c.to, c.point.id);
    return c;
}

static void changes_survive_the_failure_of_each_allocation(void **state)
{
    (void)state;
    size_t survived = 0;
    for (uint64_t seed = 0; seed < 12; seed++) {
        uint64_t random = seed;
        counting_allocator counts = {0};
        octree *tree = make_counted_tree(&counts, cube(-1, 1), 1 + seed % 4, 3 + seed, OCTREE_GROW);
        brute all = {0};
        for (uint64_t id = 0; id < 400; id++) {
            change c = random_change(&random, &all, id);
            survived += apply_under_failures(tree, &counts, &c);
            assert_int_equal(octree_count(tree), all.count);
        }
        brute found = {0};
        octree_box world = cube(-1, 1);
        assert_int_equal(octree_range(tree, &world, brute_collect, &found), OCTREE_OK);
        assert_true(brute_equal(&found, &all));
        brute_free(&found);
        brute_free(&all);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
    assert_true(survived > 0);
}

/* Memory ends after some changes, while blocks that were taken before are not yet full: whichever change is the first
 * that needs more does nothing. */
static void changes_are_whole_when_memory_ends(void **state)
{
    (void)state;
    size_t failed[3] = {0};
    for (uint64_t seed = 0; seed < 300; seed++) {
        uint64_t random = seed, id = 0;
        counting_allocator counts = {0};
        const size_t capacity = seed % 3 == 0 ? 70 : 1 + seed % 4; /* more than 64 in a leaf are a block of their own */
        octree *tree = make_counted_tree(&counts, cube(-1, 1), capacity, 1 + seed % 11, OCTREE_GROW);
        brute all = {0};
        change c = {.kind = CHANGE_INSERT};
        for (; id < 100 + seed; id++) {
            c = random_change(&random, &all, id);
            assert_int_equal(apply(tree, &c), OCTREE_OK);
        }
        counts.fail_from = counts.calls;
        counts.fail_until = SIZE_MAX;
        octree_status status = OCTREE_OK;
        uint64_t digest = 0, version = 0;
        for (; status == OCTREE_OK && id < 2000; id++) {
            digest = octree_digest(tree);
            version = octree_version(tree);
            c = seed % 2 ? random_insertion(&random, &all, id) : random_change(&random, &all, id);
            status = apply(tree, &c);
        }
        assert_int_equal(status, OCTREE_NO_MEMORY);
        assert_true(octree_digest(tree) == digest && octree_version(tree) == version);
        assert_valid(tree);
        failed[c.kind]++;
        counting_allocator_stop_failing(&counts);
        assert_int_equal(apply(tree, &c), OCTREE_OK);
        assert_valid(tree);
        assert_int_equal(octree_count(tree), all.count);
        brute_free(&all);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
    assert_true(failed[CHANGE_INSERT] > 9 && failed[CHANGE_REMOVE] > 0 && failed[CHANGE_MOVE] > 9);
}

/* Whatever an insertion needs memory for: a leaf more, a larger leaf, a split. */
static void each_allocation_of_many_insertions_may_fail(void **state)
{
    (void)state;
    static const size_t capacities[] = {1, 2, 3, 7, 20};
    for (size_t row = 0; row < sizeof capacities / sizeof *capacities; row++) {
        uint64_t random = row;
        counting_allocator counts = {0};
        octree *tree = make_counted_tree(&counts, cube(-1, 1), capacities[row], 21, OCTREE_GROW);
        size_t refused = 0;
        for (uint64_t id = 0; id < 20000; id++) {
            const double at[3] = {random_between(&random, -1, 1), random_between(&random, -1, 1),
                                  random_between(&random, -1, 1)};
            const uint64_t version = octree_version(tree);
            counting_allocator_fail_at(&counts, 0);
            octree_status status = octree_insert(tree, at, id);
            counting_allocator_stop_failing(&counts);
            if (status == OCTREE_NO_MEMORY) {
                assert_int_equal(octree_count(tree), id);
                assert_true(octree_version(tree) == version);
                if (refused++ % 8 == 0)
                    assert_valid(tree);
                status = octree_insert(tree, at, id);
            }
            assert_int_equal(status, OCTREE_OK);
        }
        assert_true(refused > 30);
        assert_valid(tree);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
}

static void equal_points_that_fill_a_leaf_stay_without_memory(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 70, 3, OCTREE_GROW);
    const double here[3] = {0.5, 0.5, 0.5};
    for (uint64_t id = 0; id < 70; id++)
        assert_int_equal(octree_insert(tree, here, id), OCTREE_OK);
    counting_allocator_fail_at(&counts, 0); /* that of a leaf of 71 */
    assert_int_equal(octree_insert(tree, here, 70), OCTREE_NO_MEMORY);
    assert_int_equal(octree_count(tree), 70);
    assert_valid(tree);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void a_large_leaf_is_emptied_without_memory(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 1, 2, OCTREE_GROW);
    const double here[3] = {0.5, 0.5, 0.5}, there[3] = {-0.5, -0.5, -0.5};
    for (uint64_t id = 0; id < 200; id++)
        assert_int_equal(octree_insert(tree, here, id), OCTREE_OK);
    assert_int_equal(octree_insert(tree, there, 1), OCTREE_OK);
    assert_int_equal(octree_insert(tree, there, 2), OCTREE_OK);
    counts.fail_from = counts.calls;
    counts.fail_until = SIZE_MAX;
    for (uint64_t id = 0; id < 200; id++)
        assert_int_equal(octree_remove(tree, here, id), OCTREE_OK);
    assert_int_equal(octree_count(tree), 2);
    assert_valid(tree);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void a_hashed_leaf_of_equal_points_survives_failures_as_well(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 1, 2, OCTREE_GROW);
    size_t survived = 0;
    for (uint64_t i = 0; i < 600; i++) {
        change c = {.kind = CHANGE_INSERT, .point = {{0.5, 0.5, 0.5}, i * 7919 % 600}};
        survived += apply_under_failures(tree, &counts, &c);
    }
    for (uint64_t i = 0; i < 600; i++) {
        change c = {.kind = i % 2 == 0 ? CHANGE_REMOVE : CHANGE_MOVE,
                    .point = {{0.5, 0.5, 0.5}, i * 7907 % 600},
                    .to = {-0.5, -0.5, -0.5}};
        survived += apply_under_failures(tree, &counts, &c);
    }
    assert_int_equal(octree_count(tree), 300);
    assert_true(survived > 0);
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void a_tree_without_any_more_memory_still_answers(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 21, OCTREE_GROW);
    uint64_t random = 2;
    for (uint64_t id = 0; id < 300; id++) {
        double at[3];
        random_position(&random, at);
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
    }
    size_t calls = counts.calls;
    counts.fail_from = 0;
    counts.fail_until = SIZE_MAX;
    octree_neighbor nearest;
    size_t count = 0;
    octree_box world = cube(-1, 1);
    assert_int_equal(octree_nearest(tree, (double[3]){0.1, 0.2, 0.3}, OCTREE_SKIP_NONE, 0, &nearest), OCTREE_OK);
    assert_int_equal(octree_range_count(tree, &world, &count), OCTREE_OK);
    assert_int_equal(count, 300);
    assert_int_equal(octree_find(tree, nearest.point.position, NULL), OCTREE_OK);
    assert_valid(tree);
    assert_int_equal(counts.calls, calls); /* queries take nothing from the tree's allocator */
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void clear_gives_the_memory_back(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 2, 21, OCTREE_GROW);
    size_t empty = counts.bytes;
    uint64_t random = 3;
    for (int round = 0; round < 3; round++) {
        for (uint64_t id = 0; id < 20000; id++) {
            double at[3];
            random_position(&random, at);
            assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
        }
        assert_true(counts.bytes > 20000 * sizeof(octree_point) / 2);
        const uint64_t version = octree_version(tree);
        assert_int_equal(octree_clear(tree), OCTREE_OK);
        assert_true(octree_version(tree) > version);
        assert_int_equal(memory_of(tree), counts.bytes);
        assert_true(counts.bytes <= empty + 4096);
    }
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void churn_does_not_grow_the_memory(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = make_counted_tree(&counts, cube(-1, 1), 3, 21, OCTREE_GROW);
    uint64_t random = 4;
    static double at[1000][3];
    for (uint64_t id = 0; id < 1000; id++) {
        random_position(&random, at[id]);
        assert_int_equal(octree_insert(tree, at[id], id), OCTREE_OK);
    }
    size_t limit = 0;
    for (uint64_t i = 0; i < 100000; i++) {
        uint64_t id = random_below(&random, 1000);
        double to[3];
        random_position(&random, to);
        assert_int_equal(octree_move(tree, at[id], id, to), OCTREE_OK);
        for (int axis = 0; axis < 3; axis++)
            at[id][axis] = to[axis];
        if (i == 10000)
            limit = 2 * counts.bytes + 65536;
        assert_true(limit == 0 || counts.bytes <= limit);
    }
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void play_under_failures(bool sweep)
{
    static const octree_query queries[] = {
        {.tick = 219, .kind = OCTREE_QUERY_RANGE, .box = {{700, 700, 700}, {1000, 1000, 1000}}},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = SIZE_MAX},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RADIUS, .at_player = true, .radius = 900},
        {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_KNEAREST, .k = 9},
    };
    bool failed = true;
    for (size_t n = 0; failed; n++) { /* some failures cost time alone: the last is the one that is not reached */
        counting_allocator counts = {0};
        octree_session session = octree_session_default();
        session.player.sweep = sweep;
        session.queries = queries;
        session.query_count = sizeof queries / sizeof queries[0];
        session.tree.allocator = counting_allocator_use(&counts);
        counting_allocator_fail_at(&counts, n);
        octree_game *game = NULL;
        octree_status status = octree_game_create(&session, &game);
        assert_true((game != NULL) == (status == OCTREE_OK));
        while (status == OCTREE_OK && !octree_game_over(game)) {
            status = octree_game_advance(game);
            assert_true(status != OCTREE_OK ||
                        octree_game_tick(game)->tree_digest == octree_digest(octree_game_tree(game)));
        }
        assert_true(status == OCTREE_OK || status == OCTREE_NO_MEMORY);
        failed = counts.calls > n;
        octree_game_destroy(game);
        assert_all_returned(&counts);
    }
}

static void a_game_survives_the_failure_of_each_allocation(void **state)
{
    (void)state;
    play_under_failures(false);
    play_under_failures(true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(create_survives_the_failure_of_each_allocation),
        cmocka_unit_test(changes_survive_the_failure_of_each_allocation),
        cmocka_unit_test(changes_are_whole_when_memory_ends),
        cmocka_unit_test(each_allocation_of_many_insertions_may_fail),
        cmocka_unit_test(equal_points_that_fill_a_leaf_stay_without_memory),
        cmocka_unit_test(a_large_leaf_is_emptied_without_memory),
        cmocka_unit_test(a_hashed_leaf_of_equal_points_survives_failures_as_well),
        cmocka_unit_test(a_tree_without_any_more_memory_still_answers),
        cmocka_unit_test(clear_gives_the_memory_back),
        cmocka_unit_test(churn_does_not_grow_the_memory),
        cmocka_unit_test(a_game_survives_the_failure_of_each_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
