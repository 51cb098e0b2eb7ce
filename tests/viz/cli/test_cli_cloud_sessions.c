/* SPDX-License-Identifier: MIT */
/* test_cli_cloud_sessions.c - sessions with a file of points: their world, the ids of the points, and the warnings
 * about refused points. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "session_file.h"
#include "tick_lines.h"

#define HEADER "{\"octreel\": \"session\", \"version\": 2, \"ticks\": 3,\n"
#define FILM "record %s --size 160x90 --jobs 1 -o %s"

/* Coordinates of a survey, far outside the default world. */
static place write_survey(const temp_folder *folder, const char *name)
{
    enum { POINTS = 400 };
    const place path = place_in(folder, name);
    FILE *file = fopen(path.path, "w");
    assert_non_null(file);
    uint64_t random = 1;
    for (int i = 0; i < POINTS; i++)
        fprintf(file, "%.3f %.3f %.3f\n", random_between(&random, 512000, 512100),
                random_between(&random, 5403000, 5403050), random_between(&random, 200, 230));
    assert_int_equal(fclose(file), 0);
    return path;
}

static place write_session(const temp_folder *folder, const char *rest)
{
    const place path = place_in(folder, "my.json");
    char text[1024];
    snprintf(text, sizeof text, HEADER "%s}\n", rest);
    file_write_text(path.path, text);
    return path;
}

static session_file read_back(const place *film)
{
    session_file file;
    octreel_error error;
    if (!session_read(place_below(film->path, "session.json").path, &file, &error))
        fail_msg("%s", error.text);
    return file;
}

/* The number of points that tick 0 refused. */
static size_t count_refused(const place *film)
{
    char *text = file_read(place_below(film->path, "ticks.jsonl").path, NULL);
    text[strcspn(text, "\n")] = 0;
    json_t *tick = json_read(text);
    const size_t count = json_array_size(json_object_get(tick, "refusals"));
    json_decref(tick);
    free(text);
    return count;
}

static void assert_same_world(const octree_box *world, const json_t *told)
{
    for (size_t i = 0; i < 3; i++) {
        assert_true(json_number_value(json_array_get(json_member(told, "min"), i)) == world->min[i]);
        assert_true(json_number_value(json_array_get(json_member(told, "max"), i)) == world->max[i]);
    }
}

static void default_world_encloses_the_points_of_the_file(void **state)
{
    const temp_folder *folder = *state;
    const place survey = write_survey(folder, "utm.txt"), film = place_in(folder, "film");
    const place session = write_session(folder, "\"keys\": \"wd\", \"points\": {\"file\": \"utm.txt\"}");
    command_result result = run_octreel(NULL, FILM, session.path, film.path);
    assert_done(&result);
    command_release(&result);
    assert_int_equal(count_refused(&film), 0);
    result = run_octreel(NULL, "inspect %s --json", survey.path);
    assert_done(&result);
    json_t *inspected = json_read(result.out);
    session_file made = read_back(&film);
    assert_same_world(&made.session.tree.world, json_member(inspected, "world"));
    for (int i = 0; i < 3; i++) {
        const octree_box *world = &made.session.tree.world;
        assert_true(made.session.player.position[i] == world->min[i] / 2 + world->max[i] / 2);
    }
    session_release(&made);
    json_decref(inspected);
    command_release(&result);
}

