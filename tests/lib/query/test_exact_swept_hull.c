/* SPDX-License-Identifier: MIT */
/* test_exact_swept_hull.c - slanting steps: nodes beside the way are left out, and no point on it is, at any scale.
 * test_swept.c and test_exact_swept.c have what is touched.
 */
#include "fixture.h"

#include <float.h>
#include <math.h>

#include "brute.h"
#include "exact_oracle.h"

typedef struct step {
    double from[3], to[3], size;
} step;

static bool ignore(const octree_point *point, void *context)
{
    (void)point;
    (void)context;
    return true;
}

static octree_box box_around(const step *s)
{
    octree_box box, end;
    octree_collision_box(s->from, s->size, &box);
    octree_collision_box(s->to, s->size, &end);
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = fmin(box.min[axis], end.min[axis]);
        box.max[axis] = fmax(box.max[axis], end.max[axis]);
    }
    return box;
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

typedef struct fraction {
    int64_t over, under; /* under > 0 */
} fraction;

static bool is_less(fraction a, fraction b)
{
    return a.over * b.under < b.over * a.under;
}

/* Whether the way of the middle meets the cell grown by the size: cut off axis by axis, in whole numbers (Liang and
 * Barsky 1984). */
static bool meets_cell(const step *s, const octree_box *cell)
{
    fraction enter = {0, 1}, leave = {1, 1};
    for (int axis = 0; axis < 3; axis++) {
        const int64_t from = (int64_t)s->from[axis], way = (int64_t)s->to[axis] - from, size = (int64_t)s->size;
        const int64_t below = (int64_t)cell->min[axis] - size - from, above = (int64_t)cell->max[axis] + size - from;
        if (way == 0 && (below > 0 || above < 0))
            return false;
        if (way == 0)
            continue;
        const fraction first = way > 0 ? (fraction){below, way} : (fraction){-above, -way};
        const fraction last = way > 0 ? (fraction){above, way} : (fraction){-below, -way};
        enter = is_less(enter, first) ? first : enter;
        leave = is_less(last, leave) ? last : leave;
    }
    return !is_less(leave, enter);
}

/* It is convex: whether all that lies in the cell is touched. */
static bool covers_cell(const step *s, const octree_box *cell)
{
    for (int corner = 0; corner < 8; corner++) {
        octree_box at;
        for (int axis = 0; axis < 3; axis++)
            at.min[axis] = at.max[axis] = corner >> axis & 1 ? cell->max[axis] : cell->min[axis];
        if (!meets_cell(s, &at))
            return false;
    }
    return true;
}

static bool overlap(const octree_box *a, const octree_box *b)
{
    for (int axis = 0; axis < 3; axis++)
        if (a->max[axis] < b->min[axis] || b->max[axis] < a->min[axis])
            return false;
    return true;
}

typedef struct judge {
    const step *step;
    octree_box around, world;
    size_t count[OCTREE_TRACE_KINDS];
} judge;

/* Whether the box around the step meets no other octant of a node's parent: then the node is not judged by itself. */
static bool is_only_octant(const judge *j, octree_address node)
{
    int met = 0;
    for (unsigned octant = 0; octant < 8; octant++) {
        const octree_box cell = octree_cell_box(&j->world, (node >> 3) << 3 | octant);
        met += overlap(&j->around, &cell);
    }
    return met == 1;
}

static void judge_node(octree_address node, octree_trace_kind touch, void *context)
{
    judge *j = context;
    const octree_box cell = octree_cell_box(&j->world, node);
    const bool met = meets_cell(j->step, &cell);
    j->count[touch]++;
    if (touch == OCTREE_TRACE_PRUNED)
        assert_false(met);
    else if (touch == OCTREE_TRACE_TAKEN)
        assert_true(covers_cell(j->step, &cell));
    else
        assert_true(met || node == OCTREE_ROOT || is_only_octant(j, node));
}

