/* SPDX-License-Identifier: MIT */
/* test_page_shown.c - index.html in headless Chromium opens from the disk, steps, plays and filters, and shows the
 * facts of ticks.jsonl. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "browser.h"
#include "files.h"
#include "fixture.h"
#include "foreign_session.h"
#include "recordings.h"
#include "tick_lines.h"
#include "page.h"

enum { LAST = 252 }; /* last tick of the default session */

static const char ABSENT[] = "\xe2\x80\x93";

/* A recording of the default session, and the reports of its page from tests/support/viz/drive_viewer.js. */
typedef struct driven {
    void *folder; /* a temp_folder */
    char *said;   /* null without a browser */
} driven;

static int drive_page(void **state)
{
    driven *d = calloc(1, sizeof *d);
    *state = d;
    if (d == NULL || temp_folder_make(&d->folder) != 0)
        return -1;
    if (!is_browser_installed())
        return 0;
    const place film = place_in(d->folder, "film");
    const octree_session session = octree_session_default();
    const film_options options = small_film(film.path);
    assert_filmed(&session, &options);
    d->said = browser_drive(d->folder, place_below(film.path, "index.html").path, OCTREEL_DRIVE);
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

static void assert_said(const driven *d, const char *what, const char *expected)
{
    assert_reported_value(d->said, what, expected);
}

/* ---- Facts -------------------------------------------------------------------------------------------------- */

/* The value of the next line. */
static char *take_value(char **at, const char *what)
{
    char *line = *at;
    const size_t length = strlen(what);
    *at = line + strcspn(line, "\n");
    if (**at == '\n')
        *(*at)++ = '\0';
    if (strncmp(line, what, length) != 0 || line[length] != '\t')
        fail_msg("\"%s\" and not %s", line, what);
    return line + length + 1;
}

static void assert_shown(const char *what, const char *shown, const json_t *value)
{
    char *end;
    const bool same = json_is_string(value) ? strcmp(shown, json_string_value(value)) == 0
                      : json_is_null(value) ? strcmp(shown, ABSENT) == 0
                                            : strtod(shown, &end) == json_real_value(value) && *end == '\0';
    if (!same)
        fail_msg("%s: \"%s\" is shown", what, shown);
}

static void assert_tick_said(const char *line, size_t number, void *context)
{
    static const struct {
        const char *name, *object, *member;
    } curves[] = {{"nodes", "tree", "nodes"},
                  {"depth", "tree", "depth"},
                  {"points", "tree", "points"},
                  {"visits", "visits", "visited"}};
    char what[64];
    json_t *tick = json_read(line);
    snprintf(what, sizeof what, "%zu raw", number);
    json_t *raw = json_read(take_value(context, what));
    if (!json_equal(raw, tick))
        fail_msg("tick %zu: the page shows other JSON than %s", number, line);
    json_decref(raw);
    for (size_t i = 0; i < 2; i++) {
        snprintf(what, sizeof what, "%zu %s", number, (const char *const[]){"told", "sections"}[i]);
        take_value(context, what);
    }
    for (size_t i = 0; i < sizeof curves / sizeof curves[0]; i++) {
        snprintf(what, sizeof what, "%zu curve %s", number, curves[i].name);
        assert_shown(what, take_value(context, what),
                     json_member(json_member(tick, curves[i].object), curves[i].member));
    }
    json_decref(tick);
}

static void page_shows_the_facts_of_every_tick(void **state)
{
    skip_without_browser();
    const driven *d = *state;
    char *said = strdup(d->said), *at = said + 1;
    assert_int_equal(for_each_line(place_in(d->folder, "film").path, assert_tick_said, &at), LAST + 1);
    free(said);
}

/* What the inspector says about ticks of the default session. */
static void page_tells_each_kind_of_event_in_a_sentence(void **state)
{
    const char *const rows[][2] = {
        /* only the module knows the positions of points */
        {"0 told", page_can_play()
                       ? "✕Collided with point 5 at (-1, 2, 3); the player at (0, 0, 0) made no step | ■Point "
                         "10 at (750, 750, 800) refused: its leaf is full and cannot split further"
                       : "✕Collided with point 5; the player at (0, 0, 0) made no step | ■Point 10 at (750, "
                         "750, 800) refused: its leaf is full and cannot split further"},
        {"6 told", "✕Key s (−y): collided with point 1; step to (-50, -50, 100) taken back"},
        {"7 told", "Key n (nearest neighbour): the player is at (-50, 0, 100)"},
        {"7 sections",
         "Query 1: Nearest to (-50, 0, 100)1 point found; 4 nodes visited (2 leaves), 4 points compared, 2 "
         "nodes prunedpointdistanceposition150(-50, -50, 100) | Tree11 points in 7 leaves; 12 nodes, "
         "deepest at depth 5Collision test: 3 nodes visited (2 leaves), 4 points compared, 2 nodes "
         "prunedvisited4pruned2with hits1all nodes12"},
        {"74 told", "⊘Key a (−x): step refused: it would leave the world; the player stays at (-1000, -1000, -1000)"},
        {"214 told", "■Key e (+z): step to (800, 750, 750) taken back: its leaf is full and cannot split further"},
        {"225 told",
         "→Key a (−x): the player moved to (850, 850, 850) | ⊞Node 7/7/7/0 split: more points than its capacity, 2"},
        {"226 told",
         "→Key w (+y): the player moved to (850, 900, 850) | ⊟Node 7/7/7/0 merged into one leaf; capacity 2"},
        {"22 told",
         "→Key f (−z): the player moved to (-250, -200, -50) | ⊟3 nodes merged: 1, 1/6 and 1/6/6; capacity 2"},
    };
    skip_without_browser();
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_said(*state, rows[i][0], rows[i][1]);
}

/* ---- Steps -------------------------------------------------------------------------------------------------- */

/* Press the keys one after the other; a page is a twentieth of 253 ticks. */
static void keys_step_through_the_ticks(void **state)
{
    static const char expected[] = "\nkey Home\t0\nkey ArrowLeft\t0\nkey ArrowRight\t1\nkey ArrowRight\t2\n"
                                   "key ArrowLeft\t1\nkey End\t252\nkey ArrowRight\t252\nkey PageUp\t239\n"
                                   "key PageDown\t252\nkey PageUp\t239\nkey Home\t0\nkey PageDown\t13\n";
    skip_without_browser();
    assert_non_null(strstr(((driven *)*state)->said, expected));
}

static void pointer_and_typing_choose_a_tick(void **state)
{
    skip_without_browser();
    assert_said(*state, "click in the middle", "126");
    assert_said(*state, "drag to the end", "252");
    assert_said(*state, "typed", "77");
    assert_said(*state, "button", "78");
}

static void lanes_zoom_and_follow_the_tick(void **state)
{
    skip_without_browser();
    assert_said(*state, "zoomed", "56 to 168, range bar");
    assert_said(*state, "click in the part", "112");
    assert_said(*state, "followed", "140 to 252, range bar");
    assert_said(*state, "panned", "0 to 112, range bar");
    assert_said(*state, "as far as it goes", "51 to 61, range bar");
    assert_said(*state, "zoomed out", "0 to 252");
}

static void events_are_listed_in_sentences(void **state)
{
    skip_without_browser();
    assert_said(*state, "events",
                "218⊞Node 7/7/7/0 split: more points than its capacity, 2 | 220⊟Node 7/7/7/0 merged into one leaf; "
                "capacity 2 | 225⊞Node 7/7/7/0 split: more points than its capacity, 2 | 226⊟Node 7/7/7/0 merged into "
                "one leaf; capacity 2");
    assert_said(*state, "event clicked", "218 218");
    assert_said(*state, "events collided", "0 1 2 6 10 11 120 121 193 234");
    assert_said(*state, "first event", "0✕Collided with point 5; the player at (0, 0, 0) made no step");
    assert_said(*state, "events moved", "213");
}

static void page_shows_the_frame_of_the_tick(void **state)
{
    skip_without_browser();
    assert_said(*state, "frame", "78 frame_000078.png 160x90");
}

/* The ticks after `from` that have one of some events, in order. */
typedef struct chosen {
    const char *events; /* names with blanks around each */
    size_t from;
    char ticks[2048];
} chosen;

static void choose(const char *line, size_t number, void *context)
{
    chosen *c = context;
    json_t *tick = json_read(line);
    const json_t *events = json_member(tick, "events");
    bool wanted = false;
    for (size_t i = 0; i < json_array_size(events); i++) {
        char name[32];
        snprintf(name, sizeof name, " %s ", json_string_value(json_array_get(events, i)));
        wanted = wanted || strstr(c->events, name) != NULL;
    }
    if (wanted && number >= c->from)
        snprintf(c->ticks + strlen(c->ticks), sizeof c->ticks - strlen(c->ticks), "%s%zu", *c->ticks ? " " : "",
                 number);
    json_decref(tick);
}

/* The test fails unless the key led from `start` to all later ticks with the events. */
static void assert_walk(const driven *d, const char *what, const char *start, const char *events)
{
    char expected[2100];
    chosen c = {.events = events, .from = 1};
    for_each_line(place_in(d->folder, "film").path, choose, &c);
    snprintf(expected, sizeof expected, "%s%s", start, c.ticks);
    assert_said(d, what, expected);
}

static void filter_steps_from_match_to_match(void **state)
{
    skip_without_browser();
    assert_walk(*state, "walk any", "0 ", " refused collided full split merged ");
    assert_walk(*state, "walk collided", "0 ", " collided ");
    assert_walk(*state, "walk collided or merged", "0 ", " collided merged ");
    assert_said(*state, "walk back", "234 193 121 120 11 10 6 2 1 0");
    assert_said(*state, "filtered", "10 ticks with collided; j and k go to the next and previous.");
    assert_said(*state, "chosen", "collided");
    assert_said(*state, "chosen none", "0");
}

static void page_plays_frame_by_frame_until_paused(void **state)
{
    skip_without_browser();
    char *played = find_reported_value(((driven *)*state)->said, "played"), *at = played;
    long count = 0;
    for (char *end; *at != '\0'; at = end)
        assert_int_equal(strtol(at, &end, 10), ++count);
    assert_true(count >= 12);
    assert_said(*state, "played, paused", "true");
    free(played);
}

static void page_plays_only_the_filtered_ticks_and_stops_at_the_last(void **state)
{
    skip_without_browser();
    assert_walk(*state, "played collided", "", " collided ");
    assert_said(*state, "played collided, paused", "true");
}

static void address_contains_the_tick_and_restores_it(void **state)
{
    skip_without_browser();
    assert_said(*state, "address", "#t=41&filter=collided&pixels=recorded");
    assert_said(*state, "from address", "12 2");
    assert_said(*state, "beyond the end", "252");
    assert_said(*state, "from nonsense", "0");
}

static void question_mark_lists_the_keys(void **state)
{
    skip_without_browser();
    assert_said(*state, "help before", "false");
    assert_said(*state, "help", "true");
    assert_said(*state, "behind the help", "0");
    assert_said(
        *state, "keys listed",
        !page_can_play()
            ? "\xe2\x86\x92 \xe2\x86\x90 Page Down Page Up Home End space + - j k 1 2 3 4 5 6 0 i p l b z x t Esc ?"
            : "\xe2\x86\x92 \xe2\x86\x90 Page Down Page Up Home End space + - j k 1 2 3 4 5 6 0 "
              "w s d a e f n . q Shift \xe2\x86\x90 Shift \xe2\x86\x92 Shift \xe2\x86\x91 Shift \xe2\x86\x93 "
              "Shift Page Up Shift Page Down o v m c i p l b z x t Esc ?");
}

/* The page has hundreds of elements, however many ticks there are. */
static void page_stays_small_and_free_of_errors(void **state)
{
    skip_without_browser();
    char *elements = find_reported_value(((driven *)*state)->said, "elements");
    assert_true(strtol(elements, NULL, 10) < 1000);
    free(elements);
    assert_said(*state, "errors", "0");
}

/* ---- Other recordings, as they are opened ------------------------------------------------------------------- */

static void assert_has(const char *page, const char *part)
{
    if (strstr(page, part) == NULL)
        fail_msg("the page has no %s", part);
}

static void tick_without_a_frame_shows_the_previous_frame_and_says_so(void **state)
{
    skip_without_browser();
    const driven *d = *state;
    const place film = place_in(d->folder, "gaps");
    const octree_session session = octree_session_default();
    film_options options = small_film(film.path);
    options.every = 40;
    assert_filmed(&session, &options);
    char *page =
        browser_open(d->folder, place_below(film.path, "index.html").path, "t=43&filter=collided,full&pixels=recorded");
    assert_has(page, "data-tick=\"43\"");
    assert_has(page, "data-fact=\"tick\">43<");
    assert_has(page, "Tick 43 has no frame; this is the frame of tick 40.");
    assert_has(page, "src=\"frame_000040.png\"");
    assert_has(page, "11 ticks with collided or full");
    assert_has(page, "253 ticks \xc2\xb7 7 frames");
    free(page);
}

static place recording_by_hand(const driven *d, const char *name, const char *ticks)
{
    octreel_error error = {""};
    const place folder = place_in(d->folder, name);
    assert_int_equal(mkdir(folder.path, 0777), 0);
    file_write_text(place_below(folder.path, "recording.json").path, "{\"size\": [160, 90]}\n");
    file_write_text(place_below(folder.path, "ticks.jsonl").path, ticks);
    if (!page_write(NULL, folder.path, NULL, NULL, &error))
        fail_msg("%s", error.text);
    return place_below(folder.path, "index.html");
}

/* Text is shown as text, long lists are cut and say so, unknown facts are shown, and a frame may be missing. */
static void page_tolerates_unexpected_members(void **state)
{
    skip_without_browser();
    const driven *d = *state;
    char ticks[2048] =
        "{\"tick\": 0, \"key\": \"</script><script>document.title = 'mine'</script>\", \"player\": [1, 2, 3],"
        "\"events\": [\"</b>teleported\"], \"lengths\": [0";
    for (int i = 1; i < PAGE_LIST + 8; i++)
        snprintf(ticks + strlen(ticks), sizeof ticks - strlen(ticks), ", %d", i);
    strcat(ticks,
           "], \"unheard_of\": {\"weight\": -0.5, \"long\": [17.299999999999997], \"of\": [true, \"x\"]}, "
           "\"answers\": [{\"wedge\": {\"corner\": [7, 8, 9], \"ids\": [3], \"cost\": {\"nodes\": 1, \"cache\": 77}}}],"
           "\"tree\": {\"points\": 1, \"nodes\": 1, \"leaves\": 1, \"depth\": 0, \"holes\": 55}, "
           "\"frame\": \"frame_000000.png\"}\n"
           "{\"tick\": 1, \"events\": [], \"hits\": 5, \"answers\": \"<i>none\"}\n");
    const place film = recording_by_hand(d, "a #%41?b", ticks);
    char *page = browser_open(d->folder, film.path, "t=0");
    assert_has(page, "<title>a #%41?b \xe2\x80\x93 Octreel</title>");
    assert_has(page, "Key <kbd>&lt;/script&gt;&lt;script&gt;document.title");
    assert_has(page, "Event: &lt;/b&gt;teleported</p>");
    assert_has(page, "30, 31<p class=\"more\">\xe2\x80\xa6 and 8 more, in ticks.jsonl</p></details></dd>");
    assert_has(page, "8, 9<details><summary>30 more</summary>10, 11, ");
    assert_has(page, "<span class=\"count\">40</span>");
    assert_has(page, "<dd data-fact=\"unheard_of.weight\">-0.5</dd>");
    assert_has(page, "long\"><span title=\"17.299999999999997\">17.3</span></dd>");
    assert_has(page, "<dd data-fact=\"unheard_of.of\">true, x</dd>");
    assert_has(page, ": wedge</p>");
    assert_has(page, "<dd data-fact=\"answers.0.wedge.corner\">7, 8, 9</dd>");
    assert_has(page, "<dd data-fact=\"answers.0.wedge.cost.cache\">77</dd>");
    assert_has(page, "<dd data-fact=\"tree.holes\">55</dd>");
    assert_has(page, "frame_000000.png is missing beside this page");
    free(page);
    page = browser_open(d->folder, film.path, "t=1"); /* members of other types are shown as rows */
    assert_has(page, "<dd data-fact=\"hits\">5</dd>");
    assert_has(page, "<dd data-fact=\"answers\">&lt;i&gt;none</dd>");
    free(page);
}

/* The text of the page without its elements; the caller frees it. */
static char *text_of(const driven *d, const char *page, const char *hash)
{
    char *text = browser_open(d->folder, page, hash), *to = text;
    for (const char *from = strstr(text, "id=\"facts-of-tick\""); *from; from++) {
        if (*from == '<')
            from = strchr(from, '>');
        else
            *to++ = *from;
    }
    *to = '\0';
    return text;
}

static void wrong_answers_and_foreign_nodes_are_told_first(void **state)
{
    skip_without_browser();
    const driven *d = *state;
    const place film = recording_by_hand(
        d, "wrong",
        "{\"tick\": 0, \"key\": \"w\", \"player\": [0, 5, 0], \"events\": [\"moved\", \"wrong\"], \"attempt\": [0, 5, "
        "0],"
        "\"answers\": [{\"nearest\": {\"target\": [1, 2, 3], \"id\": null, \"judged\": {\"answer\": [], \"wrong\": "
        "\"none\","
        "\"expected\": 0, \"ratio\": 1}}}, {\"radius\": {\"center\": [1, 2, 3], \"radius\": 5, \"ids\": [3, 4], "
        "\"judged\":"
        "{\"answer\": [4, 22], \"wrong\": \"missing\", \"expected\": 2, \"missing\": [3], \"extra\": [22]}}}, "
        "{\"knearest\": {"
        "\"target\": [0, 0, 0], \"k\": 2, \"neighbors\": [], \"judged\": {\"answer\": [9], \"wrong\": \"duplicate\","
        "\"wrong_id\": 9, \"expected\": 2, \"ratio\": 1.5}}}], \"foreign_nodes\": {\"count\": 5, \"leaves\": 3, "
        "\"depth\": 2,"
        "\"visited\": 2, \"pruned\": 1, \"hit\": 1, \"wrong\": {\"count\": 3, \"outside_parent\": 1, \"lost_point\": 2,"
        "\"first\": [{\"wrong\": \"outside_parent\", \"node\": 3}, {\"wrong\": \"lost_point\", \"point\": 8}]}}}\n");
    char *text = text_of(d, film.path, "t=0");
    assert_has(text, "Tick 0\xe2\x89\xa0Wrong answer to \xe2\x80\x9cWithin 5 of (1, 2, 3)\xe2\x80\x9d: missing point "
                     "3; extra point 22"
                     "\xe2\x89\xa0Wrong answer to \xe2\x80\x9c"
                     "2 nearest to (0, 0, 0)\xe2\x80\x9d: it names point 9 twice"
                     "\xe2\x89\xa0"
                     "foreign node 3: its box leaves the box of its parent"
                     "\xe2\x89\xa0"
                     "Foreign nodes: a point is in no node (point 8)"
                     "\xe2\x89\xa0"
                     "1 more wrong foreign node"
                     "\xe2\x86\x92Key w (+y): the player moved to (0, 5, 0)Query 2: Within 5 of (1, 2, 3)");
    assert_has(text, "Wrong foreign answer, 2 points of 2 expected: 4 and 22");
    assert_has(text, "Right foreign answer, 0 points of 0 expected: ");
    assert_has(text, "Foreign nodes5 nodes, 3 leaves, deepest at depth 2; 3 wrong");
    free(text);
}

static void foreign_pairs_are_told_in_a_sentence(void **state)
{
    skip_without_browser();
    const driven *d = *state;
#define TICK(number, wrong, rest)                                                                                      \
    "{\"tick\": " #number ", \"key\": null, \"player\": null, \"events\": [], \"foreign_pairs\": {\"given\": "         \
    "[[1, 2], [3, 4]], \"wrong\": \"" wrong "\", \"expected\": 2" rest "}}\n"
    const place film = recording_by_hand(d, "pairs",
                                         TICK(0, "none", "") TICK(1, "missing",
                                                                  ", \"missing\": [[5, 6]], "
                                                                  "\"extra\": {\"count\": 300}")
                                             TICK(2, "unknown", ", \"wrong_pair\": [7, 1]")
                                                 TICK(3, "duplicate", ", \"wrong_pair\": [1, 2]"));
#undef TICK
    static const char *const sentences[] = {
        "The foreign index found all pairs of bodies that overlap: 2",
        "Wrong foreign pairs, 2 given; 1 missing: point 5 and point 6; 300 extra",
        "Wrong foreign pairs, 2 given; it names 7, which is no body",
        "Wrong foreign pairs, 2 given; it names point 1 and point 2 twice",
    };
    for (int i = 0; i < 4; i++) {
        char at[8];
        snprintf(at, sizeof at, "t=%d", i);
        char *text = text_of(d, film.path, at);
        assert_has(text, sentences[i]);
        free(text);
    }
}

static void recording_without_ticks_says_so(void **state)
{
    skip_without_browser();
    const driven *d = *state;
    char *page = browser_open(d->folder, recording_by_hand(d, "empty", "").path, "t=3");
    assert_has(page, "This recording has no ticks.");
    free(page);
}

/* If there are two trees, each curve names its tree. */
static void curves_of_two_trees_are_distinguishable(void **state)
{
    skip_without_browser();
    const driven *d = *state;
    const place film = place_in(d->folder, "foreign");
    const octree_session session = foreign_session();
    const film_options options = small_film(film.path);
    assert_filmed(&session, &options);
    char *page = browser_open(d->folder, place_below(film.path, "index.html").path, "t=0");
    assert_has(page, "Octreel's nodes");
    assert_has(page, "Octreel's split");
    assert_has(page, "foreign nodes");
    free(page);
    page = browser_open(d->folder, place_in(d->folder, "film/index.html").path, "t=0");
    assert_null(strstr(strstr(page, "id=\"timeline\""), "Octreel's nodes</span>"));
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_shows_the_facts_of_every_tick),
        cmocka_unit_test(page_tells_each_kind_of_event_in_a_sentence),
        cmocka_unit_test(keys_step_through_the_ticks),
        cmocka_unit_test(pointer_and_typing_choose_a_tick),
        cmocka_unit_test(lanes_zoom_and_follow_the_tick),
        cmocka_unit_test(events_are_listed_in_sentences),
        cmocka_unit_test(page_shows_the_frame_of_the_tick),
        cmocka_unit_test(filter_steps_from_match_to_match),
        cmocka_unit_test(page_plays_frame_by_frame_until_paused),
        cmocka_unit_test(page_plays_only_the_filtered_ticks_and_stops_at_the_last),
        cmocka_unit_test(address_contains_the_tick_and_restores_it),
        cmocka_unit_test(question_mark_lists_the_keys),
        cmocka_unit_test(page_stays_small_and_free_of_errors),
        cmocka_unit_test(tick_without_a_frame_shows_the_previous_frame_and_says_so),
        cmocka_unit_test(page_tolerates_unexpected_members),
        cmocka_unit_test(wrong_answers_and_foreign_nodes_are_told_first),
        cmocka_unit_test(foreign_pairs_are_told_in_a_sentence),
        cmocka_unit_test(recording_without_ticks_says_so),
        cmocka_unit_test(curves_of_two_trees_are_distinguishable),
    };
    return cmocka_run_group_tests(tests, drive_page, forget_page);
}
