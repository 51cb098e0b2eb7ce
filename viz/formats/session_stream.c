/* SPDX-License-Identifier: MIT */
/* session_stream.c - reads a session from a file descriptor, one object at a time. */
#include "session_stream.h"
#include "json_stream.h"
#include "octree/octree.h"
#include "session_members.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

struct session_stream {
    json_stream objects;
    json_reader reader;
    session_loader loader;
    octree_session start;
    session_stream_state first; /* the state after reading the object that follows the header */
    /* true: session_stream_read_tick() has still to return `first` and the object that follows the header */
    bool has_pending;
    octreel_error pending_error; /* the error, if `first` is SESSION_STREAM_BROKEN */
};

session_stream *session_stream_open(int file, const char *name, bool (*keep_going)(void *context), void *context)
{
    session_stream *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->objects = (json_stream){.file = file, .keep_going = keep_going, .context = context};
    s->loader = (session_loader){.folder = "", .tick = OCTREE_EVERY_TICK};
    s->loader.header.session = session_make_default_header();
    s->reader = (json_reader){.name = name, .line = 1, .context = &s->loader};
    return s;
}

void session_stream_close(session_stream *s)
{
    if (!s)
        return;
    json_stream_release(&s->objects);
    session_release_lists(s->loader.lists);
    session_release_lists(s->loader.header_lists);
    cloud_release(&s->loader.points);
    point_values_release(&s->loader.values.made);
    session_release_values(&s->loader.values);
    free(s->loader.bodies);
    free((char *)s->loader.header.session.keys);
    free(s);
}

/* ---- Objects ------------------------------------------------------------------------------------------------ */

static session_stream_state read_object(session_stream *s, json_object_reader *read, octreel_error *error)
{
    s->reader.error = error;
    const session_stream_state state = (session_stream_state)json_stream_read_object(&s->objects, &s->reader);
    const bool done = state != SESSION_STREAM_TICK ||
                      (session_check_is_text(&s->reader) && json_read_object(&s->reader, false, read) &&
                       session_merge_listed_values(&s->reader));
    return done ? state : SESSION_STREAM_BROKEN;
}

static octree_input make_tick_input(const session_loader *s)
{
    const octree_session all = session_assemble(s, s->lists);
    return session_collect_input(&all);
}

/* The game also checks the object of a tick. The object is checked here, too, because only here the line of an error
 * is known. */
static session_stream_state read_tick(session_stream *s, octreel_error *error)
{
    const size_t line = s->reader.line;
    session_clear_lists(s->loader.lists);
    const session_stream_state state = read_object(s, session_read_tick, error);
    if (state != SESSION_STREAM_TICK)
        return state;
    const octree_input input = make_tick_input(&s->loader);
    const octree_status status = octree_input_check(&input);
    if (status == OCTREE_OK)
        return state;
    json_fail_line(&s->reader, line, NULL, "tick %" PRIu64 " cannot be played: %s", s->loader.tick,
                   octree_status_text(status));
    return SESSION_STREAM_BROKEN;
}

/* ---- Tick 0 ------------------------------------------------------------------------------------------------- */

static bool replace_keys(session_stream *s, const char *keys, octreel_error *error)
{
    session_file file = {.session = {.keys = s->loader.header.session.keys}};
    const bool done = !keys || session_set_keys(&file, keys, error);
    s->loader.header.session.keys = file.session.keys;
    return done;
}

static bool assemble_first_session(session_stream *s)
{
    session_loader *l = &s->loader;
    const bool has_tick_0 = s->first == SESSION_STREAM_TICK && l->tick == 0;
    if (has_tick_0 && !session_move_header_lists(&s->reader))
        return false;
    s->start = session_assemble(l, has_tick_0 ? l->lists : l->header_lists);
    s->has_pending = !has_tick_0;
    if (!l->ends)
        s->start.ticks = SESSION_ENDLESS;
    return true;
}

session_stream_state session_stream_read_start(session_stream *s, const char *keys, octreel_error *error)
{
    const session_stream_state state = read_object(s, session_read_header, error);
    if (state == SESSION_STREAM_END)
        json_fail_line(&s->reader, s->reader.line, NULL, "holds no session");
    if (state != SESSION_STREAM_TICK)
        return state == SESSION_STREAM_STOPPED ? state : SESSION_STREAM_BROKEN;
    if (!replace_keys(s, keys, error))
        return SESSION_STREAM_BROKEN;
    s->first = read_tick(s, &s->pending_error);
    s->reader.error = error;
    return assemble_first_session(s) ? SESSION_STREAM_TICK : SESSION_STREAM_BROKEN;
}

const octree_session *session_stream_first_session(const session_stream *s)
{
    return &s->start;
}

const point_values *session_stream_point_values(const session_stream *s)
{
    return &s->loader.values.made;
}

const char *session_stream_note(const session_stream *s)
{
    return s->loader.note;
}

/* ---- Further ticks ------------------------------------------------------------------------------------------ */

session_stream_state session_stream_read_tick(session_stream *s, session_stream_tick *tick, octreel_error *error)
{
    session_stream_state state = s->first;
    if (!s->has_pending)
        state = read_tick(s, error);
    else if (state == SESSION_STREAM_BROKEN)
        *error = s->pending_error;
    s->has_pending = false;
    if (state == SESSION_STREAM_TICK)
        *tick = (session_stream_tick){s->loader.tick, make_tick_input(&s->loader)};
    return state;
}

uint64_t session_stream_tick_count(const session_stream *s)
{
    return s->loader.header.session.ticks;
}
