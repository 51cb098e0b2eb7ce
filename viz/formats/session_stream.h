/* SPDX-License-Identifier: MIT */
/* session_stream.h - reads a session while another program writes it: first the header, then tick by tick.
 *
 *     session_stream *s = session_stream_open(file, "standard input", keep_going, context);
 *     if (session_stream_read_start(s, NULL, &error) == SESSION_STREAM_TICK)
 *         while (session_stream_read_tick(s, &tick, &error) == SESSION_STREAM_TICK)
 *             ...
 *     session_stream_close(s);
 *
 * The text has the format of a session file. The number of ticks is known only at the end of the text.
 */
#ifndef FORMATS_SESSION_STREAM_H
#define FORMATS_SESSION_STREAM_H

#include "json_stream.h"
#include "session_file.h"

typedef struct session_stream session_stream;

typedef enum session_stream_state {
    SESSION_STREAM_TICK = JSON_STREAM_OBJECT,     /* an object or a tick was read */
    SESSION_STREAM_END = JSON_STREAM_END,         /* the end of the text was reached between two objects */
    SESSION_STREAM_STOPPED = JSON_STREAM_STOPPED, /* keep_going() returned false */
    /* the text is invalid; the error names file, line and place; earlier ticks stay valid */
    SESSION_STREAM_BROKEN = JSON_STREAM_BROKEN,
} session_stream_state;

/* Opens a stream that reads from a file descriptor, starting at its current position. The stream does not close the
 * descriptor. Errors use `name` as the name of the file. keep_going() is called while the stream waits for data. If
 * keep_going() returns false, the wait ends. keep_going may be null. Relative paths of point files start at the
 * current folder. Returns null if memory runs out. */
session_stream *session_stream_open(int file, const char *name, bool (*keep_going)(void *context), void *context);
void session_stream_close(session_stream *s); /* `s` may be null */

/* Waits for the header and the object of tick 0. Tick 0 may have no object; this is known only when the next object
 * or the end of the text arrives. Returns SESSION_STREAM_TICK if the header is valid. An error in the object after
 * the header is returned later, by session_stream_read_tick(). If `keys` is not null, it replaces the keys of the
 * header. */
session_stream_state session_stream_read_start(session_stream *s, const char *keys, octreel_error *error);

/* Returns the session of tick 0 with all keys, for octree_game_create(). The member `ticks` of the session is
 * SESSION_ENDLESS if the header has no "ticks". After session_stream_read_tick(), only the session's bodies and keys
 * are valid. */
const octree_session *session_stream_first_session(const session_stream *s);

/* Returns the values of the points (colours, intensities, classes). The pointer is valid until the stream is closed.
 * Each tick adds the values of the points that the tick inserts. */
const point_values *session_stream_point_values(const session_stream *s);

/* Returns a sentence about how the header's point file was read, or "" if there is nothing to report. */
const char *session_stream_note(const session_stream *s);

/* A tick of the stream. The numbers of successive ticks ascend. A tick without an object has no input except its
 * key. The memory of the tick is valid until the next call of session_stream_read_tick(). */
typedef struct session_stream_tick {
    uint64_t number;
    octree_input input; /* the input without the key */
} session_stream_tick;

/* Waits for the next object of the stream and returns the tick of this object. */
session_stream_state session_stream_read_tick(session_stream *s, session_stream_tick *tick, octreel_error *error);

/* Returns the number of ticks of the session. The number is final only after the end of the stream. */
uint64_t session_stream_tick_count(const session_stream *s);

#endif
