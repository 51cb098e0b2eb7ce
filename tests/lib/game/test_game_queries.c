/* SPDX-License-Identifier: MIT */
/* The table of query kinds, and asking a tree outside of a game. */
#include "counting_allocator.h"
#include "fixture.h"
#include "game_fixture.h"

#include <math.h>
#include <string.h>

/* A query of this kind that finds some points of small worlds. */
static octree_query query_of(int kind, bool at_player)
{
    return (octree_query){.tick = OCTREE_EVERY_TICK,
                          .kind = (octree_query_kind)kind,
                          .at_player = at_player,
                          .box = {{-4, -5, -6}, {3, 4, 6}},
                          .target = {1, -1, 0.5},
                          .k = 7,
                          .radius = 5.5,
                          .direction = {-1, 1, 0.5},
                          .thickness = 4,
                          .to = {-6, 4, 3},
                          .half = {3, 4, 5},
                          .frustum = {{{{1, 0.5, 0}, 5}, {{-1, 0, 0.25}, 6}, {{0, 0, 1}, 7}}, 3}};
}

static void every_kind_has_traits_and_no_other(void **state)
{
    (void)state;
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        const octree_query_traits *about = octree_query_about((octree_query_kind)kind);
        assert_non_null(about);
        assert_true(about->name && about->name[0] && about->words && about->words[0]);
        assert_ptr_equal(octree_query_name((octree_query_kind)kind), about->name);
        assert_true(about->named_by && (about->named_by & (about->named_by - 1)) == 0);
        assert_true(about->members & about->named_by);
        for (int other = 0; other < kind; other++)
            assert_string_not_equal(about->name, octree_query_name((octree_query_kind)other));
    }
    assert_null(octree_query_about(OCTREE_QUERY_KINDS));
    assert_null(octree_query_about((octree_query_kind)-1));
    assert_null(octree_query_name(OCTREE_QUERY_KINDS));
}

static void the_names_in_files_stay(void **state)
{
    (void)state;
    assert_string_equal(octree_query_name(OCTREE_QUERY_RANGE), "range");
    assert_string_equal(octree_query_name(OCTREE_QUERY_NEAREST), "nearest");
    assert_string_equal(octree_query_name(OCTREE_QUERY_KNEAREST), "knearest");
    assert_string_equal(octree_query_name(OCTREE_QUERY_RADIUS), "radius");
    assert_string_equal(octree_query_name(OCTREE_QUERY_RAY), "ray");
    assert_string_equal(octree_query_name(OCTREE_QUERY_FRUSTUM), "frustum");
    assert_string_equal(octree_query_name(OCTREE_QUERY_SWEEP), "sweep");
}

static void assert_same_answers(const octree_answer *a, const octree_answer *b)
{
    assert_true(a->kind == b->kind && a->k == b->k && a->count == b->count && a->count > 0);
    assert_memory_equal(&a->cost, &b->cost, sizeof a->cost);
    assert_memory_equal(&a->box, &b->box, sizeof a->box);
    assert_memory_equal(a->target, b->target, sizeof a->target);
    assert_true((a->points != NULL) == (b->points != NULL) && (a->neighbors != NULL) == (b->neighbors != NULL));
    assert_true((a->neighbors != NULL) == octree_query_about(a->kind)->neighbors);
    if (a->points)
        assert_memory_equal(a->points, b->points, a->count * sizeof *a->points);
    if (a->neighbors)
        assert_memory_equal(a->neighbors, b->neighbors, a->count * sizeof *a->neighbors);
}

/* Thirty bodies about the player of game_fixture.h. */
static void scatter(octree_game_body bodies[30])
{
    uint64_t random = 3;
    for (uint64_t i = 0; i < 30; i++) {
        bodies[i] = (octree_game_body){.id = i};
        for (int axis = 0; axis < 3; axis++)
            bodies[i].position[axis] = random_between(&random, -9, 9);
    }
}

static void every_kind_is_answered_outside_a_game_as_in_one(void **state)
{
    (void)state;
    octree_game_body bodies[30];
    octree_query queries[2 * OCTREE_QUERY_KINDS];
    scatter(bodies);
    for (int i = 0; i < 2 * OCTREE_QUERY_KINDS; i++)
        queries[i] = query_of(i / 2, i % 2);
    octree_session session = small_session(bodies, 30);
    session.tree.full_leaf = OCTREE_GROW;
    session.queries = queries;
    session.query_count = 2 * OCTREE_QUERY_KINDS;
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->answer_count, session.query_count);
    for (size_t i = 0; i < session.query_count; i++) {
        const octree_search how = {.skip = queries[i].at_player ? OCTREE_SKIP_ID : OCTREE_SKIP_NONE,
                                   .skip_id = session.player.id};
        octree_answer answer;
        assert_int_equal(octree_query_answer(octree_game_tree(game), &queries[i], tick->player, &how, &answer),
                         OCTREE_OK);
        assert_same_answers(&answer, &tick->answers[i]);
        octree_answer_release(octree_game_tree(game), &answer);
    }
    octree_game_destroy(game);
}

