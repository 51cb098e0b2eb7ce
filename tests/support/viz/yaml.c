/* SPDX-License-Identifier: MIT */
#include "yaml.h"

#include <stdlib.h>
#include <string.h>

#include "files.h"
#include "fixture.h"

/* A line: its blanks, and what follows them. */
typedef struct line {
    size_t indent;
    char *text;
} line;

typedef struct reader {
    char *copy;
    size_t size; /* of the whole text */
    line *lines;
    size_t count, at;
} reader;

static json_t *read_block(reader *r, size_t indent);

static void fail_at(const char *text, const char *why)
{
    fail_msg("YAML that tests/support/viz/yaml.c does not know, %s: %s", why, text);
}

/* ---- Scalars and flow ----------------------------------------------------------------------------------------- */

static void skip_blanks(const char **at)
{
    *at += strspn(*at, " ");
}

static json_t *read_quoted(const char **at)
{
    const char quote = *(*at)++;
    char *text = calloc(strlen(*at) + 1, 1), *end = text;
    assert_non_null(text);
    for (;; (*at)++) {
        if (**at == 0)
            fail_at(*at, "a quoted text that goes on in the next line");
        if (**at == quote && (quote == '"' || (*at)[1] != quote))
            break;
        if (**at == quote || (**at == '\\' && quote == '"')) {
            (*at)++;
            if (quote == '"' && strchr("\\\"", **at) == NULL)
                fail_at(*at, "an escape");
        }
        *end++ = **at;
    }
    (*at)++;
    json_t *scalar = json_string(text);
    free(text);
    return scalar;
}

/* Up to one of `ends`, a comment or the end of the line. */
static json_t *read_plain(const char **at, const char *ends)
{
    const char *begin = *at;
    if (strchr("&*!>%@`", *begin) && *begin)
        fail_at(begin, "a plain text that begins so");
    while (**at && !strchr(ends, **at) && strncmp(*at, " #", 2) != 0 && (*ends == 0 || strncmp(*at, ": ", 2) != 0))
        (*at)++;
    size_t size = (size_t)(*at - begin);
    while (size && begin[size - 1] == ' ')
        size--;
    return json_stringn(begin, size);
}

static json_t *read_flow(const char **at, const char *ends)
{
    skip_blanks(at);
    if (**at == '"' || **at == '\'')
        return read_quoted(at);
    if (**at != '{' && **at != '[')
        return read_plain(at, ends);
    const bool is_map = *(*at)++ == '{';
    const char close = is_map ? '}' : ']';
    json_t *value = is_map ? json_object() : json_array();
    for (skip_blanks(at); **at != close; skip_blanks(at)) {
        json_t *item = read_flow(at, ",}]");
        skip_blanks(at);
        if (is_map) {
            if (*(*at)++ != ':')
                fail_at(*at, "a member without a value");
            json_object_set_new(value, json_string_value(item), read_flow(at, ",}]"));
            json_decref(item);
            skip_blanks(at);
        } else {
            json_array_append_new(value, item);
        }
        if (**at == ',')
            (*at)++;
        else if (**at != close)
            fail_at(*at, "a flow that goes on in the next line");
    }
    (*at)++;
    return value;
}

/* All of a line from here on. */
static json_t *read_value(const char *at)
{
    json_t *value = read_flow(&at, "");
    skip_blanks(&at);
    if (*at != 0 && *at != '#')
        fail_at(at, "something behind a value");
    return value;
}

/* ---- Blocks --------------------------------------------------------------------------------------------------- */

static bool is_nothing(const line *l)
{
    return *l->text == 0 || *l->text == '#';
}

/* The next line that says something; null at the end. */
static line *next(reader *r)
{
    while (r->at < r->count && is_nothing(&r->lines[r->at]))
        r->at++;
    return r->at < r->count ? &r->lines[r->at] : NULL;
}

/* The lines below a "key: |". */
static json_t *read_literal(reader *r, size_t parent)
{
    size_t indent = 0, size = 0, kept = 0;
    char *text = calloc(r->size + 2, 1);
    assert_non_null(text);
    for (; r->at < r->count; r->at++) {
        const line *l = &r->lines[r->at];
        if (*l->text && l->indent <= parent)
            break;
        if (indent == 0)
            indent = l->indent;
        for (size_t i = indent; *l->text && i < l->indent; i++)
            text[size++] = ' ';
        memcpy(text + size, l->text, strlen(l->text));
        size += strlen(l->text);
        text[size++] = '\n';
        if (*l->text)
            kept = size;
    }
    json_t *value = json_stringn(text, kept);
    free(text);
    return value;
}

/* Where the value of a member begins, behind its colon; null when the line is none. */
static const char *member_value(const char *text)
{
    const char *colon = strchr(text, ':');
    return colon && (colon[1] == 0 || colon[1] == ' ') && !strchr("\"'{[", *text) ? colon + 1 : NULL;
}

static json_t *read_member_value(reader *r, const char *value, size_t indent)
{
    value += strspn(value, " ");
    if (strcmp(value, "|") == 0)
        return read_literal(r, indent);
    if (*value && *value != '#')
        return read_value(value);
    const line *below = next(r);
    const bool is_inner = below && (below->indent > indent || (below->indent == indent && *below->text == '-'));
    return is_inner ? read_block(r, below->indent) : json_string("");
}

static json_t *read_map(reader *r, size_t indent)
{
    json_t *map = json_object();
    for (line *l; (l = next(r)) != NULL && l->indent == indent && *l->text != '-';) {
        const char *value = member_value(l->text);
        if (value == NULL)
            fail_at(l->text, "a line without a member");
        char *key = strndup(l->text, (size_t)(value - 1 - l->text));
        assert_non_null(key);
        if (json_object_get(map, key))
            fail_at(l->text, "a member again");
        r->at++;
        json_object_set_new(map, key, read_member_value(r, value, indent));
        free(key);
    }
    return map;
}

static json_t *read_sequence(reader *r, size_t indent)
{
    json_t *sequence = json_array();
    for (line *l; (l = next(r)) != NULL && l->indent == indent && strncmp(l->text, "- ", 2) == 0;) {
        const size_t mark = 1 + strspn(l->text + 1, " ");
        l->text += mark;
        l->indent += mark;
        if (member_value(l->text)) {
            json_array_append_new(sequence, read_map(r, l->indent));
        } else {
            r->at++;
            json_array_append_new(sequence, read_value(l->text));
        }
    }
    return sequence;
}

static json_t *read_block(reader *r, size_t indent)
{
    const line *l = next(r);
    return l && *l->text == '-' ? read_sequence(r, indent) : read_map(r, indent);
}

json_t *yaml_read(const char *text)
{
    reader r = {.copy = strdup(text), .size = strlen(text)};
    assert_non_null(r.copy);
    for (char *at = r.copy; at && *at;) {
        r.lines = realloc(r.lines, (r.count + 1) * sizeof *r.lines);
        assert_non_null(r.lines);
        const size_t indent = strspn(at, " ");
        r.lines[r.count++] = (line){indent, at + indent};
        at = strchr(at, '\n');
        if (at)
            *at++ = 0;
    }
    json_t *value = read_block(&r, 0);
    if (next(&r))
        fail_at(next(&r)->text, "a line that is indented otherwise");
    free(r.lines);
    free(r.copy);
    return value;
}

json_t *yaml_read_file(const char *path)
{
    char *text = file_read(path, NULL);
    json_t *value = yaml_read(text);
    free(text);
    return value;
}
