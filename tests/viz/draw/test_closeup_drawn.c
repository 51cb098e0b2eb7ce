/* SPDX-License-Identifier: MIT */
/* test_closeup_drawn.c - the pixels of a close-up are those of its scene, only in its part of the picture, and pick
 * finds their elements. */
#include "frames.h"
#include "layer.h"
#include "pixel.h"
#include "recording_file.h"

#include <stdlib.h>
#include <string.h>

/* A tick of the default session with a close-up. */
static scene close_scene(view_camera camera, int aa, int ticks)
{
    const octree_session session = octree_session_default();
    octree_game *game;
    scene s = {.refused = 0};
    view v = view_make_default();
    v.width = 640;
    v.height = 360;
    v.camera = camera;
    v.aa = aa;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    for (int tick = 0; tick < ticks; tick++)
        play_tick(game);
    build_tick(&s, &v, game);
    octree_game_destroy(game);
    assert_true(s.has_closeup);
    return s;
}

static uint8_t *drawn_by(const scene *s, draw_fill fill)
{
    octreel_error error = {""};
    const int samples = s->view.aa;
    renderer *r =
        renderer_open(s->view.width * samples, s->view.height * samples, &(renderer_choice){.fill = fill}, &error);
    uint8_t *indices = malloc(frame_samples(s));
    if (!r || !indices || !renderer_draw_scene(r, s, indices, &error))
        fail_msg("%s", error.text);
    renderer_close(r);
    return indices;
}

static void close_up_draws_its_scene_and_changes_no_other_pixel(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        scene s = close_scene(i % 2 ? CAMERA_FOLLOW : CAMERA_ISO, i / 2 % 2 + 1, i / 4 ? 219 : 10);
        const size_t side = (size_t)s.view.aa, width = (size_t)s.view.width * side;
        const size_t own = (size_t)s.closeup->view.width * side, rows = (size_t)s.closeup->view.height * side;
        const size_t left = (size_t)s.closeup->place[0] * side, top = (size_t)s.closeup->place[1] * side;
        uint8_t *whole = drawn_by(&s, DRAW_FILL_INTEGERS), *gl = drawn_by(&s, DRAW_FILL_GL);
        uint8_t *alone = drawn_by(s.closeup, DRAW_FILL_INTEGERS);
        s.has_closeup = false;
        uint8_t *without = drawn_by(&s, DRAW_FILL_INTEGERS);
        assert_memory_equal(whole, gl, frame_samples(&s));
        for (size_t y = 0; y < rows; y++) {
            assert_memory_equal(whole + (top + y) * width + left, alone + y * own, own);
            memcpy(without + (top + y) * width + left, alone + y * own, own);
        }
        assert_memory_equal(whole, without, frame_samples(&s));
        free(whole);
        free(gl);
        free(alone);
        free(without);
        scene_release(&s);
    }
}

/* At samples all over the picture, the element on top equals the first one that is reported for the pixel. */
static void elements_of_the_close_up_are_picked(void **state)
{
    (void)state;
    octreel_error error = {""};
    scene s = close_scene(CAMERA_ISO, 1, 219);
    renderer *r = renderer_open(s.view.width, s.view.height, &(renderer_choice){0}, &error);
    uint32_t *numbers = calloc(frame_samples(&s), sizeof *numbers);
    assert_true(renderer_find_element_numbers(r, &s, numbers, &error));
    size_t inside = 0, nodes = 0;
    for (int y = 0; y < s.view.height; y += 3)
        for (int x = 0; x < s.view.width; x += 7) {
            const uint32_t number = numbers[y * s.view.width + x];
            const int *at = s.closeup->place;
            const bool is_in =
                x >= at[0] && y >= at[1] && x < at[0] + s.closeup->view.width && y < at[1] + s.closeup->view.height;
            draw_covers list = {0};
            if (number == 0)
                continue;
            const scene_element element = scene_element_at(&s, number);
            assert_true(!element.in_closeup || is_in);
            inside += element.in_closeup;
            nodes += element.in_closeup && element.kind == SCENE_BOX;
            assert_true(renderer_list_pixel_covers(r, &s, x, y, &list, &error));
            assert_int_equal(list.items[0].number, number);
            draw_covers_release(&list);
        }
    assert_true(inside > 20 && nodes > 5);
    free(numbers);
    renderer_close(r);
    scene_release(&s);
}

/* The mask of a layer includes its elements in the close-up, and the mask of the close-up layer is all of the close-up.
 */
static void layer_mask_includes_the_close_up(void **state)
{
    (void)state;
    octreel_error error = {""};
    scene s = close_scene(CAMERA_ISO, 1, 10);
    renderer *r = renderer_open(s.view.width, s.view.height, &(renderer_choice){0}, &error);
    uint8_t *mask = malloc(frame_samples(&s));
    const int *at = s.closeup->place;
    const int middle = (at[1] + s.closeup->view.height / 2) * s.view.width + at[0] + s.closeup->view.width / 2;
    assert_true(renderer_find_layer_mask(r, &s, 1u << LAYER_PLAYER, mask, &error));
    assert_int_equal(mask[middle], 1);
    assert_true(renderer_find_layer_mask(r, &s, 1u << LAYER_CLOSEUP, mask, &error));
    for (int y = 0; y < s.closeup->view.height; y++)
        for (int x = 0; x < s.closeup->view.width; x++)
            assert_int_equal(mask[(at[1] + y) * s.view.width + at[0] + x], 1);
    free(mask);
    renderer_close(r);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(close_up_draws_its_scene_and_changes_no_other_pixel),
        cmocka_unit_test(elements_of_the_close_up_are_picked),
        cmocka_unit_test(layer_mask_includes_the_close_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
