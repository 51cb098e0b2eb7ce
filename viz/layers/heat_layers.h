/* SPDX-License-Identifier: MIT */
/* heat_layers.h - the scales that map visits and points to the marks of the heat layers. */
#ifndef LAYERS_HEAT_LAYERS_H
#define LAYERS_HEAT_LAYERS_H

#include "theme.h"

#include <stdint.h>

/* Both scales have HEAT_STEPS steps and are the same in every session. Step 0 begins at 1. Each step begins at twice
 * (visits) or four times (points) the amount of the step before, so an amount is shifted right by this many bits per
 * step. */
#define HEAT_STEPS THEME_NODE_DEPTHS
#define HEAT_VISITS_SHIFT 1
#define HEAT_POINTS_SHIFT 2

/* The smallest amount in the last step. */
#define HEAT_LAST(shift) (UINT64_C(1) << (HEAT_STEPS - 1) * (shift))

/* Return the step of an amount, which must not be 0. */
unsigned heat_step(uint64_t amount, unsigned shift);

#endif
