/* SPDX-License-Identifier: MIT */
/* folder_files.h - writes session.json, recording.json and renderer.json, and decides whether a recording may be
 * resumed in a folder. */
#ifndef RECORD_FOLDER_FILES_H
#define RECORD_FOLDER_FILES_H

#include "renderer.h"
#include "folder.h"
#include "octree/game.h"
#include "session_file.h"
#include "view.h"

/* ---- Written ------------------------------------------------------------------------------------------------ */

/* How a file is written into a folder. */
typedef struct folder_place {
    const char *folder;
    /* A name that is unique among processes that may write the same file with the same bytes at the same time. A file
     * that exists stays and must have these bytes. Null: only this process writes, into a new folder. */
    const char *writer;
    bool dry_run; /* write nothing; a file that exists must have these bytes */
} folder_place;

/* The bytes of session.json, and their digest. The caller frees the bytes. */
typedef struct session_bytes {
    char *bytes;
    size_t size;
    uint64_t digest;
} session_bytes;

/* Make the bytes of session.json; `values`, the values of its points, may be null. */
bool make_session_bytes(const octree_session *session, const point_values *values, session_bytes *made,
                        octreel_error *error);
bool write_session_file(const folder_place *place, const session_bytes *session, octreel_error *error);

/* Write recording.json: the format version and the view. */
bool write_recording_file(const folder_place *place, const view *v, uint64_t every, octreel_error *error);

/* Write renderer.json, the only file that may differ between machines. The file of the first process stays. */
bool write_renderer_file(const folder_place *place, const renderer_info *info, octreel_error *error);

/* ---- Read --------------------------------------------------------------------------------------------------- */

/* Describe a renderer: context, renderer and version, or "the integer rasterizer". Returns `text`. */
char *describe_renderer(const renderer_info *info, char *text, size_t size);

/* Describe the renderer in a folder's renderer.json; "an unknown renderer" where it names none. Returns `text`. */
char *describe_recorded_renderer(const char *folder, char *text, size_t size);

/* Whether a recording with this session, number of ticks and `every` may be resumed in a folder. The caller has
 * compared recording.json and session.json, if they exist. A folder without a recording is accepted. Refused are:
 * frames, lines or a page without both of these files, since nothing shows to which recording they belong; frames of
 * other ticks; and a first frame of another session. session.json.live, which a program that died leaves, stands for
 * session.json. */
bool check_resumable(const char *folder, uint64_t session_digest, uint64_t ticks, uint64_t every, octreel_error *error);

#endif
