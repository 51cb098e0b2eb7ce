/* SPDX-License-Identifier: MIT */
/* test_text_boxes.c - text lights no pixel outside the boxes that are told of it. */
#include "frames.h"
#include "letters.h"
#include "layer.h"

#include <stdlib.h>
#include <string.h>

/* A picture's pixels that lie in a box. */
typedef struct mask {
    uint8_t *covered;
    int width, height;
    size_t boxes;
} mask;

static void cover(const draw_box *box, void *context)
{
    mask *m = context;
    m->boxes++;
    for (int y = box->y; y < box->y + box->height; y++)
        for (int x = box->x; x < box->x + box->width; x++)
            if (x >= 0 && y >= 0 && x < m->width && y < m->height)
                m->covered[(size_t)y * (size_t)m->width + (size_t)x] = 1;
}

static mask cover_text(const scene *s)
{
    mask m = {.width = s->view.width, .height = s->view.height};
    m.covered = calloc((size_t)m.width, (size_t)m.height);
    assert_non_null(m.covered);
    draw_text_boxes(s, cover, &m);
    return m;
}

/* Drawn with its text and without, a scene differs inside the boxes alone, and somewhere there. */
static void check_scene(scene *s)
{
    const mask m = cover_text(s);
    const size_t side = (size_t)view_samples(&s->view), width = (size_t)m.width * side;
    uint8_t *with = draw_once(s);
    s->labels.count = s->panels.count = 0;
    uint8_t *without = draw_once(s);
    size_t changed = 0, outside = 0;
    for (size_t i = 0; i < frame_samples(s); i++) {
        changed += with[i] != without[i];
        outside += with[i] != without[i] && !m.covered[i / width / side * (size_t)m.width + i % width / side];
    }
    assert_true(m.boxes > 0 && changed > 0);
    assert_int_equal(outside, 0);
    free(with);
    free(without);
    free(m.covered);
}

static void text_stays_within_its_boxes(void **state)
{
    (void)state;
    static const int sizes[][2] = {{640, 360}, {320, 640}, {200, 120}, {1280, 720}, {40, 30}};
    const octree_session session = asking_session();
    octree_game *game;
    assert_int_equal(octree_game_create(&session, &game), OCTREE_OK);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int camera = 0; camera < CAMERA_COUNT; camera++) {
            view v = view_of(sizes[i][0], sizes[i][1], (view_camera)camera, VIEW_ALL_LAYERS);
            scene s = {.refused = 0};
            v.labels = true;
            v.aa = 1 << (i + (size_t)camera) % 3;
            build_tick(&s, &v, game);
            check_scene(&s);
            scene_release(&s);
        }
        play_tick(game);
    }
    octree_game_destroy(game);
}

static void a_scene_without_text_has_no_boxes(void **state)
{
    (void)state;
    const octree_box world = cube(-1, 1);
    const view v = view_of(64, 64, CAMERA_ISO, VIEW_ALL_LAYERS);
    scene s = empty_scene(&v, &world);
    const mask m = cover_text(&s);
    assert_int_equal(m.boxes, 0);
    free(m.covered);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_stays_within_its_boxes),
        cmocka_unit_test(a_scene_without_text_has_no_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
