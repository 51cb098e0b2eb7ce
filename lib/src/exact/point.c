/* point.c - the order of points. */
#include "octree/octree.h"

int octree_compare_points(const void *a, const void *b)
{
    const octree_point *p = a, *q = b;
    if (p->id != q->id)
        return p->id < q->id ? -1 : 1;
    for (int i = 0; i < 3; i++)
        if (p->position[i] != q->position[i])
            return p->position[i] < q->position[i] ? -1 : 1;
    return 0;
}
