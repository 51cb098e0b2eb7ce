/* SPDX-License-Identifier: MIT */
/* accept.h - new frames become the reference. */
#ifndef DIFF_ACCEPT_H
#define DIFF_ACCEPT_H

#include "baseline.h"
#include "frame_list.h"

#include <stdio.h>

typedef struct accept_options {
    const char *reference; /* a PNG, a folder, a recording or a baseline; created if it does not exist */
    const char *frames;    /* a PNG, a folder or a recording */
    const frame_list
        *names; /* the frames to take over; none: all of them, and references without a frame are removed */

    /* For baselines only; with a reason, a reference that does not exist becomes a baseline. */
    acceptance_note note; /* reason null: none was given */
    const char *store;    /* the folder where pictures are stored; null: they are not stored */
    bool variant;         /* keep the digests that were accepted before, too */
    bool json;            /* print the changes as one JSON object that lists all changed frames */
} accept_options;

/* Compare, then write what differs. A reference with the same pixels stays as it is; but of a recording that is
 * accepted whole, all files are taken over. What was done is said on `out` at the end; it may be null. False with an
 * error: before anything is written when a side, a new frame or a name is invalid.
 *
 * Of two who accept at once the second sees what the first has done: a file, and a folder, is locked by the folder in
 * which it lies. Where a disk is full the reference is that of before. For all that is taken over is on the disk, as
 * NAME.part, before the first of these takes its place by a rename; pictures are in the store before a file of digests
 * is renamed. Where a rename fails or the process is killed among them, each file is the one of before or the new one,
 * whole, and none is removed yet whose frame is gone: to accept once more does the rest. */
bool accept_frames(const accept_options *options, FILE *out, octreel_error *error);

#endif
