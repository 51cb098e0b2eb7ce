/* SPDX-License-Identifier: MIT */
/* neighbor_heap.c - the k nearest neighbours found so far.
 *
 * Problem: a search offers thousands of points and keeps k. Each kept point lowers the distance beyond which points and
 * nodes are ignored. Squares in doubles order most points, but for near ties only the exact comparison decides.
 *
 * Idea: for k <= 32 a sorted array of keys. A key is a neighbour's squared distance as a double, with its lowest six
 * bits replaced by the number of the slot that holds the neighbour. So moving one double moves the neighbour. Insertion
 * shifts keys by minimum and maximum, without branches and two at a time. A key differs from the squared distance by at
 * most 2^-46 of it.
 *
 * Near ties: the search keeps every point whose key is too close to the k-th key to decide, up to 64 points in all. Its
 * end selects among them by the squared distances as integers of 128 bits (metric.h), each computed once. So a search
 * on a grid, where most points tie, decides only the ties that matter. If there are more near ties than slots (a
 * million points may share one position), each further point is compared exactly with the k-th neighbour at once.
 *
 * Why not a heap for all k: for small k its unpredictable branches cost more than the shifts. Larger k use a binary
 * heap in the caller's array, farthest on top. Cost for each point kept: O(k) with the array, O(log k) with the heap.
 */
#include "neighbor_heap.h"
#include "search.h"

#if defined(__GNUC__)
/* Marks functions that are rarely called. They are not inlined, so that their callers save fewer registers. */
#define RARE __attribute__((noinline))
#else
#define RARE
#endif

/* Returns the squared distance beyond which nodes are pruned, if points are searched up to the squared distance
 * `square`. The result allows for the error of the nodes' distances. */
static inline double limit_of_node_distance(const neighbor_heap *h, double square)
{
    if (!(h->node_error > 0))
        return metric_above(square);
    const double reach = sqrt(square) + h->node_error;
    return metric_above(reach * reach);
}

/* Returns the squared distance beyond which points are ignored, if `worst` is the squared distance of the farthest of k
 * neighbours. FAST mode drops the tolerance for points only: nodes keep it, because the bound of epsilon and the order
 * of siblings (nearest.c) depend on it. */
static inline double find_point_reach(const neighbor_heap *h, double worst)
{
    return h->how->mode == OCTREE_FAST ? worst : metric_above(worst);
}

static bool has_few_slots(const neighbor_heap *h)
{
    return h->k <= FEW_NEIGHBORS;
}

static bool is_skipped(const neighbor_heap *h, const octree_point *point)
{
    switch (h->how->skip) {
    case OCTREE_SKIP_ID:
        return point->id == h->how->skip_id;
    case OCTREE_SKIP_COINCIDENT:
        return is_same_position(point->position, h->metric.target);
    default:
        return false;
    }
}

static inline bool is_within_radius(const neighbor_heap *h, const octree_point *point, double square)
{
    return h->radius < 0 || is_within_ball(&h->metric, h->how->mode, point, square, h->radius, h->radius_square);
}

static inline bool is_accepted(const neighbor_heap *h, const octree_point *point, double square)
{
    return !is_skipped(h, point) && is_within_radius(h, point, square);
}

static int compare_near_tie(const neighbor_heap *h, const octree_point *p, const octree_point *q, double square)
{
    const int order =
        is_compared_as_double(h->how->mode, square) ? 0 : metric_compare(h->metric.target, p->position, q->position);
    return order ? order : octree_compare_points(p, q);
}

/* Compare two neighbours in the order of the results: by distance, then by id, then by position. */
static inline int compare_neighbors(const neighbor_heap *h, const octree_point *p, double p_square,
                                    const octree_point *q, double q_square)
{
    const bool ascend = p_square < q_square;
    const double less = ascend ? p_square : q_square, more = ascend ? q_square : p_square;
    if (h->how->mode == OCTREE_FAST ? less < more : metric_above(less) < more)
        return ascend ? -1 : 1;
    return compare_near_tie(h, p, q, p_square);
}

/* ---- Up to 32 neighbours: a sorted array of keys -------------------------------------------------------------- */

static unsigned find_slot_of_key(double key)
{
    uint64_t bits;
    memcpy(&bits, &key, sizeof bits);
    return bits & (FEW_SLOTS - 1);
}

static double make_slot_key(double square, unsigned place)
{
    uint64_t bits;
    memcpy(&bits, &square, sizeof bits);
    bits = (bits & ~(uint64_t)(FEW_SLOTS - 1)) | place;
    memcpy(&square, &bits, sizeof square);
    return square;
}

