/* SPDX-License-Identifier: MIT */
/* judge.c - judges the answer of a foreign index by the exact answer.
 *
 * The problem: a plain comparison of two lists of ids would report right answers as wrong. An index may promise exact
 * answers, answers that are exact for positions rounded to floats, or answers within epsilon. If several neighbours are
 * at the same distance, any of them is right. Some indexes leave out the boundary of a region.
 *
 * The idea: make two lists of points, the foreign answer and the exact answer. The positions in both lists are exact
 * or rounded, as the index promises.
 *
 * For regions, the lists are compared as sets, sorted by id. A missing point is wrong. An extra point is wrong unless
 * it lies within epsilon of the region. The bounds of the query, open or closed, decide about points exactly on the
 * boundary. Exact arithmetic finds these points.
 *
 * For neighbours, the distances are compared rank by rank, so that ties need no rule. Distances in doubles decide if
 * they differ by more than their error; otherwise exact arithmetic decides. A kind of query may sort its neighbours by
 * another key than the distance, as a ray does, and have points that no answer contains (query_rules in kind.h).
 *
 * If the index promises answers for floats, the exact answer is made again, for rounded positions. Rounding moves a
 * point by at most a fixed fraction of the world's largest coordinate. The region is enlarged by this distance. All
 * points in the enlarged region are collected, and their rounded positions decide.
 *
 * Cost: a sort of both lists; for floats, also one or more searches.
 */
#include "judge.h"
#include "../ask/kind.h"
#include "../exact/exact.h"
#include "../query/search.h"

typedef struct judge_state {
    judge *judge;
    const judged_query *about;
    octree_judgement *made;
    octree_answer asked; /* the members of the query; they are rounded to floats if the foreign index promises floats */
    const query_rules *rules;
    bool rounds;
    list *collected; /* the list to which a search appends the points that the search finds */
    size_t boundary; /* the number of points on the region's boundary that a search found */
    bool failed;     /* true: the memory ran out */
} judge_state;

static bool is_neighbor_query(const judge_state *s)
{
    return octree_query_about(s->asked.kind)->neighbors;
}

/* ---- Positions ---------------------------------------------------------------------------------------------- */

/* Begin to judge a query. After this call, *s must not move in memory, because the judged points hold pointers to
 * s->asked. */
static void begin_judging(judge_state *s, judge *j, const judged_query *about, octree_judgement *made)
{
    *s = (judge_state){.judge = j, .about = about, .made = made, .asked = *about->answer};
    s->rounds = s->asked.precision == OCTREE_FLOATS;
    if (s->rounds)
        round_answer_to_floats(&s->asked);
    s->rules = query_rules_of(s->asked.kind);
    j->foreign.count = j->exact.count = 0;
}

static judged_point make_judged_point(const judge_state *s, const octree_point *point)
{
    judged_point p = {.point = *point, .asked = &s->asked};
    octree_bodies_at(s->about->points->bodies, point, &p.body);
    for (int i = 0; s->rounds && i < 3; i++)
        p.body.position[i] = round_to_float(point->position[i]);
    if (s->rules->measure)
        p.key = s->rules->measure(&s->asked, &p.body);
    return p;
}

static bool is_skipped(const judge_state *s, const judged_point *p)
{
    return (s->about->skip == OCTREE_SKIP_ID && p->point.id == s->about->skip_id) ||
           (s->about->skip == OCTREE_SKIP_COINCIDENT && is_same_position(p->body.position, s->asked.target));
}

static void append_judged_point(judge_state *s, list *l, const judged_point *p)
{
    s->failed |= !list_push(s->judge->memory, l, p, sizeof *p);
}

/* ---- Orders ------------------------------------------------------------------------------------------------- */

static int compare_ids(const void *a, const void *b)
{
    const judged_point *p = a, *q = b;
    return (p->point.id > q->point.id) - (p->point.id < q->point.id);
}

