/* SPDX-License-Identifier: MIT */
/* replacement.h - replaces the recording in a folder by a new one; other files in the folder stay. Only
 * replacement_check() may be used outside viz/record. */
#ifndef RECORD_REPLACEMENT_H
#define RECORD_REPLACEMENT_H

#include "folder.h"

/* Returns whether --replace may be used on a folder; if not, sets an error. The folder must have a recording.json; all
 * files in it whose names a recording uses must be regular files; and no process may be recording into it. A missing
 * folder and a folder without a recording are accepted too. */
bool replacement_check(const char *folder, octreel_error *error);

typedef struct replacement {
    /* The folder of the recording, and the folder inside it that holds the old files; `aside` null: no replacement is
     * in progress. */
    char *folder, *aside;
    int lock; /* descriptor of the folder `aside`, open and locked; -1: no such folder is open */
} replacement;

/* Check the folder again and move its recording into the folder `aside`. If the folder has no recording, the folder
 * `aside` stays empty. If this fails, the folder stays as it was. */
bool replacement_begin(replacement *r, const char *folder, octreel_error *error);

/* Remove the old files in the folder `aside`, if there are any. */
void replacement_remove_old(replacement *r);

/* Remove the new recording and move the old recording back into the folder. Returns false if no replacement is in
 * progress. */
bool replacement_undo(replacement *r);

/* Remove old files that a killed process left in the folder FOLDER_ASIDE. Call this function once the new recording is
 * complete. */
void replacement_remove_leftovers(const char *folder);

#endif
