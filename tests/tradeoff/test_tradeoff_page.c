/* SPDX-License-Identifier: MIT */
/* test_tradeoff_page.c - the trade's page in headless Chromium, and the options of octree-tradeoff that read a page. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "browser.h"
#include "commands.h"
#include "driven_page.h"
#include "files.h"
#include "fixture.h"

#define CHAPTERS "index,breaks,png"

/* Run octree-tradeoff. The test fails unless its status is `status`. Returns what it said. */
static char *run(int status, const char *arguments)
{
    command_result result = run_script("%s %s 2>&1", OCTREE_TRADEOFF, arguments);
    if (result.status != status)
        fail_msg("octree-tradeoff %s ends with %d: %s", arguments, result.status, result.out);
    char *const said = result.out;
    free(result.err);
    return said;
}

static void run_in(const temp_folder *own, int status, const char *format, const char *part)
{
    char arguments[1024];
    snprintf(arguments, sizeof arguments, format, own->name, own->name);
    char *const said = run(status, arguments);
    if (!strstr(said, part))
        fail_msg("octree-tradeoff %s does not say \"%s\": %s", arguments, part, said);
    free(said);
}

static int make_page(void **state)
{
    if (temp_folder_make(state) != 0)
        return -1;
    run_in(*state, 0, "--quick --knob " CHAPTERS " --output %s/made", "has all figures");
    return 0;
}

static void a_reader_finds_charts_tables_and_examples(void **state)
{
    temp_folder *own = *state;
    skip_without_browser();
    char *said =
        run_scripts_in_page(own, place_in(own, "made/tradeoff.html").path, (const char *[]){DRIVE_TRADEOFF, NULL});
    static const char *const expected[][2] = {
        {"errors", ""},
        {"chapters and gains", "4"},
        {"title", "What speed costs in accuracy, and accuracy in speed"},
        {"has marks", "true"},
        {"fewer without octreel", "true"},
        {"all again", "true"},
        {"first point", "true"},
        {"lists", "3"},
        {"nothing about distances of a box", "There is nothing to draw with these choices."},
        {"marks of a box", "true"},
        {"rows of the matrix", "81"},
        {"octreel is never wrong", "true"},
        {"rows of the table", "true"},
        {"not a page", "other.html is not a page of octree-tradeoff."},
        {"another page", "true"},
        {"twice the marks", "true"},
        {"fits", "true"},
    };
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++)
        assert_reported_value(said, expected[i][0], expected[i][1]);
    free(said);
}

/* The figures, sentences and examples of a page make the same page again. */
static void a_page_is_made_again_from_its_figures(void **state)
{
    temp_folder *own = *state;
    run_in(own, 0, "--from %s/made/tradeoff.html --output %s/again", "has all figures");
    const place made = place_in(own, "made"), again = place_in(own, "again");
    assert_same_folders(made.path, again.path, NULL);
}

static void a_text_is_checked_against_the_figures(void **state)
{
    temp_folder *own = *state;
    char *said;
    char arguments[512];
    snprintf(arguments, sizeof arguments, "--from %s/made/tradeoff.html --knob png --output %s/said", own->name,
             own->name);
    said = run(0, arguments);
    file_write_text(place_in(own, "right.md").path, said);
    *strstr(said, " differ after") = '-';
    file_write_text(place_in(own, "wrong.md").path, said);
    free(said);
    run_in(own, 0, "--from %s/made/tradeoff.html --knob png --check %s/right.md", "");
    run_in(own, 1, "--from %s/made/tradeoff.html --knob png --check %s/wrong.md", "lacks the sentence");
}

static void bad_input_is_refused_with_a_sentence(void **state)
{
    temp_folder *own = *state;
    file_write_text(place_in(own, "other.html").path, "<p>no page</p>");
    run_in(own, 2, "--from %s/other.html", "is not a page of octree-tradeoff");
    run_in(own, 2, "--from %s/missing.html", "No such file");
    run_in(own, 2, "--check %s/right.md", "--from PAGE");
    size_t size;
    char *page = file_read(place_in(own, "made/tradeoff.html").path, &size);
    strstr(page, "csv-png\">\nscene,variant,setting")[31] = 'x';
    file_write_text(place_in(own, "columns.html").path, page);
    run_in(own, 2, "--from %s/columns.html --output %s/columns", "has other columns");
    free(page);
    page = file_read(place_in(own, "made/tradeoff.html").path, &size);
    *strstr(strstr(page, "csv-index"), "octreel,0,") = '\0';
    file_write_text(place_in(own, "cut.html").path, page);
    run_in(own, 2, "--from %s/cut.html --output %s/cut", "is cut off");
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_page_is_made_again_from_its_figures),
        cmocka_unit_test(a_reader_finds_charts_tables_and_examples),
        cmocka_unit_test(a_text_is_checked_against_the_figures),
        cmocka_unit_test(bad_input_is_refused_with_a_sentence),
    };
    return cmocka_run_group_tests(tests, make_page, nested_folder_remove);
}
