/* test_session_file.c - sessions from files and to files. */
#include "fixture.h"
#include "octree/sample.h"
#include "random_session.h"
#include "session_file.h"
#include "temp_folder.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADER "{\"octreel\":\"session\",\"version\":1"

/* ---- Reading ------------------------------------------------------------------------------------------------ */

static session_file parse(const char *text)
{
    session_file file;
    session_error error = {""};
    if (!session_parse("s.json", "", text, strlen(text), &file, &error))
        fail_msg("%s", error.text);
    return file;
}

static void assert_vector(const double found[3], double x, double y, double z)
{
    const double expected[3] = {x, y, z};
    assert_memory_equal(found, expected, sizeof expected);
}

static void header_alone_is_the_default_world(void **state)
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

static void player_follows_the_world_and_the_box_the_step(void **state)
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
    const octree_body *bodies = file.session.bodies;
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

static void sample_is_that_of_the_library(void **state)
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

static void cloud_is_found_in_the_folder_of_the_session(void **state)
{
    temp_folder *folder = *state;
    session_file file;
    session_error error;
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
    session_error error;
    char expected[256];
    snprintf(expected, sizeof expected, "%s: %s", path, reason);
    assert_false(session_read(path, &file, &error));
    assert_string_equal(error.text, expected);
}

static void file_that_is_missing_or_no_file_is_refused(void **state)
{
    temp_folder *folder = *state;
    assert_file_is_refused(temp_file(folder, "missing"), "cannot be opened: No such file or directory");
    assert_file_is_refused(folder->name, "is not a regular file");
    assert_file_is_refused("/dev/zero", "is not a regular file");
}

/* ---- Round trips -------------------------------------------------------------------------------------------- */

static char *write_session(const octree_session *session)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    assert_true(session_write(session, out));
    assert_int_equal(fclose(out), 0);
    return text;
}

static void assert_same_start(const octree_session *a, const octree_session *b)
{
    assert_memory_equal(&a->tree.world, &b->tree.world, sizeof a->tree.world);
    assert_int_equal(a->tree.leaf_capacity, b->tree.leaf_capacity);
    assert_int_equal(a->tree.max_depth, b->tree.max_depth);
    assert_int_equal(a->tree.full_leaf, b->tree.full_leaf);
    assert_int_equal(a->player.id, b->player.id);
    assert_memory_equal(a->player.position, b->player.position, sizeof a->player.position);
    assert_memory_equal(&a->player.step, &b->player.step, sizeof a->player.step);
    assert_memory_equal(&a->player.box_size, &b->player.box_size, sizeof a->player.box_size);
    assert_int_equal(a->player.sweep, b->player.sweep);
    assert_int_equal(a->ticks, b->ticks);
    assert_int_equal(a->keys != NULL, b->keys != NULL);
    if (a->keys)
        assert_string_equal(a->keys, b->keys);
    assert_int_equal(a->body_count, b->body_count);
    if (a->body_count > 0)
        assert_memory_equal(a->bodies, b->bodies, a->body_count * sizeof *a->bodies);
}

static void assert_same_edit(const octree_edit *a, const octree_edit *b)
{
    assert_int_equal(a->tick, b->tick);
    assert_int_equal(a->kind, b->kind);
    assert_int_equal(a->body.id, b->body.id);
    if (a->kind != OCTREE_EDIT_REMOVE)
        assert_memory_equal(a->body.position, b->body.position, sizeof a->body.position);
    if (a->kind == OCTREE_EDIT_INSERT)
        assert_memory_equal(a->body.velocity, b->body.velocity, sizeof a->body.velocity);
}

static void assert_same_query(const octree_query *a, const octree_query *b)
{
    assert_int_equal(a->tick, b->tick);
    assert_int_equal(a->kind, b->kind);
    assert_int_equal(a->at_player, b->at_player);
    if (a->kind == OCTREE_QUERY_RANGE)
        assert_memory_equal(&a->box, &b->box, sizeof a->box);
    else if (!a->at_player)
        assert_memory_equal(a->target, b->target, sizeof a->target);
    if (a->kind == OCTREE_QUERY_KNEAREST)
        assert_int_equal(a->k, b->k);
    if (a->kind == OCTREE_QUERY_RADIUS)
        assert_memory_equal(&a->radius, &b->radius, sizeof a->radius);
}

