/* SPDX-License-Identifier: MIT */
/* test_many_changes.c - ticks in which very many nodes split and merge have short lines, and the nodes are found by
 * replaying the session. */
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "edits.h"
#include "octree/sample.h"
#include "recordings.h"
#include "text.h"
#include "ticks_write.h"
#include "verified.h"

enum { POINTS = 6000, TICKS = 3 };

/* Record a session in which all points move far. The point `extra` is inserted at this tick, and makes a node split. */
static place film_swarm(const temp_folder *own, const char *name, uint64_t extra_at, uint64_t every)
{
    static octree_game_body bodies[POINTS];
    static double places[POINTS][3];
    octree_session session = {.tree = define(cube(-1000, 1000), 2, 12, OCTREE_GROW), .ticks = TICKS};
    const octree_edit extra = {.tick = extra_at, .body = {.id = POINTS + 1, .position = {-999, -999, -999}}};
    const place folder = place_in(own, name);
    film_options options = small_film(folder.path);
    assert_int_equal(octree_sample(OCTREE_SAMPLE_UNIFORM, 1, &session.tree.world, POINTS, places), OCTREE_OK);
    uint64_t random = 1;
    for (size_t i = 0; i < POINTS; i++) {
        bodies[i] = (octree_game_body){.id = i + 1};
        memcpy(bodies[i].position, places[i], sizeof places[i]);
        for (int axis = 0; axis < 3; axis++)
            bodies[i].velocity[axis] = (double)random_below(&random, 401) - 200;
    }
    for (size_t i = 0; i < 2; i++) { /* two resting points, next to the extra one */
        bodies[i] = (octree_game_body){.id = i + 1, .position = {-998 + (double)i, -998, -998}};
    }
    session.bodies = bodies;
    session.body_count = POINTS;
    session.edits = &extra;
    session.edit_count = extra_at > 0;
    options.every = every;
    assert_filmed(&session, &options);
    return folder;
}

static void check_line(const char *line, size_t number, void *context)
{
    size_t *digested = context;
    assert_true(strlen(line) < 700);
    *digested += strstr(line, "\"splits\": {\"count\": ") && strstr(line, "\"merges\": {\"count\": ");
    (void)number;
}

static void ticks_with_many_changes_have_short_lines_and_verify(void **state)
{
    const place folder = film_swarm(*state, "film", 0, 0);
    size_t digested = 0;
    assert_int_equal(for_each_line(folder.path, check_line, &digested), TICKS + 1);
    assert_int_equal(digested, TICKS);
    assert_identical(&folder, TICKS + 1, 0);
    edit_line(folder.path, 2, "\"splits\": {\"count\": ", "\"splits\": {\"count\": 1");
    verify_report report = verify(&folder);
    assert_int_equal(report.count, 1);
    assert_string_equal(report.findings[0].fact, "splits");
}

/* Rewrite ticks.jsonl as earlier versions wrote it, with lists of all addresses. */
static void list_all(const place *folder)
{
    octree_game *game;
    session_file file;
    octreel_error error;
    const place path = place_below(folder->path, "session.json");
    if (!session_read(path.path, &file, &error))
        fail_msg("%s", error.text);
    assert_int_equal(octree_game_create(&file.session, &game), OCTREE_OK);
    for (size_t line = 0; line <= TICKS; line++) {
        text_stream s;
        char *text;
        assert_true(text_stream_begin(&s));
        tick_write(s.stream, octree_game_tick(game), &(tick_extras){.whole = true});
        assert_true(text_stream_end(&s, &text));
        replace_line(folder->path, line, text);
        free(text);
        octree_game_advance(game);
    }
    octree_game_destroy(game);
    session_release(&file);
}

static void lines_of_earlier_versions_with_full_lists_verify(void **state)
{
    const place folder = film_swarm(*state, "film", 0, 0);
    list_all(&folder);
    assert_identical(&folder, TICKS + 1, 0);
    edit_line(folder.path, 2, "\"splits\": [\"", "\"splits\": [\"0/0/0/0/0/0/0/0/0\", \"");
    verify_report report = verify(&folder);
    assert_int_equal(report.count, 1);
    assert_string_equal(report.findings[0].fact, "splits");
}

static void assert_says(const char *command, const place *a, const place *b, const char *part)
{
    command_result result = run_octreel(NULL, "%s %s %s --json --causes all", command, a->path, b->path);
    assert_int_equal(result.status, 1);
    if (!strstr(result.out, part))
        fail_msg("\"%.3000s\" does not contain \"%s\"", result.out, part);
    command_release(&result);
}

/* In one session a point is inserted a tick earlier: at the next tick the trees are equal, but only one of them has
 * just split there. */
static void cause_names_one_node_of_many_changes(void **state)
{
    const place a = film_swarm(*state, "a", 2, 1), b = film_swarm(*state, "b", 1, 1);
    assert_says("diff", &a, &b, "\"where\": \"splits\"");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(ticks_with_many_changes_have_short_lines_and_verify),
        TEST(lines_of_earlier_versions_with_full_lists_verify),
        TEST(cause_names_one_node_of_many_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
