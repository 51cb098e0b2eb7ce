/* SPDX-License-Identifier: MIT */
/* test_accept.c - octreel accept: which references are replaced, added or removed, and which stay unchanged. */
#include "commands.h"
#include "fixture.h"
#include "files.h"
#include "galleries.h"
#include "recordings.h"
#include "png_write.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* CI runs these tests too. */
static int without_ci(void **state)
{
    unsetenv("CI");
    return temp_folder_make(state);
}

static command_result accept_all(const place *reference, const place *frames)
{
    command_result result = run_octreel(NULL, "accept %s %s", reference->path, frames->path);
    assert_done(&result);
    return result;
}

/* A reference and a later state of it: 1 unchanged, 2 changed, 3 gone, 4 new. */
typedef struct change {
    place before, after;
} change;

static change make_change(void **state)
{
    const change made = {gallery_make(*state, "golden", "1.png 2.png 3.png"),
                         gallery_make(*state, "new", "1.png 2.png 4.png")};
    gallery_write(place_below(made.after.path, "2.png").path, 1, 5);
    gallery_write(place_below(made.after.path, "4.png").path, 77, 0);
    return made;
}

static void all_new_frames_become_the_reference(void **state)
{
    const change c = make_change(state);
    command_result result = accept_all(&c.before, &c.after);
    assert_contains(result.out, "changed  2.png: 5 of 384 pixels differ");
    assert_contains(result.out, "removed  3.png");
    assert_contains(result.out, "new      4.png: 24x16");
    assert_contains(result.out, "golden: 3 before, 3 after: 1 changed, 1 new, 1 removed");
    command_release(&result);
    assert_same_folders(c.before.path, c.after.path, NULL);
    result = accept_all(&c.before, &c.after);
    assert_contains(result.out, "3 before, 3 after: 0 changed, 0 new, 0 removed");
    command_release(&result);
}

static void json_lists_the_changes(void **state)
{
    const change c = make_change(state);
    char expected[3000];
    snprintf(expected, sizeof expected,
             "{\"reference\": \"%s\", \"before\": 3, \"after\": 3, \"changed\": 1, \"new\": 1, \"removed\": 1, "
             "\"frames\": [{\"name\": \"2.png\", \"action\": \"changed\"}, {\"name\": \"3.png\", \"action\": "
             "\"removed\"}, {\"name\": \"4.png\", \"action\": \"new\"}]}\n",
             c.before.path);
    command_result result = run_octreel(NULL, "accept --json -q %s %s", c.before.path, c.after.path);
    assert_done(&result);
    assert_string_equal(result.out, expected);
    command_release(&result);
}

static void only_named_frames_are_accepted(void **state)
{
    const change c = make_change(state);
    command_result result = run_octreel(NULL, "accept %s %s 4.png", c.before.path, c.after.path);
    assert_done(&result);
    assert_contains(result.out, "3 before, 4 after: 0 changed, 1 new, 0 removed");
    command_release(&result);
    comparison_of made = assert_compared(c.before.path, c.after.path, NULL);
    assert_int_equal(find_finding(&made, "2.png"), FOUND_PIXELS);
    assert_int_equal(find_finding(&made, "3.png"), FOUND_NO_FRAME);
    assert_int_equal(find_finding(&made, "4.png"), FOUND_SAME_BYTES);
    comparison_release(&made);
    result = run_octreel(NULL, "accept %s %s 2.png 3.png", c.before.path, c.after.path);
    assert_done(&result);
    command_release(&result);
    assert_same_folders(c.before.path, c.after.path, NULL);
}

static void nothing_is_accepted_if_ci_is_set(void **state)
{
    const change c = make_change(state);
    const place untouched = gallery_make(*state, "untouched", "1.png 2.png 3.png");
    static const char *const values[] = {"CI=true", "CI=1", "CI="};
    for (size_t i = 0; i < 3; i++) {
        const command_setting setting = {.environment = {values[i]}};
        command_result result = run_octreel(&setting, "accept %s %s", c.before.path, c.after.path);
        assert_trouble(&result, "CI is set");
    }
    assert_same_folders(c.before.path, untouched.path, NULL);
}

