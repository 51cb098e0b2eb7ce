/* SPDX-License-Identifier: MIT */
/* test_baseline.c - baselines: read in any order, written in one order, compared with pictures, and refused with the
 * number of the line that is wrong. */
#include "baseline_text.h"
#include "fixture.h"
#include "galleries.h"
#include "ignored_layers.h"

#include <stdlib.h>
#include <string.h>

#define HEAD BASELINE_HEAD
#define FIRST "accepted 7f 2026-11-22 24x16 runs the first\n"
#define SECOND "accepted k3 2026-11-23 24x16 runs the second, of \"Mesa\" \xc3\xa9\n"
#define A7 "7f 0123456789abcdef a\n"
#define AK "k3 0000000000000001 a\n"
#define BK "k3 fedcba9876543210 b b\n"

static void assert_written(const char *text, const char *expected)
{
    diff_side side = assert_baseline_parsed(text);
    char *again = write_baseline_text(&side);
    assert_string_equal(again, expected);
    free(again);
    diff_side_release(&side);
}

static void lines_are_read_in_any_order_and_written_in_one(void **state)
{
    (void)state;
    static const char whole[] = HEAD FIRST SECOND A7 AK BK;
    assert_written(whole, whole);
    assert_written(HEAD SECOND BK AK BK FIRST SECOND A7, whole); /* as git's merge by union may leave it */
    assert_written(HEAD "accepted 7f 2026-11-22 24x16 runs the first\r\n7f 0123456789abcdef a\r\n", HEAD FIRST A7);
    assert_written(HEAD FIRST SECOND A7, HEAD FIRST A7); /* a reason of nothing */
    assert_written(HEAD, HEAD);
}

static void frame_has_all_variants_and_is_represented_by_the_newest(void **state)
{
    (void)state;
    diff_side side = assert_baseline_parsed(HEAD SECOND FIRST AK A7 BK);
    assert_int_equal(side.count, 2);
    assert_string_equal(side.frames[0].name, "a.png");
    assert_string_equal(side.frames[1].name, "b b.png");
    assert_int_equal(side.frames[0].variant_count, 2);
    assert_true(side.frames[0].digest.pixels == 1);
    assert_int_equal(side.frames[0].digest.width, 24);
    assert_int_equal(side.frames[0].digest.height, 16);
    assert_int_equal(side.acceptance_count, 2);
    diff_side_release(&side);
}

/* Endings other than ".png" are said, and what one line would leave in doubt. */
static void every_frame_name_survives_the_round_trip(void **state)
{
    (void)state;
    static const char *const names[] = {"a.png",  "a.PNG", "a.png.png",  "a.Png.png",   "a .png", " .png",
                                        "7f.png", "p",     "menu/1.png", "a/b /.c.PNG", "..png",  "-/-.png"};
    static const char *const lines[] = {"a",  "a.PNG", "a.png.png", "a.Png.png",   "a .png", " .png",
                                        "7f", "p",     "menu/1",    "a/b /.c.PNG", ".",      "-/-"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        diff_side side = {.path = "file", .kind = DIFF_BASELINE, .background = {255, 255, 255}};
        octreel_error error;
        frame_digest digest = {7, 24, 16, IMAGE_DIGEST_RUNS, 0};
        char line[64];
        assert_true(baseline_add_acceptance(&side, &(acceptance_note){"2026-11-22", "why"}, &digest, &error));
        assert_true(baseline_add_frame(&side, names[i], &digest, 1, &error));
        char *text = write_baseline_text(&side);
        snprintf(line, sizeof line, "\n%s 0000000000000007 %s\n", side.acceptances[0].id, lines[i]);
        assert_non_null(strstr(text, line));
        diff_side again = assert_baseline_parsed(text);
        char *twice = write_baseline_text(&again);
        assert_string_equal(twice, text);
        if (strcmp(names[i], "p") != 0) /* one picture alone may have it, and is compared whatever its name is */
            assert_string_equal(again.frames[0].name, names[i]);
        free(twice);
        free(text);
        diff_side_release(&again);
        diff_side_release(&side);
    }
}

