/* SPDX-License-Identifier: MIT */
/* answer_layers.h - what the layers of all kinds of query share. */
#ifndef LAYERS_ANSWER_LAYERS_H
#define LAYERS_ANSWER_LAYERS_H

#include "layer_type.h"

/* The element id of a part of an answer, such as the line to a neighbour: `place` is the index of the answer among
 * those of the tick. Markers have the ids of their points instead. */
uint64_t answer_part_id(size_t place, size_t part);

/* Mark the points of an answer. `half` is half the size of a mark; many marks are smaller, so that they hide less. */
void mark_answer_points(scene *s, const octree_answer *answer, view_layer own, scene_shape shape, unsigned half);

/* Describe the query that an element belongs to, such as "the box of the range query (answer 2 of 3)". Returns its
 * answer. */
const octree_answer *append_query(description *d, const char *what, uint64_t place);

/* Add the number of points found. */
void append_found_count(description *d, const octree_answer *answer);

#endif
