/* SPDX-License-Identifier: MIT */
/* test_page_sessions.c - index.html plays any session as it was recorded: random ones, sessions with every feature, and
 * those of golden/. A click names what pick names, and a session played on the page records and verifies. */
#include <stdlib.h>
#include <string.h>

#include "browser.h"
#include "fixture.h"
#include "golden_frames.h"
#include "layer.h"
#include "picture.h"
#include "driven_page.h"
#include "random_session.h"
#include "recording_file.h"
#include "recordings.h"
#include "session_file.h"
#include "tick_lines.h"
#include "verified.h"

enum { CLICKS = 50, CLICK_RADIUS = 2, CLICKED_TICKS = 5, CLICKED_SESSIONS = 4 };

/* Sessions that together have every feature of session.txt except files of points, which a page cannot read. */
static const struct {
    const char *name, *text;
} written[] = {
    {"all",
     "{\"octreel\": \"session\", \"version\": 2, \"world\": {\"min\": [-100, -100, -100], \"max\": [100, 100, 100]},"
     "\"tree\": {\"capacity\": 2, \"depth\": 3, \"full\": \"refuse\"},"
     "\"player\": {\"id\": 5, \"position\": [0, 0, 0], \"step\": 45, \"box_size\": 30, \"sweep\": true},"
     "\"points\": [[10, 0, 0], [0, 20, 0, 17], [0, 50, 5, 18], [0, 90, 0, 19], [0, 20, 0, 21], [0, 20, 0, 22],"
     "[500, 0, 0, 30], {\"id\": 40, \"position\": [0, 0, 30], \"velocity\": [9, -4, 31.5]}],"
     "\"velocities\": [[17, 0.5, 0, -20], [18, -30, 12, 0]], \"keys\": \"wwwddeen.sssq\", \"ticks\": 20,"
     "\"queries\": [{\"knearest\": 2, \"at\": \"player\"}, {\"nearest\": [1, 2, 3], \"skip\": 17},"
     "{\"range\": {\"min\": [-20, -20, -20], \"max\": [20, 20, 20]}, \"at\": \"player\", \"epsilon\": 4}],"
     "\"shapes\": [{\"box\": {\"min\": [-40, -40, -40], \"max\": [40, 40, 40]}}, {\"point\": [50, 50, 50]},"
     "{\"label\": \"</script><b>&amp;\", \"at\": [-50, 20, 0]}]}\n"
     "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 99, \"position\": [5, 5, 5], \"velocity\": [1, 0, 70]}},"
     "{\"insert\": {\"id\": 99, \"position\": [6, 6, 6]}}, {\"remove\": 17}, {\"remove\": 123456},"
     "{\"move\": {\"id\": 40, \"position\": [0, 0, 0]}}, {\"move\": {\"id\": 18, \"position\": [0, 0, 900]}}],"
     "\"queries\": [{\"radius\": 25, \"at\": [0, 20, 0], \"skip\": \"coincident\"},"
     "{\"knearest\": 3, \"at\": [5, 5, 5], \"epsilon\": 0.5}],"
     "\"shapes\": [{\"label\": \"the first change\", \"at\": [5, 5, 5]},"
     "{\"segment\": [[-90, -90, -90], [90, 90, 90]]}]}\n"
     "{\"tick\": 5, \"gap\": \"there was no <memory>\"}\n{\"tick\": 6, \"gap\": \"nor here\"}\n"
     "{\"tick\": 7, \"edits\": [{\"remove\": 99}]}\n{\"tick\": 15, \"gap\": \"late\"}\n"},
    {"body", "{\"octreel\": \"session\", \"version\": 2, \"player\": {\"id\": 3, \"body\": true, \"box_size\": 300},"
             "\"points\": [[1, 2, 3, 1], {\"id\": 3, \"position\": [9, 9, 9], \"velocity\": [200, 0, 150]}],"
             "\"keys\": \"nwn\", \"ticks\": 14, \"queries\": [{\"nearest\": \"player\"}]}\n"
             "{\"tick\": 4, \"edits\": [{\"remove\": 3}]}\n"
             "{\"tick\": 6, \"edits\": [{\"insert\": {\"id\": 3, \"position\": [-700, 0, 0]}}]}\n"},
    {"boxes",
     "{\"octreel\": \"session\", \"version\": 2, \"world\": {\"min\": [-9, -9, -9], \"max\": [9, 9, 9]},"
     "\"tree\": {\"capacity\": 1, \"depth\": 5, \"full\": \"grow\"}, \"player\": {\"id\": 5, \"step\": 1,"
     "\"box_size\": 1, \"sweep\": true}, \"keys\": \"ddaawwss\", \"pairs\": true, \"points\": [{\"id\": 1,"
     "\"position\": [5, 0, 0], \"half\": [2, 3, 1]}, {\"id\": 2, \"position\": [4, 2, 1], \"half\": [1, 1, 1],"
     "\"velocity\": [-1, 0.5, 0]}, [0, 4, 0, 3]], \"queries\": [{\"range\": {\"min\": [1, 1, 1], \"max\": [3, 3, 3]}},"
     "{\"radius\": 2, \"at\": [3, 3, 0]}, {\"knearest\": 2, \"at\": \"player\"}]}\n"
     "{\"tick\": 2, \"edits\": [{\"insert\": {\"id\": 4, \"position\": [0, 0, 3], \"half\": [8, 0, 0.5]}}]}"},
    {"nobody", "{\"octreel\": \"session\", \"version\": 2, \"player\": null, \"tree\": {\"capacity\": 1, \"depth\": 2,"
               "\"full\": \"grow\"}, \"points\": {\"sample\": \"clustered\", \"count\": 60, \"seed\": 4},"
               "\"velocities\": {\"speed\": 300, \"seed\": 2}, \"ticks\": 9}"},
};

