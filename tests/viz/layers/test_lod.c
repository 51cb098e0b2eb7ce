/* SPDX-License-Identifier: MIT */
/* test_lod.c - tests that lod and budget leave out exactly the right elements, and that the frame reports it. */
#include "scenes.h"
#include "brute.h"
#include "draw_list.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static view look_at(view_camera camera)
{
    view v = view_of(640, 360, camera, VIEW_ALL_LAYERS);
    v.lod = 0;
    v.budget = 0;
    return v;
}

static octree *clustered(size_t count, size_t capacity)
{
    const octree_box world = cube(-1000, 1000);
    brute points = {0};
    brute_sample(&points, OCTREE_SAMPLE_CLUSTERED, 7, &world, count);
    octree *tree = brute_tree(&points, world, capacity, 21);
    brute_free(&points);
    return tree;
}

static scene scene_of(const octree *tree, const view *v)
{
    scene s = {0};
    build_tree(&s, v, tree, "lod");
    return s;
}

static bool has_box(const scene *s, octree_address address)
{
    for (size_t i = 0; i < s->boxes.count; i++)
        if (s->boxes.items[i].style.layer == LAYER_NODES && s->boxes.items[i].id == address)
            return true;
    return false;
}

static bool has_point(const scene *s, uint64_t id)
{
    for (size_t i = 0; i < s->markers.count; i++)
        if (s->markers.items[i].style.layer == LAYER_POINTS && s->markers.items[i].id == id)
            return true;
    return false;
}

static bool has_text(const scene *s, const char *text)
{
    for (size_t i = 0; i < s->labels.count; i++)
        if (strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

/* ---- Size --------------------------------------------------------------------------------------------------- */

/* The rectangle around the eight corners as they are drawn; all of space where one is not before the camera. */
static double size_on_screen(const scene *s, const octree_box *box)
{
    double pixels[8][2], longest = 0;
    for (unsigned corner = 0; corner < 8; corner++) {
        double position[3], seen[3];
        box_corner(box, corner, position);
        camera_transform(&s->camera, position, seen);
        if (s->camera.perspective && seen[2] < s->camera.near)
            return INFINITY;
        camera_project(&s->camera, seen, pixels[corner]);
    }
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 8; j++)
            longest = fmax(longest, fmax(pixels[i][0] - pixels[j][0], pixels[i][1] - pixels[j][1]));
    return longest;
}

/* The context of the walk over all nodes. */
typedef struct lod_check {
    const scene *scene;
    size_t drawn, left_out;
} lod_check;

static bool ancestor_is_drawn(const scene *s, octree_address address)
{
    while ((address >>= 3) != 0)
        if (has_box(s, address))
            return true;
    return false;
}

static bool passes(const view_filter *f, const octree_node *node)
{
    return (!f->leaves || node->leaf) && (!f->by_depth || node->depth >= f->min_depth);
}

static octree_walk_order check_lod(const octree_node *node, void *context)
{
    lod_check *check = context;
    const scene *s = check->scene;
    const double size = size_on_screen(s, &node->box), lod = s->view.lod;
    if (!passes(&s->view.filter, node))
        return OCTREE_WALK_ON;
    assert_true(isinf(size) || fabs(size - lod) > 1e-9 * lod); /* not a matter of rounding */
    const bool out = size < lod && ancestor_is_drawn(s, node->address);
    assert_int_equal(has_box(s, node->address), !out);
    check->drawn += !out;
    check->left_out += out;
    return OCTREE_WALK_ON;
}

static void assert_lod(const octree *tree, const view *v)
{
    scene s = scene_of(tree, v);
    lod_check check = {.scene = &s};
    char text[SCENE_TEXT];
    octree_walk(tree, check_lod, &check);
    assert_int_equal(count_layer(&s, LAYER_NODES).boxes, check.drawn);
    assert_true(v->filter.by_depth || count_layer(&s, LAYER_POINTS).markers == octree_count(tree));
    assert_true(s.tally.nodes == check.drawn && s.tally.small == check.left_out);
    snprintf(text, sizeof text, "under %.3g px", v->lod);
    assert_int_equal(has_text(&s, text), check.left_out > 0);
    snprintf(text, sizeof text, "%zu node%s", check.left_out, check.left_out == 1 ? "" : "s");
    assert_true(check.left_out == 0 || has_text(&s, text));
    scene_release(&s);
}

static void only_boxes_below_the_lod_are_left_out(void **state)
{
    (void)state;
    octree *tree = clustered(900, 4);
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        static const double sizes[] = {1.7, 4.3, 13.1, 90.7};
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            view v = look_at((view_camera)kind);
            v.lod = sizes[i];
            assert_lod(tree, &v);
        }
    }
    octree_destroy(tree);
}

/* They are shown because no drawn box marks their place. */
static void small_boxes_without_a_drawn_ancestor_are_shown(void **state)
{
    (void)state;
    octree *tree = clustered(900, 4);
    for (unsigned depth = 1; depth < 8; depth++) {
        view v = look_at(CAMERA_ORBIT);
        v.lod = 300;
        v.filter = (view_filter){.by_depth = true, .min_depth = depth, .max_depth = 21};
        assert_lod(tree, &v);
        v.filter = (view_filter){.leaves = true};
        assert_lod(tree, &v);
    }
    octree_destroy(tree);
}

static octree_walk_order check_children(const octree_node *node, void *context)
{
    const camera *c = context;
    const octree_box world = cube(-1000, 1000);
    const double size = camera_box_size_in_pixels(c, &node->box);
    for (unsigned octant = 0; octant < 8 && node->depth < OCTREE_MAX_DEPTH; octant++) {
        const octree_box child = octree_cell_box(&world, node->address << 3 | octant);
        assert_true(isinf(size) || camera_box_size_in_pixels(c, &child) <= size * (1 + 1e-12));
    }
    return OCTREE_WALK_ON;
}

