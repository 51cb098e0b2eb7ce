/* SPDX-License-Identifier: MIT */
/* test_kept_tree.c - tests that a scene that reuses unchanged subtrees of the scene before equals a scene made from
 * nothing.
 */
#include "kept_tree.h"
#include "octree/sample.h"
#include "scenes.h"
#include "tick_scene.h"

#include <stdlib.h>
#include <string.h>

enum { BODIES = 5000, TICKS = 24, FEW = 6, MANY = 2400, MOST_EDITS = TICKS * FEW + 2 * MANY };

typedef struct played {
    octree_session session;
    octree_game_body bodies[BODIES];
    octree_edit edits[MOST_EDITS];
    size_t edit_count;
    bool gone[BODIES];
} played;

static void add_edit(played *p, uint64_t tick, octree_edit_kind kind, size_t body, const double near[3])
{
    octree_edit *e = &p->edits[p->edit_count++];
    *e = (octree_edit){.tick = tick, .kind = kind, .body = p->bodies[body]};
    for (int i = 0; near && i < 3; i++)
        e->body.position[i] = near[i] + 1e-3 * (double)(body % 7);
    memcpy(p->bodies[body].position, e->body.position, sizeof e->body.position);
    p->gone[body] = kind == OCTREE_EDIT_REMOVE;
}

/* Points gather around others, so that leaves split, and leave again, so that nodes merge. */
static void add_few(played *p, uint64_t tick)
{
    for (size_t i = 0; i < FEW; i++) {
        const size_t body = (tick * 131 + i * 977) % BODIES, other = (tick * 131) % BODIES;
        if (p->gone[body])
            add_edit(p, tick, OCTREE_EDIT_INSERT, body, p->bodies[other].position);
        else
            add_edit(p, tick, i % 3 == 2 ? OCTREE_EDIT_REMOVE : OCTREE_EDIT_MOVE, body, p->bodies[other].position);
    }
}

/* Half of all points go in one tick and return in a later one, which changes the points that the budget drops. */
static void add_many(played *p, uint64_t tick, bool go)
{
    size_t count = 0;
    for (size_t body = 0; body < BODIES && count < MANY; body++)
        if (p->gone[body] != go) {
            add_edit(p, tick, go ? OCTREE_EDIT_REMOVE : OCTREE_EDIT_INSERT, body, NULL);
            count++;
        }
}

static played *make_session(void)
{
    static char keys[TICKS];
    played *p = calloc(1, sizeof *p);
    double(*positions)[3] = malloc(BODIES * sizeof *positions);
    assert_non_null(p);
    assert_non_null(positions);
    p->session = (octree_session){.tree = octree_def_default(), .player = {.step = 40, .box_size = 3}};
    p->session.tree.leaf_capacity = 4;
    p->session.tree.full_leaf = OCTREE_GROW;
    assert_int_equal(octree_sample(OCTREE_SAMPLE_CLUSTERED, 3, &p->session.tree.world, BODIES, positions), OCTREE_OK);
    for (size_t i = 0; i < BODIES; i++) {
        p->bodies[i].id = i + 1;
        memcpy(p->bodies[i].position, positions[i], sizeof positions[i]);
    }
    free(positions);
    const octree_game_body *start = malloc(sizeof p->bodies);
    assert_non_null(start);
    memcpy((octree_game_body *)start, p->bodies, sizeof p->bodies);
    for (uint64_t tick = 1; tick < TICKS; tick++)
        if (tick == 9 || tick == 16)
            add_many(p, tick, tick == 9);
        else if (tick % 4 != 3)
            add_few(p, tick);
    for (size_t i = 0; i + 1 < TICKS; i++)
        keys[i] = "wden"[i % 4];
    p->session.bodies = start;
    p->session.body_count = BODIES;
    p->session.edits = p->edits;
    p->session.edit_count = p->edit_count;
    p->session.keys = keys;
    return p;
}

static void release_session(played *p)
{
    free((octree_game_body *)p->session.bodies);
    free(p);
}

static void expect_same(const scene *kept, const scene *whole)
{
    const scene_tally *a = &kept->tally, *b = &whole->tally;
    assert_int_equal(kept->boxes.count, whole->boxes.count);
    assert_int_equal(kept->markers.count, whole->markers.count);
    assert_int_equal(a->nodes, b->nodes);
    assert_int_equal(a->points, b->points);
    assert_int_equal(a->small, b->small);
    assert_int_equal(a->beyond, b->beyond);
    assert_int_equal(a->deepest, b->deepest);
    assert_int_equal(a->thinned, b->thinned);
    assert_int_equal(a->one_in, b->one_in);
    assert_true(scene_digest(kept) == scene_digest(whole));
}

