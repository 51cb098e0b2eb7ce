/* SPDX-License-Identifier: MIT */
/* test_resume.c - a stopped or interrupted recording is resumed to the bytes of an uninterrupted one; existing frames
 * are checked by their pixels. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/file.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "frame_file.h"
#include "images.h"
#include "layer.h"
#include "recordings.h"
#include "png_chunks.h"
#include "png_read.h"

enum { TICKS = 12 };

static const char KEYS[] = "wwddeennwwd";

static place film_whole(void **state)
{
    const place folder = place_in(*state, "whole");
    const octree_session session = short_session(KEYS);
    const film_options options = small_film(folder.path);
    assert_filmed(&session, &options);
    return folder;
}

static film_options resumed(const char *folder)
{
    film_options options = small_film(folder);
    options.resume = true;
    return options;
}

static void resume(const char *folder)
{
    const octree_session session = short_session(KEYS);
    const film_options options = resumed(folder);
    assert_int_equal(assert_filmed(&session, &options).ticks, TICKS);
}

static place copy_of(void **state, const char *folder, const char *name)
{
    const place copy = place_in(*state, name);
    copy_folder(folder, copy.path);
    return copy;
}

static void recording_stopped_after_any_tick_resumes_to_the_same_bytes(void **state)
{
    const place whole = film_whole(state);
    const octree_session session = short_session(KEYS);
    for (uint64_t stop = 1; stop <= TICKS; stop++) {
        char name[16];
        snprintf(name, sizeof name, "film%u", (unsigned)stop);
        const place folder = place_in(*state, name);
        uint64_t ticks = stop;
        const film_options options = small_film(folder.path), stopped = stopped_after(options, &ticks);
        const film_summary summary = assert_filmed(&session, &stopped);
        assert_int_equal(summary.ticks, stop);
        assert_int_equal(summary.total, TICKS);
        assert_nothing_half_written(folder.path);
        assert_true(file_exists(place_below(folder.path, "index.html").path));
        assert_int_equal(file_exists(frame_place(folder.path, stop).path), false);
        resume(folder.path);
        assert_same_folders(whole.path, folder.path, NULL);
    }
}

static void stopped_chunk_resumes_as_the_same_chunk(void **state)
{
    const place folder = place_in(*state, "film"), other = place_in(*state, "other");
    const octree_session session = short_session(KEYS);
    uint64_t ticks = 3;
    film_options options = chunk_of(small_film(folder.path), 2, 9);
    const film_options stopped = stopped_after(options, &ticks), whole = chunk_of(small_film(other.path), 2, 9);
    assert_int_equal(assert_filmed(&session, &stopped).total, 7);
    options.resume = true;
    assert_int_equal(assert_filmed(&session, &options).ticks, 7);
    assert_filmed(&session, &whole);
    assert_same_folders(folder.path, other.path, NULL);
}

static void summary_of_a_resumed_recording_covers_all_ticks(void **state)
{
    const place folder = place_in(*state, "film"), other = place_in(*state, "other");
    octree_session session = octree_session_default();
    film_options options = small_film(folder.path), again = resumed(folder.path), whole = small_film(other.path);
    uint64_t ticks = 30;
    session.keys = "wwwwwwwwwwwwwwwwwwwwwdddddddddddddddddddddeeeeeeeeeeeeeeeee";
    options.view.budget = again.view.budget = whole.view.budget = 5; /* so that frames leave out elements */
    const film_options stopped = stopped_after(options, &ticks);
    assert_filmed(&session, &stopped);
    film_summary a = assert_filmed(&session, &again), b = assert_filmed(&session, &whole);
    assert_true(b.over_budget > 0);
    assert_int_equal(a.kept, 30);
    assert_int_equal(b.kept, 0);
    a.kept = 0;
    assert_memory_equal(&a, &b, sizeof a);
}

/* The player's box reaches beyond the largest double. Elements that a kept frame leaves out are counted, too. */
static void elements_left_out_are_counted_in_kept_frames(void **state)
{
    const place folder = place_in(*state, "film");
    octree_session session = short_session("wd");
    session.tree.world = (octree_box){{-1.7e308, -1.7e308, -1.7e308}, {1.7e308, 1.7e308, 1.7e308}};
    session.player = (octree_player){.position = {1.7e308, 0, 0}, .step = 1, .box_size = 1e308};
    session.body_count = 0;
    session.query_count = 0;
    film_options options = small_film(folder.path);
    const film_summary first = assert_filmed(&session, &options);
    options.resume = true;
    film_summary second = assert_filmed(&session, &options);
    assert_true(first.left_out > 0);
    assert_int_equal(second.kept, second.frames);
    second.kept = 0;
    assert_memory_equal(&first, &second, sizeof first);
}