/* Returns a limit: a neighbour whose square or key is smaller is certainly nearer than the neighbour with `key`. Each
 * of two keys is off by at most 2^-46 of itself, and metric_below() allows 2^-47 and 2^-998 for the errors of the
 * squares; 2^-44 is more than this sum. */
static double certainly_nearer_limit(double key)
{
    return key * (1 - 0x1p-44) - 0x1p-998;
}

/* Returns a limit: a neighbour whose square is greater is certainly farther than those with `key` and smaller keys. */
static double possibly_nearer_limit(double key)
{
    return key < METRIC_FINITE / 2 ? key * (1 + 0x1p-44) + 0x1p-998 : INFINITY;
}

/* Returns the integer square of the neighbour in a slot. */
static const metric_integer *find_integer_of_slot(neighbor_heap *h, unsigned place)
{
    few_neighbors *f = &h->few;
    const double *position = f->points[place]->position;
    if (!(f->integers_known >> place & 1)) {
        if (!f->integers_known)
            metric_set_unit(&f->unit, h->metric.target, position);
        f->integers[place] = metric_integer_square(&f->unit, position);
        f->integers_known |= UINT64_C(1) << place;
    }
    return &f->integers[place];
}

/* Compare two neighbours by their integer squares, then by id and position. */
static inline bool is_less_or_tied(const metric_integer *a, const octree_point *p, const metric_integer *b,
                                   const octree_point *q)
{
    if ((a->high == b->high) & (a->low == b->low))
        return octree_compare_points(p, q) < 0;
    return (a->high < b->high) | ((a->high == b->high) & (a->low < b->low));
}

/* Returns whether a point is nearer than the neighbour in a slot. */
static RARE bool is_nearer_than_slot(neighbor_heap *h, const octree_point *point, double square, unsigned place)
{
    const octree_point *other = h->few.points[place];
    if (is_same_position(point->position, other->position)) /* many points may share one position */
        return octree_compare_points(point, other) < 0;
    if (h->how->mode == OCTREE_EXACT) {
        const metric_integer *theirs = find_integer_of_slot(h, place);
        const metric_integer own = metric_integer_square(&h->few.unit, point->position);
        if (own.high >= 0 && theirs->high >= 0)
            return is_less_or_tied(&own, point, theirs, other);
    }
    return compare_neighbors(h, point, square, other, h->few.squares[place]) < 0;
}

/* Returns whether the neighbour of a key is nearer than that of another. Exact arithmetic decides if the keys are too
 * close to decide. */
static bool is_nearer_key(neighbor_heap *h, double a, double b)
{
    const unsigned p = find_slot_of_key(a), q = find_slot_of_key(b);
    if (a < certainly_nearer_limit(b))
        return true;
    if (h->how->mode == OCTREE_EXACT) {
        const metric_integer *x = find_integer_of_slot(h, p), *y = find_integer_of_slot(h, q);
        if (x->high >= 0 && y->high >= 0)
            return is_less_or_tied(x, h->few.points[p], y, h->few.points[q]);
    }
    return compare_neighbors(h, h->few.points[p], h->few.squares[p], h->few.points[q], h->few.squares[q]) < 0;
}

/* Insert a key in ascending order and drop the key at index `last`. Each key becomes the median of itself, its
 * predecessor and the new key. This needs no branches, which would be unpredictable. */
static inline void insert_key(double *keys, size_t last, double key)
{
#ifdef OCTREE_SSE2
    const __m128d both = _mm_set1_pd(key);
    __m128d own = _mm_loadl_pd(both, &keys[last - 1]);
    for (size_t at = last - 1; at >= FEW_FIRST - 1; at -= 4) {
        const __m128d below = _mm_loadu_pd(&keys[at - 2]);
        _mm_storeu_pd(&keys[at], _mm_max_pd(_mm_shuffle_pd(below, own, 1), _mm_min_pd(own, both)));
        own = _mm_loadu_pd(&keys[at - 4]);
        _mm_storeu_pd(&keys[at - 2], _mm_max_pd(_mm_shuffle_pd(own, below, 1), _mm_min_pd(below, both)));
    }
#else
    double own = key;
    for (size_t at = last; at >= FEW_FIRST; at--) {
        const double before = keys[at - 1], less = own < key ? own : key;
        keys[at] = before > less ? before : less;
        own = before;
    }
#endif
}

