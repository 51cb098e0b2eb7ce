/* SPDX-License-Identifier: MIT */
/* test_edges.c - the merged edges of boxes, compared with every unit segment of a small grid and with a count. */
#include "scenes.h"
#include "edges.h"

#include <stdlib.h>
#include <string.h>

/* Random boxes have whole corners in 0..GRID. */
#define GRID 5
#define BOXES 24
#define KINDS 3

/* Edges of boxes are merged only within one layer, style and width. */
static const scene_style kinds[KINDS] = {
    {.layer = LAYER_NODES, .width = 1},
    {.layer = LAYER_RANGE, .stroke = STROKE_DASHED, .width = 1},
    {.layer = LAYER_NODES, .width = 2},
};

static scene random_boxes(uint64_t seed, size_t count)
{
    scene s = {.view = view_make_default()};
    for (size_t i = 0; i < count; i++) {
        scene_box box = {.id = i + 1, .depth = (uint8_t)random_below(&seed, 4)};
        box.style = kinds[random_below(&seed, KINDS)];
        box.style.role = (uint8_t)(ROLE_NODE + box.depth / 2); /* deep nodes also share one colour */
        for (int axis = 0; axis < 3; axis++) {
            box.box.min[axis] = (double)random_below(&seed, GRID);
            box.box.max[axis] =
                box.box.min[axis] + 1 + (double)random_below(&seed, (uint64_t)(GRID - box.box.min[axis]));
        }
        scene_add_box(&s, box);
    }
    return s;
}

/* The unit segment of a line along `axis` that begins at `from`; u and v are its coordinates on the next two axes. */
typedef struct unit_stretch {
    int axis;
    double from, u, v;
} unit_stretch;

static bool same_kind(scene_style a, scene_style b)
{
    return a.layer == b.layer && a.stroke == b.stroke && a.width == b.width;
}

static bool box_covers(const octree_box *box, const unit_stretch *of)
{
    const int second = (of->axis + 1) % 3, third = (of->axis + 2) % 3;
    return (of->u == box->min[second] || of->u == box->max[second]) &&
           (of->v == box->min[third] || of->v == box->max[third]) && box->min[of->axis] <= of->from &&
           box->max[of->axis] >= of->from + 1;
}

/* The depth of the shallowest box with an edge on a segment; -1 for none. */
static int shallowest_depth(const scene *s, scene_style kind, const unit_stretch *of)
{
    int best = -1;
    for (size_t i = 0; i < s->boxes.count; i++) {
        const scene_box *box = &s->boxes.items[i];
        if (same_kind(box->style, kind) && box_covers(&box->box, of) && (best < 0 || box->depth < best))
            best = box->depth;
    }
    return best;
}

static int axis_of(const edge *e)
{
    int axis = -1;
    for (int i = 0; i < 3; i++) {
        if (e->ends[0][i] == e->ends[1][i])
            continue;
        assert_int_equal(axis, -1);
        axis = i;
    }
    assert_true(axis >= 0 && e->ends[0][axis] < e->ends[1][axis]);
    return axis;
}

static bool edge_covers(const edge *e, const unit_stretch *of)
{
    return axis_of(e) == of->axis && e->ends[0][(of->axis + 1) % 3] == of->u &&
           e->ends[0][(of->axis + 2) % 3] == of->v && e->ends[0][of->axis] <= of->from &&
           e->ends[1][of->axis] >= of->from + 1;
}

static void check_stretch(const edge_list *list, const scene *s, scene_style kind, const unit_stretch *of)
{
    const int expected = shallowest_depth(s, kind, of);
    size_t found = 0;
    for (size_t i = 0; i < list->now.count; i++) {
        const edge *e = &list->now.items[i];
        if (!same_kind(e->style, kind) || !edge_covers(e, of))
            continue;
        assert_int_equal(e->depth, expected);
        assert_int_equal(e->style.role, ROLE_NODE + expected / 2);
        found++;
    }
    assert_int_equal(found, expected >= 0);
}

