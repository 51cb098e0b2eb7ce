/* SPDX-License-Identifier: MIT */
/* scale_bar.h - a bar with a round length, which shows the scale of a picture. */
#ifndef LAYERS_SCALE_BAR_H
#define LAYERS_SCALE_BAR_H

#include "scene.h"

#define SCALE_BAR_MARGIN 6 /* the distance of the bar from the edges of its area, in picture units */

/* Add a bar whose left end is at the pixel `corner`. The label above the bar is the bar's length in world units,
 * followed by `words`. The bar is at most `longest` pixels long. The label has the id `id`, the background and the
 * three parts of the bar are panels with the ids `id` to `id` + 3. Labels that the bar would cover are removed. Adds
 * nothing if there is no finite length. */
void scale_bar_add(scene *s, unsigned layer, uint64_t id, const int corner[2], double longest, const char *words);

#endif
