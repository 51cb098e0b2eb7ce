/* SPDX-License-Identifier: MIT */
/* test_session_write.c - sessions survive writing and reading; copies of sessions; replacing keys. */
#include "fixture.h"
#include "octree/sample.h"
#include "random_session.h"
#include "session_file.h"
#include "session_texts.h"

#include <float.h>
#include <stdio.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HEADER "{\"octreel\":\"session\",\"version\":2"

/* Compare the members that the kind of player has. */
static void assert_same_player(const octree_player *a, const octree_player *b)
{
    assert_int_equal(a->kind, b->kind);
    if (a->kind == OCTREE_PLAYER_NONE)
        return;
    assert_int_equal(a->id, b->id);
    assert_memory_equal(&a->box_size, &b->box_size, sizeof a->box_size);
    assert_int_equal(a->sweep, b->sweep);
    if (a->kind == OCTREE_PLAYER_BODY)
        return;
    assert_memory_equal(a->position, b->position, sizeof a->position);
    assert_memory_equal(&a->step, &b->step, sizeof a->step);
}

static void assert_same_start(const octree_session *a, const octree_session *b)
{
    assert_memory_equal(&a->tree.world, &b->tree.world, sizeof a->tree.world);
    assert_int_equal(a->tree.leaf_capacity, b->tree.leaf_capacity);
    assert_int_equal(a->tree.max_depth, b->tree.max_depth);
    assert_int_equal(a->tree.full_leaf, b->tree.full_leaf);
    assert_same_player(&a->player, &b->player);
    assert_int_equal(a->ticks, b->ticks);
    assert_int_equal(a->keys != NULL, b->keys != NULL);
    if (a->keys)
        assert_string_equal(a->keys, b->keys);
    assert_int_equal(a->body_count, b->body_count);
    if (a->body_count > 0)
        assert_memory_equal(a->bodies, b->bodies, a->body_count * sizeof *a->bodies);
}

static void assert_same_edit(const octree_edit *a, const octree_edit *b)
{
    assert_int_equal(a->tick, b->tick);
    assert_int_equal(a->kind, b->kind);
    assert_int_equal(a->body.id, b->body.id);
    if (a->kind != OCTREE_EDIT_REMOVE)
        assert_memory_equal(a->body.position, b->body.position, sizeof a->body.position);
    if (a->kind == OCTREE_EDIT_INSERT)
        assert_memory_equal(a->body.velocity, b->body.velocity, sizeof a->body.velocity);
    if (a->kind == OCTREE_EDIT_INSERT)
        assert_memory_equal(a->body.half, b->body.half, sizeof a->body.half);
}

static void assert_same_query(const octree_query *a, const octree_query *b)
{
    assert_int_equal(a->tick, b->tick);
    assert_int_equal(a->kind, b->kind);
    assert_int_equal(a->at_player, b->at_player);
    if (a->kind == OCTREE_QUERY_RANGE)
        assert_memory_equal(&a->box, &b->box, sizeof a->box);
    else if (!a->at_player)
        assert_memory_equal(a->target, b->target, sizeof a->target);
    if (a->kind == OCTREE_QUERY_KNEAREST || a->kind == OCTREE_QUERY_RAY)
        assert_int_equal(a->k, b->k);
    if (a->kind == OCTREE_QUERY_RAY) {
        assert_memory_equal(a->direction, b->direction, sizeof a->direction);
        assert_memory_equal(&a->thickness, &b->thickness, sizeof a->thickness);
        assert_memory_equal(&a->length, &b->length, sizeof a->length);
    }
    if (a->kind == OCTREE_QUERY_SWEEP) {
        assert_int_equal(a->k, b->k);
        assert_memory_equal(a->to, b->to, sizeof a->to);
        assert_memory_equal(a->half, b->half, sizeof a->half);
    }
    if (a->kind == OCTREE_QUERY_FRUSTUM)
        assert_memory_equal(&a->frustum, &b->frustum, sizeof a->frustum);
    if (a->kind == OCTREE_QUERY_RADIUS)
        assert_memory_equal(&a->radius, &b->radius, sizeof a->radius);
    assert_int_equal(a->bounds, b->bounds);
    assert_int_equal(a->skip, b->skip);
    if (a->skip == OCTREE_SKIP_ID)
        assert_int_equal(a->skip_id, b->skip_id);
    assert_memory_equal(&a->epsilon, &b->epsilon, sizeof a->epsilon);
    assert_true(a->answered == b->answered && a->answer_count == b->answer_count);
    if (a->answered)
        assert_int_equal(a->precision, b->precision);
    if (a->answer_count > 0)
        assert_memory_equal(a->answer, b->answer, a->answer_count * sizeof *a->answer);
}

