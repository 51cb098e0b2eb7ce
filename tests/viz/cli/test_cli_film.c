/* SPDX-License-Identifier: MIT */
/* test_cli_film.c - octreel film: the film has the pixels of the frames, options choose among them, and bad input is a
 * sentence and no file. */
#include "apng_read.h"
#include "background.h"
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "images.h"
#include "recordings.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Record "film" with 10 frames; ticks 5 to 8 look like tick 4. */
static int record(void **state)
{
    temp_folder_make(state);
    const temp_folder *own = *state;
    command_result result =
        run_octreel(NULL, "record -q --keys wdn.....w --layers=-text --size 160x90 --jobs 1 -o %s/film", own->name);
    assert_done(&result);
    command_release(&result);
    return 0;
}

/* Run a command in the test's folder, in which "$1" is octreel. */
static command_result run_in(const temp_folder *own, const char *line)
{
    return run_script("cd %s && set -- %s && %s", own->name, octreel_program(), line);
}

static void do_in(const temp_folder *own, const char *line)
{
    command_result result = run_in(own, line);
    if (result.status != 0)
        fail_msg("%s: %s", line, result.err);
    command_release(&result);
}

static void assert_refused_in(const temp_folder *own, const char *line, const char *part)
{
    command_result result = run_in(own, line);
    if (!strstr(result.err, part))
        fail_msg("%s: %s\ninstead of: %s", line, result.err, part);
    assert_trouble(&result, part);
}

/* The test fails unless a frame of the film shows the pixels of a file from (left, top) on. */
static void assert_shows(const apng_film *film, size_t index, const char *path, int left, int top)
{
    image whole = assert_read(path);
    assert_true(index < film->count);
    for (int y = 0; y < film->height; y++)
        for (int x = 0; x < film->width; x++) {
            const image_color color = image_color_at(&whole, left + x, top + y);
            assert_memory_equal(film->frames[index].rgb + 3 * (y * film->width + x), &color, 3);
        }
    image_release(&whole);
}

static void film_shows_each_frame_as_long_as_it_lasts(void **state)
{
    const place folder = place_in(*state, "film");
    command_result result = run_in(*state, "\"$1\" film film -o film.png");
    assert_done(&result);
    assert_string_equal(result.out, "film.png: 10 frames, 160 x 90 pixels, 0.7 s; 4 equal the previous frame\n");
    command_release(&result);
    apng_film film = apng_read(place_in(*state, "film.png").path);
    uint64_t tick = 0;
    assert_true(film.colors > 0);
    for (size_t i = 0; i < film.count; i++) {
        assert_int_equal(film.frames[i].rate, 15);
        for (unsigned j = 0; j < film.frames[i].shown; j++)
            assert_shows(&film, i, frame_place(folder.path, tick++).path, 0, 0);
    }
    assert_int_equal(tick, 10);
    assert_int_equal(film.count, 6);
    apng_release(&film);
}

static void same_recording_gives_the_same_bytes(void **state)
{
    do_in(*state, "\"$1\" film film -o a.png && \"$1\" film -q film -o b.png && \"$1\" film film -o - >c.png && "
                  "\"$1\" record -q --keys wdn.....w --layers=-text --size 160x90 --jobs 3 -o other && "
                  "\"$1\" film ./other// -o d.apng && cmp a.png b.png && cmp a.png c.png && cmp a.png d.apng && "
                  "\"$1\" film film -o film/film.png && \"$1\" film film -o film/film.png && cmp a.png film/film.png");
}

static void options_choose_ticks_speed_and_part(void **state)
{
    const place folder = place_in(*state, "film");
    do_in(*state, "\"$1\" film film -q --ticks 1:9 --every 2 --speed 10 --crop 30,20,50,41 -o part.png");
    apng_film film = apng_read(place_in(*state, "part.png").path);
    assert_int_equal(film.width, 50);
    assert_int_equal(film.height, 41);
    assert_int_equal(film.frames[0].rate, 10);
    assert_shows(&film, 0, frame_place(folder.path, 1).path, 30, 20);
    assert_shows(&film, film.count - 1, frame_place(folder.path, 7).path, 30, 20);
    unsigned shown = 0;
    for (size_t i = 0; i < film.count; i++)
        shown += film.frames[i].shown;
    assert_int_equal(shown, 4);
    apng_release(&film);
}

