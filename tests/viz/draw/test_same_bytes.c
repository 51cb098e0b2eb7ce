/* SPDX-License-Identifier: MIT */
/* test_same_bytes.c - a recording has the same bytes, except renderer.json: recorded twice, replayed from its own
 * session.json, by the library or the program, through any context, with any number of threads and on any processor. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "random_session.h"
#include "recordings.h"
#include "session_file.h"

static const char VIEW[] = "--size 160x90 --every 40 --camera orbit";

static void assert_filmed_by_program(const command_setting *setting, const char *session, const char *view,
                                     const char *folder)
{
    command_result result = run_octreel(setting, "record %s %s -o %s", session, view, folder);
    assert_done(&result);
    command_release(&result);
}

static void two_recordings_have_the_same_bytes(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    const octree_session session = octree_session_default();
    const film_options first = small_film(a.path), second = small_film(b.path);
    assert_filmed(&session, &first);
    assert_filmed(&session, &second);
    assert_same_folders(a.path, b.path, NULL);
}

static void program_and_library_record_the_same_bytes(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    const octree_session session = octree_session_default();
    film_options options = small_film(a.path);
    options.every = 40;
    options.view.camera = CAMERA_ORBIT;
    options.view.diagram = DIAGRAM_BESIDE; /* as the program shows its example */
    assert_filmed(&session, &options);
    assert_filmed_by_program(NULL, "", VIEW, b.path);
    assert_same_folders(a.path, b.path, NULL);
}

/* Environments of a renderer: vector width in bits, processor features and threads. Every pair of values from different
 * columns occurs in a row. */
static const command_setting machines[] = {
    {.environment = {"LP_NATIVE_VECTOR_WIDTH=128", "GALLIUM_OVERRIDE_CPU_CAPS=nosse", "LP_NUM_THREADS=0"}},
    {.environment = {"LP_NATIVE_VECTOR_WIDTH=128", "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1", "LP_NUM_THREADS=3"}},
    {.environment = {"LP_NATIVE_VECTOR_WIDTH=128", "LP_NUM_THREADS=8"}},
    {.environment = {"LP_NATIVE_VECTOR_WIDTH=256", "GALLIUM_OVERRIDE_CPU_CAPS=nosse", "LP_NUM_THREADS=3"}},
    {.environment = {"LP_NATIVE_VECTOR_WIDTH=256", "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1", "LP_NUM_THREADS=8"}},
    {.environment = {"LP_NATIVE_VECTOR_WIDTH=256", "LP_NUM_THREADS=0"}},
    {.environment = {"LP_NATIVE_VECTOR_WIDTH=512", "GALLIUM_OVERRIDE_CPU_CAPS=nosse", "LP_NUM_THREADS=8"}},
    {.environment = {"LP_NATIVE_VECTOR_WIDTH=512", "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1", "LP_NUM_THREADS=0"}},
    {.environment = {"LP_NATIVE_VECTOR_WIDTH=512", "LP_NUM_THREADS=3"}},
    {.environment = {"LC_ALL=de_DE.UTF-8", "LANG=de_DE.UTF-8", "TZ=Pacific/Kiritimati"}},
};

#define MACHINES (sizeof machines / sizeof machines[0])

/* Vector widths with which a context crashes before it has drawn a frame, as Mesa 26 does with 512 bits, are skipped. A
 * program for each width finds them once. */
static const char *const widths[] = {"LP_NATIVE_VECTOR_WIDTH=128", "LP_NATIVE_VECTOR_WIDTH=256",
                                     "LP_NATIVE_VECTOR_WIDTH=512"};

#define WIDTHS (sizeof widths / sizeof widths[0])

static bool crashes[WIDTHS][DRAW_CONTEXTS];

static bool draws_one_frame(const temp_folder *own, const char *width, const char *context)
{
    const command_setting machine = {.environment = {width}};
    const place folder = place_in(own, "one");
    command_result result = run_octreel(
        &machine, "record --ticks 0:1 --jobs 1 --size 64x64 --fill gl --context %s -o %s", context, folder.path);
    const bool crashed = result.status == 128 + SIGSEGV || result.status == 128 + SIGBUS ||
                         result.status == 128 + SIGILL || result.status == 128 + SIGABRT;
    if (!crashed)
        assert_done(&result);
    command_release(&result);
    return !crashed;
}