/* Returns whether a key is certainly greater than `factor` times another. The error of both keys is at most 4 ulp,
 * which for subnormal keys is 4 times 2^-1074. */
static bool is_certainly_greater(double key, double factor, double other)
{
    return key > factor * (1 + 0x1p-47) * other + 0x1p-1070;
}

/* Compare the exact keys of two points, such as their distances to the target. The keys in doubles decide if they
 * differ by more than their rounding error; else exact arithmetic decides. */
static int compare_keys(const judged_point *a, const judged_point *b)
{
    if (is_certainly_greater(a->key, 1, b->key))
        return 1;
    if (is_certainly_greater(b->key, 1, a->key))
        return -1;
    return query_rules_of(a->asked->kind)->order(a->asked, &a->body, &b->body);
}

static int compare_ranks(const void *a, const void *b)
{
    const int by_key = compare_keys(a, b);
    return by_key ? by_key : compare_ids(a, b);
}

/* ---- The foreign answer ------------------------------------------------------------------------------------- */

/* Record how the answer is wrong, unless a kind of error with a lower value is already recorded. `id` is the id that is
 * wrong, for the kinds of error that have one; the lowest id is kept. */
static void record_wrong_kind(judge_state *s, octree_wrong_kind wrong, uint64_t id)
{
    octree_judgement *made = s->made;
    if (made->wrong && (wrong > made->wrong || (wrong == made->wrong && id >= made->wrong_id)))
        return;
    made->wrong = wrong;
    made->wrong_id = wrong <= OCTREE_WRONG_SKIPPED ? id : 0;
}

/* Remove repeated points from the foreign answer, which is sorted by id. If a point was removed, record that the answer
 * has duplicates. */
static void remove_duplicates(judge_state *s, list *points)
{
    judged_point *items = points->items;
    size_t kept = 0;
    for (size_t i = 0; i < points->count; i++) {
        if (kept > 0 && items[i].point.id == items[kept - 1].point.id)
            record_wrong_kind(s, OCTREE_WRONG_DUPLICATE, items[i].point.id);
        else
            items[kept++] = items[i];
    }
    points->count = kept;
}

/* List the points of the foreign answer, sorted by id, without duplicates. Points that the query skips are left out. */
static void list_foreign_answer(judge_state *s)
{
    judge *j = s->judge;
    const octree_query *query = s->about->query;
    const audited_points *points = s->about->points;
    for (size_t i = 0; !s->failed && i < query->answer_count; i++) {
        octree_point point;
        s->failed |= !list_push(j->memory, &j->given, &query->answer[i], sizeof *query->answer);
        if (!points->find(points->context, query->answer[i], &point)) {
            record_wrong_kind(s, OCTREE_WRONG_UNKNOWN, query->answer[i]);
            continue;
        }
        judged_point p = make_judged_point(s, &point);
        if (is_skipped(s, &p))
            record_wrong_kind(s, OCTREE_WRONG_SKIPPED, point.id);
        else
            append_judged_point(s, &j->foreign, &p);
    }
    list_sort(&j->foreign, sizeof(judged_point), compare_ids);
    remove_duplicates(s, &j->foreign);
}

/* ---- The exact answer --------------------------------------------------------------------------------------- */

/* List the exact answer for positions that are not rounded. The tree has already given this answer to the game, so no
 * search is needed. */
static void list_exact_answer(judge_state *s)
{
    const judged_query *about = s->about;
    for (size_t i = 0; !s->failed && i < about->answer->count; i++) {
        judged_point p =
            make_judged_point(s, about->exact_points ? &about->exact_points[i] : &about->exact_neighbors[i].point);
        append_judged_point(s, &s->judge->exact, &p);
    }
}

/* Returns the largest distance, along one axis, by which rounding to floats moves a point of the world. */
static double largest_rounding_error(const octree *tree)
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = larger(largest, larger(fabs(tree->def.world.min[i]), fabs(tree->def.world.max[i])));
    return largest > FLT_MAX ? largest : largest * 0x1p-24 + 0x1p-149;
}

