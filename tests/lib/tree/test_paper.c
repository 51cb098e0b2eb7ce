/* SPDX-License-Identifier: MIT */
/* test_paper.c - the tree against the transcription of the paper's algorithms: where the paper is right they agree, and
 * where its text is at fault the difference is shown. */
#include "fixture.h"

#include <math.h>

#include "brute.h"
#include "paper.h"

/* One world in both. Coordinates are whole, so that all the paper's sums are exact. */
typedef struct pair {
    octree *tree;
    paper_octree paper;
    brute all;
    size_t refused;
} pair;

static pair make_pair(double reach, size_t capacity, size_t depth)
{
    octree_box world = cube(-reach, reach);
    return (pair){make_tree(world, capacity, depth, OCTREE_REFUSE), createOctree(world, capacity, depth), {0}, 0};
}

static void free_pair(pair *both)
{
    octree_destroy(both->tree);
    freeOctree(&both->paper);
    brute_free(&both->all);
}

static octree_point random_point(uint64_t *random, int64_t reach, uint64_t id)
{
    octree_point point = {.id = id};
    int64_t near = random_below(random, 2) == 0 ? reach : reach / 8;
    for (int axis = 0; axis < 3; axis++)
        point.position[axis] = (double)random_below(random, (uint64_t)(2 * near + 1)) - (double)near;
    return point;
}

static void insert_both(pair *both, const octree_point *point)
{
    bool taken = insertPoint(&both->paper, both->paper.root, point);
    assert_int_equal(octree_insert(both->tree, point->position, point->id), taken ? OCTREE_OK : OCTREE_FULL);
    if (taken)
        brute_insert(&both->all, point->position, point->id);
    else
        both->refused++;
}

/* The paper deletes the first point at the coordinates. So that both lose a point there, the lowest id goes. */
static void remove_both(pair *both, const octree_point *point)
{
    uint64_t id = 0;
    octree_status found = octree_find(both->tree, point->position, &id);
    bool deleted = deletePoint(&both->paper, both->paper.root, point);
    assert_int_equal(found, deleted ? OCTREE_OK : OCTREE_NOT_FOUND);
    assert_int_equal(octree_remove(both->tree, point->position, id), found);
    assert_true(brute_remove(&both->all, point->position, id) == deleted);
}

static void compare_search(const pair *both, const octree_point *point)
{
    bool found = searchPoint(both->paper.root, point) != NULL;
    assert_int_equal(octree_find(both->tree, point->position, NULL), found ? OCTREE_OK : OCTREE_NOT_FOUND);
}

/* The ids of coincident points may differ, because the paper does not say which of them it deletes. */
static void forget_ids(brute *points)
{
    for (size_t i = 0; i < points->count; i++)
        points->points[i].id = 0;
}

static void compare_range(const pair *both, const octree_point *a, const octree_point *b)
{
    octree_box box;
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = fmin(a->position[axis], b->position[axis]);
        box.max[axis] = fmax(a->position[axis], b->position[axis]);
    }
    brute ours = {0}, theirs = {0};
    size_t count = 0;
    rangeQuery(both->paper.root, box.min, box.max, &count, &theirs);
    assert_int_equal(octree_range(both->tree, &box, brute_collect, &ours), OCTREE_OK);
    assert_int_equal(ours.count, count);
    forget_ids(&ours);
    forget_ids(&theirs);
    assert_true(brute_equal(&ours, &theirs));
    brute_free(&ours);
    brute_free(&theirs);
}

/* Of points at one distance the paper names the one it meets first, and we the lowest id: the distance is compared. */
static void compare_nearest(const pair *both, const octree_point *target)
{
    octree_point theirs;
    double distance;
    bool found = findNearestNeighbor(&both->paper, target->position, &theirs, &distance);
    octree_neighbor ours;
    octree_status status = octree_nearest(both->tree, target->position, OCTREE_SKIP_COINCIDENT, 0, &ours);
    assert_int_equal(status, found ? OCTREE_OK : OCTREE_NOT_FOUND);
    if (found)
        assert_true(ours.distance == distance);
}

