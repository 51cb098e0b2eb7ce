/* SPDX-License-Identifier: MIT */
/* test_chunks.c - a session recorded in chunks: the files of a chunk, the refused chunks, and chunks that join to the
 * bytes of one recording. Missing and wrong parts are named. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "join.h"
#include "folder.h"
#include "random_session.h"
#include "recordings.h"

enum { TICKS = 17 };

static const char KEYS[] = "wwddeennwwddssaa"; /* one less than TICKS */

static void film_chunk(const octree_session *session, const char *folder, uint64_t first, uint64_t last)
{
    const film_options options = chunk_of(small_film(folder), first, last);
    assert_filmed(session, &options);
}

/* The whole session as one recording; film_chunks() records it in three chunks, the last one first. */
static place film_whole(void **state)
{
    const place folder = place_in(*state, "whole");
    const octree_session session = short_session(KEYS);
    const film_options options = small_film(folder.path);
    assert_filmed(&session, &options);
    return folder;
}

static place film_chunks(void **state)
{
    const place folder = place_in(*state, "chunks");
    const octree_session session = short_session(KEYS);
    film_chunk(&session, folder.path, 11, TICKS);
    film_chunk(&session, folder.path, 0, 5);
    film_chunk(&session, folder.path, 5, 11);
    return folder;
}

static void assert_joined(const char *folder)
{
    film_options options = {.folder = folder};
    film_summary summary;
    octreel_error error = {""};
    if (!join_chunks(&options, &summary, &error))
        fail_msg("%s", error.text);
    assert_int_equal(summary.ticks, TICKS);
}

/* The test fails unless joining is refused with a sentence that contains both parts, and changes no file. */
static void assert_not_joined(const char *folder, const char *what, const char *reason)
{
    film_options options = {.folder = folder};
    film_summary summary;
    octreel_error error = {""};
    listing before = folder_list(folder);
    assert_false(join_chunks(&options, &summary, &error));
    if (strstr(error.text, what) == NULL || strstr(error.text, reason) == NULL)
        fail_msg("\"%s\" does not contain both \"%s\" and \"%s\"", error.text, what, reason);
    listing after = folder_list(folder);
    assert_int_equal(before.count, after.count);
    listing_release(&before);
    listing_release(&after);
}

static void chunk_writes_its_frames_and_lines(void **state)
{
    static const char *const names[] = {"frame_000005.png", "frame_000006.png", "frame_000007.png", "recording.json",
                                        "renderer.json",    "session.json",     "ticks_5_8.jsonl"};
    const place folder = place_in(*state, "film");
    const octree_session session = short_session(KEYS);
    const film_options options = chunk_of(small_film(folder.path), 5, 8);
    const film_summary summary = assert_filmed(&session, &options);
    assert_int_equal(summary.ticks, 3);
    assert_int_equal(summary.frames, 3);
    assert_int_equal(summary.total, 3);
    listing found = folder_list(folder.path);
    assert_int_equal(found.count, sizeof names / sizeof names[0]);
    for (size_t i = 0; i < found.count; i++)
        assert_string_equal(found.names[i], names[i]);
    listing_release(&found);
}

static void joined_chunks_have_the_bytes_of_one_recording(void **state)
{
    const place whole = film_whole(state), chunks = film_chunks(state);
    assert_joined(chunks.path);
    assert_same_folders(whole.path, chunks.path, NULL);
    assert_joined(chunks.path); /* joining again changes nothing */
    assert_same_folders(whole.path, chunks.path, NULL);
}

static void overlapping_chunks_join(void **state)
{
    const place whole = film_whole(state), chunks = film_chunks(state);
    const octree_session session = short_session(KEYS);
    film_chunk(&session, chunks.path, 2, 14);
    film_chunk(&session, chunks.path, 4, 6);
    film_chunk(&session, chunks.path, 0, TICKS);
    assert_joined(chunks.path);
    assert_same_folders(whole.path, chunks.path, NULL);
}

