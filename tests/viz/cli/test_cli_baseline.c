/* SPDX-License-Identifier: MIT */
/* test_cli_baseline.c - octreel accept writes baselines and their stored pictures, and octreel diff compares with them.
 */
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "galleries.h"
#include "picture_store.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static int without_ci(void **state)
{
    unsetenv("CI");
    return temp_folder_make(state);
}

/* Two versions of three frames, of which 2.png differs; and the paths of the test. */
typedef struct states {
    place before, after, file, store;
} states;

static states make_states(void **state)
{
    const states made = {gallery_make(*state, "old", "1.png 2.png 3.png"),
                         gallery_make(*state, "new", "1.png 2.png 3.png"), place_in(*state, "baseline.txt"),
                         place_in(*state, "store")};
    gallery_write(place_below(made.after.path, "2.png").path, 1, 5);
    return made;
}

#define BY(reason, date) " --reason '" reason "' --date " date

static void accept_into(const states *s, const place *frames, const char *more)
{
    command_result result = run_script("%s accept %s %s %s", octreel_program(), s->file.path, frames->path, more);
    assert_done(&result);
    command_release(&result);
}

static void assert_diff(const states *s, const place *frames, const char *more, int status, const char *part)
{
    command_result result = run_octreel(NULL, "diff %s %s %s", s->file.path, frames->path, more);
    assert_int_equal(result.status, status);
    assert_contains(result.out, part);
    command_release(&result);
}

static size_t count_lines(const char *path, const char *part)
{
    char *text = file_read(path, NULL);
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, part)); at++)
        count++;
    free(text);
    return count;
}

/* The end of an "accepted" line: the date and the reason. */
static shell_word accepted_by(const char *date, const char *reason)
{
    shell_word line;
    snprintf(line.text, sizeof line.text, " %s 24x16 %s %s\n", date, image_digest_kind_name(IMAGE_DIGEST_NEWEST),
             reason);
    return line;
}

static void accept_replaces_digests_and_variant_keeps_them(void **state)
{
    const states s = make_states(state);
    accept_into(&s, &s.before, BY("the first", "2026-11-22"));
    assert_int_equal(count_lines(s.file.path, "\n"), 6);
    assert_diff(&s, &s.before, "", 0, "same: 3 frames");
    assert_diff(&s, &s.after, "", 1, "2.png: pixels differ: digest ");
    accept_into(&s, &s.after, "2.png --variant" BY("another machine", "2026-11-23"));
    assert_int_equal(count_lines(s.file.path, "\n"), 8);
    assert_diff(&s, &s.before, "", 0, "same: 3 frames");
    assert_diff(&s, &s.after, "", 0, "same: 3 frames");
    const place third = gallery_make(*state, "third", "1.png 2.png 3.png");
    gallery_write(place_below(third.path, "2.png").path, 1, 9);
    assert_diff(&s, &third, "", 1, "; matches none of the 2 accepted variants");
    accept_into(&s, &third, BY("on purpose", "2026-11-24"));
    assert_diff(&s, &s.before, "", 1, "different: 1 of 3 frames");
    assert_diff(&s, &third, "", 0, "same: 3 frames");
    assert_int_equal(count_lines(s.file.path, "accepted "), 2);
    assert_int_equal(count_lines(s.file.path, accepted_by("2026-11-24", "on purpose").text), 1);
}

/* Lines of unchanged frames stay, so that git shows only the changes. */
static void unchanged_frames_keep_their_lines(void **state)
{
    const states s = make_states(state);
    accept_into(&s, &s.before, BY("the first", "2026-11-22"));
    char *before = file_read(s.file.path, NULL);
    accept_into(&s, &s.before, BY("again", "2026-11-25"));
    char *after = file_read(s.file.path, NULL);
    assert_string_equal(after, before);
    free(before);
    free(after);
}

