/* SPDX-License-Identifier: MIT */
/* test_filter.c - a view shows exactly the nodes and points that pass its filter. */
#include "scenes.h"
#include "brute.h"
#include "draw_list.h"
#include "filter.h"
#include "text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A tree with its expected nodes and points. */
typedef struct known_tree {
    octree *tree;
    octree_box world;
    brute points;
    octree_node *nodes;
    size_t count;
} known_tree;

static octree_walk_order keep_node(const octree_node *node, void *context)
{
    known_tree *t = context;
    t->nodes[t->count++] = *node;
    return OCTREE_WALK_ON;
}

static known_tree known(octree_sample_kind kind, size_t count, size_t capacity, size_t depth)
{
    known_tree t = {.world = cube(-1000, 1000)};
    brute_sample(&t.points, kind, 3, &t.world, count);
    brute_insert(&t.points, (double[]){1000, 1000, 1000}, count);
    brute_insert(&t.points, (double[]){0, 0, 0}, count + 1);
    t.tree = brute_tree(&t.points, t.world, capacity, depth);
    t.nodes = malloc(node_count(t.tree) * sizeof *t.nodes);
    assert_non_null(t.nodes);
    assert_int_equal(octree_walk(t.tree, keep_node, &t), OCTREE_OK);
    return t;
}

static void forget(known_tree *t)
{
    octree_destroy(t->tree);
    brute_free(&t->points);
    free(t->nodes);
}

/* Whether a coordinate leads to a node on an axis: compare it with each plane on the path from the root. */
static bool way_leads_to(octree_address address, const octree_box *world, int axis, double at)
{
    const unsigned depth = octree_address_depth(address), bit = 2 - (unsigned)axis;
    for (unsigned level = 0; level < depth; level++) {
        const octree_address parent = address >> 3 * (depth - level);
        const octree_box upper = octree_cell_box(world, parent << 3 | 1u << bit);
        const bool goes_up = at >= upper.min[axis];
        if (goes_up != (octree_address_octant(address, level) >> bit & 1))
            return false;
    }
    return at >= world->min[axis] && at <= world->max[axis];
}

static bool meets(const octree_box *a, const octree_box *b)
{
    bool apart = false;
    for (int i = 0; i < 3; i++)
        apart |= a->min[i] > b->max[i] || b->min[i] > a->max[i];
    return !apart;
}

static bool branch_passes(const known_tree *t, const view_filter *f, const octree_node *node)
{
    return (!f->slice || way_leads_to(node->address, &t->world, f->slice - 'x', f->slice_at)) &&
           (!f->by_region || meets(&node->box, &f->region));
}

static bool node_passes(const known_tree *t, const view_filter *f, const octree_node *node)
{
    const bool deep_enough = !f->by_depth || (node->depth >= f->min_depth && node->depth <= f->max_depth);
    return branch_passes(t, f, node) && deep_enough && (!f->leaves || node->leaf);
}

/* A point passes if it lies in a leaf of the slice, in the region, and in a node in the range of depths, which is its
 * leaf if only leaves are shown. */
static bool point_passes(const known_tree *t, const view_filter *f, const octree_point *point)
{
    octree_node leaf;
    assert_int_equal(octree_locate(t->tree, point->position, &leaf), OCTREE_OK);
    if ((f->slice && !way_leads_to(leaf.address, &t->world, f->slice - 'x', f->slice_at)) ||
        (f->by_region && !box_holds(&f->region, point->position)))
        return false;
    bool in_range = !f->by_depth;
    for (unsigned depth = f->leaves ? leaf.depth : 0; depth <= leaf.depth; depth++)
        in_range |= f->by_depth && depth >= f->min_depth && depth <= f->max_depth;
    return in_range;
}

static bool has_box(const scene *s, const octree_node *node)
{
    for (size_t i = 0; i < s->boxes.count; i++)
        if (s->boxes.items[i].style.layer == LAYER_NODES && s->boxes.items[i].id == node->address)
            return same_position(s->boxes.items[i].box.min, node->box.min) &&
                   same_position(s->boxes.items[i].box.max, node->box.max);
    return false;
}

static bool has_point(const scene *s, const octree_point *point)
{
    for (size_t i = 0; i < s->markers.count; i++)
        if (s->markers.items[i].style.layer == LAYER_POINTS && s->markers.items[i].id == point->id)
            return same_position(s->markers.items[i].at, point->position);
    return false;
}

/* "2 nodes" */
static bool has_count(const scene *s, const char *noun, size_t count)
{
    char text[SCENE_TEXT];
    snprintf(text, sizeof text, "%zu %s%s", count, noun, plural_ending(count));
    for (size_t i = 0; i < s->labels.count; i++)
        if (strcmp(s->labels.items[i].text, text) == 0)
            return true;
    return false;
}

