/* SPDX-License-Identifier: MIT */
/* in_order.c - searches that return the first k bodies in an order: octree_bodies_nearest() and octree_bodies_cast().
 *
 * Both searches are one algorithm (branch and bound, Roussopoulos et al. 1995). Each body has a key: the squared
 * distance of its box, or the time at which a ray enters it. The key of the box of a node (boxes.c, cell.c) is a lower
 * bound of the keys of its bodies. A descent visits the children of a node in the order
 * of these bounds, and skips a node if its bound is above the k-th best key so far. The k best bodies are a heap with
 * the worst on top.
 *
 * Keys are doubles with an error bound. A node is skipped only if the bound says so in spite of the errors. Two bodies
 * are compared exactly if their keys are within their errors.
 */
#include "shape.h"
#include "visit.h"

/* A key: the real value is within `error` of `value`; equal to it if `error` is 0. */
typedef struct key {
    double value, error;
} key;

/* The keys of as many hits are kept, those at the top of the heap. Others are measured when they are needed. */
enum { KEPT_KEYS = 32 };

typedef struct ordered_search ordered_search;

/* What the search for neighbours and the cast do differently. */
typedef struct search_kind {
    void (*prepare)(ordered_search *s); /* Prepare the bounds for s->level. */
    /* Compute the key of a body. Returns false if the body does not count. */
    bool (*measure)(const ordered_search *s, const octree_body *body, key *k);
    /* Returns the sign of the key of `a` minus that of `b`, in real numbers. */
    int (*compare)(const ordered_search *s, const octree_body *a, const octree_body *b);
    double (*finish)(const ordered_search *s, const octree_body *body); /* Returns octree_hit.at. */
} search_kind;

struct ordered_search {
    const search_kind *kind;
    const octree_bodies *set;
    const double *target; /* nearest: the target; null for casts */
    double radius;        /* HUGE_VAL: there is none, as in a cast */
    double scale;
    cast cast;
    query_bounds bounds; /* for the bodies of the current level */
    /* compute lower bounds of the keys of bodies, and of the bodies in boxes */
    uint64_t (*bound_bodies)(const query_bounds *b, const octree_point *points, unsigned count, double cut,
                             double *bounds);
    unsigned (*bound_boxes)(const query_bounds *b, const sibling_boxes *boxes, double cut, double bounds[8]);
    octree_body_visitor accept;
    void *context;
    octree_hit *hits; /* a heap; hits[0] has the greatest key */
    key *keys;        /* of the first KEPT_KEYS hits */
    size_t count, k;
    double limit;    /* no body whose key is certainly greater than this is among the first k */
    double farthest; /* the greatest bound of a node that may have bodies within the radius */
    double shrink;   /* below 1 if the answer may be approximate */
    double cut;      /* nodes and bodies whose bound exceeds this are skipped: min(limit * shrink, farthest, DBL_MAX) */
    const level *level;
    meter meter;
};

/* ---- Keys --------------------------------------------------------------------------------------------------- */

static void prepare_distances(ordered_search *s)
{
    prepare_squares(&s->bounds, s->level, s->target);
    s->bound_bodies = s->bounds.in_lanes->squares;
    s->bound_boxes = s->bounds.in_lanes->squares_of_boxes;
}

static bool measure_distance(const ordered_search *s, const octree_body *body, key *k)
{
    const body_square square = body_measure(body, s->target, s->scale);
    *k = (key){square.value, square.error};
    return true;
}

static int compare_distances(const ordered_search *s, const octree_body *a, const octree_body *b)
{
    return body_compare_distances(a, b, s->target);
}

static double finish_distance(const ordered_search *s, const octree_body *body)
{
    return body_distance(body, s->target);
}

static const search_kind by_distance = {
    .prepare = prepare_distances,
    .measure = measure_distance,
    .compare = compare_distances,
    .finish = finish_distance,
};

