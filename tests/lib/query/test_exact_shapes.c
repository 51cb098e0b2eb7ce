/* SPDX-License-Identifier: MIT */
/* test_exact_shapes.c - for the same contents, leaf capacity and depth never change an answer: every capacity from 1 to
 * 64 at every depth from 0 to 21 says what a scan says that decides by whole numbers.
 *
 * It is built twice, the second time with the library's portable path; with --costs it prints a digest of what all its
 * queries cost, which must be the same of both.
 */
#include "fixture.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "exact_oracle.h"
#include "octree/digest.h"
#include "octree/sample.h"

enum { POINTS = 190, CAPACITIES = 64, QUESTIONS = 42 };

typedef enum kind { NEAREST, NEAREST_K, WITHIN, RADIUS, RANGE, COLLIDE, SWEPT, KINDS } kind;

static const char *const names[KINDS] = {"nearest", "nearest_k", "nearest_within", "radius",
                                         "range",   "collide",   "collide_swept"};

/* One query. `length` is a radius, or the size of the box about `at`. */
typedef struct question {
    kind kind;
    double at[3], to[3], length;
    size_t k;
    octree_search how;
} question;

/* In order for neighbours; for sets sorted, since they have no order. */
typedef struct answer {
    octree_point points[POINTS];
    size_t count;
} answer;

static bool add(const octree_point *point, void *context)
{
    answer *a = context;
    assert_true(a->count < POINTS);
    a->points[a->count++] = *point;
    return true;
}

static octree_box box_about(const question *q)
{
    octree_box box;
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = q->at[axis] - q->length;
        box.max[axis] = q->at[axis] + q->length;
    }
    return box;
}

static void ask_neighbors(const octree *tree, const question *q, answer *a)
{
    octree_neighbor found[POINTS];
    octree_status status = OCTREE_OK;
    if (q->kind == NEAREST && q->how.cost == NULL)
        status = octree_nearest(tree, q->at, q->how.skip, q->how.skip_id, found);
    else if (q->kind == NEAREST)
        status = octree_nearest_within(tree, q->at, DBL_MAX, &q->how, found);
    else if (q->kind == WITHIN)
        status = octree_nearest_within(tree, q->at, q->length, &q->how, found);
    else
        assert_int_equal(octree_nearest_k(tree, q->at, q->k, &q->how, found, &a->count), OCTREE_OK);
    if (q->kind != NEAREST_K)
        a->count = status == OCTREE_OK;
    for (size_t i = 0; i < a->count; i++)
        a->points[i] = found[i].point;
}

/* What a tree says. */
static void ask(const octree *tree, const question *q, answer *a)
{
    const octree_box box = box_about(q);
    a->count = 0;
    if (q->kind == RADIUS)
        assert_int_equal(octree_radius(tree, q->at, q->length, &q->how, add, a), OCTREE_OK);
    else if (q->kind == RANGE)
        assert_int_equal(octree_range_search(tree, &box, &q->how, add, a), OCTREE_OK);
    else if (q->kind == COLLIDE)
        assert_int_equal(octree_collide(tree, q->at, q->length, NULL, add, a), OCTREE_OK);
    else if (q->kind == SWEPT)
        assert_int_equal(octree_collide_swept(tree, q->at, q->to, q->length, NULL, NULL, add, a), OCTREE_OK);
    else
        ask_neighbors(tree, q, a);
    if (q->kind >= RADIUS)
        qsort(a->points, a->count, sizeof a->points[0], octree_compare_points);
}

static bool belongs(const question *q, const double p[3])
{
    const octree_box box = box_about(q);
    switch (q->kind) {
    case RADIUS:
        return exact_compare_radius(q->at, p, q->length, 0) <= 0;
    case RANGE:
        return box_holds(&box, p);
    case COLLIDE:
        return exact_within(q->at[0], q->length, p[0]) && exact_within(q->at[1], q->length, p[1]) &&
               exact_within(q->at[2], q->length, p[2]);
    default:
        return exact_touches(q->at, q->to, q->length, p, p, NULL);
    }
}

/* What a scan says. */
static void scan(const brute *all, const question *q, answer *a)
{
    a->count = 0;
    if (q->kind < RADIUS) {
        const size_t count =
            exact_nearest_sorted(all->points, all->count, q->at, q->how.skip, q->how.skip_id, a->points);
        a->count = q->kind == NEAREST_K ? (q->k < count ? q->k : count) : count > 0;
        if (q->kind == WITHIN && count > 0 && exact_compare_radius(q->at, a->points[0].position, q->length, 0) > 0)
            a->count = 0;
        return;
    }
    for (size_t i = 0; i < all->count; i++)
        if (belongs(q, all->points[i].position))
            add(&all->points[i], a);
    qsort(a->points, a->count, sizeof a->points[0], octree_compare_points);
}

static void put(brute *all, const double at[3])
{
    brute_insert(all, at, all->count % 150); /* some ids lie at two places */
}

/* More equal points than the largest leaf holds, points ever nearer to a corner down to the deepest cells, a lattice,
 * and near ties about a place. */
static void fill(brute *all, const double focus[3], uint64_t *random)
{
    const octree_box world = cube(-1, 1);
    const double offset[3] = {0.3, 0.1, 0.2};
    brute_sample(all, OCTREE_SAMPLE_LATTICE, 0, &world, 27);
    while (all->count < 27 + 66)
        put(all, (double[3]){0.4, 0.4, 0.4});
    for (int i = 0; i < 44; i++) {
        const double reach = ldexp(1, -i / 2);
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = -1 + reach * octree_random_unit(random);
        put(all, at);
    }
    while (all->count < POINTS) {
        double at[3];
        for (int axis = 0; axis < 3; axis++) {
            at[axis] = focus[axis] + (random_below(random, 2) == 0 ? offset[axis] : -offset[axis]);
            const uint64_t nudge = random_below(random, 4);
            at[axis] = nudge == 0 ? next_up(at[axis]) : nudge == 1 ? next_down(at[axis]) : at[axis];
        }
        put(all, at);
    }
}

