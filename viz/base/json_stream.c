/* SPDX-License-Identifier: MIT */
/* json_stream.c - finds the ends of JSON objects in a stream before they are parsed.
 *
 * A parser such as jansson needs a whole text. A parser that reads from the stream would block while a game is still
 * running and writing. Therefore this file only finds where an object ends; the parser then gets a complete object. The
 * end of an object is the bracket that closes its first bracket. Brackets inside strings do not count, so the scanner
 * tracks quotes and backslashes, and stores the open brackets on a stack. Each byte is scanned once, even if an object
 * arrives in many pieces.
 *
 * If a '}' is missing in an object, the scan must not run on through the objects after it. In valid JSON an opening
 * bracket stands only at the start, after ':', after '[', or after a comma in a list, and a string contains no control
 * character. At the first byte that violates these rules, the scan ends the object, and the parser then reports the
 * exact error. Cost: O(bytes).
 */
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

/* Returns whether an opening bracket is allowed here: at the start, after a colon, or as an element of a list. */
static bool can_open_bracket(const json_scan *s)
{
    return s->depth == 0 || s->before == ':' || s->before == '[' || (s->before == ',' && s->open[s->depth - 1] == '[');
}

/* Scans a character inside a string. Returns true if it is a control character, which JSON strings cannot contain. */
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

/* Scans the next character. Returns true if the object ends here or the text cannot be an object. */
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

static const char no_room[] = "out of memory while reading an object%s";

static json_stream_state report_broken_object(json_reader *r, const char *format, const char *reason)
{
    json_fail_line(r, r->line, NULL, format, reason);
    return JSON_STREAM_BROKEN;
}

/* Moves the current object to the start of the buffer, and makes room for a block after it. If the buffer is still
 * large from an earlier huge object, shrinks the buffer. Returns false if memory runs out. */
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

/* Waits until the stream has data or ends. Returns false if keep_going() stops the wait. */
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

/* Reads the bytes that are available. Sets s->ended at the end of the stream. JSON_STREAM_OBJECT means here that the
 * scan can continue. */
static json_stream_state read_available_bytes(json_stream *s, json_reader *r)
{
    ssize_t got;
    if (!make_room_for_block(s))
        return report_broken_object(r, no_room, "");
    do {
        if (!wait_for_input(s))
            return JSON_STREAM_STOPPED;
        got = read(s->file, s->bytes + s->size, BLOCK);
    } while (got < 0 && (errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK));
    if (got < 0)
        return report_broken_object(r, "cannot be read: %s", strerror(errno));
    s->size += (size_t)got;
    s->ended = got == 0;
    return JSON_STREAM_OBJECT;
}

/* ---- Objects ------------------------------------------------------------------------------------------------ */

/* Skips whitespace. At the start of the text, also skips a byte order mark. */
static void skip_blanks(json_stream *s, json_reader *r)
{
    static const char mark[] = "\xef\xbb\xbf";
    for (; s->begin < s->size && s->mark < 3 && s->bytes[s->begin] == mark[s->mark]; s->mark++)
        s->begin++;
    for (; s->begin < s->size && is_blank(s->bytes[s->begin]); s->begin++)
        r->line += s->bytes[s->begin] == '\n';
    if (s->begin < s->size)
        s->mark = 3; /* the text has begun, so no mark can follow: set the state after a whole mark */
}

/* Continues the scan with the bytes that were read. Returns true if the end of the object was found, or if the
 * object is too large for jansson. */
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
    if (s->scanned > 0) /* the reader has moved past the previous object */
        s->begin = (size_t)(r->at - s->bytes);
    s->scanned = 0;
    s->scan = (json_scan){0};
    if (!s->bytes && !make_room_for_block(s))
        return report_broken_object(r, no_room, "");
    for (;;) {
        if (s->scanned == 0)
            skip_blanks(s, r);
        const bool found = find_object_end(s);
        r->at = s->bytes + s->begin;
        r->limit = r->at + s->scanned;
        if (found || (s->ended && s->scan.bare))
            return JSON_STREAM_OBJECT;
        if (s->ended && s->scanned > 0)
            return report_broken_object(r, "the text ends inside the object that begins in this line%s", "");
        if (s->ended)
            return JSON_STREAM_END;
        const json_stream_state state = read_available_bytes(s, r);
        if (state != JSON_STREAM_OBJECT)
            return state;
    }
}

void json_stream_release(json_stream *s)
{
    free(s->bytes);
    *s = (json_stream){0};
}
