/* SPDX-License-Identifier: MIT */
/* motion.c - where a body is at a tick.
 *
 * A body's motion starts at an origin at some tick. The position at a later tick is computed from the origin, the
 * velocity and the number of ticks since the start, so that rounding errors do not add up. A body that bounces follows
 * a triangle wave between two faces of the box in which its centre may lie (reflect_path()).
 */
#include "motion.h"
#include "../exact/exact.h"

#include <math.h>

void store_body_position(moving_body *body, const double to[3], uint64_t tick)
{
    if (body->moved != tick)
        memcpy(body->before, body->position, sizeof body->before);
    body->moved = tick;
    memcpy(body->position, to, sizeof body->position);
}

/* Returns the position after `ticks` ticks on a path that is reflected at both ends of an interval: a triangle wave
 * with the period 2 * (max - min). If the period overflows, the computation uses quarters of all lengths. If the path
 * still overflows, the position is `origin`. *direction is 1 if the body moves in the direction of `velocity`, -1 if it
 * moves in the opposite direction, and 0 if it is at rest. */
static double reflect_path(double origin, double velocity, double ticks, double min, double max, int *direction)
{
    const double straight = origin + velocity * ticks;
    *direction = 1;
    if (min <= straight && straight <= max)
        return straight;
    const double unit = isfinite(2 * (max - min)) ? 1 : 0.25;
    const double width = max * unit - min * unit;
    double phase = fmod((origin * unit - min * unit) + velocity * unit * ticks, 2 * width);
    if (!isfinite(phase)) {
        *direction = 0;
        return origin;
    }
    phase = phase < 0 ? phase + 2 * width : phase;
    *direction = phase > width ? -1 : 1;
    const double folded = min * unit + (phase > width ? 2 * width - phase : phase);
    const double position = folded / unit;
    return position < min ? min : position > max ? max : position;
}

/* Returns the box that reflects the centre of a body: the world without the body's half extents, rounded inwards. On an
 * axis on which this box does not contain the origin of the motion, it is extended to the origin; on an axis on which
 * the body is larger than the world, it is the origin alone. */
static octree_box find_reflecting_box(const moving_body *body, const octree_box *world)
{
    octree_box box = *world;
    for (int i = 0; i < 3; i++) {
        if (body->half[i] == 0)
            continue;
        const double origin = body->origin[i];
        const double min = exact_add_up(world->min[i], body->half[i]);
        const double max = exact_add_down(world->max[i], -body->half[i]);
        box.min[i] = min > max || origin < min ? origin : min;
        box.max[i] = min > max || origin > max ? origin : max;
    }
    return box;
}

/* Compute the position and the velocity of a body on one axis. The faces of `box` reflect the body's centre. If the
 * centre is exactly at a face, the velocity is the velocity after the reflection. */
static void compute_body_on_axis(const moving_body *body, const octree_box *box, double ticks, int axis,
                                 octree_game_body *now)
{
    const double min = box->min[axis], max = box->max[axis];
    int direction;
    const double at = reflect_path(body->origin[axis], body->velocity[axis], ticks, min, max, &direction);
    const double velocity = body->velocity[axis] * direction;
    const bool leaves = (at == max && velocity > 0) || (at == min && velocity < 0);
    now->position[axis] = at;
    now->velocity[axis] = (leaves ? -velocity : velocity) + 0.0; /* adding 0.0 turns -0.0 into 0.0 */
}

/* Most bodies have not reached a face yet; a test without branches recognizes such bodies. */
octree_game_body body_at_tick(const moving_body *body, const octree_box *world, uint64_t tick)
{
    octree_game_body now = {.id = body->id, .half = {body->half[0], body->half[1], body->half[2]}};
    const double ticks = (double)(tick - body->since);
    const octree_box box = has_extent(body->half) ? find_reflecting_box(body, world) : *world;
    bool within = true;
    for (int i = 0; i < 3; i++) {
        now.position[i] = body->origin[i] + body->velocity[i] * ticks;
        now.velocity[i] = body->velocity[i] + 0.0;
        within &= (now.position[i] > box.min[i]) & (now.position[i] < box.max[i]);
    }
    for (int i = 0; !within && i < 3; i++)
        compute_body_on_axis(body, &box, ticks, i, &now);
    return now;
}

void restart_motion(moving_body *body, const octree_box *world, const double place[3], uint64_t tick)
{
    const octree_game_body now = body_at_tick(body, world, tick);
    for (int i = 0; i < 3; i++)
        /* A computed velocity of 0 can also mean that the body is too fast: its path overflows (reflect_path()). Such a
         * body keeps its stored velocity. */
        if (now.velocity[i] != 0)
            body->velocity[i] = now.velocity[i];
    memcpy(body->origin, place, sizeof body->origin);
    body->since = tick;
}
