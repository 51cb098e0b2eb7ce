/* SPDX-License-Identifier: MIT */
/* test_exact_game_extent.c - games whose bodies are boxes, against rational numbers (GMP): hits, answers and pairs of
 * random games at every scale of doubles. test_exact_game_sweep.c has swept collisions. */
#include "fixture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body_oracle.h"
#include "body_scenes.h"
#include "game_fixture.h"

enum { BODIES = 60, TICKS = 8, EDITS = 6, QUERIES = 5, PLAYER = 1000 };

/* A game and the bodies that it should have. */
typedef struct scene {
    scene_numbers numbers;
    uint64_t seed;
    octree_body bodies[BODIES];
    size_t count;
    octree_query queries[QUERIES];
    octree_half_space unused[OCTREE_MAX_HALF_SPACES];
    octree_session session;
    octree_game_body initial[BODIES];
    octree_game *game;
} scene;

static octree_game_body to_game_body(const octree_body *body)
{
    octree_game_body made = {.id = body->id};
    memcpy(made.position, body->position, sizeof made.position);
    memcpy(made.half, body->half, sizeof made.half);
    return made;
}

/* ---- What should be --------------------------------------------------------------------------------------- */

static bool is_in_answer(const octree_answer *answer, uint64_t id)
{
    for (size_t i = 0; i < answer->count; i++)
        if (octree_query_about(answer->kind)->neighbors ? answer->neighbors[i].point.id == id
                                                        : answer->points[i].id == id)
            return true;
    return false;
}

static octree_region region_of(const octree_answer *answer)
{
    static const octree_region_kind kinds[OCTREE_QUERY_KINDS] = {[OCTREE_QUERY_RANGE] = OCTREE_REGION_BOX,
                                                                 [OCTREE_QUERY_RADIUS] = OCTREE_REGION_BALL,
                                                                 [OCTREE_QUERY_FRUSTUM] = OCTREE_REGION_HALF_SPACES};
    octree_region region = {.kind = kinds[answer->kind],
                            .box = answer->box,
                            .radius = answer->radius,
                            .half_spaces = answer->frustum.half_spaces,
                            .half_space_count = answer->frustum.count};
    memcpy(region.center, answer->target, sizeof region.center);
    return region;
}

/* The player is a body without extent. */
static octree_body player_of(const octree_tick *tick)
{
    octree_body player = {.id = PLAYER};
    memcpy(player.position, tick->player, sizeof player.position);
    return player;
}

static void assert_region_answer(const scene *s, const octree_tick *tick, const octree_answer *answer)
{
    const octree_region region = region_of(answer);
    const octree_body player = player_of(tick);
    size_t expected = oracle_matches(&region, &player);
    assert_true(is_in_answer(answer, PLAYER) == oracle_matches(&region, &player));
    for (size_t i = 0; i < s->count; i++) {
        const bool matches = oracle_matches(&region, &s->bodies[i]);
        assert_true(matches == is_in_answer(answer, s->bodies[i].id));
        expected += matches;
    }
    assert_int_equal(answer->count, expected);
}

static const octree_body *find(const scene *s, const octree_body *player, uint64_t id)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->bodies[i].id == id)
            return &s->bodies[i];
    assert_int_equal(id, PLAYER);
    return player;
}

/* No body outside of the answer comes before its last neighbour, the distances ascend, and each is right. */
static void assert_neighbor_answer(const scene *s, const octree_tick *tick, const octree_answer *answer)
{
    const octree_body player = player_of(tick), *last = NULL;
    assert_int_equal(answer->count, s->count + 1 < answer->k ? s->count + 1 : answer->k);
    for (size_t i = 0; i < answer->count; i++) {
        const octree_body *body = find(s, &player, answer->neighbors[i].point.id);
        assert_true(oracle_distance_is(answer->neighbors[i].distance, 4, answer->target, body));
        if (last) {
            const int order = oracle_compare_distances(answer->target, last, body);
            assert_true(order < 0 || (order == 0 && last->id < body->id));
        }
        last = body;
    }
    for (size_t i = 0; last && i < s->count; i++)
        if (!is_in_answer(answer, s->bodies[i].id)) {
            const int order = oracle_compare_distances(answer->target, last, &s->bodies[i]);
            assert_true(order < 0 || (order == 0 && last->id < s->bodies[i].id));
        }
}

