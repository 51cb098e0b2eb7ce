/* SPDX-License-Identifier: MIT */
/* wrong_nodes.c - finds foreign nodes that are provably wrong, either in themselves or because a query visited or
 * pruned them wrongly.
 *
 * The problem: indexes differ. An index may store its points anywhere: in leaves, in inner nodes, or in several nodes
 * at once. The nodes of an index may list their points or not, their boxes may overlap, and answers may be approximate.
 * A rule of one index does not hold for another, so this file reports only nodes that are wrong in every index.
 *
 * The idea: decide which nodes hold a point. A node holds the points that it lists. A leaf that lists nothing holds
 * all points in its box. A point that no node holds is lost. A body with extent is in the box of a node if it meets the
 * box, because an index may list a body in every node that the body meets.
 *
 * A query that prunes nodes may lose points. A node that holds a point is excluded if, on the way from this node up to
 * the root, the first node that the query named was pruned. If all nodes that hold the point are excluded, the query
 * loses the point. The prune is wrong only if even the best answer without the lost points is wrong
 * (judge_without_lost_points()). So a prune that does no harm to the answer is never reported.
 *
 * Cost: a sort of the listed ids, and one judgement for each query that pruned nodes.
 */
#include "foreign.h"
#include "octree/octree.h"
#include "../exact/body.h"
#include "../exact/point.h"

#include <stdlib.h>

const char *octree_precision_name(octree_precision precision)
{
    static const char *const names[OCTREE_PRECISIONS] = {"double", "float"};
    return (unsigned)precision < OCTREE_PRECISIONS ? names[precision] : NULL;
}

static const struct {
    const char *name, *words;
} wrong_node_rows[OCTREE_WRONG_NODE_KINDS] = {
    [OCTREE_NODE_OUTSIDE_PARENT] = {"outside_parent", "its box extends outside its parent's box"},
    [OCTREE_NODE_UNKNOWN_POINT] = {"unknown_point", "it lists a point that does not exist"},
    [OCTREE_NODE_OUTSIDE_POINT] = {"outside_point", "it lists a point outside its box"},
    [OCTREE_NODE_REPEATED_POINT] = {"repeated_point", "it lists a point more than once"},
    [OCTREE_NODE_LOST_POINT] = {"lost_point", "a point is in no node"},
    [OCTREE_NODE_UNKNOWN_NODE] = {"unknown_node", "a query names it, but no node has this id"},
    [OCTREE_NODE_PRUNED_POINT] = {"pruned_point", "a query pruned it, so the answer lacks a point in it"},
};

const char *octree_wrong_node_name(octree_wrong_node_kind kind)
{
    return (unsigned)kind < OCTREE_WRONG_NODE_KINDS ? wrong_node_rows[kind].name : NULL;
}

const char *octree_wrong_node_words(octree_wrong_node_kind kind)
{
    return (unsigned)kind < OCTREE_WRONG_NODE_KINDS ? wrong_node_rows[kind].words : NULL;
}

static octree_foreign_place *foreign_places(const foreign *f)
{
    return f->places.items;
}

/* Count a wrong node. While the list has room, also add the node to the list. `place` is the index of the node, or
 * SIZE_MAX if the error concerns no existing node. Returns false if memory runs out. */
