/* SPDX-License-Identifier: MIT */
/* test_session_file.c - reading session files: defaults, and every form of points, velocities and queries. */
#include "fixture.h"
#include "octree/sample.h"
#include "session_file.h"
#include "temp_folder.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADER "{\"octreel\":\"session\",\"version\":2"

static session_file parse(const char *text)
{
    session_file file;
    octreel_error error = {""};
    if (!session_parse("s.json", "", text, strlen(text), &file, &error))
        fail_msg("%s", error.text);
    return file;
}

static void assert_vector(const double found[3], double x, double y, double z)
{
    const double expected[3] = {x, y, z};
    assert_memory_equal(found, expected, sizeof expected);
}

static void header_without_members_has_the_defaults(void **state)
{
    session_file file = parse(HEADER "}");
    const octree_session *session = &file.session;
    (void)state;
    assert_vector(session->tree.world.min, -1000, -1000, -1000);
    assert_vector(session->tree.world.max, 1000, 1000, 1000);
    assert_int_equal(session->tree.leaf_capacity, 8);
    assert_int_equal(session->tree.max_depth, 21);
    assert_int_equal(session->tree.full_leaf, OCTREE_REFUSE);
    assert_int_equal(session->player.id, 0);
    assert_vector(session->player.position, 0, 0, 0);
    assert_true(session->player.step == 50 && session->player.box_size == 30);
    assert_int_equal(session->body_count + session->edit_count + session->query_count + session->ticks, 0);
    assert_null(session->keys);
    session_release(&file);
}

/* A byte order mark does not change the line numbers of errors. */
static void byte_order_mark_before_the_header_is_skipped(void **state)
{
    static const char text[] = "\xef\xbb\xbf{\"octreel\":\"session\",\"version\":2,\n\"ticks\":7}",
                      twice[] = "\xef\xbb\xbf\xef\xbb\xbf{}", alone[] = "\xef\xbb\xbf",
                      bad[] = "\xef\xbb\xbf{\"octreel\":\"session\",\"version\":2,\n\"ticks\":\"a\"}";
    session_file file;
    octreel_error error;
    (void)state;
    assert_true(session_parse("s.json", "", text, sizeof text - 1, &file, &error));
    assert_int_equal(file.session.ticks, 7);
    session_release(&file);
    assert_false(session_parse("s.json", "", twice, sizeof twice - 1, &file, &error));
    assert_false(session_parse("s.json", "", alone, sizeof alone - 1, &file, &error));
    assert_string_equal(error.text, "s.json:1: holds no session");
    assert_false(session_parse("s.json", "", bad, sizeof bad - 1, &file, &error));
    assert_non_null(strstr(error.text, "s.json:2: ticks: "));
}

static void player_defaults_follow_world_and_step(void **state)
{
    session_file file = parse(HEADER ",\"player\":{\"id\":3},\"world\":{\"min\":[0,0,0],\"max\":[8,4,80]}}");
    (void)state;
    assert_vector(file.session.player.position, 4, 2, 40);
    assert_true(file.session.player.step == 2 && file.session.player.box_size == 1.2);
    assert_int_equal(file.session.player.id, 3);
    session_release(&file);
    file = parse(HEADER ",\"player\":{\"step\":100}}");
    assert_true(file.session.player.step == 100 && file.session.player.box_size == 60);
    session_release(&file);
    file = parse(HEADER ",\"player\":{\"box_size\":7}}");
    assert_true(file.session.player.step == 50 && file.session.player.box_size == 7);
    assert_false(file.session.player.sweep);
    session_release(&file);
    file = parse(HEADER ",\"player\":{\"sweep\":true}}");
    assert_true(file.session.player.sweep);
    session_release(&file);
    file = parse(HEADER ",\"player\":{\"sweep\":false}}");
    assert_false(file.session.player.sweep);
    session_release(&file);
}

static void player_may_be_a_body_or_missing(void **state)
{
    (void)state;
    session_file file =
        parse(HEADER ",\"player\":{\"id\":2,\"body\":true,\"box_size\":3},\"points\":[[1,1,1],[2,2,2]]}");
    assert_int_equal(file.session.player.kind, OCTREE_PLAYER_BODY);
    assert_true(file.session.player.id == 2 && file.session.player.box_size == 3);
    assert_true(file.session.bodies[0].id == 1 && file.session.bodies[1].id == 2); /* which is the player */
    session_release(&file);
    file = parse(HEADER ",\"player\":null,\"points\":[[1,1,1,0]]}");
    assert_int_equal(file.session.player.kind, OCTREE_PLAYER_NONE);
    assert_true(file.session.bodies[0].id == 0);
    session_release(&file);
}

