/* SPDX-License-Identifier: MIT */
/* camera.h - from world coordinates to pixels, in doubles.
 *
 * A camera frames a box: the world, or the box that --fit points computes. A position takes three steps to its pixel:
 * - camera_to_unit_coordinates(): relative to the lowest corner of the box and divided by its size, so that the box
 * lies within [-1, 1] on every axis. Subtracting first keeps precision: a scene at 1e15, or with an extent of 1e-300,
 * looks like the same scene at 0.
 * - camera_transform(): camera coordinates, relative to the eye, along the axes right, up and forward (depth).
 * - camera_project(): pixels, scaled by the zoom, in perspective also divided by the depth; y points down.
 *
 * All steps are in double precision and use no function that differs between machines.
 */
#ifndef SCENE_CAMERA_H
#define SCENE_CAMERA_H

#include "octree/types.h"
#include "view.h"

/* The area of the frame in which the world is drawn, in pixels; y points down. */
typedef struct camera_window {
    double x, y, width, height;
} camera_window;

typedef struct camera {
    double origin[3];                   /* the box's lowest corner, times scale */
    double scale;                       /* 1, or 1/2 where the box's extent overflows */
    double size;                        /* the box's largest extent, times scale */
    double half[3];                     /* half the box's extents, in unit coordinates: 1 on the longest axis */
    double right[3], up[3], forward[3]; /* an orthonormal basis; forward points away from the eye */
    double eye[3];                      /* in unit coordinates */
    bool perspective;
    double zoom;                  /* pixels a unit; under perspective, at distance 1 */
    double middle[2];             /* the pixel on the axis of view */
    double center[3];             /* the world position that the camera looks at; `middle` shows it */
    double distance;              /* from the eye to the center, in unit coordinates */
    double near;                  /* geometry at a smaller depth is clipped */
    double near_depth, far_depth; /* the box's range of depth, which the depth bands divide */
    bool clips_depth;             /* geometry outside of that range is clipped */
} camera;

/* The camera of a tick. The view's look, center and zoom replace the camera's own if they are given. The result depends
 * only on the view, the world, the player's position and the number of the tick. */
camera camera_make(const view *v, camera_window window, const octree_box *world, const double player[3], uint64_t tick);

/* The camera of a close-up: it looks in the direction of c at `place`, which it shows in the middle of `window`,
 * `times` as large as c shows its center. It clips geometry that is farther before or behind the place than the window
 * reaches to the side. */
camera camera_make_close_up(const camera *c, camera_window window, const double place[3], double times);

/* The length of a pixel in world units, at the camera's center. */
double camera_world_length_of_pixel(const camera *c);

static inline double dot_product(const double a[3], const double b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* Convert to unit coordinates: 2 (p - origin) / size - half. The first function converts one axis. */
static inline double camera_to_unit_coordinate(const camera *c, int axis, double at)
{
    return 2 * ((at * c->scale - c->origin[axis]) / c->size) - c->half[axis];
}

static inline void camera_to_unit_coordinates(const camera *c, const double position[3], double result[3])
{
    for (int i = 0; i < 3; i++)
        result[i] = camera_to_unit_coordinate(c, i, position[i]);
}

/* Convert to camera coordinates: distances from the eye along right, up and forward, in units of unit coordinates. */
static inline void camera_transform(const camera *c, const double position[3], double result[3])
{
    double from_eye[3];
    camera_to_unit_coordinates(c, position, from_eye);
    for (int i = 0; i < 3; i++)
        from_eye[i] -= c->eye[i];
    result[0] = dot_product(from_eye, c->right);
    result[1] = dot_product(from_eye, c->up);
    result[2] = dot_product(from_eye, c->forward);
}

/* Camera coordinates to pixels, y down. The depth must be at least `near` under perspective. */
static inline void camera_project(const camera *c, const double seen[3], double pixel[2])
{
    const double scale = c->perspective ? c->zoom / seen[2] : c->zoom;
    pixel[0] = c->middle[0] + seen[0] * scale;
    pixel[1] = c->middle[1] - seen[1] * scale;
}

/* The pixel of a position; false when it is not before the camera. */
bool camera_find_pixel(const camera *c, const double position[3], double pixel[2]);

/* The size of a box on screen: the longer side, in pixels, of the axis-aligned rectangle around its projection.
 * Infinite if a part of the box is nearer than `near`. Nothing inside the box appears larger. */
double camera_box_size_in_pixels(const camera *c, const octree_box *box);

/* True if camera_box_size_in_pixels() is below `pixels`. Faster than computing it, unless the size is close to
 * `pixels`. */
bool camera_is_box_below(const camera *c, const octree_box *box, double pixels);

/* If the view has FIT_POINTS, replace that by FIT_BOX with the box of the points that the view shows in the tree of
 * tick 0; by the box of their leaf if all of them are equal; by FIT_WORLD if there are none. Using tick 0 alone keeps
 * the camera from moving between ticks. Other views do not change. Cost: O(points). */
void camera_fit_points(view *v, const octree *tree);

/* The cosine and sine of a fraction of a full turn, from polynomials, so that every machine computes the same bits. */
void camera_compute_cosine_sine(double turns, double *cosine, double *sine);

#endif
