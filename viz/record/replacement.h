/* SPDX-License-Identifier: MIT */
/* replacement.h - replaces the recording in a folder by a new one; other files in the folder stay. Private to this
 * folder, except replacement_check(). */
#ifndef RECORD_REPLACEMENT_H
#define RECORD_REPLACEMENT_H

#include "folder.h"

/* Whether a folder may be replaced: all files whose names a recording uses are regular files, there is a
 * recording.json, and no process is recording into it. A folder without a recording, or no folder, is accepted as well.
 */
bool replacement_check(const char *folder, octreel_error *error);

typedef struct replacement {
    char *folder, *aside; /* `aside` is a folder inside `folder`; null: nothing is set aside */
    int lock;             /* an open and locked descriptor of `aside`; -1: none */
} replacement;

/* Check the folder again and move its recording aside. Does nothing where there is none. A failure changes nothing. */
bool replacement_begin(replacement *r, const char *folder, octreel_error *error);

/* Remove the files that are set aside, if there are any. */
void replacement_end(replacement *r);

/* Remove the new recording and restore the old one. False: nothing was set aside. */
bool replacement_undo(replacement *r);

/* Remove files that a killed process has set aside, once the new recording is complete. */
void replacement_sweep(const char *folder);

#endif
