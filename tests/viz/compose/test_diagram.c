/* SPDX-License-Identifier: MIT */
/* test_diagram.c - tests the diagram against a walk over the tree: each node is drawn once or in a bar, in its colour,
 * and the path to one node is marked. */
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "draw_list.h"
#include "layout.h"
#include "node_boxes.h"

static const scene_panel *find_panel(const scene *s, uint64_t id)
{
    const scene_panel *found = NULL;
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *panel = &s->panels.items[i];
        if (panel->style.layer != LAYER_DIAGRAM || panel->id != id)
            continue;
        assert_null(found);
        found = panel;
    }
    return found;
}

static const scene_segment *find_line(const scene *s, uint64_t id)
{
    const scene_segment *found = NULL;
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *line = &s->segments.items[i];
        if (line->style.layer != LAYER_DIAGRAM || line->id != id)
            continue;
        assert_null(found);
        assert_true(line->in_picture);
        found = line;
    }
    return found;
}

/* The text of the diagram that begins so, or null. */
static const char *find_words(const scene *s, const char *begin)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (s->labels.items[i].style.layer == LAYER_DIAGRAM &&
            strncmp(s->labels.items[i].text, begin, strlen(begin)) == 0)
            return s->labels.items[i].text;
    return NULL;
}

static bool panel_says(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (s->labels.items[i].style.layer == LAYER_TEXT && strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

static double center_of(const scene_panel *panel)
{
    return panel->x + panel->width / 2.0;
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

/* What a walk over the tree finds in a scene. */
typedef struct recount {
    const scene *s;
    octree_address way;
    size_t capacity, drawn, folded;
    size_t at_depth[OCTREE_MAX_DEPTH + 1], drawn_at[OCTREE_MAX_DEPTH + 1];
    double right[OCTREE_MAX_DEPTH + 1]; /* where the last node of a level ends */
    double foot[OCTREE_MAX_DEPTH + 1];  /* and where all of them end below */
} recount;

static bool is_above(octree_address node, octree_address other)
{
    for (; other > node; other >>= 3)
        ;
    return other == node;
}

/* Levels lie below each other, and nodes from the left to the right in Morton order, none on another. */
static void check_panel(recount *r, const octree_node *node, const scene_panel *panel)
{
    const unsigned depth = node->depth;
    assert_int_equal(panel->style.role,
                     node_role(&r->s->view, (node_traits){depth, node->count, r->capacity, node->leaf}));
    assert_true(panel->x >= r->right[depth]);
    r->right[depth] = panel->x + panel->width;
    r->foot[depth] = fmax(r->foot[depth], panel->y + panel->height);
    assert_true(depth == 0 || panel->y >= r->foot[depth - 1]);
}

/* A line leads from the bottom of the parent to the top of the child. */
static void check_line(recount *r, const octree_node *node, const scene_panel *panel)
{
    const scene_segment *line = find_line(r->s, node->address);
    const scene_panel *parent = find_panel(r->s, node->address >> 3);
    const bool on_way = r->way && is_above(node->address, r->way);
    assert_true(line && parent);
    assert_int_equal(line->style.role, on_way ? ROLE_PLAYER : panel->style.role);
    assert_true(fabs(line->ends[0][0] - center_of(parent)) <= 1 && fabs(line->ends[1][0] - center_of(panel)) <= 1);
    assert_true(fabs(line->ends[0][1] - (parent->y + parent->height)) <= 1 && fabs(line->ends[1][1] - panel->y) <= 1);
}

static octree_walk_order recount_node(const octree_node *node, void *context)
{
    recount *r = context;
    const scene_panel *panel = find_panel(r->s, node->address);
    r->at_depth[node->depth]++;
    if (!panel) {
        r->folded++;
        return OCTREE_WALK_ON;
    }
    check_panel(r, node, panel);
    if (node->depth)
        check_line(r, node, panel);
    r->drawn++;
    r->drawn_at[node->depth]++;
    return OCTREE_WALK_ON;
}

/* Bars tell the number of nodes within a factor of two: of `steps` as many as 2^(steps - 1) to 2^steps - 1. */
static void check_bars(const scene *s, unsigned depth, size_t nodes, double pitch)
{
    double least = 0, most = 0;
    size_t bars = 0;
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *panel = &s->panels.items[i];
        if (panel->style.layer != LAYER_DIAGRAM || panel->id >> 61 != 1 || (panel->id >> 32 & 255) != depth)
            continue;
        const double steps = ceil(panel->height * 16 / (pitch - 2 * s->unit));
        assert_true(steps >= 1 && steps <= 16);
        least += ldexp(1, (int)steps - 1);
        most += ldexp(1, (int)steps) - 1;
        bars++;
    }
    assert_true(bars > 0 && least <= (double)nodes && (double)nodes <= most);
}

/* Levels are drawn one by one or folded, never both, and no level below a folded one is drawn. */
static size_t check_levels(const recount *r, double pitch)
{
    size_t folded_levels = 0;
    for (unsigned depth = 0; depth <= OCTREE_MAX_DEPTH && r->at_depth[depth]; depth++) {
        const bool drawn = r->drawn_at[depth] > 0;
        assert_true(!drawn || (r->drawn_at[depth] == r->at_depth[depth] && folded_levels == 0));
        folded_levels += !drawn;
        if (!drawn)
            check_bars(r->s, depth, r->at_depth[depth], pitch);
    }
    return folded_levels;
}

/* The rows' counts, in the order of the depths, behind the word "nodes"; and the distance of the rows. */
static double check_counts(const scene *s, const recount *r)
{
    double rows[OCTREE_MAX_DEPTH + 1] = {0};
    unsigned depth = 0;
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        if (label->style.layer != LAYER_DIAGRAM || label->style.role != ROLE_TEXT)
            continue;
        assert_int_equal(strtoul(label->text, NULL, 10), r->at_depth[depth]);
        rows[depth++] = label->at[1];
    }
    assert_true(depth > 0 && (depth > OCTREE_MAX_DEPTH || r->at_depth[depth] == 0));
    return depth > 1 ? (rows[depth - 1] - rows[0]) / (depth - 1) : 0;
}

static recount check_diagram(const scene *s, const octree *tree, octree_address way)
{
    recount r = {.s = s, .way = way, .capacity = octree_definition(tree).leaf_capacity};
    assert_int_equal(octree_walk(tree, recount_node, &r), OCTREE_OK);
    assert_int_equal(s->tally.drawn, r.drawn);
    assert_int_equal(s->tally.folded, r.folded);
    const double pitch = view_shows_layer(&s->view, LAYER_TEXT) ? check_counts(s, &r) : 0;
    const size_t folded = check_levels(&r, pitch);
    assert_int_equal(folded ? s->tally.folded_to - s->tally.folded_from + 1 : 0, folded);
    return r;
}

/* ---- The way ------------------------------------------------------------------------------------------------ */

/* Find the leaf that holds a point by searching all leaves. */
typedef struct search {
    uint64_t id;
    octree_address leaf;
} search;

static octree_walk_order look_into(const octree_node *node, void *context)
{
    search *wanted = context;
    for (size_t i = 0; node->leaf && i < node->count; i++)
        if (node->points[i].id == wanted->id)
            wanted->leaf = node->address;
    return OCTREE_WALK_ON;
}

/* All nodes on the path are marked, and no others. */
static void check_way(const scene *s, octree_address leaf)
{
    char text[OCTREE_ADDRESS_TEXT], wanted[OCTREE_ADDRESS_TEXT + 8];
    const unsigned deep = octree_address_depth(leaf);
    size_t yellow = 0;
    for (unsigned depth = 0; depth <= deep; depth++) {
        const scene_panel *mark = find_panel(s, UINT64_C(1) << 62 | depth);
        const scene_panel *node = find_panel(s, leaf >> 3 * (deep - depth));
        assert_true(mark && mark->style.role == ROLE_PLAYER);
        if (node)
            assert_true(mark->x < node->x && mark->y < node->y && mark->x + mark->width > node->x + node->width);
        if (depth)
            assert_int_equal(find_line(s, leaf >> 3 * (deep - depth))->style.role, ROLE_PLAYER);
    }
    for (size_t i = 0; i < s->segments.count; i++)
        yellow += s->segments.items[i].style.layer == LAYER_DIAGRAM && s->segments.items[i].style.role == ROLE_PLAYER;
    assert_int_equal(yellow, deep);
    assert_int_equal(s->tally.path, deep + 1);
    snprintf(wanted, sizeof wanted, ": %s", octree_address_format(leaf, text));
    assert_non_null(strstr(find_words(s, "leaf of "), wanted));
}

static void check_tick(const scene *s, const octree_game *game)
{
    const octree *tree = octree_game_tree(game);
    search player = {.id = octree_game_session(game)->player.id};
    octree_walk(tree, look_into, &player);
    assert_true(player.leaf != 0);
    check_diagram(s, tree, player.leaf);
    check_way(s, player.leaf);
}

static void every_tick_shows_each_node_once_and_the_path_to_the_player(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    octree_game *game = start_game(&session);
    scene s = {0};
    view v = view_make_default();
    for (int tick = 0;; tick++) {
        v.diagram = tick % 2 ? DIAGRAM_ONLY : DIAGRAM_BESIDE;
        v.coloring = (view_coloring)(tick % COLORING_COUNT);
        build_tick(&s, &v, game);
        check_tick(&s, game);
        assert_int_equal(s.tally.folded, 0);
        if (octree_game_over(game))
            break;
        play_tick(game);
    }
    scene_release(&s);
    octree_game_destroy(game);
}

/* ---- Large trees -------------------------------------------------------------------------------------------- */

static octree *sampled(octree_sample_kind kind, size_t count, size_t capacity)
{
    brute all = {0};
    const octree_box world = cube(-1000, 1000);
    brute_sample(&all, kind, 3, &world, count);
    octree *tree = brute_tree(&all, world, capacity, OCTREE_MAX_DEPTH);
    brute_free(&all);
    return tree;
}

static scene look_at(const view *v, const octree *tree, octree_address node)
{
    scene s = {0};
    const tree_subject about = {.title = "diagram", .node = node};
    assert_true(tree_scene_build(&s, v, tree, &about));
    assert_int_equal(s.refused, 0);
    return s;
}

static void levels_without_room_are_folded_and_counted(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        octree *tree = sampled(i % 2 ? OCTREE_SAMPLE_CLUSTERED : OCTREE_SAMPLE_UNIFORM, i < 4 ? 300 : 4000, 2);
        view v = view_of(i & 2 ? 1280 : 640, i & 2 ? 720 : 360, CAMERA_ISO, 1u << LAYER_TEXT);
        v.diagram = i % 3 ? DIAGRAM_BESIDE : DIAGRAM_ONLY;
        scene s = look_at(&v, tree, 0);
        const recount r = check_diagram(&s, tree, 0);
        assert_true(r.folded > 0 && r.drawn_at[1] > 0 && r.drawn + r.folded == node_count(tree));
        assert_int_equal(s.tally.path, 0);
        scene_release(&s);
        octree_destroy(tree);
    }
}

