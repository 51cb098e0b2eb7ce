/* SPDX-License-Identifier: MIT */
/* test_compare_rules.c - octreel/compare.h with a baseline and its stored pictures: tolerances and rules. */
#include "accept.h"
#include "files.h"
#include "fixture.h"
#include "galleries.h"
#include "images.h"
#include "octreel/compare.h"

#include <stdlib.h>
#include <string.h>

/* The old frames a.png and b.png, of which the baseline has the digests and the store has the pictures; and new frames,
 * in which five pixels of row 3 differ. */
typedef struct setting {
    place before, after, file, store;
    octreel_compare_def def; /* with the store */
} setting;

static setting make_setting(void **state, const char *rules)
{
    frame_list all = {NULL, 0, 0, NULL};
    octreel_error error = {""};
    setting s = {gallery_make(*state, "old", "a.png b.png"), gallery_make(*state, "new", "a.png b.png"),
                 place_in(*state, "baseline.txt"), place_in(*state, "store"), octreel_compare_def_default()};
    const accept_options options = {.reference = s.file.path,
                                    .frames = s.before.path,
                                    .names = &all,
                                    .note = {.date = "2026-11-22", .reason = "a test"},
                                    .store = s.store.path};
    gallery_write(place_below(s.after.path, "a.png").path, 0, 5);
    gallery_write(place_below(s.after.path, "b.png").path, 1, 5);
    if (!accept_frames(&options, NULL, &error))
        fail_msg("%s", error.text);
    char *text = file_read(s.file.path, NULL), *both = malloc(strlen(text) + strlen(rules) + 1);
    assert_non_null(both);
    strcat(strcpy(both, text), rules);
    file_write_text(s.file.path, both);
    free(both);
    free(text);
    return s;
}

/* The place of the setting does not move, so the paths are set here. */
static octreel_comparison compare(setting *s, const char *name, const char *today)
{
    octreel_comparison found;
    s->def.store = s->store.path;
    s->def.today = today;
    octreel_compare_files(place_below(s->after.path, name).path, s->file.path, &s->def, &found);
    return found;
}

static void rule_of_the_frame_forgives_until_it_expires(void **state)
{
    setting s = make_setting(state, "rule b max-delta=0.0027 expires=2026-12-31 reason=dithered\n");
    octreel_comparison found = compare(&s, "b.png", "2026-12-31");
    assert_int_equal(found.verdict, OCTREEL_VERDICT_SAME);
    assert_int_equal(found.close, 5);
    assert_int_equal(found.max_x, 4);
    assert_contains(found.sentence, "forgiven by the rule ");
    assert_contains(found.sentence, "baseline.txt:6 until 2026-12-31: dithered");
    found = compare(&s, "b.png", "2027-01-01");
    assert_int_equal(found.verdict, OCTREEL_VERDICT_DIFFERENT);
    assert_int_equal(found.counted, 5);
    assert_contains(found.sentence, "baseline.txt:6 expired on 2026-12-31: dithered");
    found = compare(&s, "a.png", "2026-12-31");
    assert_int_equal(found.verdict, OCTREEL_VERDICT_DIFFERENT);
    assert_null(strstr(found.sentence, "rule"));
}

static void pixels_in_memory_have_rules_too(void **state)
{
    setting s = make_setting(state, "rule * ignore=0,3,5,1 reason=the clock\n");
    image picture = assert_read_rgb(place_below(s.after.path, "a.png").path);
    const octreel_pixels pixels = octreel_make_pixels(picture.pixels, picture.width, picture.height, OCTREEL_RGB8);
    octreel_comparison found;
    s.def.store = s.store.path;
    s.def.frame = "a";
    assert_int_equal(octreel_compare_pixels_to_file(&pixels, s.file.path, &s.def, &found), OCTREEL_VERDICT_SAME);
    assert_int_equal(found.ignored, 5);
    assert_contains(found.sentence, "the picture, compared with ");
    assert_contains(found.sentence, "baseline.txt:6: the clock");
    image_release(&picture);
}

static void definition_is_applied_to_stored_pictures(void **state)
{
    setting s = make_setting(state, "");
    s.def.max_pixels = 5;
    octreel_comparison found = compare(&s, "a.png", NULL);
    assert_int_equal(found.verdict, OCTREEL_VERDICT_SAME);
    assert_int_equal(found.different, 5);
    s.def.max_pixels = 4;
    assert_int_equal(compare(&s, "a.png", NULL).verdict, OCTREEL_VERDICT_DIFFERENT);
}

static void rule_that_cannot_be_applied_is_named(void **state)
{
    setting s = make_setting(state, "rule a antialias reason=edges\nrule b ignore-layer=text reason=letters\n");
    octreel_comparison found;
    octreel_compare_files(place_below(s.after.path, "a.png").path, s.file.path, NULL, &found);
    assert_int_equal(found.verdict, OCTREEL_VERDICT_DIFFERENT);
    assert_contains(found.sentence, "baseline.txt:6 was not applied: it needs the stored picture, so name the store");
    found = compare(&s, "b.png", NULL);
    assert_int_equal(found.verdict, OCTREEL_VERDICT_DIFFERENT);
    assert_contains(found.sentence, "baseline.txt:7 was not applied: it ignores layers");
}

static void invalid_date_and_rule_are_trouble(void **state)
{
    setting s = make_setting(state, "rule a antialias reason=edges\nrule b flip=2 reason=letters\n");
    octreel_comparison found = compare(&s, "a.png", "2026-02-30");
    assert_int_equal(found.verdict, OCTREEL_VERDICT_TROUBLE);
    assert_contains(found.sentence, "today is \"2026-02-30\"; it must be an existing date");
    found = compare(&s, "a.png", NULL);
    assert_int_equal(found.verdict, OCTREEL_VERDICT_TROUBLE);
    assert_contains(found.sentence, "baseline.txt:7: flip takes a number from 0 to 1, not \"2\"");
}

int main(void)
{
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(rule_of_the_frame_forgives_until_it_expires), IN_FOLDER(pixels_in_memory_have_rules_too),
        IN_FOLDER(definition_is_applied_to_stored_pictures),    IN_FOLDER(rule_that_cannot_be_applied_is_named),
        IN_FOLDER(invalid_date_and_rule_are_trouble),
    };
    unsetenv("CI"); /* accept refuses to work there */
    setenv("SOURCE_DATE_EPOCH", "0", 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
