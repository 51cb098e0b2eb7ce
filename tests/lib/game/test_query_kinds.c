/* SPDX-License-Identifier: MIT */
/* test_query_kinds.c - rules that hold for every kind of query, by the tables of octree/query.h. A new kind needs no
 * line here: its members are filled by their types, and the judge must accept its exact answer and refuse every other
 * one.
 */
#include "fixture.h"
#include "octree/game.h"

#include <string.h>

#define POINTS 40
#define QUERIES 50

static octree_game_body bodies[POINTS];

static double coordinate(uint64_t *random)
{
    return 20 * octree_random_unit(random) - 10;
}

static void fill_frustum(octree_frustum *frustum, uint64_t *random)
{
    frustum->count = 1 + (size_t)(octree_random(random) % OCTREE_FRUSTUM_HALF_SPACES);
    for (size_t i = 0; i < frustum->count; i++) {
        octree_half_space *space = &frustum->half_spaces[i];
        for (int k = 0; k < 3; k++)
            space->normal[k] = coordinate(random);
        space->offset = 8 * coordinate(random) + 50;
    }
}

/* Fill every member of a query with a random value that its type allows. */
static octree_query random_query(octree_query_kind kind, uint64_t *random)
{
    octree_query query = {.kind = kind};
    for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++) {
        const octree_query_member_traits *member = octree_query_member_at(i);
        char *value = (char *)&query + member->in_query;
        double numbers[6];
        for (int j = 0; j < 3; j++) {
            numbers[j] = coordinate(random);
            numbers[j + 3] = numbers[j] + 10 * octree_random_unit(random);
        }
        const double length = 8 * octree_random_unit(random);
        const size_t count = 1 + (size_t)(octree_random(random) % POINTS);
        switch (member->type) {
        case OCTREE_MEMBER_BOX:
            memcpy(value, numbers, sizeof(octree_box));
            break;
        case OCTREE_MEMBER_POSITION:
        case OCTREE_MEMBER_DIRECTION:
            memcpy(value, numbers, sizeof(double[3]));
            break;
        case OCTREE_MEMBER_COUNT:
            memcpy(value, &count, sizeof count);
            break;
        case OCTREE_MEMBER_LENGTH:
            memcpy(value, &length, sizeof length);
            break;
        case OCTREE_MEMBER_EXTENTS:
            for (int j = 0; j < 3; j++)
                ((double *)value)[j] = length / (j + 1);
            break;
        case OCTREE_MEMBER_FRUSTUM:
            fill_frustum((octree_frustum *)value, random);
            break;
        case OCTREE_MEMBER_BOUNDS:
            *(octree_bounds *)value = (octree_bounds)(octree_random(random) % OCTREE_BOUNDS_KINDS);
            break;
        }
    }
    return query;
}

/* How the judge calls an answer to a query. */
static octree_wrong_kind judged(octree_query query, const uint64_t *ids, size_t count, octree_precision precision)
{
    octree_game *game;
    octree_session session = {.tree = octree_def_default(),
                              .player.kind = OCTREE_PLAYER_NONE,
                              .bodies = bodies,
                              .body_count = POINTS,
                              .queries = &query,
                              .query_count = 1};
    query.answered = true;
    query.answer = ids;
    query.answer_count = count;
    query.precision = precision;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    assert_int_equal(octree_game_tick(game)->answer_count, 1);
    const octree_wrong_kind wrong = octree_game_tick(game)->answers[0].judgement.wrong;
    octree_game_destroy(game);
    return wrong;
}

static void assert_bound_contains(const octree_answer *answer)
{
    octree_box bound;
    assert_int_equal(octree_answer_bound(answer, &bound), !octree_query_about(answer->kind)->neighbors);
    for (size_t i = 0; answer->points && i < answer->count; i++)
        for (int j = 0; j < 3; j++)
            assert_true(bound.min[j] <= answer->points[i].position[j] && answer->points[i].position[j] <= bound.max[j]);
}