static void every_edge_is_drawn_once_in_the_colour_of_the_shallowest_box(void **state)
{
    (void)state;
    edge_list list = {0};
    for (uint64_t seed = 1; seed <= 25; seed++) {
        scene s = random_boxes(seed, 1 + seed % BOXES);
        assert_true(edges_merge(&list, &s, 0, LAYER_DIAGRAM + 1));
        for (int stretch = 0; stretch < 3 * GRID * (GRID + 1) * (GRID + 1); stretch++) {
            const unit_stretch of = {stretch % 3, stretch / 3 % GRID, stretch / (3 * GRID) % (GRID + 1),
                                     stretch / (3 * GRID * (GRID + 1))};
            for (int kind = 0; kind < KINDS; kind++)
                check_stretch(&list, &s, kinds[kind], &of);
        }
        scene_release(&s);
    }
    edges_release(&list);
}

static bool go_on(const edge *a, const edge *b)
{
    return memcmp(a->ends[1], b->ends[0], sizeof a->ends[1]) == 0 && axis_of(a) == axis_of(b) &&
           same_kind(a->style, b->style) && a->style.role == b->style.role && a->depth == b->depth;
}

static void assert_maximal(const edge_list *list)
{
    for (size_t i = 0; i < list->now.count; i++)
        for (size_t j = 0; j < list->now.count; j++)
            assert_false(i != j && go_on(&list->now.items[i], &list->now.items[j]));
}

static void adjacent_edges_of_one_look_and_depth_are_merged(void **state)
{
    (void)state;
    edge_list list = {0};
    for (uint64_t seed = 1; seed <= 100; seed++) {
        scene s = random_boxes(seed, BOXES);
        assert_true(edges_merge(&list, &s, 0, LAYER_DIAGRAM + 1));
        assert_maximal(&list);
        scene_release(&s);
    }
    edges_release(&list);
}

static void assert_same_edges(const edge_list *a, const edge_list *b)
{
    assert_int_equal(a->now.count, b->now.count);
    for (size_t i = 0; i < a->now.count; i++) {
        const edge *p = &a->now.items[i], *q = &b->now.items[i];
        assert_memory_equal(p->ends, q->ends, sizeof p->ends);
        assert_memory_equal(&p->style, &q->style, sizeof p->style);
        assert_true(p->depth == q->depth);
    }
}

static void shuffle(scene *s, uint64_t *random)
{
    for (size_t i = s->boxes.count; i > 1; i--) {
        const size_t j = random_below(random, i);
        const scene_box swapped = s->boxes.items[i - 1];
        s->boxes.items[i - 1] = s->boxes.items[j];
        s->boxes.items[j] = swapped;
    }
}

static void edges_do_not_depend_on_the_order_of_boxes(void **state)
{
    (void)state;
    edge_list first = {0}, other = {0};
    for (uint64_t seed = 1; seed <= 20; seed++) {
        scene s = random_boxes(seed, BOXES);
        for (size_t i = 0; i < s.boxes.count; i++) /* colours that do not depend on the depth */
            s.boxes.items[i].style.role = (uint8_t)(i % 3);
        assert_true(edges_merge(&first, &s, 0, LAYER_DIAGRAM + 1));
        for (int round = 0; round < 10; round++) {
            shuffle(&s, &seed);
            assert_true(edges_merge(&other, &s, 0, LAYER_DIAGRAM + 1));
            assert_same_edges(&first, &other);
        }
        scene_release(&s);
    }
    edges_release(&first);
    edges_release(&other);
}

/* A row of boxes in three colours, in shuffled order. */
static void long_line_is_merged_in_any_order(void **state)
{
    (void)state;
    enum { ROW = 300 };
    edge_list first = {0}, other = {0};
    uint64_t random = 1;
    scene s = {.view = view_make_default()};
    for (uint64_t i = 0; i < ROW; i++) {
        const double at = (double)i;
        scene_box box = {.id = i + 1, .depth = 2, .box = {{at, 0, 0}, {at + 1, 1, 1}}, .style = kinds[0]};
        box.style.role = (uint8_t)(ROLE_NODE + i % 3);
        scene_add_box(&s, box);
    }
    assert_true(edges_merge(&first, &s, 0, LAYER_DIAGRAM + 1));
    assert_int_equal(first.now.count, 4 * ROW + 4 * (ROW + 1));
    shuffle(&s, &random);
    assert_true(edges_merge(&other, &s, 0, LAYER_DIAGRAM + 1));
    assert_same_edges(&first, &other);
    scene_release(&s);
    edges_release(&first);
    edges_release(&other);
}

