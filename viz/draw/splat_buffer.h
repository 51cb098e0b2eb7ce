/* SPDX-License-Identifier: MIT */
/* splat_buffer.h - the nearest disc at each sample of a picture, and the light at each sample. Private to this folder.
 * splats.c explains discs and light. */
#ifndef DRAW_SPLAT_BUFFER_H
#define DRAW_SPLAT_BUFFER_H

#include "scene.h"

/* The unit of depth is 1/8 of a sample. So a difference of depth between two samples is a slope, which depends neither
 * on the scale of the world nor on the camera. */
#define DEPTH_PARTS 8
#define MOST_DEPTH (1 << 29)

/* A square in samples. */
typedef struct splat_square {
    int left, top, side;
} splat_square;

/* Discs of up to this diameter are drawn with a table of their depths. */
#define MOST_TABLE_SIDE 48

/* For each sample, the nearest disc. Around the picture there is a margin of samples without a disc, so that the
 * neighbours of a sample always exist. A zeroed struct is empty. */
typedef struct splat_buffer {
    int width, height;                    /* of the picture, in samples */
    int margin;                           /* the width of the margin, in samples */
    size_t stride;                        /* the number of samples in a row, with the margin */
    int32_t *depths;                      /* EMPTY_DEPTH where there is no disc */
    uint32_t *owners;                     /* 1 + the index of the disc's marker; 0: no disc */
    int32_t *tables[MOST_TABLE_SIDE + 1]; /* tables[n]: the depths of a disc of diameter n; null: not made yet */
    size_t depth_room, owner_room;
} splat_buffer;

void splat_buffer_release(splat_buffer *b);

/* Empty the buffer for a scene from project_scene_to_samples(). Returns false if memory runs out. */
bool splat_buffer_clear(splat_buffer *b, const scene *s);

/* Find the depth of a disc at sample (x, y). `depth` is the depth of the disc's centre. Returns false if the sample is
 * outside the disc. */
bool find_disc_depth(const splat_square *q, int x, int y, int32_t depth, int32_t *at);

/* Draw the disc of the marker with this index. Returns false if memory runs out. */
bool splat_buffer_draw_disc(splat_buffer *b, const scene *s, size_t index, const splat_square *q, int32_t depth);

/* Compute the light at each sample of row y; 256 is full light. The light of samples without a disc is undefined.
 * `light` must have room for 2 * width numbers; the second half is scratch space. */
void splat_buffer_find_light(const splat_buffer *b, const scene *s, int y, int32_t *light);

/* Returns the owners of the samples of row y. */
static inline const uint32_t *splat_buffer_row_owners(const splat_buffer *b, int y)
{
    return b->owners + (size_t)(y + b->margin) * b->stride + (size_t)b->margin;
}

#endif