static void pictures_of_any_folder_are_shown_in_the_order_of_their_names(void **state)
{
    do_in(*state, "mkdir any && cp film/frame_000002.png any/b.png && cp film/frame_000000.png any/c.PNG && "
                  "cp film/frame_000009.png any/a.png && echo text >any/notes.txt && \"$1\" film any -o any.png && "
                  "\"$1\" film any --ticks 1:2 -o one.png");
    apng_film film = apng_read(place_in(*state, "any.png").path);
    assert_int_equal(film.count, 3);
    assert_shows(&film, 0, place_in(*state, "any/a.png").path, 0, 0);
    assert_shows(&film, 1, place_in(*state, "any/b.png").path, 0, 0);
    assert_shows(&film, 2, place_in(*state, "any/c.PNG").path, 0, 0);
    apng_release(&film);
    film = apng_read(place_in(*state, "one.png").path);
    assert_int_equal(film.count, 1);
    assert_shows(&film, 0, place_in(*state, "any/b.png").path, 0, 0);
    apng_release(&film);
    /* A program without APNG shows the first frame. */
    image first = assert_read(place_in(*state, "any.png").path), a = assert_read(place_in(*state, "any/a.png").path);
    const image_difference difference = image_compare(&first, &a);
    assert_true(image_has_no_difference(&difference));
    image_release(&first);
    image_release(&a);
}

static void more_than_256_colours_give_rgb(void **state)
{
    const temp_folder *own = *state;
    image picture;
    for (int i = 0; i < 2; i++) {
        assert_true(image_create(&picture, 20, 10, 3));
        for (int j = 0; j < 200; j++)
            memcpy(picture.pixels + 3 * j, (uint8_t[]){(uint8_t)j, (uint8_t)(i * 9), 3}, 3);
        assert_int_equal(mkdir(place_below(own->name, "rgb").path, 0777), i == 0 ? 0 : -1);
        assert_written(&picture, place_in(own, i ? "rgb/1.png" : "rgb/0.png").path);
        image_release(&picture);
    }
    command_result result = run_in(own, "\"$1\" film rgb -o rgb.png");
    assert_done(&result);
    assert_non_null(strstr(result.out, "; more than 256 colours, so the film has no palette\n"));
    command_release(&result);
    apng_film film = apng_read(place_in(own, "rgb.png").path);
    assert_int_equal(film.colors, 0);
    for (size_t i = 0; i < 2; i++)
        assert_shows(&film, i, place_in(own, i ? "rgb/1.png" : "rgb/0.png").path, 0, 0);
    apng_release(&film);
}

static void missing_frames_are_reported_and_left_out(void **state)
{
    do_in(*state, "rm film/frame_000002.png film/frame_000006.png film/frame_000007.png");
    command_result result = run_in(*state, "\"$1\" film film -o film.png");
    assert_int_equal(result.status, 0);
    assert_string_equal(result.err,
                        "octreel: 3 frames are missing, the first after tick 1; the film leaves them out\n");
    assert_non_null(strstr(result.out, "film.png: 7 frames, "));
    command_release(&result);
    result = run_in(*state, "\"$1\" film -q film -o film.png");
    assert_done(&result);
    command_release(&result);
}

