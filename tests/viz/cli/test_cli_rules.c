/* SPDX-License-Identifier: MIT */
/* test_cli_rules.c - octreel diff applies the rules of a baseline to stored pictures and names them in every report;
 * octreel accept keeps them. */
#include "baseline.h"
#include "commands.h"
#include "fixture.h"
#include "galleries.h"
#include "images.h"
#include "recordings.h"

#include <stdlib.h>
#include <string.h>

/* Two versions of two frames. In the new ones five pixels of row 3 differ, by one level of green. The baseline has the
 * old ones, and their pictures are in the store. */
typedef struct setting {
    place before, after, file, store;
} setting;

static void accept_into(const setting *s, const char *more)
{
    command_result result = run_octreel(NULL, "accept %s %s --store %s --reason first --date 2026-11-22 %s",
                                        s->file.path, s->before.path, s->store.path, more);
    assert_done(&result);
    command_release(&result);
}

static setting make_setting(void **state)
{
    unsetenv("CI");
    const setting s = {gallery_make(*state, "old", "1.png menu/2.png"), gallery_make(*state, "new", "1.png menu/2.png"),
                       place_in(*state, "baseline.txt"), place_in(*state, "store")};
    gallery_write(place_below(s.after.path, "1.png").path, 0, 5);
    gallery_write(place_below(s.after.path, "menu/2.png").path, 1, 5);
    accept_into(&s, "");
    return s;
}

/* Put lines before the third line of the baseline. */
static void add_lines(const setting *s, const char *lines)
{
    char *text = file_read(s->file.path, NULL), *third = strchr(strchr(text, '\n') + 1, '\n') + 1;
    char *both = malloc(strlen(text) + strlen(lines) + 1);
    assert_non_null(both);
    sprintf(both, "%.*s%s%s", (int)(third - text), text, lines, third);
    file_write_text(s->file.path, both);
    free(both);
    free(text);
}

static void assert_diff(const setting *s, const char *more, int status, const char *part)
{
    command_result result = run_octreel(NULL, "diff %s %s --store %s --today 2026-11-27 %s", s->file.path,
                                        s->after.path, s->store.path, more);
    if (result.status != status || !strstr(result.out, part))
        fail_msg("status %d, not %d, or no \"%s\" in: %s%s", result.status, status, part, result.out, result.err);
    command_release(&result);
}

#define CLOCK "rule menu/* ignore=0,3,5,1 date=2026-11-22 expires=2026-12-31 reason=the clock shows the <time>\n"
#define DITHER "rule 1 max-delta=0.0027 reason=the gradient is dithered\n"

static void every_report_names_the_rule_that_forgave(void **state)
{
    const setting s = make_setting(state);
    const place out = place_in(*state, "out");
    char more[2048];
    assert_diff(&s, "", 1, "different: 2 of 2 frames");
    add_lines(&s, CLOCK DITHER);
    assert_diff(&s, "", 0, "same: 2 frames, 2 forgiven\n");
    assert_diff(&s, "", 0, "/baseline.txt:3 until 2026-12-31: the clock shows the <time>\n");
    assert_diff(&s, "", 0, "within (0,3)-(4,3); forgiven by the rule ");
    assert_diff(&s, "", 0, "compared exactly; 1 frame forgiven by the rule ");
    assert_diff(&s, "--json", 0, "\"rule\": {\"effect\": \"forgave\", \"file\": \"");
    assert_diff(&s, "--json", 0,
                "\"line\": 3, \"pattern\": \"menu/*\", \"date\": \"2026-11-22\", \"expires\": "
                "\"2026-12-31\", \"reason\": \"the clock shows the <time>\"}");
    assert_diff(&s, "--json", 0, "\"reason\": \"the gradient is dithered\", \"frames\": 1}]");
    assert_diff(&s, "--junit -", 0, "name=\"menu/2.png\" time=\"0\">\n      <system-out>forgiven by the rule ");
    assert_diff(&s, "--junit -", 0, ":3 until 2026-12-31: the clock shows the &#60;time&#62;</system-out>");
    assert_diff(&s, "--markdown -", 0, ":4: the gradient is dithered");
    snprintf(more, sizeof more, "-o %s", out.path);
    assert_diff(&s, more, 0, "forgiven by the rule ");
    char *page = file_read(place_below(out.path, "report.html").path, NULL);
    assert_contains(page, "baseline.txt:3 until 2026-12-31: the clock shows the \\u003ctime>");
    free(page);
}

