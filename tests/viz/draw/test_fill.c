/* SPDX-License-Identifier: MIT */
/* test_fill.c - integers fill every quad with the pixels of GL, wherever its corners are. */
#include "frames.h"
#include "fill.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 128, BATCH = 40, MOST = SIDE * QUAD_SUBPIXELS };

/* Many coordinates are those of centres, edges and corners of pixels, where only the rule for ties decides. */
static int32_t some_place(uint64_t *random)
{
    static const int steps[] = {1, 1, 16, QUAD_SUBPIXELS / 2, QUAD_SUBPIXELS};
    const int step = steps[random_below(random, 5)];
    return (int32_t)random_below(random, (uint64_t)(MOST / step + 1)) * step;
}

static int32_t near_to(int32_t place, int32_t reach, uint64_t *random)
{
    const int32_t at = place - reach + (int32_t)random_below(random, 2 * (uint64_t)reach + 1);
    return at < 0 ? 0 : at > MOST ? MOST : at;
}

/* Any four corners: convex, reflex, crossed or folded, of either winding. */
static quad any_quad(uint64_t *random)
{
    quad q = {0};
    for (int i = 0; i < 4; i++) {
        q.x[i] = some_place(random);
        q.y[i] = some_place(random);
    }
    return q;
}

/* Corners within a few pixels, or a fraction of one, of each other. */
static quad small_quad(uint64_t *random)
{
    const int32_t x = some_place(random), y = some_place(random), reach = 1 << random_below(random, 11);
    quad q = {0};
    for (int i = 0; i < 4; i++) {
        q.x[i] = near_to(x, reach, random);
        q.y[i] = near_to(y, reach, random);
    }
    return q;
}

/* Two far corners, and two that are close to the line between them. */
static quad sliver(uint64_t *random)
{
    const int32_t reach = 1 << random_below(random, 9);
    quad q = any_quad(random);
    const unsigned way = (unsigned)random_below(random, 3);
    for (int i = 2; i < 4; i++) {
        const int near = way == 0 ? 3 - i : way == 1 ? i - 2 : 0;
        q.x[i] = way == 2 ? (q.x[0] + q.x[1]) / 2 : near_to(q.x[near], reach, random);
        q.y[i] = way == 2 ? (q.y[0] + q.y[1]) / 2 : near_to(q.y[near], reach, random);
    }
    return q;
}

/* Corners that coincide, or lie on a line. */
static quad degenerate(uint64_t *random)
{
    quad q = any_quad(random);
    const int one = (int)random_below(random, 4), other = (int)random_below(random, 4);
    switch (random_below(random, 4)) {
    case 0:
        q.x[one] = q.x[other];
        q.y[one] = q.y[other];
        break;
    case 1:
        q.y[one] = q.y[other];
        break;
    case 2:
        q.x[0] = q.x[1] = q.x[2] = q.x[3];
        break;
    default: /* corner 2 is on the line through 0 and 1, between them or beyond */
        q.x[1] = (q.x[0] + q.x[2]) / 2;
        q.y[1] = (q.y[0] + q.y[2]) / 2;
    }
    return q;
}

/* Lines as stroke.c makes them, diamonds and upright rectangles. */
static quad stroked(uint64_t *random)
{
    const quad any = any_quad(random);
    const int32_t half = (int32_t)(1 + random_below(random, 8)) * QUAD_SUBPIXELS / 2;
    const int32_t x[2] = {near_to(any.x[0], 0, random), any.x[1]}, y[2] = {any.y[0], any.y[1]};
    quad q = {0};
    const unsigned kind = (unsigned)random_below(random, 4);
    for (int i = 0; i < 4; i++) {
        const int end = i == 1 || i == 2, off = i < 2 ? -half : half;
        q.x[i] = kind == 1 ? x[end] + off : x[end];
        q.y[i] = kind == 0 ? y[end] + off : y[end];
        if (kind == 2)
            q.y[i] = y[i / 2];
        if (kind == 3) {
            q.x[i] = x[0] + (i == 0 ? -half : i == 2 ? half : 0);
            q.y[i] = y[0] + (i == 1 ? -half : i == 3 ? half : 0);
        }
        q.x[i] = near_to(q.x[i], 0, random);
        q.y[i] = near_to(q.y[i], 0, random);
    }
    return q;
}

