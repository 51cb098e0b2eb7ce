/* SPDX-License-Identifier: MIT */
/* json_stream.c - finds the ends of JSON objects in a stream, before parsing.
 *
 * A parser such as jansson wants a whole text, and a call for "more" would block inside it while a game is still
 * running. So this file only finds where an object ends, and the parser then gets a complete one. The end is the
 * bracket that closes the first one. Brackets inside strings do not count, so the scanner tracks quotes and
 * backslashes, and keeps a stack of open brackets. Each byte is scanned once, even if an object arrives in many pieces.
 *
 * A broken line must not swallow the objects after it: if a '}' is missing, the search would run on. Valid JSON has a
 * bracket only at the start or after ':', '[' or a comma in a list, and no control character in a string. At the first
 * byte that violates this the object counts as ended, and the parser reports the exact error. Cost: O(bytes). */
#include "json_stream.h"
#include "array.h"

#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Finding the end of an object --------------------------------------------------------------------------- */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* True if an opening bracket is allowed here: at the start, after a colon, or as an element of a list. */
static bool can_open_bracket(const json_scan *s)
{
    return s->depth == 0 || s->before == ':' || s->before == '[' || (s->before == ',' && s->open[s->depth - 1] == '[');
}

/* Scans a character inside a string. True: a control character, which JSON strings cannot contain. */
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

/* Scans the next character. True: the object ends here, or this cannot be an object. */
static bool scan_character(json_scan *s, char c)
{
    if (s->quoted)
        return scan_string(s, c);
    if (s->bare)
        return c == '\n' || c == 0;
    if (is_blank(c))
        return false;
    if (c == '{' || c == '[') {
        if (!can_open_bracket(s) || s->depth == JSON_DEEPEST)
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

/* ---- Reading ------------------------------------------------------------------------------------------------ */

#define BLOCK ((size_t)1 << 16)

static const char no_room[] = "out of memory for an object of the stream%s";

static json_stream_state report_broken(json_reader *r, const char *format, const char *reason)
{
    json_fail_line(r, r->line, NULL, format, reason);
    return JSON_STREAM_BROKEN;
}

/* Moves the current object to the start of the buffer and makes room for a block. Shrinks the buffer after a huge
 * object. */
static bool make_room_for_block(json_stream *s)
{
    if (s->begin > 0)
        memmove(s->bytes, s->bytes + s->begin, s->size - s->begin);
    s->size -= s->begin;
    s->begin = 0;
    const bool grown = array_grow(&s->bytes, s->size + BLOCK, &s->room, 1);
    char *smaller = grown && s->room > 64 * BLOCK && s->size < BLOCK ? realloc(s->bytes, 2 * BLOCK) : NULL;
    if (smaller) {
        s->bytes = smaller;
        s->room = 2 * BLOCK;
    }
    return grown;
}

/* Waits until there is something to read. False: keep_going() stops the wait. */
static bool wait_for_input(const json_stream *s)
{
    enum { POLL_MILLISECONDS = 50 };
    struct pollfd watched = {.fd = s->file, .events = POLLIN};
    do {
        if (s->keep_going && !s->keep_going(s->context))
            return false;
    } while (poll(&watched, 1, s->keep_going ? POLL_MILLISECONDS : -1) <= 0);
    return true;
}

/* Reads the available bytes, or sets s->ended at the end of the stream. Returns JSON_STREAM_OBJECT if scanning can
 * continue. */
static json_stream_state read_more(json_stream *s, json_reader *r)
{
    ssize_t got;
    if (!make_room_for_block(s))
        return report_broken(r, no_room, "");
    do {
        if (!wait_for_input(s))
            return JSON_STREAM_STOPPED;
        got = read(s->file, s->bytes + s->size, BLOCK);
    } while (got < 0 && (errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK));
    if (got < 0)
        return report_broken(r, "cannot be read: %s", strerror(errno));
    s->size += (size_t)got;
    s->ended = got == 0;
    return JSON_STREAM_OBJECT;
}

/* ---- Objects ------------------------------------------------------------------------------------------------ */

/* Skips whitespace and, at the start of the text, a byte order mark. */
static void skip_blanks(json_stream *s, json_reader *r)
{
    static const char mark[] = "\xef\xbb\xbf";
    for (; s->begin < s->size && s->mark < 3 && s->bytes[s->begin] == mark[s->mark]; s->mark++)
        s->begin++;
    for (; s->begin < s->size && is_blank(s->bytes[s->begin]); s->begin++)
        r->line += s->bytes[s->begin] == '\n';
    if (s->begin < s->size)
        s->mark = 3; /* a byte order mark can only stand at the start */
}

/* Continues the scan. True: the end of the object is found, or the object is too large for jansson. */
static bool find_object_end(json_stream *s)
{
    for (; s->begin + s->scanned < s->size; s->scanned++)
        if (scan_character(&s->scan, s->bytes[s->begin + s->scanned])) {
            s->scanned++;
            return true;
        }
    return s->scanned > INT_MAX;
}

json_stream_state json_stream_read_object(json_stream *s, json_reader *r)
{
    if (s->scanned > 0) /* the reader has moved past the previous object and counted its lines */
        s->begin = (size_t)(r->at - s->bytes);
    s->scanned = 0;
    s->scan = (json_scan){0};
    if (!s->bytes && !make_room_for_block(s))
        return report_broken(r, no_room, "");
    for (;;) {
        if (s->scanned == 0)
            skip_blanks(s, r);
        const bool found = find_object_end(s);
        r->at = s->bytes + s->begin;
        r->limit = r->at + s->scanned;
        if (found || (s->ended && s->scan.bare))
            return JSON_STREAM_OBJECT;
        if (s->ended && s->scanned > 0)
            return report_broken(r, "the text stops in the middle of the object that begins here%s", "");
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