/* session.json contains the world and the points: the cloud is not needed again, and chunks and resume agree. */
static void every_way_of_recording_a_cloud_gives_the_same_files(void **state)
{
    const temp_folder *folder = *state;
    const place survey = write_survey(folder, "utm.txt"), film = place_in(folder, "film"),
                parts = place_in(folder, "parts");
    const place session = write_session(folder, "\"points\": {\"file\": \"utm.txt\"}");
    static const char *const lines[] = {FILM, FILM " --resume"};
    static const char *const chunks[] = {FILM " --ticks 2:", FILM " --ticks :2"};
    for (int i = 0; i < 2; i++) {
        command_result result = run_octreel(NULL, lines[i], session.path, film.path);
        assert_done(&result);
        command_release(&result);
        result = run_octreel(NULL, chunks[i], session.path, parts.path);
        assert_done(&result);
        command_release(&result);
    }
    assert_int_equal(remove(survey.path), 0);
    command_result result = run_octreel(NULL, "join %s", parts.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(film.path, parts.path, NULL);
    result = run_octreel(NULL, "verify %s", film.path);
    assert_done(&result);
    command_release(&result);
}

/* The world that the sentence proposes; the caller frees it. */
static char *copy_world(const char *sentence)
{
    const char *begin = strstr(sentence, "\"world\": "), *end = begin ? strstr(begin, "}") : NULL;
    assert_non_null(end);
    return strndup(begin, (size_t)(end + 1 - begin));
}

static void warning_about_points_outside_names_a_world_that_fits(void **state)
{
    static const char *const points[] = {"\"points\": {\"file\": \"utm.txt\"}",
                                         "\"points\": [[5000, 0, 0], [6000, 0, 0], [1, 2, 3]]"};
    static const char *const counts[] = {"400 of the session's 400 points lie outside its world and are refused",
                                         "2 of the session's 3 points lie outside its world and are refused"};
    const temp_folder *folder = *state;
    write_survey(folder, "utm.txt");
    for (int i = 0; i < 2; i++) {
        char rest[512], names[2][8];
        for (int j = 0; j < 2; j++)
            snprintf(names[j], sizeof names[j], "film%d", 2 * i + j);
        const place film = place_in(folder, names[0]), mended = place_in(folder, names[1]);
        snprintf(rest, sizeof rest, "\"world\": {\"min\": [-9, -9, -9], \"max\": [9, 9, 9]}, %s", points[i]);
        place session = write_session(folder, rest);
        command_result result = run_octreel(NULL, FILM, session.path, film.path);
        assert_int_equal(result.status, 0);
        assert_non_null(strstr(result.err, counts[i]));
        assert_ptr_equal(strchr(result.err, '\n'), result.err + strlen(result.err) - 1);
        char *world = copy_world(result.err);
        command_release(&result);
        snprintf(rest, sizeof rest, "%s, %s", world, points[i]);
        free(world);
        session = write_session(folder, rest);
        result = run_octreel(NULL, FILM, session.path, mended.path);
        assert_done(&result);
        command_release(&result);
        assert_int_equal(count_refused(&mended), 0);
    }
}

static void warning_about_full_leaves_names_the_remedy(void **state)
{
    const temp_folder *folder = *state;
    const place film = place_in(folder, "film"), survey = write_survey(folder, "utm.txt");
    const place session = write_session(folder, "\"tree\": {\"depth\": 1}, \"points\": {\"file\": \"utm.txt\"}");
    command_result result = run_octreel(NULL, FILM, session.path, film.path);
    assert_int_equal(result.status, 0);
    assert_true(file_exists(survey.path) && count_refused(&film) > 200);
    assert_non_null(strstr(result.err, " of the session's 400 points are refused by full leaves"));
    assert_non_null(strstr(result.err, "\"full\": \"grow\""));
    command_release(&result);
}

/* If at most half of the points are refused there is no warning, but ticks.jsonl counts them. */
static void refused_points_are_counted(void **state)
{
    const temp_folder *folder = *state;
    const place film = place_in(folder, "film");
    const place session =
        write_session(folder, "\"points\": [[5000, 0, 0], [0, 6000, 0], [1, 2, 3], [4, 5, 6], [7, 8, 9]]");
    command_result result = run_octreel(NULL, FILM, session.path, film.path);
    assert_done(&result);
    assert_non_null(strstr(
        result.out,
        "\nrefused points, edits and steps (steps out of the world are not counted): 2; ticks.jsonl lists them\n"));
    command_release(&result);
}

#define PCD "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 3\nDATA ascii\n1 2 3\nnan nan nan\n4 5 6\n7 8 9\n"

/* Skipped rows count, so that an id leads back to its row; and data after the last point is noted. */
static void ids_are_row_numbers_of_the_cloud(void **state)
{
    const temp_folder *folder = *state;
    static const char note[] = "the file has more lines than its header says; the points before this place were read\n";
    const place points = place_in(folder, "scan.pcd"), film = place_in(folder, "film");
    const place session = write_session(folder, "\"points\": {\"file\": \"scan.pcd\"}, \"player\": {\"id\": 3}");
    file_write_text(points.path, PCD);
    command_result result = run_octreel(NULL, "inspect %s --node root --json", points.path);
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, note));
    json_t *node = json_read(result.out);
    const json_t *rows = json_member(node, "points");
    assert_int_equal(json_array_size(rows), 2);
    assert_whole_number(json_member(json_array_get(rows, 0), "id"), 0);
    assert_whole_number(json_member(json_array_get(rows, 1), "id"), 2);
    json_decref(node);
    command_release(&result);
    result = run_octreel(NULL, FILM, session.path, film.path);
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, note));
    command_release(&result);
    session_file made = read_back(&film);
    assert_int_equal(made.session.body_count, 2);
    assert_int_equal(made.session.bodies[0].id, 1);
    assert_int_equal(made.session.bodies[1].id, 4);
    session_release(&made);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(default_world_encloses_the_points_of_the_file),
        IN_FOLDER(every_way_of_recording_a_cloud_gives_the_same_files),
        IN_FOLDER(warning_about_points_outside_names_a_world_that_fits),
        IN_FOLDER(warning_about_full_leaves_names_the_remedy),
        IN_FOLDER(refused_points_are_counted),
        IN_FOLDER(ids_are_row_numbers_of_the_cloud),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