static void assert_hits(const scene *s, const octree_tick *tick)
{
    octree_body box = player_of(tick);
    size_t at = 0;
    memcpy(box.position, tick->attempt, sizeof box.position);
    for (int axis = 0; axis < 3; axis++)
        box.half[axis] = s->session.player.box_size;
    for (uint64_t id = 0; id < BODIES; id++)
        for (size_t i = 0; i < s->count; i++)
            if (s->bodies[i].id == id) {
                const bool hit = at < tick->hit_count && tick->hits[at].id == id;
                assert_true(hit == oracle_overlap(&box, &s->bodies[i]));
                at += hit;
            }
    assert_int_equal(at, tick->hit_count);
}

static void assert_pairs(const scene *s, const octree_tick *tick)
{
    size_t expected = 0;
    for (size_t i = 0; i < s->count; i++)
        for (size_t j = i + 1; j < s->count; j++)
            expected += oracle_overlap(&s->bodies[i], &s->bodies[j]);
    assert_int_equal(tick->pair_count, expected);
    assert_true(((tick->events & OCTREE_EVENT_OVERLAPPED) != 0) == (expected > 0));
    for (size_t i = 0; i < tick->pair_count; i++) {
        const octree_pair *p = &tick->pairs[i];
        assert_true(p->a < p->b && (i == 0 || p[-1].a < p->a || (p[-1].a == p->a && p[-1].b < p->b)));
        assert_true(oracle_overlap(find(s, NULL, p->a), find(s, NULL, p->b)));
    }
}

static void assert_tick(const scene *s, const octree_tick *tick)
{
    assert_hits(s, tick);
    assert_pairs(s, tick);
    assert_int_equal(tick->answer_count, QUERIES);
    for (size_t i = 0; i < tick->answer_count; i++)
        if (octree_query_about(tick->answers[i].kind)->neighbors)
            assert_neighbor_answer(s, tick, &tick->answers[i]);
        else
            assert_region_answer(s, tick, &tick->answers[i]);
    for (size_t i = 0; i < s->count; i++) {
        octree_body body;
        assert_true(octree_game_find_body(s->game, s->bodies[i].id, &body));
        assert_int_equal(octree_compare_bodies(&body, &s->bodies[i]), 0);
    }
}

/* ---- Random games ----------------------------------------------------------------------------------------- */

static void draw_queries(scene *s)
{
    const octree_region box = random_region(s->numbers, OCTREE_REGION_BOX, &s->seed, s->unused);
    const octree_region ball = random_region(s->numbers, OCTREE_REGION_BALL, &s->seed, s->unused);
    s->queries[0] = (octree_query){.kind = OCTREE_QUERY_RANGE, .box = box.box};
    s->queries[1] = (octree_query){.kind = OCTREE_QUERY_RADIUS, .radius = ball.radius};
    s->queries[2] = (octree_query){.kind = OCTREE_QUERY_KNEAREST, .k = random_below(&s->seed, BODIES + 5)};
    s->queries[3] = (octree_query){.kind = OCTREE_QUERY_NEAREST};
    for (int i = 1; i < 4; i++)
        random_target(s->numbers, &s->seed, s->queries[i].target);
    const octree_region frustum = random_region(s->numbers, OCTREE_REGION_HALF_SPACES, &s->seed, s->unused);
    octree_query *query = &s->queries[4];
    *query = (octree_query){.kind = OCTREE_QUERY_FRUSTUM};
    while (query->frustum.count < frustum.half_space_count && query->frustum.count < OCTREE_FRUSTUM_HALF_SPACES) {
        query->frustum.half_spaces[query->frustum.count] = frustum.half_spaces[query->frustum.count];
        query->frustum.count++;
    }
}

/* Change the expected bodies and store the same changes as edits: moves, and replacements by a body of the same id. */
static size_t draw_edits(scene *s, octree_edit edits[2 * EDITS])
{
    size_t count = 0;
    for (size_t i = 0; i < EDITS; i++) {
        octree_body *body = &s->bodies[i * 7];
        const octree_body drawn = random_body(s->numbers, &s->seed, body->id);
        const bool replaced = random_below(&s->seed, 2);
        if (replaced) {
            *body = drawn;
            edits[count++] = (octree_edit){.kind = OCTREE_EDIT_REMOVE, .body.id = body->id};
        }
        memcpy(body->position, drawn.position, sizeof body->position);
        edits[count++] =
            (octree_edit){.kind = replaced ? OCTREE_EDIT_INSERT : OCTREE_EDIT_MOVE, .body = to_game_body(body)};
    }
    return count;
}