static quad (*const makers[])(uint64_t *random) = {any_quad, small_quad, sliver, degenerate, stroked};
enum { MAKERS = sizeof makers / sizeof *makers };

static void assert_filled_alike(renderer *r, const quad *quads, size_t count, renderer_part part)
{
    static uint8_t by_gl[SIDE * SIDE], by_integers[SIDE * SIDE];
    octreel_error error = {""};
    if (!renderer_fill_quads(r, quads, count, part, by_gl, &error))
        fail_msg("%s", error.text);
    memset(by_integers, 0, sizeof by_integers);
    fill_quads(quads, count, part, by_integers);
    for (int i = 0; i < part.width * part.height; i++)
        if (by_gl[i] != by_integers[i]) {
            const quad *q = &quads[(by_gl[i] > by_integers[i] ? by_gl[i] : by_integers[i]) - 1];
            fail_msg("pixel %d %d: %d by GL, %d by integers; quad %d,%d %d,%d %d,%d %d,%d", i % part.width,
                     i / part.width, by_gl[i], by_integers[i], q->x[0], q->y[0], q->x[1], q->y[1], q->x[2], q->y[2],
                     q->x[3], q->y[3]);
        }
}

static void check_quads(int first, int end, int rounds)
{
    const renderer_part all = {0, 0, SIDE, SIDE};
    renderer *r = open_gl_renderer(SIDE, SIDE);
    uint64_t random = 1;
    for (int round = 0; round < rounds; round++) {
        quad quads[BATCH];
        for (int i = 0; i < BATCH; i++) {
            quads[i] = makers[first + (int)random_below(&random, (uint64_t)(end - first))](&random);
            quads[i].color = (uint8_t)(i + 1);
        }
        assert_filled_alike(r, quads, BATCH, all);
    }
    renderer_close(r);
}

static void quads_with_any_corners_are_filled_as_by_gl(void **state)
{
    (void)state;
    check_quads(0, 1, 500);
}

static void small_quads_are_filled_as_by_gl(void **state)
{
    (void)state;
    check_quads(1, 2, 1000);
}

static void slivers_are_filled_as_by_gl(void **state)
{
    (void)state;
    check_quads(2, 3, 500);
}

static void degenerate_quads_are_filled_as_by_gl(void **state)
{
    (void)state;
    check_quads(3, 4, 500);
}

static void strokes_are_filled_as_by_gl(void **state)
{
    (void)state;
    check_quads(4, 5, 500);
}

/* A part of a picture is cut off exactly at its edges. (GL clips before it rounds.) */
static void part_of_a_picture_has_the_pixels_of_the_whole(void **state)
{
    (void)state;
    static uint8_t whole[SIDE * SIDE], bytes[SIDE * SIDE];
    uint64_t random = 1;
    for (int round = 0; round < 2000; round++) {
        quad q = makers[random_below(&random, MAKERS)](&random);
        const int x = (int)random_below(&random, SIDE - 1), y = (int)random_below(&random, SIDE - 1);
        const renderer_part all = {0, 0, SIDE, SIDE},
                            part = {x, y, 1 + (int)random_below(&random, (uint64_t)(SIDE - x)),
                                    1 + (int)random_below(&random, (uint64_t)(SIDE - y))};
        q.color = 1;
        memset(whole, 0, sizeof whole);
        memset(bytes, 0, sizeof bytes);
        fill_quads(&q, 1, all, whole);
        fill_quads(&q, 1, part, bytes);
        for (int row = 0; row < part.height; row++)
            assert_memory_equal(bytes + row * part.width, whole + (y + row) * SIDE + x, (size_t)part.width);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quads_with_any_corners_are_filled_as_by_gl),
        cmocka_unit_test(small_quads_are_filled_as_by_gl),
        cmocka_unit_test(slivers_are_filled_as_by_gl),
        cmocka_unit_test(degenerate_quads_are_filled_as_by_gl),
        cmocka_unit_test(strokes_are_filled_as_by_gl),
        cmocka_unit_test(part_of_a_picture_has_the_pixels_of_the_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
