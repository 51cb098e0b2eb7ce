/* SPDX-License-Identifier: MIT */
/* accepting.h - the state of an accept command, shared by the accept*.c files. */
#ifndef DIFF_ACCEPTING_H
#define DIFF_ACCEPTING_H

#include "accept.h"
#include "diff.h"

/* What happens to each reference. */
typedef enum action { KEPT, CHANGED, ADDED, REMOVED, ACTIONS } action;

typedef struct accepting {
    const accept_options *options;
    diff_side reference, frames;
    bool is_new; /* the reference does not exist yet and is created */
    diff_result result;
    action *actions; /* one action for each pair */
    size_t counts[ACTIONS];
    FILE *out;
} accepting;

/* Check that no process is writing a recording, and that the recording is complete: a missing frame would remove its
 * reference. Both functions accept sides that are not recordings. They return false with an error. */
bool accept_check_ended(const diff_side *side, octreel_error *error);
bool accept_check_whole(const diff_side *side, octreel_error *error);

/* Copy the pictures into the picture store, if one was given, and write the baseline. */
bool accept_digests(accepting *a, octreel_error *error);

/* Replace the pictures of the reference. If a whole recording is accepted, replace its other files, too. */
bool accept_pictures(accepting *a, octreel_error *error);

#endif
