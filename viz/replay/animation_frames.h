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
    uint64_t every;       /* of these pictures, every n-th is chosen, where n is `every`; 0 means 1 */
} frame_choice;

typedef struct listed_frame {
    uint64_t number;
    char *path; /* owned */
} listed_frame;

typedef struct animation_frames {
    listed_frame *frames; /* at least one, in the order of their numbers */
    size_t count;
    int width, height; /* the size of every frame, in pixels */
    bool are_ticks;    /* true: the frames of a recording; false: other pictures */
    /* `missing`: the number of frames that seem to be missing, because two neighbouring numbers differ by more than the
     * smallest such difference. `missing_after`: the number of the frame before the first missing frame. */
    uint64_t missing, missing_after;
} animation_frames;

/* List the chosen pictures. In a folder with frames of a recording, other pictures are ignored. Returns false and sets
 * *error if no picture is chosen, or if the chosen pictures have different sizes. Cost: the header of every chosen file
 * is read. */
bool animation_frames_read(const char *folder, const frame_choice *choice, animation_frames *list,
                           octreel_error *error);
void animation_frames_release(animation_frames *list);

#endif