static void reason_is_required_for_baselines_and_refused_elsewhere(void **state)
{
    const states s = make_states(state);
    command_result result = run_octreel(NULL, "accept %s %s", s.file.path, s.before.path);
    assert_trouble(&result, "add --reason TEXT to create a baseline");
    result = run_octreel(NULL, "accept %s %s --store %s", s.file.path, s.before.path, s.store.path);
    assert_trouble(&result, "accepting into a baseline needs a reason");
    result = run_octreel(NULL, "accept %s %s --variant", s.file.path, s.before.path);
    assert_trouble(&result, "accepting into a baseline needs a reason");
    static const char *const words[] = {"--reason x", "--variant", "--store pictures"};
    for (size_t i = 0; i < 3; i++) {
        result = run_octreel(NULL, "accept %s %s %s", s.before.path, s.after.path, words[i]);
        assert_trouble(&result, "work with a baseline only");
    }
    result = run_octreel(NULL, "accept %s - --from -", s.file.path);
    assert_trouble(&result, "\"-\" is given twice, but standard input can be read only once");
    result = run_octreel(NULL, "accept x.png %s --reason x", s.after.path);
    assert_trouble(&result, "cannot create a baseline under the name of a picture");
    accept_into(&s, &s.before, "--reason x");
    result = run_octreel(NULL, "accept %s %s", s.file.path, s.after.path);
    assert_trouble(&result, "accepting into a baseline needs a reason");
    static const char *const wrong[] = {"--date 2026-02-29", "--date today", "--reason ''", "--reason 'a\nb'",
                                        "--reason ' a'"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        result = run_script("%s accept %s %s %s", octreel_program(), s.file.path, s.after.path, wrong[i]);
        assert_trouble(&result, i < 2 ? "--date takes an existing date" : "--reason takes one line of text");
    }
    result = run_octreel(NULL, "accept %s %s --date 2026-11-22", s.file.path, s.after.path);
    assert_trouble(&result, "--date needs --reason TEXT");
    const command_setting ci = {.environment = {"CI=true"}};
    result = run_octreel(&ci, "accept %s %s --reason x", s.file.path, s.after.path);
    assert_trouble(&result, "CI is set");
}

/* ---- What a person ticked ------------------------------------------------------------------------------------ */

static void only_the_listed_frames_are_accepted(void **state)
{
    const states s = make_states(state);
    const place list = place_in(*state, "accept.txt");
    gallery_write(place_below(s.after.path, "3.png").path, 2, 5);
    accept_into(&s, &s.before, BY("the first", "2026-11-22"));
    file_write_text(list.path, "\r\n3.png\r\n3.png");
    char more[1200];
    snprintf(more, sizeof more, "--from %s" BY("ticked", "2026-11-23"), list.path);
    accept_into(&s, &s.after, more);
    assert_diff(&s, &s.after, "", 1, "different: 1 of 3 frames");
    file_write_text(list.path, "3.png\n<<<<<<< HEAD\n");
    command_result result =
        run_octreel(NULL, "accept %s %s --reason x --from %s", s.file.path, s.after.path, list.path);
    assert_trouble(&result, "line 2 of the list: no frame <<<<<<< HEAD");
    file_write_text(list.path, "\n\n");
    result = run_octreel(NULL, "accept %s %s --reason x --from %s", s.file.path, s.after.path, list.path);
    assert_trouble(&result, "accept.txt: contains no name of a frame");
    result = run_octreel(NULL, "accept %s %s --from nix.txt", s.before.path, s.after.path);
    assert_trouble(&result, "nix.txt: cannot be opened");
    file_write_text(list.path, "2.png\n"); /* --from works for folders of pictures, too */
    result = run_octreel(NULL, "accept %s %s --from %s", s.before.path, s.after.path, list.path);
    assert_done(&result);
    assert_contains(result.out, "1 changed, 0 new, 0 removed");
    command_release(&result);
}

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

/* The path of the only picture in the store, after one frame was accepted. */
static place only_picture(const states *s)
{
    command_result result = run_script("find %s -name '*.png'", s->store.path);
    place found;
    snprintf(found.path, sizeof found.path, "%.*s", (int)strcspn(result.out, "\n"), result.out);
    command_release(&result);
    return found;
}

