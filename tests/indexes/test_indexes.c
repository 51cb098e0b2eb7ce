/* SPDX-License-Identifier: MIT */
/* test_indexes.c - each index answers as its library promises, and a planted fault is found in each. */
#include "fixture.h"
#include "index.h"
#include "answer_error.h"
#include "point_sets.h"
#include "quick_oracle.h"
#include "truth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 12, QUERIES = 60 };

/* Rounding of doubles may exchange neighbours whose distances differ by less, and the points of a boundary. */
#define DOUBLE_RATIO (1 + 0x1p-50)
#define FLOAT_RATIO (1 + 4e-6)

/* Whether an error is more than rounding explains. */
static bool is_fault(const spatial_index *index, const answer_error *error, octree_query_kind kind)
{
    if (error->unknown > 0 || error->extra > 0)
        return true;
    if (octree_query_about(kind)->neighbors)
        return error->ratio > (index->precision == OCTREE_FLOATS ? FLOAT_RATIO : DOUBLE_RATIO);
    return error->missing > 0 && !error->boundary;
}

/* Points of doubles that floats hold too, so that an index of floats has the same points. */
static void round_points(octree_point *points, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            points[i].position[axis] = round_to_float(points[i].position[axis]);
}

/* A query whose numbers floats hold, away from the boundaries of other points. */
static octree_query make_query(uint64_t *random, octree_query_kind kind)
{
    octree_query query = {.kind = kind, .k = 1 + (size_t)random_below(random, QUICK_NEAREST_MOST)};
    query.radius = (double)random_below(random, 800) + 0.5;
    for (int axis = 0; axis < 3; axis++) {
        query.target[axis] = (double)random_below(random, 2000) - 1000;
        query.box.min[axis] = query.target[axis] - query.radius / 2;
        query.box.max[axis] = query.target[axis] + query.radius / 4;
    }
    return query;
}

/* The number of faulty answers of an index that was built of points[0 .. built - 1], where all `count` points count. */
static size_t count_faults(const spatial_index *index, const octree_point *points, size_t built, size_t count,
                           uint64_t *random)
{
    static uint64_t ids[POINT_SET_MOST];
    const octree_box world = cube(-1000, 1000);
    void *const self = index->create(points, built, &world, 0);
    size_t faults = 0;
    assert_non_null(self);
    for (int i = 0; i < QUERIES; i++) {
        const octree_query_kind kind = (octree_query_kind)(i % OCTREE_QUERY_KINDS);
        if (!(index->kinds >> kind & 1))
            continue;
        const octree_query query = make_query(random, kind);
        const size_t found = index->ask(self, &query, ids, POINT_SET_MOST);
        assert_in_range(found, 0, POINT_SET_MOST);
        const answer_error error = find_answer_error(&query, points, count, ids, found, NULL);
        faults += is_fault(index, &error, kind);
    }
    index->destroy(self);
    return faults;
}

static size_t count_all_faults(const spatial_index *index, size_t dropped)
{
    static octree_point points[POINT_SET_MOST];
    uint64_t random = 1;
    size_t faults = 0;
    for (int round = 0; round < ROUNDS; round++) {
        const size_t count = point_set_fill(&point_sets[0], &random, points);
        round_points(points, count);
        faults += count_faults(index, points, count - dropped, count, &random);
    }
    return faults;
}

static void every_index_answers_as_its_library_promises(void **state)
{
    (void)state;
    for (size_t i = 0; all_indexes[i]; i++) {
        print_message("%s %s\n", all_indexes[i]->name, all_indexes[i]->version);
        assert_int_equal(count_all_faults(all_indexes[i], 0), 0);
    }
}

static void an_index_that_lacks_points_is_found_faulty(void **state)
{
    (void)state;
    for (size_t i = 0; all_indexes[i]; i++)
        assert_true(count_all_faults(all_indexes[i], 40) > 0);
}

/* The judge itself, by answers whose errors are known. */
static void the_judge_counts_every_kind_of_error(void **state)
{
    (void)state;
    const octree_point points[] = {{{0, 0, 0}, 0}, {{1, 0, 0}, 1}, {{3, 0, 0}, 2}, {{4, 0, 0}, 3}};
    octree_query query = {.kind = OCTREE_QUERY_KNEAREST, .k = 2};
    answer_error error = find_answer_error(&query, points, 4, (uint64_t[]){1, 0}, 2, NULL);
    assert_true(is_right(&error));
    error = find_answer_error(&query, points, 4, (uint64_t[]){2, 0}, 2, NULL);
    assert_int_equal(error.missing, 1);
    assert_true(error.ratio == 3);
    error = find_answer_error(&query, points, 4, (uint64_t[]){0, 0}, 2, NULL);
    assert_int_equal(error.unknown, 1);
    assert_int_equal(error.missing, 1);
    query = (octree_query){.kind = OCTREE_QUERY_RADIUS, .radius = 3};
    error = find_answer_error(&query, points, 4, (uint64_t[]){0, 1}, 2, NULL);
    assert_int_equal(error.missing, 1);
    assert_true(error.boundary);
    error = find_answer_error(&query, points, 4, (uint64_t[]){0, 2, 3, 9}, 4, NULL);
    assert_int_equal(error.missing, 1);
    assert_false(error.boundary);
    assert_int_equal(error.extra, 1);
    assert_int_equal(error.unknown, 1);
    const octree_point odd[] = {{{0, 0, 0}, 0}, {{NAN, 0, 0}, 1}, {{INFINITY, 0, 0}, 2}};
    error = find_answer_error(&query, odd, 3, (uint64_t[]){0, 1, 2}, 3, NULL);
    assert_int_equal(error.unknown, 2);
    query = (octree_query){.kind = OCTREE_QUERY_NEAREST};
    error = find_answer_error(&query, odd, 3, (uint64_t[]){1}, 1, NULL);
    assert_int_equal(error.unknown, 1);
    assert_int_equal(error.missing, 1);
    query = (octree_query){.kind = OCTREE_QUERY_RANGE, .box = {{0, 0, 0}, {3, 1, 1}}};
    error = find_answer_error(&query, points, 4, (uint64_t[]){0, 1, 2}, 3, NULL);
    assert_true(is_right(&error));
    assert_int_equal(error.expected, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_index_answers_as_its_library_promises),
        cmocka_unit_test(an_index_that_lacks_points_is_found_faulty),
        cmocka_unit_test(the_judge_counts_every_kind_of_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
