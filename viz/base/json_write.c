/* SPDX-License-Identifier: MIT */
/* json_write.c - writes JSON to a stream. */
#include "json_write.h"
#include "number.h"
#include "text.h"

#include <math.h>
#include <string.h>

static void write_pending_newline(json_writer *writer)
{
    if (writer->newline)
        putc_unlocked('\n', writer->out);
    writer->newline = false;
}

/* Writes the comma, space or line end that precedes the next value or key. */
static void write_separator(json_writer *writer)
{
    if (writer->comma)
        putc_unlocked(',', writer->out);
    if (writer->comma && !writer->newline)
        putc_unlocked(' ', writer->out);
    writer->comma = false;
    write_pending_newline(writer);
}

static void write_opening_bracket(json_writer *writer, char bracket)
{
    write_separator(writer);
    putc_unlocked(bracket, writer->out);
}

static void write_closing_bracket(json_writer *writer, char bracket)
{
    write_pending_newline(writer);
    putc_unlocked(bracket, writer->out);
    writer->comma = true;
}

void json_write_begin_object(json_writer *writer)
{
    write_opening_bracket(writer, '{');
}

void json_write_end_object(json_writer *writer)
{
    write_closing_bracket(writer, '}');
}

void json_write_begin_array(json_writer *writer)
{
    write_opening_bracket(writer, '[');
}

void json_write_end_array(json_writer *writer)
{
    write_closing_bracket(writer, ']');
}

/* Writes a value that is a single word, such as true. */
static void write_word(json_writer *writer, const char *word)
{
    write_separator(writer);
    fputs(word, writer->out);
    writer->comma = true;
}

/* A buffer that collects the text of several numbers, because many small writes to a stream are slow. */
typedef struct number_buffer {
    char text[8 * NUMBER_TEXT];
    size_t size;
} number_buffer;

static void append_text(number_buffer *g, const char *text, size_t size)
{
    memcpy(g->text + g->size, text, size);
    g->size += size;
}

static void append_separator(number_buffer *g, json_writer *writer)
{
    if (writer->comma)
        append_text(g, ", ", writer->newline ? 1 : 2);
    if (writer->newline)
        append_text(g, "\n", 1);
    writer->comma = true;
    writer->newline = false;
}

static void append_number(number_buffer *g, double value)
{
    if (isfinite(value))
        g->size += number_print(value, g->text + g->size);
    else
        append_text(g, "null", 4);
}

static void write_buffer(json_writer *writer, number_buffer *g)
{
    fwrite(g->text, 1, g->size, writer->out);
    g->size = 0;
}

/* ---- Strings ------------------------------------------------------------------------------------------------ */

static void write_escape(FILE *out, unsigned char c)
{
    if (c == '"' || c == '\\')
        fprintf(out, "\\%c", c);
    else if (c == '\n')
        fputs("\\n", out);
    else if (c == '\t')
        fputs("\\t", out);
    else
        fprintf(out, "\\u%04x", (unsigned)c);
}

/* Returns the number of characters at `at` that can be copied unchanged: ASCII characters that need no escape. */
static size_t count_unescaped(const unsigned char *at)
{
    size_t count = 0;
    while (at[count] >= ' ' && at[count] < 0x80 && at[count] != '"' && at[count] != '\\')
        count++;
    return count;
}

static void write_quoted(FILE *out, const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    putc_unlocked('"', out);
    while (*at) {
        const size_t plain = count_unescaped(at);
        fwrite(at, 1, plain, out);
        at += plain;
        if (*at < 0x80) {
            if (*at)
                write_escape(out, *at++);
            continue;
        }
        const size_t length = utf8_sequence_length(at);
        if (length > 0)
            fwrite(at, 1, length, out);
        else
            fputs(UTF8_REPLACEMENT, out);
        at += length > 0 ? length : 1;
    }
    putc_unlocked('"', out);
}

void json_write_key(json_writer *writer, const char *key)
{
    write_separator(writer);
    write_quoted(writer->out, key);
    fputs(": ", writer->out);
}

void json_write_string(json_writer *writer, const char *text)
{
    write_separator(writer);
    write_quoted(writer->out, text);
    writer->comma = true;
}

/* ---- Other values ------------------------------------------------------------------------------------------- */

void json_write_number(json_writer *writer, double value)
{
    json_write_elements(writer, &value, 1);
}

void json_write_elements(json_writer *writer, const double *values, size_t count)
{
    number_buffer g = {.size = 0};
    for (size_t i = 0; i < count; i++) {
        append_separator(&g, writer);
        append_number(&g, values[i]);
        if (i + 1 == count || g.size > sizeof g.text - 2 * NUMBER_TEXT)
            write_buffer(writer, &g);
    }
}

void json_write_integer(json_writer *writer, uint64_t value)
{
    number_buffer g = {.size = 0};
    char text[24], *at = text + sizeof text;
    do
        *--at = (char)('0' + value % 10);
    while (value /= 10);
    append_separator(&g, writer);
    append_text(&g, at, (size_t)(text + sizeof text - at));
    write_buffer(writer, &g);
}

void json_write_bool(json_writer *writer, bool value)
{
    write_word(writer, value ? "true" : "false");
}

void json_write_null(json_writer *writer)
{
    write_word(writer, "null");
}

void json_write_numbers(json_writer *writer, const double *values, size_t count)
{
    json_write_begin_array(writer);
    json_write_elements(writer, values, count);
    json_write_end_array(writer);
}

/* ---- Members and lines -------------------------------------------------------------------------------------- */

void json_write_integer_member(json_writer *writer, const char *key, uint64_t value)
{
    json_write_key(writer, key);
    json_write_integer(writer, value);
}

void json_write_number_member(json_writer *writer, const char *key, double value)
{
    json_write_key(writer, key);
    json_write_number(writer, value);
}

void json_write_bool_member(json_writer *writer, const char *key, bool value)
{
    json_write_key(writer, key);
    json_write_bool(writer, value);
}

void json_begin_object_member(json_writer *writer, const char *key)
{
    json_write_key(writer, key);
    json_write_begin_object(writer);
}

void json_begin_array_member(json_writer *writer, const char *key)
{
    json_write_key(writer, key);
    json_write_begin_array(writer);
}

void json_write_text_member(json_writer *writer, const char *key, const char *text)
{
    json_write_key(writer, key);
    if (text)
        json_write_string(writer, text);
    else
        json_write_null(writer);
}

void json_write_vector_member(json_writer *writer, const char *key, const double vector[3])
{
    json_write_key(writer, key);
    json_write_numbers(writer, vector, 3);
}

void json_write_box_member(json_writer *writer, const char *key, const octree_box *box)
{
    json_write_key(writer, key);
    json_write_begin_object(writer);
    json_write_vector_member(writer, "min", box->min);
    json_write_vector_member(writer, "max", box->max);
    json_write_end_object(writer);
}

void json_start_new_line(json_writer *writer)
{
    writer->newline = true;
}

void json_write_end_line(json_writer *writer)
{
    putc_unlocked('\n', writer->out);
    writer->comma = false;
    writer->newline = false;
}
