/* edges.c - see edges.h. A box has twelve edges; on a tree most of them are shared. They are gathered by the line that
 * they lie on, compared by the very doubles of the planes, and each line is swept once. Most are not even gathered: a
 * tree's boxes come from the root down, and what lies on an edge of a parent is covered by the stretch before it. And
 * from one frame to the next a line keeps its edges, unless a box on it came or went. */
#include "edges.h"
#include "array.h"

#include <stdlib.h>
#include <string.h>

/* One edge of one box, or one end of it, on its line. */
typedef struct stretch {
    double from, to;
    uint64_t id;
    uint32_t line; /* its place in the set of lines */
    scene_style style;
    uint8_t depth;
} stretch;

typedef struct stretch_list {
    stretch *items;
    size_t count, room;
} stretch_list;

static int compare_lines(const void *a, const void *b)
{
    const line *p = *(line *const *)a, *q = *(line *const *)b;
    return line_key_compare(&p->key, &q->key);
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

static bool make_room(edge_list *list, size_t count)
{
    edge *items = array_reserve(list->items, list->count + count, &list->room, sizeof *items);
    if (items)
        list->items = items;
    return items != NULL;
}

void edges_release(edge_list *list)
{
    lines_release(&list->lines);
    merged_boxes_release(&list->boxes);
    free(list->order);
    free(list->items);
    free(list->before);
    memset(list, 0, sizeof *list);
}

static bool same_style(scene_style a, scene_style b)
{
    return a.layer == b.layer && a.role == b.role && a.stroke == b.stroke && a.width == b.width;
}

/* Add the stretch [from, to] with the style of `of`, to the last edge where it goes on from there on the same line. */
static bool emit(edge_list *list, const stretch *of, double from, double to, bool same_line)
{
    const line *on = &list->lines.items[of->line];
    const unsigned axis = line_key_axis(&on->key);
    edge *last = list->count ? &list->items[list->count - 1] : NULL;
    if (same_line && last && last->depth == of->depth && same_style(last->style, of->style) &&
        last->ends[1][axis] == from) {
        last->ends[1][axis] = to;
        return true;
    }
    if (!make_room(list, 1))
        return false;
    edge *added = &list->items[list->count++];
    *added = (edge){.id = of->id, .style = of->style, .depth = of->depth};
    for (int end = 0; end < 2; end++) {
        added->ends[end][axis] = end ? to : from;
        added->ends[end][(axis + 1) % 3] = on->key.u;
        added->ends[end][(axis + 2) % 3] = on->key.v;
    }
    return true;
}

/* The shallowest stretch of a line that covers what begins at `at`: the best of those begun and not yet ended. */
static const stretch *shallowest(const stretch *line, size_t begun, double at)
{
    const stretch *best = NULL;
    for (size_t i = 0; i < begun; i++)
        if (line[i].to > at && (!best || line[i].depth < best->depth))
            best = &line[i];
    return best;
}

/* Where the stretch in force ends or a shallower one begins. */
static double next_change(const stretch *line, size_t count, size_t begun, const stretch *now)
{
    for (size_t i = begun; i < count && line[i].from < now->to; i++)
        if (line[i].depth < now->depth)
            return line[i].from;
    return now->to;
}

/* Sweep the stretches of one line, sorted by where they begin. Those that have ended are dropped from the front, so
 * that a line costs little more than its length times the depth of the tree. */
static bool sweep_line(edge_list *list, const stretch *line, size_t count)
{
    if (count == 0)
        return true;
    const unsigned axis = line_key_axis(&list->lines.items[line[0].line].key);
    size_t first = 0;
    bool same_line = false;
    double at = line[0].from;
    while (first < count) {
        size_t begun = first;
        while (begun < count && line[begun].from <= at)
            begun++;
        const stretch *now = shallowest(line + first, begun - first, at);
        if (!now) {
            const bool covered = same_line && list->items[list->count - 1].ends[1][axis] == at;
            if (!covered && !emit(list, &line[first], at, at, false))
                return false; /* a box of no extent is a dot */
            same_line = true;
            first = begun;
            at = begun < count ? line[begun].from : at;
            continue;
        }
        const double to = next_change(line, count, begun, now);
        if (!emit(list, now, at, to, same_line))
            return false;
        same_line = true;
        at = to;
        while (first < count && line[first].to <= at)
            first++;
    }
    return true;
}

/* Whether a stretch that was put on the same line before leaves nothing of this one to be seen: what sweep_line() would
 * find, known at once. */
static bool is_covered(const stretch *it, const stretch *by)
{
    if (it->from < by->from || it->to > by->to || it->depth < by->depth)
        return false;
    return it->depth > by->depth || it->from > by->from || it->id >= by->id;
}

static bool append_stretch(stretch_list *all, const stretch *it)
{
    stretch *items = array_reserve(all->items, all->count + 1, &all->room, sizeof *items);
    if (!items)
        return false;
    all->items = items;
    all->items[all->count++] = *it;
    return true;
}

static bool collect_edge(stretch_list *all, line *on, uint32_t place, const scene_box *box, unsigned axis)
{
    const stretch it = {.from = box->box.min[axis],
                        .to = box->box.max[axis],
                        .id = box->id,
                        .line = place,
                        .style = box->style,
                        .depth = box->depth};
    if (on->last != LINE_NONE && is_covered(&it, &all->items[on->last]))
        return true;
    on->last = (uint32_t)all->count;
    on->next++; /* a count, so far */
    return append_stretch(all, &it);
}

/* The stretches of all lines that are changed. */
static bool collect(stretch_list *all, edge_list *list)
{
    bool ok = true;
    line_set *lines = &list->lines;
    for (size_t i = 0; i < lines->count; i++)
        if (lines->changed[i]) {
            lines->items[i].next = 0;
            lines->items[i].last = LINE_NONE;
        }
    const box_arrays *boxes = &list->boxes.now;
    for (size_t i = 0; ok && i < boxes->count; i++)
        for (unsigned edge = 0; ok && edge < BOX_EDGES; edge++) {
            const uint32_t place = boxes->lines[i].of[edge];
            if (place != LINE_NONE && lines->changed[place])
                ok = collect_edge(all, &lines->items[place], place, &boxes->boxes[i], edge / 4);
        }
    return ok && all->count <= UINT32_MAX;
}

/* The lines that came last, in their order, by way of pointers. Null when there is no memory. */
static const line **sort_new_lines(const edge_list *list)
{
    const line_set *lines = &list->lines;
    const size_t count = lines->count - list->ordered;
    const line **sorted = malloc((count + 1) * sizeof *sorted);
    for (size_t i = 0; sorted && i < count; i++)
        sorted[i] = &lines->items[list->ordered + i];
    if (sorted)
        qsort(sorted, count, sizeof *sorted, compare_lines);
    return sorted;
}

/* Put the lines that came last between the others, from the last one on. */
static void merge_order(edge_list *list, const line *const *sorted)
{
    const line *lines = list->lines.items;
    size_t old = list->ordered, new = list->lines.count - old;
    for (size_t at = list->lines.count; new > 0;) {
        const bool comes = old == 0 || line_key_compare(&lines[list->order[old - 1]].key, &sorted[new - 1]->key) < 0;
        list->order[--at] = comes ? (uint32_t)(sorted[--new] - lines) : list->order[--old];
    }
    list->ordered = list->lines.count;
}

static bool order_lines(edge_list *list)
{
    if (list->ordered == list->lines.count)
        return true;
    const line **sorted = sort_new_lines(list);
    uint32_t *order = sorted ? realloc(list->order, list->lines.room * sizeof *order) : NULL;
    if (order) {
        list->order = order;
        merge_order(list, sorted);
    }
    free(sorted);
    return order != NULL;
}

/* Stretches side by side with those of their line, line by line in their order. Null when there is no memory. */
static stretch *gather(const stretch_list *all, edge_list *list)
{
    stretch *gathered = malloc((all->count + 1) * sizeof *gathered);
    line *lines = list->lines.items;
    uint32_t next = 0;
    for (size_t i = 0; i < list->ordered; i++) {
        const uint32_t place = list->order[i];
        if (!list->lines.changed[place])
            continue;
        const uint32_t count = lines[place].next;
        lines[place].next = next;
        next += count;
    }
    for (size_t i = 0; gathered && i < all->count; i++)
        gathered[lines[all->items[i].line].next++] = all->items[i];
    return gathered;
}

/* Most lines have few, and these nearly in order. */
static void sort_stretches(stretch *line, size_t count)
{
    enum { FEW = 24 };
    if (count > FEW) {
        qsort(line, count, sizeof *line, compare_stretches);
        return;
    }
    for (size_t i = 1; i < count; i++) {
        const stretch it = line[i];
        size_t at = i;
        for (; at > 0 && compare_stretches(&line[at - 1], &it) > 0; at--)
            line[at] = line[at - 1];
        line[at] = it;
    }
}

/* The edges of a line that are as they were. */
static bool copy_edges(edge_list *list, const line *of)
{
    if (of->count == 0)
        return true;
    if (!make_room(list, of->count))
        return false;
    memcpy(list->items + list->count, list->before + of->first, of->count * sizeof *list->items);
    list->count += of->count;
    return true;
}

/* Line by line in their order: what is gathered of those that are changed, and the edges before of all others. */
static bool sweep_lines(edge_list *list, stretch *gathered)
{
    bool ok = true;
    uint32_t begin = 0;
    for (size_t i = 0; ok && i < list->ordered; i++) {
        line *on = &list->lines.items[list->order[i]];
        uint8_t *changed = &list->lines.changed[list->order[i]];
        const size_t first = list->count;
        if (*changed) {
            sort_stretches(gathered + begin, on->next - begin);
            ok = sweep_line(list, gathered + begin, on->next - begin);
            begin = on->next;
            on->count = (uint32_t)(list->count - first);
        } else {
            ok = copy_edges(list, on);
        }
        on->first = (uint32_t)first;
        *changed = false;
    }
    return ok;
}

static void swap_arrays(edge_list *list)
{
    edge *const items = list->items;
    const size_t room = list->room;
    list->items = list->before;
    list->room = list->before_room;
    list->before = items;
    list->before_room = room;
    list->count = 0;
}

static bool merge_lines(edge_list *list)
{
    stretch_list all = {0};
    swap_arrays(list);
    const bool ok = order_lines(list) && collect(&all, list);
    stretch *gathered = ok ? gather(&all, list) : NULL;
    const bool swept = gathered && sweep_lines(list, gathered);
    free(gathered);
    free(all.items);
    return swept;
}

static void forget(edge_list *list)
{
    lines_clear(&list->lines);
    list->boxes.now.count = list->ordered = list->count = 0;
}

bool edges_merge(edge_list *list, const scene *s, unsigned first, unsigned behind)
{
    if (merged_boxes_are(&list->boxes, s, first, behind))
        return true;
    if (list->lines.idle > list->lines.count / 2)
        forget(list);
    if (merged_boxes_become(&list->boxes, &list->lines, s, first, behind) && merge_lines(list))
        return true;
    forget(list);
    return false;
}
