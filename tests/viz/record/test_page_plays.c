/* SPDX-License-Identifier: MIT */
/* test_page_plays.c - index.html in headless Chromium plays the session itself: the ticks, scenes and pixels of the
 * recording in any order; picks, queries and saved sessions agree with the program. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "browser.h"
#include "driven_page.h"
#include "fixture.h"
#include "game_fixture.h"
#include "played_page.h"
#include "recordings.h"
#include "session_file.h"
#include "session_texts.h"
#include "text.h"
#include "ticks_write.h"

enum { LAST = 252 }; /* last tick of the default session */

/* A recording of the default session, and the reports of its page from drive_plays.js. */
typedef struct driven {
    void *folder; /* a temp_folder */
    char *said;   /* null if the page cannot play */
} driven;

static int drive_page(void **state)
{
    driven *d = calloc(1, sizeof *d);
    *state = d;
    if (!d || temp_folder_make(&d->folder) != 0)
        return -1;
    const place film = place_in(d->folder, "film"), page = place_below(film.path, "index.html");
    const octree_session session = octree_session_default();
    const film_options options = small_film(film.path);
    assert_filmed(&session, &options);
    d->said = run_scripts_in_playing_page(d->folder, page.path, (const char *const[]){"drive_plays.js", NULL});
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

static const driven *need_page(void **state)
{
    const driven *d = *state;
    skip_without_playing_page(place_below(place_in(d->folder, "film").path, "index.html").path);
    return d;
}

/* ---- Ticks -------------------------------------------------------------------------------------------------- */

static void page_plays_the_ticks_of_the_recording_in_any_order(void **state)
{
    const driven *d = need_page(state);
    assert_reported_value(d->said, "plays by itself", "true");
    assert_reported_value(d->said, "begins with its memory in use", "true"); /* malloc() may use the rest */
    assert_reported_ticks(d->said, "tick", place_in(d->folder, "film").path, LAST + 1, false);
}

static void random_gestures_change_no_tick_and_raise_no_error(void **state)
{
    const driven *d = need_page(state);
    assert_reported_ticks(d->said, "again", place_in(d->folder, "film").path, LAST + 1, true);
    assert_reported_value(d->said, "errors", "");
}

/* ---- Questions ---------------------------------------------------------------------------------------------- */

static void click_names_the_element_that_pick_names(void **state)
{
    const driven *d = need_page(state);
    const place frame = frame_place(place_in(d->folder, "film").path, 219);
    int picks = 0;
    for (const char *at = d->said; (at = strstr(at, "\npick ")) != NULL; picks++) {
        int x, y;
        at += strlen("\npick ");
        assert_int_equal(sscanf(at, "%d %d", &x, &y), 2);
        char *said = strndup(strchr(at, '\t') + 1, strcspn(strchr(at, '\t') + 1, "\n"));
        assert_reported_pick(said, frame.path, x, y, 3);
        free(said);
    }
    assert_int_equal(picks, 40);
}

static void inspector_tells_positions_and_counts_of_a_played_tick(void **state)
{
    const driven *d = need_page(state);
    assert_reported_value(d->said, "told 6",
                          "✕Key s (−y): collided with point 1 at (-50, -50, 100); step to (-50, -50, 100) taken back");
    assert_reported_value(
        d->said, "told 225",
        "→Key a (−x): the player moved to (850, 850, 850) | ⊞Node 7/7/7/0 split into 2 nodes: 3 points for capacity 2");
    assert_reported_value(d->said, "told 226",
                          "→Key w (+y): the player moved to (850, 900, 850) | ⊟Node 7/7/7/0 merged into one leaf of 2 "
                          "points; capacity 2");
}

static void links_select_nodes_and_points(void **state)
{
    static const char *const rows[][2] = {
        {"told node root", "Node root | Inner node at depth 0: 11 points in and below it | It is split: 11 points are "
                           "more than the capacity of a leaf, 2 | 1, 3, 4 and 7"},
        {"told node 7/7/7/0", "Leaf 7/7/7/0 | Leaf at depth 4: 2 points of at most 2 | Point 6 left at this tick | It "
                              "merged at tick 226, with 2 points | 7/7/7 | 7 and 8"},
        {"told node 3/4", "Node 3/4 | An empty cell: no node is here | 3"},
        {"told point 6", "Point 6 | (850, 900, 850) | 0 from the player | 7/7/7/2"},
        {"told point 10", "Point 10 | This tick has no such element"},
        {"told foreign 3", "Foreign node 3 | This tick has no such element"},
        {"told query 1", "Query 1: Nearest to (-50, 0, 100) | 1 point found; 4 nodes visited (2 leaves), 4 points "
                         "compared, 2 nodes pruned | 1 | 50 | (-50, -50, 100)"},
        {"address of query 1", "#t=7&select=query+1"},
        {"told query 2", "Query 2 | This tick has no such element"},
        {"marked node root", "[0,0,0]"},
        {"marked point 6", "[850,900,850]"},
        {"marked point 10", "null"},
        {"followed links", "Leaf 7/7/7/0"},
    };
    const driven *d = need_page(state);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_reported_value(d->said, rows[i][0], rows[i][1]);
}

static void queries_on_the_page_have_the_answers_of_the_library(void **state)
{
    const driven *d = need_page(state);
    assert_reported_value(d->said, "answer", "[7]");
    assert_reported_value(d->said, "closed ball", "[[7],null]");
    assert_reported_value(d->said, "open ball", "[[],\"open\"]");
    assert_reported_value(d->said, "refused", "query: range: min is above max on axis x");
    assert_reported_value(d->said, "asked nothing", "true");
}

/* The page makes a ray of the clicked pixel; the library gives the same answer to the same query. */
static void ray_through_a_pixel_has_the_answer_of_the_library(void **state)
{
    const driven *d = need_page(state);
    char *query = find_reported_value(d->said, "ray query"), *facts = find_reported_value(d->said, "ray facts"),
         *point = find_reported_value(d->said, "ray point");
    char header[1024], *line;
    snprintf(header, sizeof header, "{\"octreel\": \"session\", \"version\": 2, \"queries\": [%s]}", query);
    session_file asked = session_of_text(header);
    const octree_session session = octree_session_default();
    octree_game *game = start_game(&session);
    while (octree_game_tick(game)->number < 219)
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
    assert_int_equal(octree_game_ask(game, asked.session.queries, asked.session.query_count), OCTREE_OK);
    const octree_tick *tick = octree_game_tick(game);
    const octree_answer *answer = &tick->answers[tick->answer_count - 1];
    bool hit = false;
    for (size_t i = 0; i < answer->count; i++)
        hit |= answer->neighbors[i].point.id == strtoull(point, NULL, 10);
    assert_true(answer->kind == OCTREE_QUERY_RAY && answer->thickness == 30 && answer->k == 9 && hit);
    text_stream s;
    assert_true(text_stream_begin(&s));
    tick_write(s.stream, tick, &(tick_extras){0});
    assert_true(text_stream_end(&s, &line));
    line[strcspn(line, "\n")] = 0;
    assert_string_equal(facts, line);
    assert_reported_value(d->said, "ray title", "1");
    assert_reported_value(d->said, "ray picture", "true");
    free(line);
    free(query);
    free(facts);
    free(point);
    session_release(&asked);
    octree_game_destroy(game);
}

/* ---- Playing on --------------------------------------------------------------------------------------------- */

static void session_played_on_the_page_records_the_same(void **state)
{
    const driven *d = need_page(state);
    const place film = place_in(d->folder, "played");
    octreel_error error;
    session_file session;
    assert_reported_value(d->said, "taken", "41 of 41");
    assert_reported_value(d->said, "taken again", "36 of 36");
    assert_reported_value(d->said, "bar before", "; ");
    assert_reported_value(
        d->said, "bar taken",
        "Back to the recording; Played on from tick 30; the session's own later ticks are left out: wwdnee");
    char *text = find_reported_value(d->said, "session");
    if (!session_parse("the session", "", text, strlen(text), &session, &error))
        fail_msg("%s", error.text);
    const film_options options = small_film(film.path);
    assert_filmed(&session.session, &options);
    assert_reported_ticks(d->said, "taken", film.path, 37, false);
    assert_reported_value(d->said, "given back", "36 of 252");
    session_release(&session);
    free(text);
}

static void unreadable_session_is_reported_and_the_old_one_stays(void **state)
{
    const driven *d = need_page(state);
    static const char *const rows[][2] = {
        {"frame.png", "true frame.png cannot be opened: not a session.json file"},
        {"newer.json", "true newer.json cannot be opened: line 1: version:"},
        {"cut.json", "true cut.json cannot be opened: line 1: "},
        {"nan.json", "true nan.json cannot be opened: line 1: "},
        {"cloud.json", "true cloud.json cannot be opened: "},
        {"huge.json", "true huge.json cannot be opened: line 1: "},
        {"label.json", "true label.json cannot be opened: line 1: "},
        {"marked", "true a?gnp?.json cannot be opened: not a session.json file"},
        {"binary", "true binary cannot be opened: not a session.json file"},
        {"large.json", "true large.json cannot be opened: larger than 256 MiB, the most that a page opens"},
        {"folder", "true folder cannot be opened: it cannot be read; if it is a folder, drop the session.json in it"},
        {"ticks.json", "false The session has 1,000,000,001 ticks; this page plays the first 100,000."},
        {"text.json", "false "},
        {"good.json", "false "},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char what[64];
        snprintf(what, sizeof what, "dropped %s", rows[i][0]);
        char *told = find_reported_value(d->said, what);
        if (strncmp(told, rows[i][1], strlen(rows[i][1])) != 0)
            fail_msg("%s: \"%s\" and not \"%s\"", what, told, rows[i][1]);
        free(told);
    }
    assert_reported_value(d->said, "long", "100000 1000000001");
    assert_reported_value(d->said, "dropped", "2 0,100,0");
}

/* ---- Many points -------------------------------------------------------------------------------------------- */

enum { MANY = 10000 };

/* Film a session with so many points that its page has them in a block. Some move, and some have colours. */
static place film_many_points(const driven *d)
{
    static octree_game_body bodies[MANY];
    static point_value rows[MANY];
    const place film = place_in(d->folder, "many");
    const point_values values = {.rows = rows, .count = MANY, .first = 100, .kinds = 1u << POINT_COLOR};
    octree_session session = octree_session_default();
    film_options options = small_film(film.path);
    for (size_t i = 0; i < MANY; i++) {
        bodies[i] = (octree_game_body){.id = i + 100, .velocity = {i % 7 == 0 ? 0.125 * (double)(i % 5) : 0}};
        for (size_t axis = 0; axis < 3; axis++)
            bodies[i].position[axis] = (double)((i + 1) * (31 + axis * 6) % 2000) - 1000 + 1 / (double)(i + 3);
        rows[i] = (point_value){.color = {(uint8_t)i, 90, (uint8_t)(i >> 8)}, .has[POINT_COLOR] = i % 3 > 0};
    }
    session.tree.full_leaf = OCTREE_GROW;
    session.bodies = bodies;
    session.body_count = MANY;
    session.keys = "wd.n";
    session.ticks = 4;
    options.values = &values;
    options.view.point_color = POINTS_BY_FILE;
    assert_filmed(&session, &options);
    return film;
}

static void many_points_are_packed_and_play_the_same(void **state)
{
    const driven *d = need_page(state);
    const place film = film_many_points(d);
    char *said = run_scripts_in_playing_page(d->folder, place_below(film.path, "index.html").path,
                                             (const char *const[]){"drive_packed.js", NULL});
    char *session = file_read(place_below(film.path, "session.json").path, NULL);
    for (char *at = session; (at = strchr(at, '\n'));)
        *at = ' ';
    assert_reported_value(said, "packed", "true true false");
    assert_reported_ticks(said, "tick", film.path, 5, false);
    assert_reported_value(said, "session", session);
    assert_reported_value(said, "errors", "");
    free(session);
    free(said);
}

/* ---- Without frames ----------------------------------------------------------------------------------------- */

static place write_page_without_frames(const driven *d)
{
    const place page = place_in(d->folder, "played.html");
    const octree_session session = octree_session_default();
    const film_options options = small_film("");
    film_summary summary;
    octreel_error error;
    FILE *file = fopen(page.path, "wb");
    assert_non_null(file);
    if (!write_played_page(&session, &options, file, &summary, &error))
        fail_msg("%s", error.text);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(summary.ticks, LAST + 1);
    return page;
}

static void page_without_frames_draws_at_once(void **state)
{
    const driven *d = need_page(state);
    const place page = write_page_without_frames(d);
    const driven alone = {
        d->folder, run_scripts_in_playing_page(d->folder, page.path, (const char *const[]){"drive_plays.js", NULL})};
    assert_reported_value(alone.said, "begins", "0 true false driven 253 ticks · 160 × 90 · iso");
    assert_reported_ticks(alone.said, "tick", place_in(d->folder, "film").path, LAST + 1, false);
    assert_reported_value(alone.said, "given back", "true 252");
    assert_reported_value(alone.said, "bar before", "; "); /* there is no earlier state to return to */
    assert_reported_value(alone.said, "bar looked at", "Back to the session; ");
    assert_reported_value(alone.said, "bar played on", "Back to the session; Played on from tick 252: w");
    assert_reported_value(alone.said, "bar given back", "; ");
    assert_reported_value(alone.said, "errors", "");
    free(alone.said);
}

/* As in a build of octreel without WebAssembly. */
static void page_that_cannot_draw_explains_the_remedy(void **state)
{
    const driven *d = need_page(state);
    const place page = write_page_without_frames(d);
    char *text = file_read(page.path, NULL), *module = strstr(text, "id=\"module\">") + strlen("id=\"module\">");
    FILE *file = fopen(page.path, "wb");
    assert_non_null(file);
    fprintf(file, "%.*s%s", (int)(module - text), text, strstr(module, "</script>"));
    assert_int_equal(fclose(file), 0);
    char *shown = browser_open(d->folder, page.path, "");
    assert_non_null(strstr(shown, "<p id=\"caption\">This recording has no frames, and this page cannot draw them"));
    free(shown);
    free(text);
}

static void page_of_the_default_session_is_small(void **state)
{
    const driven *d = need_page(state);
    struct stat about;
    assert_int_equal(stat(place_below(place_in(d->folder, "film").path, "index.html").path, &about), 0);
    assert_true(about.st_size < 340000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_plays_the_ticks_of_the_recording_in_any_order),
        cmocka_unit_test(click_names_the_element_that_pick_names),
        cmocka_unit_test(inspector_tells_positions_and_counts_of_a_played_tick),
        cmocka_unit_test(links_select_nodes_and_points),
        cmocka_unit_test(queries_on_the_page_have_the_answers_of_the_library),
        cmocka_unit_test(ray_through_a_pixel_has_the_answer_of_the_library),
        cmocka_unit_test(session_played_on_the_page_records_the_same),
        cmocka_unit_test(random_gestures_change_no_tick_and_raise_no_error),
        cmocka_unit_test(unreadable_session_is_reported_and_the_old_one_stays),
        cmocka_unit_test(many_points_are_packed_and_play_the_same),
        cmocka_unit_test(page_without_frames_draws_at_once),
        cmocka_unit_test(page_that_cannot_draw_explains_the_remedy),
        cmocka_unit_test(page_of_the_default_session_is_small),
    };
    return cmocka_run_group_tests(tests, drive_page, forget_page);
}
