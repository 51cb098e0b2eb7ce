/* SPDX-License-Identifier: MIT */
/* peer_octree.c - the octree as a peer of the bench: default capacity and depth, leaves that grow. */
#include "peer.h"

#include <stdlib.h>

void *make_octree(const octree_box *world, size_t capacity)
{
    octree_def def = octree_def_default();
    def.world = *world;
    def.full_leaf = OCTREE_GROW;
    def.leaf_capacity = capacity;
    octree *tree;
    octree_create(&def, &tree);
    return tree;
}

static void *create(const octree_box *world)
{
    return make_octree(world, octree_def_default().leaf_capacity);
}

static void destroy(void *self)
{
    octree_destroy(self);
}

static size_t memory(const void *self)
{
    octree_stats stats;
    return octree_statistics(self, &stats) == OCTREE_OK ? stats.memory : 0;
}

static size_t build(void *self, const octree_point *points, const octree_point *to, size_t count)
{
    (void)to;
    size_t inserted = 0;
    octree_insert_many(self, points, count, NULL, &inserted);
    return inserted;
}

static size_t insert(void *self, const octree_point *points, const octree_point *to, size_t count)
{
    (void)to;
    size_t done = 0;
    for (size_t i = 0; i < count; i++)
        done += octree_insert(self, points[i].position, points[i].id) == OCTREE_OK;
    return done;
}

static size_t take_out(void *self, const octree_point *points, const octree_point *to, size_t count)
{
    (void)to;
    size_t done = 0;
    for (size_t i = 0; i < count; i++)
        done += octree_remove(self, points[i].position, points[i].id) == OCTREE_OK;
    return done;
}

static size_t move(void *self, const octree_point *points, const octree_point *to, size_t count)
{
    size_t done = 0;
    for (size_t i = 0; i < count; i++)
        done += octree_move(self, points[i].position, points[i].id, to[i].position) == OCTREE_OK;
    return done;
}

static bool add_hit(const octree_point *point, void *context)
{
    peer_answer *answer = context;
    answer->count++;
    answer->ids += point->id;
    return true;
}

static void find(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        uint64_t id = 0;
        const bool found = octree_find(self, queries[i].at, &id) == OCTREE_OK;
        answers[i] = (peer_answer){.count = found, .ids = id};
    }
}

static void box(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        const double *at = queries[i].at, size = queries[i].size;
        const octree_box asked = {.min = {at[0] - size, at[1] - size, at[2] - size},
                                  .max = {at[0] + size, at[1] + size, at[2] + size}};
        answers[i] = (peer_answer){0};
        octree_range(self, &asked, add_hit, &answers[i]);
    }
}

static void radius(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        answers[i] = (peer_answer){0};
        octree_radius(self, queries[i].at, queries[i].size, NULL, add_hit, &answers[i]);
    }
}

static void collide(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        answers[i] = (peer_answer){0};
        octree_collide(self, queries[i].at, queries[i].size, NULL, add_hit, &answers[i]);
    }
}

static void nearest(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        octree_neighbor found = {.distance = 0};
        const bool any = octree_nearest(self, queries[i].at, OCTREE_SKIP_NONE, 0, &found) == OCTREE_OK;
        answers[i] = (peer_answer){.count = any, .distance = found.distance};
    }
}

static void search_k(const void *self, const peer_query *queries, size_t count, size_t k, const octree_search *how,
                     peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        octree_neighbor found[PEER_NEIGHBORS];
        size_t number = 0;
        octree_nearest_k(self, queries[i].at, k, how, found, &number);
        answers[i] = (peer_answer){.count = number};
        for (size_t j = 0; j < number; j++)
            answers[i].distance += found[j].distance;
    }
}

static void nearest_fast(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    search_k(self, queries, count, 1, &(octree_search){.mode = OCTREE_FAST}, answers);
}

static void knn(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    search_k(self, queries, count, PEER_NEIGHBORS, NULL, answers);
}

static void mixed(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        peer_answer parts[3];
        find(self, &queries[i], 1, &parts[0]);
        nearest(self, &queries[i], 1, &parts[1]);
        box(self, &queries[i], 1, &parts[2]);
        answers[i] = (peer_answer){.count = parts[0].count + parts[1].count + parts[2].count,
                                   .ids = parts[0].ids + parts[2].ids,
                                   .distance = parts[1].distance};
    }
}

/* What has no memory stays unanswered, which the comparison finds. */
static void ask_batches(const void *self, const peer_query *queries, size_t count, size_t batch, peer_answer *answers)
{
    double(*targets)[3] = malloc(batch * sizeof *targets);
    octree_neighbor *found = calloc(batch, sizeof *found);
    for (size_t start = 0; targets && found && start < count; start += batch) {
        const size_t size = count - start < batch ? count - start : batch;
        for (size_t i = 0; i < size; i++)
            for (int axis = 0; axis < 3; axis++)
                targets[i][axis] = queries[start + i].at[axis];
        const octree_status status = octree_nearest_batch(self, (const double(*)[3])targets, size, NULL, found, NULL);
        for (size_t i = 0; i < size; i++)
            answers[start + i] = (peer_answer){.count = status == OCTREE_OK, .distance = found[i].distance};
    }
    free(targets);
    free(found);
}

static void nearest_batch(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    ask_batches(self, queries, count, PEER_BATCH, answers);
}

static void nearest_all(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    ask_batches(self, queries, count, count, answers);
}

const peer peer_octree = {
    .name = "octree",
    .create = create,
    .destroy = destroy,
    .memory = memory,
    .change = {[PEER_BUILD] = build, [PEER_INSERT] = insert, [PEER_REMOVE] = take_out, [PEER_MOVE] = move},
    .ask = {[PEER_FIND] = find,
            [PEER_BOX] = box,
            [PEER_RADIUS] = radius,
            [PEER_NEAREST] = nearest,
            [PEER_NEAREST_FAST] = nearest_fast,
            [PEER_NEAREST_BATCH] = nearest_batch,
            [PEER_NEAREST_ALL] = nearest_all,
            [PEER_KNN] = knn,
            [PEER_COLLIDE] = collide,
            [PEER_MIXED] = mixed},
};