/* Change one box a little, or none, or leave the last one out. */
static void change_boxes(scene *s, uint64_t *random)
{
    scene_box *box = &s->boxes.items[random_below(random, s->boxes.count)];
    switch (random_below(random, 8)) {
    case 0:
        box->id += 100;
        break;
    case 1:
        box->depth ^= 1;
        break;
    case 2:
        box->style.role++;
        break;
    case 3:
        box->style = kinds[random_below(random, KINDS)];
        break;
    case 4:
        box->box.max[random_below(random, 3)]++;
        break;
    case 5:
        s->boxes.count--;
        break;
    default:
        break;
    }
}

static void merging_does_not_depend_on_earlier_frames(void **state)
{
    (void)state;
    uint64_t random = 7;
    edge_list used = {0};
    for (uint64_t seed = 1; seed <= 20; seed++) {
        scene s = random_boxes(seed, BOXES);
        while (s.boxes.count > 4) {
            edge_list fresh = {0};
            assert_true(edges_merge(&used, &s, 0, LAYER_DIAGRAM + 1));
            assert_true(edges_merge(&fresh, &s, 0, LAYER_DIAGRAM + 1));
            assert_same_edges(&used, &fresh);
            edges_release(&fresh);
            change_boxes(&s, &random);
        }
        scene_release(&s);
    }
    edges_release(&used);
}

/* As with --lod: different boxes of one list are shown at each time. */
static void boxes_that_come_and_go_leave_no_edges(void **state)
{
    (void)state;
    uint64_t random = 11;
    edge_list used = {0};
    for (uint64_t seed = 1; seed <= 10; seed++) {
        scene all = random_boxes(seed, 200), s = {.view = view_make_default()};
        for (int frame = 0; frame < 30; frame++) {
            const uint64_t shown = random_below(&random, 101), moved = frame % 10 == 9 ? GRID * (uint64_t)frame : 0;
            edge_list fresh = {0};
            scene_clear(&s);
            for (size_t i = 0; i < all.boxes.count; i++) {
                for (int axis = 0; axis < 3; axis++) {
                    all.boxes.items[i].box.min[axis] += (double)moved;
                    all.boxes.items[i].box.max[axis] += (double)moved;
                }
                if (random_below(&random, 100) < shown)
                    scene_add_box(&s, all.boxes.items[i]);
            }
            assert_true(edges_merge(&used, &s, 0, LAYER_DIAGRAM + 1));
            assert_true(edges_merge(&fresh, &s, 0, LAYER_DIAGRAM + 1));
            assert_same_edges(&used, &fresh);
            edges_release(&fresh);
        }
        scene_release(&all);
        scene_release(&s);
    }
    edges_release(&used);
}

static void edges_layer_by_layer_equal_the_edges_of_all_layers(void **state)
{
    (void)state;
    edge_list all = {0}, low = {0}, high = {0};
    for (uint64_t seed = 1; seed <= 20; seed++) {
        scene s = random_boxes(seed, BOXES);
        assert_true(edges_merge(&all, &s, 0, LAYER_DIAGRAM + 1));
        assert_true(edges_merge(&low, &s, 0, LAYER_NODES + 1));
        assert_true(edges_merge(&high, &s, LAYER_NODES + 1, LAYER_DIAGRAM + 1));
        const edge_list first = {.now = {.items = all.now.items, .count = low.now.count}};
        const edge_list rest = {
            .now = {.items = all.now.items + low.now.count, .count = all.now.count - low.now.count}};
        assert_same_edges(&first, &low);
        assert_same_edges(&rest, &high);
        scene_release(&s);
    }
    edges_release(&all);
    edges_release(&low);
    edges_release(&high);
}

static void add_nodes(scene *s, const octree_box *world, octree_address address, unsigned depth, unsigned deepest)
{
    const octree_box box = octree_cell_box(world, address);
    const scene_style style = {.layer = LAYER_NODES, .role = (uint8_t)theme_node_role(depth), .width = 1};
    scene_add_box(s, (scene_box){.id = address, .box = box, .style = style, .depth = (uint8_t)depth});
    for (unsigned octant = 0; depth < deepest && octant < 8; octant++)
        add_nodes(s, world, address << 3 | octant, depth + 1, deepest);
}

