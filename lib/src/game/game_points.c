/* game_points.c - the points that a tick's queries find, collected and sorted. */
#include "game_state.h"

#include <stdlib.h>

bool collect_point(const octree_point *point, void *context)
{
    point_collector *c = context;
    octree_point *item = list_append(c->memory, c->points, sizeof *item);
    if (item)
        *item = *point;
    c->failed = !item;
    return item != NULL;
}

void game_sort_points(octree_point *points, size_t count)
{
    if (count > 1)
        qsort(points, count, sizeof *points, octree_compare_points);
}