static void evidence_shows_expected_pictures_from_the_store(void **state)
{
    const states s = make_states(state);
    const place out = place_in(*state, "out");
    char more[4096];
    snprintf(more, sizeof more, "--store %s" BY("the first", "2026-11-22"), s.store.path);
    accept_into(&s, &s.before, more);
    snprintf(more, sizeof more, "--store %s -o %s", s.store.path, out.path);
    assert_diff(&s, &s.after, more, 1, "2.png: 5 of 384 pixels differ");
    assert_same_files(place_below(out.path, "2.expected.png").path, place_below(s.before.path, "2.png").path);
    assert_true(file_exists(place_below(out.path, "2.difference.png").path));
}

static void bad_picture_in_the_store_is_reported_without_changing_the_verdict(void **state)
{
    const states s = make_states(state);
    const place out = place_in(*state, "out");
    char more[4096];
    snprintf(more, sizeof more, "2.png --store %s" BY("the first", "2026-11-22"), s.store.path);
    accept_into(&s, &s.before, more);
    const place picture = only_picture(&s);
    snprintf(more, sizeof more, "--store %s -o %s", s.store.path, out.path);
    gallery_write(picture.path, 7, 0);
    assert_diff(&s, &s.after, more, 1, ": the pixels do not match the file name: their digest is ");
    assert_false(file_exists(place_below(out.path, "2.expected.png").path));
    assert_true(file_exists(place_below(out.path, "2.actual.png").path));
    assert_int_equal(truncate(picture.path, 60), 0);
    assert_diff(&s, &s.after, more, 1, "no picture of the reference: ");
    assert_int_equal(remove(picture.path), 0);
    assert_diff(&s, &s.after, more, 1, "cannot be opened: No such file or directory");
    snprintf(more, sizeof more, "--store %s", s.file.path); /* no folder at all */
    assert_diff(&s, &s.after, more, 1, "no picture of the reference: ");
    snprintf(more, sizeof more, "2.png --store %s" BY("again", "2026-11-23"), s.store.path);
    accept_into(&s, &s.before, more); /* the frame is unchanged, and its missing picture is stored again */
    assert_true(file_exists(picture.path));
    command_result result = run_octreel(NULL, "diff %s %s --store %s", s.before.path, s.after.path, s.store.path);
    assert_trouble(&result, "--store works with a baseline only");
}

static void accept_replaces_a_damaged_picture_in_the_store(void **state)
{
    const states s = make_states(state);
    char more[4096];
    snprintf(more, sizeof more, "2.png --store %s" BY("the first", "2026-11-22"), s.store.path);
    accept_into(&s, &s.before, more);
    const place picture = only_picture(&s);
    assert_int_equal(truncate(picture.path, 60), 0);
    accept_into(&s, &s.before, more);
    assert_same_files(picture.path, place_below(s.before.path, "2.png").path);
}

/* ---- Tolerances ---------------------------------------------------------------------------------------------- */

static void stored_pictures_allow_a_tolerance(void **state)
{
    const states s = make_states(state);
    const place out = place_in(*state, "out");
    char more[4096];
    snprintf(more, sizeof more, "--store %s" BY("the first", "2026-11-22"), s.store.path);
    accept_into(&s, &s.before, more);
    snprintf(more, sizeof more, "--store %s --max-delta 0.0027 -o %s", s.store.path, out.path);
    assert_diff(&s, &s.after, more, 0, "2 with the same pixels, 1 forgiven\n  2.png: forgiven: 0 pixels count; 5 of");
    assert_false(file_exists(place_below(out.path, "2.expected.png").path));
    static const char *const tolerances[] = {"--max-pixels 5", "--ignore 0,3,5,1"};
    for (size_t i = 0; i < 2; i++) {
        snprintf(more, sizeof more, "--store %s %s", s.store.path, tolerances[i]);
        assert_diff(&s, &s.after, more, 0, "1 forgiven");
    }
    snprintf(more, sizeof more, "--store %s --max-delta 0.0026 -o %s", s.store.path, out.path);
    assert_diff(&s, &s.after, more, 1, "different: 1 of 3 frames");
    assert_true(file_exists(place_below(out.path, "2.difference.png").path));
}

