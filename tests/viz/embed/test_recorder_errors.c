/* SPDX-License-Identifier: MIT */
/* test_recorder_errors.c - a recorder refuses invalid calls, each with its own status and sentence, and loses nothing.
 */
#include "fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "film_again.h"
#include "moving_tree.h"
#include "recordings.h"
#include "session_file.h"
#include "recording_file.h"

static void assert_not_opened(const octreel_recorder_def *def, octreel_status why, const char *part)
{
    octreel_recorder *recorder = (octreel_recorder *)def; /* anything but null */
    octreel_error error = {""};
    assert_int_equal(octreel_recorder_open(def, &recorder, &error), why);
    assert_null(recorder);
    if (strstr(error.text, part) == NULL)
        fail_msg("%s", error.text);
    assert_int_equal(octreel_recorder_open(def, &recorder, NULL), why);
}

static void every_status_has_its_own_sentence(void **state)
{
    (void)state;
    for (int i = 0; i < OCTREEL_STATUS_COUNT; i++)
        for (int j = 0; j < i; j++)
            assert_string_not_equal(octreel_status_text((octreel_status)i), octreel_status_text((octreel_status)j));
    assert_non_null(octreel_status_text(OCTREEL_STATUS_COUNT));
}

static void invalid_definitions_are_refused(void **state)
{
    const place folder = place_in(*state, "film");
    octreel_recorder *recorder;
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    const octreel_recorder_def good = small_recorder(&m, folder.path);
    octreel_recorder_def bad = good;
#define REFUSE(member, value, why, part)                                                                               \
    bad = good;                                                                                                        \
    bad.member = value;                                                                                                \
    assert_not_opened(&bad, why, part)
    REFUSE(folder, NULL, OCTREEL_NULL_ARGUMENT, "folder");
    REFUSE(folder, "", OCTREEL_BAD_FOLDER, "name is empty");
    REFUSE(camera, NULL, OCTREEL_NULL_ARGUMENT, "null");
    REFUSE(camera, "drone", OCTREEL_BAD_OPTION, "unknown camera \"drone\"");
    REFUSE(layers, "nodes,walls", OCTREEL_BAD_OPTION, "\"walls\"");
    REFUSE(color_by, "mood", OCTREEL_BAD_OPTION, "\"mood\"");
    REFUSE(color_points, "mood", OCTREEL_BAD_OPTION, "\"mood\"");
    REFUSE(shade, "mood", OCTREEL_BAD_OPTION, "\"mood\"");
    REFUSE(shade, NULL, OCTREEL_NULL_ARGUMENT, "octreel_recorder_def_default()");
    REFUSE(layers, NULL, OCTREEL_NULL_ARGUMENT, "a name in the definition is null");
    REFUSE(color_by, NULL, OCTREEL_NULL_ARGUMENT, "null");
    REFUSE(color_points, NULL, OCTREEL_NULL_ARGUMENT, "null");
    REFUSE(show_tree, NULL, OCTREEL_NULL_ARGUMENT, "null");
    REFUSE(diagram, NULL, OCTREEL_NULL_ARGUMENT, "null");
    REFUSE(fill, NULL, OCTREEL_NULL_ARGUMENT, "null");
    REFUSE(context, NULL, OCTREEL_NULL_ARGUMENT, "null");
    REFUSE(fill, "glow", OCTREEL_BAD_OPTION, "fill: unknown rasterizer \"glow\"");
    REFUSE(show_tree, "mine", OCTREEL_BAD_OPTION, "unknown tree \"mine\"");
    REFUSE(diagram, "above", OCTREEL_BAD_OPTION, "unknown diagram \"above\"");
    REFUSE(context, "glx", OCTREEL_BAD_OPTION, "context: unknown name \"glx\"");
    REFUSE(any_renderer, true, OCTREEL_BAD_OPTION, "any_renderer");
    REFUSE(width, 0, OCTREEL_BAD_OPTION, "0 x 90");
    REFUSE(width, 16385, OCTREEL_BAD_OPTION, "16385 x 90");
    REFUSE(height, -1, OCTREEL_BAD_OPTION, "160 x -1");
    REFUSE(height, 16385, OCTREEL_BAD_OPTION, "160 x 16385");
    REFUSE(aa, 3, OCTREEL_BAD_OPTION, "aa takes 1, 2 or 4");
    REFUSE(lod, NAN, OCTREEL_BAD_OPTION, "lod takes pixels from 0");
    REFUSE(budget, UINT64_MAX, OCTREEL_BAD_OPTION, "budget takes");
    REFUSE(every, UINT64_MAX, OCTREEL_BAD_OPTION, "every");
    REFUSE(queue_ticks, 0, OCTREEL_BAD_OPTION, "queue_ticks");
    REFUSE(tree.leaf_capacity, OCTREE_AUTO, OCTREEL_BAD_OPTION, "tree: leaf_capacity is OCTREE_AUTO");
    REFUSE(tree.leaf_capacity, 0, OCTREEL_BAD_OPTION, "tree: the leaf capacity");
    REFUSE(tree.world.min[1], NAN, OCTREEL_BAD_OPTION, "tree: the world");
    REFUSE(player.kind, OCTREE_PLAYER_KEYS, OCTREEL_BAD_OPTION, "player");
    bad = good;
    bad.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .box_size = NAN};
    assert_not_opened(&bad, OCTREEL_BAD_OPTION, "box_size");
    bad.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .box_size = INFINITY};
    assert_not_opened(&bad, OCTREEL_BAD_OPTION, "box_size");
    bad.player = (octree_player){.kind = OCTREE_PLAYER_BODY, .id = SESSION_ID_LIMIT};
    assert_not_opened(&bad, OCTREEL_BAD_ID, "9007199254740992");
    assert_int_equal(octreel_recorder_open(NULL, &recorder, NULL), OCTREEL_NULL_ARGUMENT);
    assert_int_equal(octreel_recorder_open(&good, NULL, NULL), OCTREEL_NULL_ARGUMENT);
    moving_tree_release(&m);
}

