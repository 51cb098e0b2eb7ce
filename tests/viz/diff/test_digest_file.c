/* SPDX-License-Identifier: MIT */
/* test_digest_file.c - files of digests: written, read back, compared with pictures, and refused with a line. */
#include "digest_file.h"
#include "fixture.h"
#include "galleries.h"
#include "ignored_layers.h"
#include "image_digest.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static void write_digests(const char *folder, const char *path)
{
    diff_side side = assert_side(folder);
    octreel_error error = {""};
    if (!digest_all(&side, (image_color){255, 255, 255}, &error))
        fail_msg("%s", error.text);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_true(digest_file_write(out, &side, &error));
    assert_int_equal(fclose(out), 0);
    diff_side_release(&side);
}

static void lines_are_those_of_the_format(void **state)
{
    const place folder = gallery_make(*state, "a", "b.png a.png"), file = place_in(*state, "a.digests");
    image first = gallery_picture(1), second = gallery_picture(0); /* a.png has the seed 1 */
    char expected[256];
    write_digests(folder.path, file.path);
    snprintf(expected, sizeof expected,
             "octreel-digests 1\nbackground ffffff\n%016" PRIx64 " %dx%d a.png\n%016" PRIx64 " %dx%d b.png\n",
             image_digest_by(IMAGE_DIGEST_RUNS, &first), GALLERY_WIDTH, GALLERY_HEIGHT,
             image_digest_by(IMAGE_DIGEST_RUNS, &second), GALLERY_WIDTH, GALLERY_HEIGHT);
    char *text = file_read(file.path, NULL);
    assert_string_equal(text, expected);
    free(text);
    image_release(&first);
    image_release(&second);
}

static void digests_stand_for_pictures_on_either_side(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png 3.png"), b = gallery_make(*state, "b", "1.png 2.png 4.png"),
                digests = place_in(*state, "a.digests");
    write_digests(a.path, digests.path);
    gallery_write(place_below(b.path, "2.png").path, 1, 1);
    comparison_of made = assert_compared(digests.path, b.path, NULL);
    assert_int_equal(finding_of(&made, "1.png"), FOUND_SAME_PIXELS);
    assert_int_equal(finding_of(&made, "2.png"), FOUND_DIGEST);
    assert_int_equal(finding_of(&made, "3.png"), FOUND_NO_FRAME);
    assert_int_equal(finding_of(&made, "4.png"), FOUND_NO_REFERENCE);
    comparison_release(&made);
    made = assert_compared(b.path, digests.path, NULL);
    assert_int_equal(finding_of(&made, "2.png"), FOUND_DIGEST);
    assert_int_equal(finding_of(&made, "3.png"), FOUND_NO_REFERENCE);
    comparison_release(&made);
    made = assert_compared(digests.path, digests.path, NULL);
    assert_int_equal(made.result.verdict, DIFF_SAME);
    comparison_release(&made);
}

static void unreadable_pictures_are_trouble_beside_digests_too(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), digests = place_in(*state, "a.digests");
    write_digests(a.path, digests.path);
    file_write_text(place_below(a.path, "1.png").path, "");
    comparison_of made = assert_compared(digests.path, a.path, NULL);
    assert_int_equal(made.result.verdict, DIFF_TROUBLE);
    comparison_release(&made);
}

static void nothing_is_forgiven_by_digests(void **state)
{
    const place a = gallery_make(*state, "a", "1.png"), digests = place_in(*state, "a.digests");
    static const image_rectangle corner = {0, 0, 1, 1};
    const diff_options asked[] = {
        {.tolerance = {.max_pixels = 1}, .background = {255, 255, 255}},
        {.tolerance = {.max_delta = 0.1}, .background = {255, 255, 255}},
        {.tolerance = {.antialias = true}, .background = {255, 255, 255}},
        {.tolerance = {.ignored = &corner, .ignored_count = 1}, .background = {255, 255, 255}},
        {.mask = ignore_layers, .background = {255, 255, 255}},
    };
    write_digests(a.path, digests.path);
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++)
        assert_not_compared(digests.path, a.path, &asked[i], "nothing can be forgiven");
    const diff_options black = {.background = {0, 0, 0}};
    assert_not_compared(a.path, digests.path, &black, "--background ffffff");
}

#define HEAD "octreel-digests 1\nbackground 00ff80\n"
#define LINE_A "0123456789abcdef 12x34 a.png\n"
#define LINE_B "fedcba9876543210 16384x1 b b.png\n"

static bool parse(const char *text, size_t size, diff_side *side, octreel_error *error)
{
    char *copy = malloc(size + 1);
    assert_non_null(copy);
    memcpy(copy, text, size);
    copy[size] = 0;
    *side = (diff_side){.path = "file"};
    const bool ok = digest_file_parse(side, copy, size, error);
    free(copy);
    return ok;
}

