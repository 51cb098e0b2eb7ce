/* SPDX-License-Identifier: MIT */
/* test_point_block.c - a block of points returns every bit of every number, is small, and is refused if it is damaged.
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixture.h"
#include "point_block.h"
#include "text.h"

enum { POINTS = 500 };

/* The text of a block; the caller frees it. */
static char *write_block(const point_block *b, size_t *size)
{
    text_stream s;
    char *text;
    assert_true(text_stream_begin(&s));
    assert_true(point_block_write(b, s.stream));
    assert_true(text_stream_end(&s, &text));
    *size = s.size;
    return text;
}

static void assert_restored(const point_block *b)
{
    point_block read;
    octreel_error error = {""};
    size_t size;
    char *text = write_block(b, &size);
    if (!point_block_read(text, size, &read, &error))
        fail_msg("%s", error.text);
    assert_string_equal(read.title, b->title);
    assert_int_equal(read.node, b->node);
    assert_int_equal(read.count, b->count);
    assert_int_equal(read.values.kinds, b->values.kinds);
    assert_int_equal(read.moving, b->moving);
    for (size_t i = 0; i < b->count; i++) {
        const point_value was = point_values_get(&b->values, b->bodies[i].id),
                          is = point_values_get(&read.values, b->bodies[i].id);
        assert_memory_equal(&read.bodies[i], &b->bodies[i], sizeof b->bodies[i]);
        assert_true(point_value_equals(&was, &is));
    }
    point_block_release(&read);
    free(text);
}

/* A block of points whose coordinates are returned by a function. */
static point_block make_block(size_t count, double number(size_t i))
{
    point_block b = {.title = "scan.ply", .node = 9, .count = count, .bodies = calloc(count + 1, sizeof *b.bodies)};
    assert_non_null(b.bodies);
    for (size_t i = 0; i < count; i++) {
        b.bodies[i].id = i;
        for (size_t axis = 0; axis < 3; axis++)
            b.bodies[i].position[axis] = number(3 * i + axis);
    }
    return b;
}

static double random_number(size_t i)
{
    (void)i;
    return (double)rand() / RAND_MAX * 200 - 100;
}

static double make_decimal(size_t i)
{
    return ((double)(i * 7919 % 100003) - 40000) / 1000;
}

static double make_las_number(size_t i)
{
    return (double)(i * 7919 % 100003) * 0.01;
}

static double make_single(size_t i)
{
    return (double)(float)random_number(i);
}

static double make_short_single(size_t i)
{
    return (double)(float)make_decimal(i);
}

static double make_hostile(size_t i)
{
    static const double numbers[] = {0.0, -0.0, DBL_MAX, -DBL_MAX, 5e-324, 0.1, -1e308, 0x1p53, 1e-17, FLT_MAX};
    return numbers[i % (sizeof numbers / sizeof numbers[0])];
}

static double make_minus_zero(size_t i)
{
    return i % 2 ? 0.0 : -0.0;
}

static void block_restores_every_bit(void **state)
{
    (void)state;
    double (*const numbers[])(size_t) = {random_number,     make_decimal, make_las_number, make_single,
                                         make_short_single, make_hostile, make_minus_zero};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        for (size_t count = 0; count <= POINTS; count += count ? POINTS - 1 : 1) {
            point_block b = make_block(count, numbers[i]);
            assert_restored(&b);
            b.moving = true;
            for (size_t body = 0; body < count; body++)
                for (size_t axis = 0; axis < 3; axis++)
                    b.bodies[body].velocity[axis] = numbers[i](body + axis);
            assert_restored(&b);
            point_block_release(&b);
        }
}

static void decimals_of_three_digits_take_at_most_three_bytes(void **state)
{
    (void)state;
    double (*const numbers[])(size_t) = {make_decimal, make_las_number, make_short_single};
    for (size_t i = 0; i < 3; i++) {
        point_block b = make_block(POINTS, numbers[i]);
        size_t size;
        free(write_block(&b, &size));
        assert_in_range(size, 0, POINTS * (1 + 3 * 3) + 200);
        point_block_release(&b);
    }
}

/* Give every third point no values; ids have gaps if `step` is not 1. */
static void add_values(point_block *b, size_t step)
{
    for (size_t i = 0; i < b->count; i++) {
        const point_value value = {.intensity = (float)i / 3,
                                   .class = (uint16_t)(i * 131),
                                   .color = {(unsigned char)(i * 7), (unsigned char)i, (unsigned char)(i * 3)},
                                   .has = {true, i % 5 == 0, i % 7 == 0}};
        b->bodies[i].id = i * step;
        const point_entry entry = {i * step, value};
        if (i % 3)
            assert_true(point_values_add_entries(&b->values, &entry, 1));
    }
}

static void block_restores_values(void **state)
{
    (void)state;
    for (size_t step = 1; step < 4; step += 2) {
        point_block b = make_block(POINTS, make_decimal);
        add_values(&b, step);
        assert_restored(&b);
        point_block_release(&b);
    }
}

static void assert_refused(const char *bytes, size_t size)
{
    point_block read;
    octreel_error error = {""};
    assert_false(point_block_read(bytes, size, &read, &error));
    assert_non_null(strstr(error.text, "cut off or damaged"));
    assert_null(read.bodies);
}

static void cut_block_is_refused(void **state)
{
    (void)state;
    point_block b = make_block(20, make_decimal);
    add_values(&b, 1);
    size_t size;
    char *text = write_block(&b, &size);
    for (size_t cut = 0; cut < size; cut++) {
        char *copy = malloc(cut + 1); /* so that a sanitizer sees reads behind its end */
        assert_non_null(copy);
        memcpy(copy, text, cut);
        assert_refused(copy, cut);
        free(copy);
    }
    free(text);
    point_block_release(&b);
}

static void damaged_block_is_refused_or_read_without_a_crash(void **state)
{
    (void)state;
    point_block b = make_block(20, make_decimal);
    size_t size;
    char *text = write_block(&b, &size);
    octreel_error error;
    for (int i = 0; i < 20000; i++) {
        point_block read;
        char *at = text + (size_t)rand() % (i % 2 ? size : 120), was = *at;
        *at = (char)rand();
        if (point_block_read(text, size, &read, &error))
            point_block_release(&read);
        *at = was;
    }
    free(text);
    point_block_release(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(block_restores_every_bit),
        cmocka_unit_test(decimals_of_three_digits_take_at_most_three_bytes),
        cmocka_unit_test(block_restores_values),
        cmocka_unit_test(cut_block_is_refused),
        cmocka_unit_test(damaged_block_is_refused_or_read_without_a_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