/* Count the subtrees that are in the same memory as a subtree of the scene before. */
static size_t count_kept_on(const kept_list *now)
{
    static const kept_node *before[BODIES];
    static size_t before_count;
    size_t count = 0;
    for (size_t i = 0; i < now->count; i++)
        for (size_t j = 0; j < before_count; j++)
            count += now->items[i].nodes == before[j];
    assert_true(now->count <= BODIES);
    for (before_count = 0; before_count < now->count; before_count++)
        before[before_count] = now->items[before_count].nodes;
    return count;
}

/* Make a scene every few ticks. Return the number of scenes that reused a subtree. */
static unsigned compare_scenes(const view *v, uint64_t every)
{
    played *p = make_session();
    octree_game *game;
    scene kept = {0};
    unsigned count = 0;
    const point_values none = {0}; /* a session read from a file has a table of values, even if no point has any */
    size_t kept_on = count_kept_on(&(kept_list){0}); /* none before the first */
    assert_int_equal(octree_game_create(&p->session, &game), OCTREE_OK);
    for (uint64_t tick = 0; tick < TICKS; tick++) {
        if (tick > 0)
            assert_int_equal(octree_game_advance(game), OCTREE_OK);
        if (tick % every != 0)
            continue;
        scene whole = {0};
        assert_true(tick_scene_build(&kept, v, game, NULL, &none));
        assert_true(tick_scene_build(&whole, v, game, NULL, NULL));
        expect_same(&kept, &whole);
        count += kept.kept && kept.kept->now.count > 0;
        kept_on += kept.kept ? count_kept_on(&kept.kept->now) : 0;
        scene_release(&whole);
    }
    scene_release(&kept);
    octree_game_destroy(game);
    release_session(p);
    assert_true(kept_on > 0 || count < TICKS / 2);
    return count;
}

static view look(void)
{
    view v = view_of(320, 180, CAMERA_ORBIT, VIEW_DEFAULT_LAYERS);
    v.lod = v.budget = 0;
    return v;
}

/* At least half of the scenes reuse subtrees; the first and those after many changes do not. */
static void scenes_with_kept_subtrees_equal_scenes_made_from_nothing(void **state)
{
    view v = look();
    (void)state;
    assert_true(compare_scenes(&v, 1) >= TICKS / 2);
    v.coloring = COLORING_OCCUPANCY;
    assert_true(compare_scenes(&v, 1) >= TICKS / 2);
    v.layers &= ~(1u << LAYER_NODES);
    assert_true(compare_scenes(&v, 2) > 0);
    v = look();
    v.layers &= ~(1u << LAYER_POINTS);
    assert_true(compare_scenes(&v, 1) >= TICKS / 2);
}

static void small_nodes_are_left_out_of_kept_subtrees(void **state)
{
    view v = look();
    (void)state;
    for (v.lod = 2; v.lod < 100; v.lod *= 5)
        assert_true(compare_scenes(&v, 1) >= TICKS / 2);
}

/* Some subtrees have more points than the limit at one time and fewer at another. */
static void budgets_thin_kept_subtrees_like_others(void **state)
{
    static const uint64_t budgets[] = {1, 700, 2600, 2700, 4000, 4900, 5000};
    view v = look();
    (void)state;
    for (size_t i = 0; i < sizeof budgets / sizeof *budgets; i++) {
        v.budget = budgets[i];
        assert_true(compare_scenes(&v, 1) > 0);
    }
    v.lod = 4;
    assert_true(compare_scenes(&v, 2) > 0);
}

/* A filter, or a view that changes from tick to tick, must not use kept subtrees. */
static void kept_subtrees_are_not_used_by_another_view(void **state)
{
    played *p = make_session();
    octree_game *game;
    scene kept = {0};
    view v = look();
    (void)state;
    assert_int_equal(octree_game_create(&p->session, &game), OCTREE_OK);
    for (uint64_t tick = 0; tick < 8; tick++) {
        scene whole = {0};
        v.coloring = tick % 3 == 0 ? COLORING_OCCUPANCY : COLORING_DEPTH;
        v.filter.leaves = tick == 5;
        v.layers = tick == 6 ? VIEW_DEFAULT_LAYERS & ~(1u << LAYER_POINTS) : VIEW_DEFAULT_LAYERS;
        assert_true(tick_scene_build(&kept, &v, game, NULL, NULL));
        assert_true(tick_scene_build(&whole, &v, game, NULL, NULL));
        expect_same(&kept, &whole);
        scene_release(&whole);
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
    }
    scene_release(&kept);
    octree_game_destroy(game);
    release_session(p);
}

