/* SPDX-License-Identifier: MIT */
/* text.c - prints into memory, escapes text, checks UTF-8 and encodes base64. */
#define _GNU_SOURCE /* for fopencookie(), if the system has it */
#include "text.h"
#include "array.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Printing into memory ------------------------------------------------------------------------------------ */

#ifdef __GLIBC__
static ssize_t append_bytes(void *stream, const char *bytes, size_t size)
{
    text_stream *s = stream;
    if (!array_grow(&s->text, s->size + size + 1, &s->room, 1))
        return 0;
    memcpy(s->text + s->size, bytes, size);
    s->size += size;
    s->text[s->size] = 0;
    return (ssize_t)size;
}

/* open_memstream() of glibc 2.36 is not used: if memory runs out, it leaves out a part of the text and reports no
 * error. */
static FILE *open_stream(text_stream *s)
{
    append_bytes(s, "", 0); /* allocate the text, in case nothing is printed to the stream */
    FILE *stream = s->text ? fopencookie(s, "w", (cookie_io_functions_t){.write = append_bytes}) : NULL;
    if (!stream) {
        free(s->text);
        s->text = NULL;
    }
    return stream;
}
#else
static FILE *open_stream(text_stream *s)
{
    return open_memstream(&s->text, &s->size);
}
#endif

bool text_stream_begin(text_stream *s)
{
    *s = (text_stream){0};
    s->stream = open_stream(s);
    return s->stream != NULL;
}

/* fclose() may fail to allocate the final text. Then *text is null, although the stream reports no error. */
bool text_stream_end(text_stream *s, char **text)
{
    const bool whole = s->stream && fflush(s->stream) == 0 && !ferror(s->stream);
    const bool ok = s->stream && fclose(s->stream) == 0 && whole && s->text;
    *text = ok && s->size ? s->text : NULL;
    if (!*text)
        free(s->text);
    return ok;
}

/* ---- Printable text ------------------------------------------------------------------------------------------ */

/* The valid non-ASCII sequences of UTF-8 (table 3-7 of the Unicode standard). Each row: a range of first bytes, the
 * range of the second byte, and the length in bytes. */
static const struct {
    unsigned char first, last, second_min, second_max;
    size_t length;
} sequences[] = {
    {0xc2, 0xdf, 0x80, 0xbf, 2}, {0xe0, 0xe0, 0xa0, 0xbf, 3}, {0xe1, 0xec, 0x80, 0xbf, 3}, {0xed, 0xed, 0x80, 0x9f, 3},
    {0xee, 0xef, 0x80, 0xbf, 3}, {0xf0, 0xf0, 0x90, 0xbf, 4}, {0xf1, 0xf3, 0x80, 0xbf, 4}, {0xf4, 0xf4, 0x80, 0x8f, 4},
};

size_t utf8_sequence_length(const unsigned char *at)
{
    for (size_t i = 0; i < sizeof sequences / sizeof *sequences; i++) {
        if (at[0] < sequences[i].first || at[0] > sequences[i].last)
            continue;
        if (at[1] < sequences[i].second_min || at[1] > sequences[i].second_max)
            return 0;
        for (size_t j = 2; j < sequences[i].length; j++)
            if (at[j] < 0x80 || at[j] > 0xbf)
                return 0;
        return sequences[i].length;
    }
    return 0;
}

char *make_printable(char *text)
{
    char *to = text;
    for (const char *at = text; *at;) {
        const size_t length = utf8_sequence_length((const unsigned char *)at);
        *to++ = (char)(*at < ' ' || *at > '~' ? '?' : *at);
        at += length ? length : 1;
    }
    *to = 0;
    return text;
}

const char *plural_ending(uint64_t count)
{
    return count == 1 ? "" : "s";
}

const char *verb_ending(uint64_t count)
{
    return count == 1 ? "s" : "";
}

void print_remaining_count(FILE *out, uint64_t count, uint64_t shown, const char *how)
{
    if (count > shown)
        fprintf(out, "  ... and %" PRIu64 " more%s%s\n", count - shown, *how ? "; " : "", how);
}

/* ---- Escaping ------------------------------------------------------------------------------------------------ */

static const char *format_character_reference(char c, char room[ESCAPE_ROOM])
{
    snprintf(room, ESCAPE_ROOM, "&#%d;", c);
    return room;
}

const char *escape_nothing(const char *text, const char *at, char room[ESCAPE_ROOM])
{
    (void)text, (void)at, (void)room;
    return NULL;
}

