/* SPDX-License-Identifier: MIT */
/* test_text_boxes.c - text draws no pixel outside its reported boxes. */
#include "frames.h"
#include "letters.h"
#include "layer.h"

#include <stdlib.h>
#include <string.h>

/* The pixels of a picture that lie in a box. */
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
    visit_text_boxes(s, cover, &m);
    return m;
}

/* The test fails unless a scene, drawn with text and without, differs, and only inside the boxes. */
static void check_scene(scene *s)
{
    const mask m = cover_text(s);
    const size_t side = (size_t)s->view.aa, width = (size_t)m.width * side;
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
    const octree_session session = session_with_all_layers();
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

static void keep_box(const draw_box *box, void *context)
{
    *(draw_box *)context = *box;
}

/* With a rim, the same words have a box that is larger on all sides, and the quads of letters and rim. */
static void letters_have_a_rim(void **state)
{
    (void)state;
    scene s = {.refused = 0};
    quad_list plain = {.count = 0}, rimmed = {.count = 0};
    draw_box boxes[2];
    const view v = view_of(640, 360, CAMERA_TOP, VIEW_ALL_LAYERS);
    scene_set_view(&s, &v);
    scene_add_label(&s,
                    (scene_label){.at = {50, 60}, .style = {.layer = LAYER_WORLD, .role = ROLE_FAINT}, .text = "17"});
    add_label_letters(&plain, &s, &s.labels.items[0]);
    visit_text_boxes(&s, keep_box, &boxes[0]);
    s.labels.items[0].style.stroke = STROKE_CUT;
    add_label_letters(&rimmed, &s, &s.labels.items[0]);
    visit_text_boxes(&s, keep_box, &boxes[1]);
    assert_int_equal(rimmed.count, 2 * plain.count);
    for (size_t i = 0; i < plain.count; i++) {
        assert_int_equal(rimmed.items[i].color, theme_color_index(ROLE_BACKGROUND, 0));
        assert_true(rimmed.items[i].x[0] < plain.items[i].x[0] && rimmed.items[i].y[2] > plain.items[i].y[2]);
        assert_memory_equal(rimmed.items[plain.count + i].x, plain.items[i].x, sizeof plain.items[i].x);
    }
    assert_true(boxes[1].x < boxes[0].x && boxes[1].width > boxes[0].width && boxes[1].height > boxes[0].height);
    quads_release(&plain);
    quads_release(&rimmed);
    scene_release(&s);
}

/* For example the ranks of neighbours in a close-up. */
static void labels_at_the_border_are_not_cut(void **state)
{
    (void)state;
    static const octree_box world = {{-1, -1, -1}, {1, 1, 1}};
    const view v = view_of(100, 100, CAMERA_TOP, 1u << LAYER_KNEAREST);
    scene s = {.refused = 0};
    scene_set_view(&s, &v);
    s.camera = camera_make(&v, (camera_window){0, 0, 100, 100}, &world, (double[]){0, 0, 0}, 0);
    size_t seen = 0;
    for (double x = -4; x < 4; x += 0.01) {
        double pixel[2];
        draw_box box = {.width = 0};
        s.labels.count = 0;
        scene_add_label(&s, (scene_label){.in_world = true,
                                          .at = {x, -x, 0},
                                          .style = {.layer = LAYER_KNEAREST, .role = ROLE_KNEAREST},
                                          .text = "12"});
        if (!camera_find_pixel(&s.camera, s.labels.items[0].at, pixel) || !(pixel[0] > 8 && pixel[0] < 100))
            continue;
        visit_text_boxes(&s, keep_box, &box);
        assert_true(box.width > 0 && box.x + box.width <= 100 && box.y + box.height <= 100);
        seen++;
    }
    assert_true(seen > 10);
    scene_release(&s);
}

static void scene_without_text_has_no_boxes(void **state)
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
        cmocka_unit_test(letters_have_a_rim),
        cmocka_unit_test(labels_at_the_border_are_not_cut),
        cmocka_unit_test(text_stays_within_its_boxes),
        cmocka_unit_test(scene_without_text_has_no_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
