/* SPDX-License-Identifier: MIT */
/* json_read.c - reads JSON objects with jansson. To find the line of an error, it scans the text again. */
#include "json_read.h"
#include "number.h"
#include "text.h"

#include <stdarg.h>
#include <string.h>

/* ---- Places in an object ------------------------------------------------------------------------------------ */

/* Writes a place such as points[3].velocity, and returns the number of characters written. The depth of the recursion
 * is the depth of the place, which does not depend on the input. */
static size_t format_place(const json_place *place, char *text, size_t size)
{
    if (!place)
        return 0;
    const size_t length = format_place(place->parent, text, size);
    if (length + 1 >= size)
        return length;
    if (!place->member)
        snprintf(text + length, size - length, "[%zu]", place->index);
    else
        snprintf(text + length, size - length, "%s%s", length > 0 ? "." : "", place->member);
    return length + strlen(text + length);
}

const char *json_place_format(const json_place *place, char *text, size_t size)
{
    text[0] = 0;
    format_place(place, text, size);
    return text;
}

static void skip_blanks(const char **at, const char *limit)
{
    while (*at < limit && (**at == ' ' || **at == '\t' || **at == '\n' || **at == '\r'))
        ++*at;
}

static json_malloc_t original_malloc;
static _Thread_local bool allocation_failed;

static void *allocate_and_record_failure(size_t size)
{
    void *memory = original_malloc(size);
    allocation_failed |= !memory;
    return memory;
}

void json_detect_failed_allocations(void)
{
    json_free_t release;
    json_get_alloc_funcs(&original_malloc, &release);
    json_set_alloc_funcs(allocate_and_record_failure, release);
}

json_t *json_parse(const char *text, size_t size, size_t flags, json_error_t *error)
{
    allocation_failed = false;
    json_t *value = json_loadb(text, size, flags, error);
    if (!allocation_failed)
        return value;
    json_decref(value);
    *error = (json_error_t){.line = -1};
    return NULL;
}

/* Reads the value at *at and moves *at past the value. Returns null at the end of the text. jansson does not store
 * where a value begins, but it reports where a value ends. */
static json_t *read_value_at(const char **at, const char *limit)
{
    json_error_t end;
    json_t *value = json_parse(*at, (size_t)(limit - *at),
                               JSON_DECODE_ANY | JSON_DISABLE_EOF_CHECK | JSON_DECODE_INT_AS_REAL, &end);
    *at = value ? *at + end.position : limit;
    skip_blanks(at, limit);
    return value;
}

/* Returns the start of a member or element in the object or array at `at`. Returns null if there is no such member or
 * element. */
static const char *find_child(const char *at, const char *limit, const json_place *place)
{
    if (*at != (place->member ? '{' : '['))
        return NULL;
    for (size_t i = 0; at < limit && *at != ']' && *at != '}'; i++) {
        bool found = i == place->index;
        at++; /* skip the opening bracket or the comma */
        skip_blanks(&at, limit);
        if (place->member) {
            json_t *name = read_value_at(&at, limit);
            found = name && strcmp(json_string_value(name), place->member) == 0;
            json_decref(name);
            at += at < limit; /* skip the colon */
            skip_blanks(&at, limit);
        }
        if (found)
            return at;
        json_decref(read_value_at(&at, limit));
    }
    return NULL;
}

static const char *find_place(const json_reader *r, const json_place *place)
{
    const char *above = place ? find_place(r, place->parent) : NULL;
    return !place ? r->at : above && above < r->limit ? find_child(above, r->limit, place) : NULL;
}

static size_t count_lines(const char *from, const char *to)
{
    size_t lines = 0;
    for (; from < to; from++)
        lines += *from == '\n';
    return lines;
}

size_t json_find_line(const json_reader *r, const json_place *at)
{
    const char *found = find_place(r, at);
    for (; !found; found = find_place(r, at))
        at = at->parent;
    return r->line + count_lines(r->at, found);
}

/* ---- Errors ------------------------------------------------------------------------------------------------- */