static void stopped_recording_and_a_chunk_join(void **state)
{
    const place whole = film_whole(state), chunks = place_in(*state, "chunks");
    const octree_session session = short_session(KEYS);
    uint64_t ticks = 6;
    const film_options options = small_film(chunks.path), stopped = stopped_after(options, &ticks);
    assert_int_equal(assert_filmed(&session, &stopped).ticks, 6);
    film_chunk(&session, chunks.path, 6, TICKS);
    assert_joined(chunks.path);
    assert_same_folders(whole.path, chunks.path, NULL);
}

static void session_with_edits_and_every_third_frame_joins(void **state)
{
    static random_session made;
    const place whole = place_in(*state, "whole"), chunks = place_in(*state, "chunks");
    random_session_full(&made, 3);
    film_options options = small_film(whole.path);
    options.every = 7;
    options.view.camera = CAMERA_FOLLOW;
    options.view.fit = FIT_POINTS;
    const film_summary all = assert_filmed(&made.session, &options);
    options.folder = chunks.path;
    film_summary sum = {0};
    for (uint64_t at = 0; at < all.ticks; at += 31) {
        const film_options chunk =
            chunk_of(options, at, at + 31); /* the last chunk reaches beyond the end of the session */
        const film_summary summary = assert_filmed(&made.session, &chunk);
        sum.ticks += summary.ticks;
        sum.frames += summary.frames;
    }
    assert_int_equal(sum.ticks, all.ticks);
    assert_int_equal(sum.frames, all.frames);
    film_summary joined;
    octreel_error error = {""};
    film_options found = {.folder = chunks.path};
    if (!join_chunks(&found, &joined, &error))
        fail_msg("%s", error.text);
    assert_int_equal(joined.ticks, all.ticks);
    assert_int_equal(joined.frames, all.frames);
    assert_int_equal(joined.left_out, all.left_out);
    assert_int_equal(joined.total, all.total);
    assert_int_equal(found.every, 7);
    assert_same_folders(whole.path, chunks.path, NULL);
}

static void stopped_join_changes_nothing(void **state)
{
    const place chunks = film_chunks(state), copy = place_in(*state, "copy");
    uint64_t ticks = 9;
    film_options options = stopped_after(small_film(chunks.path), &ticks);
    film_summary summary;
    octreel_error error = {""};
    copy_folder(chunks.path, copy.path);
    assert_true(join_chunks(&options, &summary, &error));
    assert_int_equal(summary.ticks, 9);
    assert_int_equal(summary.total, TICKS);
    assert_same_folders(chunks.path, copy.path, NULL);
}

/* ---- What is missing ---------------------------------------------------------------------------------------- */

static void missing_chunks_are_named_by_their_first_tick(void **state)
{
    const place chunks = film_chunks(state);
    remove(place_below(chunks.path, "ticks_11_17.jsonl").path);
    assert_not_joined(chunks.path, "no chunk has tick 11;", "--resume");
    remove(place_below(chunks.path, "ticks_5_11.jsonl").path);
    assert_not_joined(chunks.path, "no chunk has tick 5;", "--resume");
    const octree_session session = short_session(KEYS);
    film_chunk(&session, chunks.path, 7, 8);
    assert_not_joined(chunks.path, "no chunk has tick 5;", "--resume");
    remove(place_below(chunks.path, "ticks_0_5.jsonl").path);
    assert_not_joined(chunks.path, "no chunk has tick 0;", "--resume");
}

static void unfinished_chunk_lacks_its_last_ticks(void **state)
{
    const place chunks = film_chunks(state), lines = place_below(chunks.path, "ticks_5_11.jsonl");
    size_t size;
    char *text = file_read(lines.path, &size);
    file_write(lines.path, text, size - 3); /* the last line is torn */
    assert_not_joined(chunks.path, "no chunk has tick 10;", "--resume");
    file_write(lines.path, text, 0);
    assert_not_joined(chunks.path, "no chunk has tick 5;", "--resume");
    free(text);
}

static void missing_frames_are_named(void **state)
{
    const place chunks = film_chunks(state);
    remove(frame_place(chunks.path, 16).path);
    assert_not_joined(chunks.path, "frame_000016.png is missing", "--resume");
    remove(frame_place(chunks.path, 0).path);
    assert_not_joined(chunks.path, "frame_000000.png is missing", "--resume");
}

