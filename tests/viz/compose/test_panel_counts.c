/* SPDX-License-Identifier: MIT */
/* test_panel_counts.c - tests every number in the panel against the tick's line in ticks.jsonl and against a recount
 * from the points alone, which divides the world again. test_visit_layers.c does the same for visited nodes, test_lod.c
 * for elements left out. */
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw_list.h"
#include "pen.h"
#include "random_session.h"
#include "tick_lines.h"
#include "ticks_write.h"

enum { MOST_POINTS = 400, MOST_INNER = 8192 };

/* ---- The recount -------------------------------------------------------------------------------------------- */

/* A tree's points, and what dividing the world among them comes to. */
typedef struct division {
    octree_point points[MOST_POINTS];
    size_t count, nodes, leaves;
    unsigned depth;
    octree_address inner[MOST_INNER];
    size_t inner_count;
} division;

static octree_walk_order take_points(const octree_node *node, void *context)
{
    division *d = context;
    assert_true(!node->leaf || d->count + node->count <= MOST_POINTS);
    for (size_t i = 0; node->leaf && i < node->count; i++)
        d->points[d->count++] = node->points[i];
    return OCTREE_WALK_ON;
}

/* A leaf where there is room for all, or none deeper; else a node for each octant that has points. */
static void divide(division *d, const octree_def *def, octree_address node, const octree_point *points, size_t count)
{
    const unsigned depth = octree_address_depth(node);
    d->nodes++;
    d->depth = depth > d->depth ? depth : d->depth;
    if (count <= def->leaf_capacity || depth == def->max_depth) {
        d->leaves++;
        return;
    }
    const octree_box first = octree_cell_box(&def->world, node << 3);
    assert_true(d->inner_count < MOST_INNER);
    d->inner[d->inner_count++] = node;
    for (unsigned octant = 0; octant < 8; octant++) {
        octree_point part[MOST_POINTS];
        size_t in_part = 0;
        for (size_t i = 0; i < count; i++) {
            const double *p = points[i].position;
            if ((p[0] >= first.max[0]) * 4u + (p[1] >= first.max[1]) * 2u + (p[2] >= first.max[2]) == octant)
                part[in_part++] = points[i];
        }
        if (in_part)
            divide(d, def, node << 3 | octant, part, in_part);
    }
}

static void recount(division *d, const octree *tree)
{
    const octree_def def = octree_definition(tree);
    d->count = d->nodes = d->leaves = d->inner_count = 0;
    d->depth = 0;
    octree_walk(tree, take_points, d);
    divide(d, &def, OCTREE_ROOT, d->points, d->count);
}

/* Nodes that are inner ones in one and not in the other. */
static size_t count_new(const division *now, const division *before)
{
    size_t count = 0;
    for (size_t i = 0; i < now->inner_count; i++) {
        bool old = false;
        for (size_t j = 0; j < before->inner_count; j++)
            old = old || before->inner[j] == now->inner[i];
        count += !old;
    }
    return count;
}

