/* edges.c - see edges.h. A box has twelve edges; on a tree most of them are shared. Edges are sorted by the line that
 * they lie on, compared by the very doubles of the planes, and each line is swept once. */
#include "edges.h"

#include <stdlib.h>
#include <string.h>

/* One edge of one box, or one end of it: on a line along `axis` at `u` and `v` on the two other axes. */
typedef struct stretch {
    double u, v, from, to;
    uint64_t id;
    scene_look look;
    uint8_t axis, depth;
} stretch;

static stretch stretch_of(const scene_box *box, int axis, unsigned corner)
{
    const int second = (axis + 1) % 3, third = (axis + 2) % 3;
    return (stretch){
        .u = (corner & 1 ? box->box.max : box->box.min)[second],
        .v = (corner & 2 ? box->box.max : box->box.min)[third],
        .from = box->box.min[axis],
        .to = box->box.max[axis],
        .id = box->id,
        .look = box->look,
        .axis = (uint8_t)axis,
        .depth = box->depth,
    };
}

static int compare_doubles(double a, double b)
{
    return (a > b) - (a < b);
}

/* Everything but the colour: what is drawn alike on one line. */
static int compare_lines(const stretch *a, const stretch *b)
{
    const int kinds[2] = {a->look.layer << 24 | a->look.style << 16 | a->look.width << 8 | a->axis,
                          b->look.layer << 24 | b->look.style << 16 | b->look.width << 8 | b->axis};
    if (kinds[0] != kinds[1])
        return kinds[0] < kinds[1] ? -1 : 1;
    const int u = compare_doubles(a->u, b->u);
    return u ? u : compare_doubles(a->v, b->v);
}

static int compare_stretches(const void *a, const void *b)
{
    const stretch *p = a, *q = b;
    const int line = compare_lines(p, q);
    if (line)
        return line;
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
    edge *last = list->count ? &list->items[list->count - 1] : NULL;
    if (same_line && last && last->depth == of->depth && same_look(last->look, of->look) &&
        last->ends[1][of->axis] == from) {
        last->ends[1][of->axis] = to;
        return true;
    }
    edge *added = append_edge(list);
    if (!added)
        return false;
    *added = (edge){.id = of->id, .look = of->look, .depth = of->depth};
    for (int end = 0; end < 2; end++) {
        added->ends[end][of->axis] = end ? to : from;
        added->ends[end][(of->axis + 1) % 3] = of->u;
        added->ends[end][(of->axis + 2) % 3] = of->v;
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
    size_t first = 0;
    bool same_line = false;
    double at = line[0].from;
    while (first < count) {
        size_t begun = first;
        while (begun < count && line[begun].from <= at)
            begun++;
        const stretch *now = shallowest(line + first, begun - first, at);
        if (!now) {
            const bool covered = same_line && list->items[list->count - 1].ends[1][line->axis] == at;
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

/* Edges along axes of no extent are dots on others, but for a box that is a dot itself. */
static size_t collect_box(stretch *all, const scene_box *box)
{
    size_t count = 0;
    for (int axis = 0; axis < 3; axis++)
        for (unsigned corner = 0; corner < 4 && box->box.min[axis] < box->box.max[axis]; corner++)
            all[count++] = stretch_of(box, axis, corner);
    if (count == 0)
        all[count++] = stretch_of(box, 0, 0);
    return count;
}

static size_t collect(stretch *all, const scene *s)
{
    size_t count = 0;
    for (size_t i = 0; i < s->boxes.count; i++)
        count += collect_box(all + count, &s->boxes.items[i]);
    return count;
}

bool edges_merge(edge_list *list, const scene *s)
{
    list->count = 0;
    if (s->boxes.count == 0)
        return true;
    stretch *all = s->boxes.count <= SIZE_MAX / (12 * sizeof *all) ? malloc(s->boxes.count * 12 * sizeof *all) : NULL;
    if (!all)
        return false;
    const size_t count = collect(all, s);
    qsort(all, count, sizeof *all, compare_stretches);
    bool ok = true;
    for (size_t start = 0, end = 0; ok && start < count; start = end) {
        for (end = start + 1; end < count && compare_lines(&all[start], &all[end]) == 0; end++)
            ;
        ok = sweep_line(list, all + start, end - start);
    }
    free(all);
    return ok;
}
