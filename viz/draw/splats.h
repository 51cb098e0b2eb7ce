/* SPDX-License-Identifier: MIT */
/* splats.h - paints points as discs, each in its own colour. Private to this folder.
 *
 * Pictures hold indices of the theme's colours, and points have far more colours than the theme. So quads of points
 * have the index THEME_OWN, and `colors` holds the colour of each sample with this index. */
#ifndef DRAW_SPLATS_H
#define DRAW_SPLATS_H

#include "array.h"
#include "quads.h"

/* Buffers that are reused from frame to frame. A zeroed struct is empty. */
typedef struct splats {
    struct splat *samples; /* the nearest point at each sample */
    uint32_t *shared;      /* with POINTS_BY_DENSITY: the number of points whose centre is in each pixel */
    theme_color *colors;   /* the colour of each sample; valid where the picture has the index THEME_OWN */
    size_t sample_room, shared_room, color_room;
} splats;

void splats_release(splats *t);

/* Add the quads of a scene's points, and set the colours of their samples. `s` is from project_scene_to_samples().
 * False when out of memory. Cost: O(samples of the picture + points * samples of a disc). */
bool splats_paint_points(splats *t, quad_list *quads, const scene *s);

/* Set the colours of a panel whose quad has the index THEME_OWN, such as a swatch of the legend. */
void splats_fill_panel(splats *t, const scene *s, const scene_panel *panel);

/* Copy the colours of the close-up `closer` into its part of the picture of `s`. Both scenes are from
 * project_scene_to_samples(). */
void splats_copy_closeup(splats *t, const scene *s, const splats *closeup, const scene *closer);

/* A list of points that cover samples of a square, including hidden points, nearest first. A zeroed list is empty. The
 * caller frees its items. */
typedef ARRAY(struct splat_covering) splat_list;

typedef struct splat_covering {
    size_t marker; /* the index of the point's marker in the scene */
    int32_t depth; /* the least depth of the point's disc in the square; ties are decided by view_depth, then by the
                      lower id */
    double view_depth;
    uint64_t id;
} splat_covering;

/* A square in samples. */
typedef struct splat_square {
    int left, top, side;
} splat_square;

/* List the points of a scene that cover samples of a square. `s` is from project_scene_to_samples(). False when out of
 * memory. Cost: O(markers). */
bool splats_list_covering_points(const scene *s, const splat_square *samples, splat_list *list);

#endif
