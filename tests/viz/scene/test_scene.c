/* SPDX-License-Identifier: MIT */
/* test_scene.c - the draw list of a tick: which elements it has, how many, and where. test_answer_layers.c tests the
 * elements of queries. */
#include "scenes.h"

#include <math.h>

#include "draw_list.h"
#include "random_session.h"

/* The context of the walk that compares nodes with the scene. */
typedef struct node_check {
    const scene *scene;
    size_t nodes, points;
} node_check;

static octree_walk_order check_node(const octree_node *node, void *context)
{
    node_check *check = context;
    const scene_box *box = find_only_box(check->scene, LAYER_NODES, node->address);
    assert_true(same_box(&box->box, &node->box));
    assert_int_equal(box->depth, node->depth);
    assert_int_equal(box->style.role, theme_node_role(node->depth));
    for (size_t i = 0; node->leaf && i < node->count; i++) {
        assert_int_equal(count_markers_at(check->scene, LAYER_POINTS, node->points[i].id, node->points[i].position), 1);
        assert_true(box_holds(&box->box, node->points[i].position));
        check->points++;
    }
    check->nodes++;
    return OCTREE_WALK_ON;
}

static void check_tree(const scene *s, const octree *tree)
{
    node_check check = {.scene = s};
    assert_int_equal(octree_walk(tree, check_node, &check), OCTREE_OK);
    assert_int_equal(count_layer(s, LAYER_NODES).boxes, check.nodes);
    assert_int_equal(count_layer(s, LAYER_POINTS).markers, check.points);
    assert_int_equal(check.points, octree_count(tree));
    const octree_box world = octree_definition(tree).world;
    assert_true(same_box(&find_only_box(s, LAYER_WORLD, 0)->box, &world));
}

static void check_box_about(const octree_box *box, const double center[3], double size)
{
    for (int axis = 0; axis < 3; axis++) {
        assert_true(box->min[axis] == center[axis] - size);
        assert_true(box->max[axis] == center[axis] + size);
    }
}

static void check_player(const scene *s, const octree_tick *tick, const octree_player *player)
{
    const scene_box *box = find_only_box(s, LAYER_BOX, player->id);
    assert_int_equal(box->style.role, ROLE_PLAYER);
    check_box_about(&box->box, tick->player, player->box_size);
    assert_int_equal(count_layer(s, LAYER_PLAYER).markers, 1);
    assert_int_equal(count_markers_at(s, LAYER_PLAYER, player->id, tick->player), 1);
}

/* A dashed line. */
static bool has_way(const scene *s, uint64_t id, const double from[3], const double to[3])
{
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *line = &s->segments.items[i];
        if (line->style.layer == LAYER_BOX && line->id == id)
            return line->style.stroke == STROKE_DASHED && same_position(line->ends[0], from) &&
                   same_position(line->ends[1], to);
    }
    return false;
}

/* The lines of a swept collision: between the corners of the player's box, and the paths of moving points that the
 * player hit. */
static size_t ways_shown(const scene *s, const octree_tick *tick, double size)
{
    size_t ways = 0;
    for (unsigned corner = 0; tick->swept && corner < 8 && !same_position(tick->from, tick->attempt); corner++) {
        double from[3], to[3];
        for (int axis = 0; axis < 3; axis++) {
            const double side = corner >> axis & 1 ? size : -size;
            from[axis] = tick->from[axis] + side;
            to[axis] = tick->attempt[axis] + side;
        }
        assert_true(has_way(s, 12 + corner, from, to));
        ways++;
    }
    for (size_t i = 0; tick->swept && i < tick->hit_count; i++) {
        if (same_position(tick->hit_from[i], tick->hits[i].position))
            continue;
        assert_true(has_way(s, 20 + i, tick->hit_from[i], tick->hits[i].position));
        ways++;
    }
    return ways;
}

/* The hits that are boxes: each has a red outline. */
static size_t count_hit_boxes(const scene *s, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    size_t boxes = 0;
    for (size_t i = 0; i < tick->hit_count; i++) {
        octree_body body;
        assert_true(octree_game_find_body(game, tick->hits[i].id, &body));
        if (body.half[0] == 0 && body.half[1] == 0 && body.half[2] == 0)
            continue;
        const scene_box *box = find_only_box(s, LAYER_BOX, body.id);
        assert_int_equal(box->style.role, ROLE_COLLISION);
        for (int axis = 0; axis < 3; axis++) {
            assert_true(box->box.min[axis] == body.position[axis] - body.half[axis]);
            assert_true(box->box.max[axis] == body.position[axis] + body.half[axis]);
        }
        boxes++;
    }
    return boxes;
}