static void mistakes_are_sentences_and_leave_no_file(void **state)
{
    static const char *const rows[][2] = {
        {"film film", "film needs a file for the film: add -o film.png"},
        {"film absent -o x.png", "absent: no such file or folder"},
        {"film empty -o x.png", "empty: contains no PNG files"},
        {"film bare -o x.png", "bare: this recording has no frames: record it without --no-frames"},
        {"film film --ticks 20: -o x.png", "film: none of its ticks with frames, 0 to 9, is in the range of --ticks"},
        {"film any --ticks 2: -o x.png", "any: none of its pictures, 0 to 1, is in the range of --ticks"},
        {"film film --ticks 3:3 -o x.png", "--ticks takes a range of ticks"},
        {"film film --speed 0 -o x.png", "--speed takes a whole number from 1 to 120"},
        {"film film --crop 111,0,50,50 -o x.png",
         "--crop 111,0,50,50 reaches beyond the frames, which have 160 x 90 pixels"},
        {"film film --crop 0,0,50,91 -o x.png", "reaches beyond the frames"},
        {"film film --crop 16384,16384,16384,16384 -o x.png", "reaches beyond the frames"},
        {"film film --crop 0,0,0,5 -o x.png", "--crop takes the left, the top, the width and the height"},
        {"film film --crop 1,2,3 -o x.png", "--crop takes the left"},
        {"film film --crop 1,2,3,4,5 -o x.png", "--crop takes the left"},
        {"film film -o x.gif", "ends with .png, .apng, .mp4 or .webm, not \"x.gif\""},
        {"film film -o film", "-o needs a file, but \"film\" is a folder"},
        {"film film -o film/frame_000003.png", "is the same file as film/frame_000003.png, which is read"},
        {"film film -o film/frame_000099.png", "is a file of the recording in film"},
        {"film any -o any/0.png", "is the same file as any/0.png, which is read"},
        {"film film -o other/x.png", "other/x.png: cannot be written"},
        {"film mixed -o x.png",
         "mixed/1.png: has 64 x 36 pixels, but mixed/0.png has 160 x 90; a film needs frames of one size: choose a "
         "range with --ticks"},
        {"film torn -o x.png", "torn/1.png: "},
        {"film broken -o x.png", "broken/1.png: "},
        {"film film -o pipe", "no process reads this pipe"},
        {"film film/session.json -o x.png",
         "film/session.json is a session, but film takes the folder of one recording"},
    };
    do_in(*state,
          "mkdir empty any mixed torn broken && mkfifo pipe && \"$1\" record -q --no-frames --keys w -o bare && "
          "\"$1\" record -q --keys w --size 64x36 -o small && cp film/frame_000001.png any/0.png && "
          "cp any/0.png any/1.png && cp any/0.png mixed && cp small/frame_000000.png mixed/1.png && "
          "cp any/0.png torn && head -c 999 any/0.png >torn/1.png && cp any/0.png broken && "
          "{ head -c 999 any/0.png; echo x; tail -c +1002 any/0.png; } >broken/1.png");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[256];
        snprintf(line, sizeof line, "\"$1\" %s", rows[i][0]);
        assert_refused_in(*state, line, rows[i][1]);
        assert_false(file_exists(place_in(*state, "x.png").path));
        assert_false(file_exists(place_in(*state, "x.png.part").path));
    }
}

static void full_disk_is_an_error_and_leaves_the_old_film(void **state)
{
    const temp_folder *own = *state;
    const place path = place_in(own, "film.png");
    const command_setting full = {.file_limit = 3000};
    file_write_text(path.path, "old");
    command_result result = run_octreel(&full, "film %s/film -o %s", own->name, path.path);
    assert_non_null(strstr(result.err, path.path));
    assert_trouble(&result, "cannot be written: File too large");
    char *text = file_read(path.path, NULL);
    assert_string_equal(text, "old");
    free(text);
    assert_int_equal(temp_folder_count(own), 2);
    const command_setting standard = {.output = "/dev/full"};
    result = run_octreel(&standard, "film %s/film -o -", own->name);
    assert_int_equal(result.status, 2);
    assert_non_null(strstr(result.err, "octreel: "));
    command_release(&result);
}

static void interrupted_film_leaves_no_file(void **state)
{
    const temp_folder *own = *state;
    static const char *const names[] = {"long.png", "long.mp4"};
    do_in(own,
          "mkdir long && for i in 0 1 2 3 4 5 6 7 8 9; do for j in 0 1 2 3 4 5 6 7 8 9; do for k in 0 1 2 3 4 5 6 7 8 "
          "9; do cp film/frame_00000$k.png long/$i$j$k.png; done; done; done");
    for (size_t i = 0; i < 2; i++) {
        char part[32];
        if (i == 1 && !is_program_installed("ffmpeg"))
            break;
        snprintf(part, sizeof part, "%s.part", names[i]);
        background b = start_octreel("film %s/long -o %s", own->name, place_in(own, names[i]).path);
        wait_for_file(&b, place_in(own, part).path);
        kill(b.pid, SIGINT);
        command_result result = wait_for_end(&b);
        if (result.status != 0) { /* 0: the film was complete before the signal */
            assert_int_equal(result.status, 128 + SIGINT);
            assert_non_null(strstr(result.err, " was not written\n"));
            assert_false(file_exists(place_in(own, names[i]).path));
        }
        assert_false(file_exists(place_in(own, part).path));
        command_release(&result);
    }
}

