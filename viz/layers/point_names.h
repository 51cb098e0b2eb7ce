/* SPDX-License-Identifier: MIT */
/* point_names.h - the ids of points, written beside them if there are only a few. */
#ifndef LAYERS_POINT_NAMES_H
#define LAYERS_POINT_NAMES_H

#include "layer_type.h"

#define MOST_NAMED_POINTS 24 /* a tree with more points has no names */

/* Write the ids of a game's points beside them where there is room. Names are added after all other labels of the
 * scene, because these say more. A picture without room for text has no names, and the player needs none. */
void add_point_names(scene *s, const layer_source *in);

#endif
