/* test_panel.c - the words and swatches beside a picture: what they tell, and that they fit their place. */
#include "scenes.h"
#include "brute.h"
#include "draw_list.h"
#include "layout.h"

#include <stdio.h>
#include <string.h>

static const scene_label *find_text(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (s->labels.items[i].look.layer == LAYER_TEXT && strstr(s->labels.items[i].text, text))
            return &s->labels.items[i];
    return NULL;
}

/* Elements have their own ids, texts end, all begins within the column. */
static void check_place(const scene *s)
{
    const int width = panel_width(&s->view);
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        if (label->look.layer != LAYER_TEXT)
            continue;
        assert_non_null(memchr(label->text, 0, SCENE_TEXT));
        assert_false(label->in_world);
        assert_true(label->at[0] >= 0 && label->at[1] >= 0 && (width == 0 || label->at[0] < width));
        for (size_t j = 0; j < i; j++)
            assert_true(s->labels.items[j].look.layer != LAYER_TEXT || s->labels.items[j].id != label->id);
    }
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *panel = &s->panels.items[i];
        if (panel->look.layer != LAYER_TEXT)
            continue;
        assert_true(panel->x >= 0 && panel->width > 0 && panel->height > 0 && panel->x + panel->width <= width);
        for (size_t j = 0; j < i; j++)
            assert_true(s->panels.items[j].look.layer != LAYER_TEXT || s->panels.items[j].id != panel->id);
    }
}

static void check_facts(const scene *s, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    char title[SCENE_TEXT];
    snprintf(title, sizeof title, "tick %llu", (unsigned long long)tick->number);
    assert_string_equal(find_text(s, "tick ")->text, title);
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        if (tick->events >> i & 1)
            assert_non_null(find_text(s, octree_event_name(i)));
}

/* A hit is told in words and not by its colour alone; without one nothing but the legend's swatch is red. */
static void check_red_words(const scene *s, const octree_tick *tick)
{
    size_t words = 0;
    for (size_t i = 0; i < s->labels.count; i++)
        words += s->labels.items[i].look.role == ROLE_COLLISION;
    assert_int_equal(words, tick->hit_count != 0);
    if (tick->hit_count)
        assert_non_null(find_text(s, "collided"));
}

static void every_tick_tells_its_number_and_its_events(void **state)
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
        check_place(&s);
        check_facts(&s, game);
        check_red_words(&s, octree_game_tick(game));
        met |= octree_game_tick(game)->events;
    }
    assert_int_equal(met, (1 << OCTREE_EVENT_KINDS) - 1);
    octree_game_destroy(game);
    scene_release(&s);
}

static bool has_swatch(const scene *s, unsigned role)
{
    for (size_t i = 0; i < s->panels.count; i++)
        if (s->panels.items[i].look.role == role)
            return true;
    return false;
}

/* The layers that have a line in the legend, what colour its swatch has and what its words say. */
static const struct legend_row {
    view_layer layer;
    unsigned role;
    bool shared; /* other layers have this colour too */
    const char *text;
} legend_rows[] = {
    {LAYER_NODES, ROLE_NODE, true, "shallow to deep"},
    {LAYER_VISITED, ROLE_NODE + 2, true, " visited"},
    {LAYER_PRUNED, ROLE_NODE + 2, true, " pruned"},
    {LAYER_HIT, ROLE_POINT, true, " hit"},
    {LAYER_SPLITS, ROLE_POINT, true, " split"},
    {LAYER_MERGES, ROLE_POINT, true, " merged"},
    {LAYER_VISIT_HEAT, ROLE_NODE + 9, true, "+ visits"},
    {LAYER_POINT_HEAT, ROLE_NODE + 9, true, "+ points"},
    {LAYER_POINTS, ROLE_POINT, true, "point"},
    {LAYER_VELOCITIES, ROLE_POINT, true, "velocity, "},
    {LAYER_RANGE, ROLE_RANGE, false, "range query"},
    {LAYER_RADIUS, ROLE_RADIUS, false, "radius query"},
    {LAYER_KNEAREST, ROLE_KNEAREST, false, "k nearest"},
    {LAYER_NEAREST, ROLE_NEAREST, false, "nearest point"},
    {LAYER_SHAPES, ROLE_SHAPE, false, "4 shapes"},
    {LAYER_PLAYER, ROLE_PLAYER, false, "player and its box"},
    {LAYER_BOX, ROLE_COLLISION, false, "collision, crossed"},
};

