/* edges.c - see edges.h. A box has twelve edges; on a tree most of them are shared. They are gathered by the line that
 * they lie on, compared by the very doubles of the planes, and each line is swept once. Most are not even gathered: a
 * tree's boxes come from the root down, and what lies on an edge of a parent is covered by the stretch before it. */
#include "edges.h"

#include <stdlib.h>
#include <string.h>

/* One edge of one box, or one end of it, on its line. */
typedef struct stretch {
    double from, to;
    uint64_t id;
    size_t line; /* its place in the set of lines */
    scene_look look;
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

static edge *append_edge(edge_list *list)
{
    if (list->count == list->room) {
        const size_t room = list->room ? 2 * list->room : 256;
        edge *items = room <= SIZE_MAX / sizeof *items ? realloc(list->items, room * sizeof *items) : NULL;
        if (!items)
            return NULL;
        list->items = items;
        list->room = room;
    }
    return &list->items[list->count++];
}

void edges_release(edge_list *list)
{
    lines_release(&list->lines);
    free(list->boxes);
    free(list->items);
    memset(list, 0, sizeof *list);
}

static bool same_look(scene_look a, scene_look b)
{
    return a.layer == b.layer && a.role == b.role && a.style == b.style && a.width == b.width;
}

/* Add the stretch [from, to] with the look of `of`, to the last edge where it goes on from there on the same line. */
static bool emit(edge_list *list, const stretch *of, double from, double to, bool same_line)
{
    const line *on = &list->lines.items[of->line];
    const unsigned axis = line_key_axis(&on->key);
    edge *last = list->count ? &list->items[list->count - 1] : NULL;
    if (same_line && last && last->depth == of->depth && same_look(last->look, of->look) &&
        last->ends[1][axis] == from) {
        last->ends[1][axis] = to;
        return true;
    }
    edge *added = append_edge(list);
    if (!added)
        return false;
    *added = (edge){.id = of->id, .look = of->look, .depth = of->depth};
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
    if (all->count == all->room) {
        const size_t room = all->room ? 2 * all->room : 1024;
        stretch *items = room <= SIZE_MAX / sizeof *items ? realloc(all->items, room * sizeof *items) : NULL;
        if (!items)
            return false;
        all->items = items;
        all->room = room;
    }
    all->items[all->count++] = *it;
    return true;
}

static bool collect_edge(stretch_list *all, line_set *lines, const scene_box *box, unsigned axis, unsigned corner)
{
    const line_key key = line_key_of(box, axis, corner);
    const size_t place = lines_find(lines, &key);
    if (place == SIZE_MAX)
        return false;
    line *on = &lines->items[place];
    const stretch it = {.from = box->box.min[axis],
                        .to = box->box.max[axis],
                        .id = box->id,
                        .line = place,
                        .look = box->look,
                        .depth = box->depth};
    if (on->count && is_covered(&it, &all->items[on->last]))
        return true;
    on->last = all->count;
    on->count++;
    return append_stretch(all, &it);
}

/* Edges along axes of no extent are dots on others, but for a box that is a dot itself. */
static bool collect_box(stretch_list *all, line_set *lines, const scene_box *box)
{
    bool ok = true, dot = true;
    for (unsigned axis = 0; axis < 3; axis++)
        for (unsigned corner = 0; ok && corner < 4 && box->box.min[axis] < box->box.max[axis]; corner++) {
            ok = collect_edge(all, lines, box, axis, corner);
            dot = false;
        }
    return ok && (!dot || collect_edge(all, lines, box, 0, 0));
}

/* The lines in their order, by way of pointers. Null when there is no memory. */
static line **sort_lines(line_set *lines)
{
    line **sorted = malloc(lines->count * sizeof *sorted);
    for (size_t i = 0; sorted && i < lines->count; i++)
        sorted[i] = &lines->items[i];
    if (sorted)
        qsort(sorted, lines->count, sizeof *sorted, compare_lines);
    return sorted;
}

/* Stretches side by side with those of their line, line by line in their order. Null when there is no memory. */
static stretch *gather(const stretch_list *all, line_set *lines, line *const *sorted)
{
    stretch *gathered = malloc(all->count * sizeof *gathered);
    size_t next = 0;
    for (size_t i = 0; i < lines->count; i++) {
        sorted[i]->last = next; /* from here on: where its next stretch goes */
        next += sorted[i]->count;
    }
    for (size_t i = 0; gathered && i < all->count; i++)
        gathered[lines->items[all->items[i].line].last++] = all->items[i];
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

static bool sweep_lines(edge_list *list, stretch *gathered, line *const *sorted)
{
    bool ok = true;
    for (size_t i = 0; ok && i < list->lines.count; i++) {
        const size_t count = sorted[i]->count;
        sort_stretches(gathered, count);
        ok = sweep_line(list, gathered, count);
        gathered += count;
    }
    return ok;
}

static bool merge_boxes(edge_list *list)
{
    stretch_list all = {0};
    bool ok = true;
    list->count = 0;
    lines_clear(&list->lines);
    for (size_t i = 0; ok && i < list->box_count; i++)
        ok = collect_box(&all, &list->lines, &list->boxes[i]);
    line **sorted = ok && all.count ? sort_lines(&list->lines) : NULL;
    stretch *gathered = sorted ? gather(&all, &list->lines, sorted) : NULL;
    ok = ok && (all.count == 0 || (gathered && sweep_lines(list, gathered, sorted)));
    free(gathered);
    free(sorted);
    free(all.items);
    return ok;
}

static bool same_box(const scene_box *a, const scene_box *b)
{
    return a->id == b->id && a->depth == b->depth && same_look(a->look, b->look) &&
           memcmp(&a->box, &b->box, sizeof a->box) == 0;
}

static bool keep_box(edge_list *list, size_t at, const scene_box *box)
{
    if (at == list->box_room) {
        const size_t room = at ? 2 * at : 64;
        scene_box *boxes = room <= SIZE_MAX / sizeof *boxes ? realloc(list->boxes, room * sizeof *boxes) : NULL;
        if (!boxes)
            return false;
        list->boxes = boxes;
        list->box_room = room;
    }
    list->boxes[at] = *box;
    return true;
}

/* Keep the boxes of these layers; *same tells whether they are those that are kept already. */
static bool keep_boxes(edge_list *list, const scene *s, unsigned first, unsigned behind, bool *same)
{
    size_t count = 0;
    bool ok = true;
    *same = true;
    for (size_t i = 0; ok && i < s->boxes.count; i++) {
        const scene_box *box = &s->boxes.items[i];
        if (box->look.layer < first || box->look.layer >= behind)
            continue;
        if (count >= list->box_count || !same_box(&list->boxes[count], box)) {
            *same = false;
            ok = keep_box(list, count, box);
        }
        count += ok;
    }
    *same = *same && count == list->box_count;
    list->box_count = count;
    return ok;
}

bool edges_merge(edge_list *list, const scene *s, unsigned first, unsigned behind)
{
    bool same;
    if (keep_boxes(list, s, first, behind, &same) && (same || merge_boxes(list)))
        return true;
    list->box_count = 0; /* what is there is not theirs */
    list->count = 0;
    return false;
}