static void prepare_first_times(ordered_search *s)
{
    prepare_times(&s->bounds, s->level, &s->cast);
    s->bound_bodies = s->bounds.in_lanes->times;
    s->bound_boxes = s->bounds.in_lanes->times_of_boxes;
}

static bool measure_time(const ordered_search *s, const octree_body *body, key *k)
{
    cast_time first;
    const bool touches = cast_touches(&s->cast, body, &first);
    *k = (key){first.value, first.error};
    return touches;
}

static int compare_first_times(const ordered_search *s, const octree_body *a, const octree_body *b)
{
    return cast_compare(&s->cast, a, b);
}

static double finish_time(const ordered_search *s, const octree_body *body)
{
    return cast_first_time(&s->cast, body);
}

static const search_kind by_time = {
    .prepare = prepare_first_times,
    .measure = measure_time,
    .compare = compare_first_times,
    .finish = finish_time,
};

/* ---- The heap of the best bodies ---------------------------------------------------------------------------- */

static key key_of_hit(const ordered_search *s, size_t at)
{
    key k;
    if (at < KEPT_KEYS)
        return s->keys[at];
    s->kind->measure(s, &s->hits[at].body, &k);
    return k;
}

static void set_key(ordered_search *s, size_t at, key k)
{
    if (at < KEPT_KEYS)
        s->keys[at] = k;
}

/* Compare two bodies by key, then by id, position and half extents. NaN and infinite errors decide nothing. */
static int compare_by_key(const ordered_search *s, const octree_body *a, key x, const octree_body *b, key y)
{
    if (fabs(x.value - y.value) > x.error + y.error)
        return x.value < y.value ? -1 : 1;
    const int order = x.error + y.error == 0 ? 0 : s->kind->compare(s, a, b);
    return order ? order : octree_compare_bodies(a, b);
}

static void put_hit(ordered_search *s, size_t at, const octree_body *body, key k)
{
    s->hits[at].body = *body;
    set_key(s, at, k);
}

static void copy_hit(ordered_search *s, size_t to, size_t from)
{
    put_hit(s, to, &s->hits[from].body, key_of_hit(s, from));
}

/* Compare a body with a hit. */
static int compare_with_hit(const ordered_search *s, const octree_body *body, key k, size_t at)
{
    return compare_by_key(s, body, k, &s->hits[at].body, key_of_hit(s, at));
}

/* Put a body at the free end of the heap, or at its top of `count` hits; hits that are in the way move by one level. */
static void sift_up(ordered_search *s, size_t at, const octree_body *body, key k)
{
    for (; at > 0 && compare_with_hit(s, body, k, (at - 1) / 2) > 0; at = (at - 1) / 2)
        copy_hit(s, at, (at - 1) / 2);
    put_hit(s, at, body, k);
}

static void sift_down(ordered_search *s, size_t count, const octree_body *body, key k)
{
    size_t at = 0;
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && compare_with_hit(s, &s->hits[child].body, key_of_hit(s, child), child + 1) < 0)
            child++;
        if (compare_with_hit(s, body, k, child) >= 0)
            break;
        copy_hit(s, at, child);
    }
    put_hit(s, at, body, k);
}

static void set_limit(ordered_search *s, double limit)
{
    s->limit = limit;
    s->cut = fmin(fmin(limit * s->shrink, s->farthest), DBL_MAX);
}

static void update_limit(ordered_search *s)
{
    const key worst = key_of_hit(s, 0);
    const double limit = worst.value + worst.error;
    set_limit(s, limit == limit ? limit : HUGE_VAL);
}

/* Add a body that counts and whose key may be among the first k. */
static void offer_body(ordered_search *s, const octree_body *body, key k)
{
    if (s->count == s->k && compare_with_hit(s, body, k, 0) >= 0)
        return;
    if (s->accept && !s->accept(body, s->context))
        return;
    if (s->count < s->k)
        sift_up(s, s->count++, body, k);
    else
        sift_down(s, s->count, body, k);
    if (s->count == s->k)
        update_limit(s);
}

