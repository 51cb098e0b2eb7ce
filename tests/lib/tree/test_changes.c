/* SPDX-License-Identifier: MIT */
/* test_changes.c - a program that follows the change log has the contents of the tree, or is told to read the tree. */
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "counting_allocator.h"

/* Somebody who keeps a copy of a tree's contents. */
typedef struct follower {
    octree_cursor mark;
    size_t name;
    brute copy;
    size_t told, looked; /* how often each way was taken */
    size_t changes;      /* that were told */
} follower;

static void take_change(const octree_change *c, void *context)
{
    follower *f = context;
    f->changes++;
    if (c->kind != OCTREE_INSERTED)
        assert_true(brute_remove(&f->copy, c->from, c->id));
    if (c->kind != OCTREE_REMOVED)
        brute_insert(&f->copy, c->to, c->id);
}

static brute contents_of(const octree *tree)
{
    brute all = {0};
    const octree_box world = octree_definition(tree).world;
    assert_int_equal(octree_range(tree, &world, brute_collect, &all), OCTREE_OK);
    return all;
}

static bool follow(follower *f, const octree *tree)
{
    const bool known = octree_changes_since(tree, f->name, &f->mark, take_change, f);
    brute now = contents_of(tree);
    if (known) {
        assert_true(brute_equal(&f->copy, &now));
        brute_free(&now);
        f->told++;
        return true;
    }
    brute_free(&f->copy);
    f->copy = now;
    f->looked++;
    return false;
}

static void ignore_change(const octree_change *c, void *context)
{
    (void)c, (void)context;
    fail_msg("a change is told that is not known");
}

/* ---- Random changes ----------------------------------------------------------------------------------------- */

enum { BATCH = 40 };

typedef struct play {
    octree *tree;
    uint64_t random, next_id;
} play;

static void random_place(play *p, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = (double)random_below(&p->random, 65) - 32;
    if (random_below(&p->random, 30) == 0)
        at[0] = 1000; /* outside: refused */
}

/* Some that are stored, some that are not, some twice. */
static size_t random_batch(play *p, octree_point points[BATCH], double to[BATCH][3])
{
    brute all = contents_of(p->tree);
    const size_t count = random_below(&p->random, BATCH);
    for (size_t i = 0; i < count; i++) {
        points[i].id = p->next_id++;
        random_place(p, points[i].position);
        random_place(p, to[i]);
        if (all.count && random_below(&p->random, 6))
            points[i] = all.points[random_below(&p->random, all.count)];
        if (i && random_below(&p->random, 8) == 0)
            points[i] = points[i - 1];
    }
    brute_free(&all);
    return count;
}

static void change_many(play *p)
{
    octree_point points[BATCH];
    double to[BATCH][3];
    octree_status own[BATCH], *statuses = random_below(&p->random, 2) ? own : NULL;
    const size_t count = random_batch(p, points, to);
    switch (random_below(&p->random, 4)) {
    case 0:
        assert_int_equal(octree_remove_many(p->tree, points, count, statuses, NULL), OCTREE_OK);
        break;
    case 1:
        assert_int_equal(octree_move_many(p->tree, points, (const double(*)[3])to, count, statuses, NULL), OCTREE_OK);
        break;
    default:
        for (size_t i = 0; i < count; i++)
            memcpy(points[i].position, to[i], sizeof to[i]);
        assert_int_equal(octree_insert_many(p->tree, points, count, statuses, NULL), OCTREE_OK);
    }
}

static void change_one(play *p)
{
    octree_point points[BATCH];
    double to[BATCH][3];
    const size_t count = random_batch(p, points, to);
    for (size_t i = 0; i < count; i++)
        switch (random_below(&p->random, 3)) {
        case 0:
            octree_remove(p->tree, points[i].position, points[i].id);
            break;
        case 1:
            octree_move(p->tree, points[i].position, points[i].id, to[i]);
            break;
        default:
            octree_insert(p->tree, to[i], points[i].id);
        }
}

/* What changes all of the tree, or only how it is stored. */
static void change_all(play *p)
{
    const octree_box world = cube(-40, 40);
    switch (random_below(&p->random, 4)) {
    case 0:
        octree_clear(p->tree);
        break;
    case 1:
        octree_compact(p->tree);
        break;
    case 2:
        octree_reworld(p->tree, &world);
        break;
    default:
        octree_tune(p->tree, NULL);
    }
}

