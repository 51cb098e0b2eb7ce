/* SPDX-License-Identifier: MIT */
/* index_octreel.c - the octree of this repository. */
#include "index.h"

#include "octree/octree.h"

#include <stdlib.h>

static void *create(const octree_point *points, size_t count, const octree_box *world, size_t capacity)
{
    octree_def def = octree_def_default();
    octree *tree;
    size_t inserted;
    def.world = *world;
    def.leaf_capacity = capacity ? capacity : def.leaf_capacity;
    def.full_leaf = OCTREE_GROW;
    if (octree_create(&def, &tree) != OCTREE_OK)
        return NULL;
    if (octree_insert_many(tree, points, count, NULL, &inserted) == OCTREE_OK && inserted == count)
        return tree;
    octree_destroy(tree);
    return NULL;
}

static void destroy(void *self)
{
    octree_destroy(self);
}

/* The ids of an answer, as they are found. */
typedef struct id_list {
    uint64_t *ids;
    size_t room, count;
} id_list;

static bool add_id(const octree_point *point, void *context)
{
    id_list *list = context;
    if (list->count < list->room)
        list->ids[list->count] = point->id;
    list->count++;
    return true;
}

static size_t ask_region(const octree *tree, const octree_query *query, uint64_t *ids, size_t room)
{
    id_list list = {ids, room, 0};
    const octree_status status = query->kind == OCTREE_QUERY_RANGE
                                     ? octree_range(tree, &query->box, add_id, &list)
                                     : octree_radius(tree, query->target, query->radius, NULL, add_id, &list);
    return status == OCTREE_OK ? list.count : INDEX_REFUSED;
}

static size_t ask(const void *self, const octree_query *query, uint64_t *ids, size_t room)
{
    enum { ROOM = 64 };
    const octree_search how = {.epsilon = query->epsilon};
    octree_neighbor few[ROOM], *found = few;
    size_t count = query->kind == OCTREE_QUERY_NEAREST ? 1 : query->k;
    if (!octree_query_about(query->kind)->neighbors)
        return ask_region(self, query, ids, room);
    if (count > room)
        count = room;
    if (count > ROOM && !(found = malloc(count * sizeof *found)))
        return INDEX_REFUSED;
    const octree_status status = octree_nearest_k(self, query->target, count, &how, found, &count);
    for (size_t i = 0; i < count; i++)
        ids[i] = found[i].point.id;
    if (found != few)
        free(found);
    return status == OCTREE_OK ? count : INDEX_REFUSED;
}

const spatial_index index_octreel = {
    .name = "octreel",
    .version = "0.1.0",
    .precision = OCTREE_DOUBLES,
    .kinds = (1u << OCTREE_QUERY_RAY) - 1, /* all kinds for points without extent */
    .approximates = true,
    .create = create,
    .destroy = destroy,
    .ask = ask,
};