static size_t hits_of(const pair *both, const octree_point *at, double size)
{
    brute found = {0};
    assert_int_equal(octree_collide(both->tree, at->position, size, NULL, brute_collect, &found), OCTREE_OK);
    size_t count = found.count;
    brute_free(&found);
    return count;
}

/* The collision test of a moving point that its leaf can take; the paper is at fault elsewhere. */
static void compare_collision(const pair *both, const octree_point *at, double size)
{
    if (octree_insert(both->tree, at->position, at->id) != OCTREE_OK)
        return;
    assert_int_equal(octree_remove(both->tree, at->position, at->id), OCTREE_OK);
    size_t hits = hits_of(both, at, size);
    assert_true(detect_collision(&both->paper, at, size) == (hits > 0));
}

static bool has_no_points(const paper_node *node)
{
    if (node->leaf)
        return node->count == 0;
    for (int i = 0; i < 8; i++)
        if (!has_no_points(node->children[i]))
            return false;
    return true;
}

/* Every node of the paper that holds a point is ours, with the same box; the empty ones are not kept. */
static void compare_nodes(const octree *tree, const paper_node *node, octree_address address)
{
    octree_node ours;
    octree_status status = octree_node_at(tree, address, &ours);
    if (address != OCTREE_ROOT && has_no_points(node)) {
        assert_int_equal(status, OCTREE_NOT_FOUND);
        return;
    }
    assert_int_equal(status, OCTREE_OK);
    assert_true(ours.leaf == node->leaf);
    assert_true(same_position(ours.box.min, node->bounds.min) && same_position(ours.box.max, node->bounds.max));
    assert_true(!node->leaf || ours.count == node->count);
    for (unsigned i = 0; !node->leaf && i < 8; i++)
        compare_nodes(tree, node->children[i], address << 3 | i);
}

static void random_operations_agree(uint64_t seed)
{
    enum { reach = 64, operations = 1200 };
    uint64_t random = seed;
    pair both = make_pair(reach, 1 + seed % PAPER_POINTS, seed % 7);
    for (uint64_t i = 0; i < operations; i++) {
        octree_point a = random_point(&random, reach, i), b = random_point(&random, reach, i);
        octree_point known = a;
        if (both.all.count > 0)
            known = both.all.points[random_below(&random, both.all.count)];
        bool growing = i / 300 % 2 == 0;
        if (random_below(&random, 4) < (growing ? 3u : 1u))
            insert_both(&both, &a);
        else
            remove_both(&both, random_below(&random, 5) == 0 ? &b : &known);
        compare_search(&both, &a);
        compare_search(&both, &known);
        compare_range(&both, &a, &b);
        compare_nearest(&both, &b);
        compare_nearest(&both, &known);
        octree_point moving = {{b.position[0], b.position[1], b.position[2]}, UINT64_MAX};
        compare_collision(&both, &moving, (double)random_below(&random, 20));
        if (both.refused == 0)
            compare_nodes(both.tree, both.paper.root, OCTREE_ROOT);
        assert_valid(both.tree);
    }
    free_pair(&both);
}

static void the_tree_answers_as_the_paper(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 25; seed++)
        random_operations_agree(seed);
}

static void the_nodes_are_those_of_the_paper(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        uint64_t random = seed;
        pair both = make_pair(1000, 1 + seed % PAPER_POINTS, 20);
        for (uint64_t id = 0; id < 400; id++) {
            octree_point point = random_point(&random, 1000, id);
            if (octree_find(both.tree, point.position, NULL) == OCTREE_NOT_FOUND)
                insert_both(&both, &point);
        }
        compare_nodes(both.tree, both.paper.root, OCTREE_ROOT);
        while (both.all.count > 0) {
            octree_point point = both.all.points[random_below(&random, both.all.count)];
            remove_both(&both, &point);
            compare_nodes(both.tree, both.paper.root, OCTREE_ROOT);
        }
        assert_int_equal(both.refused, 0);
        free_pair(&both);
    }
}

