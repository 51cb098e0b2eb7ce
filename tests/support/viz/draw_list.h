/* SPDX-License-Identifier: MIT */
/* draw_list.h - counts and finds the elements of a layer in a scene. */
#ifndef DRAW_LIST_H
#define DRAW_LIST_H

#include "scene.h"

/* The elements of a layer, by kind. */
typedef struct layer_counts {
    size_t boxes, segments, markers, labels, panels;
} layer_counts;

layer_counts count_layer(const scene *s, unsigned layer);

/* The box of a layer with this id; the test fails unless there is exactly one. */
const scene_box *find_only_box(const scene *s, unsigned layer, uint64_t id);

/* The number of markers of a layer with this id and position. */
size_t count_markers_at(const scene *s, unsigned layer, uint64_t id, const double at[3]);

/* The number of segments of a layer with this id and these ends. */
size_t count_lines_between(const scene *s, unsigned layer, uint64_t id, const double from[3], const double to[3]);

bool same_box(const octree_box *a, const octree_box *b);

#endif
