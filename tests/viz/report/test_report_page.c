/* SPDX-License-Identifier: MIT */
/* test_report_page.c - report.html in headless Chromium: it shows the causes, steps through the differences, swipes,
 * blinks and zooms, says what was left out, and loads no other file. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "browser.h"
#include "fixture.h"
#include "galleries.h"
#include "report.h"
#include "png_write.h"
#include "text.h"

enum { FRAMES = 57 }; /* of which the fifth is the same */

#define CAUSE                                                                                                          \
    "node 0/3/7 split, point 12 moved </script><script>document.title = 'mine'</script> & \"so on\"; 7 pixels: 5 of "  \
    "node 0/3/7; text: 2"
#define HEADLINE "From tick 0 on: <b>another</b> capacity"

/* Two folders that differ in every way that a frame can, and what the page said while drive_report.js used it. */
typedef struct driven {
    void *folder; /* a temp_folder */
    char *said;   /* null without a browser */
} driven;

static place frame_in(place folder, int i)
{
    char name[32];
    snprintf(name, sizeof name, "frame_%06d.png", i);
    return place_below(folder.path, name);
}

/* Frame 0 has a cause; 1 another size; 2 no reference; 3 no frame; 4 is the same; 5 cannot be read. */
static void make_sides(place a, place b)
{
    for (int i = 0; i < FRAMES; i++) {
        if (i != 2)
            gallery_write(frame_in(a, i).path, (uint64_t)i, 0);
        if (i != 3 && i != 1)
            gallery_write(frame_in(b, i).path, (uint64_t)i, i == 4 ? 0 : 7);
    }
    image small;
    octreel_error error = {""};
    assert_true(image_create(&small, 5, 30, 3));
    assert_true(image_write_png(&small, frame_in(b, 1).path, NULL, 0, &error));
    image_release(&small);
    file_write_text(frame_in(b, 5).path, "\x89PNG, or so");
}

/* What happens after the pictures and before the page. */
typedef void meddler(const char *folder);

static void write_page_of(comparison_of *made, const char *folder, bool each, meddler *meddle)
{
    octreel_error error = {""};
    evidence e;
    const frame_groups *groups = group_frames(made, each);
    const diff_report report = {&made->a, &made->b, &made->result, &made->why, &e, LIST_LINES, groups};
    if (!evidence_prepare(folder, &made->a, &made->b, &error) ||
        !evidence_write_groups(&e, folder, &made->result, groups, &error))
        fail_msg("%s", error.text);
    if (meddle)
        meddle(folder);
    if (!diff_report_page(&report, &error))
        fail_msg("%s", error.text);
    evidence_release(&e);
    comparison_release(made);
}

static void write_page(const char *a, const char *b, const char *folder, const char *cause, const char *headline)
{
    comparison_of made = assert_compared(a, b, NULL);
    if (cause) {
        set_cause(&made, 0, cause);
        made.result.pairs[0].difference.counted.worst_delta = 0.84341; /* 0.8434 would not forgive it */
    }
    if (headline)
        made.why.headline = strdup(headline);
    write_page_of(&made, folder, true, NULL);
}

static int drive_page(void **state)
{
    driven *d = calloc(1, sizeof *d);
    *state = d;
    if (d == NULL || temp_folder_make(&d->folder) != 0)
        return -1;
    const place a = gallery_make(d->folder, "golden", ""), b = gallery_make(d->folder, "new & <b>", "");
    const place folder = place_in(d->folder, "evidence");
    make_sides(a, b);
    write_page(a.path, b.path, folder.path, CAUSE, HEADLINE);
    if (is_browser_installed())
        d->said = browser_drive(d->folder, place_below(folder.path, "report.html").path, OCTREEL_DRIVE_REPORT);
    return 0;
}

static int forget_page(void **state)
{
    driven *d = *state;
    const int status = nested_folder_remove(&d->folder);
    free(d->said);
    free(d);
    return status;
}

static void assert_said(void **state, const char *what, const char *expected)
{
    const driven *d = *state;
    skip_without_browser();
    assert_reported_value(d->said, what, expected);
}

/* What was said holds a part. */
static void assert_said_part(void **state, const char *what, const char *part)
{
    skip_without_browser();
    char *value = find_reported_value(((driven *)*state)->said, what);
    if (!strstr(value, part))
        fail_msg("%s: \"%s\" does not contain \"%s\"", what, value, part);
    free(value);
}