/* All segments of a grid line have the depth of the line: there are 3 (2^d + 1)^2 edges, however many boxes share them.
 */
static void full_subdivision_has_one_edge_for_each_grid_line(void **state)
{
    (void)state;
    static const octree_box worlds[] = {{{-1000, -1000, -1000}, {1000, 1000, 1000}},
                                        {{0.1, -0.3, 1e-3}, {0.7, 1e9, 2e-3}},
                                        {{1e15, 0, 0}, {1e15 + 8, 1, 1}}};
    edge_list list = {0};
    for (size_t world = 0; world < sizeof worlds / sizeof worlds[0]; world++) {
        for (unsigned deepest = 0; deepest <= 4; deepest++) {
            scene s = {.view = view_make_default()};
            add_nodes(&s, &worlds[world], OCTREE_ROOT, 0, deepest);
            const size_t lines = ((size_t)1 << deepest) + 1;
            assert_true(edges_merge(&list, &s, 0, LAYER_DIAGRAM + 1));
            assert_int_equal(list.now.count, 3 * lines * lines);
            for (size_t i = 0; i < list.now.count; i++) {
                const int axis = axis_of(&list.now.items[i]);
                assert_true(list.now.items[i].ends[0][axis] == worlds[world].min[axis]);
                assert_true(list.now.items[i].ends[1][axis] == worlds[world].max[axis]);
            }
            scene_release(&s);
        }
    }
    edges_release(&list);
}

static void gap_between_boxes_stays_a_gap(void **state)
{
    (void)state;
    scene s = {.view = view_make_default()};
    edge_list list = {0};
    scene_add_box(&s, (scene_box){.id = 1, .box = {{0, 0, 0}, {1, 1, 1}}});
    scene_add_box(&s, (scene_box){.id = 2, .box = {{2, 0, 0}, {3, 1, 1}}});
    assert_true(edges_merge(&list, &s, 0, LAYER_DIAGRAM + 1));
    assert_int_equal(list.now.count, 24);
    scene_release(&s);
    edges_release(&list);
}

static void no_boxes_have_no_edges(void **state)
{
    (void)state;
    scene s = {.view = view_make_default()};
    edge_list list = {0};
    assert_true(edges_merge(&list, &s, 0, LAYER_DIAGRAM + 1));
    assert_int_equal(list.now.count, 0);
    edges_release(&list);
}

/* A box without extent is a point, and must be visible as one. */
static void box_without_extent_keeps_an_edge(void **state)
{
    (void)state;
    edge_list list = {0};
    for (unsigned flat = 1; flat < 8; flat++) {
        scene s = {.view = view_make_default()};
        octree_box box = cube(1, 2);
        for (int axis = 0; axis < 3; axis++)
            box.max[axis] = flat >> axis & 1 ? box.min[axis] : box.max[axis];
        scene_add_box(&s, (scene_box){.id = 1, .box = box});
        assert_true(edges_merge(&list, &s, 0, LAYER_DIAGRAM + 1));
        assert_true(list.now.count >= 1);
        scene_release(&s);
    }
    edges_release(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_edge_is_drawn_once_in_the_colour_of_the_shallowest_box),
        cmocka_unit_test(adjacent_edges_of_one_look_and_depth_are_merged),
        cmocka_unit_test(edges_do_not_depend_on_the_order_of_boxes),
        cmocka_unit_test(long_line_is_merged_in_any_order),
        cmocka_unit_test(merging_does_not_depend_on_earlier_frames),
        cmocka_unit_test(boxes_that_come_and_go_leave_no_edges),
        cmocka_unit_test(edges_layer_by_layer_equal_the_edges_of_all_layers),
        cmocka_unit_test(full_subdivision_has_one_edge_for_each_grid_line),
        cmocka_unit_test(gap_between_boxes_stays_a_gap),
        cmocka_unit_test(no_boxes_have_no_edges),
        cmocka_unit_test(box_without_extent_keeps_an_edge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
