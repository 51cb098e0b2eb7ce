/* SPDX-License-Identifier: MIT */
/* animate.h - makes one film of many frames: an animated PNG, or a video through ffmpeg. */
#ifndef REPLAY_ANIMATE_H
#define REPLAY_ANIMATE_H

#include "animation_frames.h"
#include "watcher.h"

#define ANIMATION_MOST_RATE 120 /* the maximum number of frames per second */

typedef struct animation_options {
    uint16_t rate;                /* frames per second, 1 to ANIMATION_MOST_RATE */
    int left, top, width, height; /* the part of the frames that is shown; width 0: all */
    watcher watch;                /* called after each frame that was read; may stop the film */
} animation_options;

typedef struct animation_summary {
    size_t frames; /* the number of frames that the film shows; 0: the film was stopped, and no file was written */
    size_t stored; /* the number of frames that differ from the frame before; only they are stored */
    int width, height;
    int colors; /* the number of colours in the palette; 0: the film is an animated PNG without a palette, or a video */
} animation_summary;

/* Returns whether the ending of a file's name asks for a video, which ffmpeg writes. Other files are animated PNGs. */
bool animation_is_video(const char *path);

/* Write the film. It appears by a rename, complete or not at all. An animated PNG has the same bytes on every machine:
 * its palette has the colours of all frames if there are at most 256, else it is RGB. Frames that repeat the frame
 * before only prolong it. Returns false and sets *error on failure. Frames are read one after the other, twice for
 * an animated PNG. Memory: three frames, whatever their number. */
bool animate(const animation_frames *list, const animation_options *options, const char *path,
             animation_summary *summary, octreel_error *error);

#endif
