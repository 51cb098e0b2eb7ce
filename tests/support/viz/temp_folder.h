/* SPDX-License-Identifier: MIT */
/* temp_folder.h - a temporary folder for one test, in which leftover files can be counted.
 *
 * cmocka_unit_test_setup_teardown(test, temp_folder_make, temp_folder_remove) puts a temp_folder into *state.
 */
#ifndef TEMP_FOLDER_H
#define TEMP_FOLDER_H

typedef struct temp_folder {
    char name[32];  /* relative to the current folder */
    char path[128]; /* of the file that temp_file() named last */
} temp_folder;

int temp_folder_make(void **state);

/* Remove the folder and the files and empty folders in it. */
int temp_folder_remove(void **state);

/* "<folder>/<name>", valid until the next call. */
const char *temp_file(temp_folder *folder, const char *name);

/* The number of files and folders in the folder. */
int temp_folder_count(const temp_folder *folder);

#endif
