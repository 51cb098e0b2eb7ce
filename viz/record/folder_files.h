/* SPDX-License-Identifier: MIT */
/* folder_files.h - writes session.json, recording.json and renderer.json, and checks whether a partial recording in a
 * folder may be resumed. */
#ifndef RECORD_FOLDER_FILES_H
#define RECORD_FOLDER_FILES_H

#include "renderer.h"
#include "folder.h"
#include "octree/game.h"
#include "session_file.h"
#include "view.h"

/* ---- Writing ------------------------------------------------------------------------------------------------ */

/* The folder into which files are written, and the way in which they are written. */
typedef struct folder_place {
    const char *folder;
    /* A name that is unique to this process, used in the names of its temporary files. Several processes may then write
     * the same file with the same bytes at the same time. A file that already exists is kept and must have these bytes.
     * Null: only this process writes, and the folder is new. */
    const char *writer;
    bool dry_run; /* write nothing; only check that existing files have the expected bytes */
} folder_place;

/* The bytes of session.json, and their digest. The caller frees the bytes. */
typedef struct session_bytes {
    char *bytes;
    size_t size;
    uint64_t digest;
} session_bytes;

/* Make the bytes of session.json. `values` are the values of the session's points; may be null. */
bool make_session_bytes(const octree_session *session, const point_values *values, session_bytes *made,
                        octreel_error *error);
bool write_session_file(const folder_place *place, const session_bytes *session, octreel_error *error);

/* Write recording.json, which contains the format version, the view and `every`. */
bool write_recording_file(const folder_place *place, const view *v, uint64_t every, octreel_error *error);

/* Write renderer.json, the only file that may differ between machines. If several processes write the file, the first
 * version stays. */
bool write_renderer_file(const folder_place *place, const renderer_info *info, octreel_error *error);

/* ---- Reading ------------------------------------------------------------------------------------------------ */

/* Describe a renderer: its context, name and version, or "the integer rasterizer". Returns `text`. */
char *describe_renderer(const renderer_info *info, char *text, size_t size);

/* Describe the renderer in a folder's renderer.json. The text is "an unknown renderer" if the file is missing or
 * invalid. Returns `text`. */
char *describe_recorded_renderer(const char *folder, char *text, size_t size);

/* Check whether a recording of this session may be resumed in a folder. The caller has already compared recording.json
 * and session.json, if these files exist. A folder without a recording is accepted.
 *
 * Three kinds of folders are refused with an error. (1) The folder has frames, a ticks.jsonl with lines, or a page, but
 * lacks recording.json or session.json: nothing then shows to which recording the files belong. (2) The folder has a
 * frame that this recording does not have. (3) The folder's first frame contains another session digest.
 *
 * If a program was killed while it recorded itself, session.json.live is used in place of session.json.
 */
bool check_resumable(const char *folder, uint64_t session_digest, uint64_t ticks, uint64_t every, octreel_error *error);

#endif
