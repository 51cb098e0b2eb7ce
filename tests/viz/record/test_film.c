/* SPDX-License-Identifier: MIT */
/* test_film.c - a session becomes a recording: its frames, the text chunks that name their ticks, and its lines. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files.h"
#include "fixture.h"
#include "game_fixture.h"
#include "layer.h"
#include "octree/digest.h"
#include "random_session.h"
#include "recordings.h"
#include "session_file.h"
#include "tick_lines.h"
#include "ticks_write.h"
#include "png_chunks.h"
#include "image_digest.h"

enum { DEFAULT_TICKS = 253, DEFAULT_FRAMES = 253 };

/* Record every tick of the default session in small frames. */
static film_summary film_default(const char *folder)
{
    const octree_session session = octree_session_default();
    const film_options options = small_film(folder);
    return assert_filmed(&session, &options);
}

static void frame_print_name(char text[32], uint64_t tick)
{
    snprintf(text, 32, "frame_%06u.png", (unsigned)tick);
}

static void default_session_makes_253_whole_frames_and_nothing_else(void **state)
{
    static const char *const others[] = {"index.html", "recording.json", "renderer.json", "session.json",
                                         "ticks.jsonl"};
    const place folder = place_in(*state, "film");
    const film_summary summary = film_default(folder.path);
    assert_int_equal(summary.ticks, DEFAULT_TICKS);
    assert_int_equal(summary.frames, DEFAULT_FRAMES);
    assert_int_equal(summary.left_out, 0);
    listing names = folder_list(folder.path);
    assert_int_equal(names.count, DEFAULT_FRAMES + 5);
    for (size_t i = 0; i < names.count; i++) {
        char expected[32];
        frame_print_name(expected, i);
        assert_string_equal(names.names[i], i < DEFAULT_FRAMES ? expected : others[i - DEFAULT_FRAMES]);
    }
    listing_release(&names);
    assert_nothing_half_written(folder.path);
}

/* The test fails unless a text chunk of a frame is this digest. */
static void assert_text(const char *path, const char *keyword, const char *expected)
{
    char text[64];
    assert_true(image_read_text(path, keyword, text, sizeof text));
    assert_string_equal(text, expected);
}

/* The expected contents of a recording's frames. */
typedef struct traced {
    const char *folder;
    uint64_t session;
} traced;

static void assert_frame_traced(const char *line, size_t number, void *context)
{
    const traced *t = context;
    char name[32], text[64], session[DIGEST_TEXT], pixels[IMAGE_DIGEST_TEXT];
    json_t *tick = json_read(line);
    frame_print_name(name, number);
    assert_string_equal(json_string_value(json_member(tick, "frame")), name);
    const place path = place_below(t->folder, name);
    image frame = assert_whole_frame(path.path, SMALL_WIDTH, SMALL_HEIGHT);
    assert_true(image_read_text(path.path, "octreel-tick", text, sizeof text));
    assert_int_equal(strtoul(text, NULL, 10), number);
    assert_text(path.path, "octreel-session", digest_print(t->session, session));
    assert_text(path.path, "octreel-pixels", image_digest_print(IMAGE_DIGEST_NEWEST, image_digest(&frame), pixels));
    assert_true(image_read_text(path.path, "octreel-scene", text, sizeof text));
    assert_string_equal(text, json_string_value(json_member(tick, "scene")));
    image_release(&frame);
    json_decref(tick);
}

static void every_frame_names_its_tick_and_digests(void **state)
{
    const place folder = place_in(*state, "film");
    size_t size;
    film_default(folder.path);
    char *session = file_read(place_below(folder.path, "session.json").path, &size);
    traced t = {folder.path, octree_digest_bytes(OCTREE_DIGEST_START, session, size)};
    assert_int_equal(for_each_line(folder.path, assert_frame_traced, &t), DEFAULT_TICKS);
    free(session);
}

/* Play the next tick and compare it with its line. */
static void assert_next_tick(const char *line, size_t number, void *context)
{
    octree_game *game = context;
    if (number > 0)
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
    json_t *object = json_read(line);
    assert_line_has_facts(object, octree_game_tick(game), octree_game_tree(game));
    json_decref(object);
}

static void assert_replayed(const char *folder, const octree_session *session)
{
    octree_game *game = start_game(session);
    for_each_line(folder, assert_next_tick, game);
    assert_true(octree_game_over(game));
    octree_game_destroy(game);
}