static void page_shows_the_verdict_and_raises_no_error(void **state)
{
    assert_said(state, "errors", "none");
    assert_said(state, "verdict", "Trouble");
    assert_said_part(state, "about",
                     "55 of 57 frames, 1 cannot be read, 1 with the same bytes \xc2\xb7 compared exactly");
    assert_said_part(state, "about", "new & <b> against ");
    assert_said(state, "headline", "Tick 0 is the first frame that differs: " HEADLINE);
    assert_said_part(state, "title", "trouble: ");
}

/* As text, whatever is in it. */
static void cause_is_the_headline_of_the_picture(void **state)
{
    assert_said(state, "frame 0",
                "frame_000000.png | Node 0/3/7 split, point 12 moved </script><script>document.title = "
                "'mine'</script> & \"so on\" | expected actual difference | swipe");
    assert_said(state, "details 0", "7 pixels: 5 of node 0/3/7; text: 2");
    assert_said(state, "details 5", "none");
    assert_said_part(state, "facts 0",
                     "pixels; 7 of 384, 1.8\xe2\x80\xaf%; worst; 0.8435 YIQ at 0, 3; channels; by up to 1 of "
                     "255; area; 0, 3 to 6, 3; size; 24 \xc3\x97 16; files; ");
}

/* The way to look that was asked for comes back with the pictures it needs. */
static void frames_show_the_pictures_that_exist(void **state)
{
    assert_said(state, "frame 1",
                "frame_000001.png | The reference is 24x16, the frame is 5x30 | expected actual "
                "difference | swipe");
    assert_said(state, "frame 2", "frame_000002.png | A frame without a reference | actual | actual");
    assert_said(state, "frame 3", "frame_000003.png | A reference without a frame | expected | expected");
    assert_said_part(state, "frame 4", "frame_000005.png | Cannot be read: ");
    assert_said_part(state, "frame 5",
                     "frame_000006.png | 7 of 384 pixels differ | expected actual difference | swipe");
}

static void keys_step_from_difference_to_difference(void **state)
{
    static const char expected[] =
        "\nkey n\tframe_000001.png\nkey ArrowRight\tframe_000002.png\nkey p\tframe_000001.png\n"
        "key ArrowLeft\tframe_000000.png\nkey p\tframe_000000.png\nkey End\tframe_000056.png\n"
        "key n\tframe_000056.png\nkey Home\tframe_000000.png\nkey j\tframe_000001.png\nkey k\tframe_000000.png\n";
    skip_without_browser();
    assert_non_null(strstr(((driven *)*state)->said, expected));
}

static void page_lists_the_findings(void **state)
{
    assert_said(state, "listed", "56");
    assert_said(state, "place", "1 of 56");
    assert_said(state, "left out", "none");
}

static void keys_choose_the_display_mode(void **state)
{
    assert_said(state, "mode d", "difference: difference: difference");
    assert_said(state, "mode t", "side: expected actual difference: side");
    assert_said(state, "mode e", "expected: expected: expected");
    assert_said(state, "mode c", "actual: actual: actual");
    assert_said(state, "mode s", "swipe: expected actual: swipe");
    assert_said(state, "mode by button", "difference");
}

static void difference_of_one_level_glows(void **state)
{
    skip_without_browser();
    int r, g, b;
    char *glows = find_reported_value(((driven *)*state)->said, "glows"),
         *dim = find_reported_value(((driven *)*state)->said, "dim");
    assert_int_equal(sscanf(glows, "%d,%d,%d", &r, &g, &b), 3);
    assert_true(r == 255 && g > 90 && b < 90);
    assert_int_equal(sscanf(dim, "%d,%d,%d", &r, &g, &b), 3);
    assert_true(r == g && g == b && r < 100);
    free(glows);
    free(dim);
}

static void pointer_and_keys_move_the_dividing_line(void **state)
{
    assert_said(state, "swipe pressed", "inset(0px 75% 0px 0px) inset(0px 0px 0px 25%)");
    assert_said(state, "swipe dragged", "100");
    assert_said(state, "swipe let go", "100");
    assert_said(state, "swipe by keys", "96");
}

static void pictures_blink_automatically_and_by_key(void **state)
{
    assert_said(state, "blink", "expected actual expected actual");
    assert_said(state, "blink by hand", "expected expected actual");
}

static void zoom_shows_the_worst_place_and_returns(void **state)
{
    assert_said(state, "worst in the middle", "0,3");
    assert_said(state, "worst is larger", "true");
    assert_said(state, "worst and back", "true");
    assert_said(state, "larger", "true");
    assert_said(state, "not smaller than all of it", "true");
    assert_said(state, "beside each other alike", "0,3 0,3 0,3");
    assert_said(state, "wheel", "true");
    assert_said(state, "marks", "true");
    assert_said(state, "marks off", "0");
}

