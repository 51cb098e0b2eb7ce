/* SPDX-License-Identifier: MIT */
/* accept.h - new frames become the reference. */
#ifndef DIFF_ACCEPT_H
#define DIFF_ACCEPT_H

#include "baseline.h"
#include "frame_list.h"

#include <stdio.h>

typedef struct accept_options {
    const char *reference; /* a PNG, a folder, a recording or a file of digests; made where there is nothing */
    const char *frames;    /* a PNG, a folder or a recording */
    const frame_list
        *names; /* the frames to take over; none: all of them, and references without a frame are removed */

    /* Of a file of digests alone; with a reason, one is made where there is nothing, and one of version 1 becomes a
     * baseline. */
    acceptance_words words; /* reason null: it is not said */
    const char *store;      /* where pictures are put; null: nowhere */
    bool variant;           /* digests of before stay accepted, too */
    bool json;              /* what was done is said as one JSON object, which lists all frames that it was done to */
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
