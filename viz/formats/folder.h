/* SPDX-License-Identifier: MIT */
/* folder.h - the folder of a recording: made, checked, and filled with files written whole or not at all. */
#ifndef FORMATS_FOLDER_H
#define FORMATS_FOLDER_H

#include "file.h"

#include <stdint.h>

/* Make the folder and its parents where they are missing. */
bool folder_make(const char *folder, octreel_error *error);

/* The same for a recording. An existing folder must hold no recording and no frames. */
bool folder_prepare(const char *folder, octreel_error *error);

/* Remove the files of a recording that failed before its first frame. */
void folder_abandon(const char *folder);

/* The lines of the ticks [first, last) alone, of a recording that is filmed in chunks: "ticks_10_20.jsonl". */
#define CHUNK_NAME 56
char *chunk_name(uint64_t first, uint64_t last, char name[CHUNK_NAME]);

/* The ticks of such a name; false for any other name. */
bool chunk_parse_name(const char *name, uint64_t *first, uint64_t *last);

/* The names of a recording's files beside its frames; null beyond the last. */
const char *folder_fact_name(size_t i);

/* Where a recording that is being replaced is for the moment. */
#define FOLDER_ASIDE "octreel-replaced"

/* Whether a name is that of one of these files, of a chunk's lines, or begins as a frame's: what tells a folder that
 * was filmed into. */
bool folder_is_name(const char *name);

/* Whether a name is that of a file that was half written when something killed who wrote it: "session.json.part" and
 * the like, and the session of a program that died. */
bool folder_is_unfinished(const char *name);

/* Remove what a recording that is whole has no more use for: the lines of its chunks, and files that were half written
 * when something killed who wrote them. */
bool folder_sweep(const char *folder, octreel_error *error);

/* Write a file of the folder, whole or not at all. */
bool folder_write(const char *folder, const char *name, const char *bytes, size_t size, octreel_error *error);

#endif
