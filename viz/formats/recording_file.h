/* SPDX-License-Identifier: MIT */
/* recording_file.h - recording.json: the format version of a recording, every view option, and the values derived from
 * them; and the session.json beside it. `octreel help recording` (recording.txt) lists the members. The rows of
 * view_options.c read and write the options.
 */
#ifndef FORMATS_RECORDING_FILE_H
#define FORMATS_RECORDING_FILE_H

#include "error.h"
#include "session_file.h"
#include "view.h"

#include <stdio.h>

/* The only version that is written and read. Scene digests change with the version, so recordings of other versions
 * cannot be verified or continued. 2: scene digests hash names. 3: frames name the kind of their pixel digest. 4: every
 * option is written, "size" replaces "width" and "height", and derived values are in "derived". */
#define RECORDING_VERSION 4

/* Returns the view with the default of every option, from the rows of view_options.c. */
view view_make_default(void);

/* Write recording.json. The caller checks the stream for errors. */
void recording_write(FILE *out, const view *v, uint64_t every);

/* Read recording.json in a folder: its view, and its frame interval (--every). An option that is missing has its
 * default. False, with file, line and reason, if it is not a valid recording.json. Cost: O(size); memory as for
 * session_read().
 */
bool recording_read(const char *folder, view *v, uint64_t *every, octreel_error *error);

/* Read recording.json from memory; errors name it `name`. */
bool recording_parse(const char *name, const char *text, size_t size, view *v, uint64_t *every, octreel_error *error);

/* Read session.json in a folder, and compute the digest of its bytes. The caller releases *file. */
bool read_session_file(const char *folder, session_file *file, uint64_t *digest, octreel_error *error);

/* Read session.json.live, the session of a program that ended before it completed its recording. A last line without a
 * newline is ignored. */
bool read_live_session(const char *folder, session_file *file, octreel_error *error);

#endif
