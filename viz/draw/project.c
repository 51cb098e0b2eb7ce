/* SPDX-License-Identifier: MIT */
/* project.c - projects points and segments of the world into the picture, in double precision.
 *
 * GL would transform in single precision: a scene at coordinates of 1e15 would collapse, and the last bits would depend
 * on the CPU. So this file converts positions to camera coordinates, without cancelling digits, and then to pixels;
 * rasterizers receive only pixels.
 *
 * A segment is clipped in camera space to the space in front of the eye, because a perspective division needs a
 * positive depth. It is then cut at the planes between the eight bands of depth; a band has one shade and one place in
 * painter's order. Each piece is projected and clipped to the picture plus a margin, so that its coordinates fit 32-bit
 * integers. A cut is the weighted mean of both ends, never a + t * (b - a): with one end at 1e300, the difference would
 * lose all digits of the other end.
 *
 * A scene may have many points. project_points() therefore handles RUN points at once, in loops without branches, which
 * compilers turn into vector instructions. */
#include "project.h"

#include <math.h>
#include <string.h>

/* Segments are clipped at this distance in pixels outside the picture, so that the ends of a clipped segment are not
 * visible. */
#define CLIP_MARGIN 64.0

/* Larger camera coordinates could overflow when they are projected. */
#define FARTHEST 1e301

scene project_scene_to_samples(const scene *s)
{
    scene fine = *s;
    const int samples = s->view.aa;
    fine.view.width *= samples;
    fine.view.height *= samples;
    fine.camera.zoom *= samples;
    fine.camera.middle[0] *= samples;
    fine.camera.middle[1] *= samples;
    return fine;
}

/* Returns the position of a view depth among the bands, from 0 at the nearest depth of the world to QUAD_BANDS at its
 * farthest depth. */
static double compute_band_coordinate(const camera *c, double depth)
{
    const double span = c->far_depth - c->near_depth;
    return span > 0 ? (depth - c->near_depth) / span * QUAD_BANDS : 0;
}

static unsigned round_to_band(double position)
{
    if (!(position >= 0))
        return 0;
    return position < QUAD_BANDS ? (unsigned)position : QUAD_BANDS - 1;
}

/* Find the point of the segment from a to b at which a linear function is zero. at_a and at_b are the function's values
 * at a and b, with opposite signs. */
static void find_zero_crossing(const double a[3], const double b[3], double at_a, double at_b, double result[3])
{
    const double whole = at_b / 2 - at_a / 2;
    const double of_a = at_b / 2 / whole, of_b = -(at_a / 2) / whole;
    for (int i = 0; i < 3; i++)
        result[i] = a[i] * of_a + b[i] * of_b;
}

/* Remove the part of a segment whose coordinate on `axis` is less than the bound (side 1) or greater than the bound
 * (side -1). Returns false if nothing of the segment is left. */
static bool clip_to_side(double a[3], double b[3], int axis, double side, double bound)
{
    const double at_a = side * (a[axis] - bound), at_b = side * (b[axis] - bound);
    if (at_a < 0 && at_b < 0)
        return false;
    if (at_a < 0 || at_b < 0) {
        double *outer = at_a < 0 ? a : b, crossing[3];
        find_zero_crossing(a, b, at_a, at_b, crossing);
        crossing[axis] = bound; /* set the coordinate to exactly the bound, without a rounding error */
        memcpy(outer, crossing, sizeof crossing);
    }
    return true;
}

static bool is_within_clip_margin(const view *v, const double pixel[2])
{
    return pixel[0] >= -CLIP_MARGIN && pixel[0] <= v->width + CLIP_MARGIN && pixel[1] >= -CLIP_MARGIN &&
           pixel[1] <= v->height + CLIP_MARGIN;
}

/* Clip a projected piece to the picture with its margin. Returns false if nothing of the piece is left. Most pieces lie
 * inside and stay unchanged. */
