/* SPDX-License-Identifier: MIT */
/* test_cli_audit.c - octreel audit compares the answers of a foreign index with exact ones, and recordings keep both.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "edits.h"
#include "files.h"
#include "fixture.h"
#include "recordings.h"
#include "tick_lines.h"
#include "xml_check.h"

/* Point 2 is removed in tick 2. */
#define START                                                                                                          \
    "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,2],[0,3,0,3]],\"ticks\":3}\n"
#define FIRST                                                                                                          \
    "{\"tick\":1,\"queries\":[{\"nearest\":[0,0,0],\"answer\":[1]},{\"radius\":3,\"at\":[0,0,0],\"answer\":[3,2,1]}]}" \
    "\n"
#define SECOND(nearest, ball)                                                                                          \
    "{\"tick\":2,\"edits\":[{\"remove\":2}],\"queries\":[{\"nearest\":[2,0,0],\"answer\":" nearest                     \
    "},{\"radius\":3,\"at\":[0,0,0],\"answer\":" ball "}]}\n"

static const char right[] = START FIRST SECOND("[1]", "[1,3]");
static const char wrong[] = START FIRST SECOND("[3]", "[1,2]");

static place write_session_text(void **state, const char *text)
{
    const place session = place_in(*state, "session.json");
    file_write_text(session.path, text);
    return session;
}

static void exit_status_is_0_if_all_answers_are_right(void **state)
{
    const place session = write_session_text(state, right);
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, ": 4 answers in 4 ticks, all right\n"
                                       "nearest: 2 asked, 0 wrong, recall 1, ratio of distances 1 at worst, 99th "
                                       "percentile 1\n"
                                       "radius: 2 asked, 0 wrong, recall 1, 0 missing, 0 extra\n"));
    command_release(&result);
}

static void wrong_answers_are_counted_and_exit_status_is_1(void **state)
{
    const place session = write_session_text(state, wrong);
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_int_equal(result.status, 1);
    assert_string_equal(result.err, "");
    assert_non_null(strstr(result.out, ": 4 answers in 4 ticks, 2 wrong\n"));
    assert_non_null(strstr(result.out,
                           "nearest: 2 asked, 1 wrong, recall 0.5, ratio of distances 3.60555 at worst, 99th "
                           "percentile 3.60555; first wrong at tick 2; 1 time: a neighbour too far away\n"));
    assert_non_null(strstr(result.out,
                           "  tick 2, answers[0]: a neighbour too far away; wrong from rank 1 on; ratio of "
                           "distances 3.60555; 1 missing, 1 extra; missing 1 at (1, 0, 0); extra 3 at (0, 3, "
                           "0)\n    {\"nearest\": {\"target\": [2, 0, 0]"));
    assert_non_null(strstr(
        result.out,
        "radius: 2 asked, 1 wrong, recall 0.8, 1 missing, 0 extra; first wrong at tick 2; 1 time: names an id "
        "that no point "
        "has\n"
        "  tick 2, answers[1]: names an id that no point has (2); 1 missing, 0 extra; missing 3 at (0, 3, 0); the "
        "missing point lies on the boundary of the ball; if the index excludes it, ask with \"bounds\": \"open\"\n"));
    command_release(&result);
}

static void json_output_is_one_object(void **state)
{
    const place session = write_session_text(state, wrong);
    command_result result = run_octreel(NULL, "audit %s --json", session.path);
    assert_int_equal(result.status, 1);
    json_t *all = json_read(result.out), *kinds = json_object_get(all, "kinds");
    const json_t *nearest = json_object_get(kinds, "nearest"), *radius = json_object_get(kinds, "radius");
    assert_true(json_is_false(json_object_get(all, "right")) && json_object_size(kinds) == 2);
    assert_true(json_number_value(json_object_get(nearest, "first_wrong_tick")) == 2);
    const json_t *worst = json_array_get(json_object_get(radius, "worst"), 0);
    assert_string_equal(json_string_value(json_object_get(worst, "wrong")), "unknown");
    assert_non_null(json_object_get(json_object_get(json_object_get(worst, "answer"), "radius"), "judged"));
    json_decref(all);
    command_release(&result);
}

/* ---- The boundary --------------------------------------------------------------------------------------------- */

/* The answer of an index that tests "distance < 3", and of one that excludes only a part of the boundary. Points 3, 4
 * and 5 lie on the boundary of the ball; point 5 lies on the boundary of the box, and point 2 inside it. */