static bool report_wrong_node(foreign *f, size_t place, octree_wrong_node wrong)
{
    f->state.wrong[wrong.kind]++;
    if (place != SIZE_MAX) {
        wrong.node = foreign_places(f)[place].node->id;
        foreign_places(f)[place].wrong |= 1u << wrong.kind;
    }
    return f->wrong.count == OCTREE_LISTED_WRONG_NODES || list_push(f->memory, &f->wrong, &wrong, sizeof wrong);
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

static octree_box round_box_to_floats(const octree_box *box)
{
    octree_box rounded;
    for (int i = 0; i < 3; i++) {
        rounded.min[i] = round_to_float(box->min[i]);
        rounded.max[i] = round_to_float(box->max[i]);
    }
    return rounded;
}

bool foreign_node_meets(const octree_foreign_node *node, const octree_body *body)
{
    if (body_meets_box(body, &node->box) || node->precision == OCTREE_DOUBLES)
        return body_meets_box(body, &node->box);
    const octree_box box = round_box_to_floats(&node->box);
    octree_body rounded = *body;
    for (int i = 0; i < 3; i++)
        rounded.position[i] = round_to_float(body->position[i]);
    return body_meets_box(&rounded, &box);
}

/* Returns whether the body of a point meets the box of a node. */
static bool has_point_in_box(const audited_points *points, const octree_foreign_node *node, const octree_point *point)
{
    octree_body body;
    octree_bodies_at(points->bodies, point, &body);
    return foreign_node_meets(node, &body);
}

/* Returns whether the box of a child lies in the box of its parent. If the child or the parent has the precision
 * FLOATS, the boxes are compared as floats. */
static bool is_within_parent(const octree_foreign_node *child, const octree_foreign_node *parent)
{
    octree_box inner = child->box, outer = parent->box;
    if (child->precision == OCTREE_FLOATS || parent->precision == OCTREE_FLOATS) {
        inner = round_box_to_floats(&inner);
        outer = round_box_to_floats(&outer);
    }
    return box_contains(&outer, inner.min) && box_contains(&outer, inner.max);
}

/* ---- Nodes by themselves ------------------------------------------------------------------------------------ */

static bool check_boxes_in_parents(foreign *f)
{
    const octree_foreign_place *places = foreign_places(f);
    bool ok = true;
    for (size_t i = 0; ok && i < f->places.count; i++)
        if (places[i].parent != SIZE_MAX && !is_within_parent(places[i].node, places[places[i].parent].node))
            ok = report_wrong_node(f, i, (octree_wrong_node){.kind = OCTREE_NODE_OUTSIDE_PARENT});
    return ok;
}

/* Check the points that a node lists, and report the points that are unknown or outside the node's box. Returns false
 * if memory runs out. */
static bool check_listed_points(foreign *f, const audited_points *points, size_t place)
{
    const octree_foreign_node *node = foreign_places(f)[place].node;
    bool ok = true;
    for (size_t i = 0; ok && i < node->points.count; i++) {
        octree_point point;
        const uint64_t id = node->points.ids[i];
        if (!points->find(points->context, id, &point))
            ok = report_wrong_node(f, place, (octree_wrong_node){.kind = OCTREE_NODE_UNKNOWN_POINT, .point = id});
        else if (!has_point_in_box(points, node, &point))
            ok = report_wrong_node(f, place, (octree_wrong_node){.kind = OCTREE_NODE_OUTSIDE_POINT, .point = id});
        ok = ok && list_push(f->memory, &f->holdings, &(foreign_holding){id, place}, sizeof(foreign_holding));
    }
    return ok;
}

static bool are_holdings_equal(const foreign_holding *a, const foreign_holding *b)
{
    return a->id == b->id && a->place == b->place;
}

static int compare_by_place(const void *a, const void *b)
{
    const foreign_holding *p = a, *q = b;
    return p->place != q->place ? (p->place > q->place) - (p->place < q->place) : (p->id > q->id) - (p->id < q->id);
}

/* Report the points that a node lists more than once. f->holdings is sorted by point, but the reports are sorted by
 * node and then by point. Returns false if memory runs out. */
static bool report_repeated_points(foreign *f)
{
    const foreign_holding *items = f->holdings.items;
    bool ok = true;
    f->repeated.count = 0;
    for (size_t i = 1; ok && i < f->holdings.count; i++)
        if (are_holdings_equal(&items[i], &items[i - 1]) && !(i > 1 && are_holdings_equal(&items[i], &items[i - 2])))
            ok = list_push(f->memory, &f->repeated, &items[i], sizeof *items);
    const foreign_holding *repeated = f->repeated.items;
    list_sort(&f->repeated, sizeof *repeated, compare_by_place);
    for (size_t i = 0; ok && i < f->repeated.count; i++)
        ok = report_wrong_node(f, repeated[i].place,
                               (octree_wrong_node){.kind = OCTREE_NODE_REPEATED_POINT, .point = repeated[i].id});
    return ok;
}

static bool is_listed_by_node(const foreign *f, uint64_t point)
{
    const size_t first = foreign_find_first_holding(f, point);
    return first < f->holdings.count && ((const foreign_holding *)f->holdings.items)[first].id == point;
}

static bool is_leaf_without_list(const octree_foreign_place *place)
{
    return place->leaf && !place->node->has_points;
}

/* ---- Points that no node holds ------------------------------------------------------------------------------ */

typedef struct holding_search {
    foreign *foreign;
    const audited_points *points;
    const octree_foreign_node *leaf;
    size_t lost; /* the number of unlisted points for which no leaf that holds them was found yet */
    bool failed; /* true: the memory ran out */
} holding_search;

static bool is_id_of_key_player(const audited_points *points, uint64_t id)
{
    return points->own_id && *points->own_id == id;
}

/* An octree_point_visitor: collect the point if no node lists it. */
static bool collect_unlisted_point(const octree_point *point, void *context)
{
    holding_search *s = context;
    foreign *f = s->foreign;
    const bool listed = is_id_of_key_player(s->points, point->id) || is_listed_by_node(f, point->id);
    s->failed =
        !listed && !list_push(f->memory, &f->unlisted, &(unlisted_point){point->id, false}, sizeof(unlisted_point));
    return !s->failed;
}

/* An octree_body_visitor: if the body meets the box of the leaf, record that the leaf holds the body. */
static bool mark_held_point(const octree_body *body, void *context)
{
    holding_search *s = context;
    const list *unlisted = &s->foreign->unlisted;
    const unlisted_point key = {body->id, false};
    unlisted_point *found = bsearch(&key, unlisted->items, unlisted->count, sizeof key, compare_first_words);
    if (found && !found->held && foreign_node_meets(s->leaf, body)) {
        found->held = true;
        s->lost--;
    }
    return s->lost > 0;
}

/* Returns a box that contains every position which, rounded to floats, lies in the box of the leaf. */
static octree_box enlarge_box_for_floats(const octree_foreign_node *leaf)
{
    octree_box box = leaf->box;
    for (int i = 0; leaf->precision == OCTREE_FLOATS && i < 3; i++) {
        box.min[i] -= fabs(box.min[i]) * 0x1p-22 + 0x1p-148;
        box.max[i] += fabs(box.max[i]) * 0x1p-22 + 0x1p-148;
    }
    return box;
}

static void mark_points_held_by_leaves(holding_search *search)
{
    const octree_foreign_place *places = foreign_places(search->foreign);
    for (size_t i = 0; search->lost > 0 && i < search->foreign->places.count; i++) {
        if (!is_leaf_without_list(&places[i]))
            continue;
        const octree_region box = {.kind = OCTREE_REGION_BOX, .box = enlarge_box_for_floats(places[i].node)};
        search->leaf = places[i].node;
        /* The box is valid, so the search cannot fail. */
        octree_bodies_search(search->points->bodies, &box, NULL, mark_held_point, search);
    }
}

/* Report the points that no node holds, sorted by id. Returns false if memory runs out. */
static bool report_lost_points(foreign *f, const audited_points *points)
{
    static const octree_box all = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    holding_search search = {.foreign = f, .points = points};
    f->unlisted.count = 0;
    octree_range(points->tree, &all, collect_unlisted_point, &search);
    search.lost = f->unlisted.count;
    const unlisted_point *unlisted = f->unlisted.items;
    list_sort(&f->unlisted, sizeof *unlisted, compare_first_words);
    mark_points_held_by_leaves(&search);
    bool ok = !search.failed;
    for (size_t i = 0; ok && search.lost > 0 && i < f->unlisted.count; i++)
        if (!unlisted[i].held)
            ok = report_wrong_node(f, SIZE_MAX,
                                   (octree_wrong_node){.kind = OCTREE_NODE_LOST_POINT, .point = unlisted[i].id});
    return ok;
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

void foreign_begin_tick(foreign *f)
{
    enum { FROM_QUERIES = 1 << OCTREE_NODE_UNKNOWN_NODE | 1 << OCTREE_NODE_PRUNED_POINT };
    octree_foreign_state *state = &f->state;
    if (!state->given)
        return;
    const size_t *visit = f->visits.items;
    for (size_t i = 0; i < f->visits.count; i++) {
        foreign_places(f)[visit[i]].visits = 0;
        foreign_places(f)[visit[i]].wrong &= ~(unsigned)FROM_QUERIES;
    }
    f->visits.count = 0;
    state->fresh = false;
    for (int kind = 0; kind < OCTREE_NODE_VISITS; kind++)
        state->visits[kind] = 0;
}

/* Find the wrong nodes that can be found without queries. Returns false if memory runs out. */
static bool find_wrong_nodes_without_queries(foreign *f, const audited_points *points)
{
    octree_foreign_state *state = &f->state;
    memset(state->wrong, 0, sizeof state->wrong);
    f->wrong.count = f->holdings.count = 0;
    for (size_t i = 0; i < f->places.count; i++)
        foreign_places(f)[i].wrong = 0;
    bool ok = check_boxes_in_parents(f);
    for (size_t i = 0; ok && i < f->places.count; i++)
        ok = check_listed_points(f, points, i);
    list_sort(&f->holdings, sizeof(foreign_holding), foreign_compare_keys);
    f->checked = ok && report_repeated_points(f) && report_lost_points(f, points);
    f->standing = f->wrong.count;
    memcpy(f->standing_counts, state->wrong, sizeof state->wrong);
    f->version = octree_version(points->tree);
    return f->checked;
}

bool foreign_check_nodes(foreign *f, const audited_points *points)
{
    if (!f->state.given)
        return true;
    if (!f->checked || f->version != octree_version(points->tree))
        return find_wrong_nodes_without_queries(f, points);
    f->wrong.count = f->standing;
    memcpy(f->state.wrong, f->standing_counts, sizeof f->standing_counts);
    return true;
}

/* ---- Queries ------------------------------------------------------------------------------------------------ */

/* The query that is being recorded, as the context of callbacks. */
typedef struct node_query {
    foreign *foreign;
    const audited_points *points;
    size_t answer; /* the index of the query's answer among the answers of the tick */
} node_query;

static foreign_mark *foreign_marks(const foreign *f)
{
    return f->marks.items;
}

/* Record that the query visited, pruned or hit the node with this id. Returns false if memory runs out. */
static bool record_node_visit(const node_query *q, octree_node_visit visit, uint64_t id)
{
    foreign *f = q->foreign;
    const size_t place = foreign_find_node(f, id);
    if (place == SIZE_MAX)
        return report_wrong_node(
            f, place, (octree_wrong_node){.kind = OCTREE_NODE_UNKNOWN_NODE, .node = id, .answer = q->answer});
    octree_foreign_place *node = &foreign_places(f)[place];
    f->state.visits[visit] += !(node->visits >> visit & 1);
    node->visits |= 1u << visit;
    foreign_mark *mark = &foreign_marks(f)[place];
    const bool first = mark->query != f->query;
    /* if the query both pruned and visited a node, the node counts as visited */
    if (first || mark->visit == OCTREE_NODE_PRUNED)
        *mark = (foreign_mark){.query = f->query, .visit = visit};
    return list_push(f->memory, &f->visits, &place, sizeof place);
}

/* On the way from the node at `place` up to the root, find the first node that the query named. Returns the index of
 * this node if the query pruned it: the query then excludes the node at `place`, too. Otherwise returns SIZE_MAX. */
static size_t find_pruned_ancestor(const foreign *f, size_t place)
{
    while (place != SIZE_MAX && foreign_marks(f)[place].query != f->query)
        place = foreign_places(f)[place].parent;
    return place != SIZE_MAX && foreign_marks(f)[place].visit == OCTREE_NODE_PRUNED ? place : SIZE_MAX;
}

/* Returns the index of the next node that holds a point, or SIZE_MAX if no further node holds the point. *at must be 0
 * before the first call. */
static size_t find_next_holding_node(const node_query *q, const octree_point *point, size_t *at)
{
    const foreign *f = q->foreign;
    const foreign_holding *items = f->holdings.items;
    const size_t first = foreign_find_first_holding(f, point->id);
    if (first < f->holdings.count && items[first].id == point->id) {
        const size_t i = first + (*at)++;
        return i < f->holdings.count && items[i].id == point->id ? items[i].place : SIZE_MAX;
    }
    for (const octree_foreign_place *places = foreign_places(f); *at < f->places.count; ++*at)
        if (is_leaf_without_list(&places[*at]) && has_point_in_box(q->points, places[*at].node, point))
            return (*at)++;
    return SIZE_MAX;
}

/* A point_test: returns whether the query excluded all nodes that hold the point by pruning them or an ancestor.
 * Returns false if no node holds the point. */
static bool is_point_pruned(const octree_point *point, void *context)
{
    const node_query *q = context;
    size_t at = 0, holders = 0;
    if (is_id_of_key_player(q->points, point->id))
        return false;
    for (size_t place; (place = find_next_holding_node(q, point, &at)) != SIZE_MAX; holders++)
        if (find_pruned_ancestor(q->foreign, place) == SIZE_MAX)
            return false;
    return holders > 0;
}

/* A point_visit: report the pruned nodes because of which the query lost a point. For each query, a node is reported
 * only once, with the first lost point. Returns false if memory runs out. */
static bool report_pruned_point(const octree_point *point, void *context)
{
    const node_query *q = context;
    size_t at = 0;
    for (size_t place; (place = find_next_holding_node(q, point, &at)) != SIZE_MAX;) {
        const size_t pruned = find_pruned_ancestor(q->foreign, place);
        const octree_wrong_node wrong = {.kind = OCTREE_NODE_PRUNED_POINT, .point = point->id, .answer = q->answer};
        foreign_mark *mark = &foreign_marks(q->foreign)[pruned];
        if (!mark->reported && !report_wrong_node(q->foreign, pruned, wrong))
            return false;
        mark->reported = true;
    }
    return true;
}

bool foreign_record_query(foreign *f, judge *j, const judged_query *about, size_t answer)
{
    const octree_query *query = about->query;
    node_query q = {f, about->points, answer};
    bool ok = true;
    f->query++;
    for (int visit = 0; visit < OCTREE_NODE_VISITS; visit++)
        for (size_t i = 0; ok && i < query->visits[visit].count; i++)
            ok = record_node_visit(&q, (octree_node_visit)visit, query->visits[visit].ids[i]);
    const bool prunes = query->visits[OCTREE_NODE_PRUNED].count > 0;
    return ok && (!prunes || judge_without_lost_points(j, about, is_point_pruned, report_pruned_point, &q));
}