static bool clip_to_picture(const view *v, piece *p)
{
    if (is_within_clip_margin(v, p->from) && is_within_clip_margin(v, p->to))
        return true;
    double a[3] = {p->from[0], p->from[1], 0}, b[3] = {p->to[0], p->to[1], 0};
    const double size[2] = {v->width, v->height};
    for (int axis = 0; axis < 2; axis++)
        if (!clip_to_side(a, b, axis, 1, -CLIP_MARGIN) || !clip_to_side(a, b, axis, -1, size[axis] + CLIP_MARGIN))
            return false;
    /* Clamp the new ends to the limits: rounding may move a weighted mean of two numbers outside the interval between
     * them. */
    for (int axis = 0; axis < 2; axis++) {
        p->from[axis] = fmin(fmax(a[axis], -CLIP_MARGIN), size[axis] + CLIP_MARGIN);
        p->to[axis] = fmin(fmax(b[axis], -CLIP_MARGIN), size[axis] + CLIP_MARGIN);
    }
    return true;
}

/* Cut a segment in camera coordinates at the planes between bands of depth. The pieces are ordered from end a to end b.
 * Returns the number of pieces. */
static unsigned cut_into_bands(const scene *s, const double a[3], const double b[3], piece pieces[QUAD_BANDS])
{
    const double first = compute_band_coordinate(&s->camera, a[2]), last = compute_band_coordinate(&s->camera, b[2]);
    const int step = first < last ? 1 : -1, last_band = (int)round_to_band(last);
    unsigned count = 0;
    double from[3], to[3];
    memcpy(from, a, sizeof from);
    for (int band = (int)round_to_band(first);; band += step) {
        const double plane = step > 0 ? band + 1 : band;
        if (band == last_band)
            memcpy(to, b, sizeof to);
        else
            find_zero_crossing(a, b, first - plane, last - plane, to);
        piece *p = &pieces[count];
        p->band = (unsigned)band;
        camera_project(&s->camera, from, p->from);
        camera_project(&s->camera, to, p->to);
        count += clip_to_picture(&s->view, p);
        if (band == last_band)
            return count;
        memcpy(from, to, sizeof from);
    }
}

static bool is_within_limits(double x, double y, double depth)
{
    return fabs(x) < FARTHEST && fabs(y) < FARTHEST && fabs(depth) < FARTHEST;
}

/* Transform a position to camera coordinates. Returns false if later computations with these coordinates could
 * overflow. */
static bool transform_to_camera(const scene *s, const double position[3], double seen[3])
{
    camera_transform(&s->camera, position, seen);
    return is_within_limits(seen[0], seen[1], seen[2]);
}

unsigned project_segment(const scene *s, const double first[3], const double second[3], piece pieces[QUAD_BANDS],
                         bool *overflowed)
{
    double a[3], b[3];
    *overflowed = !transform_to_camera(s, first, a) || !transform_to_camera(s, second, b);
    if (*overflowed)
        return 0;
    if (s->camera.perspective && !clip_to_side(a, b, 2, 1, s->camera.near))
        return 0;
    if (s->camera.clips_depth &&
        !(clip_to_side(a, b, 2, 1, s->camera.near_depth) && clip_to_side(a, b, 2, -1, s->camera.far_depth)))
        return 0;
    return cut_into_bands(s, a, b, pieces);
}

bool clip_picture_segment(const scene *s, const double from[3], const double to[3], piece *p)
{
    const int samples = s->view.aa;
    p->band = 0;
    for (int axis = 0; axis < 2; axis++) {
        p->from[axis] = from[axis] * samples;
        p->to[axis] = to[axis] * samples;
    }
    return clip_to_picture(&s->view, p);
}

unsigned find_depth_band(const camera *c, double depth)
{
    return round_to_band(compute_band_coordinate(c, depth));
}

static bool is_at_visible_depth(const camera *c, double depth)
{
    return !(c->perspective && depth < c->near) &&
           (!c->clips_depth || (depth >= c->near_depth && depth <= c->far_depth));
}

bool find_pixel_and_depth(const scene *s, const double position[3], double pixel[2], double *depth)
{
    double seen[3];
    const camera *c = &s->camera;
    if (!transform_to_camera(s, position, seen) || !is_at_visible_depth(c, seen[2]))
        return false;
    camera_project(&s->camera, seen, pixel);
    *depth = seen[2];
    return pixel[0] >= -CLIP_MARGIN && pixel[0] < s->view.width + CLIP_MARGIN && pixel[1] >= -CLIP_MARGIN &&
           pixel[1] < s->view.height + CLIP_MARGIN;
}

/* The number of points that are projected at once. With 16 points, compilers unroll the loops below instead of
 * vectorizing them. */
#define RUN 64