/* Returns whether a point is nearer than the farthest of k neighbours, whose key is `farthest`. */
static inline bool is_nearer_than_farthest(neighbor_heap *h, const octree_point *point, double square, double farthest)
{
    return square < certainly_nearer_limit(farthest) ||
           is_nearer_than_slot(h, point, square, find_slot_of_key(farthest));
}

static inline bool is_rejected(const neighbor_heap *h, const octree_point *point, double square)
{
    return square > h->point_reach || (h->is_filtered && !is_accepted(h, point, square));
}

/* Store a point in a slot. Returns its key, in which a square that is too large or NaN becomes METRIC_FINITE. */
static inline double store_in_slot(few_neighbors *f, const octree_point *point, double square, unsigned place)
{
    f->points[place] = point;
    f->squares[place] = square;
    return make_slot_key(square < METRIC_FINITE ? square : METRIC_FINITE, place);
}

/* Store a point in a slot, and insert its key into the sorted keys. The key at index `last` is dropped. */
static inline void insert_neighbor(few_neighbors *f, const octree_point *point, double square, size_t last,
                                   unsigned place)
{
    insert_key(f->keys, last, store_in_slot(f, point, square, place));
}

/* Keep points until there are k neighbours. Returns the bit mask of the points that were not examined. */
static inline uint64_t fill_few_neighbors(neighbor_heap *h, const octree_point *points, const double squares[],
                                          uint64_t within)
{
    size_t count = h->count;
    for (; within && count < h->k; within &= within - 1) {
        const unsigned i = bits_lowest(within);
        if (!is_rejected(h, &points[i], squares[i])) {
            insert_neighbor(&h->few, &points[i], squares[i], FEW_FIRST + count, (unsigned)count);
            count++;
        }
    }
    h->count = count;
    h->few.free_slots = ~UINT64_C(0) << count;
    return within;
}

/* Move the last of `count` keys to its place. The other keys are in exact order. */
static void insert_last_key(neighbor_heap *h, double *keys, size_t count)
{
    size_t at = count - 1;
    const double key = keys[at];
    for (; at > 0 && !is_nearer_key(h, keys[at - 1], key); at--)
        keys[at] = keys[at - 1];
    keys[at] = key;
}

static void sort_keys(neighbor_heap *h, double *keys)
{
    for (size_t count = 2; count <= h->count; count++)
        insert_last_key(h, keys, count);
}

/* Keep a point in place of the farthest of k neighbours in exact order, if it is nearer. */
static void insert_in_exact_order(neighbor_heap *h, const octree_point *point, double square, size_t last)
{
    few_neighbors *f = &h->few;
    const unsigned place = find_slot_of_key(f->keys[last]);
    if (!is_nearer_than_slot(h, point, square, place))
        return;
    f->keys[last] = store_in_slot(f, point, square, place);
    f->integers_known &= ~(UINT64_C(1) << place);
    insert_last_key(h, f->keys + FEW_FIRST, h->k);
}

/* Drop undecided points that certainly are not among the k nearest. */
static void drop_certainly_farther(neighbor_heap *h)
{
    few_neighbors *f = &h->few;
    const double *keys = f->keys + FEW_FIRST;
    for (; h->count > h->k && keys[h->k - 1] < certainly_nearer_limit(keys[h->count - 1]); h->count--)
        f->free_slots |= UINT64_C(1) << find_slot_of_key(keys[h->count - 1]);
}

/* Keep a point without a decision whether it or another point of nearly the same distance is among the k nearest. */
static void insert_undecided(neighbor_heap *h, const octree_point *point, double square)
{
    few_neighbors *f = &h->few;
    const unsigned place = bits_lowest(f->free_slots);
    f->free_slots &= f->free_slots - 1;
    insert_neighbor(f, point, square, FEW_FIRST + h->count++, place);
    drop_certainly_farther(h);
}

/* Returns a limit: a point with a smaller square certainly takes the place of the k-th neighbour, whose key is
 * keys[last]. The limit is negative if this key is too close to others to decide which neighbour is the k-th. */
static inline double certain_limit(const neighbor_heap *h, size_t last)
{
    const double limit = certainly_nearer_limit(h->few.keys[last]);
    return h->few.keys[last - 1] >= limit || h->few.is_crowded ? -1 : limit;
}

