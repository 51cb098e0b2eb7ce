/* SPDX-License-Identifier: MIT */
/* camera.c - computes cameras and projects positions; see camera.h. The only functions of libm in use are sqrt, fabs,
 * floor, fmod and fmax. The results of these functions are exact or correctly rounded, so every machine computes the
 * same camera. */
#include "camera.h"
#include "filter.h"
#include "octree/octree.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The camera zooms so that the window is this many times as large as the framed box in the picture. The margin is room
 * for labels. */
#define MARGIN 1.1
/* the least extent of the framed box, in unit coordinates, that find_zoom() and find_orbit_zoom() assume, so that the
 * zoom is limited */
#define THINNEST 1e-3
#define ORBIT_TICKS 480 /* the number of ticks in which the orbiting camera turns once */
#define FOCAL 1.6       /* the focal length of the camera that follows the player, in units of half the window's size */

/* Limits of the fast path of is_perspective_box_smaller_than(). ASIDE: the greatest distance of a box from the view
 * axis, divided by the box's depth. FARTHEST: the greatest depth. Within these limits, rounding errors stay below
 * ROUNDING pixels. */
#define ASIDE 1e3
#define FARTHEST 1e100
#define ROUNDING 1e-6

/* Compute the cosine and sine of an angle in [0, pi/4] from their Taylor series. In this range, eight terms are enough
 * for the precision of a double. */
static void compute_octant_cosine_sine(double angle, double *cosine, double *sine)
{
    const double square = angle * angle;
    double c = 1, s = 1;
    for (int k = 16; k >= 2; k -= 2) {
        c = 1 - square / (k * (k - 1)) * c;
        s = 1 - square / (k * (k + 1)) * s;
    }
    *cosine = c;
    *sine = angle * s;
}

void camera_compute_cosine_sine(double turns, double *cosine, double *sine)
{
    const double whole = floor(turns * 4 + 0.5); /* the number of quarter turns, rounded to an integer */
    double c, s;
    compute_octant_cosine_sine(fabs(turns * 4 - whole) * 1.5707963267948966, &c, &s);
    s = turns * 4 < whole ? -s : s;
    /* The cosine after 0, 1, 2 and 3 quarter turns. The sine equals the cosine one quarter turn earlier. */
    const double cosines[4] = {c, -s, -c, s};
    const int quarter = (int)fmod(whole, 4) + 4;
    *cosine = cosines[quarter % 4];
    *sine = cosines[(quarter + 3) % 4];
}

/* Set the camera's axes from two angles in turns. The azimuth is the direction of view: 0 is +y, and the angle grows to
 * the left. The elevation is the angle of the eye above the horizon. */
static void set_axes(camera *c, double azimuth, double elevation)
{
    double ca, sa, ce, se;
    camera_compute_cosine_sine(azimuth, &ca, &sa);
    camera_compute_cosine_sine(elevation, &ce, &se);
    memcpy(c->right, (double[3]){ca, sa, 0}, sizeof c->right);
    memcpy(c->up, (double[3]){-sa * se, ca * se, ce}, sizeof c->up);
    memcpy(c->forward, (double[3]){-sa * ce, ca * ce, -se}, sizeof c->forward);
}

/* Place the eye behind a target, at a distance from the target. Target and distance are in unit coordinates. */
static void place_eye(camera *c, const double target[3], double distance)
{
    for (int i = 0; i < 3; i++)
        c->eye[i] = target[i] - distance * c->forward[i];
}

/* Returns half the extent of a box along an axis of the camera. `half` has the box's half sizes along the world's
 * axes. */
static double find_half_span(const double axis[3], const double half[3])
{
    return (fabs(axis[0]) * half[0] + fabs(axis[1]) * half[1]) + fabs(axis[2]) * half[2];
}

static const struct {
    double azimuth, elevation; /* the camera's direction of view: angles in turns */
    bool perspective;
} cameras[CAMERA_COUNT] = {
    /* This is not the true isometric view, in which a cube's nearest corner hides its farthest corner. */
    [CAMERA_ISO] = {30.0 / 360, 22.0 / 360, false},
    [CAMERA_TOP] = {0, 0.25, false},
    [CAMERA_FRONT] = {0, 0, false},
    [CAMERA_SIDE] = {0.25, 0, false},
    [CAMERA_FOLLOW] = {30.0 / 360, 22.0 / 360, true},
    [CAMERA_ORBIT] = {30.0 / 360, 22.0 / 360, true},
};