static void followers_match_the_contents_after_random_changes(void **state)
{
    (void)state;
    size_t told = 0, looked = 0;
    for (uint64_t seed = 0; seed < 8; seed++) {
        octree_def def = define(cube(-32, 32), seed % 2 ? OCTREE_AUTO : 4, 6, OCTREE_GROW);
        play p = {.random = seed};
        follower f[2] = {{.name = 1}, {.name = 2}};
        assert_int_equal(octree_create(&def, &p.tree), OCTREE_OK);
        for (int round = 0; round < 150; round++) {
            const uint64_t kind = random_below(&p.random, 40);
            (kind == 0 ? change_all : kind < 20 ? change_many : change_one)(&p);
            follow(&f[0], p.tree);
            if (random_below(&p.random, 3) == 0)
                follow(&f[1], p.tree);
        }
        for (int i = 0; i < 2; i++) {
            told += f[i].told;
            looked += f[i].looked;
            brute_free(&f[i].copy);
        }
        octree_destroy(p.tree);
    }
    assert_true(looked > 20);
    assert_true(told > 10 * looked);
}

/* A refusal by a full leaf is no change, and what a batch refuses neither. */
static void a_refused_change_is_not_logged(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 0, OCTREE_REFUSE);
    follower f = {.name = 1};
    const octree_point two[2] = {{{0, 0, 0}, 1}, {{0.5, 0, 0}, 2}};
    assert_false(follow(&f, tree));
    assert_int_equal(octree_insert_many(tree, two, 2, NULL, NULL), OCTREE_OK);
    assert_int_equal(octree_insert(tree, two[1].position, 2), OCTREE_FULL);
    assert_int_equal(octree_remove(tree, two[1].position, 2), OCTREE_NOT_FOUND);
    assert_int_equal(octree_move(tree, two[1].position, 2, two[0].position), OCTREE_NOT_FOUND);
    assert_true(follow(&f, tree));
    assert_int_equal(f.changes, 1);
    brute_free(&f.copy);
    octree_destroy(tree);
}

/* As from a node that was looked at. */
static void a_point_may_be_removed_by_its_place_in_the_tree(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 4, 5, OCTREE_GROW);
    follower f = {.name = 1};
    octree_node leaf;
    assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, 1), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){0.5, 0, 0}, 2), OCTREE_OK);
    assert_int_equal(octree_insert(tree, (double[3]){0.75, 0, 0}, 3), OCTREE_OK);
    follow(&f, tree);
    assert_int_equal(octree_node_at(tree, OCTREE_ROOT, &leaf), OCTREE_OK);
    assert_int_equal(octree_remove(tree, leaf.points[0].position, leaf.points[0].id), OCTREE_OK);
    assert_true(follow(&f, tree));
    assert_int_equal(octree_node_at(tree, OCTREE_ROOT, &leaf), OCTREE_OK);
    assert_int_equal(octree_remove_many(tree, leaf.points, 1, NULL, NULL), OCTREE_OK);
    assert_true(follow(&f, tree));
    brute_free(&f.copy);
    octree_destroy(tree);
}

/* ---- Signs of zeros: a mirror may compare bits ----------------------------------------------------------------- */

enum { MIRRORED = 8 };

typedef struct mirror {
    octree_point points[MIRRORED];
    size_t count;
} mirror;

static size_t find_by_bits(const mirror *m, const double at[3], uint64_t id)
{
    size_t i = 0;
    while (i < m->count && (m->points[i].id != id || memcmp(m->points[i].position, at, sizeof m->points[i].position)))
        i++;
    return i;
}

static void mirror_change(const octree_change *c, void *context)
{
    mirror *m = context;
    if (c->kind != OCTREE_INSERTED) {
        const size_t i = find_by_bits(m, c->from, c->id);
        assert_true(i < m->count);
        m->points[i] = m->points[--m->count];
    }
    if (c->kind != OCTREE_REMOVED) {
        assert_true(m->count < MIRRORED);
        octree_point *p = &m->points[m->count++];
        p->id = c->id;
        memcpy(p->position, c->to, sizeof p->position);
    }
}

static void assert_mirrored(const octree *tree, octree_cursor *cursor, mirror *m)
{
    assert_true(octree_changes_since(tree, 1, cursor, mirror_change, m));
    brute all = contents_of(tree);
    assert_int_equal(all.count, m->count);
    for (size_t i = 0; i < all.count; i++)
        assert_true(find_by_bits(m, all.points[i].position, all.points[i].id) < m->count);
    brute_free(&all);
}