/* Collect a point if it is in the region. For a query for neighbours, collect every point that can be in an answer. */
static bool collect_judged_point(const octree_body *body, void *context)
{
    judge_state *s = context;
    const octree_point point = point_of_body(body);
    const judged_point p = make_judged_point(s, &point);
    const int outside = s->asked.bounds == OCTREE_BOUNDS_OPEN ? 0 : 1;
    if (!is_skipped(s, &p) &&
        (s->rules->compare ? s->rules->compare(&s->asked, &p.body, 0) < outside : p.key < HUGE_VAL))
        append_judged_point(s, s->collected, &p);
    return !s->failed;
}

/* Collect the points whose keys are at most `reach`, even after they are moved by `slack`. The region is valid, so only
 * a lack of memory can make the search fail. A failure sets s->failed. */
static void collect_candidates(judge_state *s, double reach, double slack)
{
    const octree_region region = s->rules->region(&s->asked, reach, slack);
    octree_bodies_search(s->about->points->bodies, &region, NULL, collect_judged_point, s);
}

/* Store the first k neighbours, by rounded positions, in the list `exact`. Search larger and larger regions, until the
 * k-th neighbour in the region comes before every point outside the region. The factor grows, because rounding may move
 * points off a ray: then no region has k of them, and the last one must come soon. */
static void collect_nearest(judge_state *s, double slack)
{
    const octree_answer *answer = s->about->answer;
    list *exact = &s->judge->exact;
    const size_t count = answer->count, k = answer->k;
    /* if there are fewer than k neighbours, all points are candidates */
    double reach = count < k ? DBL_MAX : k ? s->about->exact_neighbors[k - 1].distance + slack : 0;
    for (double factor = 2; !s->failed; reach *= factor, factor *= factor) {
        exact->count = 0;
        reach = reach < DBL_MAX ? reach : DBL_MAX;
        collect_candidates(s, reach, slack);
        list_sort(exact, sizeof(judged_point), compare_ranks);
        const judged_point *found = exact->items;
        if (k == 0 || reach == DBL_MAX || (exact->count >= k && !is_certainly_greater(found[k - 1].key, 1, reach)))
            break;
    }
    exact->count = exact->count < k ? exact->count : k;
}

/* Returns an upper bound of the distance by which rounding moves any point of the world: this distance is at most
 * sqrt(3) times the largest rounding error along one axis. Returns 0 if positions are not rounded. */
static double rounding_slack(const judge_state *s)
{
    return s->rounds ? 2 * largest_rounding_error(s->about->points->tree) : 0;
}

/* Visit all points that may lie in the region after the foreign index rounds their positions. The searched box is
 * valid, so the search cannot fail. */
static void visit_region_points(judge_state *s, octree_body_visitor visit)
{
    const octree_region box = {.kind = OCTREE_REGION_BOX, .box = s->rules->bound(&s->asked, rounding_slack(s))};
    octree_bodies_search(s->about->points->bodies, &box, NULL, visit, s);
}

/* List the exact answer for positions rounded to floats. */
static void list_rounded_exact_answer(judge_state *s)
{
    s->collected = &s->judge->exact;
    if (is_neighbor_query(s))
        collect_nearest(s, rounding_slack(s));
    else
        visit_region_points(s, collect_judged_point);
}

static void find_exact_answer(judge_state *s)
{
    if (s->rounds)
        list_rounded_exact_answer(s);
    else
        list_exact_answer(s);
    s->made->expected = s->judge->exact.count;
}

/* ---- Regions ------------------------------------------------------------------------------------------------ */

static void list_wrong_point(judge_state *s, const judged_point *p, size_t *count)
{
    s->failed |= !list_push(s->judge->memory, &s->judge->wrong, &p->point, sizeof p->point);
    ++*count;
}