/* Points with colours of their own, from the tree and from a table of values. */
static void painted_points_are_kept_with_their_colors(void **state)
{
    view v = look();
    (void)state;
    v.shade = SHADE_EDL;
    v.point_color = POINTS_BY_LEAF;
    v.point_scale.given = true;
    v.point_scale.of.high[2] = 1000;
    assert_true(compare_scenes(&v, 1) >= TICKS / 2);
    v.point_color = POINTS_BY_DEPTH;
    v.budget = 2600;
    assert_true(compare_scenes(&v, 1) > 0);
}

/* Build the scene of a tree for a view, with and without the results for earlier views. Return whether subtrees were
 * kept. */
static bool compare_tree_scenes(scene *kept, const view *v, const octree *tree, const tree_subject *subject)
{
    scene whole = {0};
    tree_subject alone = *subject;
    alone.history = NULL;
    assert_true(tree_scene_build(kept, v, tree, subject));
    assert_true(tree_scene_build(&whole, v, tree, &alone));
    expect_same(kept, &whole);
    assert_true(!whole.kept || whole.kept->now.count == 0);
    scene_release(&whole);
    return kept->kept && kept->kept->now.count > 0;
}

/* The camera, the colours of points, their scale and their values change. */
static void subtrees_of_tree_without_game_are_kept(void **state)
{
    enum { TURNS = 12 };
    played *p = make_session();
    octree_game *game;
    tick_history h = {.state = 0};
    scene kept = {0};
    point_value rows[BODIES];
    for (size_t i = 0; i < BODIES; i++)
        rows[i] = (point_value){.color = {(uint8_t)i, (uint8_t)(i >> 8), 9}, .has[POINT_COLOR] = i % 3 > 0};
    const point_values values = {.rows = rows, .count = BODIES, .first = 1, .kinds = 1u << POINT_COLOR};
    view v = look();
    (void)state;
    v.shade = SHADE_EDL;
    v.budget = 2000;
    v.look.given = true;
    assert_int_equal(octree_game_create(&p->session, &game), OCTREE_OK);
    for (int turn = 0; turn < TURNS; turn++) {
        const tree_subject subject = {.title = "tree", .values = turn < 10 ? &values : NULL, .history = &h};
        v.look.azimuth = 20.0 * turn;
        v.point_color = turn < 4 ? POINTS_BY_FILE : turn < 8 ? POINTS_BY_HEIGHT : POINTS_BY_FILE;
        v.point_scale.given = true;
        v.point_scale.of.high[2] = turn < 6 ? 500 : 100;
        const bool has_kept = compare_tree_scenes(&kept, &v, octree_game_tree(game), &subject);
        assert_true(has_kept || turn == 0 || turn % 2 == 0);
    }
    scene_release(&kept);
    tick_history_release(&h);
    octree_game_destroy(game);
    release_session(p);
}

/* The change log does not hold so many changes, and then is not read for some ticks. */
static void unchanged_tree_is_kept_after_many_changes(void **state)
{
    enum { MANY_CHANGES = 16 };
    played *p = make_session();
    octree_game *game;
    tick_history h = {.state = 0};
    scene kept = {0}, whole = {0};
    view v = look();
    (void)state;
    assert_int_equal(octree_game_create(&p->session, &game), OCTREE_OK);
    assert_true(tick_history_add(&h, &v, game));
    for (uint64_t tick = 1; tick <= MANY_CHANGES; tick++) {
        assert_true(tick_scene_build(&kept, &v, game, &h, NULL));
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
        assert_true(tick_history_add(&h, &v, game));
    }
    for (int turn = 0; turn < 3; turn++) {
        v.look.given = true;
        v.look.azimuth = 20.0 * turn;
        v.look.elevation = 30;
        assert_true(tick_scene_build(&kept, &v, game, &h, NULL));
        assert_true(tick_scene_build(&whole, &v, game, NULL, NULL));
        expect_same(&kept, &whole);
        assert_int_equal(kept.kept->now.count > 0, turn > 0);
    }
    scene_release(&kept);
    scene_release(&whole);
    tick_history_release(&h);
    octree_game_destroy(game);
    release_session(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_with_kept_subtrees_equal_scenes_made_from_nothing),
        cmocka_unit_test(small_nodes_are_left_out_of_kept_subtrees),
        cmocka_unit_test(budgets_thin_kept_subtrees_like_others),
        cmocka_unit_test(kept_subtrees_are_not_used_by_another_view),
        cmocka_unit_test(painted_points_are_kept_with_their_colors),
        cmocka_unit_test(subtrees_of_tree_without_game_are_kept),
        cmocka_unit_test(unchanged_tree_is_kept_after_many_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