/* A reference with the same pixels keeps its bytes, so that what is committed is what changed. */
static void reference_with_equal_pixels_is_unchanged(void **state)
{
    const place before = gallery_make(*state, "golden", "1.png"), after = gallery_make(*state, "new", "");
    static const image_text texts[] = {{"Comment", "new"}};
    image picture = gallery_picture(0);
    octreel_error error;
    assert_true(image_write_png(&picture, place_below(after.path, "1.png").path, texts, 1, &error));
    image_release(&picture);
    command_result result = accept_all(&before, &after);
    assert_contains(result.out, "0 changed");
    command_release(&result);
    comparison_of made = assert_compared(before.path, after.path, NULL);
    assert_int_equal(find_finding(&made, "1.png"), FOUND_SAME_PIXELS);
    comparison_release(&made);
}

static void everything_is_checked_before_the_first_write(void **state)
{
    const change c = make_change(state);
    const place untouched = gallery_make(*state, "untouched", "1.png 2.png 3.png"),
                empty = gallery_make(*state, "empty", "");
    command_result result = run_octreel(NULL, "accept %s %s 2.png nix.png", c.before.path, c.after.path);
    assert_trouble(&result, "no frame nix.png");
    result = run_octreel(NULL, "accept %s %s", c.before.path, empty.path);
    assert_trouble(&result, "contains no PNG files");
    assert_int_equal(truncate(place_below(c.after.path, "4.png").path, 200), 0);
    result = run_octreel(NULL, "accept %s %s", c.before.path, c.after.path);
    assert_trouble(&result, "4.png: the file is truncated");
    assert_same_folders(c.before.path, untouched.path, NULL);
    result = run_octreel(NULL, "accept %s", c.before.path);
    assert_trouble(&result, "accept needs a reference and new frames; ");
}

static void accept_refuses_to_remove_all_references(void **state)
{
    const place pictures = gallery_make(*state, "pictures", "cat.png dog.png"),
                untouched = gallery_make(*state, "untouched", "cat.png dog.png"),
                frames = gallery_make(*state, "new", "1.png");
    command_result result = run_octreel(NULL, "accept %s %s", pictures.path, frames.path);
    assert_trouble(&result, "refusing to remove all 2 references");
    assert_same_folders(pictures.path, untouched.path, NULL);
}

static void unreadable_reference_is_replaced(void **state)
{
    const change c = make_change(state);
    assert_int_equal(truncate(place_below(c.before.path, "1.png").path, 100), 0);
    command_result result = accept_all(&c.before, &c.after);
    assert_contains(result.out, "changed  1.png: cannot be read");
    command_release(&result);
    assert_same_folders(c.before.path, c.after.path, NULL);
}

static void missing_reference_is_created(void **state)
{
    const place frames = gallery_make(*state, "new", "1.png 2.png"), folder = place_in(*state, "made/golden"),
                one = place_below(frames.path, "2.png"), picture = place_in(*state, "one.png");
    command_result result = accept_all(&folder, &frames);
    assert_contains(result.out, "0 before, 2 after");
    command_release(&result);
    assert_same_folders(folder.path, frames.path, NULL);
    result = accept_all(&picture, &one);
    command_release(&result);
    comparison_of made = assert_compared(picture.path, one.path, NULL);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
    gallery_write(one.path, 8, 3);
    result = accept_all(&picture, &one);
    assert_contains(result.out, "1 before, 1 after: 1 changed");
    command_release(&result);
}

/* What would be made is not what its name says it is. */
static void name_of_a_file_becomes_no_folder_and_no_picture_in_another_format(void **state)
{
    const place frames = gallery_make(*state, "new", "1.png 2.png"), one = place_below(frames.path, "2.png");
    static const char *const names[] = {"golden.digests", "golden.png", "golden.json"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const place reference = place_in(*state, names[i]);
        command_result result = run_octreel(NULL, "accept %s %s", reference.path, frames.path);
        assert_trouble(&result, "this is the name of a file, but the references are a folder; ");
        assert_false(file_exists(reference.path));
    }
    const place golden = place_in(*state, "golden");
    command_result result = run_octreel(NULL, "accept %s %s", golden.path, one.path);
    assert_trouble(&result, "use NAME.png");
    assert_false(file_exists(golden.path));
}

/* Only what is not there is new: a link to itself is there. */
static void inaccessible_reference_is_an_error(void **state)
{
    const place frames = gallery_make(*state, "new", "1.png"), loop = place_in(*state, "golden.digests");
    struct stat status;
    assert_int_equal(symlink("golden.digests", loop.path), 0);
    command_result result = run_octreel(NULL, "accept %s %s --reason first --date 2026-11-23", loop.path, frames.path);
    assert_trouble(&result, "golden.digests: Too many levels of symbolic links");
    assert_int_equal(lstat(loop.path, &status), 0);
    assert_true(S_ISLNK(status.st_mode));
}

/* ---- Subfolders ---------------------------------------------------------------------------------------------- */

