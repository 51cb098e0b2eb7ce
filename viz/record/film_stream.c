/* SPDX-License-Identifier: MIT */
/* film_stream.c - records a session from a stream to which another process may still write. */
#include "film.h"
#include "live.h"

typedef struct streaming {
    session_stream *from;
    live_recording *live;
    const film_options *options;
    octreel_error *error;
    uint64_t end;  /* the last tick of the session, according to the part of the stream that has been read */
    uint64_t last; /* last recorded tick */
} streaming;

/* Record the next tick. If `input` is null, the tick has no input other than the player's key press, which is in the
 * session. */
static film_stream_end film_next_tick(streaming *s, const octree_input *input)
{
    static const octree_input nothing = {0};
    if (!watcher_continues(&s->options->watch))
        return FILM_STREAM_STOPPED;
    if (!live_film_tick(s->live, input ? input : &nothing, s->error))
        return FILM_STREAM_BROKEN;
    s->last++;
    return FILM_STREAM_WHOLE;
}

/* Record the ticks after s->last, up to and including `tick`. The stream has no JSON object for any of these ticks. */
static film_stream_end film_ticks_up_to(streaming *s, uint64_t tick)
{
    film_stream_end how = FILM_STREAM_WHOLE;
    while (how == FILM_STREAM_WHOLE && s->last < tick && s->last < s->end)
        how = film_next_tick(s, NULL);
    return how;
}

static bool check_length(const streaming *s, uint64_t ticks)
{
    return session_check_length(&(octree_session){.ticks = ticks}, s->options->max_ticks, s->error);
}

static film_stream_end film_tick_and_ticks_before(streaming *s, const session_stream_tick *tick)
{
    if (tick->number <= s->end && !check_length(s, tick->number))
        return FILM_STREAM_BROKEN;
    const film_stream_end how = film_ticks_up_to(s, tick->number - 1);
    if (how != FILM_STREAM_WHOLE)
        return how;
    if (tick->number <= s->end)
        return film_next_tick(s, &tick->input);
    return live_add_unplayed(s->live, tick->number, &tick->input, s->error) ? how : FILM_STREAM_BROKEN;
}

/* Record the ticks after the last JSON object of the stream. Such a tick exists if the player has a key press for it,
 * or if the number of ticks in the header includes it. The number of these ticks is known only at the end of the
 * stream. */
static film_stream_end film_remaining_ticks(streaming *s)
{
    octree_session session = *session_stream_first_session(s->from);
    session.ticks = session_stream_tick_count(s->from);
    s->end = octree_session_length(&session);
    if (!check_length(s, s->end))
        return FILM_STREAM_BROKEN;
    return film_ticks_up_to(s, s->end);
}

static film_stream_end film_all_ticks(streaming *s)
{
    for (session_stream_tick tick;;) {
        film_stream_end how = FILM_STREAM_WHOLE;
        switch (session_stream_read_tick(s->from, &tick, s->error)) {
        case SESSION_STREAM_TICK:
            how = film_tick_and_ticks_before(s, &tick);
            break;
        case SESSION_STREAM_END:
            return film_remaining_ticks(s);
        case SESSION_STREAM_STOPPED:
            return FILM_STREAM_STOPPED;
        case SESSION_STREAM_BROKEN:
            return FILM_STREAM_BROKEN;
        }
        if (how != FILM_STREAM_WHOLE)
            return how;
    }
}

film_stream_end film_stream(session_stream *from, const char *keys, const film_options *options, film_summary *summary,
                            octreel_error *error)
{
    octreel_error late;
    streaming s = {.from = from, .options = options, .error = error};
    *summary = (film_summary){0};
    const session_stream_state header = session_stream_read_start(from, keys, error);
    if (header != SESSION_STREAM_TICK)
        return header == SESSION_STREAM_STOPPED ? FILM_STREAM_STOPPED : FILM_STREAM_BROKEN;
    const octree_session *start = session_stream_first_session(from);
    s.end = octree_session_length(start);
    if (start->ticks != SESSION_ENDLESS && !check_length(&s, s.end))
        return FILM_STREAM_BROKEN;
    film_options with_values = *options;
    with_values.values = session_stream_point_values(from);
    s.live = live_open(start, &with_values, error);
    if (!s.live)
        return FILM_STREAM_BROKEN;
    const bool begun = live_begin(s.live, error) && live_film_first_tick(s.live, error);
    film_stream_end how = begun ? film_all_ticks(&s) : FILM_STREAM_BROKEN;
    if (!live_close(s.live, session_stream_tick_count(from), summary, how == FILM_STREAM_BROKEN ? &late : error))
        how = FILM_STREAM_BROKEN;
    return how;
}
