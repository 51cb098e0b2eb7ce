/* SPDX-License-Identifier: MIT */
/* camera.h - from world coordinates to pixels, in doubles.
 *
 * A camera frames a box: the world, or the box that its view fits. Positions are first taken relative to the lowest
 * corner of that box and divided by its size, so that a scene at 1e15 or of extent 1e-300 looks like the same scene
 * about 0. In those units the box lies within [-1, 1] on every axis.
 */
#ifndef SCENE_CAMERA_H
#define SCENE_CAMERA_H

#include "octree/types.h"
#include "view.h"

/* The part of the frame that the world is drawn in; pixels, y down. */
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
    double middle[2];             /* the pixel that the axis of view passes through */
    double center[3];             /* what it looks at, at that pixel, in world coordinates */
    double distance;              /* from the eye to it */
    double near;                  /* what is nearer than this (along forward, from the eye) is clipped */
    double near_depth, far_depth; /* the box's range of view depth, which is cut into bands */
    bool clips_depth;             /* what is outside that range is clipped */
} camera;

/* The camera of a tick, with the view's look, center and zoom in place of its own: it depends on nothing but the view,
 * the world, the player and the number of the tick. */
camera camera_make(const view *v, camera_window window, const octree_box *world, const double player[3], uint64_t tick);

/* The camera of a close-up: in the direction of c, into another window, of a place in its middle and what is about as
 * far before and behind it as beside it, so many times as large as c shows what it looks at. */
camera camera_close_up(const camera *c, camera_window window, const double place[3], double times);

/* How long a pixel is, in world units, at the distance of what the camera looks at. */
double camera_pixel_length(const camera *c);

static inline double camera_dot(const double a[3], const double b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* To unit coordinates: 2 (p - origin) / size - half; and on one axis. */
static inline double camera_unit_on(const camera *c, int axis, double at)
{
    return 2 * ((at * c->scale - c->origin[axis]) / c->size) - c->half[axis];
}

static inline void camera_unit(const camera *c, const double position[3], double result[3])
{
    for (int i = 0; i < 3; i++)
        result[i] = camera_unit_on(c, i, position[i]);
}

/* To camera coordinates: right, up, and depth along forward, from the eye; unit lengths. */
static inline void camera_transform(const camera *c, const double position[3], double result[3])
{
    double from_eye[3];
    camera_unit(c, position, from_eye);
    for (int i = 0; i < 3; i++)
        from_eye[i] -= c->eye[i];
    result[0] = camera_dot(from_eye, c->right);
    result[1] = camera_dot(from_eye, c->up);
    result[2] = camera_dot(from_eye, c->forward);
}

/* Camera coordinates to pixels, y down. The depth must be at least `near` under perspective. */
static inline void camera_project(const camera *c, const double seen[3], double pixel[2])
{
    const double scale = c->perspective ? c->zoom / seen[2] : c->zoom;
    pixel[0] = c->middle[0] + seen[0] * scale;
    pixel[1] = c->middle[1] - seen[1] * scale;
}

/* The pixel of a position; false when it is not before the camera. */
bool camera_pixel(const camera *c, const double position[3], double pixel[2]);

/* A box's size on screen: the longer side, in pixels, of the upright rectangle around its projection; infinite when a
 * part of it is nearer than `near`. Nothing inside the box appears larger. */
double camera_box_pixels(const camera *c, const octree_box *box);

/* Whether that is less than `pixels`; faster unless the size is close to it. */
bool camera_box_is_below(const camera *c, const octree_box *box, double pixels);

/* Under FIT_POINTS, make the view frame the points that it shows of the tree of tick 0, so that the camera does not
 * move from tick to tick: FIT_BOX around them, around their leaf when they are all equal, or FIT_WORLD when there are
 * none. Other views do not change. */
void camera_fit(view *v, const octree *tree);

/* The cosine and sine of a fraction of a full turn, from polynomials: the same on every machine. */
void camera_turn(double turns, double *cosine, double *sine);

#endif
