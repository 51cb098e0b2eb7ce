/* SPDX-License-Identifier: MIT */
/* test_wrong_pairs.c - tests the marks of missing and extra pairs of a foreign index, their legend and descriptions. */
#include "column.h"
#include "describe.h"
#include "draw_list.h"
#include "scenes.h"

#include <string.h>

/* 1 and 2 overlap from x = 1 to x = 2; 3 is 3 to the right of 2, and 4 is a floor under all. */
static const octree_game_body bodies[] = {{.id = 1, .half = {2, 1, 1}},
                                          {.id = 2, .position = {3, 0, 0}, .half = {2, 1, 1}},
                                          {.id = 3, .position = {9, 0, 0}, .half = {1, 1, 1}},
                                          {.id = 4, .position = {0, 0, -6}, .half = {10, 10, 1}}};

static octree_game *game;
static scene drawn;

static void draw_pairs(const octree_pair *pairs, size_t count)
{
    static octree_foreign_pairs list;
    static octree_session session;
    const view v = view_of(1280, 720, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
    list = (octree_foreign_pairs){.pairs = pairs, .pair_count = count};
    session = small_session(bodies, sizeof bodies / sizeof *bodies);
    session.tree.full_leaf = OCTREE_GROW;
    session.player.kind = OCTREE_PLAYER_NONE;
    session.foreign_pairs = &list;
    session.foreign_pairs_count = 1;
    game = start_game(&session);
    build_tick(&drawn, &v, game);
}

static void release(void)
{
    scene_release(&drawn);
    octree_game_destroy(game);
}

static const scene_marker *find_marker(scene_shape shape, size_t *count)
{
    const scene_marker *found = NULL;
    *count = 0;
    for (size_t i = 0; i < drawn.markers.count; i++)
        if (drawn.markers.items[i].style.layer == LAYER_WRONG && drawn.markers.items[i].shape == (uint8_t)shape) {
            found = &drawn.markers.items[i];
            ++*count;
        }
    return found;
}

static void assert_marker(scene_shape shape, theme_role role, const double at[3])
{
    size_t count;
    const scene_marker *found = find_marker(shape, &count);
    assert_int_equal(count, 1);
    assert_true(found->style.role == role && same_position(found->at, at));
}

static const char *text_of(scene_kind kind, size_t index)
{
    static element_subject subject;
    subject = describe_element(game, NULL, &drawn, (scene_element){.kind = kind, .index = index});
    return subject.text;
}

/* The missing pair has its marker in the overlap, the extra pair in the gap. Lines lead to the bodies. */
static void missing_and_extra_pairs_are_marked(void **state)
{
    (void)state;
    draw_pairs((const octree_pair[]){{3, 2}}, 1);
    const double overlap[] = {1.5, 0, 0}, gap[] = {6.5, 0, 0};
    assert_marker(SHAPE_TRIANGLE, ROLE_MISSED, overlap);
    assert_marker(SHAPE_WEDGE, ROLE_WRONG, gap);
    assert_marker(SHAPE_RING, ROLE_WRONG, overlap);
    assert_int_equal(count_layer(&drawn, LAYER_WRONG).segments, 4);
    for (size_t i = 0; i < 2; i++) {
        const double *marker = i ? gap : overlap;
        const size_t first = 1 + i;
        for (size_t end = first - 1; end <= first; end++)
            assert_int_equal(count_lines_between(&drawn, LAYER_WRONG, UINT64_C(1) << 63 | (2 * i + end + 1 - first),
                                                 end < first ? bodies[end].position : marker,
                                                 end < first ? marker : bodies[end].position),
                             1);
    }
    assert_true(has_label_with(&drawn, "1 missing, 1 extra"));
    release();
}

static void legend_explains_the_marks(void **state)
{
    (void)state;
    draw_pairs((const octree_pair[]){{3, 2}}, 1);
    assert_true(find_text(&drawn, "wrong answer") && find_text(&drawn, "missing pair"));
    assert_true(find_text(&drawn, "extra pair") && !find_text(&drawn, "missing point"));
    release();
    draw_pairs((const octree_pair[]){{2, 1}}, 1);
    assert_false(find_text(&drawn, "wrong answer") || find_text(&drawn, "missing pair"));
    assert_int_equal(count_layer(&drawn, LAYER_WRONG).markers, 0);
    release();
}

/* The ring of a floor and a body is between them, not at the middle of their centres. */
static void ring_of_a_pair_that_is_given_twice_is_between_its_bodies(void **state)
{
    (void)state;
    draw_pairs((const octree_pair[]){{1, 2}, {2, 1}}, 2);
    assert_marker(SHAPE_RING, ROLE_WRONG, (double[]){1.5, 0, 0});
    assert_true(has_label_with(&drawn, "1 and 2 twice"));
    release();
    draw_pairs((const octree_pair[]){{1, 2}, {3, 4}}, 2);
    assert_marker(SHAPE_RING, ROLE_WRONG, (double[]){9, 0, -3});
    release();
}

/* Without a known body there is no ring, but the column tells the error. */
static void ring_of_an_unknown_id_is_at_the_body_beside_it(void **state)
{
    (void)state;
    draw_pairs((const octree_pair[]){{1, 2}, {3, 77}}, 2);
    assert_marker(SHAPE_RING, ROLE_WRONG, bodies[2].position);
    release();
    size_t count;
    draw_pairs((const octree_pair[]){{1, 2}, {66, 77}}, 2);
    assert_null(find_marker(SHAPE_RING, &count));
    assert_true(has_label_with(&drawn, "no body has id 66") && !find_text(&drawn, "wrong answer"));
    release();
}

static void marks_are_described(void **state)
{
    (void)state;
    size_t found[4] = {0};
    draw_pairs((const octree_pair[]){{3, 2}}, 1);
    for (size_t i = 0; i < drawn.markers.count; i++) {
        found[0] += strcmp(text_of(SCENE_MARKER, i), "the missing pair of body 1 and body 2: their boxes overlap, but "
                                                     "the foreign index did not find the pair") == 0;
        found[1] += strcmp(text_of(SCENE_MARKER, i), "the extra pair of body 2 and body 3: the foreign index found the "
                                                     "pair, but their boxes do not overlap") == 0;
        found[2] += strcmp(text_of(SCENE_MARKER, i),
                           "the ring around the foreign pairs, which are wrong: 1 missing, 1 extra") == 0;
    }
    for (size_t i = 0; i < drawn.labels.count; i++)
        found[3] += strstr(text_of(SCENE_LABEL, i), "about the foreign pairs, which are wrong: 1 missing") != NULL;
    for (int i = 0; i < 4; i++)
        assert_int_equal(found[i], 1);
    release();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(missing_and_extra_pairs_are_marked),
        cmocka_unit_test(legend_explains_the_marks),
        cmocka_unit_test(ring_of_a_pair_that_is_given_twice_is_between_its_bodies),
        cmocka_unit_test(ring_of_an_unknown_id_is_at_the_body_beside_it),
        cmocka_unit_test(marks_are_described),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