/* A frame passes if it is within the tolerance of any accepted picture. */
static void tolerance_applies_to_every_variant(void **state)
{
    const states s = make_states(state);
    char more[4096];
    snprintf(more, sizeof more, "2.png --store %s" BY("the first", "2026-11-22"), s.store.path);
    accept_into(&s, &s.before, more);
    gallery_write(place_below(s.before.path, "2.png").path, 70, 0);
    snprintf(more, sizeof more, "2.png --variant --store %s" BY("another", "2026-11-23"), s.store.path);
    accept_into(&s, &s.before, more);
    snprintf(more, sizeof more, "--store %s --max-pixels 5", s.store.path);
    assert_diff(&s, &s.after, more, 1, "2 of 3 frames, 1 forgiven"); /* 1.png and 3.png have no reference */
    gallery_write(place_below(s.after.path, "2.png").path, 1, 6);
    assert_diff(&s, &s.after, more, 1, "; matches none of the 2 accepted variants");
}

/* Let the process open `count` more files. Returns the former limit. */
static struct rlimit limit_open_files(int count)
{
    struct rlimit before;
    const int lowest = open("/dev/null", O_RDONLY);
    assert_true(lowest >= 0 && close(lowest) == 0);
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    struct rlimit limit = before;
    limit.rlim_cur = (rlim_t)(lowest + count);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &limit), 0);
    return before;
}

/* With a limit of 0 the stored picture cannot be opened; with 1 the frame cannot be opened at the same time. Without a
 * tolerance the digests decide. */
static void tolerance_that_cannot_be_checked_is_an_error(void **state)
{
    const states s = make_states(state);
    char more[4096];
    snprintf(more, sizeof more, "--store %s" BY("the first", "2026-11-22"), s.store.path);
    accept_into(&s, &s.before, more);
    for (int i = 0; i < 6; i++) {
        const bool exact = i % 2, enough = i / 2 == 2;
        diff_options options = diff_options_default();
        options.store = s.store.path;
        options.tolerance.max_pixels = exact ? 0 : 5;
        comparison_of made = assert_compared(s.file.path, s.after.path, &options);
        const struct rlimit before = limit_open_files(i / 2);
        octreel_error error;
        assert_true(picture_store_fetch(&made.a, &made.b, &made.result, &error));
        assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
        const diff_pair *pair = diff_find(&made.result, "2.png");
        assert_int_equal(made.result.verdict, exact ? DIFF_DIFFERENT : enough ? DIFF_SAME : DIFF_TROUBLE);
        assert_int_equal(pair->lacks_resources, !exact && !enough);
        assert_true(exact || enough || strstr(pair->trouble, "cannot be opened: Too many open files"));
        comparison_release(&made);
    }
}

static void tolerance_needs_stored_pictures(void **state)
{
    const states s = make_states(state);
    char more[4096];
    accept_into(&s, &s.before, BY("the first", "2026-11-22"));
    command_result result = run_octreel(NULL, "diff %s %s --max-delta 0.1", s.file.path, s.after.path);
    assert_trouble(&result, "baseline.txt: a baseline holds digests, which allow no tolerance; add --store DIR, the "
                            "folder in which octreel accept --store DIR saved the pictures, or remove --max-pixels, "
                            "--max-delta, --max-channel, --flip, --antialias, --ignore and --ignore-layer");
    result = run_octreel(NULL, "diff %s %s --max-channel 3", s.file.path, s.after.path);
    assert_trouble(&result, "which allow no tolerance; ");
    snprintf(more, sizeof more, "--store %s --max-delta 0.1", s.store.path);
    assert_diff(&s, &s.after, more, 1, "colours within 0.1 YIQ; not applied to 1 frame without a stored picture\n");
    result = run_octreel(NULL, "diff %s %s %s", s.file.path, s.file.path, more);
    assert_trouble(&result, "which allow no tolerance; compare the pictures themselves");
}

/* ---- Subfolders ---------------------------------------------------------------------------------------------- */

