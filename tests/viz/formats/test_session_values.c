/* SPDX-License-Identifier: MIT */
/* test_session_values.c - the colours, intensities and classes of a session's points: reading, writing, finding by id.
 */
#include "clouds.h"
#include "session_file.h"
#include "session_texts.h"
#include "temp_folder.h"
#include "text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADER "{\"octreel\": \"session\", \"version\": 2, \"ticks\": 3, "

/* The test fails unless the written session contains a text, and writing it after reading yields the same. */
static void assert_writes(const session_file *file, const char *part)
{
    char *text = text_of_session(&file->session, &file->values);
    if (!strstr(text, part))
        fail_msg("%s\nhas not\n%s", text, part);
    session_file again = session_of_text(text);
    char *text_again = text_of_session(&again.session, &again.values);
    assert_string_equal(text, text_again);
    free(text_again);
    session_release(&again);
    free(text);
}

static void values_are_found_by_id(void **state)
{
    session_file file = session_of_text(
        HEADER "\"columns\": [\"class\", \"color\"],"
               "\"points\": [[1,2,3], [4,5,6,70,2,\"#Ff0001\"], [7,8,9,5,null,\"#000000\"],"
               "{\"id\": 9000000000000, \"position\": [1,1,1], \"intensity\": 0.1}]}"
               "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 6, \"position\": [1,1,1], \"class\": 65535}}]}");
    const point_values *v = &file.values;
    (void)state;
    assert_null(point_values_find_row(v, 1));
    const point_value at70 = point_values_get(v, 70), at6 = point_values_get(v, 6),
                      far = point_values_get(v, UINT64_C(9000000000000));
    assert_true(at70.has[POINT_CLASS] && at70.has[POINT_COLOR] && !at70.has[POINT_INTENSITY]);
    assert_memory_equal(at70.color, "\xff\x00\x01", 3);
    assert_int_equal(at70.class, 2);
    assert_true(!point_values_get(v, 5).has[POINT_CLASS] && point_values_get(v, 5).has[POINT_COLOR]);
    assert_int_equal(at6.class, 65535);
    assert_true(far.has[POINT_INTENSITY] && far.intensity == 0.1F);
    assert_writes(&file,
                  "\"columns\": [\"color\", \"intensity\", \"class\"],\n\"points\": [\n[1, 2, 3, 1],\n"
                  "[4, 5, 6, 70, \"#ff0001\", null, 2],\n[7, 8, 9, 5, \"#000000\", null, null],\n"
                  "[1, 1, 1, 9000000000000, null, 0.1, null]\n]}\n{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 6, "
                  "\"position\": [1, 1, 1], \"class\": 65535}}]}\n");
    session_release(&file);
}

static void points_with_velocities_keep_their_values(void **state)
{
    session_file file = session_of_text(HEADER "\"points\": [{\"id\": 3, \"position\": [1,2,3], \"velocity\": [1,0,0], "
                                               "\"color\": \"#123456\", \"intensity\": -2.5, \"class\": 0}]}");
    (void)state;
    assert_writes(&file, "{\"id\": 3, \"position\": [1, 2, 3], \"velocity\": [1, 0, 0], \"color\": \"#123456\", "
                         "\"intensity\": -2.5, \"class\": 0}");
    session_release(&file);
}

static void intensities_are_written_as_shortest_floats(void **state)
{
    static const struct {
        const char *read, *written;
    } rows[] = {{"0.1", "0.1"},
                {"0.10000000149011612", "0.1"},
                {"65535", "65535"},
                {"16777217", "16777216"},
                {"-0.0", "-0"},
                {"1e-45", "1.4013e-45"},
                {"3e38", "3e+38"},
                {"0.333333343", "0.33333334"},
                {"123456.789", "123456.79"}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[256], expected[64];
        snprintf(text, sizeof text, HEADER "\"columns\": [\"intensity\"], \"points\": [[1,2,3,4,%s]]}", rows[i].read);
        snprintf(expected, sizeof expected, "[1, 2, 3, 4, %s]", rows[i].written);
        session_file file = session_of_text(text);
        assert_writes(&file, expected);
        session_release(&file);
    }
}