static void lines_have_the_facts_of_a_replay(void **state)
{
    const place folder = place_in(*state, "film"), random = place_in(*state, "random");
    static random_session made;
    const octree_session session = octree_session_default();
    film_options options = small_film(random.path);
    film_default(folder.path);
    assert_replayed(folder.path, &session);
    random_session_full(&made, 5);
    options.every = 50;
    assert_filmed(&made.session, &options);
    assert_replayed(random.path, &made.session);
}

static void summary_counts_the_ticks_of_each_event(void **state)
{
    const octree_session session = octree_session_default();
    uint64_t events[OCTREE_EVENT_KINDS] = {0};
    octree_game *game = start_game(&session);
    for (;;) {
        for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
            events[i] += (octree_game_tick(game)->events & 1u << i) != 0;
        if (octree_game_over(game))
            break;
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
    }
    octree_game_destroy(game);
    const film_summary summary = film_default(place_in(*state, "film").path);
    assert_memory_equal(summary.events, events, sizeof events);
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        /* the default session has all other events */
        assert_true((events[i] > 0) == !(1u << i & (OCTREE_EVENT_WRONG | OCTREE_EVENT_OVERLAPPED)));
}

/* Only ticks 0, 60, 120 ... have frames, which equal those of the whole recording. */
static void assert_sixtieth(const char *line, size_t number, void *context)
{
    json_t *tick = json_read(line);
    char name[32];
    (void)context;
    frame_print_name(name, number);
    if (number % 60 == 0)
        assert_string_equal(json_string_value(json_member(tick, "frame")), name);
    else
        assert_null(json_object_get(tick, "frame"));
    json_decref(tick);
}

static void every_option_draws_the_same_frames_of_fewer_ticks(void **state)
{
    const place whole = place_in(*state, "whole"), part = place_in(*state, "part");
    const octree_session session = octree_session_default();
    film_options options = small_film(part.path);
    options.every = 60;
    film_default(whole.path);
    const film_summary summary = assert_filmed(&session, &options);
    assert_int_equal(summary.frames, 5);
    assert_int_equal(summary.ticks, DEFAULT_TICKS);
    assert_int_equal(for_each_line(part.path, assert_sixtieth, NULL), DEFAULT_TICKS);
    assert_replayed(part.path, &session);
    for (uint64_t tick = 0; tick < DEFAULT_TICKS; tick++) {
        char name[32];
        frame_print_name(name, tick);
        assert_int_equal(file_exists(place_below(part.path, name).path), tick % 60 == 0);
        if (tick % 60 != 0)
            remove(place_below(whole.path, name).path);
    }
    static const char *const named[] = {"ticks.jsonl", "index.html"}; /* the files that contain names of frames */
    for (size_t i = 0; i < 2; i++) {
        remove(place_below(whole.path, named[i]).path);
        remove(place_below(part.path, named[i]).path);
    }
    assert_same_folders(whole.path, part.path, "recording.json");
}

static void every_option_beyond_the_end_draws_only_tick_0(void **state)
{
    const place folder = place_in(*state, "film");
    const octree_session session = octree_session_default();
    film_options options = small_film(folder.path);
    options.every = INT64_MAX;
    const film_summary summary = assert_filmed(&session, &options);
    assert_int_equal(summary.frames, 1);
    assert_int_equal(summary.ticks, DEFAULT_TICKS);
}

static void frame_without_layers_is_background(void **state)
{
    const place folder = place_in(*state, "film");
    octree_session session = octree_session_default();
    film_options options = small_film(folder.path);
    session.keys = "wd";
    session.query_count = 0;
    options.view.layers = 0;
    assert_filmed(&session, &options);
    image frame = assert_whole_frame(place_below(folder.path, "frame_000001.png").path, SMALL_WIDTH, SMALL_HEIGHT);
    const image_color background = image_color_at(&frame, 0, 0);
    for (int y = 0; y < SMALL_HEIGHT; y++) {
        for (int x = 0; x < SMALL_WIDTH; x++) {
            const image_color color = image_color_at(&frame, x, y);
            assert_memory_equal(&color, &background, sizeof color);
        }
    }
    image_release(&frame);
}