static void folder_of_another_recording_is_unchanged(void **state)
{
    const place folder = place_in(*state, "film"), file = place_in(*state, "file");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    octreel_recorder_def def = small_recorder(&m, folder.path);
    octreel_recorder *recorder = open_recorder(&def);
    record_steps(recorder, &m, 2);
    close_recorder(recorder);
    const listing before = folder_list(folder.path);
    assert_not_opened(&def, OCTREEL_BAD_FOLDER, "already holds a recording");
    const listing after = folder_list(folder.path);
    assert_int_equal(before.count, after.count);
    listing_release((listing *)&before);
    listing_release((listing *)&after);
    file_write_text(file.path, "mine");
    def.folder = file.path;
    assert_not_opened(&def, OCTREEL_BAD_FOLDER, "a file has this name");
    moving_tree_release(&m);
}

static void recording_is_replaced_on_request(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    octreel_recorder_def def = small_recorder(&m, folder.path);
    def.replace = true;
    for (int ticks = 5; ticks > 2; ticks--) {
        octreel_recorder *recorder = open_recorder(&def);
        record_steps(recorder, &m, ticks);
        close_recorder(recorder);
    }
    assert_films_again(&folder, &again, 3);
    octreel_recorder *ring = NULL, *idle = open_recorder(&def); /* neither gets a tick */
    assert_int_equal(octreel_recorder_close(idle), OCTREEL_NOTHING);
    octreel_recorder_destroy(idle);
    assert_same_folders(folder.path, again.path, NULL);
    def.ring = 2;
    ring = open_recorder(&def);
    record_steps(ring, &m, 2);
    assert_int_equal(octreel_recorder_write(ring, folder.path, NULL), OCTREEL_OK);
    assert_int_equal(octreel_recorder_write(ring, folder.path, NULL), OCTREEL_OK);
    close_recorder(ring);
    moving_tree_release(&m);
    assert_int_equal(for_each_line(folder.path, NULL, NULL), 2);
}

/* Record three ticks with a queue of one tick. Tick 2 enters the queue when tick 1 has left it, after tick 0 is filmed.
 */
static void record_until_begun(octreel_recorder *recorder, moving_tree *m)
{
    record_steps(recorder, m, 3);
}

/* Not even by the same process. */
static void recording_in_progress_is_not_replaced(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    octreel_recorder_def def = small_recorder(&m, folder.path);
    def.replace = true;
    def.queue_ticks = 1;
    octreel_recorder *early = open_recorder(&def), *recorder = open_recorder(&def);
    record_until_begun(recorder, &m);
    assert_not_opened(&def, OCTREEL_BAD_FOLDER, "is recording into this folder");
    assert_int_equal(octreel_recorder_tick(early, m.tree, NULL), OCTREEL_OK); /* the worker finds the error later */
    assert_int_equal(octreel_recorder_close(early), OCTREEL_BAD_FOLDER);
    octreel_recorder_destroy(early);
    record_steps(recorder, &m, 2);
    close_recorder(recorder);
    moving_tree_release(&m);
    assert_films_again(&folder, &again, 5);
}

