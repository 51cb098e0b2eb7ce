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

/* Compare, then write what differs: each file whole, by a rename. A reference with the same pixels stays as it is; but
 * of a recording that is accepted whole, all files are taken over. What was done is said on `out` at the end; it may be
 * null. False with an error: before anything is written when a side, a new frame or a name is invalid.
 *
 * A file of digests is read, changed and renamed while its folder is locked, after pictures are in the store: of two
 * who accept at once the second sees what the first has done, and where a disk is full the file is that of before. */
bool accept_frames(const accept_options *options, FILE *out, octreel_error *error);

#endif