/* Keep a point that may be among the k nearest, where keys cannot decide. */
static RARE void insert_near_tie(neighbor_heap *h, const octree_point *point, double square, size_t last)
{
    if (h->count == FEW_SLOTS && !h->few.is_crowded) {
        sort_keys(h, h->few.keys + FEW_FIRST);
        h->count = h->k;
        h->few.is_crowded = true;
    }
    if (h->few.is_crowded)
        insert_in_exact_order(h, point, square, last);
    else
        insert_undecided(h, point, square);
}

static void add_to_few_neighbors(neighbor_heap *h, const octree_point *points, const double squares[], uint64_t within)
{
    const size_t last = FEW_FIRST - 1 + h->k;
    double *keys = h->few.keys;
    if (h->count < h->k)
        within = fill_few_neighbors(h, points, squares, within);
    if (h->count < h->k)
        return;
    for (double certain = certain_limit(h, last); within; within &= within - 1) {
        const unsigned i = bits_lowest(within);
        const double square = squares[i];
        if (!(square < certain) && square > possibly_nearer_limit(keys[last]))
            continue;
        if (h->is_filtered && !is_accepted(h, &points[i], square))
            continue;
        if (square < certain)
            insert_neighbor(&h->few, &points[i], square, last, find_slot_of_key(keys[last]));
        else
            insert_near_tie(h, &points[i], square, last);
        certain = certain_limit(h, last);
    }
    h->worst = h->point_reach = possibly_nearer_limit(keys[last]);
}

/* Returns whether keys are so far apart that their order is certainly the exact order of their neighbours. */
static bool are_certainly_ascending(const double *keys, size_t count)
{
    bool ascend = true;
    for (size_t i = 1; i < count; i++)
        ascend &= keys[i - 1] < certainly_nearer_limit(keys[i]);
    return ascend;
}

/* Sort the neighbours exactly and store them in the caller's array. Returns true if the stored `distance` is the final
 * distance: the square roots are then accurate and ascend. Otherwise `distance` holds the square, and the function
 * returns false. */
static bool sort_few_neighbors(neighbor_heap *h)
{
    double *keys = h->few.keys + FEW_FIRST;
    drop_certainly_farther(h);
    const bool ascend = are_certainly_ascending(keys, h->count);
    if (!ascend)
        sort_keys(h, keys);
    h->count = h->count < h->k ? h->count : h->k;
    const bool plain =
        ascend && h->metric.scale == 1 && is_root_accurate(keys[0]) && is_root_accurate(keys[h->count - 1]);
    for (size_t i = 0; i < h->count; i++) {
        const unsigned place = find_slot_of_key(keys[i]);
        const double square = h->few.squares[place];
        h->items[i] = (octree_neighbor){*h->few.points[place], plain ? positive_root(square) : square};
    }
    return plain;
}

/* ---- One neighbour: the first slot, without a key ------------------------------------------------------------- */

static inline void keep_if_nearest(neighbor_heap *h, const octree_point *point, double square)
{
    few_neighbors *f = &h->few;
    if (is_rejected(h, point, square) ||
        (h->count > 0 && !is_nearer_than_farthest(h, point, square, make_slot_key(f->squares[0], 0))))
        return;
    f->points[0] = point;
    f->squares[0] = h->worst = square;
    f->integers_known = 0;
    h->count = 1;
    h->point_reach = find_point_reach(h, square);
}

/* ---- More than 32 neighbours: a binary heap ------------------------------------------------------------------- */

static inline int compare_items(const neighbor_heap *h, const octree_neighbor *p, const octree_neighbor *q)
{
    return compare_neighbors(h, &p->point, p->distance, &q->point, q->distance);
}

/* Replace the top of a heap of `count` items by `item`, and move the item down to its place. */
static void sink_in_heap(const neighbor_heap *h, const octree_neighbor *item, size_t count)
{
    octree_neighbor *items = h->items;
    size_t at = 0;
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && compare_items(h, &items[child], &items[child + 1]) < 0)
            child++;
        if (compare_items(h, item, &items[child]) >= 0)
            break;
        items[at] = items[child];
    }
    items[at] = *item;
}

/* Append an item to the heap at index `at`, and move it up to its place. */
static void rise_in_heap(const neighbor_heap *h, const octree_neighbor *item, size_t at)
{
    octree_neighbor *items = h->items;
    for (size_t parent; at > 0 && compare_items(h, &items[parent = (at - 1) / 2], item) < 0; at = parent)
        items[at] = items[parent];
    items[at] = *item;
}

