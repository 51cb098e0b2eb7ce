/* SPDX-License-Identifier: MIT */
/* replacement.h - a recording makes room for another one in its folder, and for nothing else: other files stay.
 *
 * What is there is set aside in a folder within the folder, until a tick of the new recording is filmed. Where that
 * fails it is put back; where the process is killed meanwhile, the next replacement begins with that. Private to this
 * folder, but for replacement_check(). */
#ifndef RECORD_REPLACEMENT_H
#define RECORD_REPLACEMENT_H

#include "folder.h"

/* Whether all that a recording would write over is a recording, which nobody is filming: it has a recording.json, and
 * what bears the names of a recording are regular files. A folder without a recording will do, and so will one that is
 * not there. */
bool replacement_check(const char *folder, octreel_error *error);

typedef struct replacement {
    char *folder, *aside; /* null: nothing is set aside */
    int lock;             /* that folder, open; -1: it is not */
} replacement;

/* Set a recording aside that is checked again first; where there is none there is nothing to do. On failure all is as
 * it was. */
bool replacement_begin(replacement *r, const char *folder, octreel_error *error);

/* Remove what is set aside, if anything is. */
void replacement_end(replacement *r);

/* Put it back, in place of what has been filmed; false where nothing was set aside. */
bool replacement_undo(replacement *r);

/* Remove what a killed process has set aside for a recording that is whole now. */
void replacement_sweep(const char *folder);

#endif