#define BOUNDARY(bounds)                                                                                               \
    "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,2],[0,3,0,3],[0,0,-3,4],"     \
    "[2,2,1,5]],\"ticks\":1,\"queries\":[{\"radius\":3,\"at\":[0,0,0]," bounds "\"answer\":[1,2]}]}\n"                 \
    "{\"tick\":1,\"queries\":[{\"radius\":3,\"at\":[0,0,0]," bounds "\"answer\":[1,2,4]},"                             \
    "{\"range\":{\"min\":[1.5,-9,-9],\"max\":[9,9,1]}," bounds "\"answer\":[2]}]}\n"

static const char boundary_closed[] = BOUNDARY(""), boundary_open[] = BOUNDARY("\"bounds\":\"open\","),
                  boundary_either[] = BOUNDARY("\"bounds\":\"either\",");

static void answers_with_their_bounds_are_right(void **state)
{
    place session = write_session_text(state, boundary_either);
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_done(&result);
    assert_contains(result.out, ": 4 answers in 2 ticks, all right\n");
    command_release(&result);
    session = write_session_text(state, boundary_open);
    result = run_octreel(NULL, "audit %s", session.path);
    assert_int_equal(result.status, 1);
    assert_contains(result.out, ": 4 answers in 2 ticks, 1 wrong\n");
    assert_contains(result.out, "; the extra point lies on the boundary of the ball; if the index includes only a part "
                                "of the boundary, ask with \"bounds\": \"either\"");
    command_release(&result);
}

static void wrong_answers_that_differ_at_the_boundary_name_their_bounds(void **state)
{
    const place session = write_session_text(state, boundary_closed), xml = place_in(*state, "a.xml"),
                page = place_in(*state, "a.html");
    static const char open_ball[] = "; all 3 missing points lie on the boundary of the ball; if the index excludes it, "
                                    "ask with \"bounds\": \"open\"",
                      mixed_ball[] = "; all 2 missing points lie on the boundary of the ball; if the index includes "
                                     "only a part of the boundary, ask with \"bounds\": \"either\"",
                      open_box[] = "; the missing point lies on the boundary of the box; if the index excludes it, ask "
                                   "with \"bounds\": \"open\"";
    command_result result = run_octreel(NULL, "audit %s --junit %s --html %s", session.path, xml.path, page.path);
    assert_int_equal(result.status, 1);
    char *junit = file_read(xml.path, NULL), *html = file_read(page.path, NULL);
    const char *const reports[] = {result.out, junit, html};
    for (int i = 0; i < 3; i++) {
        assert_contains(reports[i], open_ball);
        assert_contains(reports[i], mixed_ball);
        assert_contains(reports[i], open_box);
        assert_contains(reports[i], "; 3 times: wrong only on the boundary of the ball");
    }
    assert_xml_count(junit, "failure", 2);
    free(junit);
    free(html);
    command_release(&result);
}

static void json_output_names_the_accepting_bounds(void **state)
{
    const place session = write_session_text(state, boundary_closed);
    command_result result = run_octreel(NULL, "audit %s --json", session.path);
    json_t *all = json_read(result.out);
    const json_t *radius = json_object_get(json_object_get(all, "kinds"), "radius");
    const json_t *worst = json_object_get(radius, "worst");
    static const char *const accepting[] = {"open", "open", "either"};
    assert_int_equal(json_number_value(json_object_get(radius, "on_boundary")), 3);
    for (size_t i = 0; i < 3; i++) {
        const json_t *c = json_array_get(worst, i);
        assert_string_equal(json_string_value(json_object_get(c, "on_boundary")), "missing");
        assert_string_equal(json_string_value(json_object_get(c, "accepting_bounds")), accepting[i]);
    }
    json_decref(all);
    command_release(&result);
}

/* ---- A gate --------------------------------------------------------------------------------------------------- */

