/* SPDX-License-Identifier: MIT */
/* test_clip.c - a clipped quad stays in its square and keeps its pixels, except for the rounding of its corners. */
#include "fill.h"
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 64, LIMIT = SIDE * QUAD_SUBPIXELS };

static const int32_t limits[2] = {LIMIT, LIMIT};

static int32_t some_place(uint64_t *random, int32_t reach)
{
    return (int32_t)random_below(random, (uint64_t)(LIMIT + 2 * reach + 1)) - reach;
}

/* A line as stroke.c makes it, or a diamond, reaching beyond the square by up to `reach`. */
static quad some_quad(uint64_t *random, int32_t reach)
{
    const int32_t half = (int32_t)(1 + random_below(random, 2000)), kind = (int32_t)random_below(random, 3);
    const int32_t x[2] = {some_place(random, reach), some_place(random, reach)};
    const int32_t y[2] = {some_place(random, reach), some_place(random, reach)};
    quad q = {.color = 1, .order = 7, .index = 9};
    for (int i = 0; i < 4; i++) {
        const int end = i == 1 || i == 2, off = i < 2 ? -half : half;
        q.x[i] = kind == 2 ? x[0] + (i == 0 ? -half : i == 2 ? half : 0) : kind == 1 ? x[end] + off : x[end];
        q.y[i] = kind == 2 ? y[0] + (i == 1 ? -half : i == 3 ? half : 0) : kind == 0 ? y[end] + off : y[end];
    }
    return q;
}

/* Whether the centre of a pixel is within 2/256 pixel of the line through an edge. */
static bool is_near_an_edge(const quad *q, int64_t x, int64_t y)
{
    for (int i = 0; i < 4; i++) {
        const int j = (i + 1) % 4;
        const int64_t dx = (int64_t)q->x[j] - q->x[i], dy = (int64_t)q->y[j] - q->y[i];
        const int64_t off = dx * (y - q->y[i]) - dy * (x - q->x[i]); /* distance times length */
        const int64_t longer = llabs(dx) > llabs(dy) ? llabs(dx) : llabs(dy);
        if (llabs(off) <= 2 * longer)
            return true;
    }
    return false;
}

static void assert_keeps_pixels(const quad *q, const quad *pieces, int count)
{
    static uint8_t whole[SIDE * SIDE], clipped[SIDE * SIDE];
    const renderer_part all = {0, 0, SIDE, SIDE};
    memset(whole, 0, sizeof whole);
    memset(clipped, 0, sizeof clipped);
    fill_quads(q, 1, all, whole);
    fill_quads(pieces, (size_t)count, all, clipped);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            if (whole[y * SIDE + x] != clipped[y * SIDE + x])
                assert_true(is_near_an_edge(q, x * 256 + 128, y * 256 + 128));
}

static void assert_inside(const quad *q)
{
    for (int i = 0; i < 4; i++)
        assert_true(q->x[i] >= 0 && q->y[i] >= 0 && q->x[i] <= LIMIT && q->y[i] <= LIMIT);
}

static void clipping_keeps_the_visible_pixels_of_a_quad(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int round = 0; round < 20000; round++) {
        const quad q = some_quad(&random, 1 << (round % 20));
        quad pieces[CLIP_PIECES];
        const int count = clip_quad(&q, limits, pieces);
        assert_true(count >= 0 && count <= CLIP_PIECES);
        for (int i = 0; i < count; i++) {
            assert_inside(&pieces[i]);
            assert_true(pieces[i].color == 1 && pieces[i].order == 7 && pieces[i].index == 9);
        }
        assert_keeps_pixels(&q, pieces, count);
    }
}

static void quad_inside_the_square_is_unchanged(void **state)
{
    (void)state;
    uint64_t random = 1;
    const quad whole = {.x = {0, LIMIT, LIMIT, 0}, .y = {0, 0, LIMIT, LIMIT}};
    quad pieces[CLIP_PIECES];
    assert_int_equal(clip_quad(&whole, limits, pieces), 1);
    assert_memory_equal(pieces[0].x, whole.x, sizeof whole.x);
    for (int round = 0; round < 1000; round++) {
        const quad q = some_quad(&random, -2000);
        if (clip_quad(&q, limits, pieces) != 1)
            fail();
        assert_memory_equal(pieces[0].x, q.x, sizeof q.x);
        assert_memory_equal(pieces[0].y, q.y, sizeof q.y);
    }
}

static void fill_clipped(const quad *q, uint8_t *bytes)
{
    quad pieces[CLIP_PIECES];
    const int count = clip_quad(q, limits, pieces);
    memset(bytes, 0, SIDE * SIDE);
    fill_quads(pieces, (size_t)count, (renderer_part){0, 0, SIDE, SIDE}, bytes);
}

/* Adjacent quads still share their edge after clipping: no pixel is in both or in neither. */
static void edge_is_cut_at_the_same_place_in_both_directions(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int round = 0; round < 2000; round++) {
        static uint8_t over[SIDE * SIDE], under[SIDE * SIDE], together[SIDE * SIDE];
        const int32_t x[2] = {some_place(&random, LIMIT), some_place(&random, LIMIT)};
        const int32_t y[2] = {some_place(&random, LIMIT), some_place(&random, LIMIT)}, half = 900;
        const quad above = {.x = {x[0], x[1], x[1], x[0]}, .y = {y[0], y[1], y[1] - half, y[0] - half}, .color = 1};
        const quad below = {.x = {x[1], x[0], x[0], x[1]}, .y = {y[1], y[0], y[0] + half, y[1] + half}, .color = 1};
        const quad both = {
            .x = {x[0], x[1], x[1], x[0]}, .y = {y[0] - half, y[1] - half, y[1] + half, y[0] + half}, .color = 1};
        fill_clipped(&above, over);
        fill_clipped(&below, under);
        fill_clipped(&both, together);
        for (int i = 0; i < SIDE * SIDE; i++)
            assert_int_equal(over[i] + under[i], together[i]);
    }
}

static void rectangles_of_any_size_are_clipped(void **state)
{
    (void)state;
    const int32_t far = INT32_MAX;
    const quad all = {.x = {-far - 1, far, far, -far - 1}, .y = {-far - 1, -far - 1, far, far}, .color = 1};
    static uint8_t filled[SIDE * SIDE];
    const quad outside = {.x = {far - 9, far, far, far - 9}, .y = {0, 0, LIMIT, LIMIT}};
    quad pieces[CLIP_PIECES];
    assert_int_equal(clip_quad(&all, limits, pieces), 1);
    fill_clipped(&all, filled);
    for (int i = 0; i < SIDE * SIDE; i++)
        assert_int_equal(filled[i], 1);
    assert_int_equal(clip_quad(&outside, limits, pieces), 0);
}

static void clip_square_is_a_power_of_two_around_the_picture(void **state)
{
    (void)state;
    assert_int_equal(enclosing_power_of_two(1, 1), 1);
    assert_int_equal(enclosing_power_of_two(1280, 720), 2048);
    assert_int_equal(enclosing_power_of_two(64, 1024), 1024);
    assert_int_equal(enclosing_power_of_two(VIEW_MAX_SIDE, 1), VIEW_MAX_SIDE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clipping_keeps_the_visible_pixels_of_a_quad),
        cmocka_unit_test(quad_inside_the_square_is_unchanged),
        cmocka_unit_test(edge_is_cut_at_the_same_place_in_both_directions),
        cmocka_unit_test(rectangles_of_any_size_are_clipped),
        cmocka_unit_test(clip_square_is_a_power_of_two_around_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
