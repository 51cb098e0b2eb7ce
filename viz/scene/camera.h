/* SPDX-License-Identifier: MIT */
/* camera.h - converts world coordinates to pixels, in double precision.
 *
 * A camera frames a box: the world, or the box that --fit points computes. A world position becomes a pixel in three
 * steps:
 *
 * 1. camera_to_unit_coordinates(): subtract the lowest corner of the box, divide by half the box's longest side, and
 * centre the box on 0. The box then lies within [-1, 1] on every axis. Subtracting first keeps precision: a scene at
 * 1e15, or with an extent of 1e-300, looks like the same scene at 0.
 *
 * 2. camera_transform(): camera coordinates, relative to the eye, along the axes right, up and forward (depth).
 *
 * 3. camera_project(): pixels. Multiply by the zoom; under perspective, divide by the depth; y points down.
 *
 * The camera uses no function of libm whose results differ between machines. */
#ifndef SCENE_CAMERA_H
#define SCENE_CAMERA_H

#include "octree/types.h"
#include "view.h"

/* The area of the picture in which the world is drawn, in pixels; y points down. */
typedef struct camera_window {
    double x, y, width, height;
} camera_window;

typedef struct camera {
    double origin[3]; /* the lowest corner of the framed box, multiplied by `scale` */
    double scale;     /* usually 1; 1/2 if the extent of the framed box overflows a double */
    double size;      /* the largest extent of the framed box, multiplied by `scale` */
    double half[3];   /* half the framed box's extent on each axis, in unit coordinates; 1 on the box's longest axis */
    /* an orthonormal basis of the camera; `forward` points from the eye into the scene */
    double right[3], up[3], forward[3];
    double eye[3]; /* the position of the eye in unit coordinates */
    bool perspective;
    bool follows; /* true: CAMERA_FOLLOW, near the player or near view.center */
    /* pixels per unit of length in unit coordinates; under perspective, for a length at distance 1 from the eye */
    double zoom;
    double middle[2]; /* the pixel at which the view axis meets the picture */
    double center[3]; /* the world position that the camera looks at; it appears at the pixel `middle` */
    double distance;  /* the distance from the eye to the center, in unit coordinates */
    double near;      /* geometry at a depth less than this is clipped */
    double near_depth,
        far_depth;    /* the range of depths of the framed box; fading with distance divides this range into bands */
    bool clips_depth; /* geometry outside near_depth to far_depth is clipped */
} camera;

/* Returns the camera of a tick. The view's `look`, `center` and `zoom`, if given, override the camera kind view.camera.
 * The result depends only on the view, the world, the player's position and the number of the tick. `player` is null if
 * there is no player. CAMERA_FOLLOW without a player and without `center` shows the framed box as CAMERA_ORBIT does at
 * tick 0. */
camera camera_make(const view *v, camera_window window, const octree_box *world, const double player[3], uint64_t tick);

/* Returns the camera of a close-up. The new camera looks in the same direction as `c`, at the world position `place`.
 * `place` appears in the middle of `window`, magnified `times` as much as the center of `c`. The new camera clips
 * geometry whose depth differs from the depth of `place` by more than half the window's longer side. */
camera camera_make_close_up(const camera *c, camera_window window, const double place[3], double times);

/* Returns the side of a pixel in world units, at the camera's center. */
double camera_world_length_of_pixel(const camera *c);

static inline double dot_product(const double a[3], const double b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* Convert a world position to unit coordinates: 2 (p - origin) / size - half. camera_to_unit_coordinate() converts one
 * coordinate. */
static inline double camera_to_unit_coordinate(const camera *c, int axis, double at)
{
    return 2 * ((at * c->scale - c->origin[axis]) / c->size) - c->half[axis];
}

static inline void camera_to_unit_coordinates(const camera *c, const double position[3], double result[3])
{
    for (int i = 0; i < 3; i++)
        result[i] = camera_to_unit_coordinate(c, i, position[i]);
}

/* Convert a world position to camera coordinates: distances from the eye along right, up and forward, with the lengths
 * of unit coordinates. */
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

/* Convert camera coordinates to a pixel; the picture's y axis points down. Under perspective the depth must be at least
 * `near`. */
static inline void camera_project(const camera *c, const double seen[3], double pixel[2])
{
    const double scale = c->perspective ? c->zoom / seen[2] : c->zoom;
    pixel[0] = c->middle[0] + seen[0] * scale;
    pixel[1] = c->middle[1] - seen[1] * scale;
}

/* Find the pixel of a world position. Returns false if the position is not in front of the camera. */
bool camera_find_pixel(const camera *c, const double position[3], double pixel[2]);

/* Compute the ray of positions that appear at a pixel: its origin, and its direction with length 1. Under perspective
 * the origin is the eye; otherwise no point of the box `world` appears before the origin. */
void camera_find_ray(const camera *c, const double pixel[2], const octree_box *world, double origin[3],
                     double direction[3]);

/* Returns the size of a box on screen in pixels: the longer side of the axis-aligned rectangle around the box's
 * projection. The size is infinite if a corner of the box is nearer than `near`. Nothing inside the box appears
 * larger. */
double camera_box_size_in_pixels(const camera *c, const octree_box *box);

/* Returns whether camera_box_size_in_pixels() is below `pixels`. Faster than computing the size, unless the size is
 * close to `pixels`. */
bool camera_is_box_smaller_than(const camera *c, const octree_box *box, double pixels);

/* If v->fit is FIT_POINTS, set it to FIT_BOX, and v->focus to the box of the points that the view shows in the tree of
 * tick 0. If all these points are equal, use the box of their leaf; if there are no such points, set FIT_WORLD. All
 * ticks use the box of tick 0, so that the camera does not move between ticks. If v->fit is not FIT_POINTS, change
 * nothing. Cost: O(points). */
void camera_fit_points(view *v, const octree *tree);

/* Compute the cosine and sine of an angle in turns, from polynomials, so that every machine gets the same bits. */
void camera_compute_cosine_sine(double turns, double *cosine, double *sine);

/* Compute the position of a corner of a box. Bit i of the number `corner` is set if the corner is at the upper end of
 * axis i. */
static inline void box_corner(const octree_box *box, unsigned corner, double position[3])
{
    for (unsigned i = 0; i < 3; i++)
        position[i] = corner >> i & 1 ? box->max[i] : box->min[i];
}

#endif
