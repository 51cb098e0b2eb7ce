/* SPDX-License-Identifier: MIT */
/* test_nodes.c - walk, locate and node_at: every point in the leaf that is drawn around it, the same nodes whatever
 * the order of changes. Addresses are in test_address.c. */
#include "fixture.h"

#include <math.h>
#include <string.h>

#include "brute.h"

/* What a walk has seen. */
typedef struct walk_log {
    const octree *tree;
    octree_address last;
    size_t nodes;
    size_t leaves;
    size_t points;
} walk_log;

/* Morton order over all levels: ancestors first, then octants ascending. */
static bool comes_before(octree_address a, octree_address b)
{
    unsigned depth_a = octree_address_depth(a), depth_b = octree_address_depth(b);
    octree_address deep_a = a << 3 * (OCTREE_MAX_DEPTH - depth_a), deep_b = b << 3 * (OCTREE_MAX_DEPTH - depth_b);
    return deep_a != deep_b ? deep_a < deep_b : depth_a < depth_b;
}

static bool same_box(const octree_box *a, const octree_box *b)
{
    return same_position(a->min, b->min) && same_position(a->max, b->max);
}

static void check_leaf(const walk_log *log, const octree_node *node)
{
    assert_int_equal(node->octants, 0);
    for (size_t i = 0; i < node->count; i++) {
        const double *position = node->points[i].position;
        assert_true(box_holds(&node->box, position));
        octree_node located;
        assert_int_equal(octree_locate(log->tree, position, &located), OCTREE_OK);
        assert_true(located.address == node->address);
    }
}

static void check_inner(const walk_log *log, const octree_node *node)
{
    assert_null(node->points);
    size_t below = 0;
    for (unsigned octant = 0; octant < 8; octant++) {
        octree_node child;
        octree_status status = octree_node_at(log->tree, node->address << 3 | octant, &child);
        assert_int_equal(status, node->octants >> octant & 1 ? OCTREE_OK : OCTREE_NOT_FOUND);
        if (status == OCTREE_OK) {
            assert_true(child.count > 0);
            below += child.count;
        }
    }
    assert_int_equal(below, node->count);
}

static octree_walk_order check_node(const octree_node *node, void *context)
{
    walk_log *log = context;
    octree_def def = octree_definition(log->tree);
    octree_box box = octree_cell_box(&def.world, node->address);
    assert_true(same_box(&box, &node->box));
    assert_true(log->nodes == 0 ? node->address == OCTREE_ROOT : comes_before(log->last, node->address));
    assert_int_equal(octree_address_depth(node->address), node->depth);
    octree_node again;
    assert_int_equal(octree_node_at(log->tree, node->address, &again), OCTREE_OK);
    assert_int_equal(again.count, node->count);
    assert_true(again.leaf == node->leaf && again.octants == node->octants && same_box(&again.box, &node->box));
    if (node->leaf)
        check_leaf(log, node);
    else
        check_inner(log, node);
    log->last = node->address;
    log->nodes++;
    log->leaves += node->leaf ? 1 : 0;
    log->points += node->leaf ? node->count : 0;
    return OCTREE_WALK_ON;
}

/* Everything that a walk promises, for every node, and that the statistics agree. */
static void assert_walk(const octree *tree)
{
    walk_log log = {.tree = tree};
    assert_int_equal(octree_walk(tree, check_node, &log), OCTREE_OK);
    octree_stats stats;
    assert_int_equal(octree_statistics(tree, &stats), OCTREE_OK);
    assert_int_equal(log.nodes, stats.nodes);
    assert_int_equal(log.leaves, stats.leaves);
    assert_int_equal(log.points, stats.points);
    assert_int_equal(log.points, octree_count(tree));
    size_t nodes = 0, leaves = 0;
    for (unsigned depth = 0; depth <= OCTREE_MAX_DEPTH; depth++) {
        nodes += stats.nodes_at_depth[depth];
        leaves += stats.leaves_at_depth[depth];
        assert_true(depth <= stats.depth || stats.nodes_at_depth[depth] == 0);
    }
    assert_int_equal(nodes, stats.nodes);
    assert_int_equal(leaves, stats.leaves);
    assert_valid(tree);
}