static void frames_in_subfolders_have_digests_and_stored_pictures(void **state)
{
    const states s = {gallery_make(*state, "old", "1.png menu/1.png menu/old/2.png"),
                      gallery_make(*state, "new", "1.png menu/1.png menu/old/2.png"), place_in(*state, "baseline.txt"),
                      place_in(*state, "old/store")}; /* the store is no part of the frames */
    const place out = place_in(*state, "out");
    char more[4096];
    snprintf(more, sizeof more, "--store %s" BY("the first", "2026-11-22"), s.store.path);
    accept_into(&s, &s.before, more);
    accept_into(&s, &s.before, more);
    assert_int_equal(count_lines(s.file.path, "\n"), 6);
    assert_int_equal(count_lines(s.file.path, " menu/old/2\n"), 1);
    assert_diff(&s, &s.after, "", 0, "same: 3 frames");
    gallery_write(place_below(s.after.path, "menu/old/2.png").path, 2, 5);
    snprintf(more, sizeof more, "--store %s -o %s", s.store.path, out.path);
    assert_diff(&s, &s.after, more, 1, "  menu/old/2.png: 5 of 384 pixels differ");
    assert_same_files(place_below(out.path, "menu/old/2.expected.png").path,
                      place_below(s.before.path, "menu/old/2.png").path);
    assert_diff(&s, &s.after, "--no-recursive", 1, "different: 2 of 3 frames");
}

/* ---- Who else writes, and disks that are full ---------------------------------------------------------------- */

static void concurrent_accepts_lose_nothing(void **state)
{
    const states s = make_states(state);
    const place many = gallery_make(*state, "many", "1.png 2.png 3.png 4.png 5.png 6.png 7.png 8.png");
    command_result result = run_script(
        "for i in 1 2 3 4 5 6 7 8; do %s accept %s %s $i.png --store %s" BY("frame '$i'", "2026-11-22") " & done; wait",
        octreel_program(), s.file.path, many.path, s.store.path);
    assert_done(&result);
    command_release(&result);
    assert_diff(&s, &many, "", 0, "same: 8 frames");
    assert_int_equal(count_lines(s.file.path, "accepted "), 8);
    result = run_script("find %s -name '*.part'; find %s -name '*.png' | wc -l", s.store.path, s.store.path);
    assert_int_equal(atoi(result.out), 8);
    command_release(&result);
}

/* The limits stop writing a picture of the store, and then the baseline itself: both stay unchanged. */
static void full_disk_accepts_nothing(void **state)
{
    const states s = make_states(state);
    static const size_t limits[] = {1, 20, 150};
    char more[4096];
    accept_into(&s, &s.before,
                BY("the first, with a reason that is rather long, so that the file is not shorter than "
                   "a picture",
                   "2026-11-22"));
    char *before = file_read(s.file.path, NULL);
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        const command_setting full = {.file_limit = limits[i]};
        snprintf(more, sizeof more, "--store %s --reason x", s.store.path);
        command_result result =
            run_octreel(&full, "accept %s %s %s", s.file.path, s.after.path, i == 1 ? "--reason x" : more);
        assert_trouble(&result, "cannot be written: File too large");
        char *after = file_read(s.file.path, NULL);
        assert_string_equal(after, before);
        free(after);
    }
    free(before);
    command_result result = run_script("find %s -type f", s.store.path);
    assert_string_equal(result.out, "");
    command_release(&result);
    assert_false(file_exists(place_in(*state, "baseline.txt.part").path));
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, without_ci, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(accept_replaces_digests_and_variant_keeps_them),
        WITH_FOLDER(unchanged_frames_keep_their_lines),
        WITH_FOLDER(reason_is_required_for_baselines_and_refused_elsewhere),
        WITH_FOLDER(only_the_listed_frames_are_accepted),
        WITH_FOLDER(evidence_shows_expected_pictures_from_the_store),
        WITH_FOLDER(bad_picture_in_the_store_is_reported_without_changing_the_verdict),
        WITH_FOLDER(accept_replaces_a_damaged_picture_in_the_store),
        WITH_FOLDER(stored_pictures_allow_a_tolerance),
        WITH_FOLDER(tolerance_applies_to_every_variant),
        WITH_FOLDER(tolerance_that_cannot_be_checked_is_an_error),
        WITH_FOLDER(tolerance_needs_stored_pictures),
        WITH_FOLDER(frames_in_subfolders_have_digests_and_stored_pictures),
        WITH_FOLDER(concurrent_accepts_lose_nothing),
        WITH_FOLDER(full_disk_accepts_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