static void extreme_worlds_have_a_player_inside(void **state)
{
    static const char *const worlds[] = {
        "{\"min\":[-1.7976931348623157e308,0,0],\"max\":[1.7976931348623157e308,1,1]}",
        "{\"min\":[5e-324,5e-324,0],\"max\":[1e-323,1e-310,5e-324]}",
        "{\"min\":[1e15,1e15,-1e200],\"max\":[1000000000000001,1000000000000000.2,1e200]}",
    };
    (void)state;
    for (size_t i = 0; i < sizeof worlds / sizeof *worlds; i++) {
        char text[256];
        octree_game *game;
        snprintf(text, sizeof text, "%s,\"world\":%s}", HEADER, worlds[i]);
        session_file file = parse(text);
        assert_int_equal(octree_game_create(&file.session, &game), OCTREE_OK);
        octree_game_destroy(game);
        session_release(&file);
    }
}

static void points_are_read_in_each_form(void **state)
{
    session_file file = parse(HEADER ",\"player\":{\"id\":2},\"points\":[[1,2,3],[-0,5e-1,6],[7,8,9,40],"
                                     "{\"id\":9007199254740991,\"position\":[1,1,1],\"velocity\":[0,0.25,-1]},"
                                     "{\"position\":[2000,0,0]}]}");
    const octree_game_body *bodies = file.session.bodies;
    (void)state;
    assert_int_equal(file.session.body_count, 5);
    assert_int_equal(bodies[0].id, 1);
    assert_vector(bodies[0].position, 1, 2, 3);
    assert_int_equal(bodies[1].id, 3);
    assert_vector(bodies[1].position, -0.0, 0.5, 6);
    assert_int_equal(bodies[2].id, 40);
    assert_true(bodies[3].id == SESSION_ID_LIMIT - 1);
    assert_vector(bodies[3].velocity, 0, 0.25, -1);
    assert_int_equal(bodies[4].id, 6);
    assert_vector(bodies[4].position, 2000, 0, 0);
    session_release(&file);
}

static void velocities_are_listed_by_id_or_random(void **state)
{
    session_file file = parse(HEADER ",\"velocities\":[[2,1,2,3],[1,0,0,4]],\"points\":[[0,0,1],[0,0,2]]}");
    (void)state;
    assert_vector(file.session.bodies[0].velocity, 0, 0, 4);
    assert_vector(file.session.bodies[1].velocity, 1, 2, 3);
    session_release(&file);
    file = parse(HEADER ",\"velocities\":{\"speed\":5,\"seed\":7},\"points\":[[0,0,1],[0,0,2]]}");
    uint64_t seed = 7;
    for (int i = 0; i < 6; i++)
        assert_true(file.session.bodies[i / 3].velocity[i % 3] == 5 * (2 * octree_random_unit(&seed) - 1));
    session_release(&file);
}

static void ticks_become_edits_and_queries_in_order(void **state)
{
    session_file file =
        parse(HEADER ",\"queries\":[{\"nearest\":\"player\"}],\"keys\":\"wq\",\"ticks\":9}\n"
                     "{\"tick\":0,\"queries\":[{\"nearest\":[1,2,3]}]}{\"tick\":1}\r\n"
                     "{\"edits\":[{\"remove\":9},{\"move\":{\"id\":1,\"position\":[4,5,6]}}],\"tick\":3,"
                     "\"queries\":[{\"at\":\"player\",\"range\":{\"min\":[1,1,1],\"max\":[1,2,3]}}]}\n\n"
                     "{\"tick\":1e9,\"edits\":[{\"insert\":{\"id\":8,\"position\":[7,8,9]}}]}  ");
    const octree_session *session = &file.session;
    (void)state;
    assert_string_equal(session->keys, "wq");
    assert_int_equal(session->ticks, 9);
    assert_int_equal(session->edit_count, 3);
    assert_int_equal(session->edits[0].kind, OCTREE_EDIT_REMOVE);
    assert_int_equal(session->edits[1].kind, OCTREE_EDIT_MOVE);
    assert_vector(session->edits[1].body.position, 4, 5, 6);
    assert_int_equal(session->edits[2].kind, OCTREE_EDIT_INSERT);
    assert_int_equal(session->edits[2].tick, 1000000000);
    assert_int_equal(session->query_count, 3);
    assert_int_equal(session->queries[0].tick, 0);
    assert_vector(session->queries[0].target, 1, 2, 3);
    assert_int_equal(session->queries[1].tick, 3);
    assert_true(session->queries[1].at_player && session->queries[1].kind == OCTREE_QUERY_RANGE);
    assert_vector(session->queries[1].box.max, 1, 2, 3);
    assert_true(session->queries[2].tick == OCTREE_EVERY_TICK && session->queries[2].at_player);
    session_release(&file);
}

static void session_without_ticks_ends_at_its_last_key_or_object(void **state)
{
    (void)state;
    session_file file = parse(HEADER "}\n{\"tick\":3}\n{\"tick\":17,\"edits\":[]}");
    assert_int_equal(octree_session_length(&file.session), 17);
    session_release(&file);
    file = parse(HEADER ",\"ticks\":2}\n{\"tick\":3}");
    assert_int_equal(octree_session_length(&file.session), 2);
    session_release(&file);
    file = parse(HEADER ",\"keys\":\"wwq\"}\n{\"tick\":3}");
    assert_int_equal(octree_session_length(&file.session), 2);
    session_release(&file);
}

