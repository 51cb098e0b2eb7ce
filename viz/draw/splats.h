/* SPDX-License-Identifier: MIT */
/* splats.h - paints points as discs, each in its own colour. Private to this folder.
 *
 * A picture holds indices of the theme's colours, but points have far more colours than the theme. So quads of points
 * have the index THEME_OWN. The array `colors` holds the colour of each sample with this index. */
#ifndef DRAW_SPLATS_H
#define DRAW_SPLATS_H

#include "array.h"
#include "quads.h"
#include "splat_buffer.h"

/* Buffers that are reused from frame to frame. A zeroed struct is empty. */
typedef struct splats {
    splat_buffer nearest; /* for each sample, the nearest point */
    int32_t *light;       /* the light of a row of samples, and scratch space of the same size */
    /* with POINTS_BY_DENSITY: for each pixel, the number of points whose centre is in the pixel */
    uint32_t *shared;
    theme_color *colors; /* the colour of each sample; valid only for samples with the index THEME_OWN */
    size_t light_room, shared_room, color_room;
} splats;

void splats_release(splats *t);

/* Add the quads of a scene's points, and set the colours of the samples that these quads cover. `s` is from
 * project_scene_to_samples(). Returns false if memory runs out. Cost: O(samples of the picture + points * samples of a
 * disc). */
bool splats_paint_points(splats *t, quad_list *quads, const scene *s);

/* Set the colours of the samples of a panel whose quad has the index THEME_OWN, such as a swatch of the legend. */
void splats_fill_panel(splats *t, const scene *s, const scene_panel *panel);

/* Copy the colours of the close-up `closer` into its part of the picture of `s`. Both scenes are from
 * project_scene_to_samples(). */
void splats_copy_closeup(splats *t, const scene *s, const splats *closeup, const scene *closer);

/* A list of points whose discs cover samples of a square, including hidden points, nearest first. A zeroed list is
 * empty. The caller frees the items of the list. */
typedef ARRAY(struct splat_covering) splat_list;

typedef struct splat_covering {
    size_t marker; /* the index of the point's marker in the scene */
    /* the least depth of the point's disc within this square of the screen; the list of a square is sorted by `depth`,
     * then by view_depth, then by id */
    int32_t depth;
    double view_depth;
    uint64_t id;
} splat_covering;

/* List the points of a scene whose discs cover samples of a square. `s` is from project_scene_to_samples(). Returns
 * false if memory runs out. Cost: O(markers). */
bool splats_list_covering_points(const scene *s, const splat_square *samples, splat_list *list);

#endif
