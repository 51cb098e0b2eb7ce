/* SPDX-License-Identifier: MIT */
/* edges.c - a box has twelve edges, and in a tree most are shared. They are grouped by the line that they lie on, whose
 * doubles are compared exactly, and each line is swept once. Most are dropped before: a tree's boxes come from the root
 * down, and an edge on a parent's edge is covered by it. A line keeps its edges from frame to frame unless a box on it
 * was added or removed. */
#include "edges.h"
#include "array.h"

#include <stdlib.h>
#include <string.h>

/* One edge of one box, or one end of it, on its line. */
typedef struct stretch {
    double from, to;
    uint64_t id;
    scene_style style;
    uint8_t depth;
} stretch;

typedef struct stretch_list {
    stretch *items;
    size_t count, room;
} stretch_list;

void edges_release(edge_list *list)
{
    box_lines_release(&list->boxes);
    free(list->order);
    free(list->now.items);
    free(list->before.items);
    memset(list, 0, sizeof *list);
}

/* ---- The order of lines --------------------------------------------------------------------------------------- */

static int compare_lines(const void *a, const void *b)
{
    const line *const *p = a, *const *q = b;
    return line_key_compare(&(*p)->key, &(*q)->key);
}

/* Merge the new lines, sorted, into the order of the others, from the end. */
static void merge_order(edge_list *list, const line *const *sorted)
{
    const line *lines = list->boxes.lines;
    size_t old = list->ordered, new = list->boxes.count - old;
    for (size_t at = list->boxes.count; new > 0;) {
        const bool comes = old == 0 || line_key_compare(&lines[list->order[old - 1]].key, &sorted[new - 1]->key) < 0;
        list->order[--at] = comes ? (uint32_t)(sorted[--new] - lines) : list->order[--old];
    }
    list->ordered = list->boxes.count;
}

static bool order_lines(edge_list *list)
{
    const size_t old = list->ordered, count = list->boxes.count;
    if (old == count)
        return true;
    const line **sorted = malloc((count - old) * sizeof *sorted);
    uint32_t *order = sorted ? realloc(list->order, list->boxes.room * sizeof *order) : NULL;
    if (order) {
        list->order = order;
        for (size_t i = old; i < count; i++)
            sorted[i - old] = &list->boxes.lines[i];
        qsort(sorted, count - old, sizeof *sorted, compare_lines);
        merge_order(list, sorted);
    }
    free(sorted);
    return order != NULL;
}

/* ---- The stretches of lines ----------------------------------------------------------------------------------- */

static stretch stretch_of(const scene_box *box, unsigned axis)
{
    return (stretch){
        .from = box->box.min[axis], .to = box->box.max[axis], .id = box->id, .style = box->style, .depth = box->depth};
}

/* Whether an earlier stretch of the same line hides this one completely, as sweep_line() would find. */
static bool is_covered(const stretch *it, const stretch *by)
{
    if (it->from < by->from || it->to > by->to || it->depth < by->depth)
        return false;
    return it->depth > by->depth || it->from > by->from || it->id >= by->id;
}

static void collect_edge(uint32_t *places, line *on, const lined_box *boxes, uint32_t place, unsigned axis)
{
    if (on->stretches > 0) {
        const stretch it = stretch_of(&boxes[place].box, axis), last = stretch_of(&boxes[on->last].box, axis);
        if (is_covered(&it, &last))
            return;
    }
    places[on->start + on->stretches++] = on->last = place;
}

/* Let each changed line have room for the places of all boxes that lie on it, in the order in which lines are swept.
 * Null when there is no memory. */
static uint32_t *make_room(edge_list *list)
{
    box_lines *from = &list->boxes;
    size_t total = 0;
    for (size_t i = 0; i < list->ordered; i++) {
        line *on = &from->lines[list->order[i]];
        on->stretches = 0;
        on->start = (uint32_t)total;
        total += from->changed[list->order[i]] ? on->users : 0;
    }
    return total < UINT32_MAX ? malloc((total + 1) * sizeof(uint32_t)) : NULL;
}

