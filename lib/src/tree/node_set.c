/* node_set.c - see node_set.h. */
#include "node_set.h"
#include "bits.h"

static bool append(arena *memory, list *set, octree_address address)
{
    octree_address *item = list_append(memory, set, sizeof *item);
    if (item)
        *item = address;
    return item != NULL;
}

/* Pre-order: by the place of the cell's lowest corner, the larger cell first. */
static bool comes_before(octree_address a, octree_address b)
{
    const uint64_t a_place = a << (63 - bits_highest(a)), b_place = b << (63 - bits_highest(b));
    return a_place != b_place ? a_place < b_place : a < b;
}

int node_set_compare(const void *a, const void *b)
{
    const octree_address *p = a, *q = b;
    return comes_before(*p, *q) ? -1 : comes_before(*q, *p);
}

bool node_set_subtract(arena *memory, const list *a, const list *b, list *out)
{
    const octree_address *in_a = a->items, *in_b = b->items;
    size_t j = 0;
    for (size_t i = 0; i < a->count; i++) {
        while (j < b->count && comes_before(in_b[j], in_a[i]))
            j++;
        if ((j == b->count || in_b[j] != in_a[i]) && !append(memory, out, in_a[i]))
            return false;
    }
    return true;
}
