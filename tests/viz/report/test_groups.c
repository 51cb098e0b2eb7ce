/* SPDX-License-Identifier: MIT */
/* test_groups.c - frames that differ for the same cause are one group; how its frames are printed. */
#include "fixture.h"
#include "galleries.h"
#include "images.h"
#include "png_write.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static comparison_of compare(const char *a, const char *b, uint64_t most)
{
    comparison_of made = assert_compared(a, b, NULL);
    octreel_error error = {""};
    if (!explain(&made.a, &made.b, &made.result, most, &made.why, &error))
        fail_msg("%s", error.text);
    return made;
}

/* 1, 2 and 5 differ in the same pixels by as much; 3 in more; 4 is the same; 6, 7 are of another size; 8 is gone; 9 and
 * 10 cannot be read. */
static comparison_of make_all(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png 3.png 4.png 5.png 6.png 7.png 8.png 9.png"),
                b = gallery_make(*state, "b", "1.png 2.png 3.png 4.png 5.png 9.png");
    static const int spoilt[] = {4, 4, 9, 0, 4};
    image small;
    octreel_error error;
    for (int i = 0; i < 5; i++)
        gallery_write(place_below(b.path, (char[]){(char)('1' + i), '.', 'p', 'n', 'g', 0}).path, (uint64_t)i,
                      spoilt[i]);
    assert_true(image_create(&small, 5, 4, 3));
    assert_true(image_write_png(&small, place_below(b.path, "6.png").path, NULL, 0, &error) &&
                image_write_png(&small, place_below(b.path, "7.png").path, NULL, 0, &error));
    image_release(&small);
    assert_int_equal(truncate(place_below(b.path, "9.png").path, 99), 0);
    file_write_text(place_below(a.path, "a.png").path, "\x89PNG");
    file_write_text(place_below(b.path, "a.png").path, "\x89PNG, too");
    return compare(a.path, b.path, 10);
}

static void frames_are_grouped_by_cause(void **state)
{
    comparison_of made = make_all(state);
    assert_groups(&made, false, "1.png, 2.png, 5.png\n3.png\n6.png, 7.png\n8.png\n9.png\na.png\n");
    assert_groups(&made, true, "1.png\n2.png\n3.png\n5.png\n6.png\n7.png\n8.png\n9.png\na.png\n");
    assert_int_equal(frame_groups_count_failing(&made.groups, &made.result), 9);
    comparison_release(&made);
}

static void frames_without_explanation_are_not_grouped(void **state)
{
    comparison_of made = make_all(state);
    explanation_release(&made.why);
    assert_groups(&made, false, "1.png\n2.png\n3.png\n5.png\n6.png\n7.png\n8.png\n9.png\na.png\n");
    comparison_release(&made);
}

/* Of unlike digests, and of a frame that only one side has, nothing tells whether others are alike; of two sizes the
 * sizes do. */
static void frames_that_cannot_be_compared_are_not_grouped(void **state)
{
    const place a = place_in(*state, "a.digests"), b = gallery_make(*state, "b", "1.png 2.png 3.png 4.png 5.png 6.png");
    file_write_text(a.path, "octreel-digests 2\nbackground ffffff\naccepted 7f 2026-11-22 24x16 runs x\n"
                            "accepted k3 2026-11-22 9x9 runs x\n7f 0123456789abcdef 1\n7f 0123456789abcdef 2\n"
                            "k3 0123456789abcdef 3\nk3 0123456789abcdef 4\nk3 0123456789abcdef 7\n"
                            "k3 0123456789abcdef 8\n");
    comparison_of made = compare(a.path, b.path, 10);
    assert_groups(&made, false, "1.png\n2.png\n3.png, 4.png\n5.png\n6.png\n7.png\n8.png\n");
    comparison_release(&made);
}

/* One pixel elsewhere, or by another colour, is another cause. */
static void different_place_or_colour_is_a_different_group(void **state)
{
    const place a = gallery_make(*state, "a", "1.png 2.png 3.png"), b = gallery_make(*state, "b", "");
    static const struct {
        int x, y;
        uint8_t by;
    } spots[] = {{3, 3, 1}, {3, 4, 1}, {3, 3, 2}};
    for (int i = 0; i < 3; i++) {
        image picture = gallery_picture((uint64_t)i);
        octreel_error error;
        char name[8];
        picture.pixels[3 * (spots[i].y * GALLERY_WIDTH + spots[i].x)] ^= spots[i].by;
        snprintf(name, sizeof name, "%d.png", i + 1);
        assert_true(image_write_png(&picture, place_below(b.path, name).path, NULL, 0, &error));
        image_release(&picture);
    }
    comparison_of made = compare(a.path, b.path, 10);
    assert_groups(&made, false, "1.png\n2.png\n3.png\n");
    comparison_release(&made);
}

static void long_groups_are_listed_as_ranges(void **state)
{
    const place a = gallery_make(*state, "a", ""), b = gallery_make(*state, "b", "");
    for (int i = 0; i < 20; i++) {
        char name[32];
        snprintf(name, sizeof name, "frame_%06d.png", i);
        gallery_write(place_below(a.path, name).path, 1, 0);
        gallery_write(place_below(b.path, name).path, 1, i % 5 ? 1 : 0);
    }
    comparison_of made = compare(a.path, b.path, 10);
    char *text = list_groups(&made, false, true);
    assert_string_equal(text, "ticks 2 to 4, 6 to 9, 11 to 14, 16 to 19\n");
    free(text);
    comparison_release(&made);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(frames_are_grouped_by_cause),
        WITH_FOLDER(frames_without_explanation_are_not_grouped),
        WITH_FOLDER(frames_that_cannot_be_compared_are_not_grouped),
        WITH_FOLDER(different_place_or_colour_is_a_different_group),
        WITH_FOLDER(long_groups_are_listed_as_ranges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