/* Of two answers for each kind of query one is wrong: a point 3.6 times as far, and an unknown id. */
static void errors_within_limits_pass_and_are_reported(void **state)
{
    static const char farther[] = START FIRST SECOND("[3]", "[1,3]"), missing[] = START FIRST SECOND("[1]", "[1]"),
                      none[] = START FIRST SECOND("[]", "[1,3]");
    static const struct {
        const char *session, *allowed;
        int status;
    } runs[] = {
        {farther, "ratio=3.7", 0},
        {farther, "ratio=3.6", 1},
        {farther, "recall=0.5", 0},
        {farther, "recall=0.51", 1},
        {farther, "ratio=3.7,recall=0.51", 1},
        {missing, "recall=0.8", 0},
        {missing, "recall=0.9", 1},
        {missing, "ratio=9", 1},
        {none, "ratio=9,recall=0", 1},
        {none, "recall=0", 0},
        {wrong, "ratio=9,recall=0", 1}, /* the unknown id */
        {right, "recall=1,ratio=1", 0},
    };
    for (size_t i = 0; i < sizeof runs / sizeof runs[0]; i++) {
        const place session = write_session_text(state, runs[i].session);
        command_result result = run_octreel(NULL, "audit %s --allow %s", session.path, runs[i].allowed);
        if (result.status != runs[i].status)
            fail_msg("%zu: --allow %s ends with %d: %s", i, runs[i].allowed, result.status, result.out);
        assert_non_null(
            strstr(result.out, runs[i].status ? ", beyond the allowed limits\n" : ", within the allowed limits\n"));
        assert_non_null(strstr(result.out, "\nallowed: "));
        command_release(&result);
    }
}

static void invalid_limits_are_refused(void **state)
{
    static const char *const bad[] = {
        "ratio=0.9",       "recall=1.1",  "recall=-0.1",
        "ratio=nan",       "ratio=inf",   "ratio",
        "ratio=1,",        "''",          "other=1",
        "ratio=1,ratio=2", "recall=",     "ratio=1=2",
        ",recall=1",       "recall=0.9x", "ratio=1.000000000000000000000000000000000000000000000000000000000000000"};
    const place session = write_session_text(state, right);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        command_result result = run_script("%s audit %s --allow %s", octreel_program(), session.path, bad[i]);
        assert_trouble(&result, "--allow: expected a ratio of at least 1, a recall from 0 to 1, or both");
    }
}

/* ---- Files ----------------------------------------------------------------------------------------------------- */

static void junit_has_a_case_for_each_query_kind(void **state)
{
    const place session = write_session_text(state, wrong), xml = place_in(*state, "a.xml");
    command_result result = run_octreel(NULL, "audit %s --allow ratio=4 --junit %s", session.path, xml.path);
    assert_int_equal(result.status, 1);
    command_release(&result);
    char *text = file_read(xml.path, NULL);
    assert_xml_attribute(text, "testcase", 1, "name", "radius");
    assert_xml_count(text, "testcase", 2);
    assert_xml_count(text, "failure", 1);
    assert_non_null(strstr(text, "<testsuites name=\"octreel audit\" tests=\"2\" failures=\"1\" errors=\"0\""));
    assert_non_null(strstr(text, "tick 2, answers[1]: names an id that no point has (2)"));
    free(text);
}

/* Refused: to overwrite the session, to write into a missing folder, and two reports in one file. */
static void reports_overwrite_no_input_and_no_other_report(void **state)
{
    const place session = write_session_text(state, right), file = place_in(*state, "a");
    command_result result = run_octreel(NULL, "audit %s --html %s", session.path, session.path);
    assert_trouble(&result, "--html takes the name of an HTML file, such as report.html, or of a folder, not \"");
    result = run_octreel(NULL, "audit %s --html %s.html --junit %s.html", session.path, file.path, file.path);
    assert_trouble(&result, "--junit");
    result = run_octreel(NULL, "audit %s --html - --json", session.path);
    assert_trouble(&result, "only one output can go to standard output");
    result = run_octreel(NULL, "audit %s --html %s/none/a.html", session.path, file.path);
    assert_trouble(&result, "none/a.html");
    char *text = file_read(session.path, NULL);
    assert_string_equal(text, right);
    free(text);
}

/* A name without a suffix is a folder, as for octreel diff -o: a browser would not show a page without one. */
static void missing_folder_of_the_page_is_made(void **state)
{
    static const char *const names[] = {"report", "new/deep/"};
    const place session = write_session_text(state, right), none = place_in(*state, "none");
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const place folder = place_in(*state, names[i]);
        command_result result = run_octreel(NULL, "audit %s --html %s", session.path, folder.path);
        assert_done(&result);
        command_release(&result);
        assert_true(file_exists(place_below(folder.path, "audit.html").path));
    }
    command_result result = run_octreel(NULL, "audit %s --html %s/report", none.path, none.path);
    assert_trouble(&result, "no such file");
    assert_false(file_exists(none.path));
    result = run_octreel(NULL, "audit %s --html report.txt", session.path);
    assert_trouble(&result, "not \"report.txt\"");
}