/* The test fails unless a tick is refused with this status and a sentence with this part. */
static void assert_refused(octreel_recorder *recorder, const octree *tree, const octreel_tick_info *about,
                           octreel_status why, const char *part)
{
    assert_int_equal(octreel_recorder_tick(recorder, tree, about), why);
    if (strstr(octreel_recorder_error(recorder), part) == NULL)
        fail_msg("%s", octreel_recorder_error(recorder));
}

static void refuse_queries(octreel_recorder *recorder, const octree *tree)
{
    const octree_query rows[] = {
        {.kind = OCTREE_QUERY_NEAREST, .target = {0, NAN, 0}},
        {.kind = OCTREE_QUERY_RADIUS, .radius = INFINITY},
        {.kind = OCTREE_QUERY_RADIUS, .radius = -1},
        {.kind = OCTREE_QUERY_RANGE, .box = {{0, 0, 0}, {0, 0, -1}}},
        {.kind = OCTREE_QUERY_RANGE, .box = {{0, 0, 0}, {0, 0, INFINITY}}},
        {.kind = OCTREE_QUERY_RANGE, .box = {{0, -INFINITY, 0}, {0, 0, 0}}},
        {.kind = OCTREE_QUERY_RANGE, .skip = OCTREE_SKIP_COINCIDENT},
        {.kind = OCTREE_QUERY_RADIUS, .epsilon = -1},
        {.kind = OCTREE_QUERY_NEAREST, .skip = OCTREE_SKIP_ID, .skip_id = UINT64_C(1) << 53},
        {.kind = OCTREE_QUERY_NEAREST, .at_player = true}, /* there is no player */
        {.kind = OCTREE_QUERY_KINDS},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const octree_query queries[2] = {{.kind = OCTREE_QUERY_NEAREST}, rows[i]};
        const octreel_tick_info about = {.queries = queries, .query_count = 2};
        const bool unlisted = rows[i].skip == OCTREE_SKIP_COINCIDENT || rows[i].kind == OCTREE_QUERY_KINDS;
        assert_refused(recorder, tree, &about, OCTREEL_BAD_QUERY,
                       unlisted ? "queries[1]: unknown kind or unknown skip" : "queries[1]: ");
    }
}

static void refuse_shapes(octreel_recorder *recorder, const octree *tree)
{
    octree_shape rows[] = {
        {.kind = OCTREE_SHAPE_POINT, .at = {NAN, 0, 0}},
        {.kind = OCTREE_SHAPE_SEGMENT, .to = {0, -INFINITY, 0}},
        {.kind = OCTREE_SHAPE_BOX, .at = {1, 0, 0}},
        {.kind = OCTREE_SHAPE_LABEL, .text = "\n"},
        {.kind = OCTREE_SHAPE_LABEL},
        {.kind = OCTREE_SHAPE_KINDS},
    };
    memset(rows[4].text, 'x', sizeof rows[4].text);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const octreel_tick_info about = {.shapes = &rows[i], .shape_count = 1};
        assert_refused(recorder, tree, &about, OCTREEL_BAD_SHAPE, "shapes[0]: ");
    }
}

static void refuse_trees(octreel_recorder *recorder, const octree *tree)
{
    const octree_def def = octree_definition(tree);
    octree *others[] = {make_tree(cube(-8, 9), 1, 2, OCTREE_GROW), make_tree(cube(-9, 8), 1, 2, OCTREE_GROW),
                        make_tree(def.world, 2, 2, OCTREE_GROW), make_tree(def.world, 1, 3, OCTREE_GROW),
                        make_tree(def.world, 1, 2, OCTREE_REFUSE)};
    static const char *const differences[] = {"world on axis x is [-8, 9]", "world on axis x is [-9, 8]",
                                              "leaf_capacity is 2", "max_depth is 3", "full_leaf"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        assert_refused(recorder, others[i], NULL, OCTREEL_OTHER_TREE, differences[i]);
        octree_destroy(others[i]);
    }
    octree *twice = make_tree(def.world, 1, 2, OCTREE_GROW);
    for (uint64_t i = 0; i < 300; i++)
        assert_int_equal(octree_insert(twice, (double[]){1, 2, (double)i / 100}, i % 299), OCTREE_OK);
    assert_refused(recorder, twice, NULL, OCTREEL_DUPLICATE_ID, "same id: 0");
    octree_destroy(twice);
    octree *large = make_tree(def.world, 1, 2, OCTREE_GROW);
    assert_int_equal(octree_insert(large, (double[]){1, 2, 3}, SESSION_ID_LIMIT), OCTREE_OK);
    assert_refused(recorder, large, NULL, OCTREEL_BAD_ID, "9007199254740992");
    octree_destroy(large);
    assert_refused(recorder, NULL, NULL, OCTREEL_NULL_ARGUMENT, "null");
}

