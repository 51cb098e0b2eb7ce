/* SPDX-License-Identifier: MIT */
/* sample.c - generates points of each distribution. It calls no function of libm except sqrt(), so the points are the
 * same on every machine. */
#include "octree/sample.h"
#include "../exact/exact.h"
#include "../exact/float_mode.h"
#include "../exact/point.h"
#include "octree/digest.h"

#include <math.h>
#include <string.h>

uint64_t octree_random(uint64_t *state)
{
    const uint64_t before = *state;
    *state += UINT64_C(0x9e3779b97f4a7c15);
    return octree_digest_word(before, 0);
}

double octree_random_unit(uint64_t *state)
{
    return (double)(octree_random(state) >> 11) * 0x1p-53;
}

/* Returns a random value with mean 0 and variance 1, between -6 and 6: the sum of twelve uniform values, shifted
 * (Irwin-Hall distribution). */
static double random_normal(uint64_t *state)
{
    double sum = -6;
    for (int i = 0; i < 12; i++)
        sum += octree_random_unit(state);
    return sum;
}

/* A function that draws `count` random positions. Each row of `rows` is a position, with three coordinates in [-1,
 * 1]. */
typedef void distribution(uint64_t seed, size_t count, double (*rows)[3]);

static void sample_uniform(uint64_t seed, size_t count, double (*rows)[3])
{
    for (size_t n = 0; n < count; n++)
        for (int i = 0; i < 3; i++)
            rows[n][i] = 2 * octree_random_unit(&seed) - 1;
}

/* Returns a normally distributed random value around `center`, in [-1, 1]. A value outside [-1, 1] is drawn again, so
 * that points do not pile up on the faces of the box. */
static double random_within(uint64_t *state, double center, double sigma)
{
    double x;
    do
        x = center + sigma * random_normal(state);
    while (x < -1 || x > 1);
    return x;
}

static void sample_gaussian(uint64_t seed, size_t count, double (*rows)[3])
{
    for (size_t n = 0; n < count; n++)
        for (int i = 0; i < 3; i++)
            rows[n][i] = random_within(&seed, 0, 1.0 / 3);
}

#define CLUSTERS 16

static void sample_clustered(uint64_t seed, size_t count, double (*rows)[3])
{
    double centers[CLUSTERS][3], widths[CLUSTERS];
    for (int c = 0; c < CLUSTERS; c++) {
        for (int i = 0; i < 3; i++)
            centers[c][i] = 1.6 * octree_random_unit(&seed) - 0.8;
        widths[c] = 0.01 + 0.05 * octree_random_unit(&seed);
    }
    for (size_t n = 0; n < count; n++) {
        const size_t c = (size_t)(octree_random(&seed) % CLUSTERS);
        for (int i = 0; i < 3; i++)
            rows[n][i] = random_within(&seed, centers[c][i], widths[c]);
    }
}

/* Draw random points in a ball and project the points onto the surface of the ball. */
static void sample_surface(uint64_t seed, size_t count, double (*rows)[3])
{
    for (size_t n = 0; n < count; n++) {
        double square;
        do {
            square = 0;
            for (int i = 0; i < 3; i++) {
                rows[n][i] = 2 * octree_random_unit(&seed) - 1;
                square += rows[n][i] * rows[n][i];
            }
        } while (square > 1 || square < 0.01);
        for (int i = 0; i < 3; i++)
            rows[n][i] *= 0.9 / sqrt(square);
    }
}

static void sample_lattice(uint64_t seed, size_t count, double (*rows)[3])
{
    (void)seed;
    size_t side = 1;
    while (side * side * side < count)
        side++;
    for (size_t n = 0; n < count; n++) {
        const size_t at[3] = {n / (side * side), n / side % side, n % side};
        for (int i = 0; i < 3; i++)
            rows[n][i] = (double)(2 * at[i] + 1) / (double)side - 1;
    }
}

static const struct {
    const char *name;
    distribution *fill;
} kinds[OCTREE_SAMPLE_KINDS] = {
    [OCTREE_SAMPLE_UNIFORM] = {"uniform", sample_uniform},
    [OCTREE_SAMPLE_GAUSSIAN] = {"gaussian", sample_gaussian},
    [OCTREE_SAMPLE_CLUSTERED] = {"clustered", sample_clustered},
    [OCTREE_SAMPLE_SURFACE] = {"surface", sample_surface},
    [OCTREE_SAMPLE_LATTICE] = {"lattice", sample_lattice},
};

const char *octree_sample_name(octree_sample_kind kind)
{
    return (unsigned)kind < OCTREE_SAMPLE_KINDS ? kinds[kind].name : NULL;
}

bool octree_sample_parse(const char *name, octree_sample_kind *kind)
{
    for (int i = 0; name && kind && i < OCTREE_SAMPLE_KINDS; i++) {
        if (strcmp(name, kinds[i].name) == 0) {
            *kind = (octree_sample_kind)i;
            return true;
        }
    }
    return false;
}

/* Map a value from [-1, 1] to [min, max], without overflow. */
static double map_to_interval(double unit, double min, double max)
{
    const double x = (min / 2 + max / 2) + unit * (max / 2 - min / 2);
    return x < min ? min : x > max ? max : x;
}

octree_status octree_sample(octree_sample_kind kind, uint64_t seed, const octree_box *box, size_t count,
                            double (*positions)[3])
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_sample, kind, seed, box, count, positions);
    if (!box || (!positions && count))
        return OCTREE_NULL_ARGUMENT;
    if ((unsigned)kind >= OCTREE_SAMPLE_KINDS)
        return OCTREE_BAD_OPTION;
    if (!has_exact_double_arithmetic())
        return OCTREE_BAD_BUILD;
    if (!is_world(box))
        return OCTREE_BAD_WORLD;
    kinds[kind].fill(seed, count, positions);
    for (size_t n = 0; n < count; n++)
        for (int i = 0; i < 3; i++)
            positions[n][i] = map_to_interval(positions[n][i], box->min[i], box->max[i]);
    return OCTREE_OK;
}
