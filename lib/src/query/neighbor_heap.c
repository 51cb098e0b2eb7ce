/* SPDX-License-Identifier: MIT */
#include "neighbor_heap.h"
#include "search.h"

#define FEW 32 /* neighbours */

/* The reach goes with the worst of k; until there are k, with the radius. Nodes have the slack of exact mode in fast
 * mode too: the bound of epsilon rests on it, and the order in which siblings are taken. */
static void set_reach(neighbor_heap *h)
{
    if (h->count == h->k) {
        const double worst = h->items[0].distance;
        h->point_reach = h->how.mode == OCTREE_FAST ? worst : metric_above(worst);
        h->node_reach = metric_above(worst * h->shrink);
    } else {
        h->point_reach = h->node_reach = h->radius >= 0 ? metric_above(h->radius_square) : INFINITY;
    }
}

neighbor_heap neighbor_heap_make(const metric *m, const octree_search *how, double radius, octree_neighbor *room,
                                 size_t k)
{
    neighbor_heap h = {
        .metric = *m,
        .how = *how,
        .radius = radius,
        .radius_square = radius * m->scale * (radius * m->scale),
        .shrink = how->epsilon > 0 ? (1 + 0x1p-50) / ((1 + how->epsilon) * (1 + how->epsilon)) : 1,
        .items = room,
        .k = k,
    };
    set_reach(&h);
    return h;
}

static bool is_skipped(const neighbor_heap *h, const octree_point *point)
{
    switch (h->how.skip) {
    case OCTREE_SKIP_ID:
        return point->id == h->how.skip_id;
    case OCTREE_SKIP_COINCIDENT:
        return same_position(point->position, h->metric.target);
    default:
        return false;
    }
}

static bool is_within_radius(const neighbor_heap *h, const octree_point *point, double square)
{
    return h->radius < 0 || is_within(&h->metric, h->how.mode, point, square, h->radius, h->radius_square);
}

static int compare_close(const neighbor_heap *h, const octree_neighbor *p, const octree_neighbor *q)
{
    const int order = is_trusted(h->how.mode, p->distance)
                          ? 0
                          : metric_compare(h->metric.target, p->point.position, q->point.position);
    return order ? order : octree_compare_points(&p->point, &q->point);
}

/* The order of results: by distance, then by id, then by position. */
static inline int compare(const neighbor_heap *h, const octree_neighbor *p, const octree_neighbor *q)
{
    const bool ascend = p->distance < q->distance;
    const double less = ascend ? p->distance : q->distance, more = ascend ? q->distance : p->distance;
    if (h->how.mode == OCTREE_FAST ? less < more : metric_above(less) < more)
        return ascend ? -1 : 1;
    return compare_close(h, p, q);
}

/* Item i of the heap is not nearer than its children: 2i + 1 and 2i + 2 or, of few neighbours, i + 1 alone. Few are
 * thus in descending order: moving some along takes less time than mispredicted branches of a heap, and nothing is left
 * to sort. `two` is a constant at each call, so that the compiler makes both. */
static bool are_few(const neighbor_heap *h)
{
    return h->k <= FEW;
}

/* Replace the top of the first `count`: what is farther than the new item rises. */
static inline void sink(const neighbor_heap *h, const octree_neighbor *item, size_t count, bool two)
{
    octree_neighbor *items = h->items;
    size_t at = 0;
    for (size_t child; (child = (at << two) + 1) < count; at = child) {
        if (two && child + 1 < count && compare(h, &items[child], &items[child + 1]) < 0)
            child++;
        if (compare(h, item, &items[child]) >= 0)
            break;
        items[at] = items[child];
    }
    items[at] = *item;
}

/* Put an item after the others: what is nearer sinks below it. */
static inline void rise(const neighbor_heap *h, const octree_neighbor *item, size_t at, bool two)
{
    octree_neighbor *items = h->items;
    for (size_t parent; at > 0 && compare(h, &items[parent = (at - 1) >> two], item) < 0; at = parent)
        items[at] = items[parent];
    items[at] = *item;
}

static void append(neighbor_heap *h, const octree_neighbor *item)
{
    if (are_few(h))
        rise(h, item, h->count++, false);
    else
        rise(h, item, h->count++, true);
}

static void replace_farthest(const neighbor_heap *h, const octree_neighbor *item)
{
    if (are_few(h))
        sink(h, item, h->count, false);
    else
        sink(h, item, h->count, true);
}

void neighbor_heap_add(neighbor_heap *h, const octree_point *point, double square)
{
    if (is_skipped(h, point) || !is_within_radius(h, point, square))
        return;
    const octree_neighbor found = {*point, square};
    if (h->count < h->k)
        append(h, &found);
    else if (compare(h, &found, &h->items[0]) < 0)
        replace_farthest(h, &found);
    else
        return;
    set_reach(h);
}

static void reverse(const neighbor_heap *h)
{
    for (size_t i = 0; i < h->count / 2; i++) {
        const octree_neighbor kept = h->items[i];
        h->items[i] = h->items[h->count - 1 - i];
        h->items[h->count - 1 - i] = kept;
    }
}

static void sort_heap(const neighbor_heap *h)
{
    for (size_t left = h->count; left-- > 1;) {
        const octree_neighbor last = h->items[left];
        h->items[left] = h->items[0];
        sink(h, &last, left, true);
    }
}

void neighbor_heap_finish(const neighbor_heap *h)
{
    if (are_few(h))
        reverse(h);
    else
        sort_heap(h);
    for (size_t i = 0; i < h->count; i++) {
        const double distance = metric_distance(h->metric.target, h->items[i].point.position);
        /* The order is the real numbers'; rounding must not make it look otherwise. */
        h->items[i].distance = i > 0 ? fmax(distance, h->items[i - 1].distance) : distance;
    }
}