static void assert_same_session(const octree_session *a, const octree_session *b)
{
    assert_same_start(a, b);
    assert_int_equal(a->edit_count, b->edit_count);
    for (size_t i = 0; i < a->edit_count; i++)
        assert_same_edit(&a->edits[i], &b->edits[i]);
    assert_int_equal(a->query_count, b->query_count);
    for (size_t i = 0; i < a->query_count; i++)
        assert_same_query(&a->queries[i], &b->queries[i]);
    assert_int_equal(a->shape_count, b->shape_count);
    for (size_t i = 0; i < a->shape_count; i++)
        assert_memory_equal(&a->shapes[i], &b->shapes[i], sizeof a->shapes[i]);
    assert_int_equal(a->gap_count, b->gap_count);
    for (size_t i = 0; i < a->gap_count; i++) {
        assert_int_equal(a->gaps[i].tick, b->gaps[i].tick);
        assert_string_equal(a->gaps[i].why, b->gaps[i].why);
    }
}

static void assert_round_trip(const octree_session *session)
{
    char *text = text_of_session(session, NULL);
    session_file file = session_of_text(text);
    assert_same_session(session, &file.session);
    char *again = text_of_session(&file.session, NULL);
    assert_string_equal(text, again);
    free(again);
    free(text);
    session_release(&file);
}

static void default_session_survives_the_round_trip(void **state)
{
    const octree_session session = octree_session_default();
    (void)state;
    assert_round_trip(&session);
}

static void skips_and_epsilons_survive_the_round_trip(void **state)
{
    static const octree_query queries[] = {
        {.kind = OCTREE_QUERY_RANGE, .skip = OCTREE_SKIP_ID, .skip_id = 0, .epsilon = 5e-324},
        {.kind = OCTREE_QUERY_RANGE, .at_player = true, .skip = OCTREE_SKIP_ID, .skip_id = (UINT64_C(1) << 53) - 1},
        {.kind = OCTREE_QUERY_KNEAREST, .k = 3, .skip = OCTREE_SKIP_COINCIDENT, .epsilon = 0.1},
        {.kind = OCTREE_QUERY_NEAREST, .at_player = true, .skip = OCTREE_SKIP_COINCIDENT},
        {.kind = OCTREE_QUERY_RADIUS, .radius = 2, .skip = OCTREE_SKIP_ID, .skip_id = 12, .epsilon = 1e300},
    };
    octree_session session = octree_session_default();
    (void)state;
    session.queries = queries;
    session.query_count = sizeof queries / sizeof queries[0];
    assert_round_trip(&session);
}

static void rays_survive_the_round_trip(void **state)
{
    static const octree_query queries[] = {
        {.kind = OCTREE_QUERY_RAY, .direction = {0, -1, 0}, .k = 1},
        {.kind = OCTREE_QUERY_RAY, .direction = {5e-324, 0, 0}, .k = 0, .length = 5e-324},
        {.kind = OCTREE_QUERY_RAY, .at_player = true, .direction = {1, 2, DBL_MAX}, .k = 9, .thickness = 0.1},
        {.kind = OCTREE_QUERY_RAY, .target = {1, 2, 3}, .direction = {1, 0, 0}, .k = 2, .thickness = 3, .length = 4},
    };
    octree_session session = octree_session_default();
    (void)state;
    session.queries = queries;
    session.query_count = sizeof queries / sizeof queries[0];
    assert_round_trip(&session);
}