static void queries_are_read_in_each_form(void **state)
{
    session_file file = parse(HEADER ",\"queries\":[{\"knearest\":8,\"at\":[1,2,3]},{\"at\":\"player\",\"knearest\":0},"
                                     "{\"radius\":0.25,\"at\":\"player\"},{\"radius\":-0,\"at\":[4,5,6]}]}");
    const octree_query *queries = file.session.queries;
    (void)state;
    assert_int_equal(file.session.query_count, 4);
    assert_true(queries[0].kind == OCTREE_QUERY_KNEAREST && !queries[0].at_player && queries[0].k == 8);
    assert_vector(queries[0].target, 1, 2, 3);
    assert_true(queries[1].kind == OCTREE_QUERY_KNEAREST && queries[1].at_player && queries[1].k == 0);
    assert_true(queries[2].kind == OCTREE_QUERY_RADIUS && queries[2].at_player && queries[2].radius == 0.25);
    assert_true(queries[3].kind == OCTREE_QUERY_RADIUS && !queries[3].at_player && queries[3].radius == 0);
    assert_vector(queries[3].target, 4, 5, 6);
    session_release(&file);
}

static void sample_equals_octree_sample(void **state)
{
    session_file file = parse(HEADER ",\"points\":{\"sample\":\"clustered\",\"count\":2000,\"seed\":5},"
                                     "\"world\":{\"min\":[0,0,0],\"max\":[10,20,30]},\"player\":{\"id\":1000}}");
    static double positions[2000][3];
    (void)state;
    assert_int_equal(file.session.body_count, 2000);
    assert_int_equal(octree_sample(OCTREE_SAMPLE_CLUSTERED, 5, &file.session.tree.world, 2000, positions), OCTREE_OK);
    for (size_t i = 0; i < 2000; i++) {
        assert_memory_equal(file.session.bodies[i].position, positions[i], sizeof positions[i]);
        assert_int_equal(file.session.bodies[i].id, i + 1 < 1000 ? i + 1 : i + 2);
    }
    session_release(&file);
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void cloud_path_starts_at_the_folder_of_the_session(void **state)
{
    temp_folder *folder = *state;
    session_file file;
    octreel_error error;
    write_text(temp_file(folder, "cloud.xyz"), "500000.123456789 2 3\n4 5 6\n");
    write_text(temp_file(folder, "s.json"), HEADER ",\"points\":{\"file\":\"cloud.xyz\"}}");
    assert_true(session_read(temp_file(folder, "s.json"), &file, &error));
    assert_int_equal(file.session.body_count, 2);
    assert_vector(file.session.bodies[0].position, 500000.123456789, 2, 3);
    assert_int_equal(file.session.bodies[1].id, 2);
    session_release(&file);
    write_text(temp_file(folder, "cloud.xyz"), "1 2 3\n4 five 6\n");
    assert_false(session_read(temp_file(folder, "s.json"), &file, &error));
    assert_non_null(strstr(error.text, "/cloud.xyz:2: 'five' is not a number"));
    assert_memory_equal(error.text, folder->name, strlen(folder->name));
}

static void assert_file_is_refused(const char *path, const char *reason)
{
    session_file file;
    octreel_error error;
    char expected[256];
    snprintf(expected, sizeof expected, "%s: %s", path, reason);
    assert_false(session_read(path, &file, &error));
    assert_string_equal(error.text, expected);
}

static void missing_files_and_folders_are_refused(void **state)
{
    temp_folder *folder = *state;
    assert_file_is_refused(temp_file(folder, "missing"), "cannot be opened: No such file or directory");
    assert_file_is_refused(folder->name, "is not a regular file");
    assert_file_is_refused("/dev/zero", "is not a regular file");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(header_without_members_has_the_defaults),
        cmocka_unit_test(byte_order_mark_before_the_header_is_skipped),
        cmocka_unit_test(player_defaults_follow_world_and_step),
        cmocka_unit_test(player_may_be_a_body_or_missing),
        cmocka_unit_test(extreme_worlds_have_a_player_inside),
        cmocka_unit_test(points_are_read_in_each_form),
        cmocka_unit_test(velocities_are_listed_by_id_or_random),
        cmocka_unit_test(ticks_become_edits_and_queries_in_order),
        cmocka_unit_test(session_without_ticks_ends_at_its_last_key_or_object),
        cmocka_unit_test(queries_are_read_in_each_form),
        cmocka_unit_test(sample_equals_octree_sample),
        cmocka_unit_test_setup_teardown(cloud_path_starts_at_the_folder_of_the_session, temp_folder_make,
                                        temp_folder_remove),
        cmocka_unit_test_setup_teardown(missing_files_and_folders_are_refused, temp_folder_make, temp_folder_remove),
    };
    return cmocka_run_group_tests_name("session_file", tests, NULL, NULL);
}