/* The test fails unless the scene has each node and point that passes once, and no other, and the frame states their
 * numbers. Returns the number of nodes. */
static size_t check_filter(const known_tree *t, const view_filter *f)
{
    view v = view_make_default();
    scene s = {0};
    size_t nodes = 0, points = 0;
    v.filter = *f;
    build_tree(&s, &v, t->tree, "filter");
    for (size_t i = 0; i < t->count; i++) {
        const bool passes = node_passes(t, f, &t->nodes[i]);
        assert_int_equal(has_box(&s, &t->nodes[i]), passes);
        nodes += passes;
    }
    for (size_t i = 0; i < t->points.count; i++) {
        const bool passes = point_passes(t, f, &t->points.points[i]);
        assert_int_equal(has_point(&s, &t->points.points[i]), passes);
        points += passes;
    }
    assert_int_equal(count_layer(&s, LAYER_NODES).boxes, nodes);
    assert_int_equal(count_layer(&s, LAYER_POINTS).markers, points);
    assert_int_equal(has_count(&s, "node", nodes) && has_count(&s, "point", points), filter_is_set(f));
    scene_release(&s);
    return nodes;
}

static void without_a_filter_everything_is_shown(void **state)
{
    (void)state;
    known_tree t = known(OCTREE_SAMPLE_CLUSTERED, 300, 4, 21);
    assert_int_equal(check_filter(&t, &(view_filter){0}), t.count);
    forget(&t);
}

static void a_slice_shows_one_layer_of_cells_at_its_plane(void **state)
{
    (void)state;
    known_tree t = known(OCTREE_SAMPLE_CLUSTERED, 300, 4, 21);
    uint64_t random = 5;
    double places[24] = {0, -1000, 1000, 500, -500, -0.0, next_down(0), next_up(0), next_down(1000), 250, 999};
    for (size_t i = 11; i < 24; i++)
        places[i] = random_between(&random, -1000, 1000);
    for (size_t i = 0; i < 24; i++)
        for (char axis = 'x'; axis <= 'z'; axis++)
            assert_true(check_filter(&t, &(view_filter){.slice = axis, .slice_at = places[i]}) >= 1);
    forget(&t);
}

/* In a uniform lattice, a slice on a plane of the tree shows only the cells above the plane. */
static void a_slice_on_a_plane_of_the_tree_shows_one_side(void **state)
{
    (void)state;
    known_tree t = known(OCTREE_SAMPLE_LATTICE, 512, 1, 3);
    const size_t nodes = check_filter(&t, &(view_filter){.slice = 'y', .slice_at = 0});
    assert_int_equal(nodes, 1 + 4 + 16 + 64);
    forget(&t);
}

static void depth_leaf_and_region_filters_follow_their_rules(void **state)
{
    (void)state;
    known_tree t = known(OCTREE_SAMPLE_CLUSTERED, 300, 4, 21);
    uint64_t random = 6;
    for (unsigned from = 0; from < 9; from++)
        for (unsigned to = from; to < 9; to += 2)
            for (int leaves = 0; leaves < 2; leaves++)
                check_filter(&t,
                             &(view_filter){.by_depth = true, .min_depth = from, .max_depth = to, .leaves = leaves});
    size_t leaves = 0;
    for (size_t i = 0; i < t.count; i++)
        leaves += t.nodes[i].leaf;
    assert_int_equal(check_filter(&t, &(view_filter){.leaves = true}), leaves);
    for (int i = 0; i < 40; i++) {
        view_filter f = {.by_region = true, .leaves = i % 3 == 0};
        for (int axis = 0; axis < 3; axis++) {
            f.region.min[axis] = random_between(&random, -1500, 1000);
            f.region.max[axis] = f.region.min[axis] + (i % 5 ? random_between(&random, 0, 1500) : 0);
        }
        f.slice = i % 4 == 0 ? 'z' : 0;
        f.by_depth = i % 2;
        f.max_depth = 4;
        check_filter(&t, &f);
    }
    forget(&t);
}

static void a_region_is_closed(void **state)
{
    (void)state;
    known_tree t = known(OCTREE_SAMPLE_UNIFORM, 200, 1, 21);
    const octree_point *point = &t.points.points[17];
    view_filter f = {.by_region = true};
    memcpy(f.region.min, point->position, sizeof f.region.min);
    memcpy(f.region.max, point->position, sizeof f.region.max);
    check_filter(&t, &f);
    f.region = (octree_box){{-1000, -1000, 1000}, {-1000, -1000, 2000}}; /* an edge of the world, from outside */
    assert_true(check_filter(&t, &f) >= 1);
    forget(&t);
}