static void recording_json_keeps_the_view(void **state)
{
    const place folder = place_in(*state, "film");
    octree_session session = octree_session_default();
    film_options options = small_film(folder.path);
    session.keys = "w";
    session.query_count = 0;
    options.every = 7;
    options.view.camera = CAMERA_ORBIT;
    options.view.layers = 1u << LAYER_NODES | 1u << LAYER_TEXT;
    options.view.coloring = COLORING_OCCUPANCY;
    options.view.filter = (view_filter){
        .slice = 'y', .slice_at = 0.1, .by_depth = true, .max_depth = 4, .leaves = true, .by_region = true};
    assert_filmed(&session, &options);
    char *text = file_read(place_below(folder.path, "recording.json").path, NULL);
    json_t *object = json_read(text);
    assert_whole_number(json_member(object, "version"), 4);
    const json_t *size = json_member(object, "size");
    assert_whole_number(json_array_get(size, 0), SMALL_WIDTH);
    assert_whole_number(json_array_get(size, 1), SMALL_HEIGHT);
    assert_whole_number(json_member(object, "every"), 7);
    assert_string_equal(json_string_value(json_member(object, "camera")), "orbit");
    const json_t *layers = json_member(object, "layers");
    assert_int_equal(json_array_size(layers), 2);
    assert_string_equal(json_string_value(json_array_get(layers, 0)), "nodes");
    assert_string_equal(json_string_value(json_array_get(layers, 1)), "text");
    assert_string_equal(json_string_value(json_member(object, "color_by")), "occupancy");
    assert_true(json_real_value(json_member(json_member(object, "slice"), "y")) == 0.1);
    assert_whole_number(json_array_get(json_member(object, "depths"), 0), 0);
    assert_whole_number(json_array_get(json_member(object, "depths"), 1), 4);
    assert_true(json_is_true(json_member(object, "leaves")));
    assert_members(json_member(object, "region"), "min max");
    json_decref(object);
    free(text);
}

/* The calls of a progress function. */
typedef struct steps {
    uint64_t calls;
} steps;

static void take_step(uint64_t done, uint64_t total, void *context)
{
    steps *taken = context;
    taken->calls++;
    assert_int_equal(done, taken->calls);
    assert_int_equal(total, DEFAULT_TICKS);
}

static void progress_is_reported_after_each_tick(void **state)
{
    const octree_session session = octree_session_default();
    const place folder = place_in(*state, "film");
    film_options options = small_film(folder.path);
    steps taken = {0};
    options.every = 100;
    options.watch.progress = take_step;
    options.watch.context = &taken;
    assert_filmed(&session, &options);
    assert_int_equal(taken.calls, DEFAULT_TICKS);
}

static void refused_recording_makes_no_folder(void **state)
{
    static const int sizes[][2] = {{0, 0}, {0, 90}, {160, -1}, {16385, 1}, {1, 16385}};
    const place folder = place_in(*state, "film");
    octree_session session = octree_session_default();
    film_options options = small_film(folder.path);
    film_summary summary;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        octreel_error error = {""};
        options.view.width = sizes[i][0];
        options.view.height = sizes[i][1];
        assert_false(film_session(&session, &options, &summary, &error));
        assert_non_null(strstr(error.text, "16384"));
        assert_false(file_exists(folder.path));
    }
    octreel_error error = {""};
    options = small_film(folder.path);
    session.player.position[0] = 1001;
    assert_false(film_session(&session, &options, &summary, &error));
    assert_non_null(strstr(error.text, octree_status_text(OCTREE_OUTSIDE)));
    assert_false(file_exists(folder.path));
}

static void smallest_and_flattest_pictures_are_recorded(void **state)
{
    static const int sizes[][2] = {{1, 1}, {16384, 1}, {1, 16384}, {3, 2}};
    octree_session session = octree_session_default();
    session.keys = "";
    session.query_count = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        char name[16];
        snprintf(name, sizeof name, "film%zu", i);
        const place folder = place_in(*state, name);
        film_options options = small_film(folder.path);
        options.view.width = sizes[i][0];
        options.view.height = sizes[i][1];
        assert_filmed(&session, &options);
        image frame = assert_whole_frame(place_below(folder.path, "frame_000000.png").path, sizes[i][0], sizes[i][1]);
        image_release(&frame);
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(default_session_makes_253_whole_frames_and_nothing_else),
        IN_FOLDER(every_frame_names_its_tick_and_digests),
        IN_FOLDER(lines_have_the_facts_of_a_replay),
        IN_FOLDER(summary_counts_the_ticks_of_each_event),
        IN_FOLDER(every_option_draws_the_same_frames_of_fewer_ticks),
        IN_FOLDER(every_option_beyond_the_end_draws_only_tick_0),
        IN_FOLDER(frame_without_layers_is_background),
        IN_FOLDER(recording_json_keeps_the_view),
        IN_FOLDER(progress_is_reported_after_each_tick),
        IN_FOLDER(refused_recording_makes_no_folder),
        IN_FOLDER(smallest_and_flattest_pictures_are_recorded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
