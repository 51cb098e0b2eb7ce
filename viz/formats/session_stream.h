/* SPDX-License-Identifier: MIT */
/* session_stream.h - a session that is still being written: its header, and then tick after tick, as they come.
 *
 *   session_stream *s = session_stream_open(file, "standard input", keep_going, context);
 *   if (session_stream_begin(s, &error) == SESSION_STREAM_TICK)
 *       while (session_stream_next(s, &tick, &error) == SESSION_STREAM_TICK)
 *           ...
 *   session_stream_close(s);
 *
 * The text is that of a session file, and what is read is the same; only what comes at last is known at last. */
#ifndef FORMATS_SESSION_STREAM_H
#define FORMATS_SESSION_STREAM_H

#include "session_file.h"

typedef struct session_stream session_stream;

typedef enum session_stream_state {
    SESSION_STREAM_TICK,    /* what was asked for has come */
    SESSION_STREAM_END,     /* the text ended before, where it may */
    SESSION_STREAM_STOPPED, /* keep_going() said so */
    SESSION_STREAM_BROKEN,  /* an error, with file, line and place: what came before stays */
} session_stream_state;

/* A descriptor that is read from where it stands, and not closed. `name` is for errors. keep_going() is asked
 * while nothing comes; it may be null. Files of points are looked for in the current folder. Null when there is no
 * memory. */
session_stream *session_stream_open(int file, const char *name, bool (*keep_going)(void *context), void *context);
void session_stream_close(session_stream *s); /* null is allowed */

/* Wait for all that belongs to tick 0: the header, and the object of tick 0 where the text has one, of which it is only
 * sure that it has not when the next comes, or its end. SESSION_STREAM_TICK where the header has come, even if what
 * follows it is broken, which session_stream_next() tells. `keys` are played in place of the header's; null: they are
 * not. */
session_stream_state session_stream_begin(session_stream *s, const char *keys, octreel_error *error);

/* Tick 0, as octree_game_create() takes it, and with all keys: `ticks` is the header's, or SESSION_ENDLESS where it has
 * none. Valid until session_stream_next(), but for the bodies and keys. */
const octree_session *session_stream_start(const session_stream *s);

/* The values of its points, to which each tick adds those of points that it inserts. Valid until the stream is closed.
 */
const point_values *session_stream_values(const session_stream *s);

/* The sentence about the file of points that the header names; "" where there is nothing to say. */
const char *session_stream_note(const session_stream *s);

/* An object: its tick, above those before it; ticks without one have nothing but their keys. Valid until the next. */
typedef struct session_stream_tick {
    uint64_t number;
    octree_input input; /* without a key */
} session_stream_tick;

/* Wait for the next object. */
session_stream_state session_stream_next(session_stream *s, session_stream_tick *tick, octreel_error *error);

/* At the end: the ticks of the session, as its file has them. */
uint64_t session_stream_ticks(const session_stream *s);

#endif