/* Each point of the chart links to its frame, wherever the page is; a tick without a frame links to the recording's
 * page. */
static void ticks_on_the_page_link_to_their_frames(void **state)
{
    const place session = write_session_text(state, wrong), film = place_in(*state, "a film"),
                page = place_in(*state, "page.html");
    command_result result = run_script("%s record %s --size 64x48 --every 2 -o %s", octreel_program(), session.path,
                                       shell_quote(film.path).text);
    assert_done(&result);
    command_release(&result);
    result = run_script("%s audit %s --html %s; %s audit %s --html %s", octreel_program(), shell_quote(film.path).text,
                        page.path, octreel_program(), shell_quote(film.path).text, shell_quote(film.path).text);
    assert_int_equal(result.status, 1);
    command_release(&result);
    char *beside = file_read(page.path, NULL), *within = file_read(place_in(*state, "a film/audit.html").path, NULL);
    assert_non_null(strstr(beside, "<a href=\"./a%20film/frame_000002.png\"><circle class=\"point wrong\""));
    assert_non_null(strstr(beside, "<a href=\"./a%20film/index.html#t=1\"><circle class=\"point\""));
    assert_non_null(strstr(within, "<a href=\"./frame_000002.png\"><circle"));
    assert_non_null(strstr(within, "<title>tick 2: ratio 3.60555, 1 of 1 wrong</title>"));
    assert_non_null(strstr(within, "<li>tick 2 (<a href=\"./frame_000002.png\">frame</a>, <a "
                                   "href=\"./index.html#t=2&amp;select=point+1\">page</a>), answers[0]: a neighbour"));
    assert_null(strstr(within, "<script"));
    free(beside);
    free(within);
}

/* The link is relative to the folder of the page, however the two paths are written. */
static void page_in_another_folder_links_to_the_recording(void **state)
{
    static const char *const pages[][2] = {
        {"pages/deep/a.html", "./../../x/film/"}, {"pages/../pages/.//deep/b.html", "./../../x/film/"},
        {"x/fil/c.html", "./../film/"},           {"d.html", "./x/film/"},
        {"ab/.c/e.html", "./../../x/film/"},
    };
    const temp_folder *own = *state;
    write_session_text(state, wrong);
    command_result result =
        run_script("cd %s && mkdir -p pages/deep x/fil ab/.c && %s record session.json --size 64x48 -o "
                   "x/film",
                   own->name, octreel_program());
    assert_done(&result);
    command_release(&result);
    for (size_t i = 0; i < sizeof pages / sizeof pages[0]; i++) {
        char link[80];
        result = run_script("cd %s && %s audit x/film --html %s", own->name, octreel_program(), pages[i][0]);
        assert_int_equal(result.status, 1);
        command_release(&result);
        char *page = file_read(place_in(own, pages[i][0]).path, NULL);
        snprintf(link, sizeof link, "<a href=\"%sframe_000002.png\"><circle class=\"point wrong\"", pages[i][1]);
        if (!strstr(page, link))
            fail_msg("%s has no %s", pages[i][0], link);
        free(page);
    }
    result = run_script("cd %s && %s audit x/film --html \"/..$PWD/f.html\"", own->name, octreel_program());
    assert_int_equal(result.status, 1);
    command_release(&result);
    char *page = file_read(place_in(own, "f.html").path, NULL);
    assert_non_null(strstr(page, "<a href=\"./x/film/frame_000002.png\">"));
    free(page);
}

static void tick_without_frame_and_viewer_has_no_link(void **state)
{
    const place session = write_session_text(state, wrong), film = place_in(*state, "film");
    command_result result = run_script(
        "%s record -q %s --size 64x48 -o %s && rm %s/index.html %s/frame_000002.png && exec %s audit %s --html -",
        octreel_program(), session.path, film.path, film.path, film.path, octreel_program(), film.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "frame_000001.png\"><circle class=\"point\""));
    assert_null(strstr(result.out, "frame_000002.png"));
    assert_null(strstr(result.out, "index.html"));
    assert_non_null(strstr(result.out, "<li>tick 2, answers[0]: "));
    command_release(&result);
}

static void page_of_a_session_has_no_links_and_says_so(void **state)
{
    const place session = place_in(*state, "<b>&.json");
    file_write_text(session.path, wrong);
    command_result result = run_script("%s audit %s --html -", octreel_program(), shell_quote(session.path).text);
    assert_int_equal(result.status, 1);
    assert_null(strstr(result.out, "<a "));
    assert_null(strstr(result.out, "<b>"));
    assert_non_null(strstr(result.out, "This session has no frames"));
    command_release(&result);
}

