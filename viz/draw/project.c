/* project.c - see project.h. */
#include "project.h"

#include <math.h>

/* Pixels that a clipped line may reach beyond the picture, so that its ends are not seen. */
#define CLIP_MARGIN 64.0

/* A depth in bands from the near side of the world, not yet rounded: a real number in 0..QUAD_BANDS for what is in it. */
static double band_position(const camera *c, double depth)
{
    const double span = c->far_depth - c->near_depth;
    return span > 0 ? (depth - c->near_depth) / span * QUAD_BANDS : 0;
}

static unsigned band_of(double position)
{
    if (!(position >= 0))
        return 0;
    return position < QUAD_BANDS ? (unsigned)position : QUAD_BANDS - 1;
}

/* The part [*from, *to] of a segment on which start + t * slope >= 0. */
static void clip(double start, double slope, double *from, double *to)
{
    if (slope == 0) {
        if (start < 0)
            *to = -1;
        return;
    }
    const double t = -start / slope;
    if (slope > 0)
        *from = t > *from ? t : *from;
    else
        *to = t < *to ? t : *to;
}

static void interpolate(const double a[], const double b[], double t, int count, double result[])
{
    for (int i = 0; i < count; i++)
        result[i] = t == 1 ? b[i] : a[i] + t * (b[i] - a[i]);
}

/* Clip a projected piece to the picture. False when nothing is left. */
static bool clip_to_picture(const view *v, piece *p)
{
    double from = 0, to = 1;
    const double size[2] = {v->width, v->height}, a[2] = {p->from[0], p->from[1]}, b[2] = {p->to[0], p->to[1]};
    for (int i = 0; i < 2; i++) {
        clip(a[i] + CLIP_MARGIN, b[i] - a[i], &from, &to);
        clip(size[i] + CLIP_MARGIN - a[i], a[i] - b[i], &from, &to);
    }
    if (!(from <= to))
        return false;
    interpolate(a, b, from, 2, p->from);
    interpolate(a, b, to, 2, p->to);
    return true;
}

/* Cut camera coordinates at the planes between bands, from the first end to the second. */
static unsigned cut(const scene *s, const double a[3], const double b[3], piece pieces[QUAD_BANDS])
{
    const double first = band_position(&s->camera, a[2]), last = band_position(&s->camera, b[2]);
    const int step = first < last ? 1 : -1;
    unsigned count = 0;
    double at = 0;
    for (int band = (int)band_of(first);; band += step) {
        const double plane = step > 0 ? band + 1 : band;
        const bool ends_here = band == (int)band_of(last);
        const double next = ends_here ? 1 : (plane - first) / (last - first);
        double from[3], to[3];
        interpolate(a, b, at, 3, from);
        interpolate(a, b, next, 3, to);
        piece *p = &pieces[count];
        p->band = (unsigned)band;
        camera_project(&s->camera, from, p->from);
        camera_project(&s->camera, to, p->to);
        count += clip_to_picture(&s->view, p);
        if (ends_here)
            return count;
        at = next;
    }
}

static bool see(const scene *s, const double position[3], double seen[3])
{
    camera_transform(&s->camera, position, seen);
    return isfinite(seen[0]) && isfinite(seen[1]) && isfinite(seen[2]);
}

unsigned project_segment(const scene *s, const double first[3], const double second[3], piece pieces[QUAD_BANDS],
                         bool *overflowed)
{
    double a[3], b[3];
    *overflowed = !see(s, first, a) || !see(s, second, b);
    if (*overflowed)
        return 0;
    if (!s->camera.perspective)
        return cut(s, a, b, pieces);
    double from = 0, to = 1, clipped[2][3];
    clip(a[2] - s->camera.near, b[2] - a[2], &from, &to);
    if (!(from <= to))
        return 0;
    interpolate(a, b, from, 3, clipped[0]);
    interpolate(a, b, to, 3, clipped[1]);
    for (int end = 0; end < 2; end++) /* rounding must not leave an end behind the plane */
        if (clipped[end][2] < s->camera.near)
            clipped[end][2] = s->camera.near;
    return cut(s, clipped[0], clipped[1], pieces);
}

bool project_point(const scene *s, const double position[3], double pixel[2], unsigned *band)
{
    double seen[3];
    if (!see(s, position, seen) || (s->camera.perspective && seen[2] < s->camera.near))
        return false;
    camera_project(&s->camera, seen, pixel);
    *band = band_of(band_position(&s->camera, seen[2]));
    return pixel[0] >= -CLIP_MARGIN && pixel[0] < s->view.width + CLIP_MARGIN && pixel[1] >= -CLIP_MARGIN &&
           pixel[1] < s->view.height + CLIP_MARGIN;
}