static void what_is_well_formed_is_read(void **state)
{
    (void)state;
    static const char *const texts[] = {HEAD LINE_A LINE_B,
                                        "octreel-digests 1\r\nbackground 00ff80\r\n0123456789abcdef 12x34 a.png\r\n"
                                        "fedcba9876543210 16384x1 b b.png"};
    for (size_t i = 0; i < 2; i++) {
        diff_side side;
        octreel_error error = {""};
        if (!parse(texts[i], strlen(texts[i]), &side, &error))
            fail_msg("%s", error.text);
        assert_int_equal(side.count, 2);
        assert_true(side.background.r == 0 && side.background.g == 255 && side.background.b == 128);
        assert_true(side.frames[0].digest.pixels == UINT64_C(0x0123456789abcdef));
        assert_true(side.frames[0].digest.width == 12 && side.frames[0].digest.height == 34);
        assert_string_equal(side.frames[1].name, "b b.png");
        assert_null(side.frames[0].path);
        diff_side_release(&side);
    }
}

static void what_is_not_is_refused_with_its_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *part;
    } cases[] = {
        {"octreel-digests 3\nbackground ffffff\n", "file:1: "},
        {"octreel-digests 1 \nbackground ffffff\n", "file:1: "},
        {"digests\nbackground ffffff\n", "file:1: this version reads \"octreel-digests 1\" and \"octreel-digests 2\""},
        {"octreel-digests 1\n", "second line"},
        {"octreel-digests 1", "second line"},
        {"octreel-digests 1\nbackground fffff\n", "file:2: "},
        {"octreel-digests 1\nbackground fffffff\n", "file:2: "},
        {"octreel-digests 1\nbackground FFFFFF\n", "file:2: "},
        {"octreel-digests 1\n" LINE_A, "file:2: "},
        {HEAD "0123456789abcde 12x34 a.png\n", "file:3: expected"},
        {HEAD "0123456789abcdeg 12x34 a.png\n", "file:3: expected"},
        {HEAD "0123456789abcdef 0x34 a.png\n", "file:3: expected"},
        {HEAD "0123456789abcdef 16385x34 a.png\n", "file:3: expected"},
        {HEAD "0123456789abcdef 99999999999999999999x34 a.png\n", "file:3: expected"},
        {HEAD "0123456789abcdef 12x a.png\n", "file:3: expected"},
        {HEAD "0123456789abcdef 12x34\n", "file:3: expected"},
        {HEAD "0123456789abcdef 12x34 \n", "file:3: expected"},
        {HEAD "0123456789abcdef 12x34 ../a.png\n", "file:3: expected"},
        {HEAD "0123456789abcdef 12x34 a\tb.png\n", "file:3: expected"},
        {HEAD "0123456789abcdef 12x34 a\x7f.png\n", "file:3: expected"},
        {HEAD "0123456789abcdef ax34 a.png\n", "file:3: expected"},
        {HEAD "0123456789abcdef -1x34 a.png\n", "file:3: expected"},
        {HEAD "<<<<<<<HEAD\n", "file:3: expected"},
        {HEAD "<<<<==== a\n", "file:3: expected"},
        {HEAD "\n", "file:3: expected"},
        {HEAD "<<<<<<< HEAD\n", "file:3: a conflict that git has left"},
        {HEAD LINE_A LINE_A, "file:4: names must be in order"},
        {HEAD LINE_B LINE_A, "file:4: names must be in order"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        diff_side side;
        octreel_error error = {""};
        assert_false(parse(cases[i].text, strlen(cases[i].text), &side, &error));
        if (!strstr(error.text, cases[i].part))
            fail_msg("case %zu: \"%s\" does not say \"%s\"", i, error.text, cases[i].part);
        diff_side_release(&side);
    }
    diff_side side;
    octreel_error error = {""};
    assert_false(parse(HEAD "\0" LINE_A, sizeof HEAD "\0" LINE_A - 1, &side, &error));
    assert_non_null(strstr(error.text, "zero byte"));
}

static void names_that_no_line_holds_are_refused(void **state)
{
    const place folder = gallery_make(*state, "a", "");
    gallery_write(place_below(folder.path, "a\nb.png").path, 1, 0);
    diff_side side = assert_side(folder.path);
    octreel_error error = {""};
    assert_true(digest_all(&side, (image_color){0, 0, 0}, &error));
    assert_false(digest_file_write(stderr, &side, &error));
    assert_non_null(strstr(error.text, "a line cannot hold"));
    diff_side_release(&side);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(lines_are_those_of_the_format),
        WITH_FOLDER(digests_stand_for_pictures_on_either_side),
        WITH_FOLDER(unreadable_pictures_are_trouble_beside_digests_too),
        WITH_FOLDER(nothing_is_forgiven_by_digests),
        cmocka_unit_test(what_is_well_formed_is_read),
        cmocka_unit_test(what_is_not_is_refused_with_its_line),
        WITH_FOLDER(names_that_no_line_holds_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