const char *json_shorten_name(const char *name)
{
    enum { LONGEST_NAME = 160 };
    const size_t length = strlen(name);
    return length > LONGEST_NAME ? name + (length - LONGEST_NAME) : name;
}

static bool fail_at_line(json_reader *r, size_t line, const json_place *at, const char *format, va_list arguments)
{
    char where[96], reason[260], printable[sizeof where + sizeof reason];
    vsnprintf(reason, sizeof reason, format, arguments);
    json_place_format(at, where, sizeof where);
    snprintf(printable, sizeof printable, "%s%s%s", where, *where ? ": " : "", reason);
    /* make the message printable, because quoted parts of the file could contain terminal escape sequences */
    make_printable(printable);
    return error_set(r->error, "%s:%zu: %s", json_shorten_name(r->name), line, printable);
}

bool json_fail(json_reader *r, const json_place *at, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fail_at_line(r, json_find_line(r, at), at, format, arguments);
    va_end(arguments);
    return false;
}

bool json_fail_line(json_reader *r, size_t line, const json_place *at, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fail_at_line(r, line, at, format, arguments);
    va_end(arguments);
    return false;
}

/* Writes a short description of a value for an error message. */
static void describe_value(const json_t *value, char *text, size_t size)
{
    static const char *const types[] = {
        [JSON_OBJECT] = "an object", [JSON_TRUE] = "true", [JSON_FALSE] = "false", [JSON_NULL] = "null"};
    char number[NUMBER_TEXT];
    switch (json_typeof(value)) {
    case JSON_ARRAY:
        snprintf(text, size, "a list of %zu", json_array_size(value));
        break;
    case JSON_STRING:
        snprintf(text, size, "\"%.40s\"", json_string_value(value));
        break;
    case JSON_INTEGER:
    case JSON_REAL:
        number_print(json_number_value(value), number);
        snprintf(text, size, "%s", number);
        break;
    default:
        snprintf(text, size, "%s", types[json_typeof(value)]);
        break;
    }
}

bool json_fail_expected(json_reader *r, const json_t *value, const json_place *at, const char *what)
{
    char found[64];
    describe_value(value, found, sizeof found);
    return json_fail(r, at, "expected %s, found %s", what, found);
}

/* ---- Objects ------------------------------------------------------------------------------------------------ */

/* Reports jansson's error message. Two messages are reworded. The first would allow arrays, but only objects are
 * allowed here. The second names an option of jansson, which users cannot set. */
static bool fail_with_jansson_error(json_reader *r, const json_error_t *parsed)
{
    static const char *const words[][2] = {
        {"'[' or '{' expected", "'{' expected"},
        {"\\u0000 is not allowed without JSON_ALLOW_NUL", "a text cannot contain \\u0000"},
    };
    const char *rest = parsed->text, *ours = "";
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strncmp(parsed->text, words[i][0], strlen(words[i][0])) != 0)
            continue;
        ours = words[i][1];
        rest = parsed->text + strlen(words[i][0]);
    }
    return json_fail_line(r, r->line + (parsed->line > 1 ? (size_t)parsed->line - 1 : 0), NULL, "%s%s", ours, rest);
}

static void move_reader_to(json_reader *r, const char *at)
{
    r->line += count_lines(r->at, at);
    r->at = at;
}

bool json_skip_to_object(json_reader *r)
{
    const char *at = r->at;
    skip_blanks(&at, r->limit);
    move_reader_to(r, at);
    return at < r->limit;
}

bool json_read_object(json_reader *r, bool alone, json_object_reader *read)
{
    const size_t flags = JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL | (alone ? 0 : JSON_DISABLE_EOF_CHECK);
    json_error_t parsed;
    json_t *object = json_parse(r->at, (size_t)(r->limit - r->at), flags, &parsed);
    if (!object && parsed.line < 1)
        return json_fail_line(r, r->line, NULL, "out of memory");
    if (!object)
        return fail_with_jansson_error(r, &parsed);
    const bool done = json_is_object(object) ? read(r, object) : json_fail_expected(r, object, NULL, "an object");
    json_decref(object);
    if (!alone)
        move_reader_to(r, r->at + parsed.position);
    return done;
}