static void at_fault_a_refused_insertion_leaves_the_paper_subdivided(void **state)
{
    (void)state;
    pair both = make_pair(8, 2, 3);
    const octree_point at[] = {{{1, 1, 1}, 1}, {{1, 1, 1}, 2}, {{1, 1, 1}, 3}};
    for (int i = 0; i < 3; i++)
        insert_both(&both, &at[i]);
    assert_int_equal(both.refused, 1);
    assert_false(both.paper.root->leaf); /* two points, and yet inner nodes down to the maximum depth */
    octree_stats stats;
    assert_int_equal(octree_statistics(both.tree, &stats), OCTREE_OK);
    assert_int_equal(stats.nodes, 1);
    free_pair(&both);
}

static void at_fault_a_full_leaf_hides_a_collision_from_the_paper(void **state)
{
    (void)state;
    pair both = make_pair(8, 1, 0);
    const octree_point only = {{1, 1, 1}, 1};
    const octree_point moving = {{2, 1, 1}, 9};
    insert_both(&both, &only);
    assert_int_equal(hits_of(&both, &moving, 3), 1);
    assert_false(detect_collision(&both.paper, &moving, 3)); /* the moving point is not in, so count is 1 */
    free_pair(&both);
}

static void at_fault_the_collision_test_of_the_paper_deletes_a_stranger(void **state)
{
    (void)state;
    pair both = make_pair(8, 1, 0);
    const octree_point only = {{1, 1, 1}, 1};
    const octree_point moving = {{1, 1, 1}, 9};
    insert_both(&both, &only);
    detect_collision(&both.paper, &moving, 3);
    assert_null(searchPoint(both.paper.root, &only)); /* lost */
    assert_int_equal(hits_of(&both, &moving, 3), 1);
    assert_true(octree_contains(both.tree, only.position, 1));
    free_pair(&both);
}

static void at_fault_the_paper_deletes_the_first_of_coincident_points(void **state)
{
    (void)state;
    pair both = make_pair(8, 4, 3);
    const octree_point first = {{1, 1, 1}, 1}, second = {{1, 1, 1}, 2};
    insert_both(&both, &first);
    insert_both(&both, &second);
    assert_true(deletePoint(&both.paper, both.paper.root, &second));
    const paper_node *leaf = searchPoint(both.paper.root, &second);
    assert_non_null(leaf);
    assert_int_equal(leaf->points[0].id, 2); /* the first point is gone */
    assert_int_equal(octree_remove(both.tree, second.position, 2), OCTREE_OK);
    assert_true(octree_contains(both.tree, first.position, 1));
    free_pair(&both);
}

static void at_fault_the_paper_sees_no_neighbour_at_its_own_coordinates(void **state)
{
    (void)state;
    pair both = make_pair(8, 4, 3);
    const octree_point self = {{1, 1, 1}, 1}, twin = {{1, 1, 1}, 2}, tiny = {{1e-170, 0, 0}, 3};
    insert_both(&both, &self);
    insert_both(&both, &twin);
    octree_point nearest;
    double distance;
    octree_neighbor ours;
    assert_false(findNearestNeighbor(&both.paper, self.position, &nearest, &distance));
    assert_int_equal(octree_nearest(both.tree, self.position, OCTREE_SKIP_ID, 1, &ours), OCTREE_OK);
    assert_int_equal(ours.point.id, 2);
    /* Nor one that is merely so near that the square vanishes. */
    const double zero[3] = {0, 0, 0};
    insert_both(&both, &tiny);
    assert_true(findNearestNeighbor(&both.paper, zero, &nearest, &distance));
    assert_int_equal(nearest.id, 1);
    assert_int_equal(octree_nearest(both.tree, zero, OCTREE_SKIP_COINCIDENT, 0, &ours), OCTREE_OK);
    assert_int_equal(ours.point.id, 3);
    free_pair(&both);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tree_answers_as_the_paper),
        cmocka_unit_test(the_nodes_are_those_of_the_paper),
        cmocka_unit_test(at_fault_a_refused_insertion_leaves_the_paper_subdivided),
        cmocka_unit_test(at_fault_a_full_leaf_hides_a_collision_from_the_paper),
        cmocka_unit_test(at_fault_the_collision_test_of_the_paper_deletes_a_stranger),
        cmocka_unit_test(at_fault_the_paper_deletes_the_first_of_coincident_points),
        cmocka_unit_test(at_fault_the_paper_sees_no_neighbour_at_its_own_coordinates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