/* A reference and a later state of it, in subfolders: menu/1.png changed, old/2.png gone, hud/deep/3.png new. */
static change make_nested_change(void **state)
{
    const change made = {gallery_make(*state, "golden", "0.png menu/1.png old/2.png"),
                         gallery_make(*state, "new", "0.png menu/1.png hud/deep/3.png")};
    gallery_write(place_below(made.after.path, "menu/1.png").path, 1, 5);
    return made;
}

static void references_in_subfolders_are_written_and_removed(void **state)
{
    const change c = make_nested_change(state);
    command_result result = accept_all(&c.before, &c.after);
    assert_contains(result.out, "new      hud/deep/3.png: 24x16");
    assert_contains(result.out, "changed  menu/1.png: 5 of 384 pixels differ");
    assert_contains(result.out, "removed  old/2.png");
    assert_contains(result.out, "golden: 3 before, 3 after: 1 changed, 1 new, 1 removed");
    command_release(&result);
    assert_same_files(place_below(c.before.path, "menu/1.png").path, place_below(c.after.path, "menu/1.png").path);
    assert_same_files(place_below(c.before.path, "hud/deep/3.png").path,
                      place_below(c.after.path, "hud/deep/3.png").path);
    assert_false(file_exists(place_below(c.before.path, "old").path));
}

static void subfolders_stay_unchanged_without_recursion(void **state)
{
    const change c = make_nested_change(state);
    gallery_write(place_below(c.after.path, "0.png").path, 0, 5);
    command_result result = run_octreel(NULL, "accept --no-recursive %s %s", c.before.path, c.after.path);
    assert_done(&result);
    assert_contains(result.out, "golden: 1 before, 1 after: 1 changed, 0 new, 0 removed");
    command_release(&result);
    assert_true(file_exists(place_below(c.before.path, "old/2.png").path));
    assert_false(file_exists(place_below(c.before.path, "hud").path));
}

/* A reference is removed only if its frame does not exist, not if the frame's folder was left out. */
static void frames_in_folders_that_are_not_searched_keep_their_references(void **state)
{
    static const char sentence[] = "new/menu/1.png: refusing to remove its reference: the frame exists, but its folder";
    const change c = make_nested_change(state);
    const place golden = place_in(*state, "golden"), lines = place_in(*state, "lines.txt"),
                menu = place_below(c.after.path, "menu"), build = place_in(*state, "build"),
                evidence = place_below(build.path, EVIDENCE_MARKER);
    command_result result = run_octreel(NULL, "accept %s %s --reason why", lines.path, golden.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "accept %s %s --no-recursive --reason why", lines.path, c.after.path);
    assert_trouble(&result, sentence);
    assert_int_equal(rename(menu.path, build.path), 0);
    assert_int_equal(symlink("../build", menu.path), 0);
    result = run_octreel(NULL, "accept %s %s", golden.path, c.after.path);
    assert_trouble(&result, sentence);
    assert_int_equal(unlink(menu.path), 0);
    file_write_text(evidence.path, EVIDENCE_MARKER_BEGINNING);
    assert_int_equal(rename(build.path, menu.path), 0);
    result = run_octreel(NULL, "accept %s %s menu/1.png", golden.path, c.after.path);
    assert_trouble(&result, sentence);
    assert_true(file_exists(place_below(golden.path, "menu/1.png").path));
    result = run_octreel(NULL, "accept %s %s old/2.png", golden.path, c.after.path);
    assert_done(&result);
    assert_contains(result.out, "golden: 3 before, 2 after: 0 changed, 0 new, 1 removed");
    command_release(&result);
}

/* On a full disk, and where a link would lead out of the reference. */
static void nothing_in_subfolders_is_accepted_after_an_error(void **state)
{
    const change c = make_nested_change(state);
    const command_setting full = {.file_limit = 16};
    command_result result = run_octreel(&full, "accept %s %s", c.before.path, c.after.path);
    assert_trouble(&result, "3.png: cannot be written");
    assert_false(file_exists(place_below(c.before.path, "hud").path));
    const place elsewhere = gallery_make(*state, "elsewhere", ""), link = place_below(c.before.path, "hud");
    assert_int_equal(symlink(elsewhere.path, link.path), 0);
    result = run_octreel(NULL, "accept %s %s", c.before.path, c.after.path);
    assert_trouble(&result, "golden/hud: cannot create the folder: a link has this name");
    assert_false(file_exists(place_below(elsewhere.path, "deep").path));
    comparison_of made = assert_compared(c.before.path, c.after.path, NULL);
    assert_int_equal(find_finding(&made, "menu/1.png"), FOUND_PIXELS);
    assert_int_equal(find_finding(&made, "old/2.png"), FOUND_NO_FRAME);
    comparison_release(&made);
}