/* In a long session one point of the chart stands for several ticks: the worst of them. */
static void chart_of_many_ticks_keeps_the_worst_tick(void **state)
{
    const place session = place_in(*state, "session.json");
    FILE *out = fopen(session.path, "w");
    size_t points = 0;
    assert_non_null(out);
    fprintf(out, "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,2]]}\n");
    for (int tick = 1; tick <= 1001; tick++)
        fprintf(out, "{\"tick\":%d,\"queries\":[{\"nearest\":[%d,0,0],\"answer\":[1]}]}\n", tick, tick == 777);
    fprintf(out, "{\"tick\":1002,\"queries\":[{\"nearest\":[1,0,0],\"answer\":[2]}]}\n");
    assert_int_equal(fclose(out), 0);
    command_result result = run_octreel(NULL, "audit %s --html -", session.path);
    assert_int_equal(result.status, 1);
    for (const char *at = result.out; (at = strstr(at, "<circle")); at++)
        points++;
    assert_int_equal(points, 2 * 400);
    assert_non_null(strstr(result.out, "<title>tick 1002: ratio infinite, 1 of 1 wrong"));
    assert_non_null(strstr(result.out, "text-anchor=\"end\">infinite</text>"));
    assert_non_null(strstr(result.out, "<title>tick 1002: recall 0, 1 of 1 wrong"));
    command_release(&result);
}

/* Wrong nodes are a finding, whatever --allow says about answers. */
static void wrong_nodes_are_a_finding(void **state)
{
    const place session =
        write_session_text(state, START "{\"tick\":1,\"foreign_nodes\":[{\"id\":1,\"box\":{\"min\":[0,0,0],\"max\":"
                                        "[9,9,9]},\"points\":[1,2]}]}\n");
    command_result result = run_octreel(NULL, "audit %s --allow recall=0", session.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "0 answers in 4 ticks, 3 wrong nodes, beyond the allowed limits; wrong nodes "
                                       "are never allowed\n"));
    assert_non_null(strstr(result.out, "nodes: 3 wrong in 3 ticks, first at tick 1; 3 times: a point is in no node "
                                       "(tick 1, point 3)"));
    command_release(&result);
    result = run_octreel(NULL, "audit %s --junit -", session.path);
    assert_xml_count(result.out, "testcase", 1);
    assert_xml_count(result.out, "failure", 1);
    command_release(&result);
}

/* JSON has the same counts as the text; correct nodes are no finding. */
static void json_counts_wrong_nodes_by_kind(void **state)
{
#define NODES(points)                                                                                                  \
    START "{\"tick\":1,\"foreign_nodes\":[{\"id\":1,\"box\":{\"min\":[0,0,0],\"max\":[9,9,9]},\"points\":" points      \
          "}]}\n"
    const place session = write_session_text(state, NODES("[1,2]"));
    command_result result = run_octreel(NULL, "audit %s --json --allow ratio=2,recall=0.5", session.path);
    assert_int_equal(result.status, 1);
    json_t *all = json_read(result.out);
    const json_t *nodes = json_object_get(all, "nodes"), *allowed = json_object_get(all, "allowed");
    assert_true(json_is_false(json_object_get(all, "right")) && json_is_false(json_object_get(all, "passes")));
    assert_true(json_number_value(json_object_get(nodes, "faults")) == 3);
    assert_true(json_number_value(json_object_get(nodes, "first_wrong_tick")) == 1);
    assert_int_equal(json_object_size(nodes), 3);
    assert_true(json_number_value(json_object_get(allowed, "ratio")) == 2);
    assert_true(json_number_value(json_object_get(allowed, "recall")) == 0.5);
    json_decref(all);
    command_release(&result);
    write_session_text(state, NODES("[1,2,3]"));
    result = run_octreel(NULL, "audit %s --json", session.path);
    assert_done(&result);
    all = json_read(result.out);
    assert_true(json_is_true(json_object_get(all, "right")) && !json_object_get(all, "allowed"));
    assert_int_equal(json_object_size(json_object_get(all, "nodes")), 1);
    json_decref(all);
    command_release(&result);
    result = run_octreel(NULL, "audit %s --html - --allow ratio=1", session.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, "<section><h2>nodes</h2>\n<p>nodes: 0 wrong</p>\n</section>"));
    assert_non_null(strstr(result.out, "ratio of distances up to 1"));
    command_release(&result);
    result = run_octreel(NULL, "audit %s", session.path);
    assert_non_null(strstr(result.out, "\nnodes: 0 wrong\n"));
    command_release(&result);
}