static double square_distance(const double a[3], const double b[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

static size_t count_in_box(const division *d, const octree_box *box)
{
    size_t count = 0;
    for (size_t i = 0; i < d->count; i++)
        count += box_holds(box, d->points[i].position);
    return count;
}

static size_t count_in_ball(const division *d, const double center[3], double radius)
{
    size_t count = 0;
    for (size_t i = 0; i < d->count; i++)
        count += square_distance(d->points[i].position, center) <= radius * radius;
    return count;
}

/* The nearest point but one, ties to the lowest id; null where there is none. */
static const octree_point *find_nearest(const division *d, const double target[3], bool skips, uint64_t skip)
{
    const octree_point *best = NULL;
    for (size_t i = 0; i < d->count; i++) {
        const octree_point *p = &d->points[i];
        if (skips && p->id == skip)
            continue;
        const double here = square_distance(p->position, target),
                     there = best ? square_distance(best->position, target) : 0;
        if (!best || here < there || (here == there && p->id < best->id))
            best = p;
    }
    return best;
}

/* ---- The column --------------------------------------------------------------------------------------------- */

/* Whether a text of the column begins with the line, or ends with it. */
static bool is_left(const scene *s, const scene_label *label)
{
    return label->at[0] == LAYOUT_MARGIN * s->text.width;
}

static bool is_right(const scene *s, const scene_label *label)
{
    const size_t end = LAYOUT_MARGIN + LAYOUT_LETTERS - strlen(label->text);
    return label->at[0] == (double)end * s->text.width;
}

/* The value of the n-th row of this name, or null; its detail is the text before, where there is one. */
static const scene_label *find_row(const scene *s, const char *name, size_t n)
{
    for (size_t i = 0; i + 1 < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i], *value = label + 1;
        if (label->style.layer != LAYER_TEXT || strcmp(label->text, name) != 0 || !is_left(s, label))
            continue;
        if (!is_right(s, value) && i + 2 < s->labels.count)
            value++;
        if (value->at[1] != label->at[1] || !is_right(s, value))
            continue; /* an event's word */
        if (n-- == 0)
            return value;
    }
    return NULL;
}

static const char *row_of(const scene *s, const char *name, size_t n)
{
    const scene_label *value = find_row(s, name, n);
    return value ? value->text : NULL;
}

/* Of a row that is there; empty where there is none. */
static const char *detail_of(const scene *s, const char *name, size_t n)
{
    const scene_label *value = find_row(s, name, n);
    assert_non_null(value);
    return is_left(s, value - 1) ? "" : value[-1].text;
}

static void assert_row(const scene *s, const char *name, size_t n, const char *format, ...)
{
    char expected[SCENE_TEXT];
    const char *row = row_of(s, name, n);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(expected, sizeof expected, format, arguments);
    va_end(arguments);
    assert_non_null(row);
    assert_string_equal(row, expected);
}

/* The number that a row of ids ends with, the first id, and how many of them are named or counted: all, or none where
 * there is no room for the first. */
static void assert_ids(const scene *s, const char *name, size_t n, size_t count, uint64_t first)
{
    assert_row(s, name, n, "%zu found", count);
    const char *ids = detail_of(s, name, n);
    assert_true(count || !*ids);
    if (!*ids)
        return;
    char *end = (char *)ids;
    size_t told = 0;
    assert_int_equal(strtoull(ids + 1, NULL, 10), first);
    for (; *end; end += *end == ' ') {
        const bool rest = *end == '+';
        assert_true(rest || *end == '#');
        const uint64_t number = strtoull(end + 1, &end, 10);
        told += rest ? number : 1;
    }
    assert_int_equal(told, count);
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

static json_t *line_of(const octree_game *game)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    tick_write(out, octree_game_tick(game), &(tick_extras){.frame = NULL});
    assert_int_equal(fclose(out), 0);
    json_t *line = json_read(text);
    free(text);
    return line;
}

static void check_tree(const scene *s, const json_t *line, const division *d, const octree *tree)
{
    const json_t *told = json_member(line, "tree");
    assert_row(s, "points", 0, "%zu", d->count);
    assert_row(s, "nodes", 0, "%zu", d->nodes);
    assert_row(s, "leaves", 0, "%zu", d->leaves);
    assert_row(s, "depth", 0, "%u of max %zu", d->depth, octree_definition(tree).max_depth);
    assert_whole_number(json_member(told, "points"), d->count);
    assert_whole_number(json_member(told, "nodes"), d->nodes);
    assert_whole_number(json_member(told, "leaves"), d->leaves);
    assert_whole_number(json_member(told, "depth"), d->depth);
}

/* Whether the legend has a line of this count, or has no line because nothing is drawn. */
static bool legend_says(const scene *s, size_t count, const char *word, view_layer layer)
{
    char begin[SCENE_TEXT];
    const bool drawn = count_layer(s, layer).segments > 0;
    assert_true(count > 0 || !drawn);
    const int length = snprintf(begin, sizeof begin, "%zu node%s %s", count, count == 1 ? "" : "s", word);
    for (size_t i = 0; i < s->labels.count; i++)
        if (strncmp(s->labels.items[i].text, begin, (size_t)length) == 0)
            return drawn;
    return !drawn;
}

static void check_changes(const scene *s, const json_t *line, const division *now, const division *before)
{
    const size_t splits = before ? count_new(now, before) : 0, merges = before ? count_new(before, now) : 0;
    assert_true(legend_says(s, splits, "split", LAYER_SPLITS));
    assert_true(legend_says(s, merges, "merged", LAYER_MERGES));
    assert_int_equal(json_array_size(json_member(line, "splits")), splits);
    assert_int_equal(json_array_size(json_member(line, "merges")), merges);
}

/* Those of a swept way are held against the truth in test_exact_swept.c. */
static void check_hits(const scene *s, const json_t *line, const division *d, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree_player *player = &octree_game_session(game)->player;
    size_t count = json_array_size(json_member(line, "hits"));
    octree_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = tick->attempt[i] - player->box_size;
        box.max[i] = tick->attempt[i] + player->box_size;
    }
    if (!tick->swept) {
        const size_t found = count_in_box(d, &box) - box_holds(&box, tick->player); /* the player is in the tree */
        assert_int_equal(count, found);
    }
    if (tick->hit_count)
        assert_ids(s, "box hits", 0, count, count ? tick->hits[0].id : 0);
    else
        assert_null(row_of(s, "box hits", 0));
}