static void expired_rule_fails_and_says_so(void **state)
{
    const setting s = make_setting(state);
    add_lines(&s, CLOCK DITHER);
    assert_diff(&s, "--today 2026-12-31", 0, "2 forgiven");
    assert_diff(&s, "--today 2027-01-01", 1, "different: 1 of 2 frames, 1 forgiven");
    assert_diff(&s, "--today 2027-01-01", 1, "/baseline.txt:3 expired on 2026-12-31: the clock shows the <time>\n");
    assert_diff(&s, "--today 2027-01-01 --json", 1, "\"rule\": {\"effect\": \"expired\"");
    assert_diff(&s, "--today 2027-01-01 --max-pixels 5", 0, "2 forgiven\n"); /* the options forgive without the rule */
    static const struct {
        const char *epoch;
        int status;
    } days[] = {{"SOURCE_DATE_EPOCH=1798761599", 0}, {"SOURCE_DATE_EPOCH=1798761600", 1}}; /* the seconds at new year */
    for (size_t i = 0; i < 2; i++) {
        const command_setting day = {.environment = {days[i].epoch}};
        command_result result = run_octreel(&day, "diff %s %s --store %s", s.file.path, s.after.path, s.store.path);
        assert_int_equal(result.status, days[i].status);
        command_release(&result);
    }
    const command_setting bad = {.environment = {"SOURCE_DATE_EPOCH=soon"}};
    command_result result = run_octreel(&bad, "diff %s %s", s.file.path, s.after.path);
    assert_trouble(&result, "SOURCE_DATE_EPOCH is \"soon\"");
    result = run_octreel(NULL, "diff %s %s --today 2026-02-30", s.file.path, s.after.path);
    assert_trouble(&result, "--today takes an existing date");
}

static void every_tolerance_is_a_key_of_a_rule(void **state)
{
    const setting s = make_setting(state);
    static const char *const keys[][2] = {
        {"max-pixels=5", "max-pixels=4"},   {"max-pixels=1.31%", "max-pixels=1.3%"},
        {"max-delta=1", "max-delta=0.001"}, {"max-channel=1", "pixels-per-degree=30 flip=0"},
        {"flip=0.1", "flip=0.00001"},       {"ignore=0,3,5,1", "ignore=0,3,4,1"},
    };
    char *text = file_read(s.file.path, NULL), line[200];
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        for (int status = 0; status < 2; status++) {
            snprintf(line, sizeof line, "rule * %s reason=x\n", keys[i][status]);
            add_lines(&s, line);
            assert_diff(&s, "", status, status ? "different: 2 of 2 frames\n" : "same: 2 frames, 2 forgiven\n");
            file_write_text(s.file.path, text);
        }
    free(text);
}

static void rule_forgives_no_more_than_it_says(void **state)
{
    const setting s = make_setting(state);
    add_lines(&s, "rule 1 max-pixels=4 reason=few\nrule menu/2 ignore=1,3,9,1 reason=most\n");
    assert_diff(&s, "", 1, "  1.png: 5 of 384 pixels differ; worst 0.0027 YIQ at (0,3)");
    assert_diff(&s, "", 1, "/baseline.txt:3 forgives: few\n");
    assert_diff(&s, "", 1, "  menu/2.png: 1 of 384 pixels differs, 4 more in ignored areas;");
    assert_diff(&s, "--max-pixels 1", 1, "different: 1 of 2 frames, 1 forgiven"); /* with the mask of the rule */
    assert_diff(&s, "--json", 1, "\"effect\": \"exceeded\"");
}

/* A tolerance of the options that suffices is not attributed to a rule. */
static void rule_is_named_only_where_it_was_needed(void **state)
{
    const setting s = make_setting(state);
    add_lines(&s, CLOCK);
    assert_diff(&s, "--max-pixels 5", 0, "forgiven: up to 5 pixels a frame\n");
}

static void equal_digests_need_no_rule(void **state)
{
    const setting s = make_setting(state);
    add_lines(&s, CLOCK DITHER);
    command_result result = run_octreel(NULL, "diff %s %s", s.file.path, s.before.path);
    assert_int_equal(result.status, 0);
    assert_string_equal(result.out, "same: 2 frames, 2 with the same pixels\ncompared exactly\n");
    command_release(&result);
}

static void rule_without_a_stored_picture_is_not_applied(void **state)
{
    const setting s = make_setting(state);
    add_lines(&s, CLOCK DITHER);
    command_result result = run_octreel(NULL, "diff %s %s", s.file.path, s.after.path);
    assert_int_equal(result.status, 1);
    assert_contains(result.out,
                    ":4 was not applied: it needs the stored picture, so name the store (diff --store DIR)");
    command_release(&result);
    result = run_script("rm -r %s", s.store.path);
    command_release(&result);
    assert_diff(&s, "", 1, ": cannot be opened: No such file or directory; the rule ");
    assert_diff(&s, "", 1, ":4 was not applied: it needs this picture: the gradient is dithered");
    assert_diff(&s, "--json", 1, "\"effect\": \"lacks_picture\"");
}

static void rule_without_frames_is_a_warning(void **state)
{
    const setting s = make_setting(state);
    add_lines(&s, CLOCK DITHER "rule menus/* antialias reason=old\n");
    assert_diff(&s, "", 0, "baseline.txt:5 applies to no frame; correct its pattern or remove it: menus/*\n");
    assert_diff(&s, "--json", 0, "\"pattern\": \"menus/*\", \"reason\": \"old\", \"frames\": 0}");
}