static void frusta_and_sweeps_survive_the_round_trip(void **state)
{
    static const octree_query queries[] = {
        {.kind = OCTREE_QUERY_FRUSTUM, .frustum = {{{{0, -1, 0}, DBL_MAX}}, 1}},
        {.kind = OCTREE_QUERY_FRUSTUM,
         .at_player = true,
         .frustum = {{{{1, 0.1, 5e-324}, -3}, {{0, 0, -1}, 0}}, 2},
         .bounds = OCTREE_BOUNDS_EITHER},
        {.kind = OCTREE_QUERY_SWEEP, .target = {1, 2, 3}, .to = {0.1, -1, 5e-324}, .k = 1},
        {.kind = OCTREE_QUERY_SWEEP, .at_player = true, .to = {1, 2, 3}, .half = {0, 0.5, 2}, .k = 7},
    };
    octree_session session = octree_session_default();
    (void)state;
    session.queries = queries;
    session.query_count = sizeof queries / sizeof queries[0];
    assert_round_trip(&session);
}

static void a_ray_in_a_file_has_one_hit_and_no_end_by_default(void **state)
{
    (void)state;
    session_file file = session_of_text("{\"octreel\": \"session\", \"version\": 2, \"queries\": [{\"ray\": [1, 0, 0], "
                                        "\"at\": [0, 0, 0]}]}");
    const octree_query *query = file.session.queries;
    assert_true(file.session.query_count == 1 && query->kind == OCTREE_QUERY_RAY);
    assert_true(query->k == 1 && query->thickness == 0 && query->length == 0 && query->direction[0] == 1);
    session_release(&file);
}

/* Closed bounds are the default. Sessions without the member have the same bytes as before it existed. */
static void bounds_survive_the_round_trip_and_closed_ones_are_not_written(void **state)
{
    static const octree_query queries[] = {
        {.kind = OCTREE_QUERY_RADIUS, .radius = 2, .bounds = OCTREE_BOUNDS_OPEN},
        {.kind = OCTREE_QUERY_RANGE, .at_player = true, .bounds = OCTREE_BOUNDS_EITHER},
        {.kind = OCTREE_QUERY_RADIUS, .radius = 2},
    };
    octree_session session = octree_session_default();
    (void)state;
    session.queries = queries;
    session.query_count = sizeof queries / sizeof queries[0];
    assert_round_trip(&session);
    char *text = text_of_session(&session, NULL);
    assert_contains(text, "\"radius\": 2, \"at\": [0, 0, 0], \"bounds\": \"open\"}");
    assert_contains(text, "\"bounds\": \"either\", \"at\": \"player\"}");
    assert_contains(text, "\"radius\": 2, \"at\": [0, 0, 0]}");
    free(text);
}

static void answers_survive_the_round_trip(void **state)
{
    static const uint64_t ids[] = {7, 0, (UINT64_C(1) << 53) - 1, 7};
    static const octree_query queries[] = {
        {.kind = OCTREE_QUERY_RANGE, .answered = true},
        {.kind = OCTREE_QUERY_NEAREST, .answered = true, .answer = ids, .answer_count = 4, .epsilon = 0.5},
        {.tick = 4,
         .kind = OCTREE_QUERY_RADIUS,
         .answered = true,
         .precision = OCTREE_FLOATS,
         .answer = ids,
         .answer_count = 1},
        {.tick = OCTREE_EVERY_TICK,
         .kind = OCTREE_QUERY_KNEAREST,
         .k = 2,
         .at_player = true,
         .answered = true,
         .answer = ids,
         .answer_count = 2},
    };
    octree_session session = octree_session_default();
    octreel_error error;
    session_file copy;
    (void)state;
    session.queries = queries;
    session.query_count = sizeof queries / sizeof queries[0];
    assert_round_trip(&session);
    assert_true(session_copy(&session, &copy, &error));
    assert_same_session(&session, &copy.session);
    assert_true(copy.session.queries[1].answer != ids);
    session_release(&copy);
}