#define LEGEND_ROWS (sizeof legend_rows / sizeof legend_rows[0])

/* Whether the row is in the legend, whose words begin right of a swatch. Of points the whole text is compared: other
 * rows have the word too. */
static bool is_explained(const scene *s, const struct legend_row *row)
{
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        if (label->look.layer != LAYER_TEXT || label->at[0] != 34 * s->unit)
            continue;
        if (row->layer == LAYER_POINTS ? strcmp(label->text, row->text) == 0 : strstr(label->text, row->text) != NULL)
            return true;
    }
    return false;
}

/* Each layer alone has its line and no other; without it, all others have theirs. There is room for all. */
static void the_legend_has_the_layers_that_are_shown(void **state)
{
    (void)state;
    const octree_session session = asking_session();
    octree_game *game = start_game(&session);
    scene s = {0};
    for (size_t i = 0; i < LEGEND_ROWS; i++) {
        for (unsigned text = 0; text < 2; text++) {
            const unsigned words = text << LAYER_TEXT, own = 1u << legend_rows[i].layer;
            view v = view_of(1280, 1440, CAMERA_ISO, own | words);
            build_tick(&s, &v, game);
            for (size_t j = 0; j < LEGEND_ROWS; j++)
                assert_int_equal(is_explained(&s, &legend_rows[j]), text && i == j);
            assert_int_equal(has_swatch(&s, legend_rows[i].role), text);
            v.layers = VIEW_ALL_LAYERS & ~own & ~(text ? 0 : 1u << LAYER_TEXT);
            build_tick(&s, &v, game);
            for (size_t j = 0; j < LEGEND_ROWS; j++)
                assert_int_equal(is_explained(&s, &legend_rows[j]), text && i != j);
            assert_true(legend_rows[i].shared || !has_swatch(&s, legend_rows[i].role));
        }
    }
    octree_game_destroy(game);
    scene_release(&s);
}

/* How soon a row goes when there is no room: what has nothing in the frame, what explains itself, what is told beside
 * its answer, all others. */
static unsigned worth_of(const scene *s, const struct legend_row *row)
{
    static const unsigned answers = 1u << LAYER_RANGE | 1u << LAYER_RADIUS | 1u << LAYER_KNEAREST | 1u << LAYER_NEAREST;
    const layer_counts found = count_layer(s, row->layer);
    if (found.boxes + found.segments + found.markers == 0)
        return 0;
    return row->layer == LAYER_POINTS || row->layer == LAYER_PLAYER ? 1 : answers >> row->layer & 1 ? 2 : 3;
}

