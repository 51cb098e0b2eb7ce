/* SPDX-License-Identifier: MIT */
#include "json_stream.h"
#include "array.h"

#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Where an object ends ----------------------------------------------------------------------------------- */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* A bracket is a value, which has its place: so a line that lacks its end does not swallow those after it. */
static bool may_open(const json_scan *s)
{
    return s->depth == 0 || s->before == ':' || s->before == '[' || (s->before == ',' && s->open[s->depth - 1] == '[');
}

/* Whether the text cannot go on after a character of a string. */
static bool scan_string(json_scan *s, char c)
{
    if (s->escaped)
        s->escaped = false;
    else if (c == '\\')
        s->escaped = true;
    else
        s->quoted = c != '"';
    return (unsigned char)c < ' ';
}

/* Take the next character. True where the object ends with it, or is found to be none. */
static bool scan(json_scan *s, char c)
{
    if (s->quoted)
        return scan_string(s, c);
    if (s->bare)
        return c == '\n' || c == 0;
    if (is_blank(c))
        return false;
    if (c == '{' || c == '[') {
        if (!may_open(s) || s->depth == JSON_DEEPEST)
            return true;
        s->open[s->depth++] = c;
    } else if (c == '}' || c == ']') {
        if (s->depth == 0 || s->open[--s->depth] != (c == '}' ? '{' : '[') || s->depth == 0)
            return true;
    } else {
        s->bare = s->depth == 0;
        s->quoted = c == '"' && !s->bare;
    }
    s->before = c;
    return c == 0;
}

/* ---- What comes --------------------------------------------------------------------------------------------- */

#define BLOCK ((size_t)1 << 16)

static const char no_room[] = "out of memory for an object of the stream%s";

static json_stream_state fail(json_reader *r, const char *format, const char *reason)
{
    json_fail_line(r, r->line, NULL, format, reason);
    return JSON_STREAM_BROKEN;
}

/* Let the object at hand begin the bytes, with room for a block after them; what a large one took is given back. */
static bool make_room(json_stream *s)
{
    if (s->begin > 0)
        memmove(s->bytes, s->bytes + s->begin, s->size - s->begin);
    s->size -= s->begin;
    s->begin = 0;
    char *bytes = array_reserve(s->bytes, s->size + BLOCK, &s->room, 1);
    if (bytes)
        s->bytes = bytes;
    char *smaller = bytes && s->room > 64 * BLOCK && s->size < BLOCK ? realloc(bytes, 2 * BLOCK) : NULL;
    if (smaller) {
        s->bytes = smaller;
        s->room = 2 * BLOCK;
    }
    return bytes;
}

/* Wait until something comes. False where it is not to be waited for. */
static bool wait_for_more(const json_stream *s)
{
    enum { PATIENCE = 50 }; /* milliseconds */
    struct pollfd asked = {.fd = s->file, .events = POLLIN};
    do {
        if (s->keep_going && !s->keep_going(s->context))
            return false;
    } while (poll(&asked, 1, s->keep_going ? PATIENCE : -1) <= 0);
    return true;
}

/* Read what has come; JSON_STREAM_OBJECT where there is more to scan, be it that it is now known to be all. */
static json_stream_state read_more(json_stream *s, json_reader *r)
{
    ssize_t got;
    if (!make_room(s))
        return fail(r, no_room, "");
    do {
        if (!wait_for_more(s))
            return JSON_STREAM_STOPPED;
        got = read(s->file, s->bytes + s->size, BLOCK);
    } while (got < 0 && (errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK));
    if (got < 0)
        return fail(r, "cannot be read: %s", strerror(errno));
    s->size += (size_t)got;
    s->ended = got == 0;
    return JSON_STREAM_OBJECT;
}

/* ---- Objects ------------------------------------------------------------------------------------------------ */

/* With the byte order mark of a text that begins. */
static void skip_blanks(json_stream *s, json_reader *r)
{
    static const char mark[] = "\xef\xbb\xbf";
    for (; s->begin < s->size && s->mark < 3 && s->bytes[s->begin] == mark[s->mark]; s->mark++)
        s->begin++;
    for (; s->begin < s->size && is_blank(s->bytes[s->begin]); s->begin++)
        r->line += s->bytes[s->begin] == '\n';
    if (s->begin < s->size)
        s->mark = 3; /* the text has begun */
}

/* Scan on. True where the object's end is found, or it is too large for any. */
static bool find_end(json_stream *s)
{
    for (; s->begin + s->scanned < s->size; s->scanned++)
        if (scan(&s->scan, s->bytes[s->begin + s->scanned])) {
            s->scanned++;
            return true;
        }
    return s->scanned > INT_MAX;
}

json_stream_state json_stream_next(json_stream *s, json_reader *r)
{
    if (s->scanned > 0) /* the one before was read, and counted its lines */
        s->begin = (size_t)(r->at - s->bytes);
    s->scanned = 0;
    s->scan = (json_scan){0};
    if (!s->bytes && !make_room(s))
        return fail(r, no_room, "");
    for (;;) {
        if (s->scanned == 0)
            skip_blanks(s, r);
        const bool found = find_end(s);
        r->at = s->bytes + s->begin;
        r->limit = r->at + s->scanned;
        if (found || (s->ended && s->scan.bare))
            return JSON_STREAM_OBJECT;
        if (s->ended && s->scanned > 0)
            return fail(r, "the text stops in the middle of the object that begins here%s", "");
        if (s->ended)
            return JSON_STREAM_END;
        const json_stream_state state = read_more(s, r);
        if (state != JSON_STREAM_OBJECT)
            return state;
    }
}

void json_stream_release(json_stream *s)
{
    free(s->bytes);
    *s = (json_stream){0};
}
