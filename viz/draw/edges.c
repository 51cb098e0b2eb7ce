/* SPDX-License-Identifier: MIT */
/* edges.c - merges the edges of a scene's boxes into segments that do not overlap.
 *
 * The problem: in a tree most edges of a box coincide with edges of its parent, siblings and neighbours. Drawing each
 * box separately would draw the same line many times, and the line would have the colour of the last box instead of the
 * colour of the shallowest box. Comparing all pairs of edges would cost O(n^2).
 *
 * The idea: edges that overlap lie on the same line. box_lines.c groups the edges by line; it compares coordinates
 * exactly, because nodes share planes bit for bit. On its line an edge is an interval. The intervals of a line are
 * sorted by their start. One sweep then walks along the line and emits, for each part of the line, the shallowest
 * interval that covers this part. Most intervals are dropped before they are sorted: a parent box comes before its
 * children, and an edge of a child that lies on an edge of the parent is not visible.
 *
 * A line keeps its merged edges from frame to frame until a box with an edge on the line is added or removed. */
#include "edges.h"
#include "array.h"

#include <stdlib.h>
#include <string.h>

/* One edge of a box, as an interval on its line. */
typedef struct interval {
    double from, to;
    uint64_t id;
    scene_style style;
    uint8_t depth;
} interval;

typedef ARRAY(interval) interval_list;

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

/* Merge the new lines, which are sorted, into list->order. The merge runs backwards, so that no entry is overwritten
 * before it is read. */
static void merge_new_lines_into_order(edge_list *list, const line *const *sorted)
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
        merge_new_lines_into_order(list, sorted);
    }
    free(sorted);
    return order != NULL;
}

/* ---- The intervals of lines ------------------------------------------------------------------------------------ */

static interval make_interval(const scene_box *box, unsigned axis)
{
    return (interval){
        .from = box->box.min[axis], .to = box->box.max[axis], .id = box->id, .style = box->style, .depth = box->depth};
}

/* Returns whether `by`, an earlier interval of the same line, covers the interval `it`. If so, sweep_line() would emit
 * no edge for `it`. */
static bool is_covered(const interval *it, const interval *by)
{
    if (it->from < by->from || it->to > by->to || it->depth < by->depth)
        return false;
    return it->depth > by->depth || it->from > by->from || it->id >= by->id;
}

static void collect_edge(uint32_t *places, line *on, const lined_box *boxes, uint32_t place, unsigned axis)
{
    if (on->intervals > 0) {
        const interval it = make_interval(&boxes[place].box, axis), last = make_interval(&boxes[on->last].box, axis);
        if (is_covered(&it, &last))
            return;
    }
    places[on->start + on->intervals++] = on->last = place;
}

/* Allocate one array for the box indices of all changed lines. Each changed line gets a range of the array with room
 * for all of its box edges. Returns null if memory runs out. */
static uint32_t *allocate_places(edge_list *list)
{
    box_lines *from = &list->boxes;
    size_t total = 0;
    for (size_t i = 0; i < list->ordered; i++) {
        line *on = &from->lines[list->order[i]];
        on->intervals = 0;
        on->start = (uint32_t)total;
        total += from->changed[list->order[i]] ? on->users : 0;
    }
    return total < UINT32_MAX ? malloc((total + 1) * sizeof(uint32_t)) : NULL;
}

/* List the boxes of each changed line, as indices into from->now. Returns null if memory runs out. The caller frees the
 * list. */
static uint32_t *collect_boxes(edge_list *list)
{
    box_lines *from = &list->boxes;
    uint32_t *places = allocate_places(list);
    for (size_t i = 0; places && i < from->now.count; i++)
        for (unsigned edge = 0; edge < BOX_EDGES; edge++) {
            const uint32_t on = from->now.items[i].lines[edge];
            if (on != LINE_NONE && from->changed[on])
                collect_edge(places, &from->lines[on], from->now.items, (uint32_t)i, edge / 4);
        }
    return places;
}

static int compare_intervals(const void *a, const void *b)
{
    const interval *p = a, *q = b;
    const int from = compare_doubles(p->from, q->from);
    if (from)
        return from;
    if (p->depth != q->depth)
        return p->depth < q->depth ? -1 : 1;
    return p->id < q->id ? -1 : p->id > q->id;
}

/* Sort intervals by insertion. Boxes come in Morton order, so that the intervals of a line are nearly sorted, and few
 * intervals move far. After more than 16 moves per interval, qsort() sorts them instead. */
static void sort_intervals(interval *line, size_t count)
{
    enum { MOVES_OF_EACH = 16 };
    size_t left = MOVES_OF_EACH * count;
    for (size_t i = 1; i < count; i++) {
        const interval it = line[i];
        size_t at = i;
        for (; at > 0 && compare_intervals(&line[at - 1], &it) > 0; at--)
            line[at] = line[at - 1];
        line[at] = it;
        if (i - at > left) {
            qsort(line, count, sizeof *line, compare_intervals);
            return;
        }
        left -= i - at;
    }
}

/* Fill *one with the sorted intervals of the line `on`. Returns false if memory runs out. */
static bool gather_line_intervals(interval_list *one, const lined_box *boxes, const uint32_t *places, const line *on)
{
    if (!array_grow(&one->items, on->intervals + 1, &one->room, sizeof *one->items))
        return false;
    for (size_t i = 0; i < on->intervals; i++)
        one->items[i] = make_interval(&boxes[places[on->start + i]].box, line_key_axis(&on->key));
    one->count = on->intervals;
    sort_intervals(one->items, one->count);
    return true;
}

