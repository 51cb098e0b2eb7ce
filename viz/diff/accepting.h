/* SPDX-License-Identifier: MIT */
/* accepting.h - the state of an accept command, shared by the accept*.c files. */
#ifndef DIFF_ACCEPTING_H
#define DIFF_ACCEPTING_H

#include "accept.h"
#include "diff.h"

/* What happens to a reference. */
typedef enum action { KEPT, CHANGED, ADDED, REMOVED, ACTIONS } action;

typedef struct accepting {
    const accept_options *options;
    diff_side reference, frames;
    bool is_new; /* there was no reference */
    diff_result result;
    action *actions; /* one a pair */
    size_t counts[ACTIONS];
    FILE *out;
} accepting;

/* Check that a recording is not being written, and that it is complete: a missing frame would remove its reference.
 * Sides that are no recording pass. Return false with an error. */
bool accept_check_ended(const diff_side *side, octreel_error *error);
bool accept_check_whole(const diff_side *side, octreel_error *error);

/* Copy the pictures into the store, if there is one, and write the baseline. */
bool accept_digests(accepting *a, octreel_error *error);

/* Replace the pictures of the reference and, if a whole recording is accepted, its other files. */
bool accept_pictures(accepting *a, octreel_error *error);

#endif