/* ---- What is left out, and how near to the truth it is ------------------------------------------------------- */

static bool skips(const octree_query *query, const octree_point *point)
{
    return query->skip == OCTREE_SKIP_ID ? point->id == query->skip_id
                                         : query->skip && same_position(point->position, query->target);
}

static const octree_point *point_of(const octree_answer *answer, size_t i)
{
    return answer->points ? &answer->points[i] : &answer->neighbors[i].point;
}

/* `full` has one more than is asked for, where a number is. */
static void assert_left_out(const octree_query *query, const octree_answer *full, const octree_answer *left)
{
    size_t kept = 0, skipped = 0;
    for (size_t i = 0; i < full->count; i++) {
        if (skips(query, point_of(full, i)))
            skipped++;
        else if (kept < left->count)
            assert_memory_equal(point_of(full, i), point_of(left, kept++), sizeof(octree_point));
    }
    assert_int_equal(skipped, 1);
    assert_int_equal(kept, left->count);
    assert_true(left->skip == query->skip && left->skip_id == query->skip_id && left->count + 1 == full->count);
}

/* A tree of scattered points, one of them at the place that the queries name. */
static octree *scattered_tree(void)
{
    octree_game_body bodies[30];
    octree *tree = make_tree(cube(-10, 10), 2, 8, OCTREE_GROW);
    scatter(bodies);
    memcpy(bodies[11].position, (const double[3]){1, -1, 0.5}, sizeof bodies[11].position);
    for (int i = 0; i < 30; i++)
        assert_int_equal(octree_insert(tree, bodies[i].position, bodies[i].id), OCTREE_OK);
    return tree;
}

static void a_query_of_any_kind_leaves_out_what_it_skips(void **state)
{
    (void)state;
    octree *tree = scattered_tree();
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        octree_query query = query_of(kind, false), more = query;
        octree_answer full, left;
        if (kind == OCTREE_QUERY_NEAREST) {
            more.kind = OCTREE_QUERY_KNEAREST;
            more.k = 1;
        }
        more.k++;
        assert_int_equal(octree_query_answer(tree, &more, NULL, NULL, &full), OCTREE_OK);
        query.skip = OCTREE_SKIP_ID;
        query.skip_id = point_of(&full, 0)->id;
        assert_int_equal(octree_query_answer(tree, &query, NULL, NULL, &left), OCTREE_OK);
        assert_left_out(&query, &full, &left);
        octree_answer_release(tree, &left);
        query.skip = OCTREE_SKIP_COINCIDENT;
        if (octree_query_check(&query) == OCTREE_OK) {
            assert_int_equal(octree_query_answer(tree, &query, NULL, NULL, &left), OCTREE_OK);
            assert_left_out(&query, &full, &left);
            octree_answer_release(tree, &left);
        }
        octree_answer_release(tree, &full);
    }
    octree_destroy(tree);
}

/* The program's own answer, of octree.h, and that of a query in a game. */
static void a_query_with_a_skip_and_an_epsilon_is_answered_as_the_library_does(void **state)
{
    (void)state;
    octree_game_body bodies[30];
    scatter(bodies);
    const octree_query queries[] = {
        {.kind = OCTREE_QUERY_KNEAREST,
         .target = {1, 2, 3},
         .k = 5,
         .skip = OCTREE_SKIP_ID,
         .skip_id = 4,
         .epsilon = 0.75},
        {.kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = 5, .skip = OCTREE_SKIP_COINCIDENT, .epsilon = 2},
        {.kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = 5, .skip = OCTREE_SKIP_ID, .skip_id = 9},
    };
    octree_session session = small_session(bodies, 30);
    session.tree.full_leaf = OCTREE_GROW;
    session.queries = queries;
    session.query_count = 3;
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->answer_count, 3);
    for (int i = 0; i < 3; i++) {
        const octree_answer *answer = &tick->answers[i];
        octree_cost cost = {0};
        octree_neighbor near[5];
        size_t count;
        const octree_search how = {
            .skip = queries[i].skip, .skip_id = queries[i].skip_id, .epsilon = queries[i].epsilon, .cost = &cost};
        assert_int_equal(octree_nearest_k(octree_game_tree(game), answer->target, 5, &how, near, &count), OCTREE_OK);
        assert_int_equal(answer->count, count);
        assert_memory_equal(answer->neighbors, near, sizeof near);
        assert_memory_equal(&answer->cost, &cost, sizeof cost);
        assert_true(answer->epsilon == queries[i].epsilon);
    }
    /* Another skip than the player's finds the player, at no distance. */
    assert_true(tick->answers[2].neighbors[0].point.id == session.player.id);
    octree_game_destroy(game);
}

