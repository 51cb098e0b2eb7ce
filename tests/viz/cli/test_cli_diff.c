/* SPDX-License-Identifier: MIT */
/* test_cli_diff.c - octreel diff: exit statuses, text, JSON, and refused arguments. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "fixture.h"
#include "galleries.h"
#include "tick_lines.h"

static void assert_ends(command_result *result, int status, const char *part)
{
    assert_string_equal(result->err, "");
    assert_int_equal(result->status, status);
    if (!strstr(result->out, part))
        fail_msg("\"%s\" does not contain \"%s\"", result->out, part);
    command_release(result);
}

/* A picture, and a copy in which the green of five pixels is one level off. */
typedef struct twins {
    place a, b;
} twins;

static twins make_pair(void **state)
{
    const twins made = {place_in(*state, "a.png"), place_in(*state, "b.png")};
    gallery_write(made.a.path, 3, 0);
    gallery_write(made.b.path, 3, 5);
    return made;
}

static void status_and_text_agree_on_the_verdict(void **state)
{
    const twins p = make_pair(state);
    command_result result = run_octreel(NULL, "diff %s %s", p.a.path, p.a.path);
    assert_ends(&result, 0, "same: 1 frame, 1 with the same bytes\ncompared exactly\n");
    result = run_octreel(NULL, "diff %s %s", p.a.path, p.b.path);
    assert_ends(&result, 1,
                "different: 1 of 1 frame\n  b.png: 5 of 384 pixels differ; worst 0.0027 YIQ at (0,3), channels by up "
                "to 1 of 255; within (0,3)-(4,3)\ncompared exactly\n");
}