/* Between two ticks of a program, every invalid call is tried: all of them are gaps, and the program's changes are
 * recorded with the next tick. */
static void refused_tick_is_a_gap_and_nothing_else_is_lost(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    enum { TICKS = 6, REFUSED = 27, ALL = TICKS * (REFUSED + 1) };
    uint64_t expected[ALL] = {0}, told[ALL];
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 4);
    const octreel_recorder_def def = small_recorder(&m, folder.path);
    octreel_recorder *recorder = open_recorder(&def);
    for (int tick = 0; tick < TICKS; tick++) {
        assert_recorded(recorder, &m);
        expected[(size_t)tick * (REFUSED + 1)] = octree_digest(m.tree);
        moving_tree_step(&m);
        refuse_queries(recorder, m.tree);
        refuse_shapes(recorder, m.tree);
        refuse_trees(recorder, m.tree);
        assert_refused(recorder, m.tree, &(octreel_tick_info){.query_count = 1}, OCTREEL_NULL_ARGUMENT, "null");
        assert_refused(recorder, m.tree, &(octreel_tick_info){.shape_count = 1}, OCTREEL_NULL_ARGUMENT, "null");
        assert_int_equal(octreel_recorder_write(recorder, again.path, NULL), OCTREEL_NO_RING);
    }
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_GAPS);
    octreel_recorder_destroy(recorder);
    moving_tree_release(&m);
    assert_int_equal(tree_digests(folder.path, told, ALL), ALL);
    assert_memory_equal(told, expected, sizeof told);
    assert_films_again(&folder, &again, ALL);
}

static void closed_recorder_reports_its_state(void **state)
{
    const place folder = place_in(*state, "film");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    const octreel_recorder_def def = small_recorder(&m, folder.path);
    octreel_recorder *recorder = open_recorder(&def);
    record_steps(recorder, &m, 1);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_OK);
    assert_refused(recorder, m.tree, NULL, OCTREEL_CLOSED, "closed");
    assert_int_equal(octreel_recorder_write(recorder, folder.path, NULL), OCTREEL_CLOSED);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_CLOSED);
    octreel_recorder_destroy(recorder);
    moving_tree_release(&m);
}

static void recorder_without_a_tick_reports_it_and_leaves_no_recording(void **state)
{
    const place folder = place_in(*state, "film");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    const octreel_recorder_def def = small_recorder(&m, folder.path);
    octreel_recorder *recorder = open_recorder(&def);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_NOTHING);
    octreel_recorder_destroy(recorder);
    const listing names = folder_list(folder.path);
    assert_int_equal(names.count, 0);
    listing_release((listing *)&names);
    moving_tree_release(&m);
}

/* Record ticks until one is refused; the worker may notice the error some ticks late. */
static void record_until_broken(octreel_recorder *recorder, moving_tree *m, const char *part)
{
    octreel_status status = OCTREEL_OK;
    for (int i = 0; status == OCTREEL_OK && i < 200; i++) {
        moving_tree_step(m);
        status = octreel_recorder_tick(recorder, m->tree, &m->about);
    }
    assert_int_equal(status, OCTREEL_BROKEN);
    if (strstr(octreel_recorder_error(recorder), part) == NULL)
        fail_msg("%s", octreel_recorder_error(recorder));
    assert_refused(recorder, m->tree, NULL, OCTREEL_BROKEN, part);
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_BROKEN);
    assert_non_null(strstr(octreel_recorder_error(recorder), part));
    octreel_recorder_destroy(recorder);
}