static void start_scene(scene *s)
{
    s->count = BODIES;
    for (size_t i = 0; i < BODIES; i++) {
        s->bodies[i] = random_body(s->numbers, &s->seed, i);
        s->initial[i] = to_game_body(&s->bodies[i]);
    }
    s->session = small_session(s->initial, BODIES);
    s->session.tree.world = scene_world(s->numbers);
    s->session.tree.full_leaf = OCTREE_GROW;
    s->session.player.id = PLAYER;
    s->session.player.step = 0;
    const octree_body middle = random_body(s->numbers, &s->seed, 0);
    memcpy(s->session.player.position, middle.position, sizeof middle.position);
    s->session.player.box_size = middle.half[0];
    s->session.pairs = true;
    s->game = start_game(&s->session);
}

static void play_random_game(scene_numbers numbers, uint64_t seed)
{
    static scene s;
    s = (scene){.numbers = numbers, .seed = seed};
    start_scene(&s);
    for (int tick = 0; tick < TICKS; tick++) {
        octree_edit edits[2 * EDITS];
        octree_input input = {.edits = edits, .edit_count = draw_edits(&s, edits), .queries = s.queries};
        draw_queries(&s);
        input.query_count = QUERIES;
        assert_int_equal(octree_game_play(s.game, &input), OCTREE_OK);
        assert_int_equal(octree_game_tick(s.game)->refusal_count, 0);
        assert_tick(&s, octree_game_tick(s.game));
    }
    octree_game_destroy(s.game);
}

static void hits_answers_and_pairs_of_boxes_are_exact_at_every_scale(void **state)
{
    (void)state;
    for (int numbers = 0; numbers < NUMBERS_KINDS; numbers++)
        for (uint64_t seed = 1; seed <= 4; seed++)
            play_random_game((scene_numbers)numbers, seed);
}

/* ---- Motion ------------------------------------------------------------------------------------------------- */

static void a_box_bounces_by_its_faces(void **state)
{
    (void)state;
    static const octree_game_body body = {.id = 1, .position = {5, 0, 0}, .velocity = {2, 0, 0}, .half = {3, 1, 1}};
    static const double places[] = {7, 5, 3}, velocities[] = {-2, -2, -2};
    octree_session session = small_session(&body, 1);
    session.player.kind = OCTREE_PLAYER_NONE;
    octree_game *game = start_game(&session);
    for (int i = 0; i < 3; i++) {
        const octree_tick *tick = play_key(game, '.');
        assert_true(tick->movers[0].position[0] == places[i] && tick->movers[0].velocity[0] == velocities[i]);
        assert_true(tick->movers[0].half[0] == 3);
    }
    octree_game_destroy(game);
}

static void a_box_larger_than_the_world_does_not_move_on_that_axis(void **state)
{
    (void)state;
    static const octree_game_body body = {.id = 1, .position = {5, 0, 1}, .velocity = {2, 1, 0}, .half = {11, 0, 0}};
    octree_session session = small_session(&body, 1);
    session.player.kind = OCTREE_PLAYER_NONE;
    octree_game *game = start_game(&session);
    const octree_tick *tick = play_key(game, '.');
    assert_true(same_position(tick->movers[0].position, (double[3]){5, 1, 1}));
    octree_game_destroy(game);
}

/* Its box reaches 2 beyond the face, so that 8 is where it turns. */
static void a_box_that_begins_beyond_the_bounds_bounces_where_it_began(void **state)
{
    (void)state;
    static const octree_game_body body = {.id = 1, .position = {8, 0, 0}, .velocity = {-1, 0, 0}, .half = {4, 1, 1}};
    octree_session session = small_session(&body, 1);
    session.player.kind = OCTREE_PLAYER_NONE;
    octree_game *game = start_game(&session);
    for (int i = 1; i <= 28; i++) /* from 8 to -6, and back to 8 */
        assert_true(play_key(game, '.')->movers[0].position[0] == (i <= 14 ? 8 - i : i - 20));
    assert_true(play_key(game, '.')->movers[0].position[0] == 7);
    octree_game_destroy(game);
}

/* ---- Cost and errors ---------------------------------------------------------------------------------------- */