static void shapes_survive_the_round_trip(void **state)
{
    static const octree_shape shapes[] = {
        {0, OCTREE_SHAPE_BOX, {-1, -0.0, 5e-324}, {1e300, 0, 1}, ""},
        {0, OCTREE_SHAPE_LABEL, {1, 2, 3}, {0}, "1234567890123456789012345678901234567890123456"},
        {3, OCTREE_SHAPE_SEGMENT, {0.1, 0.2, 0.3}, {-0.1, -0.2, -0.3}, ""},
        {7, OCTREE_SHAPE_POINT, {1e15, -1e15, 0}, {0}, ""},
        {OCTREE_EVERY_TICK, OCTREE_SHAPE_LABEL, {9, 9, 9}, {0}, "\"quoted\\ ~"},
        {OCTREE_EVERY_TICK, OCTREE_SHAPE_BOX, {1, 1, 1}, {1, 1, 1}, ""},
    };
    octree_session session = octree_session_default();
    octreel_error error;
    session_file copy;
    (void)state;
    for (int asks = 0; asks < 2; asks++) {
        session.shapes = shapes;
        session.shape_count = sizeof shapes / sizeof shapes[0];
        assert_round_trip(&session);
        assert_true(session_copy(&session, &copy, &error));
        assert_same_session(&session, &copy.session);
        assert_true(copy.session.shapes != shapes);
        session_release(&copy);
        session.query_count = 0;
    }
}

static void players_of_every_kind_survive_the_round_trip(void **state)
{
    octree_session session = octree_session_default();
    (void)state;
    session.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .id = 3, .box_size = 0.1, .sweep = true};
    assert_round_trip(&session);
    session.player = (octree_player){.kind = OCTREE_PLAYER_NONE};
    assert_round_trip(&session);
}

static void random_sessions_survive_the_round_trip(void **state)
{
    static random_session made;
    (void)state;
    for (uint64_t seed = 0; seed < 200; seed++) {
        random_session_mixed(&made, seed);
        assert_round_trip(&made.session);
    }
}

/* Random bits that are finite doubles. */
static double any_double(uint64_t *state)
{
    double value;
    do {
        uint64_t bits = octree_random(state);
        memcpy(&value, &bits, sizeof value);
    } while (!(value >= -DBL_MAX && value <= DBL_MAX));
    return value;
}

static void every_bit_of_a_number_survives_the_round_trip(void **state)
{
    static octree_game_body bodies[500];
    uint64_t random = 11;
    octree_session session = octree_session_default();
    (void)state;
    session.bodies = bodies;
    session.body_count = sizeof bodies / sizeof *bodies;
    for (size_t i = 0; i < session.body_count; i++) {
        bodies[i].id = SESSION_ID_LIMIT - 1 - i;
        for (int axis = 0; axis < 3; axis++) {
            bodies[i].position[axis] = any_double(&random);
            bodies[i].velocity[axis] = i % 3 == 0 ? any_double(&random) : i % 3 == 1 ? -0.0 : 0.0;
            bodies[i].half[axis] = i % 5 == 0 ? fabs(any_double(&random)) : i % 5 == 1 ? -0.0 : 0.0;
        }
    }
    session.pairs = true;
    session.player.position[1] = -0.0;
    session.player.step = 5e-324;
    session.player.box_size = DBL_MAX;
    assert_round_trip(&session);
}

static void tree_options_are_written_clamped(void **state)
{
    octree_session session = octree_session_default();
    (void)state;
    session.tree.leaf_capacity = SIZE_MAX;
    session.tree.max_depth = SIZE_MAX;
    session.tree.full_leaf = OCTREE_GROW;
    char *text = text_of_session(&session, NULL);
    session_file file = session_of_text(text);
    assert_true(file.session.tree.leaf_capacity == UINT32_MAX);
    assert_int_equal(file.session.tree.max_depth, OCTREE_MAX_DEPTH);
    assert_int_equal(file.session.tree.full_leaf, OCTREE_GROW);
    free(text);
    session_release(&file);
}

