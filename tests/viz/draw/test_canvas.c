/* SPDX-License-Identifier: MIT */
/* test_canvas.c - what is not sent to the rasteriser, or not sent again, is drawn all the same. */
#include "frames.h"
#include "canvas.h"
#include "layer.h"
#include "octree/sample.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 128 };

/* ---- Against GL --------------------------------------------------------------------------------------------- */

/* Where a line ends: in the picture with all of its width, and often on the edge or the centre of a pixel, so that many
 * edges meet centres. */
static double some_place(uint64_t *random)
{
    const uint64_t steps = octree_random(random) & 1 ? 256 : 2;
    return 2 + (double)(octree_random(random) % ((SIDE - 4) * steps)) / (double)steps;
}

static void add_lines(scene *s, uint64_t *random, uint64_t count)
{
    for (uint64_t i = 0; i < count; i++) {
        const uint8_t role = (uint8_t)(1 + octree_random(random) % (ROLE_COUNT - 1));
        const uint8_t width = (uint8_t)(1 + octree_random(random) % 4), style = octree_random(random) % 8 == 0;
        scene_add_segment(
            s, (scene_segment){
                   .id = i,
                   .in_picture = true,
                   .style = {.layer = LAYER_TEXT, .role = role, .stroke = style, .width = width},
                   .ends = {{some_place(random), some_place(random)}, {some_place(random), some_place(random)}},
               });
    }
}

/* Lines that are upright: rectangles, of which many begin or end on the centres of pixels. */
static void add_upright_lines(scene *s, uint64_t *random, uint64_t count)
{
    for (uint64_t i = 0; i < count; i++) {
        const unsigned axis = octree_random(random) & 1, style = octree_random(random) % 8 == 0;
        const double at = (double)(octree_random(random) % (SIDE * 256)) / 256;
        const double half = (double)(octree_random(random) % (SIDE * 2)) / 2;
        const double from = octree_random(random) & 1 ? at : half, to = octree_random(random) % (2 * SIDE) - SIDE / 2.0;
        scene_segment line = {.id = i,
                              .in_picture = true,
                              .style = {.layer = LAYER_TEXT,
                                        .role = (uint8_t)(1 + octree_random(random) % (ROLE_COUNT - 1)),
                                        .stroke = style ? STROKE_DASHED : STROKE_SOLID,
                                        .width = (uint8_t)(1 + octree_random(random) % 4)}};
        line.ends[0][axis] = from;
        line.ends[1][axis] = to;
        line.ends[0][1 - axis] = line.ends[1][1 - axis] = octree_random(random) & 1 ? at : half;
        scene_add_segment(s, line);
    }
}

/* A diamond that comes last sends all before it to GL: they are too few to be filled first. */
static void check_against_gl(void (*add)(scene *s, uint64_t *random, uint64_t count))
{
    uint64_t random = 1;
    view v = view_of(SIDE, SIDE, CAMERA_TOP, VIEW_ALL_LAYERS);
    const octree_box world = cube(-1, 1);
    v.diagram = DIAGRAM_BESIDE; /* the one layer above the text */
    renderer *r = open_renderer(SIDE, SIDE), *other = open_renderer(SIDE, SIDE);
    for (int round = 0; round < 200; round++) {
        scene s = empty_scene(&v, &world);
        double middle[2];
        add(&s, &random, 30);
        uint8_t *filled = draw(r, &s);
        scene_add_marker(&s, (scene_marker){.shape = SHAPE_DIAMOND,
                                            .at = {0, 0, 0},
                                            .style = {.layer = LAYER_DIAGRAM, .role = ROLE_TEXT, .width = 4}});
        uint8_t *sent = draw(other, &s);
        pixel_of(&s, (const double[3]){0, 0, 0}, middle);
        assert_int_equal(sent[(int)middle[1] * SIDE + (int)middle[0]] / THEME_SHADES, ROLE_TEXT);
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++)
                if (abs(x - (int)middle[0]) > 5 || abs(y - (int)middle[1]) > 5)
                    assert_int_equal(filled[y * SIDE + x], sent[y * SIDE + x]);
        free(filled);
        free(sent);
        scene_release(&s);
    }
    renderer_close(other);
    renderer_close(r);
}

static void upright_rectangles_are_filled_as_gl_fills_them(void **state)
{
    (void)state;
    check_against_gl(add_upright_lines);
}

static void lines_are_filled_as_gl_fills_them(void **state)
{
    (void)state;
    check_against_gl(add_lines);
}

/* ---- From frame to frame ------------------------------------------------------------------------------------ */