/* Sort the heap: the worst of the remaining bodies moves to the end. */
static void sort_hits(ordered_search *s)
{
    for (size_t last = s->count; last-- > 1;) {
        const octree_body body = s->hits[last].body;
        const key k = key_of_hit(s, last);
        copy_hit(s, last, 0);
        sift_down(s, last, &body, k);
    }
    for (size_t i = 0; i < s->count; i++)
        s->hits[i].at = s->kind->finish(s, &s->hits[i].body);
}

/* ---- The descent -------------------------------------------------------------------------------------------- */

static bool is_within_radius(const ordered_search *s, const octree_body *body)
{
    return s->radius > DBL_MAX || body_meets_ball(body, s->target, s->radius);
}

/* Returns whether the k best bodies all have the key 0, the least possible, and lower ids than this one. Crowds of
 * bodies that contain the target are common. */
static bool comes_after_all(const ordered_search *s, const octree_body *body)
{
    return s->limit == 0 && body->id > s->hits[0].body.id;
}

static void measure_and_offer(ordered_search *s, const octree_point *point)
{
    octree_body scratch;
    key k;
    const octree_body *body = load_body(s->set, point, &scratch);
    if (comes_after_all(s, body))
        return;
    if (s->kind->measure(s, body, &k) && !(k.value - k.error > s->limit) && is_within_radius(s, body) &&
        !is_skipped(s->meter.how, body, s->target))
        offer_body(s, body, k);
}

/* Returns the index of the least bound, of those in a mask. */
static inline unsigned find_nearest(const double *bounds, uint64_t some)
{
    unsigned nearest = bits_lowest(some);
    for (some &= some - 1; some; some &= some - 1) {
        const unsigned i = bits_lowest(some);
        nearest = bounds[i] < bounds[nearest] ? i : nearest;
    }
    return nearest;
}

/* Offer the bodies of at most SCAN_POINTS points. The body with the least bound comes first: its key is a limit for the
 * others. */
static void scan_points(ordered_search *s, const octree_point *points, unsigned count)
{
    double bounds[SCAN_POINTS];
    uint64_t near = s->bound_bodies(&s->bounds, points, count, s->cut, bounds);
    if (near == 0)
        return;
    prefetch_bodies(s->set, points, near);
    const unsigned first = find_nearest(bounds, near);
    measure_and_offer(s, &points[first]);
    for (near &= ~(UINT64_C(1) << first); near; near &= near - 1)
        if (bounds[bits_lowest(near)] <= s->cut)
            measure_and_offer(s, &points[bits_lowest(near)]);
}

static void scan_leaf(ordered_search *s, const node *leaf)
{
    s->meter.count.leaves++;
    s->meter.count.points += leaf->count;
    for (uint32_t start = 0; start < leaf->count; start += SCAN_POINTS)
        scan_points(s, leaf_points(leaf) + start, count_scanned(leaf, start));
}

/* Search a node. `c` is the cell of an inner node if nodes have no boxes, else null. Mostly few children remain after
 * the nearest one is searched, so they are not sorted. */
static void descend(ordered_search *s, const node *n, octree_address address, const divided_cell *c)
{
    double bounds[8];
    octree_box made[8];
    divided_cell below;
    meter_record_visited(&s->meter, address);
    if (n->octants == 0) {
        scan_leaf(s, n);
        return;
    }
    const sibling_boxes boxes = boxes_of_children(n, c, made);
    unsigned left = s->bound_boxes(&s->bounds, &boxes, s->cut, bounds);
    meter_record_pruned_siblings(&s->meter, address, n, mask_of_siblings(&boxes) & ~left);
    prefetch_children(n, left);
    while (left) {
        const unsigned nearest = find_nearest(bounds, left);
        if (bounds[nearest] > s->cut)
            break;
        descend(s, &children_of(n)[nearest], address_of_sibling(&s->meter, address, n, nearest),
                cell_of_child(s->level, n, c, nearest, &below));
        left &= ~(1u << nearest);
    }
    meter_record_pruned_siblings(&s->meter, address, n, left);
}