static uint64_t cost_of_collision(bool huge)
{
    static octree_game_body bodies[200];
    static const octree_edit edits[] = {{.kind = OCTREE_EDIT_REMOVE, .body.id = 0}};
    for (size_t i = 0; i < 200; i++)
        bodies[i] = (octree_game_body){
            .id = i, .position = {(double)(i % 20) - 10, (double)(i / 20) - 5, 0}, .half = {0.1, 0.1, 0.1}};
    bodies[0].half[0] = huge ? 9 : 0.1;
    octree_session session = small_session(bodies, 200);
    session.player.id = PLAYER;
    octree_game *game = start_game(&session);
    const octree_input input = {.edits = edits, .edit_count = 1};
    assert_int_equal(octree_game_play(game, &input), OCTREE_OK);
    const uint64_t points = octree_game_tick(game)->hit_cost.points;
    octree_game_destroy(game);
    return points;
}

static void a_removed_large_body_costs_nothing(void **state)
{
    (void)state;
    assert_int_equal(cost_of_collision(true), cost_of_collision(false));
}

static void bodies_with_bad_half_extents_are_refused(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .half = {0, -1, 0}},
                                              {.id = 2, .position = {1, 1, 1}, .half = {1, 1, 1}},
                                              {.id = 3, .half = {0, 0, NAN}},
                                              {.id = 4, .half = {HUGE_VAL, 0, 0}}};
    octree_session session = small_session(bodies, 4);
    session.player.kind = OCTREE_PLAYER_NONE;
    octree_game *game = start_game(&session);
    const octree_tick *tick = octree_game_tick(game);
    assert_int_equal(tick->refusal_count, 3);
    assert_int_equal(tick->refusals[0].why, OCTREE_BAD_SIZE);
    assert_int_equal(tick->refusals[1].why, OCTREE_NOT_FINITE);
    assert_int_equal(tick->refusals[2].why, OCTREE_NOT_FINITE);
    assert_int_equal(octree_count(octree_game_tree(game)), 1);
    octree_game_destroy(game);
}

/* ---- Foreign answers ---------------------------------------------------------------------------------------- */

/* Ask with the answer that the game itself gave, and with one whose last body is replaced by body 0. */
static void right_answers_about_boxes_pass_and_wrong_ones_are_found(void **state)
{
    (void)state;
    static scene s;
    size_t wrong = 0;
    for (uint64_t seed = 10; seed < 20; seed++) {
        s = (scene){.numbers = (scene_numbers)(seed % NUMBERS_KINDS), .seed = seed};
        start_scene(&s);
        draw_queries(&s);
        assert_int_equal(octree_game_ask(s.game, s.queries, 4), OCTREE_OK);
        uint64_t ids[4][BODIES + 1];
        const octree_tick *tick = octree_game_tick(s.game);
        for (size_t i = 0; i < 4; i++) {
            const octree_answer *answer = &tick->answers[i];
            const bool near = octree_query_about(answer->kind)->neighbors;
            for (size_t j = 0; j < answer->count; j++)
                ids[i][j] = near ? answer->neighbors[j].point.id : answer->points[j].id;
            s.queries[i].answered = true;
            s.queries[i].answer = ids[i];
            s.queries[i].answer_count = answer->count;
        }
        assert_int_equal(octree_game_ask(s.game, s.queries, 4), OCTREE_OK);
        for (size_t i = 4; i < 8; i++)
            assert_true(tick->answers[i].judgement.judged && !tick->answers[i].judgement.wrong);
        for (size_t i = 0; i < 2; i++) {
            s.queries[i].answer_count -= s.queries[i].answer_count > 0;
            wrong += tick->answers[4 + i].count > 0;
        }
        assert_int_equal(octree_game_ask(s.game, s.queries, 2), OCTREE_OK);
        for (size_t i = 8; i < 10; i++)
            assert_int_equal(tick->answers[i].judgement.wrong,
                             tick->answers[i].count > 0 ? OCTREE_WRONG_MISSING : OCTREE_WRONG_NONE);
        octree_game_destroy(s.game);
    }
    assert_true(wrong > 5);
}