static void missing_files_of_the_recording_are_named(void **state)
{
    static const char *const names[] = {"renderer.json", "session.json", "recording.json"};
    const place chunks = film_chunks(state);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        remove(place_below(chunks.path, names[i]).path);
        assert_not_joined(chunks.path, names[i], i == 0 ? "is missing" : "No such file or directory");
    }
}

/* ---- What is wrong ------------------------------------------------------------------------------------------ */

/* Lines of other ticks, without a scene digest, or with the digest of another scene than the frame's. */
static void line_of_another_tick_or_frame_is_named(void **state)
{
    const place chunks = film_chunks(state), lines = place_below(chunks.path, "ticks_5_11.jsonl");
    char *text = file_read(lines.path, NULL), *third = strstr(text, "\"tick\": 7,"),
         *scene = strstr(third, "\"scene\": ");
    third[strlen("\"tick\": ")] = '8';
    file_write_text(lines.path, text);
    assert_not_joined(chunks.path, "ticks_5_11.jsonl: ", "expected the line of tick 7");
    third[strlen("\"tick\": ")] = '7';
    scene[1] = 'S';
    file_write_text(lines.path, text);
    assert_not_joined(chunks.path, "ticks_5_11.jsonl: ", "expected the line of tick 7");
    scene[1] = 's';
    char *digit = scene + strlen("\"scene\": \"");
    *digit = *digit == '0' ? '1' : '0';
    file_write_text(lines.path, text);
    assert_not_joined(chunks.path, frame_place(chunks.path, 7).path, "another view");
    free(text);
}

static void chunk_with_surplus_lines_or_ticks_is_named(void **state)
{
    const place chunks = film_chunks(state), lines = place_below(chunks.path, "ticks_5_11.jsonl");
    char *text = file_read(lines.path, NULL);
    FILE *file = fopen(lines.path, "a");
    fputs("{}\n", file);
    fclose(file);
    assert_not_joined(chunks.path, "ticks_5_11.jsonl", "more lines than ticks");
    file_write_text(lines.path, text);
    file_write_text(place_below(chunks.path, "ticks_3_18.jsonl").path, "");
    assert_not_joined(chunks.path, "ticks_3_18.jsonl", "whose last tick is 16");
    free(text);
}

static void incomplete_frame_is_named(void **state)
{
    const place chunks = film_chunks(state), frame = frame_place(chunks.path, 8);
    size_t size;
    char *bytes = file_read(frame.path, &size);
    const size_t sizes[] = {0, 7, 60, size / 2, size - 12, size - 1};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        file_write(frame.path, bytes, sizes[i]);
        assert_not_joined(chunks.path, frame.path, ": ");
    }
    bytes[size - 30] ^= 4;
    file_write(frame.path, bytes, size);
    assert_not_joined(chunks.path, frame.path, ": ");
    free(bytes);
}

static void frame_of_another_tick_session_or_view_is_named(void **state)
{
    const place chunks = film_chunks(state), frame = frame_place(chunks.path, 8), other = place_in(*state, "other");
    char *own = NULL, *others;
    size_t own_size, size;
    own = file_read(frame.path, &own_size);
    others = file_read(frame_place(chunks.path, 9).path, &size);
    file_write(frame.path, others, size);
    assert_not_joined(chunks.path, frame.path, "is the frame of tick");
    free(others);
    octree_session session = short_session("wwddeennwwddssaw");
    film_chunk(&session, other.path, 8, 10);
    others = file_read(frame_place(other.path, 8).path, &size);
    file_write(frame.path, others, size);
    assert_not_joined(chunks.path, frame.path, "another session");
    free(others);
    session = short_session(KEYS);
    film_options view = chunk_of(small_film(place_in(*state, "view").path), 8, 10);
    view.view.camera = CAMERA_TOP;
    assert_filmed(&session, &view);
    others = file_read(frame_place(view.folder, 8).path, &size);
    file_write(frame.path, others, size);
    assert_not_joined(chunks.path, frame.path, "another view");
    free(others);
    file_write(frame.path, own, own_size);
    assert_joined(chunks.path);
    free(own);
}

