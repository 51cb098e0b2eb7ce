/* SPDX-License-Identifier: MIT */
/* point_names.h - writes the ids of points beside the points of a game with only a few points. */
#ifndef LAYERS_POINT_NAMES_H
#define LAYERS_POINT_NAMES_H

#include "layer_type.h"

#define MOST_NAMED_POINTS 24 /* in a tree with more points, no ids are written */

/* Write the ids of a game's points beside the points where there is room. Call this function after all other labels of
 * the scene were added, because the other labels say more. The player gets no id, and a picture without room for text
 * gets no ids. */
void add_point_names(scene *s, const layer_source *in);

#endif