typedef struct point_run {
    double from_eye[3][RUN];
    /* for each point: its camera coordinates, as camera_transform() computes them */
    double across[RUN], along[RUN], depth[RUN];
    /* for each point: its pixel (x, y), and its position among the bands from compute_band_coordinate() */
    double x[RUN], y[RUN], band[RUN];
    double seen[RUN]; /* not 0: the point is visible in the picture */
} point_run;

static void project_onto_axis(const point_run *run, const double axis[3], double seen[RUN])
{
    double turned[RUN];
    for (int i = 0; i < RUN; i++)
        turned[i] = (run->from_eye[0][i] * axis[0] + run->from_eye[1][i] * axis[1]) + run->from_eye[2][i] * axis[2];
    memcpy(seen, turned, sizeof turned);
}

/* Set `seen` of each point that is_within_limits() and is_at_visible_depth() accept and whose pixel is in the
 * picture. */
static void find_visible_points(const scene *s, point_run *run)
{
    const camera *c = &s->camera;
    const double width = s->view.width, height = s->view.height;
    double first = c->perspective ? c->near : -FARTHEST, last = FARTHEST;
    if (c->clips_depth) {
        first = c->near_depth > first ? c->near_depth : first;
        last = c->far_depth;
    }
    for (int i = 0; i < RUN; i++) {
        double seen = run->x[i] >= 0 ? 1 : 0;
        seen = run->x[i] < width ? seen : 0;
        seen = run->y[i] >= 0 ? seen : 0;
        seen = run->y[i] < height ? seen : 0;
        seen = fabs(run->across[i]) < FARTHEST ? seen : 0;
        seen = fabs(run->along[i]) < FARTHEST ? seen : 0;
        seen = fabs(run->depth[i]) < FARTHEST ? seen : 0;
        seen = run->depth[i] >= first ? seen : 0;
        run->seen[i] = run->depth[i] <= last ? seen : 0;
    }
}

static void project_point_run(const scene *s, point_run *run)
{
    const camera c = s->camera; /* a copy of the camera, so that the compiler knows that no write below changes the
                                 * camera */
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < RUN; i++)
            run->from_eye[axis][i] = camera_to_unit_coordinate(&c, axis, run->from_eye[axis][i]) - c.eye[axis];
    project_onto_axis(run, c.right, run->across);
    project_onto_axis(run, c.up, run->along);
    project_onto_axis(run, c.forward, run->depth);
    for (int i = 0; i < RUN; i++) {
        const double scale = c.perspective ? c.zoom / run->depth[i] : c.zoom;
        run->x[i] = c.middle[0] + run->across[i] * scale;
        run->y[i] = c.middle[1] - run->along[i] * scale;
    }
    for (int i = 0; i < RUN; i++)
        run->band[i] = compute_band_coordinate(&c, run->depth[i]);
    find_visible_points(s, run);
}

/* Copy the positions of `count` markers into the run. If there are fewer than RUN markers, copies of the first marker
 * fill the remaining entries. */
static void gather_positions(const scene_marker *markers, size_t count, point_run *run)
{
    for (size_t i = 0; i < RUN; i++) {
        const double *at = markers[i < count ? i : 0].at;
        run->from_eye[0][i] = at[0];
        run->from_eye[1][i] = at[1];
        run->from_eye[2][i] = at[2];
    }
}

static point_place make_point_place(const scene *s, const point_run *run, size_t i)
{
    if (run->seen[i] == 0)
        return (point_place){.seen = false};
    return (point_place){.pixel = (uint32_t)run->y[i] * (uint32_t)s->view.width + (uint32_t)run->x[i],
                         .band = (uint8_t)round_to_band(run->band[i]),
                         .seen = true};
}

void project_points(const scene *s, const scene_marker *markers, size_t count, point_place *places)
{
    for (size_t first = 0; first < count; first += RUN) {
        point_run run;
        const size_t size = count - first < RUN ? count - first : RUN;
        gather_positions(markers + first, size, &run);
        project_point_run(s, &run);
        for (size_t i = 0; i < size; i++)
            places[first + i] = make_point_place(s, &run, i);
    }
}

bool find_pixel_and_band(const scene *s, const double position[3], double pixel[2], unsigned *band)
{
    double depth;
    if (!find_pixel_and_depth(s, position, pixel, &depth))
        return false;
    *band = find_depth_band(&s->camera, depth);
    return true;
}
