/* SPDX-License-Identifier: MIT */
/* scenes.c - see scenes.h. */
#include "scenes.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "fixture.h"
#include "octree/sample.h"

double scene_nudge(double value, int steps)
{
    for (; steps > 0; steps--)
        value = next_up(value);
    for (; steps < 0; steps++)
        value = next_down(value);
    return fmin(fmax(value, -DBL_MAX), DBL_MAX);
}

typedef void place_maker(scene *s, uint64_t *random);

static void sample_into(scene *s, octree_sample_kind kind, uint64_t *random)
{
    octree_sample(kind, octree_random(random), &s->world, s->count, s->places);
}

static void place_uniform(scene *s, uint64_t *random)
{
    sample_into(s, OCTREE_SAMPLE_UNIFORM, random);
}

static void place_gaussian(scene *s, uint64_t *random)
{
    sample_into(s, OCTREE_SAMPLE_GAUSSIAN, random);
}

static void place_clustered(scene *s, uint64_t *random)
{
    sample_into(s, OCTREE_SAMPLE_CLUSTERED, random);
}

static void place_surface(scene *s, uint64_t *random)
{
    sample_into(s, OCTREE_SAMPLE_SURFACE, random);
}

static void place_lattice(scene *s, uint64_t *random)
{
    sample_into(s, OCTREE_SAMPLE_LATTICE, random);
}

/* Coordinates i * unit for whole i in the world: many ties and, if the unit rounds, near ties. */
static void place_on_grid(scene *s, uint64_t *random, double unit)
{
    for (size_t i = 0; i < s->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const double first = ceil(s->world.min[axis] / unit), last = floor(s->world.max[axis] / unit);
            s->places[i][axis] = (first + (double)random_below(random, (uint64_t)(last - first) + 1)) * unit;
        }
}

static void place_whole(scene *s, uint64_t *random)
{
    place_on_grid(s, random, 1);
}

static void place_tenths(scene *s, uint64_t *random)
{
    place_on_grid(s, random, 0.1);
}

/* The focus plus or minus one of a few offsets on each axis, and up to two doubles beside it. */
static void place_mirrored(scene *s, uint64_t *random)
{
    double offsets[4][3];
    for (int axis = 0; axis < 3; axis++) {
        const double half = s->world.max[axis] / 2 - s->world.min[axis] / 2;
        const double middle = s->world.min[axis] / 2 + s->world.max[axis] / 2;
        s->focus[axis] = random_between(random, middle - half / 4, middle + half / 4);
        for (int i = 0; i < 4; i++)
            offsets[i][axis] = random_between(random, 0, half / 2);
    }
    for (size_t i = 0; i < s->count; i++) {
        const double *offset = offsets[random_below(random, 4)];
        for (int axis = 0; axis < 3; axis++) {
            const double turned = random_below(random, 2) == 0 ? offset[axis] : -offset[axis];
            const int steps = random_below(random, 3) == 0 ? (int)random_below(random, 5) - 2 : 0;
            s->places[i][axis] = scene_nudge(s->focus[axis] + turned, steps);
        }
    }
}

/* Few places for many points. */
static void place_equal(scene *s, uint64_t *random)
{
    const size_t few = 1 + random_below(random, 3);
    place_uniform(s, random);
    s->count = s->count < few ? s->count : few;
}

/* On the planes of cells of any depth, and up to two doubles beside them. */
static void place_on_planes(scene *s, uint64_t *random)
{
    for (size_t i = 0; i < s->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            octree_address address = OCTREE_ROOT;
            for (uint64_t depth = random_below(random, OCTREE_MAX_DEPTH + 1); depth > 0; depth--)
                address = address << 3 | random_below(random, 8);
            const octree_box cell = octree_cell_box(&s->world, address);
            s->places[i][axis] = scene_nudge(cell.min[axis], (int)random_below(random, 5) - 2);
        }
}

/* On the faces, edges and corners of the world, and on its middle planes. */
static void place_on_faces(scene *s, uint64_t *random)
{
    const octree_box upper = octree_cell_box(&s->world, 017);
    for (size_t i = 0; i < s->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const double inside = random_between(random, s->world.min[axis], s->world.max[axis]);
            const double values[] = {s->world.min[axis], s->world.max[axis], upper.min[axis], inside};
            s->places[i][axis] = values[random_below(random, 4)];
        }
}

/* Every exponent of doubles in one tree. */
static void place_magnitudes(scene *s, uint64_t *random)
{
    for (size_t i = 0; i < s->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const int exponent = (int)random_below(random, 2098) - 1074;
            s->places[i][axis] = ldexp(random_between(random, -1, 1), exponent);
        }
}

/* So near to the middle of the world that squares of distances underflow. */
static void place_vanishing(scene *s, uint64_t *random)
{
    for (size_t i = 0; i < s->count; i++) {
        const int exponent = -(int)random_below(random, 600);
        for (int axis = 0; axis < 3; axis++)
            s->places[i][axis] = ldexp(random_between(random, -1, 1), exponent);
    }
}

/* Towards a corner of the world, each place some halvings nearer: leaves of every depth. */
static void place_towards_a_corner(scene *s, uint64_t *random)
{
    for (size_t i = 0; i < s->count; i++) {
        const int halvings = (int)random_below(random, 26);
        for (int axis = 0; axis < 3; axis++) {
            const double half = s->world.max[axis] / 2 - s->world.min[axis] / 2;
            const double reach = ldexp(half, 1 - halvings);
            s->places[i][axis] = s->world.min[axis] + random_between(random, 0, fmin(reach, DBL_MAX));
        }
    }
}

