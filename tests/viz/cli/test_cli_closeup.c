/* SPDX-License-Identifier: MIT */
/* test_cli_closeup.c - close-ups of clouds, and of recordings without a player, in inspect, record, pick and diff. */
#include "commands.h"
#include "fixture.h"
#include "png_chunks.h"
#include "recordings.h"
#include "replay.h"

#include <stdio.h>
#include <string.h>

/* ---- Clouds ------------------------------------------------------------------------------------------------- */

typedef struct scene_text {
    char text[64];
} scene_text;

/* The digest of the scene in a picture of the cloud. */
static scene_text inspected(const place *cloud, const place *picture, const char *arguments)
{
    scene_text scene;
    command_result result =
        run_octreel(NULL, "inspect %s --size 640x360 %s -o %s", cloud->path, arguments, picture->path);
    assert_done(&result);
    command_release(&result);
    assert_true(image_read_text(picture->path, "octreel-scene", scene.text, sizeof scene.text));
    return scene;
}

static void write_lattice(const char *path)
{
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    for (int i = 0; i < 1000; i++)
        fprintf(out, "%d %d %d\n", i % 10 * 10, i / 10 % 10 * 10, i / 100 * 10);
    assert_int_equal(fclose(out), 0);
}

/* A query whose answer is small in the picture gets a close-up, unless --no-closeup is given. */
static void close_up_of_a_cloud_shows_the_queries(void **state)
{
    static const struct {
        const char *asked;
        bool small;
    } rows[] = {
        {"--radius 50,50,50,2", true},
        {"--radius 50,50,50,40", false},
        {"--nearest 50,51,50", true},
        {"--nearest 50,51,50,8", false},
        {"--range 39,39,39,41,41,41", true},
        {"--range 0,0,0,90,90,90", false},
        {"--capacity 1 --node 0/0/0/7", true},
        {"--node root", false},
        {"", false},
    };
    const place cloud = place_in(*state, "lattice.txt"), picture = place_in(*state, "tree.png");
    char arguments[128];
    write_lattice(cloud.path);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const scene_text with = inspected(&cloud, &picture, rows[i].asked);
        snprintf(arguments, sizeof arguments, "%s --no-closeup", rows[i].asked);
        const scene_text without = inspected(&cloud, &picture, arguments);
        if ((strcmp(with.text, without.text) != 0) != rows[i].small)
            fail_msg("%s", rows[i].asked);
    }
}

/* ---- Recordings --------------------------------------------------------------------------------------------- */

/* A radius query at tick 1, and no query at tick 2. */
#define HEADER                                                                                                         \
    "{\"octreel\": \"session\", \"version\": 2, \"player\": null, \"ticks\": 2, \"points\": [[505, 500, 500, 7]]}\n"
#define ASKED "{\"tick\": 1, \"queries\": [{\"radius\": 20, \"at\": [500, 500, 500]}]}\n"

static place record(const temp_folder *own, const char *name, const char *arguments)
{
    const place session = place_in(own, "session.json"), folder = place_in(own, name);
    file_write_text(session.path, HEADER ASKED);
    command_result result =
        run_octreel(NULL, "record %s --size 640x360 %s -o %s", session.path, arguments, folder.path);
    assert_done(&result);
    command_release(&result);
    return folder;
}

static void pick_names_elements_of_a_close_up_without_a_player(void **state)
{
    const place folder = record(*state, "film", "");
    const place frame = frame_place(folder.path, 2);
    octreel_error error = {""};
    replay replay;
    if (!replay_open(&replay, folder.path, 0, &error) || !replay_play_up_to(&replay, 2, &error) ||
        !playback_compose_scene(&replay.playback, &error))
        fail_msg("%s", error.text);
    const scene *s = &replay.playback.scene;
    const double point[] = {505, 500, 500};
    double pixel[2];
    assert_true(s->has_closeup);
    assert_true(camera_find_pixel(&s->closeup->camera, point, pixel));
    command_result result = run_octreel(NULL, "pick %s %d %d", frame.path, s->closeup->place[0] + (int)pixel[0],
                                        s->closeup->place[1] + (int)pixel[1]);
    assert_done(&result);
    assert_non_null(strstr(result.out, "point 7 at (505, 500, 500)"));
    assert_non_null(strstr(result.out, " (in the close-up)\n"));
    command_release(&result);
    replay_close(&replay);
    result = run_octreel(NULL, "verify %s", folder.path);
    assert_done(&result);
    command_release(&result);
}

static void diff_names_the_close_up_as_cause_without_a_player(void **state)
{
    const place a = record(*state, "a", ""), b = record(*state, "b", "--no-closeup");
    command_result result = run_octreel(NULL, "diff %s %s", a.path, b.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "different: 2 of 3 frames")); /* there is no query before tick 1 */
    assert_non_null(strstr(result.out, "another close-up (off, was on)"));
    command_release(&result);
}

/* Several processes record the same as one, and so does a chunk that begins after the query. */
static void jobs_and_chunks_film_the_same_close_up(void **state)
{
    const place a = record(*state, "a", ""), b = record(*state, "b", "--jobs 3");
    command_result result = run_octreel(NULL, "diff %s %s", a.path, b.path);
    assert_done(&result);
    command_release(&result);
    const place chunks = record(*state, "chunks", "--ticks 2:3"), frame = frame_place(a.path, 2);
    result = run_octreel(NULL, "diff %s %s", frame.path, frame_place(chunks.path, 2).path);
    assert_done(&result);
    command_release(&result);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(close_up_of_a_cloud_shows_the_queries),
        IN_FOLDER(pick_names_elements_of_a_close_up_without_a_player),
        IN_FOLDER(diff_names_the_close_up_as_cause_without_a_player),
        IN_FOLDER(jobs_and_chunks_film_the_same_close_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