/* One renderer for a whole flight, and for each of its frames a new one. */
static void check_flight(view_camera camera)
{
    const view v = view_of(320, 200, camera, VIEW_ALL_LAYERS);
    octree_session session = asking_session();
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

static void a_renderer_draws_the_same_whatever_it_drew_before(void **state)
{
    (void)state;
    check_flight(CAMERA_ISO);
    check_flight(CAMERA_ORBIT);
    check_flight(CAMERA_FOLLOW);
}

/* ---- What is sent ------------------------------------------------------------------------------------------- */

/* A rasteriser that lights the pixel of a quad's first corner, and counts. */
typedef struct pen {
    size_t sent, calls;
    bool fails;
} pen;

static bool dot_quads(void *context, const quad *quads, size_t count, uint8_t ground, int first, int end,
                      uint8_t *indices, octreel_error *error)
{
    pen *p = context;
    if (p->fails)
        return error_set(error, "no ink");
    p->sent += count;
    p->calls++;
    memset(indices + first * SIDE, ground, (size_t)(end - first) * SIDE);
    for (size_t i = 0; i < count; i++) {
        const int x = quads[i].x[0] / QUAD_SUBPIXELS, y = quads[i].y[0] / QUAD_SUBPIXELS;
        assert_true(y >= first && y < end);
        indices[y * SIDE + x] = quads[i].color;
    }
    return true;
}

/* Slanted: nothing that is filled. */
static quad slanted(size_t i, uint8_t color)
{
    const int32_t x = (int32_t)(i % SIDE) * QUAD_SUBPIXELS, y = (int32_t)(i / SIDE % SIDE) * QUAD_SUBPIXELS;
    return (quad){.x = {x, x + 9, x + 5, x}, .y = {y, y + 3, y + 8, y + 1}, .color = color};
}

static void add_slanted(quad_list *list, size_t count, uint8_t color)
{
    const quad_list all = *list;
    for (size_t i = all.count; i < all.count + count; i++) {
        const quad q = slanted(i, color);
        quads_add(list, &q);
    }
}

static void assert_drawn(const uint8_t *indices, const quad_list *list)
{
    for (size_t i = 0; i < SIDE * SIDE; i++)
        assert_int_equal(indices[i], i < list->count ? list->items[i].color : 0);
}

static void draw_list(canvas *c, pen *p, const quad_list *list, size_t sent)
{
    static uint8_t indices[SIDE * SIDE];
    quad_list copy = {0}; /* which the canvas keeps */
    octreel_error error = {""};
    memset(indices, 77, sizeof indices);
    p->sent = p->calls = 0;
    for (size_t i = 0; i < list->count; i++)
        quads_add(&copy, &list->items[i]);
    assert_true(canvas_draw(c, &copy, dot_quads, p, indices, &error));
    quads_release(&copy);
    assert_drawn(indices, list);
    assert_int_equal(p->sent, sent);
}

static void what_frames_begin_with_alike_is_sent_twice_and_then_no_more(void **state)
{
    (void)state;
    canvas c = {.width = SIDE, .height = SIDE};
    pen p = {0};
    quad_list list = {0};
    draw_list(&c, &p, &list, 0);
    add_slanted(&list, 1000, 3);
    add_slanted(&list, 100, 4);
    draw_list(&c, &p, &list, 1100);
    for (uint8_t color = 5; color < 9; color++) { /* what comes last changes */
        for (size_t i = 1000; i < 1100; i++)
            list.items[i].color = color;
        draw_list(&c, &p, &list, color == 5 ? 1100 : 100);
    }
    list.items[500].x[3]++; /* and then something before it */
    draw_list(&c, &p, &list, 1100);
    list.items[1099].color = 9;
    draw_list(&c, &p, &list, 600); /* what is kept ends where it changed */
    list.items[1099].color = 10;
    draw_list(&c, &p, &list, 1);
    list.count = 300;
    draw_list(&c, &p, &list, 300);
    list.count = 0;
    draw_list(&c, &p, &list, 0);
    quads_release(&list);
    canvas_release(&c);
}

/* Lines, then points that hide some of them, then lines on top: only lines are sent. */
static void many_rectangles_are_filled_between_what_is_sent(void **state)
{
    (void)state;
    enum { POINTS = 3000, FIRST_POINT = 100, ON_TOP = 200 };
    canvas c = {.width = SIDE, .height = SIDE};
    pen p = {0};
    quad_list list = {0};
    uint8_t indices[SIDE * SIDE];
    add_slanted(&list, 150, 3);
    for (int i = FIRST_POINT; i < FIRST_POINT + POINTS; i++) {
        const int32_t x = i % SIDE * QUAD_SUBPIXELS, y = i / SIDE * QUAD_SUBPIXELS;
        const int32_t right = x + QUAD_SUBPIXELS, bottom = y + QUAD_SUBPIXELS;
        quads_add(&list, &(quad){.x = {x, right, right, x}, .y = {y, y, bottom, bottom}, .color = 4});
    }
    for (size_t i = 0; i < ON_TOP; i++) {
        const quad q = slanted(i, 5);
        quads_add(&list, &q);
    }
    octreel_error error = {""};
    assert_true(canvas_draw(&c, &list, dot_quads, &p, indices, &error));
    assert_int_equal(p.sent, 150 + ON_TOP);
    assert_int_equal(p.calls, 2);
    for (int i = 0; i < SIDE * SIDE; i++)
        assert_int_equal(indices[i], i < ON_TOP ? 5 : i < FIRST_POINT + POINTS ? 4 : 0);
    quads_release(&list);
    canvas_release(&c);
}

static void a_rasteriser_that_fails_is_told_of(void **state)
{
    (void)state;
    canvas c = {.width = SIDE, .height = SIDE};
    pen p = {.fails = true};
    quad_list list = {0};
    uint8_t indices[SIDE * SIDE];
    add_slanted(&list, 10, 3);
    octreel_error error = {""};
    assert_false(canvas_draw(&c, &list, dot_quads, &p, indices, &error));
    assert_string_equal(error.text, "no ink");
    quads_release(&list);
    canvas_release(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(upright_rectangles_are_filled_as_gl_fills_them),
        cmocka_unit_test(lines_are_filled_as_gl_fills_them),
        cmocka_unit_test(a_renderer_draws_the_same_whatever_it_drew_before),
        cmocka_unit_test(what_frames_begin_with_alike_is_sent_twice_and_then_no_more),
        cmocka_unit_test(many_rectangles_are_filled_between_what_is_sent),
        cmocka_unit_test(a_rasteriser_that_fails_is_told_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