/* Ask a query. Returns the number of ids in its answer. */
static size_t ask(const octree *tree, const octree_query *query, uint64_t ids[POINTS + 1])
{
    octree_answer answer;
    assert_int_equal(octree_query_answer(tree, query, NULL, NULL, &answer), OCTREE_OK);
    const size_t count = answer.count;
    for (size_t i = 0; i < count; i++)
        ids[i] = answer.points ? answer.points[i].id : answer.neighbors[i].point.id;
    assert_bound_contains(&answer);
    octree_answer_release(tree, &answer);
    return count;
}

/* An id that is not among the given ones. */
static uint64_t other_id(const uint64_t *ids, size_t count)
{
    for (uint64_t id = 0;; id++) {
        bool used = false;
        for (size_t i = 0; i < count; i++)
            used |= ids[i] == id;
        if (!used)
            return id;
    }
}

/* The error of an answer with one more point: a ray or box hits it later, or never; all other points are neighbours. */
static octree_wrong_kind expect_of_other(const octree *tree, octree_query query, uint64_t other)
{
    uint64_t ids[POINTS + 1];
    if (!octree_query_about(query.kind)->neighbors)
        return OCTREE_WRONG_EXTRA;
    if (!(octree_query_about(query.kind)->members & (OCTREE_QUERY_HAS_DIRECTION | OCTREE_QUERY_HAS_TO)))
        return OCTREE_WRONG_COUNT;
    query.k = POINTS;
    const size_t count = ask(tree, &query, ids);
    for (size_t i = 0; i < count; i++)
        if (ids[i] == other)
            return OCTREE_WRONG_COUNT;
    return OCTREE_WRONG_EXTRA;
}

static void assert_judged(const octree *tree, const octree_query *query)
{
    const bool neighbors = octree_query_about(query->kind)->neighbors;
    uint64_t ids[POINTS + 1];
    const size_t count = ask(tree, query, ids);
    assert_int_equal(judged(*query, ids, count, OCTREE_DOUBLES), OCTREE_WRONG_NONE);
    assert_int_equal(judged(*query, ids, count, OCTREE_FLOATS), OCTREE_WRONG_NONE);
    if (count > 0)
        assert_int_equal(judged(*query, ids, count - 1, OCTREE_DOUBLES),
                         neighbors ? OCTREE_WRONG_COUNT : OCTREE_WRONG_MISSING);
    if (count == POINTS)
        return;
    ids[count] = other_id(ids, count);
    const octree_wrong_kind expected = expect_of_other(tree, *query, ids[count]);
    assert_int_equal(judged(*query, ids, count + 1, OCTREE_DOUBLES), expected);
    assert_int_equal(judged(*query, ids, count + 1, OCTREE_FLOATS), expected);
}

static void judge_accepts_only_the_exact_answer_of_every_kind(void **state)
{
    uint64_t random = 7;
    octree *tree;
    (void)state;
    octree_def def = octree_def_default();
    assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
    for (size_t i = 0; i < POINTS; i++) {
        bodies[i] =
            (octree_game_body){.id = i, .position = {coordinate(&random), coordinate(&random), coordinate(&random)}};
        assert_int_equal(octree_insert(tree, bodies[i].position, i), OCTREE_OK);
    }
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++)
        for (int i = 0; i < QUERIES; i++) {
            const octree_query query = random_query((octree_query_kind)kind, &random);
            assert_int_equal(octree_query_check(&query), OCTREE_OK);
            assert_judged(tree, &query);
        }
    octree_destroy(tree);
}

static void every_kind_reads_the_member_that_bears_its_name(void **state)
{
    (void)state;
    assert_null(octree_query_about(OCTREE_QUERY_KINDS));
    assert_null(octree_query_member_at(OCTREE_QUERY_MEMBERS));
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        const octree_query_traits *about = octree_query_about((octree_query_kind)kind);
        assert_true(about->members & about->named_by);
        assert_true(*about->name && *about->words && *about->region);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(judge_accepts_only_the_exact_answer_of_every_kind),
        cmocka_unit_test(every_kind_reads_the_member_that_bears_its_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