static void edited_session_is_found(void **state)
{
    const place chunks = film_chunks(state), session = place_below(chunks.path, "session.json");
    char *text = file_read(session.path, NULL), *keys = strstr(text, "wwdd");
    assert_non_null(keys);
    keys[15] = 'w';
    file_write_text(session.path, text);
    assert_not_joined(chunks.path, frame_place(chunks.path, 0).path, "another session");
    free(text);
}

static void surplus_frame_is_named(void **state)
{
    const place chunks = film_chunks(state), extra = frame_place(chunks.path, TICKS);
    file_write_text(extra.path, "");
    assert_not_joined(chunks.path, extra.path, "not a frame of this recording");
}

/* ---- Parts that are refused --------------------------------------------------------------------------------- */

static void assert_not_filmed(const octree_session *session, const film_options *options, const char *what,
                              const char *reason)
{
    film_summary summary;
    octreel_error error = {""};
    assert_false(film_session(session, options, &summary, &error));
    if (strstr(error.text, what) == NULL || strstr(error.text, reason) == NULL)
        fail_msg("\"%s\" does not contain both \"%s\" and \"%s\"", error.text, what, reason);
}

static void chunk_of_another_recording_is_refused_and_changes_nothing(void **state)
{
    const place chunks = film_chunks(state), copy = place_in(*state, "copy");
    copy_folder(chunks.path, copy.path);
    const octree_session session = short_session(KEYS), other = short_session("wwd");
    film_options options = chunk_of(small_film(chunks.path), 2, 4);
    assert_not_filmed(&other, &options, "session.json", "another session");
    options.view.camera = CAMERA_TOP;
    assert_not_filmed(&session, &options, "recording.json", "another view");
    options = chunk_of(small_film(chunks.path), 2, 4);
    options.every = 2;
    assert_not_filmed(&session, &options, "recording.json", "every");
    options = chunk_of(small_film(chunks.path), 0, 5);
    assert_not_filmed(&session, &options, "ticks_0_5.jsonl", "--resume");
    assert_same_folders(chunks.path, copy.path, NULL);
}

static void chunk_beyond_the_session_is_refused_and_writes_nothing(void **state)
{
    const place folder = place_in(*state, "film");
    const octree_session session = short_session(KEYS);
    const film_options options = chunk_of(small_film(folder.path), TICKS, TICKS + 5);
    assert_not_filmed(&session, &options, "tick 17", "last tick is 16");
    assert_false(file_exists(folder.path));
}

static void folder_with_chunks_is_refused_for_a_whole_recording(void **state)
{
    const place chunks = film_chunks(state);
    const octree_session session = short_session(KEYS);
    const film_options options = small_film(chunks.path);
    assert_not_filmed(&session, &options, chunks.path, "already holds a recording");
}

/* ---- The program -------------------------------------------------------------------------------------------- */

/* All processes start at the same time, and the folder does not exist yet. */
static void four_processes_record_the_bytes_of_one(void **state)
{
    const place whole = place_in(*state, "whole"), chunks = place_in(*state, "chunks");
    command_result result = run_octreel(NULL, "record --size 160x90 --camera orbit -o %s", whole.path);
    assert_done(&result);
    command_release(&result);
    result =
        run_script("for t in :64 64:128 128:192 192:256; do %s record --size 160x90 --camera orbit --ticks $t -o %s & "
                   "pids=\"$pids $!\"; done; for p in $pids; do wait $p || exit; done",
                   octreel_program(), chunks.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "join %s --json", chunks.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "\"ticks\": 253, \"frames\": 253"));
    command_release(&result);
    assert_same_folders(whole.path, chunks.path, NULL);
}

static void gnu_parallel_records_the_chunks(void **state)
{
    const place whole = place_in(*state, "whole"), chunks = place_in(*state, "chunks");
    if (!is_program_installed("parallel"))
        skip();
    command_result result = run_octreel(NULL, "record --size 160x90 -o %s", whole.path);
    assert_done(&result);
    command_release(&result);
    result = run_script("export program=%s; parallel '\"$program\"' record --size 160x90 --jobs 1 -o %s --ticks {}:'{= "
                        "$_ += 64 =}' ::: "
                        "$(seq 0 64 252) && \"$program\" join %s",
                        octreel_program(), chunks.path, chunks.path);
    assert_int_equal(result.status, 0); /* parallel may print a request for citation */
    command_release(&result);
    assert_same_folders(whole.path, chunks.path, NULL);
}

