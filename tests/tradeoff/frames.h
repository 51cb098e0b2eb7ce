/* SPDX-License-Identifier: MIT */
/* frames.h - the scenes that pictures are measured on, and how unlike two pictures are. */
#ifndef TRADEOFF_FRAMES_H
#define TRADEOFF_FRAMES_H

#include "image.h"
#include "knob.h"
#include "scene.h"

typedef struct frame_kind {
    const char *name;
    size_t points; /* of a tree of clusters; 0: tick 219 of the default session */
} frame_kind;

/* What is drawn of it: the tree, or the tick. */
typedef struct subject subject;
subject *subject_make(const frame_kind *kind);
void subject_free(subject *s);
const octree *subject_tree(const subject *s);

/* Fill a scene with it. */
void subject_show(const subject *s, const view *v, scene *picture);

/* A scene of 16 * 16 samples a pixel in colours. Free it with image_release. */
enum { REFERENCE_SAMPLES = 16 };
image draw_reference(const scene *picture);

/* Attach a part of a frame around its middle to a table, `width` * `height` pixels, as a PNG. */
void attach_picture(const run *r, table *t, const image *frame, int width, int height, const char *caption);

/* Peak signal to noise over all channels in decibels; infinite for equal pictures. */
double peak_signal_to_noise(const image *a, const image *b);

#endif