static void number_of_neighbours_is_written_clamped(void **state)
{
    const octree_query all = {.kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = SIZE_MAX};
    octree_session session = octree_session_default();
    (void)state;
    session.queries = &all;
    session.query_count = 1;
    char *text = text_of_session(&session, NULL);
    session_file file = session_of_text(text);
    assert_true(file.session.queries[0].k == UINT32_MAX);
    free(text);
    session_release(&file);
}

static void written_session_has_one_line_for_each_point_and_tick(void **state)
{
    static const char expected[] =
        "{\"octreel\": \"session\", \"version\": 2,\n"
        "\"world\": {\"min\": [-1000, -1000, -1000], \"max\": [1000, 1000, 1000]},\n"
        "\"tree\": {\"capacity\": 8, \"depth\": 21, \"full\": \"refuse\"},\n"
        "\"player\": {\"id\": 0, \"position\": [0, 0, 0], \"step\": 50, \"box_size\": 30},\n"
        "\"keys\": \"wn\",\n"
        "\"ticks\": 2,\n"
        "\"queries\": [{\"nearest\": \"player\"}],\n"
        "\"points\": [\n"
        "[1, 2, 3, 1],\n"
        "{\"id\": 7, \"position\": [0.5, 0, 0], \"velocity\": [1, 0, 0]}\n"
        "]}\n"
        "{\"tick\": 1, \"edits\": [{\"remove\": 7}], \"queries\": [{\"nearest\": [0, 0, 0]}]}\n"
        "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 9, \"position\": [1, 1, 1]}}]}\n";
    session_file file = session_of_text(expected);
    char *text = text_of_session(&file.session, NULL);
    (void)state;
    assert_string_equal(text, expected);
    free(text);
    session_release(&file);
}

static void write_reports_a_full_disk(void **state)
{
    const octree_session session = octree_session_default();
    char room[16];
    FILE *full = fmemopen(room, sizeof room, "w");
    (void)state;
    assert_non_null(full);
    assert_false(session_write(&session, NULL, full));
    fclose(full);
}

/* With this number of points, any quadratic algorithm would be noticeably slow. */
static void many_points_survive_the_round_trip(void **state)
{
    session_file file =
        session_of_text(HEADER ",\"points\":{\"sample\":\"uniform\",\"count\":20000},\"velocities\":{\"speed\":1}}");
    (void)state;
    assert_round_trip(&file.session);
    session_release(&file);
}

static void copy_owns_its_memory(void **state)
{
    random_session *made = calloc(1, sizeof *made);
    session_file file;
    octreel_error error;
    (void)state;
    assert_non_null(made);
    random_session_full(made, 3);
    assert_true(session_copy(&made->session, &file, &error));
    assert_same_session(&made->session, &file.session);
    memset(made, 0xff, sizeof *made);
    random_session_full(made, 3);
    assert_same_session(&made->session, &file.session);
    free(made);
    char *text = text_of_session(&file.session, NULL);
    free(text);
    session_release(&file);
    session_release(&file);
}

static void keys_are_replaced(void **state)
{
    const octree_session session = octree_session_default();
    session_file file;
    octreel_error error;
    (void)state;
    assert_true(session_copy(&session, &file, &error));
    assert_true(session_set_keys(&file, "wwdn.", &error));
    assert_string_equal(file.session.keys, "wwdn.");
    assert_int_equal(octree_session_length(&file.session), 5);
    session_release(&file);
}