static void search_level(ordered_search *s, const level *l)
{
    divided_cell root;
    s->level = l;
    s->kind->prepare(s);
    descend(s, &l->tree->root, OCTREE_ROOT, cell_of_root(l, &root));
}

static void search_in_order(ordered_search *s, size_t *count)
{
    key keys[KEPT_KEYS];
    const unsigned begun = begin_set_callbacks(s->set);
    s->keys = keys;
    set_limit(s, HUGE_VAL);
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS && s->k > 0; i++)
        if (count_in_level(&s->set->levels[i]) > 0)
            search_level(s, &s->set->levels[i]);
    end_callbacks(begun);
    sort_hits(s);
    *count = s->count;
    meter_add_to_cost(&s->meter);
}

/* ---- Public functions --------------------------------------------------------------------------------------- */

/* Check the arguments that octree_bodies_nearest() and octree_bodies_cast() have in common. */
static octree_status check_ordered_search(const octree_bodies *set, const octree_search *how, size_t k,
                                          const octree_hit *hits)
{
    if (!set || (k > 0 && !hits))
        return OCTREE_NULL_ARGUMENT;
    return check_search_options(how);
}

octree_status octree_bodies_nearest(const octree_bodies *bodies, const double target[3], size_t k, double radius,
                                    const octree_search *how, octree_body_visitor accept, void *context,
                                    octree_hit *hits, size_t *count)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_nearest, bodies, target, k, radius, CALLER_SEARCH(how),
                           CALLER_BODY_VISITOR(accept, context), hits, count);
    if (!target || !count)
        return OCTREE_NULL_ARGUMENT;
    *count = 0;
    const octree_search search = search_or_default(how);
    octree_status status = check_ordered_search(bodies, &search, k, hits);
    if (status == OCTREE_OK)
        status = check_finite_position(target);
    if (status == OCTREE_OK)
        status = radius == HUGE_VAL ? OCTREE_OK : check_length(radius);
    if (status != OCTREE_OK)
        return status;
    ordered_search s = {.kind = &by_distance,
                        .set = bodies,
                        .target = target,
                        .radius = radius,
                        .accept = accept,
                        .context = context,
                        .hits = hits,
                        .k = k,
                        .meter.how = &search};
    s.scale = anchor_of(bodies)->scale;
    s.farthest = metric_above(radius * s.scale * (radius * s.scale));
    const double factor = 1 + search.epsilon;
    s.shrink = search.epsilon > 0 ? (1 + 0x1p-50) / (factor * factor) : 1;
    search_in_order(&s, count);
    return OCTREE_OK;
}

octree_status octree_bodies_cast(const octree_bodies *bodies, const octree_region *ray, size_t k,
                                 const octree_search *how, octree_body_visitor accept, void *context, octree_hit *hits,
                                 size_t *count)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_cast, bodies, ray, k, CALLER_SEARCH(how),
                           CALLER_BODY_VISITOR(accept, context), hits, count);
    if (!count)
        return OCTREE_NULL_ARGUMENT;
    *count = 0;
    const octree_search search = search_or_default(how);
    octree_status status = check_ordered_search(bodies, &search, k, hits);
    if (status == OCTREE_OK)
        status = octree_region_check(ray);
    if (status == OCTREE_OK && ray->kind != OCTREE_REGION_RAY && ray->kind != OCTREE_REGION_SWEPT)
        status = OCTREE_BAD_OPTION;
    if (status != OCTREE_OK)
        return status;
    ordered_search s = {.kind = &by_time,
                        .set = bodies,
                        .accept = accept,
                        .context = context,
                        .hits = hits,
                        .k = k,
                        .radius = HUGE_VAL,
                        .farthest = HUGE_VAL,
                        .shrink = 1,
                        .meter.how = &search};
    s.cast = make_cast_of_region(ray);
    search_in_order(&s, count);
    return OCTREE_OK;
}
