/* SPDX-License-Identifier: MIT */
/* splats.h - points painted one by one, each with its own colour: squares of whole samples, of which the nearest wins,
 * lit by the depths around them. All in integers, once the points' places and depths are known. For this folder.
 *
 * GL or the filler only fills: where points are seen the quads have the index THEME_OWN, and what colour that is at
 * each sample is known here.
 */
#ifndef DRAW_SPLATS_H
#define DRAW_SPLATS_H

#include "quads.h"

/* Data that is reused from frame to frame. Empty when zeroed. */
typedef struct splats {
    struct splat *samples; /* what is nearest at each */
    uint32_t *shared;      /* under POINTS_BY_DENSITY: the points whose middle is in each pixel */
    uint8_t *colors;       /* r, g, b a sample, where the picture has the index THEME_OWN */
    size_t room;           /* samples; of `shared` and `colors` likewise, where they are needed */
} splats;

void splats_release(splats *t);

/* Where the view of a scene, which is in samples, paints points, make room for colours and add the quads of its points.
 * False when there is no memory. Cost: O(samples + points * the samples of one). */
bool splats_paint(splats *t, quad_list *quads, const scene *s);

/* Colour a rectangle of the picture in pixels, such as a swatch. Above points alone. */
void splats_fill(splats *t, const scene *s, const scene_panel *panel);

/* Take over the colours of a close-up, where its part of the picture is; both scenes are in samples. */
void splats_put_closeup(splats *t, const scene *s, const splats *closeup, const scene *closer);

/* The painted points that cover any of some samples, those that others hide too, the nearest first; and where their
 * markers are. Empty when zeroed; free the items. */
typedef struct splat_list {
    struct splat_covering *items;
    size_t count, room;
} splat_list;

typedef struct splat_covering {
    size_t marker;
    int32_t depth; /* as it is painted there; of equal ones the nearer, and then the lower id, comes first */
    double view_depth;
    uint64_t id;
} splat_covering;

/* So many samples to each side. */
typedef struct splat_square {
    int left, top, side;
} splat_square;

/* List those of a scene, which is in samples. False when there is no memory. Cost: O(markers). */
bool splats_list(const scene *s, const splat_square *samples, splat_list *list);

#endif