static void frames_in_subfolders_are_named_by_their_paths(void **state)
{
    const change c = make_nested_change(state);
    command_result result = run_octreel(NULL, "accept %s %s 3.png", c.before.path, c.after.path);
    assert_trouble(&result, "golden; did you mean hud/deep/3.png?");
    result = run_octreel(NULL, "accept %s %s hud/deep/3.png", c.before.path, c.after.path);
    assert_done(&result);
    assert_contains(result.out, "golden: 3 before, 4 after: 0 changed, 1 new, 0 removed");
    command_release(&result);
}

/* New frames in the reference's folder are no references, and the other way round. */
static void sides_in_one_another_are_not_mixed(void **state)
{
    const place outer = gallery_make(*state, "outer", "1.png inner/1.png"), inner = place_below(outer.path, "inner");
    gallery_write(place_below(inner.path, "2.png").path, 7, 0);
    command_result result = accept_all(&outer, &inner);
    assert_contains(result.out, "outer: 1 before, 2 after: 1 changed, 1 new, 0 removed");
    command_release(&result);
    result = accept_all(&inner, &outer);
    assert_contains(result.out, "inner: 2 before, 2 after: 0 changed, 0 new, 0 removed");
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s", inner.path, outer.path);
    assert_done(&result);
    command_release(&result);
}

#define BECAUSE " --reason why --date 2026-11-22"

static void accept_updates_a_baseline_line_by_line(void **state)
{
    const change c = make_change(state);
    const place digests = place_in(*state, "golden.digests"), fresh = place_in(*state, "fresh.digests");
    command_result result = run_octreel(NULL, "accept %s %s" BECAUSE, digests.path, c.before.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "accept %s %s 2.png" BECAUSE, digests.path, c.after.path);
    assert_done(&result);
    assert_contains(result.out, "3 before, 3 after: 1 changed, 0 new, 0 removed");
    command_release(&result);
    comparison_of made = assert_compared(digests.path, c.after.path, NULL);
    assert_int_equal(find_finding(&made, "2.png"), FOUND_SAME_PIXELS);
    assert_int_equal(find_finding(&made, "3.png"), FOUND_NO_FRAME);
    assert_int_equal(find_finding(&made, "4.png"), FOUND_NO_REFERENCE);
    comparison_release(&made);
    result = run_octreel(NULL, "accept %s %s" BECAUSE, digests.path, c.after.path);
    command_release(&result);
    result = run_octreel(NULL, "accept %s %s" BECAUSE, fresh.path, c.after.path);
    command_release(&result);
    char *accepted = file_read(digests.path, NULL), *expected = file_read(fresh.path, NULL);
    assert_string_equal(accepted, expected);
    free(accepted);
    free(expected);
}

static void film(const place *folder, const char *keys)
{
    octree_session session = octree_session_default();
    film_options options = small_film(folder->path);
    session.keys = keys;
    assert_filmed(&session, &options);
}

static void recording_is_accepted_with_its_ticks(void **state)
{
    const place before = place_in(*state, "golden"), after = place_in(*state, "new"), made = place_in(*state, "made");
    film(&before, "wwd");
    film(&after, "ds");
    command_result result = run_octreel(NULL, "accept %s %s frame_000001.png", before.path, after.path);
    assert_done(&result);
    assert_contains(result.out, "ticks.jsonl was not changed");
    command_release(&result);
    result = accept_all(&before, &after);
    command_release(&result);
    assert_same_folders(before.path, after.path, NULL);
    result = accept_all(&made, &after);
    command_release(&result);
    assert_same_folders(made.path, after.path, NULL);
}

/* Where nothing has changed nothing is said of ticks; and other files may lie there. */
static void empty_folder_becomes_a_recording(void **state)
{
    const place empty = place_in(*state, "golden"), after = place_in(*state, "new");
    film(&after, "ds");
    file_write_text(place_below(after.path, "ticks").path, "mine");
    file_write_text(place_below(after.path, "ticks.txt").path, "mine");
    assert_int_equal(mkdir(empty.path, 0777), 0);
    command_result result = accept_all(&empty, &after);
    assert_contains(result.out, "0 before, 3 after: 0 changed, 3 new, 0 removed");
    command_release(&result);
    assert_true(file_exists(place_below(empty.path, "ticks.jsonl").path));
    result = run_octreel(NULL, "accept %s %s frame_000001.png", empty.path, after.path);
    assert_done(&result);
    assert_contains(result.out, "0 changed");
    assert_null(strstr(result.out, "Its ticks"));
    command_release(&result);
}

