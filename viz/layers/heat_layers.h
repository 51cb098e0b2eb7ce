/* SPDX-License-Identifier: MIT */
/* heat_layers.h - the scales of the heat layers. */
#ifndef LAYERS_HEAT_LAYERS_H
#define LAYERS_HEAT_LAYERS_H

#include "theme.h"

#include <stdint.h>

/* The steps of both scales, the same in every session: each is twice as much as the one before in visits, and four
 * times as much in points. Step 0 begins at 1. */
#define HEAT_STEPS THEME_NODE_DEPTHS
#define HEAT_VISITS_SHIFT 1
#define HEAT_POINTS_SHIFT 2

/* The least amount of the last step. */
#define HEAT_LAST(shift) (UINT64_C(1) << (HEAT_STEPS - 1) * (shift))

/* The step of an amount, which is not 0. */
unsigned heat_step(uint64_t amount, unsigned shift);

#endif