/* Returns whether an answer is right both with and without a point. This is so on the boundary of a region with the
 * bounds EITHER and, if `slack` is above 0, within the distance `slack` of the region. */
static bool is_point_optional(const judge_state *s, const judged_point *p, double slack)
{
    return (slack > 0 && s->rules->compare(&s->asked, &p->body, slack) <= 0) ||
           (s->asked.bounds == OCTREE_BOUNDS_EITHER && is_on_boundary(&s->asked, &p->body));
}

/* An octree_body_visitor: count a point if it is on the boundary of the region. */
static bool count_boundary_point(const octree_body *body, void *context)
{
    judge_state *s = context;
    const octree_point point = point_of_body(body);
    const judged_point p = make_judged_point(s, &point);
    s->boundary += !is_skipped(s, &p) && is_on_boundary(&s->asked, &p.body);
    return true;
}

/* All wrong points lie on the boundary of the region: find the bounds with which the answer to the query would be
 * right. The bounds are EITHER if the answer contains only a part of the points on the boundary. */
static void find_accepting_bounds(judge_state *s)
{
    octree_judgement *made = s->made;
    const bool missing = made->on_boundary == OCTREE_WRONG_MISSING;
    s->boundary = 0;
    visit_region_points(s, count_boundary_point);
    made->accepting = (missing ? made->missing_count : made->extra_count) < s->boundary ? OCTREE_BOUNDS_EITHER
                      : missing                                                         ? OCTREE_BOUNDS_OPEN
                                                                                        : OCTREE_BOUNDS_CLOSED;
}

/* List as wrong the points of the list `from` that are not in the list `without`, except optional points. Both lists
 * are sorted by id. `wrong` is the kind of error: MISSING or EXTRA. *count is increased by the number of listed
 * points. */
static void list_difference_as_wrong(judge_state *s, octree_wrong_kind wrong, const list *from, const list *without,
                                     double slack, size_t *count)
{
    const judged_point *items = from->items, *others = without->items;
    bool on_boundary = true;
    for (size_t i = 0, j = 0; !s->failed && i < from->count; i++) {
        while (j < without->count && compare_ids(&others[j], &items[i]) < 0)
            j++;
        const bool lacks = j == without->count || compare_ids(&others[j], &items[i]) > 0;
        if (!lacks || is_point_optional(s, &items[i], slack))
            continue;
        list_wrong_point(s, &items[i], count);
        on_boundary = on_boundary && is_on_boundary(&s->asked, &items[i].body);
    }
    if (*count > 0)
        record_wrong_kind(s, wrong, 0);
    if (*count > 0 && on_boundary)
        s->made->on_boundary = wrong;
}

static void judge_region(judge_state *s)
{
    judge *j = s->judge;
    list_sort(&j->exact, sizeof(judged_point), compare_ids);
    list_difference_as_wrong(s, OCTREE_WRONG_MISSING, &j->exact, &j->foreign, 0, &s->made->missing_count);
    list_difference_as_wrong(s, OCTREE_WRONG_EXTRA, &j->foreign, &j->exact, s->asked.epsilon, &s->made->extra_count);
}

/* ---- Neighbours --------------------------------------------------------------------------------------------- */

/* Returns whether point `a` is too far from the target for its rank in the answer. Point `b` is the exact neighbour of
 * this rank and is nearer than `a`. Point `a` may be farther than `b` only by the factor 1 + epsilon. */
static bool is_too_far(const judge_state *s, const judged_point *a, const judged_point *b)
{
    return !(s->asked.epsilon > 0) || b->key == 0 || is_certainly_greater(a->key, 1 + s->asked.epsilon, b->key);
}

