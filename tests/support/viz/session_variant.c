/* SPDX-License-Identifier: MIT */
/* session_variant.c - see session_variant.h. */
#include "session_variant.h"

#include <stdlib.h>
#include <string.h>

#include "cause_words.h"
#include "fixture.h"
#include "game_fixture.h"
#include "text.h"

static const octree_game_body some_bodies[] = {{.id = 1, .position = {1, 2, 3}},
                                               {.id = 2, .position = {-4, 5, -6}},
                                               {.id = 3, .position = {7, 7, 7}},
                                               {.id = 4, .position = {8, 7, 7}}};

static const octree_edit some_edits[] = {{2, OCTREE_EDIT_MOVE, {.id = 1, .position = {1, 2, 4}}},
                                         {2, OCTREE_EDIT_INSERT, {.id = 9, .position = {9, 9, 9}}},
                                         {4, OCTREE_EDIT_REMOVE, {.id = 2}}};

static const octree_shape some_shapes[] = {
    {.tick = 2, .kind = OCTREE_SHAPE_POINT, .at = {1, 2, 3}},
    {.tick = 2, .kind = OCTREE_SHAPE_LABEL, .at = {4, 5, 6}, .text = "start"},
    {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_SHAPE_BOX, .at = {-1, -1, -1}, .to = {1, 1, 1}},
    {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_SHAPE_SEGMENT, .at = {0, 0, 0}, .to = {9, 9, 9}}};

static void make_variant(variant *v)
{
    *v = (variant){.session = small_session(v->bodies, 4)};
    memcpy(v->bodies, some_bodies, sizeof some_bodies);
    memcpy(v->edits, some_edits, sizeof some_edits);
    v->queries[0] = (octree_query){.tick = 3, .kind = OCTREE_QUERY_RADIUS, .radius = 5};
    v->queries[1] =
        (octree_query){.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{-5, -5, -5}, {5, 5, 5}}};
    v->session.keys = "wdwa";
    v->session.ticks = 6;
    v->session.edits = v->edits;
    v->session.edit_count = 3;
    v->session.queries = v->queries;
    v->session.query_count = 2;
    memcpy(v->shapes, some_shapes, sizeof some_shapes);
    v->session.shapes = v->shapes;
    v->session.shape_count = sizeof some_shapes / sizeof *some_shapes;
}

static char *headline_of(const variant *a, const variant *b)
{
    const cause_watcher first = {.first = 1};
    octreel_error error = {""};
    char *text;
    cause c;
    text_stream s;
    if (!cause_find(&(session_file){.session = a->session, .values = a->values},
                    &(session_file){.session = b->session, .values = b->values}, NULL, &first, &c, &error))
        fail_msg("%s", error.text);
    assert_true(text_stream_begin(&s));
    cause_print_headline(s.stream, &c);
    assert_true(text_stream_end(&s, &text));
    cause_release(&c);
    return text;
}

void assert_change_headline_from(void prepare(variant *v), void change(variant *v), const char *expected)
{
    static variant a, b;
    make_variant(&a);
    make_variant(&b);
    if (prepare) {
        prepare(&a);
        prepare(&b);
    }
    change(&b);
    char *text = headline_of(&a, &b);
    if (strcmp(text ? text : "", expected) != 0)
        fail_msg("it says \"%s\" and not \"%s\"", text ? text : "", expected);
    free(text);
    point_values_release(&a.values);
    point_values_release(&b.values);
}

void assert_change_headline(void change(variant *v), const char *expected)
{
    assert_change_headline_from(NULL, change, expected);
}