/* 40,000 leaves in all but an instant, and the words say what is folded. */
static void tree_of_forty_thousand_leaves_is_readable(void **state)
{
    (void)state;
    octree *tree = sampled(OCTREE_SAMPLE_CLUSTERED, 80000, 4);
    octree_stats stats;
    char wanted[SCENE_TEXT];
    octree_statistics(tree, &stats);
    assert_true(stats.leaves >= 40000);
    view v = view_of(640, 360, CAMERA_ISO, 1u << LAYER_TEXT);
    v.diagram = DIAGRAM_BESIDE;
    octree_node leaf;
    search some = {.id = 4711};
    octree_walk(tree, look_into, &some);
    scene s = look_at(&v, tree, some.leaf);
    assert_int_equal(octree_node_at(tree, some.leaf, &leaf), OCTREE_OK);
    assert_true(count_layer(&s, LAYER_DIAGRAM).panels < 2000);
    assert_int_equal(s.tally.drawn + s.tally.folded, stats.nodes);
    check_way(&s, some.leaf);
    unsigned drawn = 0;
    while (s.tally.drawn > 0 && stats.nodes_at_depth[drawn] <= s.tally.drawn)
        s.tally.drawn -= stats.nodes_at_depth[drawn++];
    assert_int_equal(s.tally.drawn, 0);
    assert_true(drawn >= 2); /* eight nodes always have room */
    snprintf(wanted, sizeof wanted, "depths %u to %u", drawn, stats.depth);
    assert_true(panel_says(&s, wanted));
    assert_string_equal(find_words(&s, "0"), "0"); /* the first level's number */
    scene_release(&s);
    octree_destroy(tree);
}

