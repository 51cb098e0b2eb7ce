/* live_session.h - session.json of a session that is being made: its ticks are kept in session.json.live, and become
 * the file when their number is known. Private to this folder. */
#ifndef RECORD_LIVE_SESSION_H
#define RECORD_LIVE_SESSION_H

#include "folder.h"
#include "session_file.h"

#include <sys/types.h>

typedef struct live_session {
    session_file start;
    uint64_t ticks; /* behind tick 0 */
    FILE *stream;   /* session.json.live */
    char *path;
    off_t head, whole; /* where its ticks begin, and where its last whole one ends */
} live_session;

/* Copy the start of a session. False when there is no memory. */
bool live_session_init(live_session *s, const octree_session *start);
void live_session_release(live_session *s);

const octree_session *live_session_start(const live_session *s);

/* Begin session.json.live with the header and tick 0. */
bool live_session_begin(live_session *s, const char *folder, octreel_error *error);

/* Add the next tick. */
bool live_session_add(live_session *s, const octree_input *input, octreel_error *error);

/* Remove session.json.live where it was begun. */
void live_session_abandon(live_session *s);

/* Write session.json, and remove session.json.live; *digest is that of its bytes. */
bool live_session_end(live_session *s, const char *folder, uint64_t *digest, octreel_error *error);

#endif