static void a_skip_or_epsilon_that_cannot_be_is_refused(void **state)
{
    (void)state;
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        octree_query query = query_of(kind, true);
        query.skip = (octree_skip)(OCTREE_SKIP_COINCIDENT + 1);
        assert_int_equal(octree_query_check(&query), OCTREE_BAD_OPTION);
        query.skip = OCTREE_SKIP_COINCIDENT;
        const bool has_target = octree_query_about(query.kind)->members & OCTREE_QUERY_HAS_TARGET;
        assert_int_equal(octree_query_check(&query), has_target ? OCTREE_OK : OCTREE_BAD_OPTION);
        query.skip = OCTREE_SKIP_ID;
        assert_int_equal(octree_query_check(&query), OCTREE_OK);
        query.epsilon = -1;
        assert_int_equal(octree_query_check(&query), OCTREE_BAD_SIZE);
        query.epsilon = NAN;
        assert_int_equal(octree_query_check(&query), OCTREE_NOT_FINITE);
    }
}

static octree *counted_tree(counting_allocator *counts)
{
    octree *tree = make_counted_tree(counts, cube(-10, 10), 2, 8, OCTREE_GROW);
    octree_game_body bodies[30];
    scatter(bodies);
    for (int i = 0; i < 30; i++)
        assert_int_equal(octree_insert(tree, bodies[i].position, bodies[i].id), OCTREE_OK);
    return tree;
}

static void an_answer_survives_the_failure_of_each_allocation(void **state)
{
    (void)state;
    counting_allocator counts = {0};
    octree *tree = counted_tree(&counts);
    const size_t before = counts.bytes;
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        const octree_query query = query_of(kind, false);
        octree_status status = OCTREE_NO_MEMORY;
        for (size_t n = 0; status != OCTREE_OK; n++) {
            octree_answer answer;
            counting_allocator_fail_at(&counts, n);
            status = octree_query_answer(tree, &query, NULL, NULL, &answer);
            assert_true(status == OCTREE_OK || status == OCTREE_NO_MEMORY);
            assert_true((answer.count > 0) == (status == OCTREE_OK));
            octree_answer_release(tree, &answer);
            assert_int_equal(counts.bytes, before);
            assert_int_equal(counts.wrong, 0);
        }
    }
    octree_destroy(tree);
    assert_all_returned(&counts);
}

static void answer_refuses_what_cannot_be_asked(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-10, 10), 2, 8, OCTREE_GROW);
    octree_query query = query_of(OCTREE_QUERY_RANGE, true);
    octree_answer answer = {.count = 1};
    assert_int_equal(octree_query_answer(tree, &query, NULL, NULL, &answer), OCTREE_NULL_ARGUMENT);
    assert_true(answer.count == 0 && !answer.points && !answer.neighbors);
    query.at_player = false;
    assert_int_equal(octree_query_answer(tree, &query, NULL, NULL, &answer), OCTREE_OK);
    assert_int_equal(octree_query_answer(tree, &query, NULL, NULL, NULL), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_query_answer(NULL, &query, NULL, NULL, &answer), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_query_answer(tree, NULL, NULL, NULL, &answer), OCTREE_NULL_ARGUMENT);
    assert_int_equal(octree_query_answer(tree, &query, NULL, &(octree_search){.epsilon = -1}, &answer),
                     OCTREE_BAD_SIZE);
    query.kind = OCTREE_QUERY_KINDS;
    assert_int_equal(octree_query_answer(tree, &query, NULL, NULL, &answer), OCTREE_BAD_OPTION);
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_has_traits_and_no_other),
        cmocka_unit_test(the_names_in_files_stay),
        cmocka_unit_test(every_kind_is_answered_outside_a_game_as_in_one),
        cmocka_unit_test(a_query_of_any_kind_leaves_out_what_it_skips),
        cmocka_unit_test(a_query_with_a_skip_and_an_epsilon_is_answered_as_the_library_does),
        cmocka_unit_test(a_skip_or_epsilon_that_cannot_be_is_refused),
        cmocka_unit_test(an_answer_survives_the_failure_of_each_allocation),
        cmocka_unit_test(answer_refuses_what_cannot_be_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