static int find_crashes(void **state)
{
    (void)state;
    for (size_t i = 0; i < WIDTHS * DRAW_CONTEXTS; i++) {
        const draw_context kind = (draw_context)(i % DRAW_CONTEXTS);
        void *folder;
        if (!draw_context_is_built(kind))
            continue;
        assert_int_equal(temp_folder_make(&folder), 0);
        const char *width = widths[i / DRAW_CONTEXTS], *context = draw_context_name(kind);
        crashes[i / DRAW_CONTEXTS][kind] = !draws_one_frame(folder, width, context);
        if (crashes[i / DRAW_CONTEXTS][kind])
            print_message("%s is left out: this machine's Mesa crashes under it (--context %s)\n", width, context);
        nested_folder_remove(&folder);
    }
    return 0;
}

static bool can_draw(const command_setting *machine, draw_context kind)
{
    if (!draw_context_is_built(kind))
        return false;
    for (size_t i = 0; i < WIDTHS; i++)
        if (strcmp(machine->environment[0], widths[i]) == 0)
            return !crashes[i][kind];
    return true;
}

/* In every environment, every context of the program draws with GL the bytes that integers draw. */
static void assert_same_on_every_machine(const temp_folder *own, const char *session, const char *view)
{
    const place plain = place_in(own, "plain");
    assert_filmed_by_program(NULL, session, view, plain.path);
    for (size_t i = 0; i < MACHINES * DRAW_CONTEXTS; i++) {
        const draw_context kind = (draw_context)(i % DRAW_CONTEXTS);
        char name[16], options[256];
        if (kind == DRAW_AUTO || !can_draw(&machines[i / DRAW_CONTEXTS], kind))
            continue;
        snprintf(name, sizeof name, "film%zu", i);
        snprintf(options, sizeof options, "%s --fill gl --context %s", view, draw_context_name(kind));
        const place other = place_in(own, name);
        assert_filmed_by_program(&machines[i / DRAW_CONTEXTS], session, options, other.path);
        assert_same_folders(plain.path, other.path, "renderer.json");
    }
}

static void default_session_is_the_same_on_every_machine(void **state)
{
    assert_same_on_every_machine(*state, "", "--size 320x180 --every 60 --camera iso");
}

static void anti_aliased_frames_with_labels_are_the_same_on_every_machine(void **state)
{
    assert_same_on_every_machine(*state, "", "--size 160x90 --every 70 --camera orbit --aa 4 --labels");
}

static void crowd_in_motion_is_the_same_on_every_machine(void **state)
{
    const place session = place_in(*state, "s.json");
    file_write_text(session.path, "{\"octreel\": \"session\", \"version\": 2, \"tree\": {\"capacity\": 4, \"full\": "
                                  "\"grow\"}, \"points\": {\"sample\": \"clustered\", \"count\": 600, \"seed\": 5}, "
                                  "\"velocities\": {\"speed\": 9, \"seed\": 2}, \"keys\": \"wwdne\"}\n");
    assert_same_on_every_machine(*state, session.path, "--size 320x180 --every 2 --camera follow --color-by occupancy");
}

static void session_with_all_features_is_the_same_on_every_machine(void **state)
{
    static random_session made;
    const place session = place_in(*state, "s.json");
    random_session_full(&made, 11);
    FILE *file = fopen(session.path, "wb");
    assert_non_null(file);
    assert_true(session_write(&made.session, NULL, file));
    assert_int_equal(fclose(file), 0);
    assert_same_on_every_machine(*state, session.path, "--size 160x90 --every 20 --camera top");
}

/* Otherwise the tests above would compare equal renderers. */
static void environment_of_a_poor_processor_reaches_each_context(void **state)
{
    static const struct {
        const char *set, *said;
    } rows[] = {
        {"LP_NATIVE_VECTOR_WIDTH=512", "512 bits"},
        {"LP_NATIVE_VECTOR_WIDTH=128", "128 bits"},
        {"GALLIUM_OVERRIDE_CPU_CAPS=nosse", "128 bits"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0] * DRAW_CONTEXTS; i++) {
        const command_setting machine = {.environment = {rows[i / DRAW_CONTEXTS].set}};
        char name[16], options[64];
        snprintf(name, sizeof name, "film%zu", i);
        snprintf(options, sizeof options, "--keys w --size 16x16 --fill gl --context %s",
                 draw_context_name((i % DRAW_CONTEXTS)));
        if (!can_draw(&machine, (draw_context)(i % DRAW_CONTEXTS)))
            continue;
        const place folder = place_in(*state, name);
        assert_filmed_by_program(&machine, "", options, folder.path);
        char *text = file_read(place_below(folder.path, "renderer.json").path, NULL);
        assert_non_null(strstr(text, rows[i / DRAW_CONTEXTS].said));
        free(text);
    }
}