static void changes_have_the_stored_signs_of_zeros(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    const double plus[3] = {0.0, 0.5, 0.0}, minus[3] = {-0.0, 0.5, 0.0}, other[3] = {0.25, -0.0, 0.5};
    octree_cursor cursor = {0};
    mirror m = {.count = 0};
    octree_changes_since(tree, 1, &cursor, mirror_change, &m);
    for (uint64_t id = 0; id < 4; id++)
        assert_int_equal(octree_insert(tree, id % 2 ? plus : minus, id), OCTREE_OK);
    assert_mirrored(tree, &cursor, &m);
    assert_int_equal(octree_remove(tree, plus, 0), OCTREE_OK);
    assert_int_equal(octree_move(tree, minus, 1, other), OCTREE_OK); /* to another leaf */
    assert_int_equal(octree_move(tree, plus, 2, plus), OCTREE_OK);   /* within its leaf */
    assert_int_equal(octree_remove(tree, minus, 3), OCTREE_OK);
    assert_mirrored(tree, &cursor, &m);
    octree_destroy(tree);
}

/* Two of the moves start where an earlier one of the batch ends, with the other sign. */
static void batches_have_the_stored_signs_of_zeros(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    const octree_point stored[4] = {
        {{-0.0, 0.5, 1}, 1}, {{0.0, 0.5, 1}, 2}, {{0.5, -0.0, -0.0}, 2}, {{0.5, 0.5, 0}, 3}};
    const octree_point moved[5] = {
        {{0.0, 0.5, 1}, 1}, {{-0.5, 0.0, -0.0}, 1}, {{-0.0, 0.5, 1}, 2}, {{0.5, 0.0, 0.0}, 2}, {{0.0, 0.5, 1}, 2}};
    const double to[5][3] = {{-0.5, -0.0, 0.0}, {0.0, 0.0, -0.0}, {1, 1, 1}, {-0.0, 0.5, 1}, {0.0, -0.5, 0.0}};
    const octree_point removed[3] = {{{-0.0, -0.0, 0.0}, 1}, {{-0.0, -0.5, -0.0}, 2}, {{0.5, 0.5, -0.0}, 3}};
    octree_cursor cursor = {0};
    mirror m = {.count = 0};
    octree_changes_since(tree, 1, &cursor, mirror_change, &m);
    assert_int_equal(octree_insert_many(tree, stored, 4, NULL, NULL), OCTREE_OK);
    assert_mirrored(tree, &cursor, &m);
    size_t done;
    assert_int_equal(octree_move_many(tree, moved, to, 5, NULL, &done), OCTREE_OK);
    assert_int_equal(done, 5);
    assert_mirrored(tree, &cursor, &m);
    assert_int_equal(octree_remove_many(tree, removed, 3, NULL, &done), OCTREE_OK);
    assert_int_equal(done, 3);
    assert_mirrored(tree, &cursor, &m);
    octree_destroy(tree);
}

/* ---- What is not known -------------------------------------------------------------------------------------- */

static void changes_are_unknown_without_a_cursor_or_a_log_name(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 4, 5, OCTREE_GROW);
    octree_cursor mark = {0}, other = {0};
    assert_false(octree_changes_since(NULL, 1, &mark, ignore_change, NULL));
    assert_false(octree_changes_since(tree, 0, &mark, ignore_change, NULL));
    assert_false(octree_changes_since(tree, 1, NULL, ignore_change, NULL));
    assert_false(octree_changes_since(tree, 1, &mark, NULL, NULL));
    assert_false(octree_changes_since(tree, 1, &mark, ignore_change, NULL));
    assert_true(octree_changes_since(tree, 1, &mark, ignore_change, NULL));
    assert_false(octree_changes_since(tree, 2, &other, ignore_change, NULL));
    assert_true(octree_changes_since(tree, 2, &other, ignore_change, NULL));
    octree_destroy(tree);
}

/* Even where the other tree has as many changes: their logs have different names. */
static void changes_are_unknown_for_a_cursor_of_another_tree(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 4, 5, OCTREE_GROW), *other = make_tree(cube(-1, 1), 4, 5, OCTREE_GROW);
    octree_cursor mark = {0}, fresh = {0};
    assert_false(octree_changes_since(tree, 7, &mark, ignore_change, NULL));
    assert_false(octree_changes_since(other, 8, &fresh, ignore_change, NULL));
    const double at[3] = {0, 0, 0};
    assert_int_equal(octree_insert(tree, at, 1), OCTREE_OK);
    assert_int_equal(octree_insert(other, at, 2), OCTREE_OK);
    assert_false(octree_changes_since(other, 7, &mark, ignore_change, NULL));
    octree_destroy(tree);
    octree_destroy(other);
}