/* The length to some point: a radius that ends there, or the half of a box. */
static double length_to(const brute *all, const question *q, uint64_t *random)
{
    const double *p = all->points[random_below(random, all->count)].position;
    double sum = 0;
    if (q->kind != RADIUS && q->kind != WITHIN)
        return fabs(p[0] - q->at[0]);
    for (int axis = 0; axis < 3; axis++)
        sum += (p[axis] - q->at[axis]) * (p[axis] - q->at[axis]);
    return sqrt(sum);
}

static void think_of_questions(const brute *all, const double focus[3], question *questions, uint64_t *random)
{
    const size_t counts[] = {1, 3, 8, 40};
    for (size_t i = 0; i < QUESTIONS; i++) {
        question *q = &questions[i];
        *q = (question){.kind = (kind)(i % KINDS), .k = counts[random_below(random, 4)]};
        q->how.skip = (octree_skip)random_below(random, 3);
        const octree_point *p = &all->points[random_below(random, all->count)];
        q->how.skip_id = p->id;
        for (int axis = 0; axis < 3; axis++) {
            const double places[] = {focus[axis], p->position[axis], random_between(random, -1.5, 1.5)};
            q->at[axis] = places[i / KINDS % 3];
            q->to[axis] = random_between(random, -1.5, 1.5);
        }
        q->length = length_to(all, q, random);
    }
}

static octree *tree_of(const brute *all, size_t capacity, size_t depth)
{
    octree *tree = make_tree(cube(-1, 1), capacity, depth, OCTREE_GROW);
    size_t inserted;
    assert_int_equal(octree_insert_many(tree, all->points, all->count, NULL, &inserted), OCTREE_OK);
    assert_int_equal(inserted, all->count);
    return tree;
}

/* The points, the questions, and the true answers. */
typedef struct examination {
    brute all;
    question questions[QUESTIONS];
    answer truths[QUESTIONS];
} examination;

static void prepare(examination *e)
{
    const double focus[3] = {0.1, 0.2, 0.3};
    uint64_t random = 17;
    e->all = (brute){0};
    fill(&e->all, focus, &random);
    think_of_questions(&e->all, focus, e->questions, &random);
    for (size_t i = 0; i < QUESTIONS; i++)
        scan(&e->all, &e->questions[i], &e->truths[i]);
}

static bool is_true(const answer *said, const answer *truth)
{
    return said->count == truth->count &&
           memcmp(said->points, truth->points, said->count * sizeof said->points[0]) == 0;
}

static void examine(const examination *e, const octree *tree, size_t capacity, size_t depth)
{
    static answer said;
    for (size_t i = 0; i < QUESTIONS; i++) {
        ask(tree, &e->questions[i], &said);
        if (!is_true(&said, &e->truths[i]))
            fail_msg("capacity %zu, depth %zu: number %zu, %s, gives another answer", capacity, depth, i,
                     names[e->questions[i].kind]);
    }
}

static void every_capacity_and_depth_gives_the_true_answers(void **state)
{
    (void)state;
    static examination e;
    prepare(&e);
    for (size_t capacity = 1; capacity <= CAPACITIES; capacity++)
        for (size_t depth = 0; depth <= OCTREE_MAX_DEPTH; depth++) {
            octree *tree = tree_of(&e.all, capacity, depth);
            octree_stats stats;
            assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
            assert_int_equal(stats.depth, depth); /* the equal points: no two depths are one shape */
            examine(&e, tree, capacity, depth);
            octree_destroy(tree);
        }
    brute_free(&e.all);
}

static void every_kind_of_question_has_points_in_its_answers(void **state)
{
    (void)state;
    static examination e;
    size_t found[KINDS] = {0};
    prepare(&e);
    for (size_t i = 0; i < QUESTIONS; i++)
        found[e.questions[i].kind] += e.truths[i].count > 0;
    for (int i = 0; i < KINDS; i++)
        assert_true(found[i] >= 3);
    brute_free(&e.all);
}

/* A digest of what the questions cost that can be asked with a report, of every fifth shape. */
static void print_costs(void)
{
    static examination e;
    static answer said;
    uint64_t digest = OCTREE_DIGEST_START;
    prepare(&e);
    for (size_t shape = 0; shape < CAPACITIES * (OCTREE_MAX_DEPTH + 1); shape += 5) {
        octree *tree = tree_of(&e.all, 1 + shape % CAPACITIES, shape / CAPACITIES);
        for (size_t i = 0; i < QUESTIONS; i++) {
            octree_cost cost = {0};
            question q = e.questions[i];
            q.how.cost = &cost;
            ask(tree, &q, &said);
            digest = octree_digest_word(octree_digest_word(digest, cost.nodes), cost.leaves);
            digest = octree_digest_word(octree_digest_word(digest, cost.points), cost.pruned);
        }
        octree_destroy(tree);
    }
    brute_free(&e.all);
    printf("%016" PRIx64 "\n", digest);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_capacity_and_depth_gives_the_true_answers),
        cmocka_unit_test(every_kind_of_question_has_points_in_its_answers),
    };
    if (argc == 2 && strcmp(argv[1], "--costs") == 0) {
        print_costs();
        return 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