static void need_ffmpeg(void)
{
    if (is_program_installed("ffmpeg") && is_program_installed("ffprobe"))
        return;
    print_message("ffmpeg is not installed\n");
    skip();
}

/* Another decoder finds the same pixels. */
static void ffmpeg_decodes_the_frames_of_the_film(void **state)
{
    need_ffmpeg();
    do_in(*state,
          "\"$1\" film film -q --ticks :4 -o film.png && mkdir parts frames && cp film/frame_00000[0-3].png frames "
          "&& ffmpeg -v error -i film.png -start_number 0 parts/frame_%06d.png </dev/null && "
          "\"$1\" diff frames parts");
}

static void video_has_every_frame_and_even_sides(void **state)
{
    need_ffmpeg();
    static const char *const names[] = {"film.mp4", "film.webm"};
    for (size_t i = 0; i < 2; i++) {
        command_result result =
            run_script("cd %1$s && %2$s film film -q --crop 0,0,81,41 --speed 20 -o ./%3$s && ls -a && ffprobe -v "
                       "error -count_frames "
                       "-show_entries stream=width,height,pix_fmt,r_frame_rate,nb_read_frames -of csv=p=0 %3$s",
                       ((const temp_folder *)*state)->name, octreel_program(), names[i]);
        assert_done(&result);
        assert_non_null(strstr(result.out, "82,42,yuv420p,20/1,10"));
        assert_null(strstr(result.out, ".part"));
        command_release(&result);
    }
}

static void video_without_ffmpeg_names_the_package(void **state)
{
    const temp_folder *own = *state;
    const command_setting bare = {.environment = {"PATH=/nowhere"}};
    command_result result = run_octreel(&bare, "film %s/film -o %s/film.mp4", own->name, own->name);
    assert_trouble(&result, "film.mp4: cannot be written, because the program ffmpeg is not installed; install the "
                            "package ffmpeg, or name a file that ends with .png");
    assert_int_equal(temp_folder_count(own), 1);
}

/* A program in place of ffmpeg ends at once, with success or without. */
static void failing_ffmpeg_is_an_error_and_leaves_no_file(void **state)
{
    do_in(*state, "mkdir bin && printf '#!/bin/sh\\nexit 3\\n' >bin/ffmpeg && chmod +x bin/ffmpeg");
    assert_refused_in(*state, "PATH=$PWD/bin:$PATH \"$1\" film film -o film.mp4",
                      "film.mp4: cannot be written: ffmpeg ");
    assert_int_equal(temp_folder_count(*state), 2);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, record, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(film_shows_each_frame_as_long_as_it_lasts),
        IN_FOLDER(same_recording_gives_the_same_bytes),
        IN_FOLDER(options_choose_ticks_speed_and_part),
        IN_FOLDER(pictures_of_any_folder_are_shown_in_the_order_of_their_names),
        IN_FOLDER(more_than_256_colours_give_rgb),
        IN_FOLDER(missing_frames_are_reported_and_left_out),
        IN_FOLDER(mistakes_are_sentences_and_leave_no_file),
        IN_FOLDER(full_disk_is_an_error_and_leaves_the_old_film),
        IN_FOLDER(interrupted_film_leaves_no_file),
        IN_FOLDER(ffmpeg_decodes_the_frames_of_the_film),
        IN_FOLDER(video_has_every_frame_and_even_sides),
        IN_FOLDER(video_without_ffmpeg_names_the_package),
        IN_FOLDER(failing_ffmpeg_is_an_error_and_leaves_no_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
