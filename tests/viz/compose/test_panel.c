/* SPDX-License-Identifier: MIT */
/* test_panel.c - tests the texts and swatches of the panel, and that they fit their room. */
#include "scenes.h"
#include "brute.h"
#include "column.h"
#include "draw_list.h"
#include "layout.h"

#include <stdio.h>
#include <string.h>

static void check_facts(const scene *s, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    char title[SCENE_TEXT];
    snprintf(title, sizeof title, "tick %llu", (unsigned long long)tick->number);
    assert_string_equal(find_text(s, "tick ")->text, title);
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        if (tick->events >> i & 1)
            assert_non_null(find_text(s, octree_event_name(1u << i)));
}

/* A hit is reported in text, not by colour alone. Without a hit only the legend's swatch is red. */
static void check_red_words(const scene *s, const octree_tick *tick)
{
    size_t words = 0;
    for (size_t i = 0; i < s->labels.count; i++)
        words += s->labels.items[i].style.role == ROLE_COLLISION;
    assert_int_equal(words, tick->hit_count != 0);
    if (tick->hit_count)
        assert_non_null(find_text(s, "collided"));
}

static void panel_shows_every_ticks_number_and_events(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1280, 720}, {320, 180}, {640, 360}, {3840, 2160}};
    const octree_session session = octree_session_default();
    octree_game *game = start_game(&session);
    scene s = {0};
    unsigned met = 0;
    for (unsigned tick = 0; !octree_game_over(game); tick++) {
        const view v = view_of(sizes[tick % 4][0], sizes[tick % 4][1], CAMERA_ISO, VIEW_ALL_LAYERS);
        play_tick(game);
        build_tick(&s, &v, game);
        assert_inside_column(&s);
        check_facts(&s, game);
        check_red_words(&s, octree_game_tick(game));
        met |= octree_game_tick(game)->events;
    }
    assert_int_equal(met, OCTREE_EVENT_WRONG - 1);
    octree_game_destroy(game);
    scene_release(&s);
}

static void panel_shows_a_swept_test(void **state)
{
    (void)state;
    const view v = view_make_default();
    for (int sweep = 0; sweep < 2; sweep++) {
        octree_session session = small_session(NULL, 0);
        session.player.sweep = sweep;
        octree_game *game = start_game(&session);
        scene s = {0};
        build_tick(&s, &v, game);
        assert_inside_column(&s);
        assert_int_equal(find_text(&s, "the whole path") != NULL, sweep);
        octree_game_destroy(game);
        scene_release(&s);
    }
}

static void panel_shows_answers(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 41, .position = {3, 4, 0}},
                                              {.id = 42, .position = {0, 2, 0}},
                                              {.id = 43, .position = {0, 0, 9}},
                                              {.id = 44, .position = {0, 0, -9}}};
    static const octree_query queries[] = {{.kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = 2},
                                           {.kind = OCTREE_QUERY_RADIUS, .at_player = true, .radius = 4.25},
                                           {.kind = OCTREE_QUERY_RADIUS, .target = {9, 9, 9}, .radius = 0.5},
                                           {.kind = OCTREE_QUERY_KNEAREST, .target = {0, 0, 0}, .k = 5}};
    octree_session session = small_session(bodies, 4);
    session.queries = queries;
    session.query_count = 4;
    const view v = view_make_default();
    octree_game *game = start_game(&session);
    scene s = {0};
    build_tick(&s, &v, game);
    assert_inside_column(&s);
    assert_true(has_label_with(&s, "#42 #41") && has_label_with(&s, "#100 +4") && has_label_with(&s, "5 found"));
    assert_true(has_label_with(&s, "4.25") && has_label_with(&s, "0.5") && has_label_with(&s, "2 found") &&
                has_label_with(&s, "0 found"));
    octree_game_destroy(game);
    scene_release(&s);
}

/* Rows of the column by where they begin, whatever is written on them. */
static size_t count_rows(const scene *s, int below)
{
    size_t rows = 0;
    double at = -1;
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        if (label->style.layer != LAYER_TEXT || label->at[1] == at || is_in_caption(s, label))
            continue;
        at = label->at[1];
        rows += at <= below;
    }
    return rows;
}