static void malformed_line_is_refused_with_its_number(void **state)
{
    (void)state;
    static const struct {
        const char *text, *part;
    } cases[] = {
        {HEAD FIRST "<<<<<<< HEAD\n" A7 "=======\n" AK ">>>>>>> theirs\n", "file:4: unresolved merge conflict"},
        {HEAD FIRST A7 "=======\n", "file:5: unresolved merge conflict"},
        {HEAD "||||||| 0123456\n", "file:3: unresolved merge conflict"},
        {"<<<<<<< HEAD\n", "file:1: unresolved merge conflict"},
        {HEAD "accepted 7f 2026-11-22 24x16 lanes9 why\n" A7, "file:3: unknown kind of digest \"lanes9\""},
        {HEAD A7, "file:3: no line before this one defines the id 7f"},
        {HEAD FIRST "accepted 7f 2026-11-23 24x16 runs another\n", "file:4: the id 7f is already used"},
        {HEAD "accepted 7f 2026-02-30 24x16 runs why\n", "file:3: expected"},
        {HEAD FIRST "accepted 7f 2026-11-22 25x16 runs the first\n", "file:4: the id 7f is already used"},
        {HEAD FIRST "accepted 7f 2026-11-22 24x17 runs the first\n", "file:4: the id 7f is already used"},
        {HEAD "accepted 7f 2026-13-01 24x16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7f-2026-11-22 24x16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22x24x16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 24x16 runs  why\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 24x16 runs why \n", "file:3: expected"},
        {HEAD "accepted 7f 2026-1-1 24x16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 24x16 runs\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 24x16 runs \n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 0x16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7 2026-11-22 24x16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7F 2026-11-22 24x16 runs why\n", "file:3: expected"},
        {HEAD "accepted F7 2026-11-22 24x16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 24x16 0123456789012345678901234567890123456789x why\n",
         "file:3: unknown kind of digest \"0123456789012345678901234567890123456789\""},
        {HEAD "accepted\n", "file:3: expected"},
        {HEAD "accepted \n", "file:3: expected"},
        {HEAD "\n", "file:3: expected"},
        {HEAD FIRST "7f 0123456789abcde a\n", "file:4: expected"},
        {HEAD FIRST "7f 0123456789ABCDEF a\n", "file:4: expected"},
        {HEAD FIRST "7f 0123456789abcdef \n", "file:4: expected"},
        {HEAD FIRST "7f 0123456789abcdef\n", "file:4: expected"},
        {HEAD FIRST "7f 0123456789abcdef ../a\n", "file:4: expected a path relative to the compared folder, such as"},
        {HEAD FIRST "7f 0123456789abcdef a/../../b\n", "file:4: expected a path"},
        {HEAD FIRST "7f 0123456789abcdef a/./b\n", "file:4: expected a path"},
        {HEAD FIRST "7f 0123456789abcdef ./a\n", "file:4: expected a path"},
        {HEAD FIRST "7f 0123456789abcdef /a\n", "file:4: expected a path"},
        {HEAD FIRST "7f 0123456789abcdef a//b\n", "file:4: expected a path"},
        {HEAD FIRST "7f 0123456789abcdef a/b\x01\n", "file:4: expected an acceptance"},
        {HEAD FIRST "7f 0123456789abcdef a\tb\n", "file:4: expected"},
        {HEAD FIRST "7f\n", "file:4: expected"},
        {HEAD FIRST "7\n", "file:4: expected"},
        {"octreel-digests 3\nbackground ffffff\n", "file:1: expected \"octreel-digests 2\""},
        {"octreel-digests 1\nbackground ffffff\n", "file:1: expected \"octreel-digests 2\"; version 1"},
        {"octreel-digests 2 \nbackground ffffff\n", "file:1: "},
        {"digests\nbackground ffffff\n", "file:1: "},
        {"octreel-digests 2\n", "second line"},
        {"octreel-digests 2", "second line"},
        {"octreel-digests 2\nbackground fffff\n", "file:2: "},
        {"octreel-digests 2\nbackground fffffff\n", "file:2: "},
        {"octreel-digests 2\nbackground FFFFFF\n", "file:2: "},
        {"octreel-digests 2\n" FIRST, "file:2: "},
        {HEAD "accepted 7f 2026-11-22 16385x16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 99999999999999999999x16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 24x runs why\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 ax16 runs why\n", "file:3: expected"},
        {HEAD "accepted 7f 2026-11-22 -1x16 runs why\n", "file:3: expected"},
        {HEAD FIRST "7f 0123456789abcdeg a\n", "file:4: expected"},
        {HEAD FIRST "7f 0123456789abcdef a\x7f\n", "file:4: expected"},
        {HEAD "<<<<<<<HEAD\n", "file:3: expected"},
        {HEAD "<<<<==== a\n", "file:3: expected"},
        {HEAD FIRST "7f 0123456789abcdef a\n7f 0123456789abcdef menu/st",
         "file:5: the line does not end with a newline, so the file may be cut off; restore it, or end the line"},
        {HEAD FIRST "7f 0123456789abcdef a\n7f 01234567", "file:5: the line does not end with a newline"},
        {HEAD "accepted 7f 2026-11-22 24x16 runs wh", "file:3: the line does not end with a newline"},
        {HEAD FIRST "7f 0123456789abcdef a\n>>>>>>> theirs", "file:5: unresolved merge conflict"},
        {"octreel-digests 2\nbackground ffffff", "file:2: the line does not end with a newline"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        diff_side side;
        octreel_error error = {""};
        if (parse_baseline(cases[i].text, &side, &error) || !strstr(error.text, cases[i].part))
            fail_msg("case %zu: \"%s\" does not contain \"%s\"", i, error.text, cases[i].part);
        diff_side_release(&side);
    }
}

static void zero_byte_is_refused(void **state)
{
    (void)state;
    char text[] = HEAD "\0" FIRST;
    diff_side side = {.path = "file"};
    octreel_error error = {""};
    assert_false(baseline_parse(&side, text, sizeof text - 1, &error));
    assert_non_null(strstr(error.text, "zero byte"));
    diff_side_release(&side);
}

static void only_dates_of_the_calendar_are_accepted(void **state)
{
    (void)state;
    static const char *const right[] = {"2026-11-22", "2024-02-29", "2000-02-29", "2026-02-28", "2026-12-31"};
    static const char *const wrong[] = {"2026-02-29", "2100-02-29", "2024-02-30", "2026-00-01",  "2026-13-01",
                                        "2026-01-00", "2026-04-31", "2026-1-01",  "2026-11-222", "2026/11/22",
                                        "2026-11-2x", "2026-11-2:", "",           "2026-11-2"};
    for (size_t i = 0; i < sizeof right / sizeof right[0]; i++)
        if (!baseline_is_date(right[i]))
            fail_msg("%s is a date", right[i]);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        if (baseline_is_date(wrong[i]))
            fail_msg("%s is no date", wrong[i]);
    for (int month = 1; month <= 12; month++) {
        const bool is_short = month == 4 || month == 6 || month == 9 || month == 11;
        for (int day = 1; day < 40; day++) {
            char text[24];
            snprintf(text, sizeof text, "2025-%02d-%02d", month, day);
            assert_int_equal(baseline_is_date(text), day <= (month == 2 ? 28 : is_short ? 30 : 31));
        }
    }
}

/* As two branches leave them that were merged; the smaller first. */
static void two_digests_with_one_reason_are_both_written(void **state)
{
    (void)state;
#define BEFORE_A7 "7f 0000000000000007 a\n"
    assert_written(HEAD FIRST A7 BEFORE_A7, HEAD FIRST BEFORE_A7 A7);
    assert_written(HEAD FIRST BEFORE_A7 A7 BEFORE_A7, HEAD FIRST BEFORE_A7 A7);
}

/* What two branches accept for the same reason has one name in both; other reasons have others. */
static void acceptance_name_is_derived_from_its_text(void **state)
{
    (void)state;
    static const char *const reasons[] = {"one", "two", "one"};
    diff_side side = {.path = "file", .kind = DIFF_BASELINE};
    frame_digest digests[3];
    octreel_error error;
    for (size_t i = 0; i < 3; i++) {
        digests[i] = (frame_digest){i, 24, 16, IMAGE_DIGEST_RUNS, 0};
        assert_true(baseline_add_acceptance(&side, &(acceptance_note){"2026-11-22", reasons[i]}, &digests[i], &error));
    }
    assert_int_equal(side.acceptance_count, 2);
    assert_int_equal(digests[0].acceptance, digests[2].acceptance);
    assert_string_not_equal(side.acceptances[0].id, side.acceptances[1].id);
    frame_digest other = {9, 48, 32, IMAGE_DIGEST_RUNS, 0};
    assert_true(baseline_add_acceptance(&side, &(acceptance_note){"2026-11-22", "one"}, &other, &error));
    assert_int_equal(other.acceptance, 2);
    diff_side_release(&side);
}

static void thousand_acceptances_have_names_and_too_many_are_refused(void **state)
{
    (void)state;
    diff_side side = {.path = "file", .kind = DIFF_BASELINE};
    octreel_error error;
    char reason[16];
    for (int i = 0; i <= 36 * 36; i++) {
        frame_digest digest = {1, 24, 16, IMAGE_DIGEST_RUNS, 0};
        snprintf(reason, sizeof reason, "%d", i);
        assert_int_equal(baseline_add_acceptance(&side, &(acceptance_note){"2026-11-22", reason}, &digest, &error),
                         i < 36 * 36);
    }
    assert_non_null(strstr(error.text, "ids of acceptances are in use"));
    diff_side_release(&side);
}

/* 1,000 frames with 3 variants: under 100 KB. */
static void large_baseline_takes_few_bytes(void **state)
{
    (void)state;
    static const char *const reasons[] = {"as recorded first, with Mesa 25", "Mesa 26", "without SIMD"};
    diff_side side = {.path = "file", .kind = DIFF_BASELINE};
    octreel_error error;
    for (int i = 0; i < 1000; i++) {
        frame_digest variants[3];
        char name[32];
        snprintf(name, sizeof name, "frame_%06d.png", i);
        for (int v = 0; v < 3; v++) {
            variants[v] = (frame_digest){UINT64_C(0x9e3779b97f4a7c15) * (uint64_t)(3 * i + v + 1), 1280, 720,
                                         IMAGE_DIGEST_NEWEST, 0};
            assert_true(
                baseline_add_acceptance(&side, &(acceptance_note){"2026-11-22", reasons[v]}, &variants[v], &error));
        }
        assert_true(baseline_add_frame(&side, name, variants, 3, &error));
    }
    char *text = write_baseline_text(&side);
    assert_true(strlen(text) < 100000);
    diff_side again = assert_baseline_parsed(text);
    assert_int_equal(again.count, 1000);
    assert_int_equal(again.frames[999].variant_count, 3);
    diff_side_release(&again);
    diff_side_release(&side);
    free(text);
}

/* Write a baseline that accepts each frame of a folder by one kind of digest, which follows from its place; `shift`
 * makes that of the next one. */
static void write_by_kinds(const char *folder, const char *path, int shift)
{
    diff_side frames = assert_side(folder), side = {.path = path, .kind = DIFF_BASELINE};
    octreel_error error;
    side.background = (image_color){255, 255, 255};
    for (size_t i = 0; i < frames.count; i++) {
        frame_digest digest = {.kind = (image_digest_kind)((i + (size_t)shift) % IMAGE_DIGEST_KINDS)};
        assert_true(digest_picture(frames.frames[i].path, side.background, &digest, &error));
        assert_true(baseline_add_acceptance(&side, &(acceptance_note){"2026-11-22", "why"}, &digest, &error));
        assert_true(baseline_add_frame(&side, frames.frames[i].name, &digest, 1, &error));
    }
    char *text = write_baseline_text(&side);
    file_write_text(path, text);
    free(text);
    diff_side_release(&side);
    diff_side_release(&frames);
}

/* What was accepted by an old kind of digest stays accepted by it. Files without a kind in common tell nothing. */
static void each_digest_is_compared_by_its_own_kind(void **state)
{
    const place folder = gallery_make(*state, "a", "1.png 2.png 3.png"), file = place_in(*state, "a.txt"),
                other = place_in(*state, "b.txt");
    write_by_kinds(folder.path, file.path, 0);
    write_by_kinds(folder.path, other.path, 1);
    for (int turned = 0; turned < 2; turned++) {
        comparison_of made = assert_compared(turned ? folder.path : file.path, turned ? file.path : folder.path, NULL);
        assert_int_equal(made.result.found[FOUND_SAME_PIXELS], 3);
        comparison_release(&made);
    }
    comparison_of made = assert_compared(file.path, other.path, NULL);
    assert_int_equal(made.result.found[FOUND_UNREADABLE], IMAGE_DIGEST_KINDS > 1 ? 3 : 0);
    comparison_release(&made);
    gallery_write(place_below(folder.path, "1.png").path, 0, 3);
    gallery_write(place_below(folder.path, "2.png").path, 1, 3);
    made = assert_compared(file.path, folder.path, NULL);
    assert_int_equal(made.result.found[FOUND_DIGEST], 2);
    comparison_release(&made);
}

/* The same picture is among the variants of both sides, wherever it stands there. */
static void two_baselines_agree_if_any_variants_are_equal(void **state)
{
    static const char *const variants[] = {"k3 0000000000000001 a\n", "k3 0000000000000002 a\n",
                                           "k3 0000000000000003 a\n"};
    const place one = place_in(*state, "a.txt"), other = place_in(*state, "b.txt");
    for (int same = 0; same < 3; same++)
        for (int pair = 0; pair < 9; pair++) {
            char texts[2][400];
            for (int side = 0; side < 2; side++) {
                const int place = side ? pair % 3 : pair / 3;
                char lines[3][32];
                for (int i = 0; i < 3; i++)
                    snprintf(lines[i], sizeof lines[i], "k3 00000000000%02d%d%d%d a\n", 10 * side + i, side, i, i);
                strcpy(lines[place], variants[same]);
                snprintf(texts[side], sizeof texts[side], HEAD SECOND "%s%s%s", lines[0], lines[1], lines[2]);
            }
            file_write_text(one.path, texts[0]);
            file_write_text(other.path, texts[1]);
            comparison_of made = assert_compared(one.path, other.path, NULL);
            assert_int_equal(made.result.found[FOUND_SAME_PIXELS], 1);
            comparison_release(&made);
        }
    file_write_text(other.path, HEAD SECOND "k3 1111111111111111 a\nk3 2222222222222222 a\n");
    comparison_of made = assert_compared(one.path, other.path, NULL);
    assert_int_equal(made.result.found[FOUND_DIGEST], 1);
    comparison_release(&made);
}

static void baseline_may_be_either_side(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png 3.png"), b = gallery_make(*state, "b", "1.png 2.png 4.png"),
                file = place_in(*state, "a.txt");
    write_by_kinds(a.path, file.path, 0);
    gallery_write(place_below(b.path, "2.png").path, 1, 1);
    comparison_of made = assert_compared(file.path, b.path, NULL);
    assert_int_equal(find_finding(&made, "1.png"), FOUND_SAME_PIXELS);
    assert_int_equal(find_finding(&made, "2.png"), FOUND_DIGEST);
    assert_int_equal(find_finding(&made, "3.png"), FOUND_NO_FRAME);
    assert_int_equal(find_finding(&made, "4.png"), FOUND_NO_REFERENCE);
    comparison_release(&made);
    made = assert_compared(b.path, file.path, NULL);
    assert_int_equal(find_finding(&made, "2.png"), FOUND_DIGEST);
    assert_int_equal(find_finding(&made, "3.png"), FOUND_NO_REFERENCE);
    comparison_release(&made);
    made = assert_compared(file.path, file.path, NULL);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
}

static void unreadable_picture_is_an_error_with_a_baseline_too(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), file = place_in(*state, "a.txt");
    write_by_kinds(a.path, file.path, 0);
    file_write_text(place_below(a.path, "1.png").path, "");
    comparison_of made = assert_compared(file.path, a.path, NULL);
    assert_int_equal(made.result.verdict, DIFF_TROUBLE);
    comparison_release(&made);
}

