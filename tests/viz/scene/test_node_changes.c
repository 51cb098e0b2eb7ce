/* SPDX-License-Identifier: MIT */
/* test_node_changes.c - the change that made a node's cell, and the points that a tick brought to it or took away,
 * equal those that follow from all trees since tick 0. */
#include "fixture.h"
#include "game_fixture.h"
#include "node_changes.h"
#include "random_session.h"

enum { MOST_TICKS = 400, MOST_POINTS = 256, MOST_NODES = 256 };

/* The tree of a tick: its points, its inner nodes, and their numbers of points. */
typedef struct tree_copy {
    octree_point points[MOST_POINTS];
    octree_address inner[MOST_NODES];
    size_t held[MOST_NODES], count, inner_count;
} tree_copy;

static tree_copy copies[MOST_TICKS];

static octree_walk_order copy_node(const octree_node *node, void *context)
{
    tree_copy *c = context;
    for (size_t i = 0; node->leaf && i < node->count; i++) {
        assert_true(c->count < MOST_POINTS);
        c->points[c->count++] = node->points[i];
    }
    assert_true(c->inner_count < MOST_NODES);
    c->inner[c->inner_count] = node->address;
    c->held[c->inner_count] = node->count;
    c->inner_count += !node->leaf;
    return OCTREE_WALK_ON;
}

static void copy_tree(const octree_game *game)
{
    const uint64_t tick = octree_game_tick(game)->number;
    assert_true(tick < MOST_TICKS);
    copies[tick] = (tree_copy){.count = 0};
    octree_walk(octree_game_tree(game), copy_node, &copies[tick]);
}

/* Returns the number of points in an inner node at a tick; 0 if the node is not an inner node then. */
static size_t points_in_inner(uint64_t tick, octree_address node)
{
    for (size_t i = 0; i < copies[tick].inner_count; i++)
        if (copies[tick].inner[i] == node)
            return copies[tick].held[i];
    return 0;
}

/* The address of the cell at a depth that contains a position, by the planes of all cells above. */
static octree_address cell_of(const octree_box *world, const double at[3], unsigned depth)
{
    octree_address cell = OCTREE_ROOT;
    for (unsigned level = 0; level < depth; level++) {
        const octree_box high = octree_cell_box(world, cell << 3 | 7);
        cell = cell << 3 | (at[0] >= high.min[0] ? 4u : 0u) | (at[1] >= high.min[1] ? 2u : 0u) |
               (at[2] >= high.min[2] ? 1u : 0u);
    }
    return cell;
}

static bool holds(const tree_copy *c, const octree_box *world, octree_address node, uint64_t id)
{
    for (size_t i = 0; i < c->count; i++)
        if (c->points[i].id == id)
            return cell_of(world, c->points[i].position, octree_address_depth(node)) == node;
    return false;
}

/* The test fails unless the ids are those of the points that a node holds in one tree and not in the other. */
static void check_ids(const octree_box *world, octree_address node, const tree_copy *to, const tree_copy *from,
                      id_list *ids)
{
    size_t expected = 0;
    for (size_t i = 0; i < to->count; i++)
        expected += holds(to, world, node, to->points[i].id) && !holds(from, world, node, to->points[i].id);
    assert_int_equal(ids->count, expected);
    for (size_t i = 0; i < ids->count; i++) {
        assert_true(holds(to, world, node, ids->items[i]) && !holds(from, world, node, ids->items[i]));
        assert_true(i == 0 || ids->items[i - 1] < ids->items[i]);
    }
    free(ids->items);
}

/* Returns 1 if the maker is a split, 2 if it is a merge, 0 if there is none. */
static int check_maker(const node_changes *c, uint64_t tick, octree_address node)
{
    const node_change maker = node_changes_find_origin(c, node);
    const octree_address parent = node >> 3;
    for (uint64_t t = maker.tick; t <= tick; t++)
        assert_true(maker.node && !maker.split ? points_in_inner(t, node) == 0
                                               : node == OCTREE_ROOT || points_in_inner(t, parent) > 0);
    if (!maker.node)
        return 0;
    assert_int_equal(maker.node, maker.split ? parent : node);
    assert_int_equal(points_in_inner(maker.tick - 1, maker.node) > 0, !maker.split);
    if (maker.split)
        assert_int_equal(points_in_inner(maker.tick, maker.node), maker.points);
    return maker.split ? 1 : 2;
}

typedef struct checking {
    const node_changes *changes;
    const octree_game *game;
    int makers[3];
} checking;

static octree_walk_order check_node(const octree_node *node, void *context)
{
    checking *c = context;
    const uint64_t tick = octree_game_tick(c->game)->number;
    const octree_box *world = &octree_game_session(c->game)->tree.world;
    id_list arrived, left;
    assert_true(node_changes_list_points(c->changes, c->game, node, &arrived, &left));
    check_ids(world, node->address, &copies[tick], &copies[tick - 1], &arrived);
    check_ids(world, node->address, &copies[tick - 1], &copies[tick], &left);
    if (node->leaf)
        c->makers[check_maker(c->changes, tick, node->address)]++;
    return OCTREE_WALK_ON;
}

static void changes_follow_from_all_trees_since_tick_0(void **state)
{
    static random_session made;
    int makers[3] = {0};
    (void)state;
    for (uint64_t seed = 0; seed < 5; seed++) {
        node_changes changes = {.tracked = true};
        random_session_mixed(&made, seed);
        octree_game *game = start_game(&made.session);
        copy_tree(game);
        while (!octree_game_over(game)) {
            assert_true(node_changes_begin_tick(&changes, game, NULL));
            assert_int_equal(octree_game_advance(game), OCTREE_OK);
            assert_true(node_changes_end_tick(&changes, game));
            copy_tree(game);
            checking c = {&changes, game, {0}};
            octree_walk(octree_game_tree(game), check_node, &c);
            for (int i = 0; i < 3; i++)
                makers[i] += c.makers[i];
        }
        node_changes_release(&changes);
        octree_game_destroy(game);
    }
    assert_true(makers[0] > 100 && makers[1] > 100 && makers[2] > 100);
}

static void nothing_is_stored_unless_tracked(void **state)
{
    (void)state;
    node_changes changes = {0};
    const octree_session session = octree_session_default();
    octree_game *game = start_game(&session);
    while (!octree_game_over(game)) {
        assert_true(node_changes_begin_tick(&changes, game, NULL));
        assert_int_equal(octree_game_advance(game), OCTREE_OK);
        assert_true(node_changes_end_tick(&changes, game));
    }
    assert_null(changes.items);
    assert_null(changes.before.items);
    octree_game_destroy(game);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changes_follow_from_all_trees_since_tick_0),
        cmocka_unit_test(nothing_is_stored_unless_tracked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