/* ---- Steadiness --------------------------------------------------------------------------------------------- */

static octree_walk_order same_place(const octree_node *node, void *context)
{
    const scene *const *both = context;
    const scene_panel *a = find_panel(both[0], node->address), *b = find_panel(both[1], node->address);
    assert_true(!a || (b && a->x == b->x && a->y == b->y && a->width == b->width && a->height == b->height));
    return OCTREE_WALK_ON;
}

/* Octants that were empty: a point in each makes leaves, and what was there before stays. */
static void filling_an_empty_octant_moves_nothing(void **state)
{
    (void)state;
    static const double first[][3] = {{-900, -900, -900}, {900, 900, 900}, {600, 600, 600}, {600, 600, 900}},
                        more[][3] = {{-900, 900, -900}, {-900, -900, 900}, {900, -900, 900}, {600, 900, 600}};
    octree *before = make_tree(cube(-1000, 1000), 1, 5, OCTREE_REFUSE);
    octree *after = make_tree(cube(-1000, 1000), 1, 5, OCTREE_REFUSE);
    insert_all(before, first, 4);
    insert_all(after, first, 4);
    view v = view_make_default();
    v.diagram = DIAGRAM_BESIDE;
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(octree_insert(after, more[i], 10 + i), OCTREE_OK);
        scene a = look_at(&v, before, 0), b = look_at(&v, after, 0);
        assert_int_equal(b.tally.drawn, a.tally.drawn + i + 1);
        assert_int_equal(octree_walk(before, same_place, (const scene *[]){&a, &b}), OCTREE_OK);
        scene_release(&a);
        scene_release(&b);
    }
    octree_destroy(before);
    octree_destroy(after);
}

