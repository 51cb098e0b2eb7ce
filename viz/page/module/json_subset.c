/* SPDX-License-Identifier: MIT */
/* json_subset.c - the part of jansson that reading sessions and views takes, for WebAssembly, for which Debian has no
 * jansson: its header is used as it is. test_json_subset.c holds this against the library.
 *
 * What is read by one call lies in one arena, whose first item is the value that is returned: deleting it frees all.
 * Other than with jansson, integers are always read as real numbers (JSON_DECODE_INT_AS_REAL), lists and objects nest
 * 200 deep at most, and UTF-8 is taken as it is: the page has none that is not valid. */
#include "json_values.h"
#include "number.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEEPEST 200
#define CHUNK ((size_t)1 << 16)

typedef struct parser {
    const char *begin, *at, *limit;
    chunk *first, *last;
    json_t **items; /* of the lists that are being read, those of inner lists last */
    size_t count, room;
    unsigned depth;
    size_t flags;
    json_error_t *error;
} parser;

/* ---- Memory ------------------------------------------------------------------------------------------------- */

static bool fail(parser *p, const char *at, const char *format, const char *what, int length)
{
    json_error_t *e = p->error;
    if (e->line >= 0)
        return false; /* the first is kept */
    e->line = 1;
    for (const char *c = p->begin; c < at; c++)
        e->line += *c == '\n';
    e->position = (int)(at - p->begin);
    snprintf(e->text, sizeof e->text - 1, format, length, what);
    return false;
}

/* jansson's sign that there is no memory: a line of -1 alone. */
static void *take(parser *p, size_t size)
{
    size = (size + 7) & ~(size_t)7;
    if (!p->last || p->last->room - p->last->used < size) {
        const size_t room = size > CHUNK ? size : CHUNK;
        chunk *c = malloc(sizeof *c + room);
        if (!c)
            return NULL;
        *c = (chunk){NULL, room, 0};
        *(p->last ? &p->last->next : &p->first) = c;
        p->last = c;
    }
    void *taken = (char *)p->last->aligned + p->last->used;
    p->last->used += size;
    return taken;
}

static bool push(parser *p, json_t *value)
{
    if (p->count == p->room) {
        const size_t room = p->room ? 2 * p->room : 64;
        json_t **grown = realloc(p->items, room * sizeof *grown);
        if (!grown)
            return false;
        p->items = grown;
        p->room = room;
    }
    p->items[p->count++] = value;
    return true;
}

/* ---- Texts -------------------------------------------------------------------------------------------------- */

static bool unexpected(parser *p, const char *wanted)
{
    char format[96];
    if (p->at >= p->limit)
        return fail(p, p->at, "%.*sunexpected end of input", "", 0);
    snprintf(format, sizeof format, "%s near '%%.*s'", wanted);
    int length = 1;
    while (length < 20 && p->at + length < p->limit && p->at[length] > ' ' && !strchr(",:[]{}\"", p->at[length]))
        length++;
    return fail(p, p->at, format, p->at, length);
}

/* The code of "uXXXX" at `at`; -1 where there is none. */
static long escaped_code(const char *at, const char *limit)
{
    char digits[5] = "";
    if (limit - at < 5 || *at != 'u')
        return -1;
    memcpy(digits, at + 1, 4);
    return strspn(digits, "0123456789abcdefABCDEF") == 4 ? strtol(digits, NULL, 16) : -1;
}

static char *put_utf8(char *to, long code)
{
    const int more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    static const unsigned char firsts[] = {0, 0xc0, 0xe0, 0xf0};
    *to++ = (char)(firsts[more] | code >> (6 * more));
    for (int i = more - 1; i >= 0; i--)
        *to++ = (char)(0x80 | (code >> (6 * i) & 0x3f));
    return to;
}

