/* SPDX-License-Identifier: MIT */
/* test_recorded_ticks.c - a recording is opened and played to any of its ticks: the scenes are those of its frames. */
#include "recordings.h"
#include "layer.h"
#include "replay.h"
#include "frame_file.h"
#include "verified.h"
#include "image_digest.h"

#include <string.h>

static void open_it(replay *r, const place *folder)
{
    octreel_error error = {""};
    if (!replay_open(r, folder->path, 0, &error))
        fail_msg("%s", error.text);
}

/* The test fails unless the scene of a tick has the digest in its frame. */
static void check_scene(replay *r, const place *folder, uint64_t tick)
{
    octreel_error error = {""};
    if (!replay_play_up_to(r, tick, &error) || !playback_compose_scene(&r->playback, &error))
        fail_msg("%s", error.text);
    assert_int_equal(octree_game_tick(r->playback.game)->number, tick);
    frame_origin origin = {.tick = tick, .session = r->session_digest, .scene = scene_digest(&r->playback.scene)};
    if (!frame_check_tick(folder->path, &origin, &error))
        fail_msg("%s", error.text);
}

static void scenes_equal_those_of_the_frames_in_any_order(void **state)
{
    static const uint64_t order[] = {3, 6, 12, 0, 9, 9, 3};
    const place folder = film_short(*state);
    replay r;
    open_it(&r, &folder);
    assert_int_equal(r.ticks, SHORT_TICKS);
    assert_int_equal(r.film.every, SHORT_EVERY);
    for (size_t i = 0; i < sizeof order / sizeof order[0]; i++)
        check_scene(&r, &folder, order[i]);
    replay_close(&r);
}

/* Heat adds up from tick 0: going back must restart it. */
static void heat_is_correct_after_going_back(void **state)
{
    const place folder = place_in(*state, "film");
    octree_session session = short_session("wwdd");
    film_options options = small_film(folder.path);
    replay r;
    options.view.layers = VIEW_ALL_LAYERS;
    assert_filmed(&session, &options);
    open_it(&r, &folder);
    check_scene(&r, &folder, 4);
    check_scene(&r, &folder, 2);
    check_scene(&r, &folder, 4);
    replay_close(&r);
}

static void renderer_is_opened_once_and_draws_the_frame(void **state)
{
    const place folder = film_short(*state);
    const renderer_choice any = {.context = DRAW_AUTO};
    octreel_error error = {""};
    replay r;
    open_it(&r, &folder);
    assert_null(r.playback.picture.renderer);
    renderer *first = replay_renderer(&r, &any, &error);
    assert_non_null(first);
    check_scene(&r, &folder, 6);
    check_scene(&r, &folder, 3); /* restarts */
    assert_ptr_equal(replay_renderer(&r, &any, &error), first);
    assert_true(picture_draw(&r.playback.picture, &r.playback.scene, &error));
    image frame = assert_whole_frame(frame_place(folder.path, 3).path, SMALL_WIDTH, SMALL_HEIGHT);
    assert_int_equal(image_digest(&r.playback.picture.frame), image_digest(&frame));
    image_release(&frame);
    replay_close(&r);
}

static void tick_beyond_the_end_is_refused(void **state)
{
    const place folder = film_short(*state);
    octreel_error error = {""};
    replay r;
    open_it(&r, &folder);
    assert_false(replay_play_up_to(&r, SHORT_TICKS, &error));
    assert_non_null(strstr(error.text, "last tick of the session is 13"));
    replay_close(&r);
}

static void folder_without_a_recording_is_refused(void **state)
{
    const place folder = place_in(*state, "nothing");
    octreel_error error = {""};
    replay r;
    assert_false(replay_open(&r, folder.path, 0, &error));
    assert_non_null(strstr(error.text, "recording.json"));
    replay_close(&r);
}

int main(void)
{
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(scenes_equal_those_of_the_frames_in_any_order), IN_FOLDER(heat_is_correct_after_going_back),
        IN_FOLDER(renderer_is_opened_once_and_draws_the_frame),   IN_FOLDER(tick_beyond_the_end_is_refused),
        IN_FOLDER(folder_without_a_recording_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