static void address_contains_the_frame_and_restores_it(void **state)
{
    assert_said(state, "address", "#frame=frame_000001.png&mode=difference");
    assert_said(state, "from address", "frame_000003.png expected");
    assert_said(state, "from nonsense", "frame_000000.png");
}

static void bars_show_the_size_of_the_difference_per_frame(void **state)
{
    assert_said(state, "bars",
                "56 tick 0; pixels that differ in each frame; click to go to the nearest difference; tick 56");
    assert_said(state, "end of the bars", "frame_000056.png");
}

static void question_mark_lists_the_keys(void **state)
{
    assert_said(state, "help before", "false");
    assert_said(state, "help", "true");
    assert_said(state, "behind the help", "frame_000000.png");
    assert_said(state, "keys listed",
                "j n \xe2\x86\x92 k p \xe2\x86\x90 Home End s b d f t e c space [ ] z + - 0 a x m ?");
}

/* What cannot be read cannot be accepted. */
static void selected_findings_are_saved_for_accept(void **state)
{
    const driven *d = *state;
    char how[512];
    assert_said(state, "selectable", "true true true true false true");
    assert_said(state, "selected before", "0 selected, 0 frames true ");
    assert_said(state, "selected", "2 selected, 2 frames");
    snprintf(how, sizeof how, "octreel accept %s/golden '%s/new & <b>' --from accept.txt",
             ((temp_folder *)d->folder)->name, ((temp_folder *)d->folder)->name);
    assert_said(state, "accept how", how);
    assert_said(state, "saved as", "accept.txt");
    assert_said(state, "saved", "frame_000000.png frame_000002.png");
    assert_said(state, "selected no more", "1 selected, 1 frame");
    assert_said(state, "selected all", "55 selected, 55 frames");
    assert_said(state, "selected none", "0 selected, 0 frames");
}

static void page_loads_no_other_file(void **state)
{
    driven *d = *state;
    assert_said(state, "loaded", "0");
    char *page = file_read(place_below(place_in(d->folder, "evidence").path, "report.html").path, NULL);
    assert_null(strstr(page, "http:"));
    assert_null(strstr(page, "https:"));
    free(page);
}

/* ---- Other pages, as they are opened ------------------------------------------------------------------------ */

static void assert_opens_with(void **state, place folder, const char *part)
{
    driven *d = *state;
    skip_without_browser();
    char *page = browser_open(d->folder, place_below(folder.path, "report.html").path, "");
    if (!strstr(page, part))
        fail_msg("the page has no %s", part);
    free(page);
}

static void page_of_no_difference_says_so(void **state)
{
    driven *d = *state;
    const place a = gallery_make(d->folder, "same", "1.png 2.png"), folder = place_in(d->folder, "calm");
    write_page(a.path, a.path, folder.path, NULL, NULL);
    assert_opens_with(state, folder,
                      "<h2>No frame differs</h2>\n<p id=\"calm-words\">2 frames, 2 with the same "
                      "bytes</p>\n<p id=\"calm-tolerance\">Compared exactly</p>");
}

static void page_of_tolerated_differences_says_that_frames_differ(void **state)
{
    driven *d = *state;
    const place a = gallery_make(d->folder, "strict", "1.png 2.png"), b = gallery_make(d->folder, "lax", "1.png 2.png");
    const place folder = place_in(d->folder, "forgiven");
    diff_options options = diff_options_default();
    options.tolerance.max_pixels = 9;
    gallery_write(place_below(b.path, "1.png").path, 0, 7);
    comparison_of made = assert_compared(a.path, b.path, &options);
    write_page_of(&made, folder.path, true, NULL);
    assert_opens_with(state, folder, "<h2>1 frame differs and is forgiven</h2>");
}

static void page_shows_flip_where_it_was_measured(void **state)
{
    driven *d = *state;
    const place a = gallery_make(d->folder, "seen", "1.png"), b = gallery_make(d->folder, "unseen", "1.png");
    const place folder = place_in(d->folder, "visible"), exact = place_in(d->folder, "exact");
    diff_options options = diff_options_default();
    options.tolerance.flip = true;
    gallery_write(place_below(b.path, "1.png").path, 7, 0);
    comparison_of made = assert_compared(a.path, b.path, &options);
    write_page_of(&made, folder.path, true, NULL);
    assert_opens_with(state, folder, "<dt>FLIP</dt><dd data-fact=\"FLIP\">mean 0.");
    assert_opens_with(state, folder, "<p id=\"flip-colors\">");
    assert_opens_with(state, folder, "title=\"FLIP (f)\" aria-pressed=\"false\">FLIP</button>");
    write_page(a.path, b.path, exact.path, NULL, NULL);
    assert_opens_with(state, exact,
                      "title=\"FLIP (f)\" aria-pressed=\"false\" disabled=\"\" hidden=\"\">FLIP</button>");
}

