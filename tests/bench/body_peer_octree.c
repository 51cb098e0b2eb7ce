/* SPDX-License-Identifier: MIT */
/* body_peer_octree.c - sets of bodies, and a tree of their positions. */
#include "body_peer.h"

#include <math.h>

/* ---- Bodies ------------------------------------------------------------------------------------------------- */

static void *create(const octree_box *world)
{
    octree_bodies *set;
    octree_def def = octree_bodies_def_default();
    def.world = *world;
    return octree_bodies_create(&def, &set) == OCTREE_OK ? set : NULL;
}

static void destroy(void *self)
{
    octree_bodies_destroy(self);
}

static size_t memory(const void *self)
{
    return octree_bodies_memory(self);
}

static void build(void *self, const octree_body *bodies, const octree_body *to, size_t count)
{
    (void)to;
    octree_bodies_insert_many(self, bodies, count, NULL, NULL);
}

static void insert(void *self, const octree_body *bodies, const octree_body *to, size_t count)
{
    (void)to;
    for (size_t i = 0; i < count; i++)
        octree_bodies_insert(self, &bodies[i]);
}

static void remove_each(void *self, const octree_body *bodies, const octree_body *to, size_t count)
{
    (void)to;
    for (size_t i = 0; i < count; i++)
        octree_bodies_remove(self, &bodies[i]);
}

static void move(void *self, const octree_body *bodies, const octree_body *to, size_t count)
{
    for (size_t i = 0; i < count; i++)
        octree_bodies_move(self, &bodies[i], &to[i]);
}

static void move_all(void *self, const octree_body *bodies, const octree_body *to, size_t count)
{
    (void)bodies;
    octree_bodies_replace_all(self, to, count, NULL, NULL);
}

static bool add_body(const octree_body *body, void *context)
{
    body_answer *answer = context;
    answer->count++;
    answer->ids += body->id;
    return true;
}

static void search(const void *self, const octree_region *regions, size_t count, body_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        answers[i] = (body_answer){0};
        octree_bodies_search(self, &regions[i], NULL, add_body, &answers[i]);
    }
}

static void cast(const void *self, const octree_region *regions, size_t count, body_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        octree_hit hit = {.at = 0};
        answers[i] = (body_answer){0};
        octree_bodies_cast(self, &regions[i], 1, NULL, NULL, NULL, &hit, &answers[i].count);
        answers[i].at = hit.at;
    }
}

static void find_nearest(const void *self, const octree_region *regions, size_t count, body_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        octree_hit hit = {.at = 0};
        answers[i] = (body_answer){0};
        octree_bodies_nearest(self, regions[i].center, 1, HUGE_VAL, NULL, NULL, NULL, &hit, &answers[i].count);
        answers[i].at = hit.at;
    }
}

static bool add_pair(const octree_body *a, const octree_body *b, void *context)
{
    body_answer *answer = context;
    answer->count++;
    answer->ids += a->id + b->id;
    return true;
}

static void find_pairs(const void *self, const octree_region *regions, size_t count, body_answer *answers)
{
    (void)regions;
    (void)count;
    answers[0] = (body_answer){0};
    octree_bodies_pairs(self, NULL, add_pair, &answers[0]);
}

const body_peer body_peer_octree = {
    "octree",
    create,
    destroy,
    memory,
    0,
    {build, insert, remove_each, move, move_all},
    {search, search, search, cast, find_nearest, find_pairs},
};

/* ---- Points ------------------------------------------------------------------------------------------------- */

static void *create_tree(const octree_box *world)
{
    octree *tree;
    octree_def def = octree_bodies_def_default();
    def.world = *world;
    return octree_create(&def, &tree) == OCTREE_OK ? tree : NULL;
}

static void destroy_tree(void *self)
{
    octree_destroy(self);
}

static size_t memory_of_tree(const void *self)
{
    octree_stats stats = {0};
    octree_statistics(self, &stats);
    return stats.memory;
}

static void insert_points(void *self, const octree_body *bodies, const octree_body *to, size_t count)
{
    (void)to;
    for (size_t i = 0; i < count; i++)
        octree_insert(self, bodies[i].position, bodies[i].id);
}

static void remove_points(void *self, const octree_body *bodies, const octree_body *to, size_t count)
{
    (void)to;
    for (size_t i = 0; i < count; i++)
        octree_remove(self, bodies[i].position, bodies[i].id);
}

static void move_points(void *self, const octree_body *bodies, const octree_body *to, size_t count)
{
    for (size_t i = 0; i < count; i++)
        octree_move(self, bodies[i].position, bodies[i].id, to[i].position);
}

const body_peer body_peer_points = {
    "points",       create_tree, destroy_tree,
    memory_of_tree, 0,           {insert_points, insert_points, remove_points, move_points, NULL},
    {NULL},
};
