/* SPDX-License-Identifier: MIT */
/* replacement.h - replaces the recording in a folder by a new one; other files in the folder stay. Only
 * replacement_check() may be used outside viz/record. */
#ifndef RECORD_REPLACEMENT_H
#define RECORD_REPLACEMENT_H

#include "folder.h"

/* Returns true if --replace may be used on a folder: it has a recording.json, all files whose names a recording uses
 * are regular files, and no process is recording into it. A folder without a recording or a missing folder is accepted
 * too. */
bool replacement_check(const char *folder, octreel_error *error);

typedef struct replacement {
    char *folder, *aside; /* `aside` is a folder inside `folder`, for the old files; null: no old recording */
    int lock;             /* descriptor of `aside`, open and locked; -1: none */
} replacement;

/* Check the folder again and move its recording into the folder aside. Does nothing if there is no recording. If this
 * fails, the folder stays as it was. */
bool replacement_begin(replacement *r, const char *folder, octreel_error *error);

/* Remove the files in the folder aside, if there are any. */
void replacement_remove_old(replacement *r);

/* Remove the new recording and move the old one back. Returns false if there is no old recording. */
bool replacement_undo(replacement *r);

/* Remove old files that a killed process left in the folder aside. Call this once the new recording is complete. */
void replacement_sweep(const char *folder);

#endif