static void baseline_allows_no_tolerance(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), file = place_in(*state, "a.txt");
    static const image_rectangle corner = {0, 0, 1, 1};
    const diff_options asked[] = {
        {.tolerance = {.max_pixels = 1}, .background = {255, 255, 255}},
        {.tolerance = {.max_delta = 0.1}, .background = {255, 255, 255}},
        {.tolerance = {.antialias = true}, .background = {255, 255, 255}},
        {.tolerance = {.ignored = &corner, .ignored_count = 1}, .background = {255, 255, 255}},
        {.mask = ignore_layers, .ignored_layers = 1u, .background = {255, 255, 255}},
    };
    write_by_kinds(a.path, file.path, 0);
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++)
        assert_not_compared(file.path, a.path, &asked[i], "a baseline holds digests, which allow no tolerance");
    const diff_options black = {.background = {0, 0, 0}};
    assert_not_compared(a.path, file.path, &black, "--background ffffff");
}

static void name_that_cannot_be_written_is_refused(void **state)
{
    (void)state;
    diff_side side = {.path = "file", .kind = DIFF_BASELINE};
    octreel_error error = {""};
    frame_digest digest = {1, 24, 16, IMAGE_DIGEST_RUNS, 0};
    assert_true(baseline_add_acceptance(&side, &(acceptance_note){"2026-11-22", "why"}, &digest, &error));
    assert_true(baseline_add_frame(&side, "a\nb.png", &digest, 1, &error));
    assert_false(baseline_write(stderr, &side, &error));
    assert_non_null(strstr(error.text, "contains a control character"));
    diff_side_release(&side);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_are_read_in_any_order_and_written_in_one),
        cmocka_unit_test(frame_has_all_variants_and_is_represented_by_the_newest),
        cmocka_unit_test(every_frame_name_survives_the_round_trip),
        cmocka_unit_test(malformed_line_is_refused_with_its_number),
        cmocka_unit_test(zero_byte_is_refused),
        cmocka_unit_test(only_dates_of_the_calendar_are_accepted),
        cmocka_unit_test(two_digests_with_one_reason_are_both_written),
        cmocka_unit_test(acceptance_name_is_derived_from_its_text),
        cmocka_unit_test(thousand_acceptances_have_names_and_too_many_are_refused),
        cmocka_unit_test(large_baseline_takes_few_bytes),
        cmocka_unit_test_setup_teardown(baseline_may_be_either_side, temp_folder_make, nested_folder_remove),
        cmocka_unit_test_setup_teardown(unreadable_picture_is_an_error_with_a_baseline_too, temp_folder_make,
                                        nested_folder_remove),
        cmocka_unit_test_setup_teardown(baseline_allows_no_tolerance, temp_folder_make, nested_folder_remove),
        cmocka_unit_test_setup_teardown(each_digest_is_compared_by_its_own_kind, temp_folder_make,
                                        nested_folder_remove),
        cmocka_unit_test_setup_teardown(two_baselines_agree_if_any_variants_are_equal, temp_folder_make,
                                        nested_folder_remove),
        cmocka_unit_test(name_that_cannot_be_written_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
