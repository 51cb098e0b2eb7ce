/* SPDX-License-Identifier: MIT */
/* folder.h - the folder of a recording: creating it, checking it, and writing its files whole or not at all. */
#ifndef FORMATS_FOLDER_H
#define FORMATS_FOLDER_H

#include "file.h"

#include <stdint.h>

/* Create the folder and its parents if they do not exist. */
bool folder_make(const char *folder, octreel_error *error);

/* Create the folder for a recording. An existing folder must not contain a recording or frames. */
bool folder_prepare(const char *folder, octreel_error *error);

/* Remove the files of a recording that failed before its first frame. */
void folder_abandon(const char *folder);

/* The file name of the lines of ticks [first, last) of a recording made in chunks: "ticks_10_20.jsonl". */
#define CHUNK_NAME 56
char *chunk_name(uint64_t first, uint64_t last, char name[CHUNK_NAME]);

/* Parse the name of a chunk. False for any other name. */
bool chunk_parse_name(const char *name, uint64_t *first, uint64_t *last);

/* The names of the files of a recording that are not frames; null after the last. */
extern const char *const recording_files[];

/* The folder that holds the old recording while a new one replaces it. */
#define FOLDER_ASIDE "octreel-replaced"

/* Whether a file of this name shows that its folder holds a recording: one of recording_files, the lines of a chunk,
 * or a name that begins like a frame. */
bool folder_is_name(const char *name);

/* Whether a file of this name is incomplete because its writer was killed: "session.json.part" and similar names, and
 * session.json.live of a program that ended early. */
bool folder_is_unfinished(const char *name);

/* Remove the files that a complete recording does not need: the lines of its chunks, and incomplete files. */
bool folder_sweep(const char *folder, octreel_error *error);

/* Remove a file of the folder, which may be missing. */
bool folder_remove(const char *folder, const char *name, octreel_error *error);

/* Write a file in the folder, whole or not at all. */
bool folder_write(const char *folder, const char *name, const char *bytes, size_t size, octreel_error *error);

#endif