/* Returns the zoom of the orbiting camera. The box turns about its vertical axis, and the zoom must be the same in
 * every tick. So this function fits the vertical cylinder around the box into the window.
 *
 * A rim of the cylinder appears widest where a line of sight touches the rim. The highest and lowest points of a rim in
 * the picture are its nearest and farthest points. In perspective the cylinder reaches farther down than up from the
 * view axis: *lift becomes the shift in pixels that centres the cylinder. */
static double find_orbit_zoom(const camera *c, camera_window window, double *lift)
{
    const double radius = sqrt(c->half[0] * c->half[0] + c->half[1] * c->half[1]), rise = c->up[2];
    const double fall = -c->forward[2];
    /* extents of the cylinder from the view axis: to both sides, up and down, at distance 1 */
    double across = THINNEST, up = THINNEST, down = THINNEST;
    for (int top = -1; top <= 1; top += 2) {
        const double height = top * c->half[2], depth = c->distance - height * fall;
        across = fmax(across, radius / sqrt(depth * depth - radius * radius * rise * rise));
        for (int near = -1; near <= 1; near += 2) {
            const double y = (height * rise - near * radius * fall) / (depth - near * radius * rise);
            up = fmax(up, y);
            down = fmax(down, -y);
        }
    }
    const double x = window.width / (2 * MARGIN * across), y = window.height / (MARGIN * (up + down));
    const double zoom = x < y ? x : y;
    *lift = (down - up) / 2 * zoom;
    return zoom;
}

/* Returns the zoom of an orthographic camera at which the framed box just fits into the window. */
static double find_zoom(const camera *c, camera_window window)
{
    const double across = fmax(find_half_span(c->right, c->half), THINNEST),
                 along = fmax(find_half_span(c->up, c->half), THINNEST);
    const double x = window.width / (2 * MARGIN * across), y = window.height / (2 * MARGIN * along);
    return x < y ? x : y;
}

static void set_framed_box(camera *c, const octree_box *world)
{
    double extent[3];
    c->scale = 1;
    for (int i = 0; i < 3; i++)
        if (!isfinite(world->max[i] - world->min[i]))
            c->scale = 0.5;
    for (int i = 0; i < 3; i++) {
        c->origin[i] = world->min[i] * c->scale;
        extent[i] = world->max[i] * c->scale - c->origin[i];
        c->size = extent[i] > c->size ? extent[i] : c->size;
    }
    for (int i = 0; i < 3; i++)
        c->half[i] = extent[i] / c->size;
}

camera camera_make(const view *v, camera_window window, const octree_box *world, const double player[3], uint64_t tick)
{
    const bool follows = v->camera == CAMERA_FOLLOW && (v->center.given || player);
    camera c = {.perspective = cameras[v->camera].perspective, .follows = follows, .near = 0.02};
    set_framed_box(&c, v->fit == FIT_BOX ? &v->focus : world);
    const bool placed = v->center.given || follows;
    const double orbit = v->camera == CAMERA_ORBIT ? (double)(tick % ORBIT_TICKS) / ORBIT_TICKS : 0;
    set_axes(&c, v->look.given ? v->look.azimuth / 360 : cameras[v->camera].azimuth + orbit,
             v->look.given ? v->look.elevation / 360 : cameras[v->camera].elevation);
    c.distance = follows ? 1 : 4.2;
    double target[3] = {0, 0, 0}, lift = 0;
    for (int i = 0; i < 3; i++)
        c.center[i] = v->center.given ? v->center.place[i]
                      : placed        ? player[i]
                                      : (c.origin[i] + c.half[i] * c.size / 2) / c.scale;
    if (placed)
        camera_to_unit_coordinates(&c, c.center, target);
    const double smaller = window.width < window.height ? window.width : window.height;
    c.zoom = follows ? FOCAL * smaller / 2 : c.perspective ? find_orbit_zoom(&c, window, &lift) : find_zoom(&c, window);
    c.zoom *= v->zoom;
    place_eye(&c, target, c.distance);
    c.middle[0] = window.x + window.width / 2;
    c.middle[1] = window.y + window.height / 2 - (placed ? 0 : lift);
    const double middle = -dot_product(c.eye, c.forward), span = find_half_span(c.forward, c.half);
    c.near_depth = middle - span > c.near ? middle - span : c.near;
    c.far_depth = middle + span;
    return c;
}