/* Nothing is written below the picture. The last row counts the rows that have no room. */
static void rows_without_room_are_counted(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    octree_game *game = start_game(&session);
    size_t cut = 0;
    for (int width = 250; width <= 640; width += 390) { /* without the column, and with it */
        view v = view_of(width, 4000, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
        scene tall = {0};
        build_tick(&tall, &v, game);
        const size_t all = count_rows(&tall, 2000); /* the legend stands below */
        for (v.height = 40; v.height < 400; v.height++) {
            scene s = {0};
            char more[SCENE_TEXT];
            build_tick(&s, &v, game);
            assert_int_equal(count_rows(&s, v.height - s.text.height), count_rows(&s, 10000));
            size_t told = 0, legend = 0;
            for (size_t i = 0; i < s.labels.count; i++)
                legend +=
                    s.labels.items[i].style.layer == LAYER_TEXT && s.labels.items[i].at[0] == find_legend_text_x(&s);
            for (size_t n = 1; n < all; n++) {
                snprintf(more, sizeof more, "and %zu more", n);
                for (size_t i = 0; i < s.labels.count; i++)
                    if (strcmp(s.labels.items[i].text, more) == 0 && s.labels.items[i].style.role == ROLE_WARNING)
                        told = n;
            }
            const size_t shown = count_rows(&s, 10000) - legend - (told > 0);
            assert_true(shown + told == all);
            cut += told > 0;
            scene_release(&s);
        }
        scene_release(&tall);
    }
    assert_true(cut > 50);
    octree_game_destroy(game);
}

/* A list of ids is cut between two of them, whatever their length, and says how many more there are. */
static void ids_without_room_are_counted(void **state)
{
    (void)state;
    static const struct {
        uint64_t first;
        size_t count;
        const char *text;
    } cases[] = {{7, 1, "#7"},
                 {7, 3, "#7 #8 #9"},
                 {1, 5, "#1 #2 +3"},
                 {100007, 2, "#100007 +1"},
                 {100000007, 1, "#100000007"},
                 {1000000007, 1, ""},
                 {100007, 4, "#100007 +3"},
                 {1000007, 4, ""},
                 {1007, 12, "#1007 +11"},
                 {10007, 12, ""},
                 {UINT64_MAX - 20, 12, ""}};
    const view v = view_make_default();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        octree_game_body bodies[12];
        for (size_t j = 0; j < cases[i].count; j++)
            bodies[j] = (octree_game_body){.id = cases[i].first + j, .position = {5, 5, 5 + (double)j / 8}};
        const octree_query query = {
            .tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{4, 4, 4}, {10, 10, 10}}};
        octree_session session = small_session(bodies, cases[i].count);
        session.tree.full_leaf = OCTREE_GROW;
        session.queries = &query;
        session.query_count = 1;
        octree_game *game = start_game(&session);
        scene s = {0};
        char found[SCENE_TEXT];
        build_tick(&s, &v, game);
        snprintf(found, sizeof found, "%zu found", cases[i].count);
        assert_true(has_label_with(&s, found));
        bool told = false;
        size_t details = 0;
        for (size_t j = 0; j < s.labels.count; j++) {
            told = told || strcmp(s.labels.items[j].text, cases[i].text) == 0;
            details += s.labels.items[j].style.layer == LAYER_TEXT && s.labels.items[j].text[0] == '#';
        }
        assert_true(cases[i].text[0] ? told : details == 0);
        scene_release(&s);
        octree_game_destroy(game);
    }
}

static void the_column_never_takes_more_than_half_the_picture(void **state)
{
    (void)state;
    for (int width = 1; width <= 16384; width += 1 + width / 50) {
        for (int height = 1; height <= 16384; height += 1 + height / 20) {
            const view v = view_of(width, height, CAMERA_ISO, VIEW_ALL_LAYERS);
            const view wordless = view_of(width, height, CAMERA_ISO, VIEW_ALL_LAYERS & ~(1u << LAYER_TEXT));
            assert_true(layout_panel_width(&v) >= 0 && 2 * layout_panel_width(&v) <= width);
            assert_int_equal(layout_panel_width(&wordless), 0);
        }
    }
}

static void picture_without_room_for_the_column_shows_the_main_facts(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    const view v = view_of(64, 48, CAMERA_ISO, VIEW_ALL_LAYERS);
    octree_game *game = start_game(&session);
    scene s = {0};
    build_tick(&s, &v, game);
    assert_int_equal(layout_panel_width(&v), 0);
    assert_int_equal(s.panels.count, 0);
    check_facts(&s, game);
    octree_game_destroy(game);
    scene_release(&s);
}

/* The longest values: ids of twenty digits, positions of many digits, titles longer than a text can be. */
static void texts_of_any_length_stay_within_bounds(void **state)
{
    (void)state;
    octree_game_body bodies[40];
    octree_session session = {.tree = define(cube(-1.2345678e300, 1.2345678e300), 1, 21, OCTREE_REFUSE)};
    session.player = (octree_player){.id = UINT64_MAX, .step = 1.2345678e299, .box_size = 1e300};
    for (size_t i = 0; i < 40; i++)
        bodies[i] = (octree_game_body){.id = UINT64_MAX - 1 - i, .position = {-1e-300, 1.2345678e299, -1.2345678e-299}};
    session.bodies = bodies;
    session.body_count = 40;
    session.keys = "dddd";
    octree_game *game = start_game(&session);
    scene s = {0};
    for (view v = view_make_default(); !octree_game_over(game); play_tick(game)) {
        build_tick(&s, &v, game);
        assert_inside_column(&s);
    }
    const view v = view_make_default();
    char title[500];
    memset(title, 'W', sizeof title);
    title[sizeof title - 1] = 0;
    build_tree(&s, &v, octree_game_tree(game), title);
    assert_inside_column(&s);
    size_t cut = 0;
    for (size_t i = 0; i < s.labels.count; i++) {
        const char *text = s.labels.items[i].text;
        const size_t length = strspn(text, "W");
        if (length > 3) {
            assert_string_equal(text + length, "..");
            cut++;
        }
    }
    assert_true(cut > 0);
    octree_game_destroy(game);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panel_shows_every_ticks_number_and_events),
        cmocka_unit_test(panel_shows_a_swept_test),
        cmocka_unit_test(panel_shows_answers),
        cmocka_unit_test(rows_without_room_are_counted),
        cmocka_unit_test(ids_without_room_are_counted),
        cmocka_unit_test(the_column_never_takes_more_than_half_the_picture),
        cmocka_unit_test(picture_without_room_for_the_column_shows_the_main_facts),
        cmocka_unit_test(texts_of_any_length_stay_within_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
