/* SPDX-License-Identifier: MIT */
/* judge_pairs.c - judges the pairs of overlapping bodies that a foreign index found.
 *
 * The problem: a broad phase reports pairs in any order, and the two ids of a pair in any order. Both lists are sets of
 * unordered pairs, and may have millions of elements.
 *
 * The idea: order the ids in each foreign pair, sort the pairs, and merge them with the exact pairs. A pair that only
 * the exact list has is missing. A pair that only the foreign list has is extra, unless one of its ids is unknown.
 * Equal foreign pairs are neighbours after the sort.
 *
 * A pair either is in the exact list or not: unlike the distances of neighbours, overlaps have no ties. Boxes are
 * closed, so an index that does not report boxes that only touch has missing pairs.
 *
 * Cost: a sort of the foreign pairs, one pass over both lists, and two lookups of ids for each pair that is not in the
 * exact list.
 */
#include "judge_pairs.h"

int compare_pairs(const void *a, const void *b)
{
    const octree_pair *p = a, *q = b;
    return p->a != q->a ? (p->a > q->a) - (p->a < q->a) : (p->b > q->b) - (p->b < q->b);
}

/* Copy the foreign pairs with their ids in order, and sort the copy. Returns false if memory runs out. */
static bool sort_given_pairs(const pair_lists *lists, const octree_foreign_pairs *given)
{
    for (size_t i = 0; i < given->pair_count; i++) {
        const octree_pair *p = &given->pairs[i];
        const octree_pair pair = p->a < p->b ? *p : (octree_pair){p->b, p->a};
        if (!list_push(lists->memory, lists->given, &pair, sizeof pair))
            return false;
    }
    list_sort(lists->given, sizeof(octree_pair), compare_pairs);
    return true;
}

/* Record how the pairs are wrong, unless an error that comes first is already recorded. */
static void record_wrong_pair(octree_pair_judgement *made, octree_wrong_kind wrong, octree_pair pair)
{
    const bool is_first = !made->wrong || wrong < made->wrong;
    if (is_first || (wrong == made->wrong && compare_pairs(&pair, &made->wrong_pair) < 0)) {
        made->wrong = wrong;
        made->wrong_pair = pair;
    }
}

static bool is_body(const audited_points *points, uint64_t id)
{
    octree_point point;
    return (!points->own_id || id != *points->own_id) && points->find(points->context, id, &point);
}

/* Record a foreign pair that is not in the exact list. Returns false if memory runs out. */
static bool record_extra_pair(const pair_lists *lists, const audited_points *points, octree_pair pair,
                              octree_pair_judgement *made)
{
    if (!is_body(points, pair.a))
        record_wrong_pair(made, OCTREE_WRONG_UNKNOWN, pair);
    else if (!is_body(points, pair.b))
        record_wrong_pair(made, OCTREE_WRONG_UNKNOWN, (octree_pair){pair.b, pair.a});
    else
        return list_push(lists->memory, lists->extra, &pair, sizeof pair);
    return true;
}

/* Merge the foreign pairs with the exact pairs. Returns false if memory runs out. */
static bool merge_pairs(const pair_lists *lists, const audited_points *points, const list *exact,
                        octree_pair_judgement *made)
{
    const octree_pair *given = lists->given->items, *expected = exact->items;
    const size_t count = lists->given->count;
    bool ok = true;
    for (size_t i = 0, j = 0; ok && (i < count || j < exact->count);) {
        const int order = i == count ? 1 : j == exact->count ? -1 : compare_pairs(&given[i], &expected[j]);
        if (order > 0) {
            ok = list_push(lists->memory, lists->missing, &expected[j++], sizeof *expected);
            continue;
        }
        if (order < 0)
            ok = record_extra_pair(lists, points, given[i], made);
        for (j += order == 0; ++i < count && compare_pairs(&given[i - 1], &given[i]) == 0;)
            record_wrong_pair(made, OCTREE_WRONG_DUPLICATE, given[i]);
    }
    return ok;
}

bool judge_pairs(const pair_lists *lists, const audited_points *points, const octree_foreign_pairs *given,
                 const list *exact, octree_pair_judgement *made)
{
    static const octree_pair none = {0, 0};
    *made = (octree_pair_judgement){.judged = true, .expected = exact->count};
    if (!sort_given_pairs(lists, given) || !merge_pairs(lists, points, exact, made))
        return false;
    made->given = lists->given->items;
    made->given_count = lists->given->count;
    made->missing = lists->missing->items;
    made->missing_count = lists->missing->count;
    made->extra = lists->extra->items;
    made->extra_count = lists->extra->count;
    if (made->missing_count)
        record_wrong_pair(made, OCTREE_WRONG_MISSING, none);
    if (made->extra_count)
        record_wrong_pair(made, OCTREE_WRONG_EXTRA, none);
    return true;
}
