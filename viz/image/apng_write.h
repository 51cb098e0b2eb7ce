/* SPDX-License-Identifier: MIT */
/* apng_write.h - writes animated PNG files (APNG), frame by frame. */
#ifndef IMAGE_APNG_WRITE_H
#define IMAGE_APNG_WRITE_H

#include "image.h"

/* The longest time for which one frame can be shown, in units of 1 / rate seconds. */
#define APNG_LONGEST 65535

typedef struct apng_description {
    int width, height; /* the size of every frame, each side 1 to IMAGE_MAX_SIDE */
    /* not null: a frame has one valid palette index per pixel; null: a frame has r, g, b per pixel */
    const image_palette *palette;
    uint32_t frames; /* the number of frames that will be added, at least 1 */
    uint16_t rate;   /* frames are shown for multiples of 1 / rate seconds; at least 1 */
} apng_description;

typedef struct apng_writer apng_writer;

/* Open a file for an animation that repeats for ever. A player without support for APNG shows the first frame. `path`
 * must outlive the writer. Returns null and sets *error on failure. Memory: two frames, and the compressed bytes of a
 * frame. */
apng_writer *apng_writer_open(const char *path, const apng_description *about, octreel_error *error);

/* Append a frame, which is shown for `shown` units, 1 to APNG_LONGEST. Only the smallest rectangle with all changed
 * pixels is stored. The same frames give the same bytes on every machine. Returns false and sets *error on failure; the
 * writer must then be discarded. */
bool apng_writer_add(apng_writer *w, const uint8_t *pixels, uint16_t shown, octreel_error *error);

/* Complete the file after the last frame. The file appears at its path by a rename. Returns false and sets *error on
 * failure. Frees the writer in both cases. */
bool apng_writer_close(apng_writer *w, octreel_error *error);

/* Remove the incomplete file and free the writer. `w` may be null. Always returns false. */
bool apng_writer_discard(apng_writer *w);

#endif