/* The script of the README's array job; each task gets its number as from Slurm. */
static void slurm_tasks_record_the_chunks(void **state)
{
    const place whole = place_in(*state, "whole"), chunks = place_in(*state, "chunks");
    command_result result = run_octreel(NULL, "record --size 160x90 -o %s", whole.path);
    assert_done(&result);
    command_release(&result);
    result = run_script(
        "task='a=$((SLURM_ARRAY_TASK_ID * 64)) && \"$program\" record --size 160x90 --jobs 1 \\\n"
        "    -o %s --ticks $a:$((a + 64))'\n"
        "export program=%s; for i in 0 1 2 3; do SLURM_ARRAY_TASK_ID=$i sh -c \"$task\" & pids=\"$pids $!\"; done; "
        "for p in $pids; do wait $p || exit; done; \"$program\" join %s",
        chunks.path, octreel_program(), chunks.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(whole.path, chunks.path, NULL);
}

static void contradicting_chunk_options_are_refused(void **state)
{
    static const char *const rows[][2] = {
        {"record --ticks 5 -o x", "100:200"},   {"record --ticks : -o x", "100:200"},
        {"record --ticks 5:5 -o x", "100:200"}, {"record --ticks 7:5 -o x", "100:200"},
        {"record --ticks a:5 -o x", "100:200"}, {"record --ticks 5:b -o x", "100:200"},
        {"record --ticks -1:5 -o x", "-1:5"},   {"record --ticks 5:6:7 -o x", "5:6:7"},
        {"record --ticks 253: -o x", "252"},    {"record --jobs 0 -o x", "--jobs"},
        {"record --jobs 257 -o x", "256"},      {"join", "one recording"},
        {"join a b", "one recording"},          {"join absent", "absent: no such file or folder"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "%s", rows[i][0]);
        assert_trouble(&result, rows[i][1]);
        assert_false(file_exists("x"));
    }
}

static void join_names_missing_parts_in_one_sentence(void **state)
{
    const place chunks = film_chunks(state);
    remove(place_below(chunks.path, "ticks_0_5.jsonl").path);
    command_result result = run_octreel(NULL, "join %s", chunks.path);
    assert_trouble(&result, "no chunk has tick 0");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(chunk_writes_its_frames_and_lines),
        IN_FOLDER(joined_chunks_have_the_bytes_of_one_recording),
        IN_FOLDER(overlapping_chunks_join),
        IN_FOLDER(stopped_recording_and_a_chunk_join),
        IN_FOLDER(session_with_edits_and_every_third_frame_joins),
        IN_FOLDER(stopped_join_changes_nothing),
        IN_FOLDER(missing_chunks_are_named_by_their_first_tick),
        IN_FOLDER(unfinished_chunk_lacks_its_last_ticks),
        IN_FOLDER(missing_frames_are_named),
        IN_FOLDER(missing_files_of_the_recording_are_named),
        IN_FOLDER(line_of_another_tick_or_frame_is_named),
        IN_FOLDER(chunk_with_surplus_lines_or_ticks_is_named),
        IN_FOLDER(incomplete_frame_is_named),
        IN_FOLDER(frame_of_another_tick_session_or_view_is_named),
        IN_FOLDER(edited_session_is_found),
        IN_FOLDER(surplus_frame_is_named),
        IN_FOLDER(chunk_of_another_recording_is_refused_and_changes_nothing),
        IN_FOLDER(chunk_beyond_the_session_is_refused_and_writes_nothing),
        IN_FOLDER(folder_with_chunks_is_refused_for_a_whole_recording),
        IN_FOLDER(four_processes_record_the_bytes_of_one),
        IN_FOLDER(gnu_parallel_records_the_chunks),
        IN_FOLDER(slurm_tasks_record_the_chunks),
        cmocka_unit_test(contradicting_chunk_options_are_refused),
        IN_FOLDER(join_names_missing_parts_in_one_sentence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