/* ---- The sweep of a line -------------------------------------------------------------------------------------- */

/* The line that is being swept. The line's merged edges are the edges of *edges from index `first` on. */
typedef struct sweep {
    edge_array *edges;
    const line_key *on;
    unsigned axis;
    size_t first;
} sweep;

/* Returns a pointer to the end coordinate of the line's last merged edge. Returns null if the line has no merged edge
 * yet. */
static double *last_merged_edge_end(const sweep *w)
{
    return w->edges->count > w->first ? &w->edges->items[w->edges->count - 1].ends[1][w->axis] : NULL;
}

static bool add_edge(const sweep *w, const interval *of, double from, double to)
{
    if (!ARRAY_GROW(w->edges, 1))
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

/* Emit a merged edge from coordinate `from` to coordinate `to`, with the style of an interval. If the last merged edge
 * ends at `from` and has the same style and depth, extend it; otherwise add an edge. Returns false if memory runs
 * out. */
static bool extend_or_add_edge(const sweep *w, const interval *of, double from, double to)
{
    double *end = last_merged_edge_end(w);
    const edge *last = end ? &w->edges->items[w->edges->count - 1] : NULL;
    if (!last || *end != from || last->depth != of->depth || memcmp(&last->style, &of->style, sizeof of->style) != 0)
        return add_edge(w, of, from, to);
    *end = to;
    return true;
}

/* Among the first `begun` intervals, returns the shallowest interval that ends after coordinate `at`. Returns null if
 * all of these intervals have ended. */
static const interval *find_shallowest(const interval *line, size_t begun, double at)
{
    const interval *best = NULL;
    for (size_t i = 0; i < begun; i++)
        if (line[i].to > at && (!best || line[i].depth < best->depth))
            best = &line[i];
    return best;
}

/* Returns the coordinate at which the interval `now` ends or a shallower interval begins, whichever comes first. */
static double find_next_change(const interval *line, size_t count, size_t begun, const interval *now)
{
    for (size_t i = begun; i < count && line[i].from < now->to; i++)
        if (line[i].depth < now->depth)
            return line[i].from;
    return now->to;
}

/* Sweep the intervals of one line, which are sorted by their start, and emit the line's merged edges. Intervals that
 * have ended are dropped from the front, so that the cost is about the number of intervals times the depth of the tree.
 * Returns false if memory runs out. */
static bool sweep_line(const sweep *w, const interval *line, size_t count)
{
    size_t first = 0;
    double at = count ? line[0].from : 0;
    while (first < count) {
        size_t begun = first;
        while (begun < count && line[begun].from <= at)
            begun++;
        const interval *now = find_shallowest(line + first, begun - first, at);
        if (!now) { /* the begun intervals have length 0; only a box that is a single point has such an edge */
            const double *end = last_merged_edge_end(w);
            if (!(end && *end == at) && !add_edge(w, &line[first], at, at))
                return false;
            first = begun;
            at = begun < count ? line[begun].from : at;
            continue;
        }
        const double to = find_next_change(line, count, begun, now);
        if (!extend_or_add_edge(w, now, at, to))
            return false;
        at = to;
        while (first < count && line[first].to <= at)
            first++;
    }
    return true;
}

/* ---- All lines ------------------------------------------------------------------------------------------------ */

/* Copy the merged edges of an unchanged line from list->before. Returns false if memory runs out. */
static bool copy_line_edges(edge_list *list, const line *of)
{
    edge_array *now = &list->now;
    if (of->count == 0)
        return true;
    if (!ARRAY_GROW(now, of->count))
        return false;
    memcpy(now->items + now->count, list->before.items + of->first, of->count * sizeof *now->items);
    now->count += of->count;
    return true;
}

/* Sweep the changed lines, and copy the merged edges of all other lines, both in painting order. Returns false if
 * memory runs out. */
static bool sweep_lines(edge_list *list, const uint32_t *places)
{
    bool ok = true;
    interval_list one = {0};
    for (size_t i = 0; ok && i < list->ordered; i++) {
        line *on = &list->boxes.lines[list->order[i]];
        uint8_t *changed = &list->boxes.changed[list->order[i]];
        const sweep w = {&list->now, &on->key, line_key_axis(&on->key), list->now.count};
        ok = *changed ? gather_line_intervals(&one, list->boxes.now.items, places, on) &&
                            sweep_line(&w, one.items, one.count)
                      : copy_line_edges(list, on);
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
    uint32_t *places = order_lines(list) ? collect_boxes(list) : NULL;
    const bool merged = places && sweep_lines(list, places);
    free(places);
    return merged;
}

static void clear_lines(edge_list *list)
{
    box_lines_clear(&list->boxes);
    list->now.count = list->ordered = 0;
}

bool edges_merge(edge_list *list, const scene *s, unsigned first, unsigned end)
{
    bool changed;
    if (list->boxes.idle > list->boxes.count / 2)
        clear_lines(list); /* too many lines have no box edges left, so the set of lines is rebuilt */
    if (box_lines_update(&list->boxes, s, first, end, &changed) && (!changed || merge_lines(list)))
        return true;
    clear_lines(list);
    return false;
}
