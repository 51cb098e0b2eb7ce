/* SPDX-License-Identifier: MIT */
/* animation_frames.h - the pictures of a folder that a film shows. */
#ifndef REPLAY_ANIMATION_FRAMES_H
#define REPLAY_ANIMATION_FRAMES_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The frames of a recording are numbered by their ticks. The pictures of another folder are numbered from 0 on, in the
 * order of their names. */
typedef struct frame_choice {
    uint64_t first, last; /* the numbers first to last - 1 are chosen; last 0: all from `first` on */
    uint64_t every;       /* of them, only every n-th picture is chosen; 0 stands for 1 */
} frame_choice;

typedef struct listed_frame {
    uint64_t number;
    char *path; /* owned */
} listed_frame;

typedef struct animation_frames {
    listed_frame *frames; /* at least one, in the order of their numbers */
    size_t count;
    int width, height; /* of every frame */
    bool are_ticks;    /* true: the frames of a recording; false: other pictures */
    /* The number of frames that seem to be missing, because the step from one number to the next is larger than the
     * smallest step; and the number of the frame before the first one that is missing. */
    uint64_t missing, missing_after;
} animation_frames;

/* List the chosen pictures. In a folder with frames of a recording, other pictures are ignored. Returns false and sets
 * *error if there are none, or if they have different sizes. Cost: the header of every chosen file is read. */
bool animation_frames_read(const char *folder, const frame_choice *choice, animation_frames *list,
                           octreel_error *error);
void animation_frames_release(animation_frames *list);

#endif
