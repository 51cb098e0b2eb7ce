/* SPDX-License-Identifier: MIT */
/* test_killed.c - after a kill at any call every frame is whole, and the recording is resumed to the bytes of an
 * uninterrupted one.
 *
 * A kill leaves the files as they are at that call; buffers are lost. The program therefore runs once, is stopped at
 * each call, and its folder is copied. At some of the calls it is really killed, to check that this leaves the same
 * files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "join.h"
#include "octree/digest.h"
#include "recordings.h"
#include "session_file.h"
#include "tick_lines.h"
#include "ticks_write.h"
#include "traced.h"
#include "png_chunks.h"
#include "png_read.h"
#include "image_digest.h"

enum { MOST = 512 };

#define FILM "record --jobs 1 --keys wd --size 16x16 --diagram none"

static const char KEYS[] = "wd";

/* Copies of a folder at each call; equal copies are kept once. */
typedef struct remains {
    const temp_folder *own;
    place folder;
    size_t calls, count;
    uint64_t digests[MOST];
} remains;

static uint64_t digest_folder(const char *folder)
{
    uint64_t digest = OCTREE_DIGEST_START;
    listing names = folder_list(folder);
    for (size_t i = 0; i < names.count; i++) {
        size_t size;
        char *bytes = file_read(place_below(folder, names.names[i]).path, &size);
        digest = octree_digest_bytes(digest, names.names[i], strlen(names.names[i]));
        digest = octree_digest_bytes(octree_digest_word(digest, size), bytes, size);
        free(bytes);
    }
    listing_release(&names);
    return digest;
}

static place remains_at(const remains *r, size_t i)
{
    char name[32];
    snprintf(name, sizeof name, "remains%zu", i);
    return place_in(r->own, name);
}

static bool keep_remains(size_t call, void *context)
{
    remains *r = context;
    const uint64_t digest = digest_folder(r->folder.path);
    r->calls = call + 1;
    for (size_t i = 0; i < r->count; i++)
        if (r->digests[i] == digest)
            return true;
    assert_true(r->count < MOST);
    copy_folder(r->folder.path, remains_at(r, r->count).path);
    r->digests[r->count++] = digest;
    return true;
}

/* Run a command on a folder and copy the folder at each call. The test is skipped if the program cannot be traced. */
static remains remains_of(void **state, const char *command, const char *folder)
{
    remains r = {.own = *state, .folder = place_in(*state, folder)};
    char arguments[2048];
    snprintf(arguments, sizeof arguments, "%s %s", command, r.folder.path);
    if (!trace_octreel(arguments, r.folder.path, keep_remains, &r)) {
        print_message("this system does not allow tracing of processes\n");
        skip();
    }
    return r;
}

static void assert_frame_whole(const char *path)
{
    char text[IMAGE_DIGEST_TEXT], expected[IMAGE_DIGEST_TEXT];
    octreel_error error;
    image frame;
    if (!image_read_png(path, &frame, &error))
        fail_msg("%s", error.text);
    assert_true(image_read_text(path, "octreel-pixels", text, sizeof text));
    assert_string_equal(text, image_digest_print(IMAGE_DIGEST_NEWEST, image_digest(&frame), expected));
    image_release(&frame);
}

static void parse_line(const char *line, size_t number, void *context)
{
    json_t *object = json_read(line);
    (void)context;
    assert_whole_number(json_member(object, "tick"), number);
    json_decref(object);
}

static void assert_session_whole(const char *path)
{
    session_file file;
    octreel_error error;
    if (!session_read(path, &file, &error))
        fail_msg("%s", error.text);
    session_release(&file);
}

static void assert_object_whole(const char *path)
{
    char *text = file_read(path, NULL);
    json_decref(json_read(text));
    free(text);
}

/* The test fails unless every file is whole, except .part files. */
static void assert_all_whole(const char *folder)
{
    listing names = folder_list(folder);
    for (size_t i = 0; i < names.count; i++) {
        const char *name = names.names[i], *end = strrchr(name, '.');
        const place file = place_below(folder, name);
        if (end != NULL && strcmp(end, ".png") == 0)
            assert_frame_whole(file.path);
        if (strcmp(name, "ticks.jsonl") == 0)
            for_each_line(folder, parse_line, NULL);
        if (strcmp(name, "session.json") == 0)
            assert_session_whole(file.path);
        else if (end != NULL && strcmp(end, ".json") == 0)
            assert_object_whole(file.path);
    }
    listing_release(&names);
}