static void judge_ranks(judge_state *s, const judged_point *foreign, const judged_point *exact, size_t count)
{
    octree_judgement *made = s->made;
    made->ratio = count == 0 && made->expected > 0 ? INFINITY : 1;
    for (size_t i = 0; i < count; i++) {
        if (compare_keys(&foreign[i], &exact[i]) <= 0)
            continue;
        const double ratio = foreign[i].key / exact[i].key;
        made->ratio = ratio > made->ratio ? ratio : made->ratio;
        if (made->rank == 0 && is_too_far(s, &foreign[i], &exact[i]))
            made->rank = i + 1;
    }
    if (made->rank)
        record_wrong_kind(s, OCTREE_WRONG_FARTHER, 0);
}

/* List the missing and the extra points of a wrong answer for neighbours. A right answer contains all points that are
 * nearer than the last exact neighbour, and no point that is farther. The other points of a right answer are as far as
 * the last exact neighbour. */
static void list_wrong_neighbors(judge_state *s)
{
    const judge *j = s->judge;
    octree_judgement *made = s->made;
    const judged_point *exact = j->exact.items, *foreign = j->foreign.items;
    const judged_point *last = j->exact.count ? &exact[j->exact.count - 1] : NULL;
    size_t in_reach = 0;
    while (last && in_reach < j->foreign.count && compare_keys(&foreign[in_reach], last) <= 0)
        in_reach++;
    for (size_t i = 0, n = 0; !s->failed && i < j->exact.count; i++) {
        while (n < in_reach && compare_ranks(&foreign[n], &exact[i]) < 0)
            n++;
        const bool lacks = n == in_reach || foreign[n].point.id != exact[i].point.id;
        const bool needed = compare_keys(&exact[i], last) < 0 || made->missing_count + in_reach < j->exact.count;
        if (lacks && needed)
            list_wrong_point(s, &exact[i], &made->missing_count);
    }
    for (size_t i = in_reach; !s->failed && i < j->foreign.count; i++)
        if (!last || is_too_far(s, &foreign[i], last))
            list_wrong_point(s, &foreign[i], &made->extra_count);
}

/* Returns the number of points of the sorted foreign answer that no right answer contains, such as the points that a
 * ray misses. They are the last points. */
static size_t count_impossible_neighbors(const judge_state *s)
{
    const judged_point *foreign = s->judge->foreign.items;
    const size_t count = s->judge->foreign.count;
    size_t possible = count;
    while (possible > 0 && foreign[possible - 1].key == HUGE_VAL)
        possible--;
    return count - possible;
}

static void judge_neighbors(judge_state *s, size_t given)
{
    judge *j = s->judge;
    list_sort(&j->foreign, sizeof(judged_point), compare_ranks);
    const size_t impossible = count_impossible_neighbors(s), foreign = j->foreign.count - impossible;
    const size_t exact = j->exact.count, ranks = foreign < exact ? foreign : exact;
    judge_ranks(s, j->foreign.items, j->exact.items, ranks);
    if (given != exact && given - impossible != exact)
        record_wrong_kind(s, OCTREE_WRONG_COUNT, 0);
    if (impossible)
        record_wrong_kind(s, OCTREE_WRONG_EXTRA, 0);
    if ((foreign != exact || impossible) && s->made->rank == 0)
        s->made->rank = ranks + 1;
    if (s->made->wrong)
        list_wrong_neighbors(s);
}

/* ---- An answer ---------------------------------------------------------------------------------------------- */

/* Compare the list of the foreign answer with the list of the exact answer. Do nothing if memory ran out, because a
 * list may then be incomplete. `given` is the number of ids in the foreign answer. */
static void compare_foreign_with_exact(judge_state *s, size_t given)
{
    if (!s->failed && is_neighbor_query(s))
        judge_neighbors(s, given);
    else if (!s->failed)
        judge_region(s);
}

bool judge_answer(judge *j, const judged_query *about, octree_judgement *made)
{
    judge_state s;
    *made = (octree_judgement){.judged = true, .given_count = about->query->answer_count};
    begin_judging(&s, j, about, made);
    list_foreign_answer(&s);
    find_exact_answer(&s);
    compare_foreign_with_exact(&s, about->query->answer_count);
    if (!s.failed && made->on_boundary)
        find_accepting_bounds(&s);
    return !s.failed;
}