static void check_neighbors(const scene *s, const json_t *told, const division *d, const octree_answer *answer,
                            bool at_player, uint64_t player, size_t seen[])
{
    if (answer->kind == OCTREE_QUERY_RAY || answer->kind == OCTREE_QUERY_SWEEP) {
        const char *name = octree_query_name(answer->kind);
        assert_int_equal(json_array_size(json_member(json_member(told, name), "neighbors")), answer->count);
        assert_ids(s, name, seen[answer->kind], answer->count, answer->count ? answer->neighbors[0].point.id : 0);
        return;
    }
    const octree_point *nearest = find_nearest(d, answer->target, at_player, player);
    const size_t others = d->count - at_player;
    if (answer->kind == OCTREE_QUERY_KNEAREST) {
        const size_t count = answer->k < others ? answer->k : others;
        assert_int_equal(json_array_size(json_member(json_member(told, "knearest"), "neighbors")), count);
        assert_ids(s, "k nearest", seen[answer->kind], count, count ? nearest->id : 0);
        return;
    }
    const json_t *id = json_member(json_member(told, "nearest"), "id");
    const char *row = row_of(s, "nearest", seen[answer->kind]);
    assert_non_null(row);
    if (nearest) {
        assert_whole_number(id, nearest->id);
        const char *detail = detail_of(s, "nearest", seen[answer->kind]);
        assert_int_equal(strtoull((*detail ? detail : row) + 1, NULL, 10), nearest->id);
    } else {
        assert_true(json_is_null(id));
        assert_string_equal(row, "none");
    }
}

static void check_answers(const scene *s, const json_t *line, const division *d, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree_player *player = &octree_game_session(game)->player;
    const json_t *told = json_member(line, "answers");
    size_t seen[OCTREE_QUERY_KINDS] = {0};
    assert_int_equal(json_array_size(told), tick->answer_count);
    for (size_t i = 0; i < tick->answer_count; i++) {
        const octree_answer *answer = &tick->answers[i];
        const json_t *one = json_array_get(told, i);
        if (answer->kind == OCTREE_QUERY_RANGE) {
            const size_t count = count_in_box(d, &answer->box);
            assert_int_equal(json_array_size(json_member(json_member(one, "range"), "ids")), count);
            assert_ids(s, "range", seen[answer->kind], count, count ? answer->points[0].id : 0);
        } else if (answer->kind == OCTREE_QUERY_FRUSTUM) {
            assert_int_equal(json_array_size(json_member(json_member(one, "frustum"), "ids")), answer->count);
            assert_ids(s, "frustum", seen[answer->kind], answer->count, answer->count ? answer->points[0].id : 0);
        } else if (answer->kind == OCTREE_QUERY_RADIUS) {
            const size_t count = count_in_ball(d, answer->target, answer->radius);
            assert_int_equal(json_array_size(json_member(json_member(one, "radius"), "ids")), count);
            assert_row(s, "radius", seen[answer->kind], "%zu found", count);
            const double told_radius = strtod(detail_of(s, "radius", seen[answer->kind]), NULL);
            assert_true(fabs(told_radius - answer->radius) <= 5e-6 * answer->radius);
        } else {
            const bool at_player = same_position(answer->target, tick->player) && answer->count < d->count;
            bool player_found = false;
            for (size_t j = 0; j < answer->count; j++)
                player_found = player_found || answer->neighbors[j].point.id == player->id;
            check_neighbors(s, one, d, answer, at_player && !player_found, player->id, seen);
        }
        seen[answer->kind]++;
    }
}

static void check_refusals(const scene *s, const json_t *line)
{
    const size_t count = json_array_size(json_member(line, "refusals"));
    assert_int_equal(row_of(s, "refused", 0) != NULL, count > 0);
    char more[SCENE_TEXT];
    snprintf(more, sizeof more, "and %zu more", count - 2);
    bool told = false;
    for (size_t i = 0; i < s->labels.count; i++)
        told = told || strcmp(s->labels.items[i].text, more) == 0;
    assert_true(count <= 2 || told);
}

static void check_session(const octree_session *session)
{
    static division divisions[2];
    const view v = view_of(1280, 4000, CAMERA_ISO, VIEW_DEFAULT_LAYERS);
    octree_game *game = start_game(session);
    scene s = {0};
    for (size_t n = 0;; n++) {
        division *now = &divisions[n % 2];
        recount(now, octree_game_tree(game));
        build_tick(&s, &v, game);
        json_t *line = line_of(game);
        check_tree(&s, line, now, octree_game_tree(game));
        check_changes(&s, line, now, n ? &divisions[1 - n % 2] : NULL);
        check_hits(&s, line, now, game);
        check_answers(&s, line, now, game);
        check_refusals(&s, line);
        json_decref(line);
        if (octree_game_over(game))
            break;
        play_tick(game);
    }
    scene_release(&s);
    octree_game_destroy(game);
}

static void panel_counts_of_the_default_session_match_a_recount(void **state)
{
    (void)state;
    const octree_session session = session_of_points_with_all_layers();
    check_session(&session);
}

static void panel_counts_of_random_sessions_match_a_recount(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        static random_session made;
        random_session_full(&made, seed);
        check_session(&made.session);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panel_counts_of_the_default_session_match_a_recount),
        cmocka_unit_test(panel_counts_of_random_sessions_match_a_recount),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
