/* SPDX-License-Identifier: MIT */
/* draw_list.h - what a scene has in a layer, for tests. */
#ifndef DRAW_LIST_H
#define DRAW_LIST_H

#include "scene.h"

/* The elements of a layer, by kind. */
typedef struct layer_counts {
    size_t boxes, segments, markers, labels, panels;
} layer_counts;

layer_counts count_layer(const scene *s, unsigned layer);

/* The one box of a layer with this id; the test fails when there is another number of them. */
const scene_box *only_box(const scene *s, unsigned layer, uint64_t id);

/* The markers of a layer that have this id and place. */
size_t markers_at(const scene *s, unsigned layer, uint64_t id, const double at[3]);

/* The segments of a layer that have this id and these ends. */
size_t lines_between(const scene *s, unsigned layer, uint64_t id, const double from[3], const double to[3]);

bool same_box(const octree_box *a, const octree_box *b);

#endif
