/* SPDX-License-Identifier: MIT */
/* files.h - files and folders within the folder of a test.
 *
 * Except file_exists(), every function makes the test fail if it cannot do what it says.
 */
#ifndef FILES_H
#define FILES_H

#include <stdbool.h>
#include <stddef.h>

#include "temp_folder.h"

/* The path of a file, by value, so that a test can name several. */
typedef struct place {
    char path[1024];
} place;

place place_in(const temp_folder *folder, const char *name);
place place_below(const char *folder, const char *name);

/* A teardown for temp_folder_make: removes folders in the folder too, with all they hold. */
int nested_folder_remove(void **state);

/* Simulate a full disk: no file of this process can grow beyond this number of bytes, and writing more fails with "File
 * too large". SIZE_MAX ends the simulation. */
void limit_file_size(size_t bytes);

/* Whether a file or folder with this path exists. */
bool file_exists(const char *path);

/* Whether the path is a folder, and not a link to one. */
bool is_real_folder(const char *path);

/* The bytes of a file, with a zero behind them; the caller frees them. `size` may be null. */
char *file_read(const char *path, size_t *size);
void file_write(const char *path, const void *bytes, size_t size);
void file_write_text(const char *path, const char *text);

/* The names in a folder, sorted. */
typedef struct listing {
    char (*names)[256];
    size_t count;
} listing;

listing folder_list(const char *folder);
void listing_release(listing *names);

/* Copy the files of a folder into a new one. */
void copy_folder(const char *from, const char *to);

/* The test fails unless both files hold the same bytes. */
void assert_same_files(const char *a, const char *b);

/* The test fails unless both folders hold the same names and the same bytes. The bytes of the file `except` (may be
 * null) may differ. */
void assert_same_folders(const char *a, const char *b, const char *except);

#endif
