/* SPDX-License-Identifier: MIT */
/* test_cli_cause.c - octreel diff of two recordings reports the cause as text and as JSON, and ends with the right
 * status. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "edits.h"
#include "fixture.h"
#include "recordings.h"
#include "tick_lines.h"

/* A short recording, and the same with another leaf capacity. */
typedef struct recorded_pair {
    place a, b;
} recorded_pair;

static recorded_pair film_pair(const temp_folder *own, size_t capacity)
{
    const recorded_pair made = {place_in(own, "a"), place_in(own, "b")};
    octree_session session = short_session("wdwd");
    film_options options = small_film(made.a.path);
    assert_filmed(&session, &options);
    session.tree.leaf_capacity = capacity;
    options.folder = made.b.path;
    assert_filmed(&session, &options);
    return made;
}

static void headline_is_the_second_line_and_causes_follow_their_frames(void **state)
{
    const recorded_pair p = film_pair(*state, 4);
    command_result result = run_octreel(NULL, "diff %s %s --each --causes 2", p.a.path, p.b.path);
    assert_int_equal(result.status, 1);
    assert_string_equal(result.err, "");
    assert_contains(
        result.out,
        "different: 5 of 5 frames\nanother leaf capacity (4, was 2): every tick from 0 on differs\n  frame_");
    assert_contains(result.out, "\n    tick 1: node");
    assert_null(strstr(result.out, "\n    tick 2: "));
    assert_contains(result.out, "\n  3 of these are left unexplained; --causes all explains all\n");
    command_release(&result);
}

static void write_and_film(const temp_folder *own, const char *player, const char *shape, const char *more, place film)
{
    const place session = place_in(own, "s.json");
    char text[400];
    snprintf(text, sizeof text,
             "{\"octreel\": \"session\", \"version\": 2, \"player\": %s, \"points\": [[1, 0, 0, 1]],\n"
             "\"shapes\": [%s], \"ticks\": 1}\n",
             player, shape);
    file_write_text(session.path, text);
    command_result result = run_octreel(NULL, "record -q %s --size 64x48 %s -o %s", session.path, more, film.path);
    assert_done(&result);
    command_release(&result);
}

/* Values of every JSON type: numbers, texts, booleans, lists, objects, and null for missing members. */
static void json_copies_values_from_the_files(void **state)
{
    static const char *const parts[] = {
        "{\"where\": \"leaves\", \"change\": \"other\", \"count\": 1, \"facts\": [{\"reference\": false, \"frames\": "
        "true}]}",
        "{\"where\": \"closeup\", \"change\": \"other\", \"count\": 1, \"facts\": [{\"reference\": true, \"frames\": "
        "false}]}",
        "[{\"reference\": {\"label\": \"one\", \"at\": [1, 2, 3]}, \"frames\": {\"label\": \"two\", \"at\": [1, 2, "
        "3]}}]",
        "{\"where\": \"player\", \"change\": \"other\", \"count\": 1, \"facts\": [{\"reference\": null, \"frames\": "
        "[0, 0, "
        "0]}]}",
        "{\"where\": \"slice\", \"change\": \"other\", \"count\": 1, \"facts\": [{\"reference\": null, \"frames\": "
        "{\"z\": 1}}]}",
    };
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    write_and_film(*state, "null", "{\"label\": \"one\", \"at\": [1, 2, 3]}", "", a);
    write_and_film(*state, "{\"id\": 9}", "{\"label\": \"two\", \"at\": [1, 2, 3]}",
                   "--leaves --no-closeup --slice z=1", b);
    command_result result = run_octreel(NULL, "diff %s %s --json", a.path, b.path);
    assert_int_equal(result.status, 1);
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        assert_contains(result.out, parts[i]);
    json_decref(json_read(result.out));
    command_release(&result);
}

static void causes_option_explains_all_or_no_frames(void **state)
{
    const recorded_pair p = film_pair(*state, 4);
    command_result result = run_octreel(NULL, "diff %s %s --each --causes all", p.a.path, p.b.path);
    assert_contains(result.out, "\n    tick 4: ");
    assert_null(strstr(result.out, "unexplained"));
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s --causes 0", p.a.path, p.b.path);
    assert_int_equal(result.status, 1);
    assert_null(strstr(result.out, "capacity"));
    assert_null(strstr(result.out, "unexplained"));
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s --causes some", p.a.path, p.b.path);
    assert_trouble(&result, "--causes takes a whole number");
}

static void json_lists_the_facts(void **state)
{
    const recorded_pair p = film_pair(*state, 4);
    command_result result = run_octreel(NULL, "diff %s %s --json --causes 3", p.a.path, p.b.path);
    assert_int_equal(result.status, 1);
    json_t *all = json_read(result.out), *cause = json_member(all, "cause");
    assert_string_equal(json_string_value(json_member(all, "headline")),
                        "another leaf capacity (4, was 2): every tick from 0 on differs");
    const json_t *option = json_array_get(json_member(cause, "session"), 0);
    const json_t *change = json_array_get(json_member(option, "facts"), 0);
    assert_members(option, "where change count facts");
    assert_string_equal(json_string_value(json_member(option, "where")), "tree.capacity");
    assert_whole_number(json_member(change, "reference"), 2);
    assert_whole_number(json_member(change, "frames"), 4);
    assert_whole_number(json_member(cause, "compared"), 5);
    assert_whole_number(json_member(cause, "differing"), 5);
    assert_int_equal(json_array_size(json_member(cause, "ticks")), 3);
    assert_int_equal(json_array_size(json_member(cause, "view")), 0);
    assert_int_equal(json_array_size(json_member(cause, "warnings")), 0);
    const json_t *causes = json_member(json_array_get(json_member(cause, "ticks"), 0), "causes");
    const json_t *merged = json_array_get(causes, 0);
    assert_string_equal(json_string_value(json_member(merged, "where")), "nodes.merged");
    assert_true(json_is_string(json_member(json_array_get(json_member(merged, "facts"), 0), "frames")));
    const json_t *finding = json_array_get(json_member(all, "findings"), 2);
    assert_non_null(json_member(finding, "cause"));
    json_decref(all);
    command_release(&result);
}