/* At most four missing points are named. */
static void long_lists_of_missing_points_are_counted(void **state)
{
    const place session = write_session_text(
        state,
        "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,2],[3,0,0,3],"
        "[4,0,0,4],[5,0,0,5]],\"ticks\":2}\n{\"tick\":1,\"queries\":[{\"radius\":9,\"at\":[0,0,0],\"answer\":[]},"
        "{\"knearest\":1,\"at\":[0,0,0],\"answer\":[1,2]}]}\n");
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "; 5 missing, 0 extra; missing 1 at (1, 0, 0), 2 at (2, 0, 0), 3 at (3, 0, 0), "
                                       "4 at (4, 0, 0) and 1 more\n"));
    assert_non_null(strstr(result.out, "a wrong number of neighbours (2 named, 1 expected)"));
    command_release(&result);
    result = run_octreel(NULL, "audit %s --allow recall=0", session.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "\nallowed: recall of at least 0\n"));
    command_release(&result);
}

/* Record a session with wrong answers, audit the recording, and return the audit's page, which the caller frees. */
static char *film_and_audit(void **state, const place *session)
{
    const place film = place_in(*state, "film");
    command_result result = run_octreel(NULL, "record %s --size 64x48 -o %s", session->path, film.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "audit %s --html %s", film.path, film.path);
    assert_int_equal(result.status, 1);
    command_release(&result);
    return file_read(place_in(*state, "film/audit.html").path, NULL);
}

/* The first wrong node of each kind links to its tick. */
static void wrong_nodes_link_to_their_ticks(void **state)
{
    const place session =
        write_session_text(state, START "{\"tick\":1,\"foreign_nodes\":[{\"id\":7,\"box\":{\"min\":[0,0,0],\"max\":"
                                        "[9,9,9]},\"points\":[1,2,2]}]}\n");
    char *page = film_and_audit(state, &session);
    assert_non_null(strstr(page, "<li>3 times: it lists a point more than once (tick 1, node 7, point 2) (<a "
                                 "href=\"./frame_000001.png\">frame</a>, <a "
                                 "href=\"./index.html#t=1&amp;select=foreign+7\">page</a>)</li>"));
    free(page);
}

/* All points are in the answer. */
static void page_rounds_numbers_for_people(void **state)
{
    static const char text[] = "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":"
                               "[[0.1234567890123456,0,0,1],[1,0,0,2]],\"queries\":"
                               "[{\"nearest\":[0,0,0],\"answer\":[2]}]}";
    const place session = write_session_text(state, text);
    command_result result = run_octreel(NULL, "audit %s --html -", session.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "missing 1 at (0.123456789, 0, 0)"));
    assert_non_null(strstr(result.out, "<details><summary>as in ticks.jsonl</summary><pre>{"));
    command_release(&result);
}

/* Points 1 and 4 are at one position. The pairs are right in tick 0 and wrong in three others. */
static const char pairs[] =
    "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,2],[1,0,0,4]],\"ticks\":3}\n"
    "{\"tick\":0,\"pairs\":[[4,1]]}\n{\"tick\":1,\"pairs\":[[1,2],[1,4],[4,2]]}\n{\"tick\":2,\"pairs\":[]}\n"
    "{\"tick\":3,\"pairs\":[[1,9],[1,4],[4,1]]}\n";
#define PAIRS_LINE                                                                                                     \
    "pairs: 4 asked, 3 wrong, recall 0.75, 1 missing, 2 extra; first wrong at tick 1; 1 time: names an id that no "    \
    "body has; 1 time: pairs are missing; 1 time: pairs that do not overlap"
#define EXTRA_PAIRS                                                                                                    \
    "tick 1, foreign_pairs: pairs that do not overlap; 0 missing, 2 extra\n    {\"given\": [[1, 2], [1, 4], [2, 4]], " \
    "\"wrong\": \"extra\", \"expected\": 1, \"extra\": [[1, 2], [2, 4]]}\n"