static void check_collision(const scene *s, const octree_game *game, const octree_player *player)
{
    const octree_tick *tick = octree_game_tick(game);
    const layer_counts found = count_layer(s, LAYER_BOX);
    assert_int_equal(found.markers, tick->hit_count ? tick->hit_count + 1 : 0);
    assert_int_equal(found.boxes, (tick->hit_count ? 2 : 1) + count_hit_boxes(s, game));
    assert_int_equal(found.segments, tick->hit_count ? 12 + ways_shown(s, tick, player->box_size) : 0);
    for (size_t i = 0; i < tick->hit_count; i++)
        assert_int_equal(count_markers_at(s, LAYER_BOX, tick->hits[i].id, tick->hits[i].position), 1);
    if (tick->hit_count == 0)
        return;
    assert_int_equal(count_markers_at(s, LAYER_BOX, player->id, tick->attempt), 1);
    const scene_box *box = find_only_box(s, LAYER_BOX, UINT64_MAX);
    assert_int_equal(box->style.role, ROLE_COLLISION);
    check_box_about(&box->box, tick->attempt, player->box_size);
}

static void check_red(const scene *s, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    size_t red = 0;
    for (size_t i = 0; i < s->boxes.count; i++)
        red += s->boxes.items[i].style.role == ROLE_COLLISION;
    for (size_t i = 0; i < s->markers.count; i++) {
        const unsigned layer = s->markers.items[i].style.layer;
        red += layer == LAYER_PAIRS; /* of a pair whose overlap is small */
        assert_int_equal(s->markers.items[i].style.role == ROLE_COLLISION, layer == LAYER_BOX || layer == LAYER_PAIRS);
    }
    assert_int_equal(red, (tick->hit_count != 0) + count_hit_boxes(s, game) + tick->pair_count);
    for (size_t i = 0; i < s->segments.count; i++)
        assert_int_equal(s->segments.items[i].style.role == ROLE_COLLISION,
                         s->segments.items[i].style.layer == LAYER_BOX);
}

static void check_tick(const scene *s, const octree_game *game)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree_player *player = &octree_game_session(game)->player;
    check_tree(s, octree_game_tree(game));
    check_player(s, tick, player);
    check_collision(s, game, player);
    check_red(s, game);
}

static void check_session(const octree_session *session, view_camera camera)
{
    const view v = view_of(320, 180, camera, VIEW_ALL_LAYERS);
    octree_game *game = start_game(session);
    scene s = {0};
    for (;;) {
        build_tick(&s, &v, game);
        check_tick(&s, game);
        if (octree_game_over(game))
            break;
        play_tick(game);
    }
    scene_release(&s);
    octree_game_destroy(game);
}

static void scenes_of_the_default_session_have_the_expected_elements(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    check_session(&session, CAMERA_ISO);
}

static void scenes_of_random_sessions_have_the_expected_elements(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        random_session made;
        random_session_mixed(&made, seed);
        check_session(&made.session, (view_camera)(seed % CAMERA_COUNT));
    }
}

static size_t elements(layer_counts of)
{
    return of.boxes + of.segments + of.markers + of.labels + of.panels;
}

/* The layers whose labels stand where other layers leave room. */
#define LABELLED                                                                                                       \
    (1u << LAYER_POINTS | 1u << LAYER_KNEAREST | 1u << LAYER_RAY | 1u << LAYER_SWEEP | 1u << LAYER_SHAPES |            \
     1u << LAYER_WRONG)