/* Of each worth all rows are there, or some of less worth are not; of the last the first ones, and how many more. */
static void the_legend_leaves_out_what_is_needed_least(void **state)
{
    (void)state;
    const octree_session session = asking_session();
    octree_game *game = start_game(&session);
    scene s = {0};
    size_t whole = 0, partial = 0, cut = 0, none = 0;
    for (int height = 100; height <= 1440; height += 10) {
        const view v = view_of(1280, height, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
        size_t there[4] = {0}, missing[4] = {0};
        char more[SCENE_TEXT];
        build_tick(&s, &v, game);
        check_place(&s);
        for (size_t i = 0; i < LEGEND_ROWS; i++) {
            const unsigned worth = worth_of(&s, &legend_rows[i]);
            const bool listed = is_explained(&s, &legend_rows[i]);
            if (!(v.layers >> legend_rows[i].layer & 1))
                continue;
            assert_true(!listed || worth < 3 || missing[3] == 0);
            there[worth] += listed;
            missing[worth] += !listed;
        }
        for (unsigned worth = 1; worth < 4; worth++)
            assert_true(missing[worth] == 0 || there[worth - 1] == 0);
        const size_t all = there[0] + there[1] + there[2] + there[3];
        snprintf(more, sizeof more, "and %zu more", missing[3]);
        bool told = false;
        for (size_t i = 0; i < s.labels.count; i++)
            told = told || (strcmp(s.labels.items[i].text, more) == 0 && s.labels.items[i].at[0] == 34 * s.unit);
        assert_int_equal(told, all > 0 && missing[3] > 0);
        whole += missing[0] == 0;
        partial += missing[3] == 0 && missing[0] > 0;
        cut += all > 0 && missing[3] > 0;
        none += all == 0;
    }
    assert_true(whole > 0 && partial > 0 && cut > 0 && none > 0);
    octree_game_destroy(game);
    scene_release(&s);
}

static void the_legend_leaves_out_queries_that_the_session_never_asks(void **state)
{
    (void)state;
    static const theme_role roles[OCTREE_QUERY_KINDS] = {ROLE_RANGE, ROLE_NEAREST, ROLE_KNEAREST, ROLE_RADIUS};
    const view v = view_default();
    scene s = {0};
    for (int kind = -1; kind < OCTREE_QUERY_KINDS; kind++) {
        const octree_query late = {.tick = 99, .kind = (octree_query_kind)(kind < 0 ? 0 : kind)};
        octree_session session = small_session(NULL, 0);
        session.queries = &late;
        session.query_count = kind >= 0;
        octree_game *game = start_game(&session);
        build_tick(&s, &v, game);
        for (int i = 0; i < OCTREE_QUERY_KINDS; i++) /* n names the nearest in every session */
            assert_int_equal(has_swatch(&s, roles[i]), i == kind || i == OCTREE_QUERY_NEAREST);
        octree_game_destroy(game);
    }
    scene_release(&s);
}

/* What a program asks next is not known while its session is made. */
static void the_legend_without_keys_has_the_queries_asked_so_far_and_no_player_where_none_is(void **state)
{
    (void)state;
    const view v = view_default();
    const octree_query late = {.tick = 2, .kind = OCTREE_QUERY_RADIUS, .target = {1, 1, 1}, .radius = 1};
    for (octree_player_kind kind = OCTREE_PLAYER_BODY; kind <= OCTREE_PLAYER_NONE; kind++) {
        octree_session session = small_session(NULL, 0);
        session.player.kind = kind;
        session.queries = &late;
        session.query_count = 1;
        session.ticks = 3;
        octree_game *game = start_game(&session);
        scene s = {0};
        for (int tick = 0; tick < 4; tick++) {
            build_tick(&s, &v, game);
            assert_int_equal(has_swatch(&s, ROLE_RADIUS), tick >= 2);
            assert_false(has_swatch(&s, ROLE_NEAREST));
            assert_int_equal(has_swatch(&s, ROLE_PLAYER), kind == OCTREE_PLAYER_BODY);
            assert_int_equal(count_layer(&s, LAYER_PLAYER).markers, 0);
            assert_int_equal(find_text(&s, "away") != NULL, kind == OCTREE_PLAYER_BODY);
            if (tick < 3)
                play_tick(game);
        }
        octree_game_destroy(game);
        scene_release(&s);
    }
}

/* The word, and the line of the legend that a sweep needs. */
static void a_sweep_is_told(void **state)
{
    (void)state;
    const view v = view_default();
    for (int sweep = 0; sweep < 2; sweep++) {
        octree_session session = small_session(NULL, 0);
        session.player.sweep = sweep;
        octree_game *game = start_game(&session);
        scene s = {0};
        build_tick(&s, &v, game);
        check_place(&s);
        assert_int_equal(find_text(&s, "the whole way") != NULL, sweep);
        assert_int_equal(find_text(&s, "way to a hit, dashed") != NULL, sweep);
        octree_game_destroy(game);
        scene_release(&s);
    }
}

static bool says(const scene *s, const char *text)
{
    return find_text(s, text) != NULL;
}

static void answers_are_told_in_words(void **state)
{
    (void)state;
    static const octree_body bodies[] = {{.id = 41, .position = {3, 4, 0}},
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
    const view v = view_default();
    octree_game *game = start_game(&session);
    scene s = {0};
    build_tick(&s, &v, game);
    check_place(&s);
    assert_true(says(&s, "2: 42 41") && says(&s, "5: 100 42 41 +2"));
    assert_true(says(&s, "2 within 4.25") && says(&s, "0 within 0.5"));
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
        if (label->look.layer != LAYER_TEXT || label->at[1] == at)
            continue;
        at = label->at[1];
        rows += at <= below;
    }
    return rows;
}

/* Nothing is written below the picture; what would be is counted in its last row. */
static void rows_that_have_no_room_are_counted(void **state)
{
    (void)state;
    const octree_session session = asking_session();
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
            assert_int_equal(count_rows(&s, v.height - 10 * s.unit), count_rows(&s, 10000));
            size_t told = 0, legend = 0;
            for (size_t i = 0; i < s.labels.count; i++)
                legend += s.labels.items[i].look.layer == LAYER_TEXT && s.labels.items[i].at[0] == 34 * s.unit;
            for (size_t n = 1; n < all; n++) {
                snprintf(more, sizeof more, "and %zu more", n);
                for (size_t i = 0; i < s.labels.count; i++)
                    if (strcmp(s.labels.items[i].text, more) == 0 && s.labels.items[i].look.role == ROLE_WARNING)
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
static void ids_that_have_no_room_are_counted(void **state)
{
    (void)state;
    static const struct {
        uint64_t first;
        size_t count;
        const char *text;
    } cases[] = {{1, 0, "0"},
                 {7, 1, "1: 7"},
                 {7, 3, "3: 7 8 9"},
                 {7, 5, "5: 7 8 9 +2"},
                 {100007, 4, "4: 100007 +3"},
                 {100007, 2, "2: 100007 100008"},
                 {1000007, 2, "2: 1000007 +1"},
                 {12345678901, 12, "12: 12345678901 +11"},
                 {1234567890, 12, "12: 1234567890 +11"},
                 {UINT64_MAX - 20, 12, "12"}};
    const view v = view_default();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        octree_body bodies[12];
        for (size_t j = 0; j < cases[i].count; j++)
            bodies[j] = (octree_body){.id = cases[i].first + j, .position = {5, 5, 5 + (double)j / 8}};
        const octree_query query = {
            .tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{4, 4, 4}, {10, 10, 10}}};
        octree_session session = small_session(bodies, cases[i].count);
        session.tree.full_leaf = OCTREE_GROW;
        session.queries = &query;
        session.query_count = 1;
        octree_game *game = start_game(&session);
        scene s = {0};
        bool told = false;
        build_tick(&s, &v, game);
        for (size_t j = 0; j < s.labels.count; j++)
            told = told || strcmp(s.labels.items[j].text, cases[i].text) == 0;
        const bool fits = strlen(cases[i].text) <= 17; /* letters beside a name */
        assert_int_equal(told, fits);
        if (!fits)
            assert_true(says(&s, "12") && !says(&s, "12:"));
        scene_release(&s);
        octree_game_destroy(game);
    }
}

static void the_legend_has_what_the_diagram_shows(void **state)
{
    (void)state;
    brute all = {0};
    const octree_box world = cube(-1000, 1000);
    brute_sample(&all, OCTREE_SAMPLE_UNIFORM, 3, &world, 4000);
    octree *large = brute_tree(&all, world, 4, OCTREE_MAX_DEPTH);
    all.count = 40;
    octree *small = brute_tree(&all, world, 4, OCTREE_MAX_DEPTH);
    for (int i = 0; i < 16; i++) {
        view v = view_default();
        scene s = {0};
        v.diagram = i & 1 ? DIAGRAM_ONLY : DIAGRAM_BESIDE;
        v.filter.leaves = i & 2;
        const tree_look about = {.title = "legend", .node = i & 8 ? OCTREE_ROOT : 0};
        assert_true(look_scene_build(&s, &v, i & 4 ? large : small, &about));
        assert_true(says(&s, "inner node, leaf") && says(&s, "node, shallow to deep"));
        assert_int_equal(says(&s, "node filtered out"), (i & 2) != 0);
        assert_int_equal(says(&s, "nodes, log2, folded"), (i & 4) != 0);
        assert_int_equal(says(&s, "way from the root"), (i & 8) != 0);
        scene_release(&s);
    }
    brute_free(&all);
    octree_destroy(small);
    octree_destroy(large);
}

static void the_column_never_takes_more_than_half_the_picture(void **state)
{
    (void)state;
    for (int width = 1; width <= 16384; width += 1 + width / 50) {
        for (int height = 1; height <= 16384; height += 1 + height / 20) {
            const view v = view_of(width, height, CAMERA_ISO, VIEW_ALL_LAYERS);
            const view wordless = view_of(width, height, CAMERA_ISO, VIEW_ALL_LAYERS & ~(1u << LAYER_TEXT));
            assert_true(panel_width(&v) >= 0 && 2 * panel_width(&v) <= width);
            assert_int_equal(panel_width(&wordless), 0);
        }
    }
}

static void a_picture_too_small_for_the_column_has_its_facts_all_the_same(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    const view v = view_of(64, 48, CAMERA_ISO, VIEW_ALL_LAYERS);
    octree_game *game = start_game(&session);
    scene s = {0};
    build_tick(&s, &v, game);
    assert_int_equal(panel_width(&v), 0);
    assert_int_equal(s.panels.count, 0);
    check_facts(&s, game);
    octree_game_destroy(game);
    scene_release(&s);
}

/* The longest of everything: ids of twenty digits, positions of many, titles beyond the room of a text. */
static void numbers_of_any_length_stay_texts(void **state)
{
    (void)state;
    octree_body bodies[40];
    octree_session session = {.tree = define(cube(-1.2345678e300, 1.2345678e300), 1, 21, OCTREE_REFUSE)};
    session.player = (octree_player){.id = UINT64_MAX, .step = 1.2345678e299, .box_size = 1e300};
    for (size_t i = 0; i < 40; i++)
        bodies[i] = (octree_body){.id = UINT64_MAX - 1 - i, .position = {-1e-300, 1.2345678e299, -1.2345678e-299}};
    session.bodies = bodies;
    session.body_count = 40;
    session.keys = "dddd";
    octree_game *game = start_game(&session);
    scene s = {0};
    for (view v = view_default(); !octree_game_over(game); play_tick(game)) {
        build_tick(&s, &v, game);
        check_place(&s);
    }
    const view v = view_default();
    char title[500];
    memset(title, 'W', sizeof title);
    title[sizeof title - 1] = 0;
    assert_true(tree_scene_build(&s, &v, octree_game_tree(game), title));
    check_place(&s);
    octree_game_destroy(game);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_tick_tells_its_number_and_its_events),
        cmocka_unit_test(the_legend_has_the_layers_that_are_shown),
        cmocka_unit_test(the_legend_leaves_out_what_is_needed_least),
        cmocka_unit_test(the_legend_leaves_out_queries_that_the_session_never_asks),
        cmocka_unit_test(the_legend_without_keys_has_the_queries_asked_so_far_and_no_player_where_none_is),
        cmocka_unit_test(a_sweep_is_told),
        cmocka_unit_test(answers_are_told_in_words),
        cmocka_unit_test(rows_that_have_no_room_are_counted),
        cmocka_unit_test(ids_that_have_no_room_are_counted),
        cmocka_unit_test(the_legend_has_what_the_diagram_shows),
        cmocka_unit_test(the_column_never_takes_more_than_half_the_picture),
        cmocka_unit_test(a_picture_too_small_for_the_column_has_its_facts_all_the_same),
        cmocka_unit_test(numbers_of_any_length_stay_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