static void wrong_pairs_are_reported_and_exit_status_is_1(void **state)
{
    const place session = write_session_text(state, pairs), film = place_in(*state, "film");
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, ": 4 answers in 4 ticks, 3 wrong\n" PAIRS_LINE "\n  " EXTRA_PAIRS));
    assert_non_null(strstr(result.out, "  tick 2, foreign_pairs: pairs are missing; 1 missing, 0 extra\n"));
    command_release(&result);
    result = run_octreel(NULL, "audit %s --junit -", session.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "name=\"pairs\""));
    assert_non_null(strstr(result.out, PAIRS_LINE "\">" PAIRS_LINE "\ntick 1, foreign_pairs: pairs that do not "));
    command_release(&result);
    char *page = film_and_audit(state, &session);
    result = run_octreel(NULL, "verify %s", film.path);
    assert_done(&result);
    command_release(&result);
    assert_non_null(strstr(page, "<section class=\"fails\"><h2>pairs</h2>\n<p>" PAIRS_LINE "</p>"));
    assert_non_null(strstr(page, "<li>tick 1 (<a href=\"./frame_000001.png\">frame</a>, <a "
                                 "href=\"./index.html#t=1\">page</a>), foreign_pairs: pairs that do not overlap; "));
    free(page);
}

static void audit_of_pairs_is_in_the_json(void **state)
{
    const place session = write_session_text(state, pairs);
    command_result result = run_octreel(NULL, "audit %s --json", session.path);
    assert_int_equal(result.status, 1);
    json_t *all = json_read(result.out), *found = json_object_get(json_object_get(all, "kinds"), "pairs");
    assert_true(json_is_false(json_object_get(all, "right")) && json_is_false(json_object_get(found, "passes")));
    assert_true(json_number_value(json_object_get(all, "wrong")) == 3);
    assert_true(json_number_value(json_object_get(found, "recall")) == 0.75);
    assert_true(json_object_size(json_object_get(found, "faults")) == 3);
    const json_t *worst = json_array_get(json_object_get(found, "worst"), 0);
    assert_string_equal(json_string_value(json_object_get(worst, "wrong")), "extra");
    assert_null(json_object_get(worst, "place"));
    assert_true(json_array_size(json_object_get(json_object_get(worst, "answer"), "extra")) == 2);
    json_decref(all);
    command_release(&result);
}

/* A limit of the recall allows missing pairs, but no other errors. */
static void recall_allows_missing_pairs(void **state)
{
    static const char *const rows[] = {"\"pairs\":[]", "\"pairs\":[[1,2]]", "\"pairs\":[[1,4],[4,1]]"};
    for (int i = 0; i < 3; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "{\"octreel\":\"session\",\"version\":2,\"player\":null,\"points\":[[1,0,0,1],[2,0,0,2],[1,0,0,4]]}\n"
                 "{\"tick\":0,%s}\n{\"tick\":1,\"pairs\":[[1,4]]}\n",
                 rows[i]);
        const place session = write_session_text(state, text);
        command_result result = run_octreel(NULL, "audit %s --allow recall=0.5", session.path);
        assert_int_equal(result.status, i > 0);
        command_release(&result);
    }
}

/* The list of each tick is right. */
static void right_pairs_have_exit_status_0(void **state)
{
    const place session = write_session_text(state, START "{\"tick\":1,\"pairs\":[]}\n{\"tick\":2,\"pairs\":[]}\n");
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, ": 2 answers in 4 ticks, all right\n"
                                       "pairs: 2 asked, 0 wrong, recall 1, 0 missing, 0 extra\n"));
    command_release(&result);
}

static void session_without_answers_is_refused(void **state)
{
    const place session = write_session_text(state, START "{\"tick\":1,\"queries\":[{\"nearest\":[0,0,0]}]}");
    command_result result = run_octreel(NULL, "audit %s", session.path);
    assert_trouble(&result, "session.json: nothing to audit: the played ticks have neither foreign nodes nor \"pairs\" "
                            "nor a query with an \"answer\"");
    result = run_octreel(NULL, "audit %s.none", session.path);
    assert_trouble(&result, "no such file");
}

/* The recording has the answers in session.json and their judgements in ticks.jsonl; it verifies, and its audit equals
 * that of the session. */