typedef struct scene_kind {
    const char *name;
    octree_box world;
    place_maker *make;
} scene_kind;

static const scene_kind kinds[] = {
    {"uniform", {{-1000, -1000, -1000}, {1000, 1000, 1000}}, place_uniform},
    {"gaussian", {{-1000, -1000, -1000}, {1000, 1000, 1000}}, place_gaussian},
    {"clustered", {{-1000, -1000, -1000}, {1000, 1000, 1000}}, place_clustered},
    {"surface", {{-1000, -1000, -1000}, {1000, 1000, 1000}}, place_surface},
    {"lattice", {{-1000, -1000, -1000}, {1000, 1000, 1000}}, place_lattice},
    {"whole", {{-4, -4, -4}, {4, 4, 4}}, place_whole},
    {"tenths", {{0, 0, 0}, {1, 1, 1}}, place_tenths},
    {"mirrored", {{-1, -1, -1}, {1, 1, 1}}, place_mirrored},
    {"mirrored-aside", {{-1000, 1e15, -1e-3}, {1000, 1e15 + 1024, 1e-3}}, place_mirrored},
    {"equal", {{-1, -1, -1}, {1, 1, 1}}, place_equal},
    {"corner", {{-1, -1, -1}, {1, 1, 1}}, place_towards_a_corner},
    {"faces", {{-1, -3, 0}, {1, 5, 0.3}}, place_on_faces},
    {"planes", {{-1000, -1000, -1000}, {1000, 1000, 1000}}, place_on_planes},
    {"planes-odd", {{0.1, -0.3, 1e15}, {0.7, 1e-3, 1e15 + 1}}, place_on_planes},
    {"planes-extreme", {{-1.7e308, -1e200, 5e-324}, {1.7e308, 1e200, 1e-310}}, place_on_planes},
    {"offset-1e12", {{1e12, 1e12, 1e12}, {1e12 + 1000, 1e12 + 1000, 1e12 + 1000}}, place_clustered},
    {"offset-1e15", {{1e15, 1e15, 1e15}, {1e15 + 1, 1e15 + 1, 1e15 + 1}}, place_uniform},
    {"exhausted-axis", {{1e15, 0, 0}, {1e15 + 1, 1000, 1000}}, place_uniform},
    {"tiny-1e-310", {{-1e-310, -1e-310, -1e-310}, {1e-310, 1e-310, 1e-310}}, place_uniform},
    {"tiny-5e-324", {{5e-324, 5e-324, 5e-324}, {1e-310, 1e-310, 1e-310}}, place_mirrored},
    {"tiny-few", {{0, 0, 0}, {40 * 5e-324, 40 * 5e-324, 40 * 5e-324}}, place_uniform},
    {"tiny-edge", {{-0x1p-1023, 0, -0x1.fp-1024}, {0x1.8p-1024, 0x1p-1023, 0x1.fp-1024}}, place_mirrored},
    {"tiny-whole", {{-0x1.fp-1024, -0x1.fp-1024, 0}, {0x1.fp-1024, 0x1.fp-1024, 0x1p-1060}}, place_on_planes},
    {"small-1e-200", {{-1e-200, -1e-200, -1e-200}, {1e-200, 1e-200, 1e-200}}, place_mirrored},
    {"large-1e200", {{-1e200, -1e200, -1e200}, {1e200, 1e200, 1e200}}, place_clustered},
    {"mirrored-1e200", {{-1e200, -1e200, -1e200}, {1e200, 1e200, 1e200}}, place_mirrored},
    {"largest", {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}}, place_uniform},
    {"mirrored-largest", {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}}, place_mirrored},
    {"magnitudes", {{-DBL_MAX, -DBL_MAX, -DBL_MAX}, {DBL_MAX, DBL_MAX, DBL_MAX}}, place_magnitudes},
    {"vanishing", {{-1, -1, -1}, {1, 1, 1}}, place_vanishing},
    {"unlike-axes", {{-DBL_MAX, -1, 5e-324}, {DBL_MAX, 1, 1e-310}}, place_uniform},
};

size_t scene_kinds(void)
{
    return sizeof kinds / sizeof kinds[0];
}

const char *scene_name(size_t kind)
{
    return kind < scene_kinds() ? kinds[kind].name : NULL;
}

/* Rounding may move a place out of the world. */
static void keep_inside(scene *s)
{
    for (size_t i = 0; i < s->count; i++)
        for (int axis = 0; axis < 3; axis++)
            s->places[i][axis] = fmin(fmax(s->places[i][axis], s->world.min[axis]), s->world.max[axis]);
}

void scene_make(scene *s, size_t kind, size_t count, uint64_t *random)
{
    s->name = kinds[kind].name;
    s->world = kinds[kind].world;
    s->count = count < PLACES_AT_MOST ? count : PLACES_AT_MOST;
    for (int axis = 0; axis < 3; axis++)
        s->focus[axis] = random_between(random, s->world.min[axis], s->world.max[axis]);
    kinds[kind].make(s, random);
    keep_inside(s);
}
