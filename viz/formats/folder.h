/* SPDX-License-Identifier: MIT */
/* folder.h - creates and checks the folder of a recording, and writes files in it atomically. */
#ifndef FORMATS_FOLDER_H
#define FORMATS_FOLDER_H

#include "file.h"

#include <stdint.h>

/* Creates a folder and its parent folders, as far as they do not exist. Returns false with an error. If the path is
 * too long, no folder is created. */
bool folder_create(const char *folder, octreel_error *error);

/* Creates, in a folder, the parent folders of a relative path: for "menu/1.png" the subfolder "menu". Returns false
 * with an error, also if a parent folder is a symbolic link, which could lead out of the folder.
 * folder_remove_empty_parents() removes those parent folders that are empty. */
bool folder_create_parents(const char *folder, const char *name, octreel_error *error);
void folder_remove_empty_parents(const char *folder, const char *name);

/* Creates the folder for a recording. Returns false with an error if the folder already contains a recording or
 * frames. */
bool folder_create_for_recording(const char *folder, octreel_error *error);

/* Removes the files of a recording that failed before its first frame was written. */
void folder_remove_recording_files(const char *folder);

/* Prints the file name of a chunk of ticks.jsonl: "ticks_10_20.jsonl" holds the ticks from 10 to 19; `last` is
 * exclusive. Returns `name`. */
#define CHUNK_NAME 56
char *chunk_print_name(uint64_t first, uint64_t last, char name[CHUNK_NAME]);

/* Parses the file name of a chunk of ticks.jsonl. Returns false if the name is not the name of a chunk. */
bool chunk_parse_name(const char *name, uint64_t *first, uint64_t *last);

/* The names of all files of a recording except its frames. A null pointer ends the list. */
extern const char *const recording_files[];

/* The name of the folder to which an old recording is moved while a new recording replaces it. */
#define FOLDER_ASIDE "octreel-replaced"

/* Returns whether a file with this name shows that its folder is a recording. Such a name is one of recording_files,
 * FOLDER_ASIDE, the name of a chunk of ticks.jsonl, or any name that begins with "frame_". */
bool folder_is_recording_file(const char *name);

/* Returns whether a name marks a file that is incomplete because its writer was killed: "session.json.part" and similar
 * names, and "session.json.live" of a program that ended early. */
bool folder_is_unfinished_file(const char *name);

/* Removes files that a complete recording does not need: chunks of ticks.jsonl and incomplete files. Returns false
 * with an error. */
bool folder_remove_leftovers(const char *folder, octreel_error *error);

/* Removes a file from a folder. If the file does not exist, this is no error. Returns false with an error. */
bool folder_remove_file(const char *folder, const char *name, octreel_error *error);

/* Writes a file in the folder atomically: a reader finds the whole new file or none of it. Returns false with an
 * error. */
bool folder_write_file(const char *folder, const char *name, const char *bytes, size_t size, octreel_error *error);

#endif
