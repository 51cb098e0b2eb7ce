/* SPDX-License-Identifier: MIT */
/* folder.h - the folder of a recording: creates it, checks it, and writes its files atomically. */
#ifndef FORMATS_FOLDER_H
#define FORMATS_FOLDER_H

#include "file.h"

#include <stdint.h>

/* Create the folder and its parents if they do not exist. */
bool folder_create(const char *folder, octreel_error *error);

/* Create the folder for a recording. Fails if the folder already contains a recording or frames. */
bool folder_create_for_recording(const char *folder, octreel_error *error);

/* Remove the files of a recording that failed before its first frame. */
void folder_remove_recording_files(const char *folder);

/* Print the file name of a chunk of ticks.jsonl with the ticks [first, last): "ticks_10_20.jsonl". Returns `name`. */
#define CHUNK_NAME 56
char *chunk_print_name(uint64_t first, uint64_t last, char name[CHUNK_NAME]);

/* Parse the name of a chunk. False for any other name. */
bool chunk_parse_name(const char *name, uint64_t *first, uint64_t *last);

/* The names of the files of a recording that are not frames; null after the last. */
extern const char *const recording_files[];

/* The folder that holds the old recording while a new one replaces it. */
#define FOLDER_ASIDE "octreel-replaced"

/* True if a file of this name shows that its folder holds a recording: one of recording_files, the lines of a chunk,
 * or a name that begins like a frame. */
bool folder_is_recording_file(const char *name);

/* True if a file of this name is incomplete because its writer was killed: "session.json.part" and similar names, and
 * session.json.live of a program that ended early. */
bool folder_is_unfinished_file(const char *name);

/* Remove files that a complete recording does not need: chunks of ticks.jsonl, and incomplete files. */
bool folder_remove_leftovers(const char *folder, octreel_error *error);

/* Remove a file of the folder, which may be missing. */
bool folder_remove_file(const char *folder, const char *name, octreel_error *error);

/* Write a file in the folder atomically. */
bool folder_write_file(const char *folder, const char *name, const char *bytes, size_t size, octreel_error *error);

#endif
