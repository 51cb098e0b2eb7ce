/* SPDX-License-Identifier: MIT */
/* answer_layers.h - functions that the layers of all query kinds share. */
#ifndef LAYERS_ANSWER_LAYERS_H
#define LAYERS_ANSWER_LAYERS_H

#include "layer_type.h"

/* Return the element id of a part of an answer, such as the line to a neighbour. `place` is the answer's index in the
 * tick. Markers have the ids of their points instead. */
uint64_t answer_part_id(size_t place, size_t part);

/* Mark the points of an answer. `half` is half the size of a mark, in half units. An answer with many points gets
 * smaller marks, so that they hide less. */
void mark_answer_points(scene *s, const octree_answer *answer, view_layer own, scene_shape shape, unsigned half);

/* Append a phrase such as "the box of the range query (answer 2 of 3)"; `what` is the noun, here "box". Return the
 * answer at `place`. */
const octree_answer *append_query(description *d, const char *what, uint64_t place);

/* Append the number of points that the query found. */
void append_found_count(description *d, const octree_answer *answer);

#endif