static void unknown_keys_are_refused_and_change_nothing(void **state)
{
    static const struct {
        const char *keys, *sentence;
    } rows[] = {
        {"wwx", "key 3, 'x', is not one of w a s d e f n q ."},
        {" w", "key 1, ' ', is not one of w a s d e f n q ."},
        {"W", "key 1, 'W', is not one of w a s d e f n q ."},
        {"w\xc3\xa9", "key 2, byte 0xc3, is not one of w a s d e f n q ."},
        {"w\n", "key 2, byte 0x0a, is not one of w a s d e f n q ."},
    };
    octree_session session = octree_session_default();
    session_file file, refused;
    octreel_error error;
    (void)state;
    assert_true(session_copy(&session, &file, &error));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_false(session_set_keys(&file, rows[i].keys, &error));
        assert_string_equal(error.text, rows[i].sentence);
        session.keys = rows[i].keys;
        assert_false(session_copy(&session, &refused, &error));
        assert_string_equal(error.text, rows[i].sentence);
    }
    session.keys = octree_session_default().keys;
    assert_same_session(&session, &file.session);
    session_release(&file);
}

static void gaps_survive_the_round_trip(void **state)
{
    octree_gap gaps[] = {{0, "the first"}, {3, "\"quoted\\ ~"}, {4, "two points have one id: 7"}, {400, ""}};
    octree_session session = octree_session_default();
    octreel_error error;
    session_file copy;
    (void)state;
    memset(gaps[3].why, 'x', OCTREE_GAP_TEXT - 1);
    session.gaps = gaps;
    session.gap_count = sizeof gaps / sizeof gaps[0];
    session.ticks = 400;
    assert_round_trip(&session);
    assert_true(session_copy(&session, &copy, &error));
    assert_same_session(&session, &copy.session);
    assert_true(copy.session.gaps != gaps);
    session_release(&copy);
}

/* The game plays no other input of a gap's tick, and a reader refuses it. */
static void gaps_are_written_without_other_input_of_their_tick(void **state)
{
    octree_gap gap = {2, "lost"};
    const octree_edit edits[] = {{.tick = 2, .kind = OCTREE_EDIT_REMOVE, .body.id = 1},
                                 {.tick = 3, .kind = OCTREE_EDIT_REMOVE, .body.id = 2}};
    octree_session session = octree_session_default();
    (void)state;
    session.gaps = &gap;
    session.gap_count = 1;
    session.edits = edits;
    session.edit_count = 2;
    char *text = text_of_session(&session, NULL);
    assert_non_null(strstr(text, "\n{\"tick\": 2, \"gap\": \"lost\"}\n{\"tick\": 3, \"edits\": [{\"remove\": 2}]}\n"));
    session_file copy = session_of_text(text);
    assert_int_equal(copy.session.edit_count, 1);
    session_release(&copy);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(number_of_neighbours_is_written_clamped),
        cmocka_unit_test(default_session_survives_the_round_trip),
        cmocka_unit_test(skips_and_epsilons_survive_the_round_trip),
        cmocka_unit_test(rays_survive_the_round_trip),
        cmocka_unit_test(frusta_and_sweeps_survive_the_round_trip),
        cmocka_unit_test(a_ray_in_a_file_has_one_hit_and_no_end_by_default),
        cmocka_unit_test(bounds_survive_the_round_trip_and_closed_ones_are_not_written),
        cmocka_unit_test(answers_survive_the_round_trip),
        cmocka_unit_test(shapes_survive_the_round_trip),
        cmocka_unit_test(players_of_every_kind_survive_the_round_trip),
        cmocka_unit_test(random_sessions_survive_the_round_trip),
        cmocka_unit_test(every_bit_of_a_number_survives_the_round_trip),
        cmocka_unit_test(tree_options_are_written_clamped),
        cmocka_unit_test(written_session_has_one_line_for_each_point_and_tick),
        cmocka_unit_test(write_reports_a_full_disk),
        cmocka_unit_test(many_points_survive_the_round_trip),
        cmocka_unit_test(copy_owns_its_memory),
        cmocka_unit_test(keys_are_replaced),
        cmocka_unit_test(unknown_keys_are_refused_and_change_nothing),
        cmocka_unit_test(gaps_survive_the_round_trip),
        cmocka_unit_test(gaps_are_written_without_other_input_of_their_tick),
    };
    return cmocka_run_group_tests_name("session_write", tests, NULL, NULL);
}
