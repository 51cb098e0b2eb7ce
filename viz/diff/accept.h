/* SPDX-License-Identifier: MIT */
/* accept.h - makes new frames the reference. */
#ifndef DIFF_ACCEPT_H
#define DIFF_ACCEPT_H

#include "baseline.h"
#include "frame_list.h"

#include <stdio.h>

typedef struct accept_options {
    const char *reference;   /* a PNG, a folder, a recording or a baseline; created if it does not exist */
    const char *frames;      /* a PNG, a folder or a recording */
    const frame_list *names; /* the frames to accept; empty: all of them, and references without a frame are removed */

    /* For baselines only; with a reason, a reference that does not exist becomes a baseline. */
    acceptance_note note; /* reason null: none was given */
    const char *store;    /* the folder where pictures are stored; null: they are not stored */
    bool variant;         /* keep the digests that were accepted before, too */
    bool json;            /* print the changes as one JSON object that lists all changed frames */
} accept_options;

/* Compare both sides, then replace the references that differ. References with equal pixels are not written; but if a
 * whole recording is accepted, all its files are replaced. A summary is printed to `out` at the end, which may be null.
 * Return false with an error; nothing has been written if a side, a new frame or a name is invalid.
 *
 * Concurrent calls run one after the other: the folder that holds the reference is locked. All new files are written as
 * NAME.part first and renamed when the last one is complete, so on a full disk the reference is unchanged. Pictures are
 * in the store before the baseline is renamed. If the process dies between renames, each file is either the old or the
 * new one, and no reference has been removed; accepting again completes the change. */
bool accept_frames(const accept_options *options, FILE *out, octreel_error *error);

#endif