static void long_list_of_frames_is_cut(void **state)
{
    const place golden = place_in(*state, "golden"),
                after = gallery_make(*state, "new",
                                     "1.png 2.png 3.png 4.png 5.png 6.png 7.png 8.png 9.png A.png B.png C.png");
    command_result result = accept_all(&golden, &after);
    assert_contains(result.out, "new      A.png");
    assert_null(strstr(result.out, "B.png"));
    assert_contains(result.out, "2 more");
    command_release(&result);
    assert_same_folders(golden.path, after.path, NULL);
}

static void baseline_cannot_be_accepted(void **state)
{
    const place golden = gallery_make(*state, "golden", "1.png"), digests = place_in(*state, "new.digests");
    command_result result = run_octreel(NULL, "accept %s %s" BECAUSE, digests.path, golden.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "accept %s %s", golden.path, digests.path);
    assert_trouble(&result, "cannot accept a baseline; give the pictures themselves");
}

static void plain_pictures_cannot_replace_a_recording(void **state)
{
    const place before = place_in(*state, "golden"), after = gallery_make(*state, "new", "frame_000000.png");
    film(&before, "w");
    command_result result = run_octreel(NULL, "accept %s %s", before.path, after.path);
    assert_trouble(&result, "is a recording");
}

static void unwritable_reference_is_an_error(void **state)
{
    const change c = make_change(state);
    const command_setting full = {.file_limit = 16};
    const place untouched = gallery_make(*state, "untouched", "1.png 2.png 3.png");
    command_result result = run_octreel(&full, "accept %s %s 2.png", c.before.path, c.after.path);
    assert_trouble(&result, "2.png: cannot be written");
    assert_same_folders(c.before.path, untouched.path, NULL);
}

/* Whoever films has the log locked. */
static void recording_in_progress_is_refused(void **state)
{
    const place film = place_in(*state, "film"), golden = place_in(*state, "golden");
    command_result result = run_octreel(NULL, "record --keys wd --size 64x36 -o %s", film.path);
    assert_done(&result);
    command_release(&result);
    const int log = open(place_below(film.path, "ticks.jsonl").path, O_RDONLY);
    assert_true(log >= 0 && flock(log, LOCK_EX | LOCK_NB) == 0);
    result = run_octreel(NULL, "accept %s %s", golden.path, film.path);
    assert_trouble(&result, "film: is still being recorded");
    assert_false(file_exists(golden.path));
    close(log);
    result = accept_all(&golden, &film);
    command_release(&result);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, without_ci, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(recording_in_progress_is_refused),
        WITH_FOLDER(all_new_frames_become_the_reference),
        WITH_FOLDER(json_lists_the_changes),
        WITH_FOLDER(only_named_frames_are_accepted),
        WITH_FOLDER(nothing_is_accepted_if_ci_is_set),
        WITH_FOLDER(reference_with_equal_pixels_is_unchanged),
        WITH_FOLDER(everything_is_checked_before_the_first_write),
        WITH_FOLDER(accept_refuses_to_remove_all_references),
        WITH_FOLDER(unreadable_reference_is_replaced),
        WITH_FOLDER(missing_reference_is_created),
        WITH_FOLDER(name_of_a_file_becomes_no_folder_and_no_picture_in_another_format),
        WITH_FOLDER(inaccessible_reference_is_an_error),
        WITH_FOLDER(references_in_subfolders_are_written_and_removed),
        WITH_FOLDER(subfolders_stay_unchanged_without_recursion),
        WITH_FOLDER(frames_in_folders_that_are_not_searched_keep_their_references),
        WITH_FOLDER(nothing_in_subfolders_is_accepted_after_an_error),
        WITH_FOLDER(frames_in_subfolders_are_named_by_their_paths),
        WITH_FOLDER(sides_in_one_another_are_not_mixed),
        WITH_FOLDER(accept_updates_a_baseline_line_by_line),
        WITH_FOLDER(recording_is_accepted_with_its_ticks),
        WITH_FOLDER(empty_folder_becomes_a_recording),
        WITH_FOLDER(long_list_of_frames_is_cut),
        WITH_FOLDER(baseline_cannot_be_accepted),
        WITH_FOLDER(plain_pictures_cannot_replace_a_recording),
        WITH_FOLDER(unwritable_reference_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
