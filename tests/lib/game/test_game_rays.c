/* SPDX-License-Identifier: MIT */
/* test_game_rays.c - queries of the kind "ray": the answer, and the judgement of foreign answers. */
#include "fixture.h"
#include "octree/game.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define PLAYER 5000

/* Along the x axis: two bodies whose faces are at x = 1, a thin plate at 3, a point at 5. Body 9 lies apart. */
static const octree_game_body bodies[] = {{.id = 4, .position = {2, 0, 0}, .half = {1, 1, 1}},
                                          {.id = 2, .position = {1.5, 1, 0}, .half = {0.5, 1, 3}},
                                          {.id = 7, .position = {3, 0, 0}, .half = {0, 2, 2}},
                                          {.id = 1, .position = {5, 0, 0}},
                                          {.id = 9, .position = {0, 6, 0}, .half = {1, 0.5, 0.5}}};

static octree_game *game;

static octree_session make_session(const octree_query *query)
{
    return (octree_session){.tree = define(cube(-10, 10), 2, 6, OCTREE_GROW),
                            .player = {.id = PLAYER, .position = {-4, 0, 0}},
                            .bodies = bodies,
                            .body_count = sizeof bodies / sizeof bodies[0],
                            .queries = query,
                            .query_count = 1};
}

static const octree_answer *ask(const octree_query *query)
{
    const octree_session session = make_session(query);
    octree_game_destroy(game);
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    assert_int_equal(octree_game_tick(game)->answer_count, 1);
    return &octree_game_tick(game)->answers[0];
}

static const octree_answer *judge(octree_query query, const uint64_t *ids, size_t count)
{
    query.answered = true;
    query.answer = ids;
    query.answer_count = count;
    return ask(&query);
}

#define IDS(...) (const uint64_t[]){__VA_ARGS__}, sizeof((const uint64_t[]){__VA_ARGS__}) / sizeof(uint64_t)

static void assert_hits(const octree_query *query, const uint64_t *ids, const double *times, size_t count)
{
    const octree_answer *answer = ask(query);
    assert_int_equal(answer->count, count);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(answer->neighbors[i].point.id, ids[i]);
        assert_true(answer->neighbors[i].distance == times[i]);
    }
}

static const octree_query all = {.kind = OCTREE_QUERY_RAY, .target = {-1, 0, 0}, .direction = {2, 0, 0}, .k = 8};

static void a_ray_hits_bodies_in_the_order_of_their_first_contact(void **state)
{
    static const uint64_t ids[] = {2, 4, 7, 1};
    static const double times[] = {1, 1, 2, 3};
    (void)state;
    octree_query query = all;
    assert_hits(&query, ids, times, 4);
    query.k = 1;
    assert_hits(&query, ids, times, 1);
    query.k = 3;
    assert_hits(&query, ids, times, 3);
}

static void a_ray_ends_after_its_length_and_reaches_its_end(void **state)
{
    static const uint64_t ids[] = {2, 4, 7};
    static const double times[] = {1, 1, 2};
    (void)state;
    octree_query query = all;
    query.length = 2;
    assert_hits(&query, ids, times, 3);
    query.length = nextafter(2, 0);
    assert_hits(&query, ids, times, 2);
    query.length = 0.5;
    assert_hits(&query, ids, times, 0);
}

static void a_thick_ray_hits_what_it_touches(void **state)
{
    static const uint64_t ids[] = {9, 2, 7};
    static const double times[] = {0, 0.5, 2.5};
    octree_query query = {
        .kind = OCTREE_QUERY_RAY, .target = {-1.5, 4, 0}, .direction = {1, 0, 0}, .k = 5, .thickness = 1.5};
    (void)state;
    assert_hits(&query, ids, times, 1); /* bodies 2 and 7 end at y = 2, half a unit below the ray */
    query.thickness = 2;
    assert_hits(&query, ids, times, 3);
}

/* The player is at (-4, 0, 0), a point on the ray. */
static void a_ray_from_the_player_skips_the_player(void **state)
{
    octree_query query = {.kind = OCTREE_QUERY_RAY, .at_player = true, .direction = {1, 0, 0}, .k = 1};
    (void)state;
    const octree_answer *answer = ask(&query);
    assert_true(answer->count == 1 && answer->neighbors[0].point.id == 2 && answer->neighbors[0].distance == 5);
    assert_true(answer->target[0] == -4);
    query = (octree_query){.kind = OCTREE_QUERY_RAY, .target = {-9, 0, 0}, .direction = {1, 0, 0}, .k = 1};
    assert_int_equal(ask(&query)->neighbors[0].point.id, PLAYER);
}