/* Returns the number of pixels per unit of length in unit coordinates, at the camera's center. */
static double zoom_at_center(const camera *c)
{
    return c->perspective ? c->zoom / c->distance : c->zoom;
}

double camera_world_length_of_pixel(const camera *c)
{
    return c->size / 2 / c->scale / zoom_at_center(c);
}

camera camera_make_close_up(const camera *c, camera_window window, const double place[3], double times)
{
    camera close = *c;
    double target[3];
    camera_to_unit_coordinates(c, place, target);
    memcpy(close.center, place, sizeof close.center);
    close.zoom *= times;
    place_eye(&close, target, c->distance);
    close.middle[0] = window.x + window.width / 2;
    close.middle[1] = window.y + window.height / 2;
    const double reach = (window.width > window.height ? window.width : window.height) / 2 / zoom_at_center(&close);
    close.near_depth = fmax(c->distance - reach, c->near);
    close.far_depth = c->distance + reach;
    close.clips_depth = true;
    return close;
}

bool camera_find_pixel(const camera *c, const double position[3], double pixel[2])
{
    double seen[3];
    camera_transform(c, position, seen);
    if (c->perspective && !(seen[2] >= c->near))
        return false;
    camera_project(c, seen, pixel);
    return isfinite(pixel[0]) && isfinite(pixel[1]);
}

/* Returns the least depth of the corners of a box, or 0, the depth of the eye, if that is less. */
static double find_least_depth(const camera *c, const octree_box *box)
{
    double least = 0;
    for (unsigned corner = 0; corner < 8; corner++) {
        double position[3], seen[3];
        box_corner(box, corner, position);
        camera_transform(c, position, seen);
        least = fmin(least, seen[2]);
    }
    return least;
}

void camera_find_ray(const camera *c, const double pixel[2], const octree_box *world, double origin[3],
                     double direction[3])
{
    const double right = (pixel[0] - c->middle[0]) / c->zoom, up = (c->middle[1] - pixel[1]) / c->zoom;
    const double depth = c->perspective ? 0 : find_least_depth(c, world);
    const double aside = c->perspective ? 0 : 1; /* parallel rays begin beside each other, others spread */
    double ahead[3];
    for (int i = 0; i < 3; i++) {
        const double across = c->right[i] * right + c->up[i] * up;
        const double begin = c->eye[i] + across * aside + c->forward[i] * depth;
        origin[i] = ((begin + c->half[i]) * (c->size / 2) + c->origin[i]) / c->scale;
        ahead[i] = c->forward[i] + across * (1 - aside);
    }
    const double length = sqrt(dot_product(ahead, ahead));
    for (int i = 0; i < 3; i++)
        direction[i] = ahead[i] / length;
}

/* Returns the size of a box on screen under orthographic projection, where the size does not depend on the position. */
static double find_orthographic_box_size(const camera *c, const octree_box *box)
{
    double half[3];
    for (int i = 0; i < 3; i++)
        half[i] = (box->max[i] * c->scale - box->min[i] * c->scale) / c->size;
    return 2 * c->zoom * fmax(find_half_span(c->right, half), find_half_span(c->up, half));
}

double camera_box_size_in_pixels(const camera *c, const octree_box *box)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    if (!c->perspective)
        return find_orthographic_box_size(c, box);
    for (unsigned corner = 0; corner < 8; corner++) {
        double position[3], seen[3], pixel[2];
        box_corner(box, corner, position);
        camera_transform(c, position, seen);
        if (!(seen[2] >= c->near))
            return INFINITY;
        camera_project(c, seen, pixel);
        for (int i = 0; i < 2; i++) {
            low[i] = pixel[i] < low[i] ? pixel[i] : low[i];
            high[i] = pixel[i] > high[i] ? pixel[i] : high[i];
        }
    }
    return fmax(high[0] - low[0], high[1] - low[1]);
}

/* Returns whether a box appears smaller than `pixels` under perspective. Let (x, y, depth) be the camera coordinates of
 * the box's middle. A corner at offset d from the middle is projected at this distance in x from the middle's pixel,
 * and likewise in y:
 *
 *   zoom (d.right - x / depth d.forward) / (depth + d.forward)
 *
 * The absolute value of the numerator is largest at two opposite corners. The denominator lies between the depths of
 * the nearest and the farthest corner. Numerator and denominator give a lower and an upper bound of the box's size on
 * screen. For a small box the two bounds are nearly equal, so that one of the bounds usually decides the result.
 *
 * Rounding errors are far below ROUNDING if no corner is beside or behind the eye. */
