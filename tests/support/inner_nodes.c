/* SPDX-License-Identifier: MIT */
#include "inner_nodes.h"

#include <stdlib.h>
#include <string.h>

#include "fixture.h"

static octree_walk_order list_inner(const octree_node *node, void *context)
{
    inner_nodes *inner = context;
    assert_true(inner->count < INNER_NODES_AT_MOST);
    if (!node->leaf)
        inner->addresses[inner->count++] = node->address;
    return OCTREE_WALK_ON;
}

void list_inner_nodes(const octree *tree, inner_nodes *inner)
{
    inner->count = 0;
    assert_int_equal(octree_walk(tree, list_inner, inner), OCTREE_OK);
}

static int compare_addresses(const void *a, const void *b)
{
    const octree_address p = *(const octree_address *)a, q = *(const octree_address *)b;
    return p < q ? -1 : p > q;
}

/* The test fails unless `listed` is what is in `a` and not in `b`, in pre-order. */
static void assert_difference(const inner_nodes *a, const inner_nodes *b, const octree_address *listed, size_t count)
{
    static octree_address sorted[INNER_NODES_AT_MOST];
    size_t at = 0;
    memcpy(sorted, b->addresses, b->count * sizeof *sorted);
    qsort(sorted, b->count, sizeof *sorted, compare_addresses);
    for (size_t i = 0; i < a->count; i++) {
        if (bsearch(&a->addresses[i], sorted, b->count, sizeof *sorted, compare_addresses))
            continue;
        assert_true(at < count && listed[at] == a->addresses[i]);
        at++;
    }
    assert_int_equal(at, count);
}

void assert_splits_and_merges(const octree_tick *tick, const octree *tree, inner_nodes *before)
{
    static inner_nodes now;
    list_inner_nodes(tree, &now);
    assert_difference(&now, before, tick->splits, tick->split_count);
    assert_difference(before, &now, tick->merges, tick->merge_count);
    assert_true(((tick->events & OCTREE_EVENT_SPLIT) != 0) == (tick->split_count > 0));
    assert_true(((tick->events & OCTREE_EVENT_MERGED) != 0) == (tick->merge_count > 0));
    *before = now;
}