static void an_empty_tree_shows_its_root_if_the_filter_reaches_it(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-1, 1), 1, 5, OCTREE_GROW);
    view v = view_make_default();
    scene s = {0};
    v.filter = (view_filter){.slice = 'x', .slice_at = 1, .leaves = true};
    build_tree(&s, &v, tree, "empty");
    assert_int_equal(count_layer(&s, LAYER_NODES).boxes, 1);
    v.filter.by_depth = true;
    v.filter.min_depth = v.filter.max_depth = 1;
    build_tree(&s, &v, tree, "empty");
    assert_int_equal(count_layer(&s, LAYER_NODES).boxes, 0);
    scene_release(&s);
    octree_destroy(tree);
}

/* The outlines of the slice and the region are drawn dashed, in the layer of the world. */
static void the_slice_and_the_region_are_outlined(void **state)
{
    (void)state;
    known_tree t = known(OCTREE_SAMPLE_UNIFORM, 10, 4, 21);
    view v = view_make_default();
    scene s = {0};
    v.filter = (view_filter){.slice = 'y', .slice_at = 7, .by_region = true, .region = cube(-5, 50)};
    build_tree(&s, &v, t.tree, "outlines");
    size_t outlines = 0;
    for (size_t i = 0; i < s.boxes.count; i++) {
        const scene_box *box = &s.boxes.items[i];
        if (box->style.layer != LAYER_WORLD || box->style.stroke != STROKE_DASHED)
            continue;
        const octree_box plane = {{-1000, 7, -1000}, {1000, 7, 1000}};
        const octree_box *expected = box->id == 1 ? &plane : &v.filter.region;
        assert_true(same_position(box->box.min, expected->min) && same_position(box->box.max, expected->max));
        outlines++;
    }
    assert_int_equal(outlines, 2);
    scene_release(&s);
    forget(&t);
}

/* Boxes of foreign nodes, which may be deeper than any node of Octreel's tree. */
static void depth_filter_of_a_foreign_box_follows_its_rule(void **state)
{
    (void)state;
    const octree_box box = cube(-1, 1);
    const struct {
        unsigned from, to, depth;
        bool shown;
    } rows[] = {{2, 4, 1, false}, {2, 4, 2, true},   {2, 4, 4, true},
                {2, 4, 5, false}, {2, 21, 40, true}, {2, 21, 1, false}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const view_filter f = {.by_depth = true, .min_depth = rows[i].from, .max_depth = rows[i].to};
        assert_int_equal(filter_shows_box(&f, &box, rows[i].depth, true), rows[i].shown);
    }
}

static void filters_that_can_show_nothing_are_refused(void **state)
{
    (void)state;
    const octree_def tree = define(cube(-10, 10), 4, 6, OCTREE_GROW);
    static const struct {
        view_filter filter;
        const char *part; /* null: accepted */
    } rows[] = {
        {{0}, NULL},
        {{.slice = 'z', .slice_at = 10}, NULL},
        {{.slice = 'z', .slice_at = -10}, NULL},
        {{.slice = 'z', .slice_at = 10.5}, "slice z = 10.5 lies outside the world, which extends from -10 to 10"},
        {{.slice = 'x', .slice_at = -1e300}, "slice x = -1e+300"},
        {{.slice = 'y', .slice_at = 12345.678951}, "slice y = 12345.679 lies"},
        {{.by_region = true, .region = {{10, 10, 10}, {20, 20, 20}}}, NULL},
        {{.by_region = true, .region = {{-99, -99, -99}, {99, 99, 99}}}, NULL},
        {{.by_region = true, .region = {{0, 9876.5432151, 0}, {1, 12345.678951, 1}}},
         "on axis y the region extends from 9876.54322 to 12345.679, and the world from -10 to 10"},
        {{.by_region = true, .region = {{0, 0, -30}, {1, 1, -20}}}, "on axis z the region extends from -30 to -20"},
        {{.by_depth = true, .min_depth = 6, .max_depth = 21}, NULL},
        {{.by_depth = true, .min_depth = 7, .max_depth = 8}, "begins at 7, but the deepest level of the tree is 6"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[FILTER_TEXT];
        const char *reason = filter_find_problem(&rows[i].filter, &tree, text);
        assert_int_equal(reason != NULL, rows[i].part != NULL);
        if (reason)
            assert_non_null(strstr(reason, rows[i].part));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_filter_everything_is_shown),
        cmocka_unit_test(a_slice_shows_one_layer_of_cells_at_its_plane),
        cmocka_unit_test(a_slice_on_a_plane_of_the_tree_shows_one_side),
        cmocka_unit_test(depth_leaf_and_region_filters_follow_their_rules),
        cmocka_unit_test(a_region_is_closed),
        cmocka_unit_test(depth_filter_of_a_foreign_box_follows_its_rule),
        cmocka_unit_test(an_empty_tree_shows_its_root_if_the_filter_reaches_it),
        cmocka_unit_test(the_slice_and_the_region_are_outlined),
        cmocka_unit_test(filters_that_can_show_nothing_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