static octree_walk_order count_with_order(const octree_node *node, void *context)
{
    (void)node;
    size_t *left = context;
    return --*left == 0 ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

static octree_walk_order skip_deep(const octree_node *node, void *context)
{
    ++*(size_t *)context;
    assert_true(node->depth <= 1);
    return node->depth == 1 ? OCTREE_WALK_SKIP : OCTREE_WALK_ON;
}

static void a_walk_can_skip_and_stop(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(0, 8), 1, 5, OCTREE_REFUSE);
    for (uint64_t id = 0; id < 64; id++) {
        double at[3] = {(double)(id % 4) * 2 + 1, (double)(id / 4 % 4) * 2 + 1, (double)(id / 16) * 2 + 1};
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
    }
    assert_walk(tree);
    size_t seen = 0;
    assert_int_equal(octree_walk(tree, skip_deep, &seen), OCTREE_OK);
    assert_int_equal(seen, 9);
    for (size_t n = 1; n <= 73; n++) {
        size_t left = n;
        assert_int_equal(octree_walk(tree, count_with_order, &left), OCTREE_OK);
        assert_int_equal(left, 0);
    }
    octree_destroy(tree);
}

static void node_at_refuses_addresses_without_a_node(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(0, 8), 1, 21, OCTREE_REFUSE);
    static const double at[][3] = {{1, 1, 1}, {7, 7, 7}};
    insert_all(tree, at, 2);
    static const octree_address none[] = {0, 2, 3, 7, 9, 14, 8 * 8, UINT64_MAX, UINT64_C(1) << 63, 127};
    octree_node node;
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        assert_int_equal(octree_node_at(tree, none[i], &node), OCTREE_NOT_FOUND);
    assert_int_equal(octree_node_at(tree, 8, &node), OCTREE_OK);
    assert_int_equal(octree_node_at(tree, 15, &node), OCTREE_OK);
    octree_destroy(tree);
}

static void locate_gives_the_leaf_or_the_deepest_node_on_the_way(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(0, 8), 1, 5, OCTREE_REFUSE);
    octree_node node;
    assert_int_equal(octree_locate(tree, (double[3]){1, 1, 1}, &node), OCTREE_OK);
    assert_true(node.address == OCTREE_ROOT);
    static const double at[][3] = {{1, 1, 1}, {7, 7, 7}};
    insert_all(tree, at, 2);
    assert_int_equal(octree_locate(tree, (double[3]){3, 3, 3}, &node), OCTREE_OK);
    assert_true(node.address == 8 && node.leaf);
    assert_int_equal(octree_locate(tree, (double[3]){3, 3, 5}, &node), OCTREE_OK);
    assert_true(node.address == OCTREE_ROOT && !node.leaf);
    assert_int_equal(octree_locate(tree, (double[3]){3, 3, 9}, &node), OCTREE_OUTSIDE);
    assert_int_equal(octree_locate(tree, (double[3]){3, 3, -5e-324}, &node), OCTREE_OUTSIDE);
    assert_int_equal(octree_locate(tree, (double[3]){3, NAN, 3}, &node), OCTREE_NOT_FINITE);
    octree_destroy(tree);
}

/* Insert a point at a plane of one axis, and at one and two ulps on both sides. */
static void insert_around(octree *tree, int axis, double plane, uint64_t *id)
{
    double steps[5] = {next_down(next_down(plane)), next_down(plane), plane, next_up(plane), next_up(next_up(plane))};
    octree_def def = octree_definition(tree);
    for (int i = 0; i < 5; i++) {
        double at[3];
        for (int other = 0; other < 3; other++)
            at[other] = def.world.min[other];
        at[axis] = steps[i];
        if (box_holds(&def.world, at))
            assert_int_equal(octree_insert(tree, at, ++*id), OCTREE_OK);
    }
}