/* ---- The view ----------------------------------------------------------------------------------------------- */

/* The leaves alone: inner nodes are grey, and so are the lines to them. */
static octree_walk_order grey_unless_leaf(const octree_node *node, void *context)
{
    const scene *s = context;
    assert_int_equal(find_panel(s, node->address)->style.role == ROLE_WORLD, !node->leaf);
    if (node->depth)
        assert_int_equal(find_line(s, node->address)->style.role == ROLE_WORLD, !node->leaf);
    return OCTREE_WALK_ON;
}

static void filtered_nodes_are_grey(void **state)
{
    (void)state;
    octree *tree = sampled(OCTREE_SAMPLE_UNIFORM, 40, 4);
    view v = view_make_default();
    v.diagram = DIAGRAM_ONLY;
    v.filter.leaves = true;
    scene s = look_at(&v, tree, 0);
    assert_int_equal(s.tally.folded, 0);
    assert_int_equal(octree_walk(tree, grey_unless_leaf, &s), OCTREE_OK);
    scene_release(&s);
    octree_destroy(tree);
}

static void diagram_only_view_has_only_diagram_and_panel(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    octree_game *game = start_game(&session);
    scene s = {0};
    view v = view_make_default();
    v.diagram = DIAGRAM_ONLY;
    build_tick(&s, &v, game);
    for (int layer = 0; layer < LAYER_TEXT; layer++) {
        const layer_counts found = count_layer(&s, (unsigned)layer);
        assert_int_equal(found.boxes + found.segments + found.markers + found.labels + found.panels, 0);
    }
    assert_true(count_layer(&s, LAYER_TEXT).labels > 0 && count_layer(&s, LAYER_DIAGRAM).panels > 0);
    v.diagram = DIAGRAM_NONE;
    build_tick(&s, &v, game);
    const layer_counts none = count_layer(&s, LAYER_DIAGRAM);
    assert_int_equal(none.boxes + none.segments + none.markers + none.labels + none.panels, 0);
    assert_int_equal(s.tally.drawn + s.tally.folded + s.tally.path, 0);
    scene_release(&s);
    octree_game_destroy(game);
}

