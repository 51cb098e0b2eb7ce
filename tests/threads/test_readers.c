/* SPDX-License-Identifier: MIT */
/* test_readers.c - many threads ask one tree and one set of bodies at once. Built with ThreadSanitizer, which ends the
 * program with a failure when two of them touch the same memory and one of them writes.
 */
#include "fixture.h"

#include <math.h>
#include <pthread.h>

#include "octree/bodies.h"
#include "octree/sample.h"

enum { READERS = 4, POINTS = 3000, ROUNDS = 200 };

typedef struct reader {
    const octree *tree;
    const octree_bodies *bodies;
    uint64_t seed;
    uint64_t answers; /* a digest of all that was found: equal for equal seeds */
} reader;

static bool add_id(const octree_point *point, void *context)
{
    *(uint64_t *)context += point->id * 2654435761u;
    return true;
}

static octree_walk_order add_count(const octree_node *node, void *context)
{
    *(uint64_t *)context += node->count;
    return OCTREE_WALK_ON;
}

static void ask(reader *r, const double at[3])
{
    octree_neighbor nearest[8];
    octree_node node;
    octree_stats stats;
    bool found[1];
    size_t count;
    const double to[3] = {at[0] / 2, at[1] / 2, at[2] / 2};
    const octree_box box = {{at[0] - 50, at[1] - 50, at[2] - 50}, {at[0] + 50, at[1] + 50, at[2] + 50}};
    octree_range(r->tree, &box, add_id, &r->answers);
    octree_range_count(r->tree, &box, &count);
    octree_radius(r->tree, at, 80, NULL, add_id, &r->answers);
    octree_collide(r->tree, at, 60, NULL, add_id, &r->answers);
    octree_collide_swept(r->tree, at, to, 20, NULL, NULL, add_id, &r->answers);
    octree_nearest_k(r->tree, at, 8, NULL, nearest, &count);
    r->answers += nearest[count - 1].point.id;
    octree_nearest_batch(r->tree, &to, 1, NULL, nearest, found);
    octree_locate(r->tree, at, &node);
    octree_statistics(r->tree, &stats);
    octree_walk(r->tree, add_count, &r->answers);
    r->answers += nearest[0].point.id + node.address + stats.nodes + octree_digest(r->tree);
}

static bool add_body(const octree_body *body, void *context)
{
    *(uint64_t *)context += body->id * 2654435761u;
    return true;
}

static bool add_pair(const octree_body *a, const octree_body *b, void *context)
{
    *(uint64_t *)context = *(uint64_t *)context * 31 + a->id + 3 * b->id;
    return true;
}

static void ask_bodies(reader *r, const double at[3], bool all_pairs)
{
    octree_hit hits[4] = {{{{0}, {0}, 0}, 0}};
    size_t count;
    const octree_half_space spaces[2] = {{{1, 2, -1}, at[0]}, {{-1, 0.5, 0}, at[1]}};
    octree_region region = {.box = {{at[0] - 50, at[1] - 50, at[2] - 50}, {at[0] + 50, at[1] + 50, at[2] + 50}},
                            .radius = 80,
                            .half_spaces = spaces,
                            .half_space_count = 2,
                            .half = {5, 6, 7},
                            .direction = {1, -2, 0.5},
                            .length = 500};
    for (int i = 0; i < 3; i++)
        region.center[i] = region.origin[i] = region.from[i] = at[i];
    for (int kind = 0; kind < OCTREE_REGION_KINDS; kind++) {
        region.kind = (octree_region_kind)kind;
        octree_bodies_search(r->bodies, &region, NULL, add_body, &r->answers);
    }
    region.kind = OCTREE_REGION_RAY;
    octree_bodies_cast(r->bodies, &region, 4, NULL, NULL, NULL, hits, &count);
    r->answers += count + hits[0].body.id;
    octree_bodies_nearest(r->bodies, at, 4, HUGE_VAL, NULL, NULL, NULL, hits, &count);
    r->answers += hits[count - 1].body.id + octree_bodies_contain(r->bodies, &hits[0].body);
    if (all_pairs)
        octree_bodies_pairs(r->bodies, NULL, add_pair, &r->answers);
}

static void *read_all(void *context)
{
    reader *r = context;
    for (int i = 0; i < ROUNDS; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = random_between(&r->seed, -1000, 1000);
        ask(r, at);
        ask_bodies(r, at, i % 50 == 0);
    }
    return NULL;
}

static octree_bodies *make_bodies(const double (*positions)[3])
{
    octree_bodies *bodies;
    const octree_def def = define(cube(-1000, 1000), 8, 21, OCTREE_GROW);
    assert_int_equal(octree_bodies_create(&def, &bodies), OCTREE_OK);
    for (uint64_t i = 0; i < POINTS; i++) {
        const double half = i % 7 ? 10 : 0.5 * (double)(i % 100);
        const octree_body body = {{positions[i][0], positions[i][1], positions[i][2]}, {half, half, 5}, i};
        assert_int_equal(octree_bodies_insert(bodies, &body), OCTREE_OK);
    }
    return bodies;
}

static void readers_share_nothing_they_write(void **state)
{
    (void)state;
    static double positions[POINTS][3];
    octree *tree = make_tree(cube(-1000, 1000), 4, 21, OCTREE_GROW);
    const octree_box world = cube(-1000, 1000);
    assert_int_equal(octree_sample(OCTREE_SAMPLE_CLUSTERED, 3, &world, POINTS, positions), OCTREE_OK);
    insert_all(tree, (const double(*)[3])positions, POINTS);
    octree_bodies *bodies = make_bodies((const double(*)[3])positions);
    reader readers[READERS];
    pthread_t threads[READERS];
    for (int i = 0; i < READERS; i++) {
        readers[i] = (reader){tree, bodies, (uint64_t)(i / 2), 0}; /* two of each seed */
        assert_int_equal(pthread_create(&threads[i], NULL, read_all, &readers[i]), 0);
    }
    for (int i = 0; i < READERS; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int i = 0; i < READERS; i += 2)
        assert_true(readers[i].answers == readers[i + 1].answers);
    assert_true(readers[0].answers != readers[2].answers);
    octree_bodies_destroy(bodies);
    octree_destroy(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(readers_share_nothing_they_write),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
