/* SPDX-License-Identifier: MIT */
/* polytope.c - the edges of a convex region that half-spaces cut out of a box.
 *
 * Each pair of planes meets in a line, unless they are parallel. All other half-spaces clip this line; what is left is
 * an edge. With at most 14 planes these are 91 lines, each clipped 12 times, so no faster method is needed.
 *
 * The box is mapped to [-1, 1] on each axis and the normals are scaled, so that nothing overflows in any world.
 */
#include "polytope.h"

#include <math.h>
#include <string.h>

/* Positions are this precise, and lines shorter than this are no edges. */
#define PRECISION 1e-12

typedef struct plane {
    double normal[3]; /* of length 1 */
    double offset;
} plane;

typedef struct line {
    double origin[3], direction[3];
} line;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double product[3])
{
    for (int i = 0; i < 3; i++)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Map a half-space to the box [-1, 1]. The largest part of the normal becomes 1 first. */
static plane map_half_space(const octree_half_space *space, const double center[3], const double half[3])
{
    plane p;
    const double largest = fmax(fmax(fabs(space->normal[0]), fabs(space->normal[1])), fabs(space->normal[2]));
    p.offset = space->offset / largest;
    for (int i = 0; i < 3; i++) {
        p.normal[i] = space->normal[i] / largest;
        p.offset -= p.normal[i] * center[i];
    }
    const double size = fmax(fmax(half[0], half[1]), half[2]);
    for (int i = 0; i < 3; i++)
        p.normal[i] *= half[i] / size;
    p.offset /= size;
    const double length = sqrt(dot(p.normal, p.normal));
    for (int i = 0; i < 3; i++)
        p.normal[i] /= length;
    p.offset /= length;
    return p;
}

/* Find the line in which two planes meet. Returns false if they are parallel. */
static bool find_line(const plane *a, const plane *b, line *l)
{
    double along_b[3], along_a[3];
    cross(a->normal, b->normal, l->direction);
    const double square = dot(l->direction, l->direction);
    if (!(square > PRECISION))
        return false;
    cross(b->normal, l->direction, along_b);
    cross(l->direction, a->normal, along_a);
    for (int i = 0; i < 3; i++) {
        l->origin[i] = (a->offset * along_b[i] + b->offset * along_a[i]) / square;
        l->direction[i] /= sqrt(square);
    }
    return true;
}

/* Clip the part from *first to *last of a line by a half-space. */
static void clip_line(const line *l, const plane *p, double *first, double *last)
{
    const double steep = dot(p->normal, l->direction), room = p->offset - dot(p->normal, l->origin);
    if (fabs(steep) <= PRECISION)
        *last = room < -PRECISION ? *first : *last; /* the line is parallel: all of it is inside or outside */
    else if (steep > 0)
        *last = fmin(*last, room / steep);
    else
        *first = fmax(*first, room / steep);
}

static bool find_edge(const plane *planes, unsigned count, unsigned a, unsigned b, line *l, double ends[2])
{
    if (!find_line(&planes[a], &planes[b], l))
        return false;
    ends[0] = -4; /* all lines leave the box before: its diagonal is shorter than 4 */
    ends[1] = 4;
    for (unsigned i = 0; i < count; i++)
        if (i != a && i != b)
            clip_line(l, &planes[i], &ends[0], &ends[1]);
    return ends[1] - ends[0] > PRECISION;
}

/* Make the planes of the box [-1, 1] and of the half-spaces. Returns their number. */
static unsigned make_planes(const octree_frustum *frustum, const double center[3], const double half[3],
                            plane planes[POLYTOPE_PLANES])
{
    memset(planes, 0, POLYTOPE_PLANES * sizeof *planes);
    for (int i = 0; i < 6; i++) {
        planes[i].normal[i / 2] = i % 2 ? 1 : -1;
        planes[i].offset = 1;
    }
    for (size_t i = 0; i < frustum->count; i++)
        planes[6 + i] = map_half_space(&frustum->half_spaces[i], center, half);
    return 6 + (unsigned)frustum->count;
}

size_t polytope_find_edges(const octree_box *box, const octree_frustum *frustum, polytope_edge edges[POLYTOPE_EDGES])
{
    plane planes[POLYTOPE_PLANES];
    double center[3], half[3], ends[2];
    size_t found = 0;
    line l;
    for (int i = 0; i < 3; i++) {
        center[i] = box->min[i] / 2 + box->max[i] / 2;
        half[i] = box->max[i] / 2 - box->min[i] / 2;
    }
    const unsigned count = make_planes(frustum, center, half, planes);
    for (unsigned b = 6; b < count; b++)
        for (unsigned a = 0; a < b; a++) {
            if (!find_edge(planes, count, a, b, &l, ends))
                continue;
            polytope_edge *edge = &edges[found++];
            *edge = (polytope_edge){.planes = {a, b}};
            for (int side = 0; side < 2; side++)
                for (int i = 0; i < 3; i++)
                    edge->ends[side][i] = center[i] + half[i] * (l.origin[i] + ends[side] * l.direction[i]);
        }
    return found;
}
