/* SPDX-License-Identifier: MIT */
/* test_named.c - an element described by its name: nodes with their contents, foreign nodes, and points with their leaf
 * and values. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixture.h"
#include "foreign_session.h"
#include "octree/octree.h"
#include "pick.h"
#include "recordings.h"
#include "tick_lines.h"

static playback open_session(const octree_session *session, const point_values *values)
{
    playback p;
    octreel_error error = {""};
    const view v = small_film("").view;
    if (!playback_open(&p, session, values, &v, &error))
        fail_msg("%s", error.text);
    return p;
}

/* The description of an element; null if there is none. The caller releases it. */
static json_t *describe(const playback *p, const char *name)
{
    char *text = NULL;
    size_t size;
    octreel_error error = {""};
    FILE *out = open_memstream(&text, &size);
    const bool found = pick_print_named(out, name, p, &error);
    assert_int_equal(fclose(out), 0);
    json_t *json = found ? json_read(text) : NULL;
    if (!found)
        assert_non_null(strstr(error.text, name));
    free(text);
    return json;
}

static bool has_id(const json_t *ids, uint64_t id)
{
    for (size_t i = 0; i < json_array_size(ids); i++)
        if ((uint64_t)json_number_value(json_array_get(ids, i)) == id)
            return true;
    return false;
}

static void leaf_of_a_point_holds_the_point(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    playback p = open_session(&session, NULL);
    size_t found = 0;
    for (uint64_t id = 0; id < 20; id++) {
        char name[64];
        octree_point point;
        snprintf(name, sizeof name, "point %d", (int)id);
        json_t *described = describe(&p, name);
        assert_int_equal(described != NULL, octree_game_find(p.game, id, &point));
        if (!described)
            continue;
        snprintf(name, sizeof name, "node %s", json_string_value(json_member(described, "leaf")));
        json_t *leaf = describe(&p, name);
        assert_true(has_id(json_member(leaf, "holds"), id));
        json_decref(leaf);
        json_decref(described);
        found++;
    }
    assert_int_equal(found, 11); /* of 12 points the tree refuses one */
    playback_close(&p);
}

static size_t count_leaves(const playback *p, const char *path)
{
    char name[64];
    snprintf(name, sizeof name, "node %s", path);
    json_t *node = describe(p, name);
    assert_non_null(node);
    const json_t *children = json_object_get(node, "children");
    size_t count = children ? 0 : 1;
    for (size_t i = 0; i < json_array_size(children); i++)
        count += count_leaves(p, json_string_value(json_array_get(children, i)));
    json_decref(node);
    return count;
}

static void children_lead_to_every_leaf(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    playback p = open_session(&session, NULL);
    assert_int_equal(count_leaves(&p, "root"), octree_game_tick(p.game)->stats.leaves);
    playback_close(&p);
}

static void foreign_node_has_its_parent_and_errors(void **state)
{
    (void)state;
    octreel_error error;
    const octree_session session = foreign_session();
    playback p = open_session(&session, NULL);
    assert_true(playback_advance(&p, &error));
    json_t *described = describe(&p, "foreign 4"); /* FOREIGN_LOW */
    const json_t *node = json_member(described, "foreign_node");
    assert_whole_number(json_member(node, "parent"), FOREIGN_LEFT);
    assert_string_equal(json_string_value(json_array_get(json_member(node, "wrong"), 0)), "outside_parent");
    json_decref(described);
    playback_close(&p);
}

static void point_has_the_values_of_the_session(void **state)
{
    (void)state;
    octree_session session = octree_session_default();
    point_values values = {0};
    const point_value value = {
        .intensity = 0.5f, .class = 6, .color = {1, 2, 255}, .has = {[POINT_COLOR] = true, [POINT_CLASS] = true}};
    assert_true(point_values_add_entries(&values, &(point_entry){3, value}, 1));
    playback p = open_session(&session, &values);
    json_t *three = describe(&p, "point 3"), *four = describe(&p, "point 4");
    assert_string_equal(json_string_value(json_member(three, "color")), "#0102ff");
    assert_whole_number(json_member(three, "class"), 6);
    assert_null(json_object_get(three, "intensity"));
    assert_null(json_object_get(four, "color"));
    json_decref(three);
    json_decref(four);
    playback_close(&p);
    point_values_release(&values);
}

static void unknown_names_are_refused(void **state)
{
    static const char *const names[] = {"",         "node",     "node 8",   "node 0/",   "point",
                                        "point -1", "point x",  "point 1 ", "point  1",  "foreign 1",
                                        "foreign",  "points 1", "node0",    "point 0x1", "foreign 9e9"};
    (void)state;
    octree_session session = octree_session_default();
    playback p = open_session(&session, NULL);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        assert_null(describe(&p, names[i]));
    playback_close(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(leaf_of_a_point_holds_the_point),
        cmocka_unit_test(children_lead_to_every_leaf),
        cmocka_unit_test(foreign_node_has_its_parent_and_errors),
        cmocka_unit_test(point_has_the_values_of_the_session),
        cmocka_unit_test(unknown_names_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
