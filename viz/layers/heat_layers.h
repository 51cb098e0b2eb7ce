/* SPDX-License-Identifier: MIT */
/* heat_layers.h - the scales that map numbers of visits and points to the sizes and colours of heat markers. */
#ifndef LAYERS_HEAT_LAYERS_H
#define LAYERS_HEAT_LAYERS_H

#include "theme.h"

#include <stdint.h>

/* The scale of visits and the scale of points have HEAT_STEPS steps each, and are the same in every session. Step 0
 * begins at 1. Each further step begins at twice the number of visits, or at four times the number of points, of the
 * previous step. So each step corresponds to a right shift of the number by HEAT_VISITS_SHIFT or HEAT_POINTS_SHIFT
 * bits. */
#define HEAT_STEPS THEME_NODE_DEPTHS
#define HEAT_VISITS_SHIFT 1
#define HEAT_POINTS_SHIFT 2

/* The least number of visits or points that has the last colour step. Each step begins at 2^shift times the number of
 * the step before. */
#define HEAT_LAST(shift) (UINT64_C(1) << (HEAT_STEPS - 1) * (shift))

/* Return the step of a number of visits or points. `amount` must not be 0. */
unsigned heat_step(uint64_t amount, unsigned shift);

#endif