/* In the list beside the pictures, as wide windows have it. */
static void file_names_are_neither_changed_nor_cut(void **state)
{
    static const char look[] =
        "for (const {cssRules, ownerNode} of document.styleSheets)\n"
        "    for (let i = cssRules.length; i-- > 0;)\n"
        "        if (cssRules[i].media?.mediaText.includes('max-width')) ownerNode.sheet.deleteRule(i);\n"
        "const made = document.body.appendChild(document.createElement('pre'));\n"
        "const cut = [...document.querySelectorAll('#list .name')].filter(n => n.scrollWidth > n.clientWidth);\n"
        "made.textContent = `cut\\t${cut.length}\\nheadline\\t${document.getElementById('headline').textContent}\\n`;\n"
        "made.id = 'said';\n";
    driven *d = *state;
    const place a = place_in(d->folder, "a.digests"), b = gallery_make(d->folder, "listed", "shown.png title.png"),
                folder = place_in(d->folder, "names"), script = place_in(d->folder, "look.js");
    skip_without_browser();
    file_write_text(a.path, "octreel-digests 2\nbackground ffffff\naccepted 7f 2026-11-22 24x16 runs x\n"
                            "7f 0123456789abcdef shown\n7f 0123456789abcdef title\n");
    file_write_text(script.path, look);
    write_page(a.path, b.path, folder.path, NULL, NULL);
    char *said = browser_drive(d->folder, place_below(folder.path, "report.html").path, script.path);
    assert_reported_value(said, "cut", "0");
    assert_reported_value(said, "headline", "shown.png is the first frame that differs");
    free(said);
}

static void page_of_few_differences_shows_all(void **state)
{
    driven *d = *state;
    const place a = gallery_make(d->folder, "few", "1.png 2.png"), b = gallery_make(d->folder, "fewer", "1.png");
    const place folder = place_in(d->folder, "few evidence");
    write_page(a.path, b.path, folder.path, NULL, NULL);
    assert_opens_with(state, folder, "<p id=\"left-out\" hidden=\"\">");
    assert_opens_with(state, folder, "<h2 id=\"cause\">A reference without a frame</h2>");
}

/* One entry, one picture, and all names for accept.txt. */
static void frames_with_one_cause_are_one_entry(void **state)
{
    driven *d = *state;
    const place a = gallery_make(d->folder, "old", "1.png 2.png 3.png"),
                b = gallery_make(d->folder, "later", "1.png 2.png 3.png"), folder = place_in(d->folder, "alike");
    octreel_error error;
    for (int i = 0; i < 3; i++)
        gallery_write(place_below(b.path, (char[]){(char)('1' + i), '.', 'p', 'n', 'g', 0}).path, (uint64_t)i, 7);
    comparison_of made = assert_compared(a.path, b.path, NULL);
    assert_true(explain(&made.a, &made.b, &made.result, 10, &made.why, &error));
    write_page_of(&made, folder.path, false, NULL);
    assert_false(file_exists(place_below(folder.path, "2.actual.png").path));
    assert_opens_with(state, folder, "<dt>same in</dt><dd data-fact=\"same in\">3 frames: 1.png to 3.png</dd>");
    assert_opens_with(state, folder, "<b>+2</b><small>7 pixels</small></button></li></ol>");
    assert_opens_with(state, folder, "\"frames\": [\"1.png\", \"2.png\", \"3.png\"]");
}

