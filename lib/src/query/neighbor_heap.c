/* best.c - see best.h. */
#include "neighbor_heap.h"
#include "point.h"
#include "search.h"

#define FEW 32 /* neighbours */

/* The reach goes with the worst of k; until there are k, with the radius. Nodes have the slack of exact mode in fast
 * mode too: the bound of epsilon rests on it, and the order in which siblings are taken. */
static void set_reach(best *b)
{
    if (b->count == b->k) {
        const double worst = b->heap[0].distance;
        b->point_reach = b->how.mode == OCTREE_FAST ? worst : metric_above(worst);
        b->node_reach = metric_above(worst * b->shrink);
    } else {
        b->point_reach = b->node_reach = b->radius >= 0 ? metric_above(b->radius_square) : INFINITY;
    }
}

best best_make(const metric *m, const octree_search *how, double radius, octree_neighbor *room, size_t k)
{
    best b = {
        .metric = *m,
        .how = *how,
        .radius = radius,
        .radius_square = radius * m->scale * (radius * m->scale),
        .shrink = how->epsilon > 0 ? (1 + 0x1p-50) / ((1 + how->epsilon) * (1 + how->epsilon)) : 1,
        .heap = room,
        .k = k,
    };
    set_reach(&b);
    return b;
}

static bool is_skipped(const best *b, const octree_point *point)
{
    switch (b->how.skip) {
    case OCTREE_SKIP_ID:
        return point->id == b->how.skip_id;
    case OCTREE_SKIP_COINCIDENT:
        return same_position(point->position, b->metric.target);
    default:
        return false;
    }
}

static bool is_within_radius(const best *b, const octree_point *point, double square)
{
    return b->radius < 0 || is_within(&b->metric, b->how.mode, point, square, b->radius, b->radius_square);
}

static int compare_close(const best *b, const octree_neighbor *p, const octree_neighbor *q)
{
    const int order = is_trusted(b->how.mode, p->distance)
                          ? 0
                          : metric_compare(b->metric.target, p->point.position, q->point.position);
    return order ? order : octree_compare_points(&p->point, &q->point);
}

/* The order of results: by distance, then by id, then by position. */
static inline int compare(const best *b, const octree_neighbor *p, const octree_neighbor *q)
{
    const bool ascend = p->distance < q->distance;
    const double less = ascend ? p->distance : q->distance, more = ascend ? q->distance : p->distance;
    if (b->how.mode == OCTREE_FAST ? less < more : metric_above(less) < more)
        return ascend ? -1 : 1;
    return compare_close(b, p, q);
}

/* Put an item where the top of the first `count` was: what is worse rises above it. */
static void sink(const best *b, const octree_neighbor *item, size_t count)
{
    octree_neighbor *heap = b->heap;
    size_t at = 0;
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && compare(b, &heap[child], &heap[child + 1]) < 0)
            child++;
        if (compare(b, item, &heap[child]) >= 0)
            break;
        heap[at] = heap[child];
    }
    heap[at] = *item;
}

static void rise(const best *b, const octree_neighbor *item, size_t at)
{
    octree_neighbor *heap = b->heap;
    for (; at > 0 && compare(b, &heap[(at - 1) / 2], item) < 0; at = (at - 1) / 2)
        heap[at] = heap[(at - 1) / 2];
    heap[at] = *item;
}

/* A few neighbours are kept in descending order, which is a heap too. To move some along takes less time than to
 * foresee wrongly which way a heap branches, and at the end nothing is left to sort. */
static bool are_few(const best *b)
{
    return b->k <= FEW;
}

static void sink_in_order(const best *b, const octree_neighbor *item)
{
    octree_neighbor *heap = b->heap;
    size_t at = 0;
    for (; at + 1 < b->count && compare(b, item, &heap[at + 1]) < 0; at++)
        heap[at] = heap[at + 1];
    heap[at] = *item;
}

static void rise_in_order(const best *b, const octree_neighbor *item, size_t at)
{
    octree_neighbor *heap = b->heap;
    for (; at > 0 && compare(b, &heap[at - 1], item) < 0; at--)
        heap[at] = heap[at - 1];
    heap[at] = *item;
}

static void add(best *b, const octree_neighbor *item)
{
    if (are_few(b))
        rise_in_order(b, item, b->count++);
    else
        rise(b, item, b->count++);
}

static void replace_worst(const best *b, const octree_neighbor *item)
{
    if (are_few(b))
        sink_in_order(b, item);
    else
        sink(b, item, b->count);
}

void best_consider(best *b, const octree_point *point, double square)
{
    if (is_skipped(b, point) || !is_within_radius(b, point, square))
        return;
    const octree_neighbor found = {*point, square};
    if (b->count < b->k)
        add(b, &found);
    else if (compare(b, &found, &b->heap[0]) < 0)
        replace_worst(b, &found);
    else
        return;
    set_reach(b);
}

static void reverse(const best *b)
{
    for (size_t i = 0; i < b->count / 2; i++) {
        const octree_neighbor kept = b->heap[i];
        b->heap[i] = b->heap[b->count - 1 - i];
        b->heap[b->count - 1 - i] = kept;
    }
}

static void sort_heap(const best *b)
{
    for (size_t left = b->count; left-- > 1;) {
        const octree_neighbor last = b->heap[left];
        b->heap[left] = b->heap[0];
        sink(b, &last, left);
    }
}

void best_finish(const best *b)
{
    if (are_few(b))
        reverse(b);
    else
        sort_heap(b);
    for (size_t i = 0; i < b->count; i++) {
        const double distance = metric_distance(b->metric.target, b->heap[i].point.position);
        /* The order is the real numbers'; rounding must not make it look otherwise. */
        b->heap[i].distance = i > 0 ? fmax(distance, b->heap[i - 1].distance) : distance;
    }
}