/* ---- An answer without some points -------------------------------------------------------------------------- */

static void remove_lost_points(list *l, point_test *is_lost, void *context)
{
    judged_point *items = l->items;
    size_t kept = 0;
    for (size_t i = 0; i < l->count; i++)
        if (!is_lost(&items[i].point, context))
            items[kept++] = items[i];
    l->count = kept;
}

/* Replace the foreign answer by all points that a right answer may contain: the points that are at most 1 + epsilon
 * times as far as the last exact neighbour. */
static void list_possible_neighbors(judge_state *s)
{
    const list *exact = &s->judge->exact;
    const judged_point *last = (const judged_point *)exact->items + exact->count - 1;
    const double factor = (1 + s->asked.epsilon) * (1 + 0x1p-40);
    s->collected = &s->judge->foreign;
    s->collected->count = 0;
    collect_candidates(s, last->key < DBL_MAX / factor ? last->key * factor : DBL_MAX,
                       s->rounds ? rounding_slack(s) : 0x1p-1000);
}

/* Replace the foreign answer by the best answer that contains no lost points. For neighbours this is the nearest
 * other points; for a region it is all other points in the region. */
static void list_best_answer(judge_state *s, point_test *is_lost, void *context)
{
    list *foreign = &s->judge->foreign;
    const list *exact = &s->judge->exact;
    if (!is_neighbor_query(s)) {
        list_sort(foreign, sizeof(judged_point), compare_ids);
        return;
    }
    list_possible_neighbors(s);
    remove_lost_points(foreign, is_lost, context);
    list_sort(foreign, sizeof(judged_point), compare_ranks);
    foreign->count = foreign->count < exact->count ? foreign->count : exact->count;
}

bool judge_without_lost_points(judge *j, const judged_query *about, point_test *is_lost, point_visit *report,
                               void *context)
{
    octree_judgement made = {.judged = true};
    judge_state s;
    const size_t listed = j->wrong.count;
    begin_judging(&s, j, about, &made);
    find_exact_answer(&s);
    for (size_t i = 0; i < j->exact.count; i++)
        append_judged_point(&s, &j->foreign, (const judged_point *)j->exact.items + i);
    remove_lost_points(&j->foreign, is_lost, context);
    if (s.failed || j->foreign.count == j->exact.count)
        return !s.failed;
    list_best_answer(&s, is_lost, context);
    compare_foreign_with_exact(&s, j->foreign.count);
    /* only lost points can be missing here, because the best answer contains all other points that a right answer
     * needs */
    const octree_point *missed = j->wrong.items;
    for (size_t i = 0; !s.failed && made.wrong && i < made.missing_count; i++)
        s.failed = !report(&missed[listed + i], context);
    j->wrong.count = listed;
    return !s.failed;
}

/* ---- Lists -------------------------------------------------------------------------------------------------- */

void judge_assign_lists(const judge *j, octree_answer *answers, size_t count)
{
    const uint64_t *given = j->given.items;
    const octree_point *wrong = j->wrong.items;
    size_t ids = 0, points = 0; /* the number of ids, and the number of points, in the answers before this one */
    for (size_t i = 0; i < count; i++) {
        octree_judgement *made = &answers[i].judgement;
        made->given = made->given_count ? given + ids : NULL;
        made->missing = made->missing_count ? wrong + points : NULL;
        made->extra = made->extra_count ? wrong + points + made->missing_count : NULL;
        ids += made->given_count;
        points += made->missing_count + made->extra_count;
    }
}

void judge_release(judge *j)
{
    list_release(j->memory, &j->given, sizeof(uint64_t));
    list_release(j->memory, &j->wrong, sizeof(octree_point));
    list_release(j->memory, &j->foreign, sizeof(judged_point));
    list_release(j->memory, &j->exact, sizeof(judged_point));
}
