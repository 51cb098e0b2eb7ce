/* SPDX-License-Identifier: MIT */
/* accept.h - new frames become the reference. */
#ifndef DIFF_ACCEPT_H
#define DIFF_ACCEPT_H

#include "diff.h"

#include <stdio.h>

typedef struct accept_options {
    const char *reference;    /* a PNG, a folder, a recording or a file of digests; made where there is nothing */
    const char *frames;       /* a PNG, a folder or a recording */
    const char *const *names; /* the frames to take over; */
    size_t name_count;        /* none: all of them, and references without a frame are removed */
} accept_options;

/* Compare, then write what differs: each file whole, by a rename. A reference with the same pixels stays as it is; but
 * of a recording that is accepted whole, all files are taken over. What was done is said on `out` at the end. False
 * with an error: before anything is written when a side, a new frame or a name is invalid. */
bool accept_frames(const accept_options *options, FILE *out, octreel_error *error);

#endif
