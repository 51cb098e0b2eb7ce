/* SPDX-License-Identifier: MIT */
/* test_wrong_layer.c - tests the marks of wrong foreign answers: missing points, extra points, and the ring around each
 * answer. */
#include "column.h"
#include "layout.h"
#include "draw_list.h"
#include "judgement.h"
#include "layer_type.h"
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const octree_game_body bodies[] = {{.id = 1, .position = {1, 0, 1}},
                                          {.id = 2, .position = {2, 0, 1}},
                                          {.id = 3, .position = {5, 3, 1}},
                                          {.id = 4, .position = {-7, 4, 1}}};

/* A session without a player: the bodies, and these queries in tick 0. */
static octree_session session_of(const octree_query *queries, size_t count)
{
    octree_session session = small_session(bodies, 4);
    session.player.kind = OCTREE_PLAYER_NONE;
    session.queries = queries;
    session.query_count = count;
    return session;
}

static octree_query nearest_of(const uint64_t *answer, size_t count)
{
    return (octree_query){
        .kind = OCTREE_QUERY_NEAREST, .target = {0, 0, 1}, .answered = true, .answer = answer, .answer_count = count};
}

static scene scene_of(const octree_query *queries, size_t count, view_camera camera)
{
    const view v = view_of(1280, 720, camera, VIEW_DEFAULT_LAYERS);
    const octree_session session = session_of(queries, count);
    octree_game *game = start_game(&session);
    scene s = {0};
    build_tick(&s, &v, game);
    octree_game_destroy(game);
    return s;
}

/* The markers of a shape; *found is the last of them. */
static size_t count_shape(const scene *s, scene_shape shape, const scene_marker **found)
{
    size_t count = 0;
    for (size_t i = 0; i < s->markers.count; i++)
        if (s->markers.items[i].style.layer == LAYER_WRONG && s->markers.items[i].shape == (uint8_t)shape) {
            *found = &s->markers.items[i];
            count++;
        }
    return count;
}