static void assert_same_session(const octree_session *a, const octree_session *b)
{
    assert_same_start(a, b);
    assert_int_equal(a->edit_count, b->edit_count);
    for (size_t i = 0; i < a->edit_count; i++)
        assert_same_edit(&a->edits[i], &b->edits[i]);
    assert_int_equal(a->query_count, b->query_count);
    for (size_t i = 0; i < a->query_count; i++)
        assert_same_query(&a->queries[i], &b->queries[i]);
}

static void assert_round_trip(const octree_session *session)
{
    char *text = write_session(session);
    session_file file = parse(text);
    assert_same_session(session, &file.session);
    char *again = write_session(&file.session);
    assert_string_equal(text, again);
    free(again);
    free(text);
    session_release(&file);
}

static void default_session_survives_the_round_trip(void **state)
{
    const octree_session session = octree_session_default();
    (void)state;
    assert_round_trip(&session);
}

static void random_sessions_survive_the_round_trip(void **state)
{
    static random_session made;
    (void)state;
    for (uint64_t seed = 0; seed < 200; seed++) {
        random_session_full(&made, seed);
        assert_round_trip(&made.session);
    }
}

/* Random bits that are finite doubles. */
static double any_double(uint64_t *state)
{
    double value;
    do {
        uint64_t bits = octree_random(state);
        memcpy(&value, &bits, sizeof value);
    } while (!(value >= -DBL_MAX && value <= DBL_MAX));
    return value;
}

static void every_bit_of_a_number_survives_the_round_trip(void **state)
{
    static octree_body bodies[500];
    uint64_t random = 11;
    octree_session session = octree_session_default();
    (void)state;
    session.bodies = bodies;
    session.body_count = sizeof bodies / sizeof *bodies;
    for (size_t i = 0; i < session.body_count; i++) {
        bodies[i].id = SESSION_ID_LIMIT - 1 - i;
        for (int axis = 0; axis < 3; axis++) {
            bodies[i].position[axis] = any_double(&random);
            bodies[i].velocity[axis] = i % 3 == 0 ? any_double(&random) : i % 3 == 1 ? -0.0 : 0.0;
        }
    }
    session.player.position[1] = -0.0;
    session.player.step = 5e-324;
    session.player.box_size = DBL_MAX;
    assert_round_trip(&session);
}

static void options_that_the_tree_clamps_are_written_clamped(void **state)
{
    octree_session session = octree_session_default();
    (void)state;
    session.tree.leaf_capacity = SIZE_MAX;
    session.tree.max_depth = SIZE_MAX;
    session.tree.full_leaf = OCTREE_GROW;
    char *text = write_session(&session);
    session_file file = parse(text);
    assert_true(file.session.tree.leaf_capacity == UINT32_MAX);
    assert_int_equal(file.session.tree.max_depth, OCTREE_MAX_DEPTH);
    assert_int_equal(file.session.tree.full_leaf, OCTREE_GROW);
    free(text);
    session_release(&file);
}

static void neighbours_beyond_what_a_tree_holds_are_written_clamped(void **state)
{
    const octree_query all = {.kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = SIZE_MAX};
    octree_session session = octree_session_default();
    (void)state;
    session.queries = &all;
    session.query_count = 1;
    char *text = write_session(&session);
    session_file file = parse(text);
    assert_true(file.session.queries[0].k == UINT32_MAX);
    free(text);
    session_release(&file);
}

static void written_session_has_a_point_a_line_and_a_tick_a_line(void **state)
{
    static const char expected[] =
        "{\"octreel\": \"session\", \"version\": 1,\n"
        "\"world\": {\"min\": [-1000, -1000, -1000], \"max\": [1000, 1000, 1000]},\n"
        "\"tree\": {\"capacity\": 8, \"depth\": 21, \"full\": \"refuse\"},\n"
        "\"player\": {\"id\": 0, \"position\": [0, 0, 0], \"step\": 50, \"box_size\": 30},\n"
        "\"keys\": \"wn\",\n"
        "\"ticks\": 2,\n"
        "\"queries\": [{\"nearest\": \"player\"}],\n"
        "\"points\": [\n"
        "[1, 2, 3, 1],\n"
        "{\"id\": 7, \"position\": [0.5, 0, 0], \"velocity\": [1, 0, 0]}\n"
        "]}\n"
        "{\"tick\": 1, \"edits\": [{\"remove\": 7}], \"queries\": [{\"nearest\": [0, 0, 0]}]}\n"
        "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 9, \"position\": [1, 1, 1]}}]}\n";
    session_file file = parse(expected);
    char *text = write_session(&file.session);
    (void)state;
    assert_string_equal(text, expected);
    free(text);
    session_release(&file);
}

