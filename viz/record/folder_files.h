/* folder_files.h - the files of a recording that are written once: what is played, how it is seen, who draws it. */
#ifndef RECORD_FOLDER_FILES_H
#define RECORD_FOLDER_FILES_H

#include "draw.h"
#include "folder.h"
#include "octree/game.h"

/* session.json; *digest is that of its bytes. */
bool write_session_file(const char *folder, const octree_session *session, uint64_t *digest, record_error *error);

/* recording.json: format version and view. */
bool write_recording_file(const char *folder, const view *v, uint64_t every, record_error *error);

/* renderer.json: the one file that may differ between machines. */
bool write_renderer_file(const char *folder, const renderer_info *info, record_error *error);

#endif
