/* SPDX-License-Identifier: MIT */
/* frame_checks.h - draws a few frames of a recording a second time, with GL, and compares the pixels.
 *
 * OSMesa is the authority on pixels, but the integer rasterizer is 2 to 3 times as fast. So the integer rasterizer
 * draws every frame, and GL also draws the first, every CHECK_EVERY-th and the last. Each comparison comes before the
 * frame is written. Where GL cannot be loaded, frames are not checked and `reason` says why; recording goes on, since
 * the frames are the same bytes. */
#ifndef RECORD_FRAME_CHECKS_H
#define RECORD_FRAME_CHECKS_H

#include "picture.h"

#define CHECK_EVERY 100 /* frames */

/* The result of all checks. Plain bytes: jobs send it through a pipe. */
typedef struct frame_checks {
    uint64_t count;       /* frames that both rasterizers draw with the same pixels */
    draw_context by;      /* the GL context that draws them; DRAW_AUTO before the first check */
    octreel_error reason; /* why no further frame can be checked; "": nothing prevents it */
} frame_checks;

/* "OSMesa", "EGL". */
const char *frame_checks_title(draw_context by);

/* Compare the scene that the picture shows with the same scene drawn by GL. `name` is the frame in the error. False
 * where pixels differ: the two pictures are then kept as PREFIX.integers.png and PREFIX.gl.png, and p->frame is that
 * of GL. */
bool frame_checks_compare(frame_checks *checks, picture *p, const scene *s, const char *name, const char *prefix,
                          octreel_error *error);

#endif
