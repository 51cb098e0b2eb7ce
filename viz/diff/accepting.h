/* SPDX-License-Identifier: MIT */
/* accepting.h - the state of an accept command, shared by the accept*.c files. */
#ifndef DIFF_ACCEPTING_H
#define DIFF_ACCEPTING_H

#include "accept.h"
#include "diff.h"

/* What the accept command does with a reference. */
typedef enum action { KEPT, CHANGED, ADDED, REMOVED, ACTIONS } action;

typedef struct accepting {
    const accept_options *options;
    diff_side reference, frames;
    bool is_new; /* true: the reference does not exist yet and is created */
    diff_result result;
    action *actions;        /* actions[i]: the action for pair i */
    size_t counts[ACTIONS]; /* counts[x]: the number of pairs with action x */
    FILE *out;
} accepting;

/* accept_check_ended() checks that no process is writing a recording. accept_check_whole() checks that the recording is
 * complete, because accepting an incomplete one would remove the reference of each missing frame. Both functions do
 * nothing for a side that is not a recording, and return false with an error if the check fails. */
bool accept_check_ended(const diff_side *side, octreel_error *error);
bool accept_check_whole(const diff_side *side, octreel_error *error);

/* Copy the pictures into the picture store, if one was given, and write the baseline. */
bool accept_digests(accepting *a, octreel_error *error);

/* Replace the pictures of the reference. If a whole recording is accepted, also replace the other files of the
 * reference. */
bool accept_pictures(accepting *a, octreel_error *error);

#endif