static void correct_frames_are_not_rewritten(void **state)
{
    const place whole = film_whole(state);
    struct stat before[TICKS], after;
    for (uint64_t tick = 0; tick < TICKS; tick++)
        assert_int_equal(stat(frame_place(whole.path, tick).path, &before[tick]), 0);
    remove(frame_place(whole.path, 5).path);
    resume(whole.path);
    for (uint64_t tick = 0; tick < TICKS; tick++) {
        assert_int_equal(stat(frame_place(whole.path, tick).path, &after), 0);
        if (tick != 5)
            assert_int_equal(after.st_ino, before[tick].st_ino);
    }
}

/* ---- Frames that are there and not right -------------------------------------------------------------------- */

static void cut_off(const char *path)
{
    size_t size;
    char *bytes = file_read(path, &size);
    file_write(path, bytes, size / 2);
    free(bytes);
}

static void empty(const char *path)
{
    file_write(path, "", 0);
}

static void flip_a_bit(const char *path)
{
    size_t size;
    char *bytes = file_read(path, &size);
    bytes[size - 40] ^= 1;
    file_write(path, bytes, size);
    free(bytes);
}

/* Change a pixel of a frame. Its text chunks are unchanged, and the PNG is whole: only the pixels differ. */
static void paint_a_pixel(const char *path)
{
    static const char *const keywords[] = {"octreel-tick", "octreel-session", "octreel-scene", "octreel-pixels"};
    char values[4][32];
    image_text texts[4];
    octreel_error error;
    for (size_t i = 0; i < 4; i++) {
        assert_true(image_read_text(path, keywords[i], values[i], sizeof values[i]));
        texts[i] = (image_text){keywords[i], values[i]};
    }
    image frame = assert_read_rgb(path); /* two entries of a palette may be the same colour */
    frame.pixels[3000] ^= 1;
    assert_true(image_write_png(&frame, path, texts, 4, &error));
    image_release(&frame);
}

static void take_the_next_frame(const char *path)
{
    size_t size;
    char next[1024];
    snprintf(next, sizeof next, "%s", path);
    char *digit = strrchr(next, '.') - 1;
    *digit = (char)(*digit + 1);
    char *bytes = file_read(next, &size);
    file_write(path, bytes, size);
    free(bytes);
}

static void strip_its_texts(const char *path)
{
    octreel_error error;
    image frame;
    assert_true(image_read_png(path, &frame, &error));
    assert_true(image_write_png(&frame, path, NULL, 0, &error));
    image_release(&frame);
}

static void incorrect_frames_are_redrawn(void **state)
{
    static void (*const damages[])(const char *path) = {
        cut_off, empty, flip_a_bit, paint_a_pixel, take_the_next_frame, strip_its_texts};
    const place whole = film_whole(state);
    for (size_t i = 0; i < sizeof damages / sizeof damages[0]; i++) {
        char name[16];
        snprintf(name, sizeof name, "film%zu", i);
        const place folder = copy_of(state, whole.path, name);
        damages[i](frame_place(folder.path, 4).path);
        resume(folder.path);
        assert_same_folders(whole.path, folder.path, NULL);
    }
}

static void frame_of_another_view_is_redrawn(void **state)
{
    const place whole = film_whole(state), other = place_in(*state, "other");
    const octree_session session = short_session(KEYS);
    film_options options = small_film(other.path);
    size_t size;
    options.view.layers &= ~(1u << LAYER_WORLD);
    assert_filmed(&session, &options);
    char *bytes = file_read(frame_place(other.path, 4).path, &size);
    const place folder = copy_of(state, whole.path, "film");
    file_write(frame_place(folder.path, 4).path, bytes, size);
    free(bytes);
    resume(folder.path);
    assert_same_folders(whole.path, folder.path, NULL);
}

static void partial_files_are_removed(void **state)
{
    static const char *const left[] = {"frame_000003.png.part", "session.json.part", "recording.json.ticks_0_12.jsonl",
                                       "index.html.part",       "ticks_0_3.jsonl",   "ticks.jsonl.part"};
    const place whole = film_whole(state), folder = copy_of(state, whole.path, "film");
    for (size_t i = 0; i < sizeof left / sizeof left[0]; i++)
        file_write_text(place_below(folder.path, left[i]).path, "{\"ha");
    const place mine = place_below(folder.path, "mine.part");
    file_write_text(mine.path, "mine");
    resume(folder.path);
    remove(mine.path);
    assert_same_folders(whole.path, folder.path, NULL);
}

/* ---- Lines -------------------------------------------------------------------------------------------------- */

static void wrong_torn_and_surplus_lines_are_repaired(void **state)
{
    const place whole = film_whole(state);
    size_t size;
    char *lines = file_read(place_below(whole.path, "ticks.jsonl").path, &size);
    for (size_t i = 0; i < 5; i++) {
        char name[16];
        snprintf(name, sizeof name, "film%zu", i);
        const place folder = copy_of(state, whole.path, name), log = place_below(folder.path, "ticks.jsonl");
        char *bytes = file_read(log.path, NULL);
        if (i == 0)
            bytes[size / 3] ^= 1;
        file_write(log.path, bytes, i == 1 ? size - 4 : i == 2 ? size / 2 : i == 3 ? 0 : size);
        free(bytes);
        if (i == 4) {
            FILE *file = fopen(log.path, "a");
            fputs("{}\n{", file);
            fclose(file);
        }
        resume(folder.path);
        assert_same_folders(whole.path, folder.path, NULL);
    }
    free(lines);
}