/* Not even where somebody gave the name of the log before it to the log after it. */
static void changes_are_unknown_after_a_new_world(void **state)
{
    (void)state;
    const octree_box world = cube(-2, 2);
    for (int kind = 0; kind < 2; kind++) {
        octree *tree = make_tree(cube(-1, 1), 4, 5, OCTREE_GROW);
        follower one = {.name = 1}, other = {.name = 1};
        assert_false(follow(&one, tree) || follow(&other, tree));
        for (uint64_t id = 0; id < 7; id++) {
            if (id == 3) {
                assert_true(follow(&other, tree));
                assert_int_equal(kind ? octree_reworld(tree, &world) : octree_compact(tree), OCTREE_OK);
                assert_false(follow(&one, tree));
            }
            assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, id), OCTREE_OK);
        }
        assert_false(follow(&other, tree));
        brute_free(&one.copy);
        brute_free(&other.copy);
        octree_destroy(tree);
    }
}

static size_t memory_of(const octree *tree)
{
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    return stats.memory;
}

/* And from then on no memory is taken, nor is it while nobody asks. */
static void changes_are_unknown_after_too_many(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 4, 5, OCTREE_GROW);
    const octree_point point = {{0, 0, 0}, 1};
    follower f = {.name = 1};
    assert_int_equal(octree_insert(tree, point.position, point.id), OCTREE_OK);
    const size_t memory = memory_of(tree);
    for (int batch = 0; batch < 2; batch++) {
        follow(&f, tree);
        for (int i = 0; i < 512; i++) {
            if (i == 1)
                assert_true(memory_of(tree) > memory);
            assert_int_equal(octree_move(tree, point.position, 1, point.position), OCTREE_OK);
            assert_int_equal(octree_move(tree, point.position, 1, point.position), OCTREE_OK);
        }
        assert_true(follow(&f, tree));
        for (int i = 0; i < 1025; i++)
            assert_int_equal(octree_move(tree, point.position, 1, point.position), OCTREE_OK);
        assert_int_equal(memory_of(tree), memory);
        assert_false(follow(&f, tree));
        assert_true(follow(&f, tree));
    }
    brute_free(&f.copy);
    octree_destroy(tree);
}