static bool is_perspective_box_smaller_than(const camera *c, const octree_box *box, double pixels)
{
    double middle[3], half[3], across = 0, along = 0;
    const double per_unit = 1 / c->size;
    for (int i = 0; i < 3; i++) {
        const double low = box->min[i] * c->scale - c->origin[i], high = box->max[i] * c->scale - c->origin[i];
        middle[i] = (low + high) * per_unit - c->half[i] - c->eye[i];
        half[i] = (high - low) * per_unit;
    }
    const double x = dot_product(middle, c->right), y = dot_product(middle, c->up),
                 depth = dot_product(middle, c->forward);
    const double reach = find_half_span(c->forward, half), most = ASIDE * depth, slack = ROUNDING * (1 + pixels);
    const bool before = depth - reach > 2 * c->near && depth < FARTHEST && fabs(x) < most && fabs(y) < most;
    if (!before)
        return camera_box_size_in_pixels(c, box) < pixels;
    for (int i = 0; i < 3; i++) {
        across += fabs(c->right[i] * depth - x * c->forward[i]) * half[i];
        along += fabs(c->up[i] * depth - y * c->forward[i]) * half[i];
    }
    const double widest = 2 * c->zoom * (across > along ? across : along);
    if (widest < (pixels - slack) * (depth - reach) * depth)
        return true;
    return !(widest > (pixels + slack) * (depth + reach) * depth) && camera_box_size_in_pixels(c, box) < pixels;
}

bool camera_is_box_smaller_than(const camera *c, const octree_box *box, double pixels)
{
    return c->perspective ? is_perspective_box_smaller_than(c, box, pixels)
                          : find_orthographic_box_size(c, box) < pixels;
}

/* ---- Framing points ------------------------------------------------------------------------------------------ */

/* The least extent of a fitted box on an axis, as a part of the box's longest side. So there is some space around
 * points that all lie on a line or a plane. */
#define THINNEST_FIT (1.0 / 16)

typedef struct bounds {
    const view_filter *filter;
    octree_box world, box;
    size_t count;
} bounds;

static void include_point(bounds *b, const double position[3])
{
    for (int i = 0; i < 3; i++) {
        b->box.min[i] = b->count == 0 || position[i] < b->box.min[i] ? position[i] : b->box.min[i];
        b->box.max[i] = b->count == 0 || position[i] > b->box.max[i] ? position[i] : b->box.max[i];
    }
    b->count++;
}

static octree_walk_order include_shown_points(const octree_node *node, void *context)
{
    bounds *b = context;
    if (!filter_shows_subtree(b->filter, &b->world, node))
        return OCTREE_WALK_SKIP;
    if (!node->leaf || !filter_shows_points_of(b->filter, &b->world, node))
        return OCTREE_WALK_ON;
    for (size_t i = 0; i < node->count; i++)
        if (filter_shows_point(b->filter, node->points[i].position))
            include_point(b, node->points[i].position);
    return OCTREE_WALK_ON;
}

/* Returns half of a box's extent on an axis. The whole extent could overflow. */
static double half_extent(const octree_box *box, int axis)
{
    return box->max[axis] / 2 - box->min[axis] / 2;
}

static void widen_thin_sides(octree_box *box)
{
    double longest = 0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, half_extent(box, i));
    for (int i = 0; i < 3; i++) {
        const double slack = longest * THINNEST_FIT - half_extent(box, i);
        if (slack <= 0)
            continue;
        box->min[i] = fmax(box->min[i] - slack, -DBL_MAX);
        box->max[i] = fmin(box->max[i] + slack, DBL_MAX);
    }
}

static bool is_single_position(const octree_box *box)
{
    return box->min[0] == box->max[0] && box->min[1] == box->max[1] && box->min[2] == box->max[2];
}

void camera_fit_points(view *v, const octree *tree)
{
    if (v->fit != FIT_POINTS)
        return;
    bounds b = {.filter = &v->filter, .world = octree_definition(tree).world};
    octree_walk(tree, include_shown_points, &b);
    v->fit = b.count ? FIT_BOX : FIT_WORLD;
    octree_node leaf;
    if (b.count && is_single_position(&b.box) && octree_locate(tree, b.box.min, &leaf) == OCTREE_OK)
        b.box = leaf.box;
    widen_thin_sides(&b.box);
    v->focus = b.box;
}
