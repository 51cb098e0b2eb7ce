/* SPDX-License-Identifier: MIT */
/* animate.h - makes one film of many frames: an animated PNG, or a video through ffmpeg. */
#ifndef REPLAY_ANIMATE_H
#define REPLAY_ANIMATE_H

#include "animation_frames.h"
#include "watcher.h"

#define ANIMATION_MOST_RATE 120 /* the maximum number of frames per second */

typedef struct animation_options {
    uint16_t rate;                /* frames per second, 1 to ANIMATION_MOST_RATE */
    int left, top, width, height; /* the part of each frame that the film shows; width 0: the whole frame */
    watcher watch;                /* called after each frame that was read; may stop the film */
} animation_options;

typedef struct animation_summary {
    size_t frames; /* the number of frames that the film shows; 0: the film was stopped, and no file was written */
    size_t stored; /* the number of frames without repetitions of the frame before; an animated PNG stores only these */
    int width, height;
    int colors; /* the number of colours in the palette; 0: the film is an animated PNG without a palette, or a video */
} animation_summary;

/* Returns true if the ending of a file's name, such as .mp4, selects a video, which ffmpeg writes. Any other file
 * becomes an animated PNG. */
bool animation_is_video(const char *path);

/* Write the film to `path`. The file appears by a rename: complete or not at all. An animated PNG has the same bytes on
 * every machine: if the frames have at most 256 colours together, it has a palette of these colours, otherwise it is
 * RGB. A frame equal to the previous one is not stored again; the previous one is shown longer. Returns false and sets
 * *error on failure. Frames are read one after the other, twice for an animated PNG. Memory: three frames, whatever
 * their number. */
bool animate(const animation_frames *list, const animation_options *options, const char *path,
             animation_summary *summary, octreel_error *error);

#endif