/* Without memory for the log, a change is made all the same, and is not known. */
static void changes_succeed_when_the_log_has_no_memory(void **state)
{
    (void)state;
    size_t unknown = 0;
    for (size_t n = 0; n < 12; n++) {
        counting_allocator counts = {0};
        octree *tree = make_counted_tree(&counts, cube(-1, 1), 64, 5, OCTREE_GROW);
        follower f = {.name = 1};
        for (uint64_t id = 0; id < 12; id++)
            assert_int_equal(octree_insert(tree, (double[3]){0, 0, 0}, id), OCTREE_OK);
        follow(&f, tree);
        counting_allocator_fail_at(&counts, n);
        for (uint64_t id = 0; id < 12; id++) /* within its leaf: no move needs memory */
            assert_int_equal(octree_move(tree, (double[3]){0, 0, 0}, id, (double[3]){0, 0, 0.001}), OCTREE_OK);
        for (uint64_t id = 0; id < 12; id++)
            assert_int_equal(octree_move(tree, (double[3]){0, 0, 0.001}, id, (double[3]){0, 0, 0}), OCTREE_OK);
        counting_allocator_stop_failing(&counts);
        unknown += !follow(&f, tree);
        brute_free(&f.copy);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
    assert_true(unknown >= 1 && unknown < 12);
}

static void a_change_refused_as_null_is_not_logged(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    follower f = {.name = 1};
    const double at[3] = {0};
    assert_false(follow(&f, tree));
    assert_int_equal(octree_insert(tree, NULL, 1), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_remove(tree, NULL, 1), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_move(tree, NULL, 1, at), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_move(tree, at, 1, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_insert_many(tree, NULL, 1, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_remove_many(tree, NULL, 0, NULL, NULL), OCTREE_OK);
    assert_true(follow(&f, tree));
    assert_int_equal(f.changes, 0);
    brute_free(&f.copy);
    octree_destroy(tree);
}

enum { LARGE = 2000 };

/* Of which a tree of so few remembers half. */
static void changes_are_unknown_after_too_large_a_batch(void **state)
{
    (void)state;
    static octree_point points[LARGE];
    for (uint64_t i = 0; i < LARGE; i++)
        points[i] = (octree_point){{(double)i / LARGE, 0, 0}, i};
    octree *tree = make_tree(cube(-1, 1), 4, 21, OCTREE_GROW);
    follower f = {.name = 1};
    follow(&f, tree);
    assert_int_equal(octree_insert_many(tree, points, LARGE, NULL, NULL), OCTREE_OK);
    assert_false(follow(&f, tree));
    for (size_t first = 0; first < LARGE; first += LARGE / 2) /* the second of these is too much amid itself */
        assert_int_equal(octree_remove_many(tree, points + first, 700, NULL, NULL), OCTREE_OK);
    assert_false(follow(&f, tree));
    assert_true(follow(&f, tree));
    brute_free(&f.copy);
    octree_destroy(tree);
}

/* A batch is noted by its statuses, which are the first allocation that it makes where the caller wants none. */
static void a_batch_succeeds_without_memory_to_log_it(void **state)
{
    (void)state;
    for (size_t n = 0; n < 2; n++) {
        counting_allocator counts = {0};
        octree *tree = make_counted_tree(&counts, cube(-1, 1), 64, 5, OCTREE_GROW);
        const octree_point points[2] = {{{0, 0, 0}, 1}, {{0.5, 0, 0}, 2}};
        follower f = {.name = 1};
        follow(&f, tree);
        counting_allocator_fail_at(&counts, n);
        assert_int_equal(octree_insert_many(tree, points, 2, NULL, NULL), n < 1 ? OCTREE_OK : OCTREE_NO_MEMORY);
        counting_allocator_stop_failing(&counts);
        assert_int_equal(octree_count(tree), n < 1 ? 2 : 0);
        assert_int_equal(follow(&f, tree), n == 1);
        brute_free(&f.copy);
        octree_destroy(tree);
        assert_all_returned(&counts);
    }
}

/* The destination is the position of a stored point, whose leaf splits and so frees its memory. */
static void a_destination_in_the_trees_own_memory_is_logged(void **state)
{
    (void)state;
    octree *tree = make_tree(octree_def_default().world, 2, OCTREE_MAX_DEPTH, OCTREE_GROW);
    const octree_point points[] = {{{1, 2, 3}, 1}, {{4, 5, 6}, 2}, {{-7, -8, -9}, 3}};
    follower f = {.name = 1};
    assert_int_equal(octree_insert_many(tree, points, 3, NULL, NULL), OCTREE_OK);
    assert_false(follow(&f, tree));
    octree_node leaf;
    size_t moved;
    assert_int_equal(octree_locate(tree, points[0].position, &leaf), OCTREE_OK);
    assert_int_equal(leaf.count, 2);
    const octree_point *stored = leaf.points;
    assert_int_equal(octree_move_many(tree, &points[2], (const double(*)[3])stored->position, 1, NULL, &moved),
                     OCTREE_OK);
    assert_int_equal(moved, 1);
    assert_true(follow(&f, tree));
    assert_int_equal(f.changes, 1);
    brute_free(&f.copy);
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(followers_match_the_contents_after_random_changes),
        cmocka_unit_test(a_refused_change_is_not_logged),
        cmocka_unit_test(a_point_may_be_removed_by_its_place_in_the_tree),
        cmocka_unit_test(changes_have_the_stored_signs_of_zeros),
        cmocka_unit_test(batches_have_the_stored_signs_of_zeros),
        cmocka_unit_test(changes_are_unknown_without_a_cursor_or_a_log_name),
        cmocka_unit_test(changes_are_unknown_for_a_cursor_of_another_tree),
        cmocka_unit_test(changes_are_unknown_after_a_new_world),
        cmocka_unit_test(changes_are_unknown_after_too_many),
        cmocka_unit_test(changes_succeed_when_the_log_has_no_memory),
        cmocka_unit_test(a_change_refused_as_null_is_not_logged),
        cmocka_unit_test(changes_are_unknown_after_too_large_a_batch),
        cmocka_unit_test(a_batch_succeeds_without_memory_to_log_it),
        cmocka_unit_test(a_destination_in_the_trees_own_memory_is_logged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
