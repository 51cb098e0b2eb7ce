/* SPDX-License-Identifier: MIT */
/* test_greyscale.c - with the picture turned to greys, a collision can still be recognized: by different shapes, not
 * only by different colours.
 *
 * A frame is turned to greys by the weights of Rec. 601, and then to the set of bright pixels, which stand out from the
 * background. A line that only changes its colour has the same bright pixels as before. */
#include "frames.h"
#include "layer.h"

#include <stdlib.h>
#include <string.h>

#define STANDS_OUT 48 /* difference from the background, of 255 greys */
#define AT_LEAST                                                                                                       \
    16 /* pixels, times the unit of line widths; where everything around is bright, most of a cross does not count */

static int grey_of(uint8_t index)
{
    const theme_color c = theme_color_at(index);
    return (299 * c.r + 587 * c.g + 114 * c.b) / 1000;
}

static bool is_lit(uint8_t index)
{
    return abs(grey_of(index) - grey_of(theme_color_index(ROLE_BACKGROUND, 0))) >= STANDS_OUT;
}

/* The number of pixels that are bright in only one of two frames. */
static size_t count_unlike(const uint8_t *a, const uint8_t *b, size_t pixels)
{
    size_t unlike = 0;
    for (size_t i = 0; i < pixels; i++)
        unlike += is_lit(a[i]) != is_lit(b[i]);
    return unlike;
}

/* Remove all signs of a collision except the outline of its box, which has an outline in free flight, too. */
static void leave_red_alone(scene *s)
{
    size_t kept = 0;
    for (size_t i = 0; i < s->segments.count; i++)
        if (s->segments.items[i].style.role != ROLE_COLLISION)
            s->segments.items[kept++] = s->segments.items[i];
    s->segments.count = kept;
    kept = 0;
    for (size_t i = 0; i < s->markers.count; i++)
        if (s->markers.items[i].style.role != ROLE_COLLISION)
            s->markers.items[kept++] = s->markers.items[i];
    s->markers.count = kept;
}

/* Also give the outline another colour. */
static void leave_nothing_red(scene *s)
{
    leave_red_alone(s);
    for (size_t i = 0; i < s->boxes.count; i++)
        if (s->boxes.items[i].style.role == ROLE_COLLISION)
            s->boxes.items[i].style.role = ROLE_PLAYER;
}

static uint8_t *draw_changed(renderer *r, const octree_game *game, const view *v, void (*change)(scene *))
{
    scene s = {0};
    build_tick(&s, v, game);
    if (change)
        change(&s);
    uint8_t *frame = draw(r, &s);
    scene_release(&s);
    return frame;
}

static void check_collision(renderer *r, const octree_game *game, const view *v)
{
    const size_t pixels = (size_t)v->width * (size_t)v->height;
    uint8_t *told = draw_changed(r, game, v, NULL);
    uint8_t *red = draw_changed(r, game, v, leave_red_alone);
    uint8_t *plain = draw_changed(r, game, v, leave_nothing_red);
    const size_t unit = (size_t)view_pixels_per_unit(v);
    assert_true(count_unlike(told, plain, pixels) >= AT_LEAST * unit);
    assert_true(memcmp(red, plain, pixels) != 0);
    assert_int_equal(count_unlike(red, plain, pixels), 0); /* the red colour alone would not be enough */
    free(told);
    free(red);
    free(plain);
}

/* Check the first collisions of a session with every camera. Returns the number of checks. */
static size_t check_collisions(const octree_session *session, int width, int height, size_t most)
{
    renderer *r = open_renderer(width, height);
    octree_game *game = start_game(session);
    size_t collisions = 0;
    for (;; play_tick(game)) {
        for (int camera = 0; octree_game_tick(game)->hit_count && camera < CAMERA_COUNT; camera++, collisions++) {
            /* without text, which names the collision, and without the leaves of the hit points */
            const view v = view_of(width, height, (view_camera)camera,
                                   VIEW_DEFAULT_LAYERS & ~(1u << LAYER_TEXT | 1u << LAYER_HIT));
            check_collision(r, game, &v);
        }
        if (octree_game_over(game) || collisions >= most * CAMERA_COUNT)
            break;
    }
    octree_game_destroy(game);
    renderer_close(r);
    return collisions;
}

static void collided_step_is_recognizable_without_colour(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    assert_true(check_collisions(&session, 640, 360, 4) == 4 * CAMERA_COUNT);
    assert_true(check_collisions(&session, 1280, 720, 1) == CAMERA_COUNT);
}

/* The player does not move: its own box, at its place, shows the collision. */
static void collision_with_a_waiting_player_is_recognizable_without_colour(void **state)
{
    (void)state;
    static const octree_game_body body[] = {{.id = 1, .position = {3, 0, 0}, .velocity = {-1, 0, 0}}};
    octree_session session = small_session(body, 1);
    session.ticks = 5;
    assert_true(check_collisions(&session, 640, 360, 1) == CAMERA_COUNT);
}

/* The word in the panel and the swatch in the legend differ from their background. */
static void collision_colour_is_bright_on_panel_and_ground(void **state)
{
    (void)state;
    for (unsigned shade = 0; shade < 3; shade++) { /* in the shades of the box */
        const int red = grey_of(theme_color_index(ROLE_COLLISION, shade));
        assert_true(red - grey_of(theme_color_index(ROLE_PANEL, 0)) >= STANDS_OUT);
        assert_true(is_lit(theme_color_index(ROLE_COLLISION, shade)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(collided_step_is_recognizable_without_colour),
        cmocka_unit_test(collision_with_a_waiting_player_is_recognizable_without_colour),
        cmocka_unit_test(collision_colour_is_bright_on_panel_and_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