static void recording_keeps_answers_and_their_judgements(void **state)
{
    const place session = write_session_text(state, wrong), folder = place_in(*state, "film");
    command_result result = run_octreel(NULL, "record %s --size 64x48 -o %s", session.path, folder.path);
    assert_done(&result);
    assert_non_null(strstr(result.out, ", wrong 1\n"));
    command_release(&result);
    char *ticks = file_read(place_in(*state, "film/ticks.jsonl").path, NULL);
    assert_non_null(strstr(ticks, "\"events\": [\"wrong\"]"));
    assert_non_null(strstr(ticks,
                           "\"judged\": {\"answer\": [3], \"wrong\": \"farther\", \"expected\": 1, \"missing\": [1], "
                           "\"extra\": [3], \"rank\": 1, \"ratio\": 3.605551275463989}"));
    assert_non_null(strstr(ticks,
                           "\"judged\": {\"answer\": [1, 2], \"wrong\": \"unknown\", \"wrong_id\": 2, \"expected\": 2, "
                           "\"missing\": [3]}"));
    assert_non_null(strstr(ticks, "\"judged\": {\"answer\": [3, 2, 1], \"wrong\": \"none\", \"expected\": 3}"));
    free(ticks);
    result = run_octreel(NULL, "verify %s", folder.path);
    assert_done(&result);
    command_release(&result);
    result = run_octreel(NULL, "audit %s", folder.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "2 wrong"));
    command_release(&result);
}

/* The program was corrected: only its answers change, and with them the judgements. */
static void diff_names_answers_that_became_wrong(void **state)
{
    const place a = place_in(*state, "a"), b = place_in(*state, "b");
    const char *const texts[] = {START FIRST SECOND("[1]", "[1,3]"), START FIRST SECOND("[3]", "[1,3]")};
    for (int i = 0; i < 2; i++) {
        const place session = write_session_text(state, texts[i]);
        command_result result = run_octreel(NULL, "record %s --size 64x48 -o %s", session.path, i ? b.path : a.path);
        assert_done(&result);
        command_release(&result);
    }
    command_result result = run_octreel(NULL, "diff %s %s", a.path, b.path);
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.out, "another foreign answer in the nearest query ((3), was (1))"));
    assert_non_null(strstr(result.out, "1 more wrong answer at tick 2; "));
    assert_non_null(
        strstr(result.out, "another judgement of the foreign answer in the nearest query (farther, was none)"));
    command_release(&result);
    result = run_octreel(NULL, "diff %s %s --json", a.path, b.path);
    json_t *all = json_read(result.out);
    const json_t *more = json_object_get(json_object_get(json_object_get(all, "cause"), "wrong_answers"), "more");
    assert_true(json_number_value(json_object_get(more, "count")) == 1);
    assert_true(json_number_value(json_object_get(more, "first")) == 2);
    json_decref(all);
    command_release(&result);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(exit_status_is_0_if_all_answers_are_right),
        IN_FOLDER(wrong_answers_are_counted_and_exit_status_is_1),
        IN_FOLDER(json_output_is_one_object),
        IN_FOLDER(answers_with_their_bounds_are_right),
        IN_FOLDER(wrong_answers_that_differ_at_the_boundary_name_their_bounds),
        IN_FOLDER(json_output_names_the_accepting_bounds),
        IN_FOLDER(errors_within_limits_pass_and_are_reported),
        IN_FOLDER(invalid_limits_are_refused),
        IN_FOLDER(junit_has_a_case_for_each_query_kind),
        IN_FOLDER(reports_overwrite_no_input_and_no_other_report),
        IN_FOLDER(missing_folder_of_the_page_is_made),
        IN_FOLDER(ticks_on_the_page_link_to_their_frames),
        IN_FOLDER(page_in_another_folder_links_to_the_recording),
        IN_FOLDER(tick_without_frame_and_viewer_has_no_link),
        IN_FOLDER(page_of_a_session_has_no_links_and_says_so),
        IN_FOLDER(chart_of_many_ticks_keeps_the_worst_tick),
        IN_FOLDER(wrong_nodes_are_a_finding),
        IN_FOLDER(json_counts_wrong_nodes_by_kind),
        IN_FOLDER(long_lists_of_missing_points_are_counted),
        IN_FOLDER(wrong_nodes_link_to_their_ticks),
        IN_FOLDER(page_rounds_numbers_for_people),
        IN_FOLDER(wrong_pairs_are_reported_and_exit_status_is_1),
        IN_FOLDER(audit_of_pairs_is_in_the_json),
        IN_FOLDER(recall_allows_missing_pairs),
        IN_FOLDER(right_pairs_have_exit_status_0),
        IN_FOLDER(session_without_answers_is_refused),
        IN_FOLDER(recording_keeps_answers_and_their_judgements),
        IN_FOLDER(diff_names_answers_that_became_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
