/* SPDX-License-Identifier: MIT */
/* recording_file.h - recording.json, and the session.json in the same folder. recording.json holds the format version
 * of the recording, every view option, and the values that are derived from the options.
 *
 * `octreel help recording` (recording.txt) lists the members. The rows of view_options.c read and write the options. */
#ifndef FORMATS_RECORDING_FILE_H
#define FORMATS_RECORDING_FILE_H

#include "error.h"
#include "session_file.h"
#include "view.h"

#include <stdio.h>

/* The only version of the format that is written and read. Scene digests change with the version, so recordings of
 * other versions cannot be verified or continued. Version 2: scene digests hash names. Version 3: frames name the
 * kind of their pixel digest. Version 4: every option is written, "size" replaces "width" and "height", and derived
 * values are in "derived". */
#define RECORDING_VERSION 4

/* Returns a view in which every option has its default. The defaults are in the rows of view_options.c. */
view view_make_default(void);

/* Writes recording.json. The caller checks the stream for errors. */
void recording_write(FILE *out, const view *v, uint64_t every);

/* Reads recording.json in a folder: its view, and its interval of frames (--every). A missing option gets its
 * default. Returns false with an error if the file is not a valid recording.json; the error names the file, the line
 * and the reason. Cost: O(size); memory as for session_read(). */
bool recording_read(const char *folder, view *v, uint64_t *every, octreel_error *error);

/* Parses recording.json from memory. Errors use `name` as its file name. */
bool recording_parse(const char *name, const char *text, size_t size, view *v, uint64_t *every, octreel_error *error);

/* Reads session.json in a folder and computes the digest of its bytes. The caller releases *file. */
bool read_session_file(const char *folder, session_file *file, uint64_t *digest, octreel_error *error);

/* Reads session.json.live in a folder: the session of a program that ended before its recording was complete. A last
 * line without a newline is ignored. */
bool read_live_session(const char *folder, session_file *file, octreel_error *error);

#endif