/* XML readers turn line ends and tabs in attributes into spaces, unless they are written as character references. */
const char *escape_xml_character(const char *text, const char *at, char room[ESCAPE_ROOM])
{
    (void)text;
    return strchr("<>&\"'\n\t", *at) ? format_character_reference(*at, room) : NULL;
}

const char *escape_xml_text(const char *text, const char *at, char room[ESCAPE_ROOM])
{
    return *at == '\n' ? "\n" : escape_xml_character(text, at, room);
}

static bool is_word_character(char c)
{
    return isalnum((unsigned char)c) || (unsigned char)c >= 0x80;
}

/* An underscore inside a word needs no escape. Other characters that Markdown treats specially become character
 * references. */
const char *escape_markdown_character(const char *text, const char *at, char room[ESCAPE_ROOM])
{
    if (*at == '_' && at > text && is_word_character(at[-1]) && is_word_character(at[1]))
        return NULL;
    if (*at == '\n' || *at == '\t')
        return " ";
    return strchr("\\`*_{}[]<>#+!|~&@$\"'", *at) ? format_character_reference(*at, room) : NULL;
}

bool utf8_is_unprintable(const unsigned char *at)
{
    switch (at[0]) {
    case 0xc2: /* U+0080 to U+009F: control characters */
        return at[1] < 0xa0;
    case 0xd8: /* U+061C: a mark that changes the direction of writing */
        return at[1] == 0x9c;
    /* U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069: marks that change the direction of writing; U+2028, U+2029:
     * separators */
    case 0xe2:
        return (at[1] == 0x80 && (at[2] == 0x8e || at[2] == 0x8f || (at[2] >= 0xa8 && at[2] <= 0xae))) ||
               (at[1] == 0x81 && at[2] >= 0xa6 && at[2] <= 0xa9);
    case 0xef: /* U+FFFE, U+FFFF: codes that are not characters */
        return at[1] == 0xbf && at[2] >= 0xbe;
    default:
        return false;
    }
}

/* Writes the non-ASCII character at `at`, or a replacement. Returns the number of bytes of `at` that were used. */
static size_t write_utf8_character(FILE *out, const unsigned char *at)
{
    const size_t length = utf8_sequence_length(at);
    if (length == 0 || utf8_is_unprintable(at))
        fputs(UTF8_REPLACEMENT, out);
    else
        fwrite(at, 1, length, out);
    return length ? length : 1;
}

void write_escaped(FILE *out, const char *text, escape *how)
{
    char room[ESCAPE_ROOM];
    for (const char *at = text; *at;) {
        const unsigned char c = (unsigned char)*at;
        if (c >= 0x80) {
            at += write_utf8_character(out, (const unsigned char *)at);
            continue;
        }
        const char *written = how(text, at++, room);
        if (written)
            fputs(written, out);
        else if (c < ' ' || c == 0x7f)
            fputs(UTF8_REPLACEMENT, out);
        else
            putc(c, out);
    }
}

char *text_next_line(char **at)
{
    char *line = *at, *end = line + strcspn(line, "\n");
    if (!*line)
        return NULL;
    *at = *end ? end + 1 : end;
    if (end > line && end[-1] == '\r')
        end[-1] = 0;
    *end = 0;
    return line;
}

/* ---- Base64 -------------------------------------------------------------------------------------------------- */

enum { GROUPS = 4096 };

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/* Encodes up to three bytes as four base64 digits. Missing bytes count as zero; the digits of missing bytes become
 * '='. */
static void encode_base64_group(const unsigned char *from, size_t count, char *to)
{
    const unsigned bits =
        (unsigned)from[0] << 16 | (count > 1 ? (unsigned)from[1] << 8 : 0) | (count > 2 ? from[2] : 0);
    for (unsigned i = 0; i < 4; i++)
        to[i] = i <= count ? digits[bits >> (18 - 6 * i) & 63] : '=';
}

void base64_encode(FILE *in, FILE *out)
{
    unsigned char bytes[3 * GROUPS];
    char text[4 * GROUPS];
    for (size_t size; (size = fread(bytes, 1, sizeof bytes, in)) > 0;) {
        size_t length = 0;
        for (size_t at = 0; at < size; at += 3, length += 4)
            encode_base64_group(bytes + at, size - at, text + length);
        fwrite(text, 1, length, out);
    }
}
