/* folder.h - the folder of a recording: made, checked, and filled with files that are there whole or not at all. */
#ifndef RECORD_FOLDER_H
#define RECORD_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

/* One sentence: what could not be done, and why. */
typedef struct record_error {
    char text[512];
} record_error;

/* Write a sentence; always false, so that a caller can return it. */
bool record_fail(record_error *error, const char *format, ...);

/* Make the folder and its parents where they are missing. An existing folder must hold no recording and no frames. */
bool folder_prepare(const char *folder, record_error *error);

/* "folder/name"; owned by the caller, null when there is no memory. */
char *folder_path(const char *folder, const char *name);

/* Write a file by way of "<name>.part" and a rename. */
bool folder_write(const char *folder, const char *name, const char *bytes, size_t size, record_error *error);

#endif