/* Resume the recording, as octreel record --resume does. */
static void resume(const place *folder)
{
    const place path = place_below(folder->path, "session.json");
    film_options options = {.folder = folder->path, .resume = true};
    octreel_error error = {""};
    octreel_error unread = {""};
    session_file file;
    assert_true(recording_read(folder->path, &options.view, &options.every, &error));
    if (!session_read(path.path, &file, &unread))
        fail_msg("%s", unread.text);
    assert_filmed(&file.session, &options);
    session_release(&file);
}

static uint64_t ticks_of(const place *folder)
{
    return for_each_line(folder->path, NULL, NULL);
}

static void unwritable_frame_ends_the_recording_and_resume_completes_it(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    octreel_recorder_def def = small_recorder(&m, folder.path);
    def.queue_ticks = 1;
    octreel_recorder *recorder = open_recorder(&def);
    const place blocked = frame_place(folder.path, 7);
    record_until_begun(recorder, &m);
    assert_int_equal(mkdir(blocked.path, 0777), 0);
    record_until_broken(recorder, &m, "frame_000007.png");
    moving_tree_release(&m);
    assert_int_equal(rmdir(blocked.path), 0);
    assert_int_equal(ticks_of(&folder), 7);
    resume(&folder);
    assert_films_again(&folder, &again, 8);
}

/* The disk is full when ticks.jsonl has some forty lines. The worker blocks the signal of the file limit. */
static void full_disk_ends_the_recording_and_resume_completes_it(void **state)
{
    const place folder = place_in(*state, "film"), again = place_in(*state, "again");
    struct rlimit limit, none;
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    octreel_recorder_def def = small_recorder(&m, folder.path);
    def.every = 1000;
    octreel_recorder *recorder = open_recorder(&def);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &none), 0);
    limit = none;
    limit.rlim_cur = 60000;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    record_until_broken(recorder, &m, "ticks.jsonl: cannot be written: File too large");
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &none), 0);
    moving_tree_release(&m);
    assert_nothing_half_written(folder.path);
    const uint64_t ticks = ticks_of(&folder);
    assert_true(ticks > 5);
    resume(&folder);
    assert_films_again(&folder, &again, ticks + 1); /* the tick that failed is not lost */
}

static void vanished_folder_ends_the_recording(void **state)
{
    const place folder = place_in(*state, "film"), gone = place_in(*state, "gone");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    octreel_recorder_def def = small_recorder(&m, folder.path);
    def.queue_ticks = 1;
    octreel_recorder *recorder = open_recorder(&def);
    record_until_begun(recorder, &m);
    assert_int_equal(rename(folder.path, gone.path), 0);
    record_until_broken(recorder, &m, folder.path);
    moving_tree_release(&m);
}

/* Between opening and tick 0 another process has taken the folder. */
static void failed_first_tick_leaves_no_recording(void **state)
{
    const place folder = place_in(*state, "film");
    const place mine = place_below(folder.path, "renderer.json.part");
    moving_tree m;
    moving_tree_make(&m, OCTREE_GROW, 1);
    const octreel_recorder_def def = small_recorder(&m, folder.path);
    octreel_recorder *recorder = open_recorder(&def);
    assert_int_equal(mkdir(mine.path, 0777), 0);
    assert_int_equal(octreel_recorder_tick(recorder, m.tree, NULL), OCTREEL_OK); /* the worker finds the error later */
    assert_int_equal(octreel_recorder_close(recorder), OCTREEL_BAD_FOLDER);
    assert_non_null(strstr(octreel_recorder_error(recorder), "renderer.json"));
    octreel_recorder_destroy(recorder);
    const listing names = folder_list(folder.path);
    assert_int_equal(names.count, 1);
    listing_release((listing *)&names);
    moving_tree_release(&m);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_status_has_its_own_sentence),
        TEST(invalid_definitions_are_refused),
        TEST(folder_of_another_recording_is_unchanged),
        TEST(recording_is_replaced_on_request),
        TEST(recording_in_progress_is_not_replaced),
        TEST(refused_tick_is_a_gap_and_nothing_else_is_lost),
        TEST(closed_recorder_reports_its_state),
        TEST(recorder_without_a_tick_reports_it_and_leaves_no_recording),
        TEST(unwritable_frame_ends_the_recording_and_resume_completes_it),
        TEST(full_disk_ends_the_recording_and_resume_completes_it),
        TEST(vanished_folder_ends_the_recording),
        TEST(failed_first_tick_leaves_no_recording),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
