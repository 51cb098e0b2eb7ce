/* folder.h - the folder of a recording: made, checked, and filled with files that are there whole or not at all. */
#ifndef RECORD_FOLDER_H
#define RECORD_FOLDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* One sentence: what could not be done, and why. */
typedef struct record_error {
    char text[512];
} record_error;

/* Write a sentence; always false, so that a caller can return it. */
bool record_fail(record_error *error, const char *format, ...);

/* Make the folder and its parents where they are missing. */
bool folder_make(const char *folder, record_error *error);

/* The same for a recording. An existing folder must hold no recording and no frames. */
bool folder_prepare(const char *folder, record_error *error);

/* Remove the files of a recording that did not come to its first frame. */
void folder_abandon(const char *folder);

/* The names of a recording's files beside its frames; null beyond the last. */
const char *folder_fact_name(size_t i);

/* Whether a name is that of one of these files, of a part's lines, or begins as a frame's: what tells a folder that was
 * filmed into. */
bool folder_is_name(const char *name);

/* Whether a name is that of a file that was half written when something killed who wrote it: "session.json.part" and
 * the like, and the session of a program that died. */
bool folder_is_unfinished(const char *name);

/* Remove what a recording that is whole has no more use for: the lines of its parts, and files that were half written
 * when something killed who wrote them. */
bool folder_sweep(const char *folder, record_error *error);

/* "folder/name"; owned by the caller, null when there is no memory. */
char *folder_path(const char *folder, const char *name);

/* Whether the folder has anything of this name. */
bool folder_has(const char *folder, const char *name);

/* A file that is written by way of "<path>.part" and a rename: there whole, or not at all. What is there already and is
 * no regular file, a pipe say, is written to as it is. */
typedef struct part_file {
    FILE *stream;
    const char *path;
    char *part; /* where the stream goes */
} part_file;

bool part_open(part_file *file, const char *path, record_error *error);
bool part_close(part_file *file, record_error *error);

/* Leave no file, and what was there before as it was; always false, so that a caller can return it. */
bool part_abandon(part_file *file);

/* Write a whole file of the folder so. */
bool folder_write(const char *folder, const char *name, const char *bytes, size_t size, record_error *error);

/* The same where several processes have these bytes to write, at the same time perhaps: what is there already stays,
 * and *same says whether it has these bytes. `writer` is a word that no other of them has. */
bool folder_write_once(const char *folder, const char *name, const char *writer, const char *bytes, size_t size,
                       bool *same, record_error *error);

/* The same without writing: what is not there is the same. */
bool folder_compare(const char *folder, const char *name, const char *bytes, size_t size, bool *same,
                    record_error *error);

#endif