static RARE void add_to_heap(neighbor_heap *h, const octree_point *points, const double squares[], uint64_t within)
{
    for (; within; within &= within - 1) {
        const unsigned i = bits_lowest(within);
        const octree_neighbor found = {points[i], squares[i]};
        if (is_rejected(h, &points[i], squares[i]))
            continue;
        if (h->count < h->k)
            rise_in_heap(h, &found, h->count++);
        else if (compare_items(h, &found, &h->items[0]) < 0)
            sink_in_heap(h, &found, h->count);
        h->worst = h->items[0].distance;
        if (h->count == h->k)
            h->point_reach = find_point_reach(h, h->worst);
    }
}

static void sort_heap(const neighbor_heap *h)
{
    for (size_t left = h->count; left-- > 1;) {
        const octree_neighbor last = h->items[left];
        h->items[left] = h->items[0];
        sink_in_heap(h, &last, left);
    }
}

/* ---- Any number of neighbours --------------------------------------------------------------------------------- */

void neighbor_heap_set_radius(neighbor_heap *h, double radius)
{
    const double scaled = radius * h->metric.scale;
    h->radius = radius;
    h->radius_square = scaled * scaled;
    h->is_filtered = true;
    h->point_reach = metric_above(h->radius_square);
    h->node_reach = limit_of_node_distance(h, h->radius_square);
}

void neighbor_heap_add(neighbor_heap *h, const octree_point *points, const double squares[], uint64_t within)
{
    if (h->k == 1)
        for (; within; within &= within - 1)
            keep_if_nearest(h, &points[bits_lowest(within)], squares[bits_lowest(within)]);
    else if (has_few_slots(h))
        add_to_few_neighbors(h, points, squares, within);
    else
        add_to_heap(h, points, squares, within);
    if (h->count >= h->k)
        h->node_reach = limit_of_node_distance(h, h->worst * h->shrink);
}

double greatest_group_minimum(const double squares[], unsigned count)
{
#ifdef OCTREE_SSE2
    __m128d least[NEIGHBOR_GROUPS / 2];
    for (unsigned k = 0; k < NEIGHBOR_GROUPS / 2; k++)
        least[k] = _mm_loadu_pd(&squares[2 * k]);
    for (unsigned i = NEIGHBOR_GROUPS; i + NEIGHBOR_GROUPS <= count; i += NEIGHBOR_GROUPS)
        for (unsigned k = 0; k < NEIGHBOR_GROUPS / 2; k++)
            least[k] = _mm_min_pd(least[k], _mm_loadu_pd(&squares[i + 2 * k]));
    for (unsigned k = 1; k < NEIGHBOR_GROUPS / 2; k++)
        least[0] = _mm_max_pd(least[0], least[k]);
    return _mm_cvtsd_f64(_mm_max_sd(_mm_unpackhi_pd(least[0], least[0]), least[0]));
#else
    double least[NEIGHBOR_GROUPS], bound = 0;
    memcpy(least, squares, sizeof least);
    for (unsigned i = NEIGHBOR_GROUPS; i + NEIGHBOR_GROUPS <= count; i += NEIGHBOR_GROUPS)
        for (unsigned k = 0; k < NEIGHBOR_GROUPS; k++)
            least[k] = squares[i + k] < least[k] ? squares[i + k] : least[k];
    for (unsigned k = 0; k < NEIGHBOR_GROUPS; k++)
        bound = least[k] > bound ? least[k] : bound;
    return bound;
#endif
}

/* Sort the neighbours again, by their distances. In FAST mode squares may underflow or round to the same double, so the
 * order of the squares may differ from the order of the distances. */
static RARE void sort_by_distance(neighbor_heap *h)
{
    for (size_t i = 0; i < h->count; i++) {
        const octree_neighbor item = h->items[i];
        rise_in_heap(h, &item, i);
    }
    sort_heap(h);
}

void neighbor_heap_sort(neighbor_heap *h)
{
    const bool is_fast = h->how->mode == OCTREE_FAST;
    bool ascend = true;
    double before = 0;
    if (h->count == 0)
        return;
    if (!has_few_slots(h))
        sort_heap(h);
    else if (sort_few_neighbors(h))
        return;
    for (size_t i = 0; i < h->count; i++) {
        const double distance = neighbor_distance(h, &h->items[i].point, h->items[i].distance);
        ascend &= distance >= before;
        /* In EXACT mode the order is exact. If rounding made a distance smaller than its predecessor, the distance is
         * raised to the predecessor. */
        before = is_fast ? distance : larger(distance, before);
        h->items[i].distance = before;
    }
    if (is_fast && !ascend)
        sort_by_distance(h);
}