static bool has_words(const scene *s, view_layer layer, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (s->labels.items[i].style.layer == layer && strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

static bool is_empty(const scene *s)
{
    const layer_counts found = count_layer(s, LAYER_WRONG);
    return found.boxes + found.segments + found.markers + found.labels + found.panels == 0;
}

static void farther_neighbour_is_marked_and_the_nearest_ringed(void **state)
{
    (void)state;
    static const uint64_t farther[] = {3};
    const octree_query query = nearest_of(farther, 1);
    for (int camera = 0; camera < CAMERA_COUNT; camera++) {
        scene s = scene_of(&query, 1, (view_camera)camera);
        const scene_marker *ring = NULL, *missed = NULL, *extra = NULL;
        assert_int_equal(count_shape(&s, SHAPE_RING, &ring), 1);
        assert_int_equal(count_shape(&s, SHAPE_TRIANGLE, &missed), 1);
        assert_int_equal(count_shape(&s, SHAPE_WEDGE, &extra), 1);
        assert_true(same_position(ring->at, bodies[0].position) && same_position(missed->at, ring->at));
        assert_true(missed->id == 1 && missed->style.role == ROLE_MISSED);
        assert_true(extra->id == 3 && extra->style.role == ROLE_WRONG && same_position(extra->at, bodies[2].position));
        assert_int_equal(count_lines_between(&s, LAYER_WRONG, 0, query.target, bodies[2].position), 1);
        assert_true(has_words(&s, LAYER_TEXT, "1 of 1") && has_words(&s, LAYER_TEXT, "nearest") &&
                    has_words(&s, LAYER_TEXT, "5.83 times as far"));
        assert_true(has_words(&s, LAYER_WRONG, "5.83 times as far"));
        scene_release(&s);
    }
}

/* The size of a ring is fixed in the picture, not in the world. */
static void ring_has_the_same_size_in_every_camera(void **state)
{
    (void)state;
    static const uint64_t farther[] = {3};
    const octree_query query = nearest_of(farther, 1);
    const octree_session session = session_of(&query, 1);
    octree_game *game = start_game(&session);
    for (double zoom = 0.01; zoom <= 100; zoom *= 100) {
        view v = view_of(1280, 720, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
        const scene_marker *ring = NULL;
        scene s = {0};
        v.zoom = zoom;
        build_tick(&s, &v, game);
        assert_int_equal(count_shape(&s, SHAPE_RING, &ring), 1);
        assert_int_equal(ring->style.width, 28);
        scene_release(&s);
    }
    octree_game_destroy(game);
}

static void missing_and_extra_points_of_a_ball_are_marked(void **state)
{
    (void)state;
    static const uint64_t named[] = {4, 2};
    const octree_query query = {.kind = OCTREE_QUERY_RADIUS,
                                .target = {0, 0, 1},
                                .radius = 3,
                                .answered = true,
                                .answer = named,
                                .answer_count = 2};
    scene s = scene_of(&query, 1, CAMERA_TOP);
    assert_int_equal(count_layer(&s, LAYER_WRONG).segments, 0);
    assert_int_equal(count_markers_at(&s, LAYER_WRONG, 1, bodies[0].position), 1);
    assert_int_equal(count_markers_at(&s, LAYER_WRONG, 4, bodies[3].position), 1);
    assert_true(has_words(&s, LAYER_TEXT, "1 missing, 1 extra"));
    scene_release(&s);
}

/* The answer names an id that no point has: the ring is at the query's target. */
static void answer_with_an_unknown_id_is_ringed_at_its_target(void **state)
{
    (void)state;
    static const uint64_t both[] = {1, 1}, box_ids[] = {9};
    const octree_query queries[] = {nearest_of(both, 2),
                                    {.kind = OCTREE_QUERY_RANGE,
                                     .box = {{-9, -9, -9}, {-8, -8, -8}},
                                     .answered = true,
                                     .answer = box_ids,
                                     .answer_count = 1}};
    scene s = scene_of(queries, 2, CAMERA_TOP);
    assert_int_equal(count_markers_at(&s, LAYER_WRONG, UINT64_MAX, queries[0].target), 1);
    assert_int_equal(count_markers_at(&s, LAYER_WRONG, UINT64_MAX - 1, (double[]){-8.5, -8.5, -8.5}), 1);
    assert_true(has_words(&s, LAYER_WRONG, "1 is listed twice") && has_words(&s, LAYER_WRONG, "no point has id 9"));
    scene_release(&s);
}

/* Of many wrong answers only the worst has a large ring and a text. */
static void worst_of_many_wrong_answers_has_the_large_ring(void **state)
{
    (void)state;
    static const uint64_t ids[] = {2, 2, 4, 2, 2, 3};
    octree_query queries[6];
    for (size_t i = 0; i < 6; i++)
        queries[i] = nearest_of(&ids[i], 1);
    scene s = scene_of(queries, 6, CAMERA_TOP);
    size_t large = 0;
    for (size_t i = 0; i < s.markers.count; i++) {
        const scene_marker *mark = &s.markers.items[i];
        if (mark->style.layer != LAYER_WRONG || mark->shape != SHAPE_RING || mark->style.width < 28)
            continue;
        assert_true(mark->id == UINT64_MAX - 2);
        large++;
    }
    assert_int_equal(large, 1);
    assert_int_equal(count_layer(&s, LAYER_WRONG).labels, 1);
    assert_true(has_words(&s, LAYER_WRONG, "8.06 times as far") && has_words(&s, LAYER_TEXT, "6 of 6") &&
                has_words(&s, LAYER_TEXT, "nearest"));
    scene_release(&s);
}

/* The column counts the wrong answers of all kinds. It names a kind only beside the error of an answer. */
static void column_counts_wrong_answers_apart_from_their_kinds(void **state)
{
    (void)state;
    static const uint64_t farther[] = {3}, none[] = {0};
    octree_query queries[] = {
        nearest_of(farther, 1),
        {.kind = OCTREE_QUERY_RADIUS, .target = {0, 0, 1}, .radius = 1.5, .answered = true, .answer = none}};
    for (size_t count = 1; count <= 2; count++) {
        scene s = scene_of(queries, count, CAMERA_ISO);
        const scene_label *name = NULL, *kind = NULL, *error = NULL;
        for (size_t i = 0; i < s.labels.count; i++) {
            const scene_label *label = &s.labels.items[i];
            if (label->style.layer != LAYER_TEXT)
                continue;
            name = strcmp(label->text, "wrong") == 0 ? label : name;
            kind = !kind && strcmp(label->text, "worst") == 0 ? label : kind;
            error = strcmp(label->text, "5.83 times as far") == 0 ? label : error;
        }
        assert_true(name && kind && error);
        assert_true(has_words(&s, LAYER_TEXT, "answers"));
        assert_true(has_words(&s, LAYER_TEXT, count == 1 ? "1 of 1" : "2 of 2"));
        assert_true(name->at[1] < kind->at[1] && kind->at[1] == error->at[1]);
        scene_release(&s);
    }
}

/* The words stay clear of the panel, of each other and of the picture's edges. */
static void texts_without_room_are_left_out(void **state)
{
    (void)state;
    static const uint64_t far[] = {4};
    octree_query queries[3];
    for (size_t i = 0; i < 3; i++) {
        queries[i] = nearest_of(far, 1);
        queries[i].target[0] = (double)i * 1e-3;
    }
    const octree_session session = session_of(queries, 3);
    octree_game *game = start_game(&session);
    for (int width = 40; width < 700; width += 60) {
        const view v = view_of(width, width / 2, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
        scene s = {0};
        build_tick(&s, &v, game);
        for (size_t i = 0; i < s.labels.count; i++) {
            const scene_label *label = &s.labels.items[i];
            if (label->style.layer != LAYER_WRONG)
                continue;
            assert_true(label->at[0] >= layout_panel_width(&v) && label->at[1] >= 0 && label->at[1] < v.height);
            assert_true(label->at[0] + (double)strlen(label->text) * s.text.width <= v.width);
        }
        scene_release(&s);
    }
    octree_game_destroy(game);
}

/* Of nodes that have one corner together as of points that are at one place: no words cover others, and what has no
 * room is counted. */
static void texts_at_one_place_do_not_overlap(void **state)
{
    (void)state;
    enum { SAME = 12 };
    static const uint64_t unknown[] = {77}, far[] = {4};
    octree_foreign_node nodes[SAME];
    octree_query queries[3];
    for (size_t i = 0; i < SAME; i++)
        nodes[i] = (octree_foreign_node){
            .id = i, .box = {{-9, -9, -9}, {1, 0, 1}}, .has_points = true, .points = {unknown, 1}};
    for (size_t i = 0; i < 3; i++)
        queries[i] = nearest_of(far, 1);
    const octree_foreign_tree tree = {.nodes = nodes, .node_count = SAME};
    octree_session session = session_of(queries, 3);
    session.foreign = &tree;
    session.foreign_count = 1;
    octree_game *game = start_game(&session);
    const view v = view_of(640, 360, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
    scene s = {0};
    build_tick(&s, &v, game);
    text_space taken = {.count = 0};
    size_t words = 0, left_out = 0;
    for (size_t i = 0; i < s.labels.count; i++) {
        const scene_label *label = &s.labels.items[i];
        double corner[2];
        if (label->style.layer != LAYER_WRONG)
            continue;
        const double middle[2] = {label->at[0] + (double)strlen(label->text) * s.text.width / 2,
                                  label->at[1] + s.text.height / 2.0};
        assert_true(!label->in_world && text_space_reserve_text(&taken, &s, label->text, middle, corner));
        words += sscanf(label->text, "and %zu others that are wrong", &left_out) != 1;
    }
    assert_true(left_out > 0);
    assert_int_equal(words + left_out, 3 + SAME + 4); /* and all points, of which no node has one */
    octree_game_destroy(game);
    scene_release(&s);
}

/* Nothing is added for right answers, nor where no program answered. */
static void right_or_missing_answers_add_nothing(void **state)
{
    (void)state;
    static const uint64_t right[] = {1};
    octree_query query = nearest_of(right, 1);
    scene s = scene_of(&query, 1, CAMERA_ISO);
    assert_true(is_empty(&s) && !has_swatch(&s, ROLE_WRONG));
    scene_release(&s);
    query.answered = false;
    s = scene_of(&query, 1, CAMERA_ISO);
    assert_true(is_empty(&s) && !has_swatch(&s, ROLE_WRONG));
    const octree_session session = session_of(&query, 1);
    const view v = view_of(1280, 720, CAMERA_ISO, VIEW_DEFAULT_LAYERS & ~(1u << LAYER_WRONG));
    octree_game *game = start_game(&session);
    scene without = {0};
    build_tick(&without, &v, game);
    assert_true(scene_digest(&s) == scene_digest(&without));
    octree_game_destroy(game);
    scene_release(&without);
    scene_release(&s);
}

static void ratio_near_one_is_printed_as_a_percentage(void **state)
{
    const struct {
        double ratio;
        const char *words;
    } rows[] = {{INFINITY, "infinite ratio"},
                {1.01, "1.01 times as far"},
                {nextafter(1.01, 1), "1% farther"},
                {1.005, "0.5% farther"},
                {8.0625, "8.06 times as far"}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const octree_judgement made = {.wrong = OCTREE_WRONG_FARTHER, .ratio = rows[i].ratio};
        char text[JUDGEMENT_TEXT];
        assert_string_equal(judgement_text(&made, text), rows[i].words);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(farther_neighbour_is_marked_and_the_nearest_ringed),
        cmocka_unit_test(ring_has_the_same_size_in_every_camera),
        cmocka_unit_test(missing_and_extra_points_of_a_ball_are_marked),
        cmocka_unit_test(answer_with_an_unknown_id_is_ringed_at_its_target),
        cmocka_unit_test(worst_of_many_wrong_answers_has_the_large_ring),
        cmocka_unit_test(column_counts_wrong_answers_apart_from_their_kinds),
        cmocka_unit_test(texts_without_room_are_left_out),
        cmocka_unit_test(texts_at_one_place_do_not_overlap),
        cmocka_unit_test(right_or_missing_answers_add_nothing),
        cmocka_unit_test(ratio_near_one_is_printed_as_a_percentage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
