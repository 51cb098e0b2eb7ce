/* folder_files.h - the files of a recording that are written once: what is played, how it is seen, who draws it. */
#ifndef RECORD_FOLDER_FILES_H
#define RECORD_FOLDER_FILES_H

#include "renderer.h"
#include "folder.h"
#include "octree/game.h"
#include "session_file.h"

/* Where they go. */
typedef struct folder_place {
    const char *folder;
    const char *writer; /* of folder_write_once(), where the folder may be that of a recording already; else null */
    bool look;          /* nothing is written: what is there must have these bytes */
} folder_place;

/* The bytes of session.json, and their digest. The caller frees the bytes. */
typedef struct session_bytes {
    char *bytes;
    size_t size;
    uint64_t digest;
} session_bytes;

/* Nearly all that is to be done for session.json. */
bool make_session_bytes(const octree_session *session, session_bytes *made, octreel_error *error);

/* And the rest. */
bool write_session_file(const folder_place *place, const session_bytes *session, octreel_error *error);

/* The same digest, of a file that is there. */
bool digest_session_file(const char *path, uint64_t *digest, octreel_error *error);

/* Read it back; the caller releases *file. */
bool read_session_file(const char *folder, session_file *file, uint64_t *digest, octreel_error *error);

/* The session that a program was making when it died: session.json.live, but for a line that it did not end. */
bool read_live_session(const char *folder, session_file *file, octreel_error *error);

/* recording.json: format version and view. */
bool write_recording_file(const folder_place *place, const view *v, uint64_t every, octreel_error *error);

/* renderer.json: the one file that may differ between machines. Of several who draw the first is named. */
bool write_renderer_file(const folder_place *place, const renderer_info *info, octreel_error *error);

#endif