static void contents_of_a_box_appear_no_larger_than_the_box(void **state)
{
    (void)state;
    octree *tree = clustered(300, 2);
    for (int kind = 0; kind < CAMERA_COUNT; kind++) {
        const view v = look_at((view_camera)kind);
        scene s = scene_of(tree, &v);
        octree_walk(tree, check_children, &s.camera);
        scene_release(&s);
    }
    octree_destroy(tree);
}

/* ---- Budget ------------------------------------------------------------------------------------------------- */

static void nodes_beyond_the_budget_are_left_out_by_whole_levels(void **state)
{
    (void)state;
    octree *tree = clustered(900, 4);
    octree_stats stats;
    octree_statistics(tree, &stats);
    for (size_t budget = 1; budget < stats.nodes + 40; budget += 1 + budget / 6) {
        view v = look_at(CAMERA_ISO);
        char text[SCENE_TEXT];
        size_t within = 0, levels = 0;
        while (levels <= stats.depth && within + stats.nodes_at_depth[levels] <= budget)
            within += stats.nodes_at_depth[levels++];
        v.budget = budget;
        scene s = scene_of(tree, &v);
        assert_int_equal(count_layer(&s, LAYER_NODES).boxes, within);
        for (size_t i = 0; i < s.boxes.count; i++)
            assert_true(s.boxes.items[i].style.layer != LAYER_NODES || s.boxes.items[i].depth < levels);
        assert_int_equal(s.tally.beyond, stats.nodes - within);
        snprintf(text, sizeof text, "nodes to depth %zu", levels - 1);
        assert_int_equal(has_text(&s, text), within < stats.nodes);
        scene_release(&s);
    }
    octree_destroy(tree);
}

static void panel_reports_that_even_the_first_level_exceeds_the_budget(void **state)
{
    (void)state;
    octree *tree = clustered(900, 4);
    view v = look_at(CAMERA_ISO);
    v.budget = 5;
    v.filter = (view_filter){.by_depth = true, .min_depth = 4, .max_depth = 4};
    scene s = scene_of(tree, &v);
    assert_int_equal(count_layer(&s, LAYER_NODES).boxes, 0);
    assert_true(has_text(&s, "no nodes") || has_text(&s, "nodes to depth 3"));
    scene_release(&s);
    octree_destroy(tree);
}

static void points_beyond_the_budget_are_left_out_by_their_ids(void **state)
{
    (void)state;
    const octree_box world = cube(-1000, 1000);
    brute points = {0}, moved = {0};
    brute_sample(&points, OCTREE_SAMPLE_UNIFORM, 1, &world, 3000);
    for (size_t i = 0; i < points.count; i++) {
        const double *p = points.points[i].position;
        brute_insert(&moved, (double[]){-p[0], p[2], p[1]}, points.points[i].id);
    }
    octree *tree = brute_tree(&points, world, 16, 21), *other = brute_tree(&moved, world, 16, 21);
    scene last = {0};
    for (size_t budget = 4000; budget >= 1; budget = budget * 2 / 3) {
        view v = look_at(CAMERA_ISO);
        v.layers &= ~(1u << LAYER_NODES);
        v.budget = budget;
        scene s = scene_of(tree, &v), t = scene_of(other, &v);
        const size_t count = count_layer(&s, LAYER_POINTS).markers;
        assert_true(count <= budget && (budget < 40 || count >= (budget < 3000 ? budget : 3000) * 2 / 5));
        assert_true(s.tally.points == count && s.tally.points + s.tally.thinned == 3000);
        assert_int_equal(count_layer(&t, LAYER_POINTS).markers, count);
        for (size_t i = 0; i < points.count; i++) {
            assert_int_equal(has_point(&s, points.points[i].id), has_point(&t, points.points[i].id));
            assert_true(last.view.width == 0 || !has_point(&s, points.points[i].id) ||
                        has_point(&last, points.points[i].id));
        }
        char text[SCENE_TEXT];
        snprintf(text, sizeof text, "1 point in %zu", (size_t)s.tally.one_in);
        assert_int_equal(has_text(&s, text), count < 3000);
        scene_release(&last);
        scene_release(&t);
        last = s;
    }
    scene_release(&last);
    octree_destroy(tree);
    octree_destroy(other);
    brute_free(&points);
    brute_free(&moved);
}

static void large_budget_changes_and_reports_nothing(void **state)
{
    (void)state;
    octree *tree = clustered(500, 4);
    view v = look_at(CAMERA_FOLLOW);
    scene free_of = scene_of(tree, &v);
    v.budget = node_count(tree) > 500 ? node_count(tree) : 500;
    scene within = scene_of(tree, &v);
    assert_true(scene_digest(&free_of) == scene_digest(&within));
    scene_release(&free_of);
    scene_release(&within);
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_boxes_below_the_lod_are_left_out),
        cmocka_unit_test(small_boxes_without_a_drawn_ancestor_are_shown),
        cmocka_unit_test(contents_of_a_box_appear_no_larger_than_the_box),
        cmocka_unit_test(nodes_beyond_the_budget_are_left_out_by_whole_levels),
        cmocka_unit_test(panel_reports_that_even_the_first_level_exceeds_the_budget),
        cmocka_unit_test(points_beyond_the_budget_are_left_out_by_their_ids),
        cmocka_unit_test(large_budget_changes_and_reports_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
