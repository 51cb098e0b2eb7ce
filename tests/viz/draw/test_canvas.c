/* SPDX-License-Identifier: MIT */
/* test_canvas.c - quads that are not filled again, because they did not change, are in the picture all the same. */
#include "frames.h"
#include "fill.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 128 };

/* Draw a whole recording with one renderer, and each of its frames with a new one. */
static void check_flight(view_camera camera)
{
    const view v = view_of(320, 200, camera, VIEW_ALL_LAYERS);
    octree_session session = session_with_all_layers();
    octree_game *game;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    renderer *kept = open_renderer(v.width, v.height);
    for (int tick = 0; tick < 40; tick++) {
        scene s = {0};
        build_tick(&s, &v, game);
        renderer *fresh = open_renderer(v.width, v.height);
        uint8_t *again = draw(kept, &s), *first = draw(fresh, &s);
        assert_same_frame(again, first, &s);
        free(again);
        free(first);
        renderer_close(fresh);
        scene_release(&s);
        if (tick % 4)
            play_tick(game);
    }
    renderer_close(kept);
    octree_game_destroy(game);
}

static void frame_does_not_depend_on_earlier_frames(void **state)
{
    (void)state;
    check_flight(CAMERA_ISO);
    check_flight(CAMERA_ORBIT);
    check_flight(CAMERA_FOLLOW);
}

/* Add quads of one pixel each, from left to right and from top to bottom. */
static void add_pixels(quad_list *list, size_t count, uint8_t color)
{
    for (size_t end = list->count + count; list->count < end;) {
        const int32_t x = (int32_t)(list->count % SIDE) * QUAD_SUBPIXELS, right = x + QUAD_SUBPIXELS;
        const int32_t y = (int32_t)(list->count / SIDE) * QUAD_SUBPIXELS, bottom = y + QUAD_SUBPIXELS;
        quads_add_quad(list, &(quad){.x = {x, right, right, x}, .y = {y, y, bottom, bottom}, .color = color});
    }
}

static void assert_fills(canvas *c, const quad_list *list, size_t filled)
{
    static uint8_t indices[SIDE * SIDE];
    quad_list copy = {0}; /* the canvas keeps the copy */
    memset(indices, 77, sizeof indices);
    for (size_t i = 0; i < list->count; i++)
        quads_add_quad(&copy, &list->items[i]);
    assert_int_equal(canvas_fill_quads(c, &copy, indices), filled);
    quads_release(&copy);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        assert_int_equal(indices[i], i < list->count ? list->items[i].color : 0);
}

static void common_beginning_of_frames_is_drawn_only_twice(void **state)
{
    (void)state;
    canvas c = {.width = SIDE, .height = SIDE};
    quad_list list = {0};
    assert_fills(&c, &list, 0);
    add_pixels(&list, 1000, 3);
    add_pixels(&list, 100, 4);
    assert_fills(&c, &list, 1100);
    for (uint8_t color = 5; color < 9; color++) { /* the last quads change */
        for (size_t i = 1000; i < 1100; i++)
            list.items[i].color = color;
        assert_fills(&c, &list, color == 5 ? 1100 : 100);
    }
    list.items[500].x[2]++; /* then a quad before them */
    assert_fills(&c, &list, 1100);
    list.items[1099].color = 9;
    assert_fills(&c, &list, 600); /* only the quads before the change are kept */
    list.items[1099].color = 10;
    assert_fills(&c, &list, 1);
    list.count = 300;
    assert_fills(&c, &list, 300);
    list.count = 0;
    assert_fills(&c, &list, 0);
    quads_release(&list);
    canvas_release(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frame_does_not_depend_on_earlier_frames),
        cmocka_unit_test(common_beginning_of_frames_is_drawn_only_twice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