static void stream_without_room_is_told(void **state)
{
    const octree_session session = octree_session_default();
    char room[16];
    FILE *full = fmemopen(room, sizeof room, "w");
    (void)state;
    assert_non_null(full);
    assert_false(session_write(&session, full));
    fclose(full);
}

/* So many points that anything quadratic is felt. */
static void many_points_survive_the_round_trip(void **state)
{
    session_file file =
        parse(HEADER ",\"points\":{\"sample\":\"uniform\",\"count\":20000},\"velocities\":{\"speed\":1}}");
    (void)state;
    assert_round_trip(&file.session);
    session_release(&file);
}

/* ---- Copies and keys ---------------------------------------------------------------------------------------- */

static void copy_owns_all_it_has(void **state)
{
    random_session *made = calloc(1, sizeof *made);
    session_file file;
    session_error error;
    (void)state;
    assert_non_null(made);
    random_session_full(made, 3);
    assert_true(session_copy(&made->session, &file, &error));
    assert_same_session(&made->session, &file.session);
    memset(made, 0xff, sizeof *made);
    random_session_full(made, 3);
    assert_same_session(&made->session, &file.session);
    free(made);
    char *text = write_session(&file.session);
    free(text);
    session_release(&file);
    session_release(&file);
}

static void keys_are_replaced(void **state)
{
    const octree_session session = octree_session_default();
    session_file file;
    session_error error;
    (void)state;
    assert_true(session_copy(&session, &file, &error));
    assert_true(session_set_keys(&file, "wwdn.", &error));
    assert_string_equal(file.session.keys, "wwdn.");
    assert_int_equal(octree_session_length(&file.session), 5);
    session_release(&file);
}

static void unknown_keys_are_refused_and_change_nothing(void **state)
{
    static const struct {
        const char *keys, *sentence;
    } rows[] = {
        {"wwx", "key 3, 'x', is not one of w a s d e f n q ."},
        {" w", "key 1, ' ', is not one of w a s d e f n q ."},
        {"W", "key 1, 'W', is not one of w a s d e f n q ."},
        {"w\xc3\xa9", "key 2, byte 0xc3, is not one of w a s d e f n q ."},
        {"w\n", "key 2, byte 0x0a, is not one of w a s d e f n q ."},
    };
    octree_session session = octree_session_default();
    session_file file, refused;
    session_error error;
    (void)state;
    assert_true(session_copy(&session, &file, &error));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_false(session_set_keys(&file, rows[i].keys, &error));
        assert_string_equal(error.text, rows[i].sentence);
        session.keys = rows[i].keys;
        assert_false(session_copy(&session, &refused, &error));
        assert_string_equal(error.text, rows[i].sentence);
    }
    session.keys = octree_session_default().keys;
    assert_same_session(&session, &file.session);
    session_release(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(header_alone_is_the_default_world),
        cmocka_unit_test(player_follows_the_world_and_the_box_the_step),
        cmocka_unit_test(extreme_worlds_have_a_player_inside),
        cmocka_unit_test(points_are_read_in_each_form),
        cmocka_unit_test(velocities_are_listed_by_id_or_random),
        cmocka_unit_test(ticks_become_edits_and_queries_in_order),
        cmocka_unit_test(queries_are_read_in_each_form),
        cmocka_unit_test(neighbours_beyond_what_a_tree_holds_are_written_clamped),
        cmocka_unit_test(sample_is_that_of_the_library),
        cmocka_unit_test_setup_teardown(cloud_is_found_in_the_folder_of_the_session, temp_folder_make,
                                        temp_folder_remove),
        cmocka_unit_test_setup_teardown(file_that_is_missing_or_no_file_is_refused, temp_folder_make,
                                        temp_folder_remove),
        cmocka_unit_test(default_session_survives_the_round_trip),
        cmocka_unit_test(random_sessions_survive_the_round_trip),
        cmocka_unit_test(every_bit_of_a_number_survives_the_round_trip),
        cmocka_unit_test(options_that_the_tree_clamps_are_written_clamped),
        cmocka_unit_test(written_session_has_a_point_a_line_and_a_tick_a_line),
        cmocka_unit_test(stream_without_room_is_told),
        cmocka_unit_test(many_points_survive_the_round_trip),
        cmocka_unit_test(copy_owns_all_it_has),
        cmocka_unit_test(keys_are_replaced),
        cmocka_unit_test(unknown_keys_are_refused_and_change_nothing),
    };
    return cmocka_run_group_tests_name("session_file", tests, NULL, NULL);
}