/* Every verdict names the tolerances, and the largest difference that they accepted. */
static void every_verdict_names_the_tolerances(void **state)
{
    const twins p = make_pair(state);
    static const struct {
        const char *options, *words;
        int status;
    } cases[] = {
        {"--max-pixels 5", "forgiven: up to 5 pixels a frame\n", 0},
        {"--max-pixels 4", "forgiven: up to 4 pixels a frame\n", 1},
        {"--max-delta 0.0027", "forgiven: colours within 0.0027 YIQ\n", 0},
        {"--max-delta 0.0026", "forgiven: colours within 0.0026 YIQ\n", 1},
        {"--ignore 0,0,3,16 --ignore 3,3,9,1", "the 3x16 pixels at (0,0), the 9x1 pixels at (3,3)\n", 0},
        {"--ignore 0,0,3,16", "2 of 384 pixels differ, 3 more in ignored areas; worst 0.0027 YIQ at (3,3)", 1},
        {"--ignore 0,0,4,16", "1 of 384 pixels differs, 4 more in ignored areas; worst 0.0027 YIQ at (4,3)", 1},
        {"--ignore 24,0,9,9 --ignore 0,15,9,9",
         "forgiven: the 9x9 pixels at (24,0), outside every frame that was compared, the 9x9 pixels at (0,15)\n", 1},
        {"--ignore 0,16,1,1", "forgiven: the 1x1 pixels at (0,16), outside every frame that was compared\n", 1},
        {"--antialias --max-pixels 5 --max-delta 0.001", "up to 5 pixels a frame, colours within 0.001 YIQ, anti-al",
         0},
        {"--max-delta 1", "b.png: forgiven: 0 pixels count; 5 of 384 pixels differ, 5 of them close; worst 0.0027", 0},
        {"--max-delta 0", "compared exactly\n", 1},
        {"--max-channel 1", "forgiven: channels within 1\n", 0},
        {"--max-channel 1", "b.png: forgiven: 0 pixels count; 5 of 384 pixels differ, 5 of them close", 0},
        {"--max-channel 0", "compared exactly\n", 1},
        {"--max-pixels 1.3%", "forgiven: up to 1.3% of the pixels\n", 1},
        {"--max-pixels 1.31%", "forgiven: up to 1.31% of the pixels\n", 0},
        {"--max-pixels 2 --max-pixels 2%", "forgiven: up to 2 pixels a frame, up to 2% of the pixels\n", 0},
        {"--flip 0.1", "forgiven: a mean FLIP up to 0.1 at 67.02 pixels per degree\n", 0},
        {"--flip 0.1",
         "b.png: forgiven: 5 of 384 pixels differ; worst 0.0027 YIQ at (0,3), channels by up to 1 of "
         "255; within (0,3)-(4,3); mean FLIP 0.00",
         0},
        {"--flip 0",
         "b.png: 5 of 384 pixels differ; worst 0.0027 YIQ at (0,3), channels by up to 1 of 255; within "
         "(0,3)-(4,3); mean FLIP 0.00",
         1},
        {"--flip 0 --pixels-per-degree 20", "forgiven: a mean FLIP up to 0 at 20 pixels per degree\n", 1},
        {"--flip 0 --max-pixels 5", "forgiven: up to 5 pixels a frame, a mean FLIP up to 0 at 67.02 pixels per deg", 0},
        {"--flip 0 --ignore 0,3,5,1", "pixels differ, 5 more in ignored areas", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        command_result result = run_octreel(NULL, "diff %s %s %s", p.a.path, p.b.path, cases[i].options);
        assert_ends(&result, cases[i].status, cases[i].words);
    }
}

static void errors_are_printed_with_status_2(void **state)
{
    const twins p = make_pair(state);
    const place folder = gallery_make(*state, "folder", "1.png"), text = place_in(*state, "text");
    file_write_text(text.path, "no picture");
    static const char *const bad[][2] = {
        {"--max-pixels -1", "--max-pixels takes a whole number"},
        {"--max-pixels 100.1%", "--max-pixels takes a whole number from 0 to 4294967295, or a percentage such as 0.5%"},
        {"--max-pixels %", "--max-pixels takes a whole number"},
        {"--max-pixels -1%", "--max-pixels takes a whole number"},
        {"--max-channel 65536", "--max-channel takes a whole number from 0 to 65535"},
        {"--max-channel 1.5", "--max-channel takes a whole number from 0 to 65535"},
        {"--max-delta 1.5", "--max-delta takes a number from 0 to 1"},
        {"--max-delta x", "--max-delta takes a number from 0 to 1"},
        {"--max-delta nan", "--max-delta takes a number from 0 to 1"},
        {"--flip 1.01", "--flip takes a number from 0 to 1"},
        {"--flip x", "--flip takes a number from 0 to 1"},
        {"--flip 0.1 --pixels-per-degree 0.9", "--pixels-per-degree takes a number from 1 to 200, not \"0.9\""},
        {"--flip 0.1 --pixels-per-degree 201", "--pixels-per-degree takes a number from 1 to 200"},
        {"--pixels-per-degree 30", "--pixels-per-degree has no effect without --flip: add --flip X"},
        {"--ignore 1,2,3", "--ignore takes left, top, width and height"},
        {"--ignore 1,2,0,4", "--ignore takes left, top, width and height"},
        {"--ignore 1,2,3,4,5", "--ignore takes left, top, width and height"},
        {"--ignore 0,0,99999999999,1", "each at most 2147483647"},
        {"--ignore 0,0,0,0", "width and height at least 1"},
        {"--ignore-layer nix", "--ignore-layer: unknown layer \"nix\""},
        {"--ignore-layer nodes,points", "--ignore-layer needs a recording"},
        {"--ignore-layer text --ignore-layer nodes", "--ignore-layer can be given once"},
        {"--background red", "--background takes a colour"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        command_result result = run_octreel(NULL, "diff %s %s %s", p.a.path, p.b.path, bad[i][0]);
        assert_trouble(&result, bad[i][1]);
    }
    command_result result = run_octreel(NULL, "diff %s", p.a.path);
    assert_trouble(&result, "diff needs two sides");
    result = run_octreel(NULL, "diff %s %s", p.a.path, folder.path);
    assert_trouble(&result, "cannot compare one picture with a folder");
    result = run_octreel(NULL, "diff %s %s", p.a.path, text.path);
    assert_trouble(&result, "not a PNG file, a folder, or a baseline");
    assert_int_equal(truncate(p.b.path, 120), 0);
    result = run_octreel(NULL, "diff %s %s", p.a.path, p.b.path);
    assert_trouble(&result, "b.png: the file is truncated");
}

static void other_frames_are_compared_beside_an_unreadable_one(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png 3.png"), b = gallery_make(*state, "b", "1.png 2.png 3.png");
    assert_int_equal(truncate(place_below(b.path, "2.png").path, 120), 0);
    gallery_write(place_below(b.path, "3.png").path, 2, 1);
    command_result result = run_octreel(NULL, "diff %s %s", a.path, b.path);
    assert_int_equal(result.status, 2);
    assert_non_null(strstr(result.err, "octreel: "));
    assert_non_null(strstr(result.err, "2.png: the file is truncated\n"));
    assert_non_null(strstr(result.out, "trouble: 1 of 3 frames, 1 cannot be read, 1 with the same bytes\n"));
    assert_non_null(strstr(result.out, "  3.png: 1 of 384 pixels differ"));
    command_release(&result);
}

/* Standard error names the first unreadable frame. */
static void unreadable_frames_are_listed(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png"), b = gallery_make(*state, "b", "1.png 2.png");
    assert_int_equal(truncate(place_below(b.path, "1.png").path, 120), 0);
    assert_int_equal(truncate(place_below(b.path, "2.png").path, 120), 0);
    command_result result = run_octreel(NULL, "diff %s %s", a.path, b.path);
    assert_int_equal(result.status, 2);
    assert_non_null(strstr(result.err, "1.png: the file is truncated (and 1 more that cannot be read)\n"));
    assert_non_null(strstr(result.out, "trouble: 2 frames, 2 cannot be read\n  1.png: cannot be read: "));
    assert_non_null(strstr(result.out, "\n  2.png: cannot be read: "));
    command_release(&result);
}

/* One identical frame at the top must not hide those below it. */
static void frames_in_subfolders_decide_the_verdict(void **state)
{
    static const char names[] = "0.png a/b/0.png a/b/1.png a/b/2.png a/b/3.png";
    const place a = gallery_make(*state, "a", names), b = gallery_make(*state, "b", names);
    for (uint64_t i = 1; i <= 3; i++) {
        char name[16];
        snprintf(name, sizeof name, "a/b/%d.png", (int)i);
        gallery_write(place_below(b.path, name).path, i + 1, 5);
    }
    command_result result =
        run_octreel(NULL, "diff %s %s --each --junit %s", a.path, b.path, place_in(*state, "out.xml").path);
    assert_ends(&result, 1, "different: 3 of 5 frames, 2 with the same bytes\n  a/b/1.png: 5 of 384 pixels differ");
    char *xml = file_read(place_in(*state, "out.xml").path, NULL);
    assert_contains(xml, "name=\"a/b/3.png\"");
    free(xml);
    result = run_octreel(NULL, "diff --no-recursive %s %s", a.path, b.path);
    assert_ends(&result, 0, "same: 1 frame, 1 with the same bytes\n");
    result = run_octreel(NULL, "diff %s %s --json", a.path, b.path);
    assert_int_equal(result.status, 1);
    assert_contains(result.out, "\"frames\": [\"a/b/1.png\", \"a/b/2.png\", \"a/b/3.png\"]");
    command_release(&result);
}

static double number(const json_t *object, const char *name)
{
    return json_number_value(json_member(object, name));
}

static void assert_tally(const json_t *tally, double pixels)
{
    assert_members(tally, "pixels worst_delta worst_at largest_channel min max");
    assert_true(number(tally, "pixels") == pixels);
    assert_true(fabs(number(tally, "worst_delta") - 0.0026635) < 1e-6);
    assert_true(number(tally, "largest_channel") == 1);
}

static void json_contains_the_whole_result(void **state)
{
    const twins p = make_pair(state);
    command_result result = run_octreel(NULL, "diff %s %s --json --ignore 0,0,1,4 --max-pixels 1", p.a.path, p.b.path);
    assert_int_equal(result.status, 1);
    json_t *object = json_read(result.out);
    assert_members(object,
                   "octreel version verdict reference compared tolerance background color_spaces_ignored frames "
                   "found findings groups");
    assert_string_equal(json_string_value(json_member(object, "verdict")), "different");
    assert_string_equal(json_string_value(json_member(json_member(object, "reference"), "kind")), "picture");
    const json_t *tolerance = json_member(object, "tolerance");
    assert_members(tolerance, "max_pixels max_delta delta_unit antialias ignore ignore_layers");
    assert_true(number(tolerance, "max_pixels") == 1);
    assert_string_equal(json_string_value(json_member(tolerance, "delta_unit")), "YIQ");
    assert_int_equal(json_array_size(json_array_get(json_member(tolerance, "ignore"), 0)), 4);
    const json_t *finding = json_array_get(json_member(object, "findings"), 0);
    assert_members(finding, "frame finding reference_size frame_size channel_range unlike counted close antialiased "
                            "ignored");
    assert_string_equal(json_string_value(json_member(finding, "finding")), "pixels");
    assert_tally(json_member(finding, "unlike"), 4);
    assert_tally(json_member(finding, "counted"), 4);
    assert_true(number(finding, "ignored") == 1);
    json_decref(object);
    command_release(&result);
}

static void json_is_printed_for_errors_too(void **state)
{
    const twins p = make_pair(state);
    assert_int_equal(truncate(p.a.path, 77), 0);
    command_result result = run_octreel(NULL, "diff %s %s --json", p.a.path, p.b.path);
    assert_int_equal(result.status, 2);
    json_t *object = json_read(result.out);
    assert_string_equal(json_string_value(json_member(object, "verdict")), "trouble");
    const json_t *finding = json_array_get(json_member(object, "findings"), 0);
    assert_non_null(strstr(json_string_value(json_member(finding, "trouble")), "truncated"));
    json_decref(object);
    command_release(&result);
}

static void text_lists_are_cut_but_json_lists_are_whole(void **state)
{
    const place a = gallery_make(*state, "a", ""), b = gallery_make(*state, "b", "");
    for (int i = 0; i < 60; i++) {
        char name[16];
        snprintf(name, sizeof name, "%02d.png", i);
        gallery_write(place_below(a.path, name).path, 1, 0);
        gallery_write(place_below(b.path, name).path, 1, 1);
    }
    command_result result = run_octreel(NULL, "diff %s %s --each", a.path, b.path);
    assert_null(strstr(result.out, "\n  10.png"));
    assert_ends(&result, 1, "\n  09.png: 1 of 384 pixels differs");
    result = run_octreel(NULL, "diff %s %s --each -o %s", a.path, b.path, place_in(*state, "evidence").path);
    assert_null(strstr(result.out, "\n  10.png"));
    assert_ends(&result, 1, "\n  ... and 50 more; --causes all lists all, and so does --json\n");
    result = run_octreel(NULL, "diff %s %s --each --causes 12", a.path, b.path);
    assert_ends(&result, 1, "\n  ... and 48 more; --causes all lists all, and so does --json\n");
    result = run_octreel(NULL, "diff %s %s --each --causes all", a.path, b.path);
    assert_null(strstr(result.out, " more"));
    assert_ends(&result, 1, "\n  59.png: ");
    result = run_octreel(NULL, "diff %s %s --json", a.path, b.path);
    json_t *object = json_read(result.out);
    assert_int_equal(json_array_size(json_member(object, "findings")), 60);
    json_decref(object);
    command_release(&result);
}

/* The page of a comparison leads to the pages of the recordings. */
static void page_links_to_the_compared_recordings(void **state)
{
    const char *const keys[] = {"wwd", "wdd"};
    const place sides[] = {place_in(*state, "a"), place_in(*state, "b")}, evidence = place_in(*state, "evidence");
    for (int i = 0; i < 2; i++) {
        command_result recorded = run_octreel(NULL, "record --keys %s --size 64x48 -o %s", keys[i], sides[i].path);
        assert_done(&recorded);
        command_release(&recorded);
    }
    command_result result = run_octreel(NULL, "diff %s %s -o %s", sides[0].path, sides[1].path, evidence.path);
    assert_int_equal(result.status, 1);
    command_release(&result);
    char *page = file_read(place_below(evidence.path, "report.html").path, NULL);
    assert_non_null(strstr(page, "\"recordings\": {\"expected\": \"./../a/\", \"actual\": \"./../b/\"}"));
    assert_non_null(strstr(page, "\"tick\": 2"));
    free(page);
}

static void removed_command_digest_names_its_replacement(void **state)
{
    (void)state;
    command_result result = run_octreel(NULL, "digest frames -o frames.digests");
    assert_trouble(&result, "octreel digest was removed; use octreel accept BASELINE FRAMES");
}

static void baseline_of_one_picture_is_compared_with_a_picture(void **state)
{
    const twins p = make_pair(state);
    const place one = place_in(*state, "one.txt"), two = place_in(*state, "two.txt");
    const place folder = gallery_make(*state, "folder", "a.png c.png");
    unsetenv("CI");
    command_result result = run_octreel(NULL, "accept %s %s --reason x", one.path, p.a.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s", one.path, p.a.path);
    assert_ends(&result, 0, "same: 1 frame, 1 with the same pixels\n");
    result = run_octreel(NULL, "diff %s %s", one.path, p.b.path);
    assert_ends(&result, 1, "different: 1 of 1 frame\n  b.png: pixels differ: digest ");
    result = run_octreel(NULL, "diff %s %s", p.a.path, one.path);
    assert_ends(&result, 0, "same: 1 frame, 1 with the same pixels\n");
    result = run_octreel(NULL, "accept %s %s --reason x", two.path, folder.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s", two.path, p.a.path);
    assert_trouble(&result, "cannot compare one picture with a baseline");
}

static void help_describes_the_command(void **state)
{
    (void)state;
    static const char *const commands[][2] = {{"diff", "Exit status:\n  0  the same"}, {"accept", "CI"}};
    for (size_t i = 0; i < 2; i++) {
        command_result result = run_octreel(NULL, "%s --help", commands[i][0]);
        assert_ends(&result, 0, commands[i][1]);
    }
}

/* Skipped if ImageMagick is not installed. */
static void imagemagick_counts_the_same_pixels(void **state)
{
    const twins p = make_pair(state);
    char line[4096];
    if (!is_program_installed("compare"))
        skip();
    for (int spoilt = 1; spoilt < 16; spoilt += 7) {
        gallery_write(p.b.path, 3, spoilt);
        snprintf(line, sizeof line, "compare -metric AE %s %s null: 2>&1", p.a.path, p.b.path);
        command_result result = run_shell(line);
        assert_int_equal(strtol(result.out, NULL, 10), spoilt);
        command_release(&result);
    }
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(status_and_text_agree_on_the_verdict),
        WITH_FOLDER(every_verdict_names_the_tolerances),
        WITH_FOLDER(errors_are_printed_with_status_2),
        WITH_FOLDER(other_frames_are_compared_beside_an_unreadable_one),
        WITH_FOLDER(unreadable_frames_are_listed),
        WITH_FOLDER(frames_in_subfolders_decide_the_verdict),
        WITH_FOLDER(json_contains_the_whole_result),
        WITH_FOLDER(json_is_printed_for_errors_too),
        WITH_FOLDER(text_lists_are_cut_but_json_lists_are_whole),
        WITH_FOLDER(page_links_to_the_compared_recordings),
        cmocka_unit_test(removed_command_digest_names_its_replacement),
        WITH_FOLDER(baseline_of_one_picture_is_compared_with_a_picture),
        cmocka_unit_test(help_describes_the_command),
        WITH_FOLDER(imagemagick_counts_the_same_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