/* Cells have faces at multiples of 16, and the box around an odd step of an even size has none of its own there. */
static void a_node_is_visited_when_its_cell_is_touched_and_taken_when_it_is_covered(void **state)
{
    (void)state;
    uint64_t random = 1;
    brute all = {0};
    brute_scatter(&all, &random, 3000, 512, 1000000);
    octree *tree = brute_tree(&all, cube(-512, 512), 2, 6);
    judge j = {.world = cube(-512, 512)};
    for (int i = 0; i < 1500; i++) {
        step s = {.size = 2 * (double)random_below(&random, i % 3 == 0 ? 120 : 12)};
        for (int axis = 0; axis < 3; axis++) {
            s.from[axis] = 2 * (double)random_below(&random, 600) - 601;
            s.to[axis] = i % 5 == axis ? s.from[axis] : 2 * (double)random_below(&random, 600) - 601;
        }
        j.step = &s;
        j.around = box_around(&s);
        const octree_search how = {.trace = judge_node, .trace_context = &j};
        assert_int_equal(octree_collide_swept(tree, s.from, s.to, s.size, NULL, &how, ignore, NULL), OCTREE_OK);
    }
    for (int touch = 0; touch < OCTREE_TRACE_KINDS; touch++)
        assert_true(j.count[touch] > 1000);
    octree_destroy(tree);
    brute_free(&all);
}

/* ---- Points ------------------------------------------------------------------------------------------------- */

/* Where the hull of a step begins, as rounding lets it be, and up to an ulp beside; brought into the world. */
static void add_on_hull(brute *all, uint64_t *random, const step *s, const octree_box *world)
{
    const double t = octree_random_unit(random);
    double at[3];
    for (int axis = 0; axis < 3; axis++) {
        const double middle = s->from[axis] * (1 - t) + s->to[axis] * t;
        const double sides[4] = {s->size, -s->size, s->size * octree_random_unit(random), 0};
        const double there = middle + sides[random_below(random, 4)];
        const double near[3] = {there, next_up(there), next_down(there)};
        at[axis] = fmin(fmax(near[random_below(random, 3)], world->min[axis]), world->max[axis]);
    }
    if (!brute_contains(all, at, 0))
        brute_insert(all, at, 0);
}

/* From anywhere to anywhere, half as far again as the world reaches; of three sizes one is for a thin hull, and of
 * three ways one is in a plane of two axes. */
static step any_step(uint64_t *random, const octree_box *world)
{
    step s;
    const size_t thin = random_below(random, 3), flat = random_below(random, 9);
    double least = DBL_MAX;
    for (size_t axis = 0; axis < 3; axis++) {
        const double low = world->min[axis], high = world->max[axis], more = high / 4 - low / 4;
        s.from[axis] = random_between(random, fmax(low - more, -DBL_MAX), fmin(high + more, DBL_MAX));
        s.to[axis] = random_between(random, fmax(low - more, -DBL_MAX), fmin(high + more, DBL_MAX));
        if (axis == flat)
            s.to[axis] = s.from[axis];
        least = fmin(least, more);
    }
    s.size = random_between(random, 0, least) * (thin == 0 ? 1 : 0x1p-6);
    return s;
}

static void add_anywhere(brute *all, uint64_t *random, const octree_box *world, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = random_between(random, world->min[axis], world->max[axis]);
        if (!brute_contains(all, at, 0))
            brute_insert(all, at, 0);
    }
}

/* The nodes that searches go through: those that they look at, and all in and below those that they take whole. */
typedef struct effort {
    const octree *tree;
    size_t nodes, leaves;
} effort;

static void add_node(effort *e, octree_address address, bool all_below)
{
    octree_node node;
    assert_int_equal(octree_node_at(e->tree, address, &node), OCTREE_OK);
    e->nodes++;
    e->leaves += node.leaf;
    for (unsigned octant = 0; all_below && octant < 8; octant++)
        if (node.octants >> octant & 1)
            add_node(e, address << 3 | octant, true);
}

static void add_effort(octree_address node, octree_trace_kind touch, void *context)
{
    if (touch != OCTREE_TRACE_PRUNED)
        add_node(context, node, touch == OCTREE_TRACE_TAKEN);
}

