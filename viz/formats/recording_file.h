/* SPDX-License-Identifier: MIT */
/* recording_file.h - recording.json: the version of a recording, and its view; and reading the session beside it.
 *
 *   {"octreel": "recording", "version": 3, the view, "theme": "night", "every": 1}
 * "every" is 0 where no tick has a frame.
 * The members of the view are those of view_options.c:
 *   "width": 1280, "height": 720, "camera": "iso", "layers": ["world", "nodes", ...], "color_by": "depth",
 *   "lod": 2, "budget": 250000, "aa": 1, and, where they are not off,
 *   "fit": {"min": [x, y, z], "max": [x, y, z]}, "look": [30, 22], "center": [x, y, z], "zoom": 2, "diagram": "beside",
 *   "color_points": "height", "shade": "edl", "point_scale": [lowest place, highest place, ids, intensities, spacing],
 *   "labels": true, "slice": {"z": 100}, "depths": [2, 5], "leaves": true, "region": {"min": [x, y, z], "max": [x, y,
 * z]}
 */
#ifndef FORMATS_RECORDING_FILE_H
#define FORMATS_RECORDING_FILE_H

#include "error.h"
#include "session_file.h"
#include "view.h"

#include <stdio.h>

/* The version that is written, and the oldest that is read, since digests of scenes are those of a version. 2: scene
 * digests hash names. 3: frames tell of which kind the digest of their pixels is, which may be that of rows. */
#define RECORDING_VERSION 3
#define RECORDING_OLDEST 2

/* Write the file. Errors stay with the stream. */
void recording_write(FILE *out, const view *v, uint64_t every);

/* Read that of a folder: its view and its frame interval (--every). Options that are missing are off. False,
 * with file, line and reason, when it is not a recording. Cost: O(size); memory as session_read() takes. */
bool recording_read(const char *folder, view *v, uint64_t *every, octreel_error *error);

/* The same of a text in memory; `name` is for errors. */
bool recording_parse(const char *name, const char *text, size_t size, view *v, uint64_t *every, octreel_error *error);

/* session.json and the digest of its bytes; the caller releases *file. */
bool read_session_file(const char *folder, session_file *file, uint64_t *digest, octreel_error *error);

/* The session that a program was making when it died: session.json.live, without a last line that is torn. */
bool read_live_session(const char *folder, session_file *file, octreel_error *error);

#endif