/* Beside the space view the same of it is shown as alone: the same boxes, points, lines and marks of the world. */
static void space_view_beside_the_diagram_has_all_its_elements(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    octree_game *game = start_game(&session);
    scene alone = {0}, beside = {0};
    view v = view_make_default();
    build_tick(&alone, &v, game);
    v.diagram = DIAGRAM_BESIDE;
    build_tick(&beside, &v, game);
    for (unsigned layer = LAYER_NODES; layer < LAYER_TEXT; layer++) {
        const layer_counts a = count_layer(&alone, layer), b = count_layer(&beside, layer);
        assert_true(a.boxes == b.boxes && a.segments == b.segments && a.markers == b.markers);
    }
    scene_release(&alone);
    scene_release(&beside);
    octree_game_destroy(game);
}

/* Every element of the diagram lies within its part, and the parts do not overlap. */
static void check_inside(const scene *s)
{
    const camera_window w = layout_diagram_area(&s->view), space = layout_space_area(s);
    assert_true(s->view.diagram == DIAGRAM_ONLY || space.x + space.width <= w.x || space.y + space.height <= w.y);
    assert_true(space.width >= 1 && space.height >= 1);
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *p = &s->panels.items[i];
        assert_true(
            p->style.layer != LAYER_DIAGRAM ||
            (p->x >= w.x && p->y >= w.y && p->x + p->width <= w.x + w.width && p->y + p->height <= w.y + w.height));
    }
    for (size_t i = 0; i < s->segments.count; i++)
        for (int end = 0; end < 2 && s->segments.items[i].in_picture; end++) {
            const double *at = s->segments.items[i].ends[end];
            assert_true(at[0] >= w.x && at[0] <= w.x + w.width && at[1] >= w.y && at[1] <= w.y + w.height);
        }
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        const double right = label->at[0] + (double)strlen(label->text) * s->text.width;
        assert_true(label->style.layer != LAYER_DIAGRAM ||
                    (label->at[0] >= w.x && right <= w.x + w.width && label->at[1] + s->text.height <= w.y + w.height));
    }
}

static void a_diagram_of_any_size_stays_in_its_part(void **state)
{
    (void)state;
    static const int sides[] = {1, 2, 3, 16, 33, 64, 100, 180, 320, 360, 720, 1280, 3840};
    octree *trees[] = {make_tree(cube(0, 1), 1, 0, OCTREE_REFUSE), sampled(OCTREE_SAMPLE_CLUSTERED, 700, 1)};
    const size_t count = sizeof sides / sizeof sides[0];
    for (size_t i = 0; i < count * count * 4; i++) {
        view v = view_of(sides[i / 4 % count], sides[i / 4 / count], CAMERA_ISO, i & 1 ? 1u << LAYER_TEXT : 0);
        v.diagram = i & 2 ? DIAGRAM_ONLY : DIAGRAM_BESIDE;
        for (int t = 0; t < 2; t++) {
            scene s = look_at(&v, trees[t], OCTREE_ROOT);
            check_inside(&s);
            scene_release(&s);
        }
    }
    octree_destroy(trees[0]);
    octree_destroy(trees[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_tick_shows_each_node_once_and_the_path_to_the_player),
        cmocka_unit_test(levels_without_room_are_folded_and_counted),
        cmocka_unit_test(tree_of_forty_thousand_leaves_is_readable),
        cmocka_unit_test(filling_an_empty_octant_moves_nothing),
        cmocka_unit_test(filtered_nodes_are_grey),
        cmocka_unit_test(diagram_only_view_has_only_diagram_and_panel),
        cmocka_unit_test(space_view_beside_the_diagram_has_all_its_elements),
        cmocka_unit_test(a_diagram_of_any_size_stays_in_its_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