static void sessions_without_values_are_written_without_values(void **state)
{
    session_file file = session_of_text(HEADER "\"columns\": [\"color\"], \"points\": [[1,2,3], [1,2,3,7,null]]}");
    char *text = text_of_session(&file.session, &file.values);
    (void)state;
    assert_null(strstr(text, "columns"));
    assert_non_null(strstr(text, "[1, 2, 3, 7]"));
    free(text);
    session_release(&file);
}

static void invalid_values_are_refused(void **state)
{
    static const struct {
        const char *rest, *reason;
    } rows[] = {
        {"\"points\": [{\"position\": [1,2,3], \"color\": \"red\"}]}",
         "points[0].color: expected a colour \"#rrggbb\", found \"red\""},
        {"\"points\": [{\"position\": [1,2,3], \"color\": \"#1234567\"}]}",
         "points[0].color: expected a colour \"#rrggbb\", found \"#1234567\""},
        {"\"points\": [{\"position\": [1,2,3], \"color\": \"1#23456\"}]}",
         "points[0].color: expected a colour \"#rrggbb\", found \"1#23456\""},
        {"\"points\": [{\"position\": [1,2,3], \"color\": \"#12g456\"}]}",
         "points[0].color: expected a colour \"#rrggbb\", found \"#12g456\""},
        {"\"points\": [{\"position\": [1,2,3], \"color\": \"#12345g\"}]}",
         "points[0].color: expected a colour \"#rrggbb\", found \"#12345g\""},
        {"\"points\": [{\"position\": [1,2,3], \"intensity\": 1e39}]}",
         "points[0].intensity: the intensity does not fit into a float"},
        {"\"points\": [{\"position\": [1,2,3], \"class\": 65536}]}",
         "points[0].class: expected a whole number from 0 to 65535, found 65536"},
        {"\"points\": [[1,2,3,4,\"#123456\"]]}",
         "points[0]: expected a point [x, y, z] or [x, y, z, id], found a list of 5"},
        {"\"columns\": [\"color\", \"class\"], \"points\": [[1,2,3,4,\"#123456\"]]}",
         "points[0]: expected a point [x, y, z] or [x, y, z, id], or [x, y, z, id] followed by a value for each of "
         "\"columns\", found a "
         "list of 5"},
        {"\"columns\": [\"colour\"], \"points\": []}",
         "columns[0]: expected one of \"color\", \"intensity\" and \"class\", found \"colour\""},
        {"\"columns\": [], \"points\": []}",
         "columns: expected a list of \"color\", \"intensity\" and \"class\", found a list of 0"},
        {"\"columns\": [\"class\", \"class\"], \"points\": []}", "columns[1]: \"class\" occurs twice"},
        {"\"points\": [{\"id\": 1, \"position\": [1,2,3], \"class\": 3}]}\n"
         "{\"tick\": 1, \"edits\": [{\"remove\": 1}, {\"insert\": {\"id\": 1, \"position\": [1,2,3], \"class\": 4}}]}",
         "edits[1].insert: the point with the id 1 had another color, intensity or class before; an id keeps its "
         "values through the session"},
        {"\"points\": [[1,2,3,7]]}\n"
         "{\"tick\": 1, \"edits\": [{\"remove\": 7}]}\n"
         "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 7, \"position\": [1,2,3], \"class\": 4}}]}",
         "s.json:3: edits[0].insert: the point with the id 7 had no color, intensity or class before, so it "
         "cannot have any now; insert the point with another id"},
        {"\"points\": []}\n"
         "{\"tick\": 1, \"edits\": [{\"insert\": {\"id\": 7, \"position\": [1,2,3]}}]}\n"
         "{\"tick\": 2, \"edits\": [{\"remove\": 7}, "
         "{\"insert\": {\"id\": 7, \"position\": [1,2,3], \"class\": 4}}]}",
         "s.json:3: edits[1].insert: the point with the id 7 had no color"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[512];
        session_file file;
        octreel_error error = {""};
        snprintf(text, sizeof text, "%s%s", HEADER, rows[i].rest);
        assert_false(session_parse("s.json", "", text, strlen(text), &file, &error));
        if (!strstr(error.text, rows[i].reason))
            fail_msg("%s\nis not\n%s", error.text, rows[i].reason);
    }
}

/* An id with values may be inserted again without them and keeps its values. A new id may have values. */
static void inserted_points_keep_the_values_of_their_id(void **state)
{
    session_file file = session_of_text(
        HEADER "\"points\": [{\"id\": 7, \"position\": [1,2,3], \"class\": 4}, [1,2,3,8]]}\n"
               "{\"tick\": 1, \"edits\": [{\"remove\": 7}, {\"insert\": {\"id\": 7, \"position\": [1,1,1]}}]}\n"
               "{\"tick\": 2, \"edits\": [{\"remove\": 7}, "
               "{\"insert\": {\"id\": 7, \"position\": [1,2,3], \"class\": 4}}, "
               "{\"insert\": {\"id\": 9, \"position\": [1,2,3], \"class\": 5}}]}");
    (void)state;
    assert_int_equal(point_values_get(&file.values, 7).class, 4);
    assert_int_equal(point_values_get(&file.values, 9).class, 5);
    session_release(&file);
}

/* ---- A file of points --------------------------------------------------------------------------------------- */

static session_file read_with_cloud(temp_folder *folder, const char *cloud, const char *more)
{
    char path[512], text[512];
    session_file file;
    octreel_error error = {""};
    FILE *stream = fopen(temp_file(folder, "c.xyz"), "wb");
    assert_non_null(stream);
    assert_true(fputs(cloud, stream) >= 0);
    assert_int_equal(fclose(stream), 0);
    snprintf(path, sizeof path, "%s/", folder->name);
    snprintf(text, sizeof text, "%s%s\"points\": {\"file\": \"c.xyz\"}}", HEADER, more);
    if (!session_parse("s.json", path, text, strlen(text), &file, &error))
        fail_msg("%s", error.text);
    remove(temp_file(folder, "c.xyz"));
    return file;
}

static void values_of_a_file_are_read(void **state)
{
    session_file file = read_with_cloud(*state, "x y z class\n1 2 3 7\n4 5 6 8\n7 8 9\n", "");
    assert_writes(&file,
                  "\"columns\": [\"class\"],\n\"points\": [\n[1, 2, 3, 1, 7],\n[4, 5, 6, 2, 8],\n[7, 8, 9, 3]\n]}");
    session_release(&file);
    file = read_with_cloud(*state, "1 2 3 255 0 1\n", "");
    assert_string_equal(file.note, "c.xyz: columns 4 to 6 have no names and are read as r g b");
    session_release(&file);
}

/* Default ids skip the player's id. */
static void values_of_a_file_skip_the_id_of_the_player(void **state)
{
    session_file file =
        read_with_cloud(*state, "x y z class\n1 2 3 7\n4 5 6 8\n7 8 9 9\n", "\"player\": {\"id\": 2}, ");
    assert_writes(&file, "\"points\": [\n[1, 2, 3, 1, 7],\n[4, 5, 6, 3, 8],\n[7, 8, 9, 4, 9]\n]}");
    assert_false(point_values_get(&file.values, 2).has[POINT_CLASS]);
    session_release(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_found_by_id),
        cmocka_unit_test(points_with_velocities_keep_their_values),
        cmocka_unit_test(intensities_are_written_as_shortest_floats),
        cmocka_unit_test(sessions_without_values_are_written_without_values),
        cmocka_unit_test(invalid_values_are_refused),
        cmocka_unit_test(inserted_points_keep_the_values_of_their_id),
        cmocka_unit_test_setup_teardown(values_of_a_file_are_read, temp_folder_make, temp_folder_remove),
        cmocka_unit_test_setup_teardown(values_of_a_file_skip_the_id_of_the_player, temp_folder_make,
                                        temp_folder_remove),
    };
    return cmocka_run_group_tests_name("session values", tests, NULL, NULL);
}