static film_options tiny_film(const char *folder)
{
    film_options options = small_film(folder);
    options.view.width = options.view.height = 16;
    return options;
}

static place film_whole(void **state)
{
    const place whole = place_in(*state, "whole");
    const octree_session session = short_session(KEYS);
    const film_options options = tiny_film(whole.path);
    assert_filmed(&session, &options);
    return whole;
}

static void assert_all_resume(const remains *r, const char *whole)
{
    const octree_session session = short_session(KEYS);
    for (size_t i = 0; i < r->count; i++) {
        const place left = remains_at(r, i);
        film_options options = tiny_film(left.path);
        options.resume = true;
        assert_all_whole(left.path);
        assert_filmed(&session, &options);
        assert_same_folders(whole, left.path, NULL);
    }
}

static void recording_killed_at_any_call_is_resumed(void **state)
{
    const place whole = film_whole(state);
    const remains r = remains_of(state, FILM " -o", "film");
    assert_true(r.count > 20); /* creating, writing and renaming a file are three calls, and there are eight files */
    assert_same_folders(whole.path, r.folder.path, NULL);
    assert_all_resume(&r, whole.path);
}

/* A frame and another file are missing, lines are wrong, and files of earlier runs are left over. */
static void resumed_recording_killed_at_any_call_is_resumed_again(void **state)
{
    const place whole = film_whole(state), film = place_in(*state, "film");
    copy_folder(whole.path, film.path);
    remove(frame_place(film.path, 1).path);
    file_write_text(place_below(film.path, "ticks_0_1.jsonl").path, "{}\n");
    file_write_text(place_below(film.path, "session.json.part").path, "{");
    file_write_text(place_below(film.path, "ticks.jsonl").path, "{\"tick\": 0}\n{\"ti");
    remove(place_below(film.path, "renderer.json").path);
    const remains r = remains_of(state, FILM " --resume -o", "film");
    assert_true(r.count > 10);
    assert_same_folders(whole.path, r.folder.path, NULL);
    assert_all_resume(&r, whole.path);
}

static void chunk_killed_at_any_call_is_resumed(void **state)
{
    const place whole = film_whole(state);
    const remains r = remains_of(state, FILM " --ticks 1: -o", "film");
    assert_true(r.count > 15);
    assert_all_resume(&r, whole.path);
}

static void join_killed_at_any_call_is_repeated(void **state)
{
    const place whole = film_whole(state), film = place_in(*state, "film");
    const octree_session session = short_session(KEYS);
    for (uint64_t i = 0; i < 3; i++) {
        const film_options part = chunk_of(tiny_film(film.path), i, i + 1);
        assert_filmed(&session, &part);
    }
    const remains r = remains_of(state, "join", "film");
    assert_true(r.count > 5);
    assert_same_folders(whole.path, r.folder.path, NULL);
    for (size_t i = 0; i < r.count; i++) {
        const place left = remains_at(&r, i);
        film_options options = {.folder = left.path};
        film_summary summary;
        octreel_error error = {""};
        assert_all_whole(left.path);
        if (!join_chunks(&options, &summary, &error))
            fail_msg("%s", error.text);
        assert_same_folders(whole.path, left.path, NULL);
    }
}

/* ---- What a kill leaves -------------------------------------------------------------------------------------- */

typedef struct killing {
    place folder;
    size_t at;
    uint64_t digest; /* digest of the folder at that call */
} killing;

static bool kill_at(size_t call, void *context)
{
    killing *k = context;
    if (call < k->at)
        return true;
    k->digest = digest_folder(k->folder.path);
    return false;
}

static void files_after_a_kill_are_those_at_the_call(void **state)
{
    const remains r = remains_of(state, FILM " -o", "film");
    for (size_t at = 3; at < r.calls; at += r.calls / 4) {
        char name[16], arguments[2048];
        snprintf(name, sizeof name, "film%u", (unsigned)at);
        killing k = {.folder = place_in(*state, name), .at = at};
        snprintf(arguments, sizeof arguments, FILM " -o %s", k.folder.path);
        if (!trace_octreel(arguments, k.folder.path, kill_at, &k))
            skip();
        assert_true(k.digest != 0);
        assert_true(digest_folder(k.folder.path) == k.digest);
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(recording_killed_at_any_call_is_resumed),
        IN_FOLDER(resumed_recording_killed_at_any_call_is_resumed_again),
        IN_FOLDER(chunk_killed_at_any_call_is_resumed),
        IN_FOLDER(join_killed_at_any_call_is_repeated),
        IN_FOLDER(files_after_a_kill_are_those_at_the_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