static void points_on_and_beside_every_plane_lie_in_the_leaf_that_is_drawn_around_them(void **state)
{
    (void)state;
    static const octree_box worlds[] = {{{-1000, -1000, -1000}, {1000, 1000, 1000}},
                                        {{0.1, -0.3, 1e15}, {0.7, 1e-3, 1e15 + 1}},
                                        {{-1.7e308, -1e200, 5e-324}, {1.7e308, 1e200, 1e-310}},
                                        {{-1, 1e-310, -7e-322}, {3, 1e-300, 9e-322}}};
    for (size_t w = 0; w < 4; w++) {
        octree *tree = make_tree(worlds[w], 1, 6, OCTREE_GROW);
        uint64_t id = 0;
        for (int axis = 0; axis < 3; axis++)
            for (unsigned k = 0; k < 64; k++) {
                octree_address address = OCTREE_ROOT; /* the cell k of depth 6 on this axis */
                for (int bit = 5; bit >= 0; bit--)
                    address = address << 3 | (k >> bit & 1) << (2 - axis);
                octree_box cell = octree_cell_box(&worlds[w], address);
                insert_around(tree, axis, cell.min[axis], &id);
            }
        assert_walk(tree);
        octree_destroy(tree);
    }
}

static void a_point_on_a_plane_lies_in_the_upper_cell(void **state)
{
    (void)state;
    octree *tree = make_tree(cube(-8, 8), 1, 3, OCTREE_GROW);
    for (int k = -3; k <= 3; k++)
        for (int axis = 0; axis < 3; axis++) {
            double at[3] = {1, 1, 1};
            at[axis] = 2 * k;
            assert_int_equal(octree_insert(tree, at, (uint64_t)(100 + 3 * k + axis)), OCTREE_OK);
            assert_int_equal(octree_insert(tree, at, (uint64_t)(200 + 3 * k + axis)), OCTREE_OK);
            octree_node leaf;
            assert_int_equal(octree_locate(tree, at, &leaf), OCTREE_OK);
            assert_int_equal(leaf.depth, 3);
            assert_true(leaf.box.min[axis] == at[axis]);
        }
    assert_walk(tree);
    octree_destroy(tree);
}

static void faces_edges_and_corners_can_be_found_and_removed(void **state)
{
    (void)state;
    static const octree_box worlds[] = {{{-1, -1, -1}, {1, 1, 1}}, {{0.1, 1e15, 5e-324}, {0.3, 1e15 + 1, 1e-310}}};
    for (size_t w = 0; w < 2; w++) {
        octree *tree = make_tree(worlds[w], 1, 21, OCTREE_GROW);
        for (int removing = 0; removing < 2; removing++)
            for (uint64_t id = 0; id < 27; id++) {
                double at[3];
                for (uint64_t axis = 0, rest = id; axis < 3; axis++, rest /= 3) {
                    octree_box upper = octree_cell_box(&worlds[w], 15);
                    const double values[] = {worlds[w].min[axis], upper.min[axis], worlds[w].max[axis]};
                    at[axis] = values[rest % 3];
                }
                assert_int_equal(removing ? octree_remove(tree, at, id) : octree_insert(tree, at, id), OCTREE_OK);
                assert_int_equal(octree_find(tree, at, NULL), removing ? OCTREE_NOT_FOUND : OCTREE_OK);
                assert_walk(tree);
            }
        assert_int_equal(octree_count(tree), 0);
        octree_destroy(tree);
    }
}

/* The digest of a tree that is built from these points in a random order. */
static uint64_t rebuilt_digest(const octree_def *def, const brute *all, uint64_t *random)
{
    octree *tree = NULL;
    assert_int_equal(octree_create(def, &tree), OCTREE_OK);
    brute order = {0};
    for (size_t i = 0; i < all->count; i++)
        brute_collect(&all->points[i], &order);
    for (size_t left = order.count; left > 0; left--) {
        size_t pick = random_below(random, left);
        octree_point point = order.points[pick];
        order.points[pick] = order.points[left - 1];
        assert_int_equal(octree_insert(tree, point.position, point.id), OCTREE_OK);
    }
    uint64_t digest = octree_digest(tree);
    brute_free(&order);
    octree_destroy(tree);
    return digest;
}

static void random_place(uint64_t *random, const octree_box *world, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] =
            random_below(random, 3) == 0
                ? random_between(random, world->min[axis], world->max[axis])
                : world->min[axis] + (double)random_below(random, 17) * (world->max[axis] / 16 - world->min[axis] / 16);
    for (int axis = 0; axis < 3; axis++)
        at[axis] = at[axis] > world->max[axis] ? world->max[axis] : at[axis];
}