static void mask_picture_excludes_its_bright_pixels(void **state)
{
    const setting s = make_setting(state);
    const place mask = place_in(*state, "the mask.png");
    image picture;
    assert_true(image_create(&picture, GALLERY_WIDTH, GALLERY_HEIGHT, 3));
    for (int x = 0; x < 5; x++)
        picture.pixels[3 * (3 * GALLERY_WIDTH + x) + x % 3] = 1;
    assert_written(&picture, mask.path);
    image_release(&picture);
    add_lines(&s, "rule * ignore-mask=the\\ mask.png reason=sparks\n");
    assert_diff(&s, "", 0, "forgiven: 0 of 384 pixels differ, 5 more in ignored areas; forgiven by the rule ");
    assert_true(image_create(&picture, 10, GALLERY_HEIGHT, 3));
    assert_written(&picture, mask.path);
    image_release(&picture);
    command_result result = run_octreel(NULL, "diff %s %s", s.file.path, s.after.path);
    assert_trouble(&result, "baseline.txt:3: the mask the mask.png has 10x16 pixels, but the frame 1.png has 24x16");
    file_write_text(mask.path, "no picture");
    result = run_octreel(NULL, "diff %s %s", s.file.path, s.after.path);
    assert_trouble(&result, "baseline.txt:3: the mask cannot be used: ");
    assert_int_equal(remove(mask.path), 0);
    result = run_octreel(NULL, "accept %s %s --reason x", s.file.path, s.after.path);
    assert_trouble(&result, "baseline.txt:3: the mask cannot be used: ");
}

static void bad_rule_is_refused_with_its_line(void **state)
{
    const setting s = make_setting(state);
    add_lines(&s, DITHER "rule 1 max-delta=-1 reason=x\n");
    command_result result = run_octreel(NULL, "diff %s %s", s.file.path, s.after.path);
    assert_trouble(&result, "baseline.txt:4: max-delta takes a number from 0 to 1, not \"-1\"");
    const setting other = {s.before, s.after, place_in(*state, "other.txt"), s.store};
    accept_into(&other, "");
    add_lines(&other, "rule 1 ignore-layer=text,nods reason=x\n");
    result = run_octreel(NULL, "diff %s %s", other.file.path, s.after.path);
    assert_trouble(&result, "other.txt:3: unknown layer \"nods\"; ");
}

/* The layers of a recording are known, those of other pictures are not. */
static void rule_ignores_layers_of_recordings(void **state)
{
    const setting folders = make_setting(state);
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    const setting s = {a, b, place_in(*state, "recording.txt"), place_in(*state, "pictures")};
    octree_session session = short_session("wd");
    film_options film = small_film(a.path);
    film.view.width = 480;
    film.view.height = 270;
    assert_filmed(&session, &film);
    film.folder = b.path;
    assert_filmed(&session, &film);
    image frame = assert_read_rgb(frame_place(b.path, 1).path);
    memcpy(frame.pixels + 3 * (10 * frame.width + 70), "\xff\0\0", 3); /* in the panel */
    assert_written(&frame, frame_place(b.path, 1).path);
    image_release(&frame);
    accept_into(&s, "");
    assert_diff(&s, "", 1, "different: 1 of 3 frames");
    add_lines(&s, "rule frame_* ignore-layer=text reason=the fonts differ\n");
    assert_diff(&s, "", 0, "1 more in ignored areas; forgiven by the rule ");
    add_lines(&folders, "rule 1 ignore-layer=text reason=the fonts differ\n");
    assert_diff(&folders, "", 1,
                ":3 was not applied: it ignores layers, and the frame is not of a recording: the fonts");
}

static void accept_keeps_rules_and_comments(void **state)
{
    const setting s = make_setting(state);
    static const char notes[] = "# in review\n" CLOCK "rule gone antialias reason=old\n" DITHER "# end\n";
    add_lines(&s, notes);
    for (int i = 0; i < 2; i++) {
        command_result result = run_octreel(NULL, "accept %s %s %s --reason new --date 2026-11-27", s.file.path,
                                            s.after.path, i ? "" : "1.png");
        assert_done(&result);
        command_release(&result);
        char *text = file_read(s.file.path, NULL);
        assert_contains(text, notes);
        free(text);
    }
    assert_diff(&s, "", 0, "same: 2 frames, 2 with the same pixels\n");
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(every_report_names_the_rule_that_forgave),
        WITH_FOLDER(expired_rule_fails_and_says_so),
        WITH_FOLDER(every_tolerance_is_a_key_of_a_rule),
        WITH_FOLDER(rule_forgives_no_more_than_it_says),
        WITH_FOLDER(rule_is_named_only_where_it_was_needed),
        WITH_FOLDER(equal_digests_need_no_rule),
        WITH_FOLDER(rule_without_a_stored_picture_is_not_applied),
        WITH_FOLDER(rule_without_frames_is_a_warning),
        WITH_FOLDER(mask_picture_excludes_its_bright_pixels),
        WITH_FOLDER(bad_rule_is_refused_with_its_line),
        WITH_FOLDER(rule_ignores_layers_of_recordings),
        WITH_FOLDER(accept_keeps_rules_and_comments),
    };
    unsetenv("SOURCE_DATE_EPOCH");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