/* Compare elements by the digests of scenes that contain only them, without labels that avoid other layers. */
static uint64_t layer_digest(const scene *s, unsigned layer)
{
    scene alone = {.view = {.layers = 1u << layer}};
    const bool labels = !(LABELLED >> layer & 1);
    for (size_t i = 0; i < s->boxes.count; i++)
        scene_add_box(&alone, s->boxes.items[i]);
    for (size_t i = 0; i < s->segments.count; i++)
        scene_add_segment(&alone, s->segments.items[i]);
    for (size_t i = 0; i < s->markers.count; i++)
        scene_add_marker(&alone, s->markers.items[i]);
    for (size_t i = 0; labels && i < s->labels.count; i++)
        scene_add_label(&alone, s->labels.items[i]);
    for (size_t i = 0; labels && i < s->panels.count; i++)
        scene_add_panel(&alone, s->panels.items[i]);
    assert_true(!labels || elements(count_layer(&alone, layer)) == elements(count_layer(s, layer)));
    const uint64_t digest = scene_digest(&alone);
    scene_release(&alone);
    return digest;
}

/* Only the text layer may change when another layer is hidden, because it describes the others. The numbers of the axes
 * are text as well, and the squares of leaves with heat and the boxes of bodies are left out where they are small: the
 * picture without text has more room for them. */
#define DEPENDS_ON_SIZE (VIEW_HEAT_LAYERS | 1u << LAYER_WORLD | 1u << LAYER_BODIES | 1u << LAYER_PAIRS)

static void check_without_layer(const scene *all, const octree_game *game, const heat *h, unsigned off)
{
    const view v = view_of(640, 360, CAMERA_ISO, VIEW_ALL_LAYERS & ~(1u << off));
    scene s = {0};
    build_hot_tick(&s, &v, game, h);
    assert_int_equal(elements(count_layer(&s, off)), 0);
    for (unsigned layer = 0; layer < LAYER_TEXT; layer++)
        if (layer != off && !(off == LAYER_TEXT && DEPENDS_ON_SIZE >> layer & 1))
            assert_true(layer_digest(&s, layer) == layer_digest(all, layer));
    scene_release(&s);
}

static void hiding_a_layer_changes_no_other_layer(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    const view v = view_of(640, 360, CAMERA_ISO, VIEW_ALL_LAYERS);
    octree_game *game = start_game(&session);
    scene all = {0};
    heat h = {0};
    bool shown[LAYER_COUNT] = {[LAYER_BROKEN] = true, [LAYER_ASKED] = true}; /* other tests cover these */
    while (!octree_game_over(game)) {
        play_tick(game);
        assert_true(heat_add_tick(&h, game));
        build_hot_tick(&all, &v, game, &h);
        for (unsigned layer = 0; layer < LAYER_COUNT; layer++)
            shown[layer] |= elements(count_layer(&all, layer)) != 0;
        for (unsigned layer = 0; octree_game_tick(game)->number % 5 == 0 && layer < LAYER_COUNT; layer++)
            check_without_layer(&all, game, &h, layer);
    }
    for (unsigned layer = 0; layer < LAYER_COUNT; layer++)
        assert_true(shown[layer]);
    heat_release(&h);
    scene_release(&all);
    octree_game_destroy(game);
}

static void shuffle(octree_game_body *bodies, size_t count, uint64_t *state)
{
    for (size_t i = count; i > 1; i--) {
        const size_t j = random_below(state, i);
        const octree_game_body swapped = bodies[i - 1];
        bodies[i - 1] = bodies[j];
        bodies[j] = swapped;
    }
}

static void the_scene_does_not_depend_on_the_order_of_bodies(void **state)
{
    (void)state;
    const view v = view_of(320, 180, CAMERA_FOLLOW, VIEW_ALL_LAYERS);
    for (uint64_t seed = 1; seed <= 10; seed++) {
        random_session made, other;
        scene a = {0}, b = {0};
        random_session_plain(&made, seed);
        random_session_plain(&other, seed);
        made.session.tree.full_leaf = other.session.tree.full_leaf = OCTREE_GROW;
        shuffle(other.bodies, other.session.body_count, &(uint64_t){seed});
        octree_game *first = start_game(&made.session), *second = start_game(&other.session);
        for (; !octree_game_over(first); play_tick(first), play_tick(second)) {
            build_tick(&a, &v, first);
            build_tick(&b, &v, second);
            assert_true(scene_digest(&a) == scene_digest(&b));
        }
        octree_game_destroy(first);
        octree_game_destroy(second);
        scene_release(&a);
        scene_release(&b);
    }
}

#define POINTS 300