static void invalid_rays_are_refused(void **state)
{
    octree_query query = all;
    (void)state;
    memset(query.direction, 0, sizeof query.direction);
    assert_int_equal(octree_query_check(&query), OCTREE_BAD_SIZE);
    query.direction[2] = NAN;
    assert_int_equal(octree_query_check(&query), OCTREE_NOT_FINITE);
    query.direction[2] = -5e-324;
    assert_int_equal(octree_query_check(&query), OCTREE_OK);
    query.thickness = -1;
    assert_int_equal(octree_query_check(&query), OCTREE_BAD_SIZE);
    query.thickness = 0;
    query.length = INFINITY;
    assert_int_equal(octree_query_check(&query), OCTREE_NOT_FINITE);
}

/* ---- Foreign answers ---------------------------------------------------------------------------------------- */

static void hits_at_one_place_are_right_in_any_order(void **state)
{
    octree_query first = all;
    (void)state;
    first.k = 1;
    assert_int_equal(judge(first, IDS(2))->judgement.wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge(first, IDS(4))->judgement.wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge(all, IDS(4, 2, 7, 1))->judgement.wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge(all, IDS(1, 7, 2, 4))->judgement.wrong, OCTREE_WRONG_NONE);
}

static void a_later_hit_is_farther(void **state)
{
    octree_query first = all;
    (void)state;
    first.k = 1;
    octree_judgement j = judge(first, IDS(7))->judgement;
    assert_true(j.wrong == OCTREE_WRONG_FARTHER && j.rank == 1 && j.ratio == 2 && j.missing_count == 1);
    assert_true(j.extra_count == 1 && j.extra[0].id == 7);
    first.epsilon = 1;
    assert_int_equal(judge(first, IDS(7))->judgement.wrong, OCTREE_WRONG_NONE);
    first.k = 2;
    first.epsilon = 0;
    j = judge(first, IDS(2, 1))->judgement;
    assert_true(j.wrong == OCTREE_WRONG_FARTHER && j.rank == 2 && j.ratio == 3 && j.missing[0].id == 4);
}

static void fewer_hits_are_a_wrong_count(void **state)
{
    (void)state;
    octree_judgement j = judge(all, IDS(2, 4, 1))->judgement;
    assert_true(j.wrong == OCTREE_WRONG_COUNT && j.expected == 4 && j.missing_count == 1 && j.missing[0].id == 7);
    j = judge(all, NULL, 0)->judgement;
    assert_true(j.wrong == OCTREE_WRONG_COUNT && j.rank == 1 && j.missing_count == 4);
    j = judge(all, IDS(2, 4, 9))->judgement;
    assert_true(j.wrong == OCTREE_WRONG_COUNT && j.rank == 3 && j.missing_count == 2 && j.extra[0].id == 9);
}

static void a_body_that_the_ray_misses_is_extra(void **state)
{
    octree_query miss = all;
    (void)state;
    octree_judgement j = judge(all, IDS(9, 2, 4, 7, 1))->judgement;
    assert_true(j.wrong == OCTREE_WRONG_EXTRA && j.rank == 5 && j.extra_count == 1 && j.extra[0].id == 9);
    assert_int_equal(j.missing_count, 0);
    j = judge(all, IDS(2, 4, 7, 9))->judgement; /* in place of a hit */
    assert_true(j.wrong == OCTREE_WRONG_EXTRA && j.rank == 4 && j.missing[0].id == 1 && j.extra[0].id == 9);
    miss.direction[0] = -1;
    j = judge(miss, IDS(9))->judgement; /* the player at (-4, 0, 0) is the only hit */
    assert_true(j.wrong == OCTREE_WRONG_EXTRA && j.extra[0].id == 9 && j.missing[0].id == PLAYER);
    miss.length = 1;
    j = judge(miss, IDS(9, 4))->judgement;
    assert_true(j.wrong == OCTREE_WRONG_EXTRA && j.expected == 0 && j.extra_count == 2 && j.rank == 1);
    assert_int_equal(judge(miss, NULL, 0)->judgement.wrong, OCTREE_WRONG_NONE);
}

