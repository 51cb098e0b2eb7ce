/* SPDX-License-Identifier: MIT */
/* edge_boxes.c - finds the boxes that share a merged edge at a sample of the picture.
 *
 * The problem: edges.c merges the edges of many boxes into one segment, which is drawn as one stroke. `octreel pick`
 * must nevertheless name the boxes at a pixel. Listing the boxes of every merged edge would cost memory in every frame,
 * although `pick` is rare.
 *
 * The idea: compute backwards from the sample to a coordinate on the line. Then find the box edges that contain this
 * coordinate, by a binary search among all box edges sorted by line.
 *
 * From sample to line: a column (or row) of the picture is a plane through the eye. The plane divides the segment in
 * the ratio of the distances of the two ends of the segment from the plane. This is exact under perspective, where
 * equal steps on the line are not equal steps in the picture. */
#include "edge_boxes.h"
#include "project.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_edges(const void *a, const void *b)
{
    const box_edge *p = a, *q = b;
    const int lines = line_key_compare(&p->line, &q->line);
    if (lines)
        return lines;
    const int from = compare_doubles(p->from, q->from);
    return from ? from : (p->box > q->box) - (p->box < q->box);
}

static box_edge make_box_edge(const scene_box *box, size_t index, unsigned axis, unsigned corner)
{
    return (box_edge){
        .line = line_key_of_box_edge(box, axis, corner),
        .from = box->box.min[axis],
        .to = box->box.max[axis],
        .box = (uint32_t)index,
        .depth = box->depth,
    };
}

bool edge_boxes_collect_edges(edge_boxes *all, const scene *s)
{
    *all = (edge_boxes){.scene = s};
    const size_t size = 12 * sizeof *all->items;
    if (s->boxes.count == 0)
        return true;
    all->items = s->boxes.count <= SIZE_MAX / size ? malloc(s->boxes.count * size) : NULL;
    if (!all->items)
        return false;
    for (size_t i = 0; i < s->boxes.count; i++) {
        const scene_box *box = &s->boxes.items[i];
        const size_t before = all->count;
        for (unsigned axis = 0; axis < 3; axis++)
            for (unsigned corner = 0; corner < 4 && box->box.min[axis] < box->box.max[axis]; corner++)
                all->items[all->count++] = make_box_edge(box, i, axis, corner);
        if (all->count == before) /* a box that is a single point has no edges so far; it gets one edge of length 0 */
            all->items[all->count++] = make_box_edge(box, i, 0, 0);
    }
    qsort(all->items, all->count, sizeof *all->items, compare_edges);
    return true;
}

void edge_boxes_release(edge_boxes *all)
{
    free(all->items);
    *all = (edge_boxes){0};
}

/* A merged edge, and the stroke that shows the edge in the picture. */
typedef struct stroke {
    line_key line;
    double from, to;
    double seen[2][3]; /* the edge's two ends in camera coordinates */
    int across;        /* the axis of the picture along which the stroke is longer: 0 for x, 1 for y */
    bool speck;        /* true: the edge is shorter than a sample, so each sample of the stroke shows the whole edge */
} stroke;

static stroke make_edge_stroke(const scene *s, const edge *e)
{
    unsigned axis = 0;
    while (axis < 2 && e->ends[0][axis] == e->ends[1][axis])
        axis++;
    if (e->ends[0][axis] == e->ends[1][axis])
        axis = 0;
    stroke k = {
        .line = line_key_through_point(e->style, axis, e->ends[0]), .from = e->ends[0][axis], .to = e->ends[1][axis]};
    piece pieces[QUAD_BANDS];
    bool overflowed;
    const unsigned count = project_segment(s, e->ends[0], e->ends[1], pieces, &overflowed);
    if (count == 0) {
        k.speck = true;
        return k;
    }
    const double dx = fabs(pieces[count - 1].to[0] - pieces[0].from[0]);
    const double dy = fabs(pieces[count - 1].to[1] - pieces[0].from[1]);
    k.speck = dx < 1 && dy < 1;
    k.across = dy > dx;
    for (int end = 0; end < 2; end++)
        camera_transform(&s->camera, e->ends[end], k.seen[end]);
    return k;
}

/* Find the point of the edge that appears at column (or row) `pixel` of the picture. Returns the coordinate of this
 * point along the edge's line. The result is clamped to the ends of the merged edge. */
static double find_coordinate_at_pixel(const scene *s, const stroke *k, double pixel)
{
    const camera *c = &s->camera;
    const double slope = (pixel - c->middle[k->across]) / c->zoom * (k->across ? -1 : 1);
    double off[2]; /* the distance of each end of the edge from the plane through the eye and the column or row */
    for (int end = 0; end < 2; end++)
        off[end] = k->seen[end][k->across] - slope * (c->perspective ? k->seen[end][2] : 1);
    const double part = off[0] / (off[0] - off[1]);
    if (!(part > 0))
        return k->from;
    return part < 1 ? k->from * (1 - part) + k->to * part : k->to;
}

/* Returns the index of the first box edge on a line. If the line has no box edge, returns the index at which one would
 * be inserted. */
static size_t find_first_edge(const edge_boxes *all, const line_key *wanted)
{
    size_t low = 0, high = all->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (line_key_compare(&all->items[middle].line, wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Returns whether box edge number i lies on the line of a stroke and does not begin after the end of the stroke. */
static bool is_edge_on_line(const edge_boxes *all, size_t i, const stroke *k)
{
    return i < all->count && line_key_compare(&all->items[i].line, &k->line) == 0 && all->items[i].from <= k->to;
}

static double find_distance_from_edge(const box_edge *edge, double at)
{
    return at < edge->from ? edge->from - at : at > edge->to ? at - edge->to : 0;
}

size_t edge_boxes_find_owner(const edge_boxes *all, const edge *e, int x, int y)
{
    const stroke k = make_edge_stroke(all->scene, e);
    const double at = k.speck ? k.from : find_coordinate_at_pixel(all->scene, &k, (k.across ? y : x) + 0.5);
    const box_edge *best = NULL;
    for (size_t i = find_first_edge(all, &k.line); is_edge_on_line(all, i, &k); i++) {
        const box_edge *found = &all->items[i];
        const bool gives = found->depth == e->depth && all->scene->boxes.items[found->box].style.role == e->style.role;
        if (gives && found->to >= k.from &&
            (!best || find_distance_from_edge(found, at) < find_distance_from_edge(best, at)))
            best = found;
    }
    return best->box; /* `best` is not null, because every merged edge consists of edges of boxes */
}

void edge_boxes_visit_sharing(const edge_boxes *all, const edge *e, int x, int y,
                              void (*visit)(size_t box, void *context), void *context)
{
    const stroke k = make_edge_stroke(all->scene, e);
    double low = k.from, high = k.to;
    if (!k.speck) {
        const int pixel = k.across ? y : x;
        const double ends[2] = {find_coordinate_at_pixel(all->scene, &k, pixel),
                                find_coordinate_at_pixel(all->scene, &k, pixel + 1)};
        low = fmin(ends[0], ends[1]);
        high = fmax(ends[0], ends[1]);
    }
    for (size_t i = find_first_edge(all, &k.line); is_edge_on_line(all, i, &k); i++)
        if (all->items[i].from <= high && all->items[i].to >= low)
            visit(all->items[i].box, context);
}