static void assert_place(const json_t *value, double x, double y, double z)
{
    const double place[3] = {x, y, z};
    assert_int_equal(json_array_size(value), 3);
    for (size_t i = 0; i < 3; i++)
        assert_true(json_number_value(json_array_get(value, i)) == place[i]);
}

static void different_shapes_are_described_in_text_and_json(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    octree_shape shape = {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_SHAPE_SEGMENT, .at = {1, 2, 3}, .to = {700, 8, 9}};
    octree_session session = short_session("wd");
    film_options options = small_film(a.path);
    session.shapes = &shape;
    session.shape_count = 1;
    assert_filmed(&session, &options);
    shape.to[0] = 500;
    options.folder = b.path;
    assert_filmed(&session, &options);
    command_result result = run_octreel(NULL, "diff %s %s", a.path, b.path);
    assert_int_equal(result.status, 1);
    assert_contains(result.out,
                    "\nanother shape shown at every tick (segment (1, 2, 3) to (500, 8, 9), was (1, 2, 3) "
                    "to (700, 8, 9)); the ticks that both sides have are equal; frames differ from tick 0 on\n");
    assert_contains(result.out,
                    "\n    tick 0: nothing differs in the tick itself; another shape shown at every tick (");
    assert_contains(result.out, " of shapes");
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s --json", a.path, b.path);
    json_t *all = json_read(result.out), *cause = json_member(all, "cause");
    const json_t *group = json_array_get(json_member(cause, "session"), 0);
    const json_t *fact = json_array_get(json_member(group, "facts"), 0);
    const json_t *ends = json_member(json_member(fact, "frames"), "segment");
    assert_string_equal(json_string_value(json_member(group, "where")), "shapes");
    assert_string_equal(json_string_value(json_member(group, "change")), "other");
    assert_members(fact, "reference frames");
    assert_place(json_array_get(ends, 0), 1, 2, 3);
    assert_place(json_array_get(ends, 1), 500, 8, 9);
    assert_whole_number(json_member(cause, "differing"), 0);
    json_decref(all);
    command_release(&result);
}

static void damaged_recording_is_an_error_after_the_report(void **state)
{
    const recorded_pair p = film_pair(*state, 4);
    set_file_size(p.b.path, "session.json", 30);
    command_result result = run_octreel(NULL, "diff %s %s", p.a.path, p.b.path);
    assert_int_equal(result.status, 2);
    assert_contains(result.out, "trouble: 5 of 5 frames\n");
    assert_contains(result.out, "frame_000004.png: ");
    assert_non_null(strstr(result.err, "octreel: "));
    assert_non_null(strstr(result.err, "session.json"));
    assert_non_null(strstr(result.err, "--causes 0 skips the explanation\n"));
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s --json", p.a.path, p.b.path);
    json_t *all = json_read(result.out);
    assert_int_equal(result.status, 2);
    assert_non_null(strstr(json_string_value(json_member(all, "trouble")), "session.json"));
    json_decref(all);
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s --causes 0", p.a.path, p.b.path);
    assert_int_equal(result.status, 1);
    command_release(&result);
}

static void equal_frames_of_different_sessions_are_equal(void **state)
{
    const recorded_pair p = film_pair(*state, 2);
    command_result result = run_octreel(NULL, "diff %s %s", p.a.path, p.b.path);
    assert_done(&result);
    assert_string_equal(result.out, "same: 5 frames, 5 with the same bytes\ncompared exactly\n");
    command_release(&result);
    edit_line(p.b.path, 3, "\"merges\": []", "\"merges\": [\"0/1\"]");
    result = run_octreel(NULL, "diff %s %s", p.a.path, p.b.path);
    assert_done(&result);
    assert_contains(result.out, "ticks.jsonl at tick 3 differs from what its session gives");
    command_release(&result);
}

/* The integer rasterizer draws the elements, so a driver that octreel refuses makes no difference. */
static void pixels_are_traced_to_elements_without_gl(void **state)
{
    const recorded_pair p = film_pair(*state, 4);
    const command_setting other = {.environment = {"GALLIUM_DRIVER=softpipe"}};
    command_result result = run_octreel(&other, "diff %s %s --each", p.a.path, p.b.path);
    assert_int_equal(result.status, 1);
    assert_string_equal(result.err, "");
    assert_contains(result.out, "another leaf capacity (4, was 2)");
    assert_contains(result.out, "\n    tick 1: node");
    assert_contains(result.out, " pixels: ");
    assert_null(strstr(result.out, "not traced"));
    command_release(&result);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(headline_is_the_second_line_and_causes_follow_their_frames),
        TEST(json_copies_values_from_the_files),
        TEST(causes_option_explains_all_or_no_frames),
        TEST(json_lists_the_facts),
        TEST(different_shapes_are_described_in_text_and_json),
        TEST(damaged_recording_is_an_error_after_the_report),
        TEST(pixels_are_traced_to_elements_without_gl),
        TEST(equal_frames_of_different_sessions_are_equal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