static void every_camera_is_the_same_on_a_poor_processor(void **state)
{
    static const char *const cameras[] = {"iso", "top", "front", "side", "follow", "orbit"};
    static const command_setting poor = {.environment = {"GALLIUM_OVERRIDE_CPU_CAPS=nosse", "LP_NUM_THREADS=0"}};
    for (size_t i = 0; i < sizeof cameras / sizeof cameras[0]; i++) {
        char name[32], view[64];
        snprintf(name, sizeof name, "%s-poor", cameras[i]);
        snprintf(view, sizeof view, "--size 160x90 --every 80 --camera %s --fill gl", cameras[i]);
        const place a = place_in(*state, cameras[i]), b = place_in(*state, name);
        assert_filmed_by_program(NULL, "", view, a.path);
        assert_filmed_by_program(&poor, "", view, b.path);
        assert_same_folders(a.path, b.path, "renderer.json");
    }
}

/* Record a session, and then the session.json of that recording; both recordings must be equal. */
static void assert_plays_again(void **state, const octree_session *session)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    film_options options = small_film(a.path);
    options.every = 20;
    assert_filmed(session, &options);
    session_file again;
    octreel_error error;
    if (!session_read(place_below(a.path, "session.json").path, &again, &error))
        fail_msg("%s", error.text);
    options.folder = b.path;
    assert_filmed(&again.session, &options);
    session_release(&again);
    assert_same_folders(a.path, b.path, NULL);
}

static void default_session_replays_from_its_recording(void **state)
{
    const octree_session session = octree_session_default();
    assert_plays_again(state, &session);
}

static void session_with_edits_motion_and_queries_replays_from_its_recording(void **state)
{
    static random_session made;
    random_session_full(&made, 11);
    assert_true(made.session.edit_count > 0);
    assert_plays_again(state, &made.session);
}

static void session_with_awkward_numbers_replays_from_its_recording(void **state)
{
    static const octree_game_body bodies[] = {
        {1, {1e15 + 0.125, -0.0, 5e-324}, {0.1, -1.0 / 3, 1e-17}, {0.3, 1e-300, 5e-324}},
        {2, {1e15 + 0.875, 0.1, 2.2250738585072014e-308}, {0, -0.0, 0}, {0}},
        {9007199254740991, {1e15 + 0.5, 1 - 0x1p-53, 1e-300}, {-0.125, 0.7, 0.01}, {0.1, 2, 0}},
    };
    octree_session session = octree_session_default();
    session.tree.world = (octree_box){{1e15, -1, -1}, {1e15 + 1, 1, 1}};
    session.player = (octree_player){.id = 7, .position = {1e15 + 0.25, 0.3, -0.0}, .step = 0.1, .box_size = 1.0 / 3};
    session.bodies = bodies;
    session.body_count = sizeof bodies / sizeof bodies[0];
    session.query_count = 0;
    session.keys = "nwasdefn.wwwwwwwwwwdddddddd";
    assert_plays_again(state, &session);
}

/* The points come from a file beside the session; the recording contains them. */
static void recording_of_a_file_of_points_replays_in_any_folder(void **state)
{
    const place session = place_in(*state, "s.json"), points = place_in(*state, "points.txt");
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    file_write_text(points.path, "1.5 2 3\n-4 5.25 6\n0.1 0.2 0.3\n");
    file_write_text(session.path,
                    "{\"octreel\": \"session\", \"version\": 2, \"world\": {\"min\": [-10, -10, -10], \"max\": [10, "
                    "10, 10]}, \"points\": {\"file\": \"points.txt\"}, \"velocities\": {\"speed\": 0.5, \"seed\": 3}, "
                    "\"keys\": \"nwd\", \"ticks\": 6}\n");
    assert_filmed_by_program(NULL, session.path, VIEW, a.path);
    remove(points.path);
    remove(session.path);
    assert_filmed_by_program(NULL, place_below(a.path, "session.json").path, VIEW, b.path);
    assert_same_folders(a.path, b.path, NULL);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(two_recordings_have_the_same_bytes),
        IN_FOLDER(program_and_library_record_the_same_bytes),
        IN_FOLDER(default_session_is_the_same_on_every_machine),
        IN_FOLDER(anti_aliased_frames_with_labels_are_the_same_on_every_machine),
        IN_FOLDER(crowd_in_motion_is_the_same_on_every_machine),
        IN_FOLDER(session_with_all_features_is_the_same_on_every_machine),
        IN_FOLDER(environment_of_a_poor_processor_reaches_each_context),
        IN_FOLDER(every_camera_is_the_same_on_a_poor_processor),
        IN_FOLDER(default_session_replays_from_its_recording),
        IN_FOLDER(session_with_edits_motion_and_queries_replays_from_its_recording),
        IN_FOLDER(session_with_awkward_numbers_replays_from_its_recording),
        IN_FOLDER(recording_of_a_file_of_points_replays_in_any_folder),
    };
    return cmocka_run_group_tests(tests, find_crashes, NULL);
}