/* All numbers are multiples of 1/2, so that a box overlaps a region if it meets the region without its outer 1/8. */
static void open_bounds_leave_out_boxes_that_only_touch(void **state)
{
    (void)state;
    static scene s = {.numbers = NUMBERS_LATTICE, .seed = 30};
    size_t touching = 0;
    start_scene(&s);
    for (int i = 0; i < 40; i++) {
        octree_query queries[2] = {{.kind = OCTREE_QUERY_RANGE}, {.kind = OCTREE_QUERY_RANGE}};
        for (int axis = 0; axis < 3; axis++) {
            const double low = (double)random_below(&s.seed, 8) - 6, high = low + 1 + (double)random_below(&s.seed, 4);
            queries[0].box.min[axis] = low;
            queries[0].box.max[axis] = high;
            queries[1].box.min[axis] = low + 0.125;
            queries[1].box.max[axis] = high - 0.125;
        }
        queries[0].bounds = OCTREE_BOUNDS_OPEN;
        assert_int_equal(octree_game_ask(s.game, queries, 2), OCTREE_OK);
        const octree_tick *tick = octree_game_tick(s.game);
        const octree_answer *answers = &tick->answers[tick->answer_count - 2];
        assert_int_equal(answers[0].count, answers[1].count);
        for (size_t j = 0; j < answers[0].count; j++)
            assert_int_equal(answers[0].points[j].id, answers[1].points[j].id);
        /* an index with closed bounds is accused of the bodies that touch, on the boundary alone */
        queries[0].bounds = OCTREE_BOUNDS_CLOSED;
        assert_int_equal(octree_game_ask(s.game, queries, 1), OCTREE_OK);
        const octree_answer *closed = &octree_game_tick(s.game)->answers[tick->answer_count - 1];
        static uint64_t ids[BODIES + 1];
        for (size_t j = 0; j < closed->count; j++)
            ids[j] = closed->points[j].id;
        const size_t extra = closed->count - answers[0].count;
        queries[0] = (octree_query){.kind = OCTREE_QUERY_RANGE,
                                    .box = queries[0].box,
                                    .bounds = OCTREE_BOUNDS_OPEN,
                                    .answered = true,
                                    .answer = ids,
                                    .answer_count = closed->count};
        assert_int_equal(octree_game_ask(s.game, queries, 1), OCTREE_OK);
        const octree_judgement *made = &octree_game_tick(s.game)->answers[tick->answer_count - 1].judgement;
        assert_int_equal(made->extra_count, extra);
        assert_int_equal(made->on_boundary, extra ? OCTREE_WRONG_EXTRA : OCTREE_WRONG_NONE);
        touching += extra;
    }
    assert_true(touching > 20);
    octree_game_destroy(s.game);
}

/* Two cells list a box that both touch, and the box's centre is in one of them: the index is right. */
static void a_node_may_list_a_body_that_only_touches_it(void **state)
{
    (void)state;
    static const octree_game_body body = {.id = 7, .position = {1, 0, 0}, .half = {1, 1, 1}};
    static const uint64_t seven[] = {7};
    octree_foreign_node nodes[] = {
        {.id = 1, .box = {{-10, -10, -10}, {0, 10, 10}}, .has_points = true, .points = {seven, 1}},
        {.id = 2, .box = {{0, -10, -10}, {10, 10, 10}}, .has_points = true, .points = {seven, 1}}};
    const octree_foreign_tree tree = {.nodes = nodes, .node_count = 2};
    octree_session session = small_session(&body, 1);
    session.foreign = &tree;
    session.foreign_count = 1;
    octree_game *game = start_game(&session);
    assert_int_equal(octree_game_tick(game)->foreign.wrong_count, 0);
    octree_game_destroy(game);
    nodes[0].box.max[0] = -0x1p-1074;
    game = start_game(&session);
    assert_int_equal(octree_game_tick(game)->foreign.wrong[OCTREE_NODE_OUTSIDE_POINT], 1);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hits_answers_and_pairs_of_boxes_are_exact_at_every_scale),
        cmocka_unit_test(a_box_bounces_by_its_faces),
        cmocka_unit_test(a_box_larger_than_the_world_does_not_move_on_that_axis),
        cmocka_unit_test(a_box_that_begins_beyond_the_bounds_bounces_where_it_began),
        cmocka_unit_test(a_removed_large_body_costs_nothing),
        cmocka_unit_test(bodies_with_bad_half_extents_are_refused),
        cmocka_unit_test(right_answers_about_boxes_pass_and_wrong_ones_are_found),
        cmocka_unit_test(open_bounds_leave_out_boxes_that_only_touch),
        cmocka_unit_test(a_node_may_list_a_body_that_only_touches_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