static void lines_stay_if_a_resumed_recording_stops_before_them(void **state)
{
    const place whole = film_whole(state), folder = copy_of(state, whole.path, "film");
    const octree_session session = short_session(KEYS);
    uint64_t ticks = 2;
    remove(frame_place(folder.path, 7).path);
    const film_options options = resumed(folder.path), stopped = stopped_after(options, &ticks);
    assert_int_equal(assert_filmed(&session, &stopped).ticks, 2);
    char *before = file_read(place_below(whole.path, "ticks.jsonl").path, NULL);
    char *after = file_read(place_below(folder.path, "ticks.jsonl").path, NULL);
    assert_string_equal(before, after);
    free(before);
    free(after);
}

/* ---- What is refused ---------------------------------------------------------------------------------------- */

static void another_session_or_view_is_refused_and_changes_nothing(void **state)
{
    const place whole = film_whole(state), folder = copy_of(state, whole.path, "film");
    const octree_session session = short_session(KEYS), other = short_session("wwddeennwwa");
    film_options options = resumed(folder.path);
    film_summary summary;
    octreel_error error = {""};
    assert_false(film_session(&other, &options, &summary, &error));
    assert_non_null(strstr(error.text, "session.json: is another session"));
    options.view.width = 161;
    assert_false(film_session(&session, &options, &summary, &error));
    assert_non_null(strstr(error.text, "recording.json: has another view"));
    assert_same_folders(whole.path, folder.path, NULL);
}

static void folder_that_another_process_records_into_is_refused(void **state)
{
    const place whole = film_whole(state), log = place_below(whole.path, "ticks.jsonl");
    const int file = open(log.path, O_RDWR);
    assert_true(file >= 0);
    if (flock(file, LOCK_EX | LOCK_NB) != 0)
        skip(); /* a file system without locks */
    command_result result = run_octreel(NULL, "record --resume -o %s", whole.path);
    close(file);
    assert_non_null(strstr(result.err, log.path));
    assert_trouble(&result, "another process is recording into this folder");
}

/* ---- The program -------------------------------------------------------------------------------------------- */

static void resume_reads_session_and_view_from_the_recording(void **state)
{
    static const char *const views[] = {"", "--every 3 --camera orbit --size 91x53 --keys wwddeenn",
                                        "--fit points --color-by occupancy --lod 0 --aa 2 --size 64x48 --keys wwd"};
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++) {
        char names[2][16];
        snprintf(names[0], sizeof names[0], "a%zu", i);
        snprintf(names[1], sizeof names[1], "b%zu", i);
        const place a = place_in(*state, names[0]), b = place_in(*state, names[1]);
        command_result result = run_octreel(NULL, "record --size 160x90 %s -o %s", views[i], a.path);
        assert_done(&result);
        command_release(&result);
        result = run_octreel(NULL, "record --size 160x90 %s --ticks 0:2 -o %s", views[i], b.path);
        assert_done(&result);
        command_release(&result);
        result = run_octreel(NULL, "record --resume -o %s", b.path);
        assert_done(&result);
        command_release(&result);
        assert_same_folders(a.path, b.path, NULL);
        result = run_octreel(NULL, "record --resume --size 160x90 %s -o %s", views[i], b.path);
        assert_done(&result); /* the same command makes the same recording */
        command_release(&result);
        assert_same_folders(a.path, b.path, NULL);
    }
}

static void resume_of_an_empty_folder_starts_a_recording(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b/c");
    command_result result = run_octreel(NULL, "record --size 160x90 --keys wwd -o %s", a.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "record --size 160x90 --keys wwd --resume -o %s", b.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(a.path, b.path, NULL);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(recording_stopped_after_any_tick_resumes_to_the_same_bytes),
        IN_FOLDER(stopped_chunk_resumes_as_the_same_chunk),
        IN_FOLDER(summary_of_a_resumed_recording_covers_all_ticks),
        IN_FOLDER(elements_left_out_are_counted_in_kept_frames),
        IN_FOLDER(correct_frames_are_not_rewritten),
        IN_FOLDER(incorrect_frames_are_redrawn),
        IN_FOLDER(frame_of_another_view_is_redrawn),
        IN_FOLDER(partial_files_are_removed),
        IN_FOLDER(wrong_torn_and_surplus_lines_are_repaired),
        IN_FOLDER(lines_stay_if_a_resumed_recording_stops_before_them),
        IN_FOLDER(another_session_or_view_is_refused_and_changes_nothing),
        IN_FOLDER(folder_that_another_process_records_into_is_refused),
        IN_FOLDER(resume_reads_session_and_view_from_the_recording),
        IN_FOLDER(resume_of_an_empty_folder_starts_a_recording),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