enum { WRITTEN = sizeof written / sizeof written[0], RANDOM = 3, FILMED = WRITTEN + RANDOM + CLICKED_SESSIONS };

/* Recordings, and the reports of a page that plays their sessions and those of golden/. */
typedef struct driven {
    void *folder; /* a temp_folder */
    place films[FILMED];
    char names[FILMED][32];
    json_t *given;
    picture held; /* kept open, so that not every pick opens a renderer */
    char *said;   /* null if the page cannot play */
} driven;

/* ---- What is played ----------------------------------------------------------------------------------------- */

/* Write the text of a session and its view, as in a recording, for the page's script. */
static void give(driven *d, const char *name, const char *session, json_t *view, json_t *ticks, int clicks, bool taken)
{
    json_t *one = json_pack("{s:s, s:s, s:o, s:o, s:i, s:b}", "name", name, "session", session, "view", view, "ticks",
                            ticks, "clicks", clicks, "taken", taken);
    assert_non_null(one);
    assert_int_equal(json_array_append_new(d->given, one), 0);
}

static json_t *ticks_of_clicks(void)
{
    return json_pack("[i, i, i, i, i]", 0, 7, 22, 41, 59);
}

/* Record a session, and write it for the page's script: all its ticks, or those with clicks. */
static void film_and_give(driven *d, size_t i, const char *name, const octree_session *session, film_options options,
                          bool clicked)
{
    snprintf(d->names[i], sizeof d->names[i], "%s", name);
    d->films[i] = place_in(d->folder, name);
    options.folder = d->films[i].path;
    assert_filmed(session, &options);
    char *text = file_read(place_below(options.folder, "session.json").path, NULL);
    char *view = file_read(place_below(options.folder, "recording.json").path, NULL);
    give(d, name, text, json_loads(view, 0, NULL), clicked ? ticks_of_clicks() : json_array(), clicked ? CLICKS : 0,
         false);
    if (!clicked)
        give(d, name, text, json_loads(view, 0, NULL), json_array(), 0, true);
    free(text);
    free(view);
}

static void give_written(driven *d)
{
    for (size_t i = 0; i < WRITTEN; i++) {
        session_file file;
        octreel_error error;
        if (!session_parse(written[i].name, "", written[i].text, strlen(written[i].text), &file, &error))
            fail_msg("%s", error.text);
        film_options options = small_film("");
        options.view.layers = VIEW_ALL_LAYERS;
        film_and_give(d, i, written[i].name, &file.session, options, false);
        session_release(&file);
    }
}

static void give_random(driven *d)
{
    for (size_t i = 0; i < RANDOM; i++) {
        random_session made;
        char name[32];
        snprintf(name, sizeof name, "random_%zu", i);
        random_session_mixed(&made, 40 + i);
        film_and_give(d, WRITTEN + i, name, &made.session, small_film(""), false);
    }
}

/* Write the paper's session with several views for the page's script. */
static void give_clicked(driven *d)
{
    char keys[60];
    snprintf(keys, sizeof keys, "%s", octree_session_default().keys);
    const octree_session session = short_session(keys);
    for (size_t i = 0; i < CLICKED_SESSIONS; i++) {
        char name[32];
        film_options options = small_film("");
        options.view.camera = i == 1 ? CAMERA_ORBIT : CAMERA_ISO;
        options.view.aa = i == 2 ? 2 : 1;
        options.view.diagram = i == 3 ? DIAGRAM_BESIDE : DIAGRAM_NONE;
        snprintf(name, sizeof name, "clicked_%zu", i);
        film_and_give(d, WRITTEN + RANDOM + i, name, &session, options, true);
    }
}

static void give_golden(driven *d)
{
    for (size_t i = 0; i < golden_frame_count; i++) {
        static golden_play play;
        octreel_error error;
        char *session, *view;
        size_t size;
        if (!golden_is_played(&golden_frames[i]))
            continue;
        if (!golden_open(&golden_frames[i], &play, &error))
            fail_msg("%s", error.text);
        FILE *out = open_memstream(&session, &size);
        assert_true(session_write(&play.session, NULL, out));
        assert_int_equal(fclose(out), 0);
        out = open_memstream(&view, &size);
        recording_write(out, &play.view, 1);
        assert_int_equal(fclose(out), 0);
        give(d, golden_frames[i].name, session, json_loads(view, 0, NULL), json_pack("[i]", (int)golden_frames[i].tick),
             0, false);
        octree_game_destroy(play.game);
        free(session);
        free(view);
    }
}

