/* session_ids.c - see session_ids.h. */
#include "session_ids.h"

#include <stdlib.h>

static int compare_ids(const void *a, const void *b)
{
    uint64_t left = ((const session_id *)a)->id, right = ((const session_id *)b)->id;
    return (left > right) - (left < right);
}

static int compare_entries(const void *a, const void *b)
{
    size_t left = ((const session_id *)a)->place, right = ((const session_id *)b)->place;
    int order = compare_ids(a, b);
    return order != 0 ? order : (left > right) - (left < right);
}

session_id *session_ids_sorted(const octree_body *bodies, size_t count)
{
    session_id *ids = malloc(count * sizeof *ids);
    if (!ids)
        return NULL;
    for (size_t i = 0; i < count; i++)
        ids[i] = (session_id){bodies[i].id, i};
    qsort(ids, count, sizeof *ids, compare_entries);
    return ids;
}

const session_id *session_ids_find(const session_id *ids, size_t count, uint64_t id)
{
    session_id wanted = {id, 0};
    return bsearch(&wanted, ids, count, sizeof *ids, compare_ids);
}

size_t session_ids_repeated(const session_id *ids, size_t count, size_t *earlier)
{
    size_t first = count;
    for (size_t i = 1; i < count; i++) {
        if (ids[i].id != ids[i - 1].id || ids[i].place >= first)
            continue;
        first = ids[i].place;
        *earlier = ids[i - 1].place;
    }
    return first;
}
