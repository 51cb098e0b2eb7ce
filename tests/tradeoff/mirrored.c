/* SPDX-License-Identifier: MIT */
/* mirrored.c - see mirrored.h. */
#include "mirrored.h"

#include <string.h>

#include "fixture.h"
#include "program.h"

enum { POINTS = 32, OFFSETS = 3 };

static double nudge(double value, int steps)
{
    for (; steps > 0; steps--)
        value = next_up(value);
    for (; steps < 0; steps++)
        value = next_down(value);
    return value;
}

/* The target plus or minus one of a few offsets on each axis; the axes of an offset may change places. */
workload mirrored_make(const char *name, uint64_t *random)
{
    double offsets[OFFSETS], target[3];
    workload w = {.name = name, .world = cube(-1, 1), .count = POINTS, .target_count = 1};
    w.points = resize_memory(NULL, POINTS * sizeof *w.points);
    w.targets = resize_memory(NULL, sizeof *w.targets);
    for (int axis = 0; axis < 3; axis++) {
        target[axis] = random_between(random, -0.25, 0.25);
        offsets[axis] = random_between(random, 0.1, 0.7);
    }
    memcpy(w.targets[0], target, sizeof target);
    for (size_t i = 0; i < POINTS; i++) {
        const uint64_t turn = random_below(random, 3);
        for (int axis = 0; axis < 3; axis++) {
            const double offset = offsets[((uint64_t)axis + turn) % OFFSETS];
            const double turned = random_below(random, 2) == 0 ? offset : -offset;
            const int steps = random_below(random, 3) == 0 ? (int)random_below(random, 5) - 2 : 0;
            w.points[i].position[axis] = nudge(target[axis] + turned, steps);
        }
        w.points[i].id = i;
    }
    return w;
}
