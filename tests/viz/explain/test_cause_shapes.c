/* SPDX-License-Identifier: MIT */
/* test_cause_shapes.c - two sessions with different shapes, and the headline that reports them. */
#include <string.h>

#include "fixture.h"
#include "session_variant.h"

/* Put a shape before the i-th. */
static void insert_shape(variant *v, size_t i, octree_shape shape)
{
    memmove(v->shapes + i + 1, v->shapes + i, (v->session.shape_count - i) * sizeof *v->shapes);
    v->shapes[i] = shape;
    v->session.shape_count++;
}

static void one_more_shape(variant *v)
{
    insert_shape(v, 0, (octree_shape){.tick = 1, .kind = OCTREE_SHAPE_LABEL, .at = {7, 8, 9}, .text = "a goal"});
}

static void one_shape_fewer(variant *v)
{
    v->session.shape_count--;
}

/* Two ticks, one more in front in each: the others are the same. */
static void two_more_shapes(variant *v)
{
    insert_shape(v, 2, (octree_shape){.tick = OCTREE_EVERY_TICK, .kind = OCTREE_SHAPE_POINT, .at = {7, 7, 7}});
    insert_shape(v, 0, (octree_shape){.tick = 2, .kind = OCTREE_SHAPE_POINT, .at = {8, 8, 8}});
}

static void larger_shape(variant *v)
{
    v->shapes[2].to[1] = 5;
}

static void longer_shape(variant *v)
{
    v->shapes[3].to[0] = 5;
}

static void moved_shape(variant *v)
{
    v->shapes[0].at[0] = 5;
}

static void moved_label(variant *v)
{
    v->shapes[1].at[0] = 5;
}

static void other_label(variant *v)
{
    strcpy(v->shapes[1].text, "a text as long as labels may be: 46 characters");
}

static void other_kind_of_shape(variant *v)
{
    v->shapes[3].kind = OCTREE_SHAPE_POINT;
}

/* A point has one place, and no text. */
static void idle_shape(variant *v)
{
    v->shapes[0].to[0] = 8;
    v->shapes[0].text[0] = 'x';
    v->shapes[1].to[1] = 7;
}

static void shape_and_length(variant *v)
{
    v->session.ticks = 5;
    one_shape_fewer(v);
}

static void shapes_are_named_by_kind_tick_and_place(void **state)
{
    (void)state;
    assert_change_headline(one_more_shape,
                           "one more shape shown at tick 1 (label \"a goal\", at (7, 8, 9)); " SAME_TICKS);
    assert_change_headline(one_shape_fewer,
                           "one shape shown fewer at every tick (segment (0, 0, 0) to (9, 9, 9)); " SAME_TICKS);
    assert_change_headline(two_more_shapes,
                           "one more shape shown at every tick (point (7, 7, 7)), one more shape shown at tick 2 "
                           "(point (8, 8, 8)); " SAME_TICKS);
    assert_change_headline(larger_shape,
                           "another shape shown at every tick (box (-1, -1, -1) to (1, 5, 1), was (-1, -1, -1) "
                           "to (1, 1, 1)); " SAME_TICKS);
    assert_change_headline(longer_shape,
                           "another shape shown at every tick (segment (0, 0, 0) to (5, 9, 9), was (0, 0, "
                           "0) to (9, 9, 9)); " SAME_TICKS);
    assert_change_headline(moved_shape, "another shape shown at tick 2 (point (5, 2, 3), was (1, 2, 3)); " SAME_TICKS);
    assert_change_headline(moved_label,
                           "another shape shown at tick 2 (label \"start\", at (5, 5, 6), was (4, 5, 6)); " SAME_TICKS);
    assert_change_headline(other_label,
                           "another shape shown at tick 2 (label \"a text as long as labels may be: 46 characters\", "
                           "was \"start\", at (4, 5, 6)); " SAME_TICKS);
    assert_change_headline(other_kind_of_shape,
                           "one shape shown fewer at every tick (segment (0, 0, 0) to (9, 9, 9)), one more "
                           "shape shown at every tick (point (0, 0, 0)); " SAME_TICKS);
    assert_change_headline(shape_and_length,
                           "another last tick (5, was 6), one shape shown fewer at every tick (segment (0, 0, "
                           "0) to (9, 9, 9)); " SAME_TICKS);
    assert_change_headline(idle_shape, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_are_named_by_kind_tick_and_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