/* A page of more findings than it holds. Only visible entries are laid out, and only shown pictures are decoded. */
static void page_of_a_thousand_findings_renders_only_visible_ones(void **state)
{
    static const char look[] =
        "const list = document.getElementById('list').children, last = list[list.length - 1].lastChild;\n"
        "const isDrawn = entry => entry.checkVisibility({contentVisibilityAuto: true});\n"
        "const press = key => document.body.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));\n"
        "const shown = () => document.querySelector('.pane img') && document.body.dataset.frame;\n"
        "const text = id => document.getElementById(id).textContent;\n"
        "async function until(isSo) { while (!isSo()) await new Promise(done => setTimeout(done, 1)); }\n"
        "async function look() {\n"
        "    await until(() => shown() === 'frame_000000.png' && isDrawn(list[0].lastChild));\n"
        "    const said = [`listed\\t${list.length}`, `left out\\t${text('left-out')}`, `last "
        "before\\t${isDrawn(last)}`];\n"
        "    for (let i = 0; i < 500; i++) press('j');\n"
        "    press('a');\n"
        "    await until(() => shown() === 'frame_000500.png');\n"
        "    said.push(`selected\\t${text('selected')}`);\n"
        "    press('End');\n"
        "    await until(() => shown() === 'frame_000999.png' && isDrawn(last));\n"
        "    await until(() => !isDrawn(list[0].lastChild));\n" /* the browser hides it a few frames later */
        "    said.push(`decoded\\t${document.images.length}`, '');\n"
        "    const made = document.body.appendChild(document.createElement('pre'));\n"
        "    made.textContent = said.join('\\n');\n"
        "    made.id = 'said';\n"
        "}\n"
        "look();\n";
    driven *d = *state;
    const place a = gallery_make(d->folder, "many", ""), b = gallery_make(d->folder, "more", ""),
                folder = place_in(d->folder, "thousand"), script = place_in(d->folder, "look.js");
    skip_without_browser();
    for (int i = 0; i < DIFF_REPORT_PAGE_FRAMES + 7; i++) {
        gallery_write(frame_in(a, i).path, 1, 0);
        gallery_write(frame_in(b, i).path, 1, 7);
    }
    file_write_text(script.path, look);
    write_page(a.path, b.path, folder.path, NULL, NULL);
    char *said = browser_drive(d->folder, place_below(folder.path, "report.html").path, script.path);
    assert_reported_value(said, "listed", "1000");
    assert_reported_value(said, "left out",
                          "7 more findings: this page shows the first 1,000. The pictures of all findings are files "
                          "beside it.");
    assert_reported_value(said, "last before", "false");
    assert_reported_value(said, "selected", "1 selected, 1 frame");
    assert_reported_value(said, "decoded", "3");
    free(said);
}

/* Nobody reads so much: it is all holes. */
static void enlarge(const char *folder)
{
    assert_int_equal(truncate(place_below(folder, "1.actual.png").path, (off_t)DIFF_REPORT_PAGE_BYTES), 0);
}

static void large_pictures_stay_in_files_beside_the_page(void **state)
{
    driven *d = *state;
    const place a = gallery_make(d->folder, "large a", "1.png 2.png"), b = gallery_make(d->folder, "large b", "");
    const place folder = place_in(d->folder, "large evidence");
    for (int i = 1; i < 3; i++)
        gallery_write(place_below(b.path, i == 1 ? "1.png" : "2.png").path, 9, 0);
    comparison_of made = assert_compared(a.path, b.path, NULL);
    write_page_of(&made, folder.path, true, enlarge);
    char *page = file_read(place_below(folder.path, "report.html").path, NULL);
    assert_null(strstr(page, "<img data-frame=\"0\""));
    assert_non_null(strstr(page, "<img data-frame=\"1\" data-picture=\"difference\" src=\"data:image/png;base64,"));
    free(page);
    assert_opens_with(state, folder, "The pictures are too large for this page; they are files beside it.");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_shows_the_verdict_and_raises_no_error),
        cmocka_unit_test(cause_is_the_headline_of_the_picture),
        cmocka_unit_test(frames_show_the_pictures_that_exist),
        cmocka_unit_test(keys_step_from_difference_to_difference),
        cmocka_unit_test(page_lists_the_findings),
        cmocka_unit_test(keys_choose_the_display_mode),
        cmocka_unit_test(difference_of_one_level_glows),
        cmocka_unit_test(pointer_and_keys_move_the_dividing_line),
        cmocka_unit_test(pictures_blink_automatically_and_by_key),
        cmocka_unit_test(zoom_shows_the_worst_place_and_returns),
        cmocka_unit_test(bars_show_the_size_of_the_difference_per_frame),
        cmocka_unit_test(address_contains_the_frame_and_restores_it),
        cmocka_unit_test(question_mark_lists_the_keys),
        cmocka_unit_test(selected_findings_are_saved_for_accept),
        cmocka_unit_test(frames_with_one_cause_are_one_entry),
        cmocka_unit_test(page_loads_no_other_file),
        cmocka_unit_test(page_of_no_difference_says_so),
        cmocka_unit_test(page_of_tolerated_differences_says_that_frames_differ),
        cmocka_unit_test(page_shows_flip_where_it_was_measured),
        cmocka_unit_test(file_names_are_neither_changed_nor_cut),
        cmocka_unit_test(page_of_few_differences_shows_all),
        cmocka_unit_test(page_of_a_thousand_findings_renders_only_visible_ones),
        cmocka_unit_test(large_pictures_stay_in_files_beside_the_page),
    };
    return cmocka_run_group_tests(tests, drive_page, forget_page);
}