/* An escape beyond its backslash; p->at is moved past it. Null with the error written. */
static char *put_escape(parser *p, char *to)
{
    static const char letters[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
    const char *found = p->at < p->limit && *p->at ? strchr(letters, *p->at) : NULL;
    if (found) {
        p->at++;
        *to = meant[found - letters];
        return to + 1;
    }
    long code = escaped_code(p->at, p->limit);
    if (code < 0)
        return fail(p, p->at, "%.*sinvalid escape", "", 0), NULL;
    p->at += 5;
    const long low = p->at < p->limit && *p->at == '\\' ? escaped_code(p->at + 1, p->limit) : -1;
    if (code >= 0xd800 && code < 0xdc00 && low >= 0xdc00 && low < 0xe000) {
        code = 0x10000 + ((code & 0x3ff) << 10 | (low & 0x3ff));
        p->at += 6;
    }
    if (code >= 0xd800 && code < 0xe000)
        return fail(p, p->at, "%.*sinvalid Unicode", "", 0), NULL;
    if (code == 0)
        return fail(p, p->at, "%.*s\\u0000 is not allowed without JSON_ALLOW_NUL", "", 0), NULL;
    return put_utf8(to, code);
}

/* The end of a text that begins at p->at, past its quote: as long as it is at most. */
static const char *text_end(const parser *p)
{
    const char *at = p->at;
    while (at < p->limit && *at != '"')
        at += *at == '\\' && at + 1 < p->limit ? 2 : 1;
    return at;
}

/* Read the text whose quote is at p->at into `to`, which has room for as many bytes as there are between its quotes and
 * one. */
static bool read_text(parser *p, char *to)
{
    for (p->at++; p->at < p->limit && *p->at != '"';) {
        if ((unsigned char)*p->at < ' ')
            return fail(p, p->at, "%.*scontrol character in a text", "", 0);
        if (*p->at == '\\') {
            p->at++;
            to = put_escape(p, to);
            if (!to)
                return false;
            continue;
        }
        *to++ = *p->at++;
    }
    *to = 0;
    return p->at < p->limit ? p->at++, true : fail(p, p->at, "%.*spremature end of input", "", 0);
}

static size_t text_room(const parser *p)
{
    return (size_t)(text_end(&(parser){.at = p->at + 1, .limit = p->limit}) - p->at) + 1;
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

static json_t *read_value(parser *p);

static void skip_blanks(parser *p)
{
    while (p->at < p->limit && *p->at && strchr(" \t\n\r", *p->at))
        p->at++;
}

static bool take_char(parser *p, char c)
{
    skip_blanks(p);
    if (p->at >= p->limit || *p->at != c)
        return false;
    p->at++;
    return true;
}

static json_t *make(parser *p, size_t size, json_type type)
{
    json_t *json = take(p, size);
    if (json)
        *json = (json_t){type, 1};
    return json;
}

static json_t *read_string(parser *p)
{
    string *s = (string *)make(p, sizeof *s, JSON_STRING);
    char *text = s ? take(p, text_room(p)) : NULL;
    if (!text || !read_text(p, text))
        return NULL;
    s->text = text;
    return &s->json;
}

static const char *digits_end(const char *at, const char *limit)
{
    while (at < limit && *at >= '0' && *at <= '9')
        at++;
    return at;
}

/* The end of the number at p->at by JSON's grammar; p->at where there is none. */
static const char *number_end(const parser *p)
{
    const char *at = p->at + (*p->at == '-'), *limit = p->limit;
    const char *end = at < limit && *at == '0' ? at + 1 : digits_end(at, limit);
    if (end == at)
        return p->at;
    if (end < limit && *end == '.') {
        at = end + 1;
        end = digits_end(at, limit);
        if (end == at)
            return p->at;
    }
    if (end < limit && (*end == 'e' || *end == 'E')) {
        at = end + 1;
        at += at < limit && (*at == '+' || *at == '-');
        end = digits_end(at, limit);
        if (end == at)
            return p->at;
    }
    return end;
}

static json_t *read_number(parser *p)
{
    const char *end = number_end(p), *stop;
    if (end == p->at)
        return unexpected(p, "invalid token"), NULL;
    real *r = (real *)make(p, sizeof *r, JSON_REAL);
    if (!r)
        return NULL;
    if (!number_parse(p->at, end, &stop, &r->value))
        return (void)(errno == ENOMEM || fail(p, p->at, "%.*sreal number overflow", "", 0)), NULL;
    p->at = end;
    return &r->json;
}

static json_t *read_array(parser *p)
{
    const size_t first = p->count;
    array *a = (array *)make(p, sizeof *a, JSON_ARRAY);
    if (!a)
        return NULL;
    p->at++;
    for (bool more = !take_char(p, ']'); more;) {
        json_t *item = read_value(p);
        if (!item || !push(p, item))
            return NULL;
        more = take_char(p, ',');
        if (!more && !take_char(p, ']'))
            return unexpected(p, "']' expected"), NULL;
    }
    a->count = p->count - first;
    a->items = take(p, a->count * sizeof *a->items);
    if (!a->items)
        return NULL;
    if (a->count)
        memcpy(a->items, p->items + first, a->count * sizeof *a->items);
    p->count = first;
    return &a->json;
}

static bool is_duplicate(const parser *p, const object *o, const char *key)
{
    for (const entry *e = o->first; e && p->flags & JSON_REJECT_DUPLICATES; e = e->next)
        if (strcmp(e->key, key) == 0)
            return true;
    return false;
}

static entry *read_entry(parser *p, const object *o)
{
    skip_blanks(p);
    if (p->at >= p->limit || *p->at != '"')
        return unexpected(p, "string or '}' expected"), NULL;
    entry *e = take(p, offsetof(entry, key) + text_room(p));
    if (!e || !read_text(p, e->key))
        return NULL;
    e->next = NULL;
    if (is_duplicate(p, o, e->key))
        return fail(p, p->at, "duplicate object key near '\"%.*s\"'", e->key, 40), NULL;
    if (!take_char(p, ':'))
        return unexpected(p, "':' expected"), NULL;
    e->value = read_value(p);
    return e->value ? e : NULL;
}

static json_t *read_object(parser *p)
{
    object *o = (object *)make(p, sizeof *o, JSON_OBJECT);
    if (!o)
        return NULL;
    o->first = NULL;
    o->count = 0;
    entry **end = &o->first;
    p->at++;
    for (bool more = !take_char(p, '}'); more;) {
        entry *e = read_entry(p, o);
        if (!e)
            return NULL;
        *end = e;
        end = &e->next;
        o->count++;
        more = take_char(p, ',');
        if (!more && !take_char(p, '}'))
            return unexpected(p, "'}' expected"), NULL;
    }
    return &o->json;
}

static json_t *read_word(parser *p)
{
    static const struct {
        const char *word;
        json_type type;
    } words[] = {{"true", JSON_TRUE}, {"false", JSON_FALSE}, {"null", JSON_NULL}};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        const size_t size = strlen(words[i].word);
        if ((size_t)(p->limit - p->at) < size || memcmp(p->at, words[i].word, size) != 0)
            continue;
        p->at += size;
        return make(p, sizeof(json_t), words[i].type);
    }
    return unexpected(p, "invalid token"), NULL;
}

static json_t *read_nested(parser *p)
{
    if (++p->depth > DEEPEST)
        return fail(p, p->at, "%.*smaximum parsing depth reached", "", 0), NULL;
    json_t *value = *p->at == '[' ? read_array(p) : read_object(p);
    p->depth--;
    return value;
}

static json_t *read_value(parser *p)
{
    skip_blanks(p);
    if (p->at >= p->limit)
        return unexpected(p, ""), NULL;
    switch (*p->at) {
    case '{':
    case '[':
        return read_nested(p);
    case '"':
        return read_string(p);
    default:
        return *p->at == '-' || (*p->at >= '0' && *p->at <= '9') ? read_number(p) : read_word(p);
    }
}

/* ---- jansson's functions ------------------------------------------------------------------------------------ */

static bool may_begin(parser *p)
{
    skip_blanks(p);
    return p->flags & JSON_DECODE_ANY || (p->at < p->limit && strchr("[{", *p->at) && *p->at) ||
           unexpected(p, "'[' or '{' expected");
}

json_t *json_loadb(const char *text, size_t size, size_t flags, json_error_t *error)
{
    parser p = {.begin = text, .at = text, .limit = text + size, .flags = flags, .error = error};
    *error = (json_error_t){.line = -1};
    json_t *value = may_begin(&p) ? read_value(&p) : NULL;
    if (value)
        error->position = (int)(p.at - text);
    skip_blanks(&p);
    if (value && p.at < p.limit && !(flags & JSON_DISABLE_EOF_CHECK)) {
        unexpected(&p, "end of file expected");
        value = NULL;
    }
    free(p.items);
    if (!value)
        json_free_arena(p.first);
    return value;
}
