/* SPDX-License-Identifier: MIT */
/* session_stream.h - reading a session while it is still being written: first its header, then one tick after another.
 *
 *   session_stream *s = session_stream_open(file, "standard input", keep_going, context);
 *   if (session_stream_read_start(s, NULL, &error) == SESSION_STREAM_TICK)
 *       while (session_stream_read_tick(s, &tick, &error) == SESSION_STREAM_TICK)
 *           ...
 *   session_stream_close(s);
 *
 * The text has the format of a session file. The number of ticks is known only at its end. */
#ifndef FORMATS_SESSION_STREAM_H
#define FORMATS_SESSION_STREAM_H

#include "json_stream.h"
#include "session_file.h"

typedef struct session_stream session_stream;

typedef enum session_stream_state {
    SESSION_STREAM_TICK = JSON_STREAM_OBJECT,     /* the object was read */
    SESSION_STREAM_END = JSON_STREAM_END,         /* the text ended between two objects */
    SESSION_STREAM_STOPPED = JSON_STREAM_STOPPED, /* keep_going() returned false */
    SESSION_STREAM_BROKEN = JSON_STREAM_BROKEN,   /* an error with file, line and place; earlier ticks remain valid */
} session_stream_state;

/* Read from a file descriptor at its current position. The stream does not close it. Errors call it `name`.
 * keep_going(), which may be null, is called while no data arrives; false stops the wait. Files of points are opened
 * relative to the current folder. Null if there is no memory. */
session_stream *session_stream_open(int file, const char *name, bool (*keep_going)(void *context), void *context);
void session_stream_close(session_stream *s); /* null is allowed */

/* Wait for the header and the object of tick 0. That object may be missing, which is known only when the next object or
 * the end arrives. Returns SESSION_STREAM_TICK if the header is valid. If the object after the header is broken,
 * session_stream_read_tick() returns that error. If `keys` is not null, it replaces the header's keys. */
session_stream_state session_stream_read_start(session_stream *s, const char *keys, octreel_error *error);

/* Returns the session of tick 0 with all keys, for octree_game_create(). `ticks` is SESSION_ENDLESS if the header has
 * none. session_stream_read_tick() invalidates all of it except the bodies and keys. */
const octree_session *session_stream_first_session(const session_stream *s);

/* Returns the values of the points. Each tick adds the values of the points that it inserts. Valid until the stream is
 * closed. */
const point_values *session_stream_point_values(const session_stream *s);

/* Returns a sentence about how the header's file of points was read; "" if there is nothing to report. */
const char *session_stream_note(const session_stream *s);

/* The object of a tick. Numbers ascend; a tick without an object has only its key. Valid until the next call. */
typedef struct session_stream_tick {
    uint64_t number;
    octree_input input; /* without a key */
} session_stream_tick;

/* Wait for the next object. */
session_stream_state session_stream_read_tick(session_stream *s, session_stream_tick *tick, octreel_error *error);

/* The number of ticks of the session. Call it after the end. */
uint64_t session_stream_tick_count(const session_stream *s);

#endif