/* The places of the boxes on all changed lines. */
static uint32_t *collect(edge_list *list)
{
    box_lines *from = &list->boxes;
    uint32_t *places = make_room(list);
    for (size_t i = 0; places && i < from->now.count; i++)
        for (unsigned edge = 0; edge < BOX_EDGES; edge++) {
            const uint32_t on = from->now.items[i].lines[edge];
            if (on != LINE_NONE && from->changed[on])
                collect_edge(places, &from->lines[on], from->now.items, (uint32_t)i, edge / 4);
        }
    return places;
}

static int compare_stretches(const void *a, const void *b)
{
    const stretch *p = a, *q = b;
    const int from = compare_doubles(p->from, q->from);
    if (from)
        return from;
    if (p->depth != q->depth)
        return p->depth < q->depth ? -1 : 1;
    return p->id < q->id ? -1 : p->id > q->id;
}

/* A tree's boxes come in Morton order: then the stretches of a line, however many, are in order but for those of the
 * cells about one place, and few are moved far. */
static void sort_stretches(stretch *line, size_t count)
{
    enum { MOVES_OF_EACH = 16 };
    size_t left = MOVES_OF_EACH * count;
    for (size_t i = 1; i < count; i++) {
        const stretch it = line[i];
        size_t at = i;
        for (; at > 0 && compare_stretches(&line[at - 1], &it) > 0; at--)
            line[at] = line[at - 1];
        line[at] = it;
        if (i - at > left) {
            qsort(line, count, sizeof *line, compare_stretches);
            return;
        }
        left -= i - at;
    }
}

/* The stretches of one line, sorted. */
static bool gather(stretch_list *one, const lined_box *boxes, const uint32_t *places, const line *on)
{
    stretch *items = array_reserve(one->items, on->stretches + 1, &one->room, sizeof *items);
    if (!items)
        return false;
    for (size_t i = 0; i < on->stretches; i++)
        items[i] = stretch_of(&boxes[places[on->start + i]].box, line_key_axis(&on->key));
    one->items = items;
    one->count = on->stretches;
    sort_stretches(items, one->count);
    return true;
}

/* ---- The sweep of a line -------------------------------------------------------------------------------------- */

/* The line that is being swept, whose edges begin at `first`. */
typedef struct sweep {
    edge_array *edges;
    const line_key *on;
    unsigned axis;
    size_t first;
} sweep;

/* The end of the line's last edge, or null. */
static double *last_end(const sweep *w)
{
    return w->edges->count > w->first ? &w->edges->items[w->edges->count - 1].ends[1][w->axis] : NULL;
}

static bool reserve_edges(edge_array *edges, size_t count)
{
    edge *items = array_reserve(edges->items, edges->count + count, &edges->room, sizeof *items);
    if (items)
        edges->items = items;
    return items != NULL;
}

static bool add_edge(const sweep *w, const stretch *of, double from, double to)
{
    if (!reserve_edges(w->edges, 1))
        return false;
    edge *added = &w->edges->items[w->edges->count++];
    *added = (edge){.style = of->style, .depth = of->depth};
    for (int end = 0; end < 2; end++) {
        added->ends[end][w->axis] = end ? to : from;
        added->ends[end][(w->axis + 1) % 3] = w->on->u;
        added->ends[end][(w->axis + 2) % 3] = w->on->v;
    }
    return true;
}

static bool same_style(scene_style a, scene_style b)
{
    return a.layer == b.layer && a.role == b.role && a.stroke == b.stroke && a.width == b.width;
}