/* Half of the points share coordinates, and some share an id. The index starts at `first` and wraps around. */
static octree *tree_from(const octree_game_body *bodies, size_t first)
{
    octree *tree = make_tree(cube(-8, 8), 3, 5, OCTREE_GROW);
    for (size_t i = 0; i < POINTS; i++) {
        const octree_game_body *body = &bodies[(first + i) % POINTS];
        const octree_status status = octree_insert(tree, body->position, body->id);
        assert_true(status == OCTREE_OK || status == OCTREE_DUPLICATE);
    }
    return tree;
}

static void the_scene_does_not_depend_on_the_history_of_the_tree(void **state)
{
    (void)state;
    const view v = view_of(320, 180, CAMERA_ISO, VIEW_ALL_LAYERS);
    octree_game_body bodies[POINTS];
    uint64_t random = 7;
    for (size_t i = 0; i < POINTS; i++)
        bodies[i] = (octree_game_body){
            .id = random_below(&random, POINTS / 2),
            .position = {(double)random_below(&random, 8), (double)random_below(&random, 4) / 8, 1},
        };
    scene s = {0};
    uint64_t expected = 0;
    for (int round = 0; round < 20; round++) {
        octree *tree = tree_from(bodies, random_below(&random, POINTS));
        const double passer_by[3] = {-7, -7, -7};
        for (uint64_t id = 0; id < 50; id++)
            assert_int_equal(octree_insert(tree, passer_by, id), OCTREE_OK);
        for (uint64_t id = 0; id < 50; id++)
            assert_int_equal(octree_remove(tree, passer_by, id), OCTREE_OK);
        build_tree(&s, &v, tree, "history");
        check_tree(&s, tree);
        expected = round ? expected : scene_digest(&s);
        assert_true(scene_digest(&s) == expected);
        octree_destroy(tree);
        shuffle(bodies, POINTS, &random);
    }
    scene_release(&s);
}

static void an_empty_tree_shows_its_world_and_its_root(void **state)
{
    (void)state;
    const view v = view_of(320, 180, CAMERA_ISO, VIEW_ALL_LAYERS);
    octree *tree = make_tree(cube(-1, 1), 2, 5, OCTREE_REFUSE);
    scene s = {0};
    build_tree(&s, &v, tree, "empty");
    check_tree(&s, tree);
    assert_int_equal(s.boxes.count, 2);
    assert_int_equal(s.markers.count, 0);
    octree_destroy(tree);
    scene_release(&s);
}

static void elements_with_infinite_positions_are_counted_and_left_out(void **state)
{
    (void)state;
    static const double wrong[] = {NAN, INFINITY, -INFINITY};
    scene s = {.view = view_make_default()};
    size_t refused = 0;
    for (size_t w = 0; w < 3; w++) {
        for (int i = 0; i < 6; i++) {
            scene_box box = {0};
            scene_segment segment = {0};
            *(i < 3 ? &box.box.min[i] : &box.box.max[i - 3]) = wrong[w];
            segment.ends[i / 3][i % 3] = wrong[w];
            scene_add_box(&s, box);
            scene_add_segment(&s, segment);
            refused += 2;
        }
        for (int i = 0; i < 3; i++) {
            scene_marker marker = {0};
            scene_label label = {.in_world = i > 0};
            marker.at[i] = label.at[i] = wrong[w];
            scene_add_marker(&s, marker);
            scene_add_label(&s, label);
            refused += 2;
        }
    }
    assert_int_equal(s.refused, refused);
    assert_int_equal(s.boxes.count + s.segments.count + s.markers.count + s.labels.count, 0);
    scene_add_box(&s, (scene_box){.box = cube(-1.7e308, 1.7e308)});
    assert_int_equal(s.boxes.count, 1);
    scene_clear(&s);
    assert_int_equal(s.refused, 0);
    scene_release(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_of_the_default_session_have_the_expected_elements),
        cmocka_unit_test(scenes_of_random_sessions_have_the_expected_elements),
        cmocka_unit_test(hiding_a_layer_changes_no_other_layer),
        cmocka_unit_test(the_scene_does_not_depend_on_the_order_of_bodies),
        cmocka_unit_test(the_scene_does_not_depend_on_the_history_of_the_tree),
        cmocka_unit_test(an_empty_tree_shows_its_world_and_its_root),
        cmocka_unit_test(elements_with_infinite_positions_are_counted_and_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
