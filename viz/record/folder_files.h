/* SPDX-License-Identifier: MIT */
/* folder_files.h - the files of a recording that are written once: the session, the view and the renderer; and
 * whether a folder that is not empty may be filmed into. */
#ifndef RECORD_FOLDER_FILES_H
#define RECORD_FOLDER_FILES_H

#include "renderer.h"
#include "folder.h"
#include "octree/game.h"
#include "session_file.h"
#include "view.h"

/* ---- Written ------------------------------------------------------------------------------------------------ */

/* Where they go. */
typedef struct folder_place {
    const char *folder;
    /* Where several processes may be writing them, all with the same bytes: a word that no other of them has. What is
     * there stays, and must have these bytes. Null: this process alone writes, and into a new folder. */
    const char *writer;
    bool dry_run; /* nothing is written: what is there must have these bytes */
} folder_place;

/* The bytes of session.json, and their digest. The caller frees the bytes. */
typedef struct session_bytes {
    char *bytes;
    size_t size;
    uint64_t digest;
} session_bytes;

/* Nearly all of the work of writing session.json; the values of its points may be null. */
bool make_session_bytes(const octree_session *session, const point_values *values, session_bytes *made,
                        octreel_error *error);
bool write_session_file(const folder_place *place, const session_bytes *session, octreel_error *error);

/* recording.json: format version and view. */
bool write_recording_file(const folder_place *place, const view *v, uint64_t every, octreel_error *error);

/* renderer.json: the one file that may differ between machines. Of several processes the first one's is kept. */
bool write_renderer_file(const folder_place *place, const renderer_info *info, octreel_error *error);

/* ---- Read --------------------------------------------------------------------------------------------------- */

/* A renderer in one phrase: context, renderer and version. Returns `text`. */
char *who_draws(const renderer_info *info, char *text, size_t size);

/* The same of the one that renderer.json names; "an unknown renderer" where it names none. */
char *who_drew(const char *folder, char *text, size_t size);

/* Whether the recording of a session, of so many ticks, each every-th filmed, may go on in a folder, whose
 * recording.json and session.json, if any, are known to be its own. A folder without recordings is fine. One that has
 * frames, lines or a page but not both of these files is refused, since nothing says whose they are, and so are frames
 * of other ticks, or of another session as the first one says; for session.json stands session.json.live of a program
 * that died. */
bool check_resumable(const char *folder, uint64_t session_digest, uint64_t ticks, uint64_t every, octreel_error *error);

#endif