/* Add [from, to] with the style of a stretch, as an edge or by extending the last one. */
static bool emit(const sweep *w, const stretch *of, double from, double to)
{
    double *end = last_end(w);
    const edge *last = end ? &w->edges->items[w->edges->count - 1] : NULL;
    if (!last || *end != from || last->depth != of->depth || !same_style(last->style, of->style))
        return add_edge(w, of, from, to);
    *end = to;
    return true;
}

/* The shallowest of a line's stretches that have begun and not ended at `at`. */
static const stretch *shallowest(const stretch *line, size_t begun, double at)
{
    const stretch *best = NULL;
    for (size_t i = 0; i < begun; i++)
        if (line[i].to > at && (!best || line[i].depth < best->depth))
            best = &line[i];
    return best;
}

/* Where the current stretch ends or a shallower one begins. */
static double next_change(const stretch *line, size_t count, size_t begun, const stretch *now)
{
    for (size_t i = begun; i < count && line[i].from < now->to; i++)
        if (line[i].depth < now->depth)
            return line[i].from;
    return now->to;
}

/* Sweep the stretches of one line, sorted by where they begin. Ended ones are dropped from the front, so that the cost
 * of a line is about its length times the depth of the tree. */
static bool sweep_line(const sweep *w, const stretch *line, size_t count)
{
    size_t first = 0;
    double at = count ? line[0].from : 0;
    while (first < count) {
        size_t begun = first;
        while (begun < count && line[begun].from <= at)
            begun++;
        const stretch *now = shallowest(line + first, begun - first, at);
        if (!now) {
            const double *end = last_end(w);
            if (!(end && *end == at) && !add_edge(w, &line[first], at, at))
                return false; /* a box of no extent is a dot */
            first = begun;
            at = begun < count ? line[begun].from : at;
            continue;
        }
        const double to = next_change(line, count, begun, now);
        if (!emit(w, now, at, to))
            return false;
        at = to;
        while (first < count && line[first].to <= at)
            first++;
    }
    return true;
}

/* ---- All lines ------------------------------------------------------------------------------------------------ */

/* Copy the edges of an unchanged line. */
static bool copy_edges(edge_list *list, const line *of)
{
    edge_array *now = &list->now;
    if (of->count == 0)
        return true;
    if (!reserve_edges(now, of->count))
        return false;
    memcpy(now->items + now->count, list->before.items + of->first, of->count * sizeof *now->items);
    now->count += of->count;
    return true;
}

/* Line by line in order: sweep the changed lines, and copy the edges of the others. */
static bool sweep_lines(edge_list *list, const uint32_t *places)
{
    bool ok = true;
    stretch_list one = {0};
    for (size_t i = 0; ok && i < list->ordered; i++) {
        line *on = &list->boxes.lines[list->order[i]];
        uint8_t *changed = &list->boxes.changed[list->order[i]];
        const sweep w = {&list->now, &on->key, line_key_axis(&on->key), list->now.count};
        ok = *changed ? gather(&one, list->boxes.now.items, places, on) && sweep_line(&w, one.items, one.count)
                      : copy_edges(list, on);
        on->first = (uint32_t)w.first;
        on->count = (uint32_t)(list->now.count - w.first);
        *changed = false;
    }
    free(one.items);
    return ok;
}

static bool merge_lines(edge_list *list)
{
    const edge_array before = list->before;
    list->before = list->now;
    list->now = before;
    list->now.count = 0;
    uint32_t *places = order_lines(list) ? collect(list) : NULL;
    const bool merged = places && sweep_lines(list, places);
    free(places);
    return merged;
}

static void forget(edge_list *list)
{
    box_lines_clear(&list->boxes);
    list->now.count = list->ordered = 0;
}

bool edges_merge(edge_list *list, const scene *s, unsigned first, unsigned end)
{
    bool changed;
    if (list->boxes.idle > list->boxes.count / 2)
        forget(list);
    if (box_lines_update(&list->boxes, s, first, end, &changed) && (!changed || merge_lines(list)))
        return true;
    forget(list);
    return false;
}
