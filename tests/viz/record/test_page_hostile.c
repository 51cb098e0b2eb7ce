/* SPDX-License-Identifier: MIT */
/* test_page_hostile.c - damaged pages, and pages in a browser without WebAssembly, say so and show what they can. */
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "browser.h"
#include "driven_page.h"
#include "fixture.h"
#include "recordings.h"

#define CUT "Loading. If this sentence stays, the page is cut off or damaged: copy or record it again."

/* A recording of a few ticks, and the reports of damaged copies of its page. */
typedef struct driven {
    void *folder; /* a temp_folder */
    place page;
    json_t *given;
    char *said; /* null if the page cannot play */
} driven;

static void give(driven *d, const char *name, const char *text, size_t size, const char *before)
{
    json_t *one = json_pack("{s:s, s:s%, s:s}", "name", name, "text", text, size, "more", before);
    assert_non_null(one);
    assert_int_equal(json_array_append_new(d->given, one), 0);
}

/* Write a copy of the page in which one letter of an element's text is changed, this far behind its beginning. */
static void give_changed(driven *d, const char *name, char *text, const char *element, size_t offset)
{
    char *at = strstr(text, element);
    assert_non_null(at);
    at += strlen(element) + offset;
    const char was = *at;
    *at = was == 'A' ? 'B' : 'A';
    give(d, name, text, strlen(text), "");
    *at = was;
}

static void give_pages(driven *d, char *text)
{
    const size_t size = strlen(text), facts = (size_t)(strstr(text, "id=\"facts\">") - text);
    const size_t module = (size_t)(strstr(text, "id=\"module\">") - text);
    give(d, "whole", text, size, "");
    give(d, "without WebAssembly", text, size, "delete window.WebAssembly;");
    give(d, "cut in the facts", text, facts + 200, "");
    give(d, "cut in the program", text, module + 5000, "");
    give(d, "cut in the script", text, size - 3000, "");
    give_changed(d, "facts changed", text, "id=\"facts\">", 0);
    give_changed(d, "program changed", text, "id=\"module\">", 40000);
    give_changed(d, "program begins otherwise", text, "id=\"module\">", 0);
}

static int drive_pages(void **state)
{
    driven *d = calloc(1, sizeof *d);
    *state = d;
    if (!d || temp_folder_make(&d->folder) != 0)
        return -1;
    const place film = place_in(d->folder, "film"), bare = place_in(d->folder, "bare.html");
    const octree_session session = short_session("wwd");
    const film_options options = small_film(film.path);
    assert_filmed(&session, &options);
    d->page = place_below(film.path, "index.html");
    d->given = json_array();
    if (!is_browser_installed() || !page_has_module(d->page.path))
        return 0;
    char *text = file_read(d->page.path, NULL);
    give_pages(d, text);
    free(text);
    const place given = write_given_script(d->folder, d->given);
    file_write_text(bare.path, "<!DOCTYPE html>\n<body>\n");
    d->said = run_scripts_in_page(d->folder, bare.path, (const char *const[]){given.path, "drive_hostile.js", NULL});
    return 0;
}

static int forget_pages(void **state)
{
    driven *d = *state;
    const int status = nested_folder_remove(&d->folder);
    json_decref(d->given);
    free(d->said);
    free(d);
    return status;
}

static const char *need_said(void **state)
{
    const driven *d = *state;
    skip_without_playing_page(d->page.path);
    return d->said;
}

static void undamaged_page_plays(void **state)
{
    const char *said = need_said(state);
    assert_reported_value(said, "whole: message", "");
    assert_reported_value(said, "whole: faults", "");
    assert_reported_value(said, "whole: bar", "true");
    assert_reported_value(said, "whole: keys", "true");
    assert_reported_value(said, "whole: column", "true");
    assert_reported_value(said, "whole: after a key", "tick 2 of 2, played: ");
}

static void page_without_webassembly_shows_only_frames(void **state)
{
    const char *said = need_said(state);
    assert_reported_value(said, "without WebAssembly: message", "");
    assert_reported_value(said, "without WebAssembly: faults", "");
    assert_reported_value(said, "without WebAssembly: bar", "false");
    assert_reported_value(said, "without WebAssembly: keys", "false");
    assert_reported_value(said, "without WebAssembly: column", "false");
    assert_reported_value(said, "without WebAssembly: after a key", "tick 1 of 3: ");
}

static void truncated_page_says_so(void **state)
{
    const char *said = need_said(state);
    assert_reported_value(said, "cut in the facts: message", CUT);
    assert_reported_value(said, "cut in the program: message", CUT);
    assert_reported_value(said, "cut in the script: message", CUT);
    assert_reported_value(said, "facts changed: message", CUT);
}

static void page_with_a_damaged_module_shows_frames_and_says_so(void **state)
{
    static const char *const names[] = {"program changed", "program begins otherwise"};
    const char *said = need_said(state);
    for (size_t i = 0; i < 2; i++) {
        static const char expected[] =
            "tick 1 of 3: The page cannot play: the WebAssembly module in this page is damaged (";
        char what[64];
        snprintf(what, sizeof what, "%s: after a key", names[i]);
        char *told = find_reported_value(said, what);
        if (strncmp(told, expected, strlen(expected)) != 0)
            fail_msg("%s: %s", what, told);
        free(told);
        snprintf(what, sizeof what, "%s: faults", names[i]);
        assert_reported_value(said, what, "");
        snprintf(what, sizeof what, "%s: column", names[i]);
        assert_reported_value(said, what, "false");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undamaged_page_plays),
        cmocka_unit_test(page_without_webassembly_shows_only_frames),
        cmocka_unit_test(truncated_page_says_so),
        cmocka_unit_test(page_with_a_damaged_module_shows_frames_and_says_so),
    };
    return cmocka_run_group_tests(tests, drive_pages, forget_pages);
}