static void assert_true_points(const octree *tree, const brute *all, const step *s, effort *swept, effort *around)
{
    const octree_search of_swept = {.trace = add_effort, .trace_context = swept};
    const octree_search of_around = {.trace = add_effort, .trace_context = around};
    swept->tree = around->tree = tree;
    const octree_box box = box_around(s);
    brute expected = {0}, found = {0};
    for (size_t i = 0; i < all->count; i++)
        if (exact_touches(s->from, s->to, s->size, all->points[i].position, all->points[i].position, NULL))
            brute_collect(&all->points[i], &expected);
    assert_int_equal(octree_collide_swept(tree, s->from, s->to, s->size, NULL, &of_swept, brute_collect, &found),
                     OCTREE_OK);
    assert_int_equal(octree_range_search(tree, &box, &of_around, ignore, NULL), OCTREE_OK);
    if (!brute_equal(&found, &expected))
        fail_msg("(%a %a %a) to (%a %a %a) with %a: %zu, not %zu", s->from[0], s->from[1], s->from[2], s->to[0],
                 s->to[1], s->to[2], s->size, found.count, expected.count);
    brute_free(&expected);
    brute_free(&found);
}

typedef struct scale {
    octree_box world;
    bool coarse; /* cells are a few doubles wide: what can be left out is little */
} scale;

static void slanting_steps_are_answered_exactly_and_cost_less_at_every_scale(void **state)
{
    (void)state;
    const scale scales[] = {{cube(-1000, 1000), false},
                            {cube(-1e-310, 1e-310), false},
                            {cube(-1e200, 1e200), false},
                            {cube(1e12, 1e12 + 1000), false},
                            {cube(-DBL_MAX, DBL_MAX), false},
                            {{{-1e200, 5, -1e-300}, {1e200, 6, 1e-300}}, true},
                            {{{-1e-300, 1e12, -1e-310}, {1e-300, 1e12 + 1, 1e-310}}, true},
                            {cube(1e15, 1e15 + 1), true},
                            {cube(0, 64 * 5e-324), true}};
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        const octree_box *world = &scales[i].world;
        uint64_t random = 10 + i;
        effort swept = {0}, around = {0};
        for (int trial = 0; trial < 12; trial++) {
            brute all = {0};
            step steps[6];
            add_anywhere(&all, &random, world, 100);
            for (int j = 0; j < 6; j++) {
                steps[j] = any_step(&random, world);
                for (int k = 0; k < 20; k++)
                    add_on_hull(&all, &random, &steps[j], world);
            }
            octree *tree = brute_tree(&all, *world, 1 + trial % 3, 21);
            for (int j = 0; j < 6; j++)
                assert_true_points(tree, &all, &steps[j], &swept, &around);
            octree_destroy(tree);
            brute_free(&all);
        }
        assert_true(swept.nodes <= around.nodes);
        if (!scales[i].coarse && 8 * swept.nodes > 7 * around.nodes)
            fail_msg("scale %zu: %d nodes, the box around has %d", i, (int)swept.nodes, (int)around.nodes);
    }
}

/* From one corner of a lattice to the other: what is met grows with the length of the way, not with its cube. */
static void a_step_through_a_lattice_costs_by_its_length(void **state)
{
    (void)state;
    const octree_box world = cube(-1000, 1000);
    brute all = {0};
    brute_sample(&all, OCTREE_SAMPLE_LATTICE, 0, &world, 8000);
    octree *tree = brute_tree(&all, world, 1, 21);
    effort swept = {0}, around = {0};
    const step s = {{-990, -980, -970}, {970, 980, 990}, 20};
    assert_true_points(tree, &all, &s, &swept, &around);
    assert_true(12 * swept.nodes < around.nodes && 12 * swept.leaves < around.leaves);
    octree_destroy(tree);
    brute_free(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_node_is_visited_when_its_cell_is_touched_and_taken_when_it_is_covered),
        cmocka_unit_test(slanting_steps_are_answered_exactly_and_cost_less_at_every_scale),
        cmocka_unit_test(a_step_through_a_lattice_costs_by_its_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
