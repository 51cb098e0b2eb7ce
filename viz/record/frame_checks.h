/* SPDX-License-Identifier: MIT */
/* frame_checks.h - draws some frames of a recording a second time, with GL, and compares the pixels.
 *
 * OSMesa defines which pixels are correct, but the integer rasterizer is 2 to 3 times as fast. So the integer
 * rasterizer draws every frame. GL also draws the first frame, every CHECK_EVERY-th frame and the last frame. A frame
 * is compared before it is written, except the last frame of a live recording. If GL cannot be loaded, frames are not
 * checked and `reason` contains the cause. The recording continues, because its frames have the same bytes with or
 * without checks. */
#ifndef RECORD_FRAME_CHECKS_H
#define RECORD_FRAME_CHECKS_H

#include "picture.h"

#define CHECK_EVERY 100 /* every 100th frame is checked */

/* The result of all checks. The struct contains no pointers, because jobs send its bytes through a socket. */
typedef struct frame_checks {
    uint64_t count;       /* number of frames that were checked and have the same pixels */
    draw_context by;      /* the GL context that draws the checked frames; DRAW_AUTO until the first check */
    octreel_error reason; /* the reason why no further frame can be checked; "" if frames can be checked */
} frame_checks;

/* Returns the title of a GL context, such as "OSMesa" or "EGL". */
const char *frame_checks_title(draw_context by);

/* Draw scene `s` with GL and compare the pixels with p->frame. `name` is the name of the frame in error messages.
 * Returns false if pixels differ. Both pictures are then kept, as PREFIX.integers.png and PREFIX.gl.png, and p->frame
 * contains the pixels of GL. */
bool frame_checks_compare(frame_checks *checks, picture *p, const scene *s, const char *name, const char *prefix,
                          octreel_error *error);

#endif