/* With floats, the positions, origin, direction and length are rounded before they are compared. */
static void an_index_of_floats_is_judged_by_floats(void **state)
{
    octree_query query = all;
    (void)state;
    query.precision = OCTREE_FLOATS;
    query.length = 1 - 0x1p-40; /* rounds to 1, where bodies 2 and 4 begin */
    assert_int_equal(judge(query, IDS(2, 4))->judgement.wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge(query, NULL, 0)->judgement.wrong, OCTREE_WRONG_COUNT);
    query.precision = OCTREE_DOUBLES;
    assert_int_equal(judge(query, NULL, 0)->judgement.wrong, OCTREE_WRONG_NONE);
    query.precision = OCTREE_FLOATS;
    query.length = 1e-60; /* rounds to 0, but does not become endless */
    assert_int_equal(judge(query, NULL, 0)->judgement.wrong, OCTREE_WRONG_NONE);
    query.length = 0;
    query.direction[0] = 1e-60; /* rounds to 0, but keeps a direction */
    assert_int_equal(judge(query, IDS(2, 4, 7, 1))->judgement.wrong, OCTREE_WRONG_NONE);
}

/* The parameters of these hits are beyond DBL_MAX. */
static void hits_beyond_every_double_are_judged(void **state)
{
    octree_query query = all;
    (void)state;
    query.direction[0] = 5e-324;
    assert_true(isinf(ask(&query)->neighbors[3].distance));
    assert_int_equal(judge(query, IDS(2, 4, 7, 1))->judgement.wrong, OCTREE_WRONG_NONE);
    query.k = 2;
    assert_int_equal(judge(query, IDS(4, 2))->judgement.wrong, OCTREE_WRONG_NONE);
    assert_int_equal(judge(query, IDS(4, 7))->judgement.wrong, OCTREE_WRONG_FARTHER);
    query.k = 5;
    assert_int_equal(judge(query, IDS(2, 4, 7, 1, 9))->judgement.wrong, OCTREE_WRONG_EXTRA);
}

/* A query that pruned the only node with a hit is wrong; one that pruned a body which the ray misses is not. */
static void a_node_with_a_hit_must_not_be_pruned(void **state)
{
    static const uint64_t near[] = {1, 2, 4, 7}, far[] = {9}, ids[] = {1, 2};
    const octree_foreign_node nodes[] = {
        {.id = 1, .box = {{-9, -9, -9}, {9, 9, 9}}, .has_points = true, .points = {near, 4}},
        {.id = 2, .box = {{-9, -9, -9}, {9, 9, 9}}, .has_points = true, .points = {far, 1}}};
    const octree_foreign_tree tree = {.nodes = nodes, .node_count = 2};
    (void)state;
    for (int pruned = 0; pruned < 2; pruned++) {
        octree_query query = all;
        query.visits[OCTREE_NODE_PRUNED] = (octree_ids){&ids[pruned], 1};
        octree_session session = make_session(&query);
        session.foreign = &tree;
        session.foreign_count = 1;
        octree_game_destroy(game);
        assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
        assert_int_equal(octree_game_tick(game)->foreign.wrong[OCTREE_NODE_PRUNED_POINT], pruned == 0 ? 1 : 0);
    }
}

static int destroy_game(void **state)
{
    (void)state;
    octree_game_destroy(game);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_hits_bodies_in_the_order_of_their_first_contact),
        cmocka_unit_test(a_ray_ends_after_its_length_and_reaches_its_end),
        cmocka_unit_test(a_thick_ray_hits_what_it_touches),
        cmocka_unit_test(a_ray_from_the_player_skips_the_player),
        cmocka_unit_test(invalid_rays_are_refused),
        cmocka_unit_test(hits_at_one_place_are_right_in_any_order),
        cmocka_unit_test(a_later_hit_is_farther),
        cmocka_unit_test(fewer_hits_are_a_wrong_count),
        cmocka_unit_test(a_body_that_the_ray_misses_is_extra),
        cmocka_unit_test(an_index_of_floats_is_judged_by_floats),
        cmocka_unit_test(hits_beyond_every_double_are_judged),
        cmocka_unit_test(a_node_with_a_hit_must_not_be_pruned),
    };
    return cmocka_run_group_tests(tests, NULL, destroy_game);
}