/* One random insertion, removal or move, done to both. */
static void change(octree *tree, brute *all, uint64_t *random, uint64_t id)
{
    octree_def def = octree_definition(tree);
    uint64_t kind = random_below(random, 5);
    double at[3];
    random_place(random, &def.world, at);
    if (all->count == 0 || kind < 2) {
        assert_int_equal(octree_insert(tree, at, id), OCTREE_OK);
        brute_insert(all, at, id);
        return;
    }
    octree_point *point = &all->points[random_below(random, all->count)];
    if (kind < 4) {
        assert_int_equal(octree_move(tree, point->position, point->id, at), OCTREE_OK);
        memcpy(point->position, at, sizeof at);
        return;
    }
    octree_point gone = *point;
    assert_int_equal(octree_remove(tree, gone.position, gone.id), OCTREE_OK);
    assert_true(brute_remove(all, gone.position, gone.id));
}

static void any_order_of_changes_gives_the_nodes_of_a_rebuilt_tree(void **state)
{
    (void)state;
    static const octree_box worlds[] = {{{-8, -8, -8}, {8, 8, 8}},
                                        {{0.1, -0.3, 1e15}, {0.7, 1e-3, 1e15 + 1}},
                                        {{-1.7e308, -1e200, 5e-324}, {1.7e308, 1e200, 1e-310}}};
    for (uint64_t seed = 0; seed < 15; seed++) {
        uint64_t random = seed;
        octree_def def = define(worlds[seed % 3], 1 + seed % 4, seed * 3 % 22, OCTREE_GROW);
        octree *tree = NULL;
        assert_int_equal(octree_create(&def, &tree), OCTREE_OK);
        brute all = {0};
        for (uint64_t id = 0; id < 250; id++) {
            change(tree, &all, &random, id);
            assert_valid(tree);
            assert_int_equal(octree_count(tree), all.count);
            assert_true(octree_digest(tree) == rebuilt_digest(&def, &all, &random));
        }
        assert_walk(tree);
        brute_free(&all);
        octree_destroy(tree);
    }
}

static void the_digest_tells_contents_ids_and_worlds_apart(void **state)
{
    (void)state;
    octree *a = make_tree(cube(-1, 1), 2, 5, OCTREE_GROW), *b = make_tree(cube(-1, 2), 2, 5, OCTREE_GROW);
    assert_true(octree_digest(a) != octree_digest(b));
    octree_destroy(b);
    b = make_tree(cube(-1, 1), 2, 5, OCTREE_GROW);
    assert_true(octree_digest(a) == octree_digest(b));
    assert_int_equal(octree_insert(a, (double[3]){0.5, 0.5, 0.5}, 1), OCTREE_OK);
    assert_int_equal(octree_insert(b, (double[3]){0.5, 0.5, 0.5}, 2), OCTREE_OK);
    assert_true(octree_digest(a) != octree_digest(b));
    assert_int_equal(octree_insert(a, (double[3]){0.5, 0.5, 0.5}, 2), OCTREE_OK);
    assert_int_equal(octree_insert(b, (double[3]){0.5, 0.5, 0.5}, 1), OCTREE_OK);
    assert_true(octree_digest(a) == octree_digest(b));
    assert_int_equal(octree_move(a, (double[3]){0.5, 0.5, 0.5}, 2, (double[3]){0.5, 0.5, next_up(0.5)}), OCTREE_OK);
    assert_true(octree_digest(a) != octree_digest(b));
    octree_destroy(a);
    octree_destroy(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_walk_can_skip_and_stop),
        cmocka_unit_test(node_at_refuses_addresses_without_a_node),
        cmocka_unit_test(locate_gives_the_leaf_or_the_deepest_node_on_the_way),
        cmocka_unit_test(points_on_and_beside_every_plane_lie_in_the_leaf_that_is_drawn_around_them),
        cmocka_unit_test(a_point_on_a_plane_lies_in_the_upper_cell),
        cmocka_unit_test(faces_edges_and_corners_can_be_found_and_removed),
        cmocka_unit_test(any_order_of_changes_gives_the_nodes_of_a_rebuilt_tree),
        cmocka_unit_test(the_digest_tells_contents_ids_and_worlds_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
