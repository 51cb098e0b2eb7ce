/* SPDX-License-Identifier: MIT */
/* accepting.h - what the files of accept.c share: both sides while the new one is taken over. */
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

/* Whether nobody is filming a recording; and whether it has all that its session makes: the frames that it lacks would
 * be taken for frames that are gone. What is no recording is fine. */
bool accept_check_ended(const diff_side *side, octreel_error *error);
bool accept_check_whole(const diff_side *side, octreel_error *error);

/* Check that the options fit the reference: a baseline needs a reason, and other references take none. */
bool accept_check_words(const accepting *a, octreel_error *error);

/* Put the pictures into the store, if there is one, and write the baseline. */
bool accept_digests(accepting *a, octreel_error *error);

/* Put the pictures, and of a recording that is accepted whole its other files, in place of those of the reference. */
bool accept_pictures(accepting *a, octreel_error *error);

#endif