static int drive_page(void **state)
{
    driven *d = calloc(1, sizeof *d);
    *state = d;
    if (!d || temp_folder_make(&d->folder) != 0)
        return -1;
    d->given = json_array();
    const view any = small_film("").view;
    octreel_error error;
    if (!picture_open(&d->held, &any, &(renderer_choice){0}, &error))
        return -1;
    give_written(d);
    give_random(d);
    give_clicked(d);
    give_golden(d);
    const place given = write_given_script(d->folder, d->given);
    d->said = run_scripts_in_playing_page(d->folder, place_below(d->films[0].path, "index.html").path,
                                          (const char *const[]){given.path, "drive_sessions.js", NULL});
    return 0;
}

static int forget_page(void **state)
{
    driven *d = *state;
    const int status = nested_folder_remove(&d->folder);
    json_decref(d->given);
    picture_close(&d->held);
    free(d->said);
    free(d);
    return status;
}

static const driven *need_page(void **state)
{
    const driven *d = *state;
    skip_without_playing_page(place_below(d->films[0].path, "index.html").path);
    return d;
}

/* ---- What is seen ------------------------------------------------------------------------------------------- */

static void page_plays_every_tick_of_random_sessions(void **state)
{
    const driven *d = need_page(state);
    for (size_t i = 0; i < FILMED; i++)
        assert_reported_ticks(d->said, d->names[i], d->films[i].path, for_each_line(d->films[i].path, NULL, NULL),
                              i >= WRITTEN + RANDOM);
    assert_reported_value(d->said, "errors", "");
}

static void page_draws_the_golden_frames(void **state)
{
    const driven *d = need_page(state);
    for (size_t i = 0; i < golden_frame_count; i++) {
        char what[64], path[512], expected[16];
        if (!golden_is_played(&golden_frames[i]))
            continue;
        snprintf(path, sizeof path, "%s/%s.ref.png", OCTREEL_GOLDEN, golden_frames[i].name);
        snprintf(what, sizeof what, "%s %d", golden_frames[i].name, (int)golden_frames[i].tick);
        snprintf(expected, sizeof expected, " %08x ", compute_png_digest(path));
        char *told = find_reported_value(d->said, what);
        if (strncmp(strchr(told, ' '), expected, strlen(expected)) != 0)
            fail_msg("%s differs from its page: %s and not %s", path, told, expected);
        free(told);
    }
}

static void thousand_clicks_name_the_elements_that_pick_names(void **state)
{
    const driven *d = need_page(state);
    size_t clicks = 0;
    for (const char *at = d->said; (at = strstr(at, "\npick clicked_")) != NULL; clicks++) {
        size_t film;
        int tick, x, y;
        assert_int_equal(sscanf(at += strlen("\npick clicked_"), "%zu %d %d %d", &film, &tick, &x, &y), 4);
        const char *told = strchr(at, '\t') + 1;
        char *line = strndup(told, strcspn(told, "\n"));
        const place frame = frame_place(d->films[WRITTEN + RANDOM + film].path, (uint64_t)tick);
        assert_reported_pick(line, frame.path, x, y, CLICK_RADIUS);
        free(line);
    }
    assert_int_equal(clicks, CLICKS * CLICKED_TICKS * CLICKED_SESSIONS);
}

/* ---- What is played on -------------------------------------------------------------------------------------- */

static void assert_taken_films(const driven *d, const char *name)
{
    char what[64], folder[64];
    session_file file;
    octreel_error error;
    snprintf(what, sizeof what, "saved %s", name);
    snprintf(folder, sizeof folder, "taken_%s", name);
    const place film = place_in(d->folder, folder);
    char *text = find_reported_value(d->said, what);
    if (!session_parse(what, "", text, strlen(text), &file, &error))
        fail_msg("%s", error.text);
    film_options options = small_film(film.path);
    uint64_t every;
    assert_true(recording_read(place_in(d->folder, name).path, &options.view, &every, &error));
    const film_summary summary = assert_filmed(&file.session, &options);
    snprintf(what, sizeof what, "taken %s", name);
    assert_reported_ticks(d->said, what, film.path, summary.ticks, false);
    assert_identical(&film, summary.ticks, summary.frames);
    session_release(&file);
    free(text);
}

static void session_played_from_any_tick_records_and_verifies(void **state)
{
    const driven *d = need_page(state);
    for (size_t i = 0; i < WRITTEN + RANDOM; i++)
        assert_taken_films(d, d->names[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_plays_every_tick_of_random_sessions),
        cmocka_unit_test(page_draws_the_golden_frames),
        cmocka_unit_test(thousand_clicks_name_the_elements_that_pick_names),
        cmocka_unit_test(session_played_from_any_tick_records_and_verifies),
    };
    return cmocka_run_group_tests(tests, drive_page, forget_page);
}
