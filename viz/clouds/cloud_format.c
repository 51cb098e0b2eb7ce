/* SPDX-License-Identifier: MIT */
/* cloud_format.c - functions that all readers of cloud formats share; see cloud_format.h. */
#include "cloud_format.h"
#include "array.h"
#include "number.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ---- Result and errors -------------------------------------------------------------------------------------- */

/* Stores the row number of the next point. This function is called only after a point was skipped: until then, the row
 * number of each point is equal to its index. */
static bool add_row_number(cloud_file *file)
{
    cloud *points = file->out;
    const bool first = !points->rows;
    if (!array_grow(&points->rows, points->count + 1, &file->row_room, sizeof *points->rows))
        return false;
    for (size_t i = 0; first && i < points->count; i++)
        points->rows[i] = i;
    points->rows[points->count] = points->count + points->skipped;
    return true;
}

void cloud_count_skipped(const cloud_file *file, const char *why)
{
    file->out->skipped++;
    file->out->why_skipped = why;
}

/* Stores the values of the point whose row number in the file is `row`. The rows of skipped points before this row get
 * missing values. */
static bool add_values(cloud_file *file, size_t row, const double *numbers)
{
    point_values *values = &file->out->values;
    while (values->count <= row)
        if (!point_values_append_row(values, &(point_value){0}))
            return false;
    cloud_convert_values(file, numbers, &values->rows[row]);
    return true;
}

bool cloud_reserve(cloud_file *file, uint64_t count)
{
    cloud *points = file->out;
    if (count <= file->room)
        return true;
    void *grown = count <= SIZE_MAX / sizeof *points->positions
                      ? realloc(points->positions, (size_t)count * sizeof *points->positions)
                      : NULL;
    if (!grown)
        return cloud_fail(file, "out of memory for %" PRIu64 " points", count);
    points->positions = grown;
    file->room = (size_t)count;
    return true;
}

bool cloud_reserve_announced(cloud_file *file, uint64_t count, uint64_t columns)
{
    const uint64_t most = file->size / columns;
    return cloud_reserve(file, count < most ? count : most);
}

bool cloud_skip_nonfinite(const cloud_file *file, const double *position)
{
    const bool finite = isfinite(position[0]) && isfinite(position[1]) && isfinite(position[2]);
    if (!finite)
        cloud_count_skipped(file, "without finite coordinates");
    return !finite;
}

bool cloud_add_point(cloud_file *file, const double *position)
{
    cloud *points = file->out;
    if (cloud_skip_nonfinite(file, position))
        return true;
    if (!array_grow(&points->positions, points->count + 1, &file->room, sizeof *points->positions) ||
        (points->skipped > 0 && !add_row_number(file)) ||
        (file->channels && !add_values(file, points->count + points->skipped, position)))
        return cloud_fail(file, "out of memory after %zu points", points->count);
    memcpy(points->positions[points->count++], position, sizeof *points->positions);
    return true;
}

void cloud_report_progress(const cloud_file *file, uint64_t calls, uint64_t done, uint64_t total)
{
    if (file->watch && calls % 65536 == 0)
        file->watch->step((double)done / (double)total, file->watch->context);
}

bool cloud_fail_at(const cloud_file *file, const char *unit, size_t number, const char *format, ...)
{
    char reason[256], place[32] = "";
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    if (unit)
        snprintf(place, sizeof place, "%s%zu:", unit, number);
    return error_set(file->error, "%s:%s %s", file->name, place, reason);
}

bool cloud_turn_error_into_note(const cloud_file *file)
{
    char *note = file->out->note;
    if (!*note)
        snprintf(note, sizeof file->out->note, "%.400s; the points before this place were read", file->error->text);
    file->error->text[0] = 0;
    return true;
}

/* ---- Lines and words ---------------------------------------------------------------------------------------- */

/* Returns the last character of the line ends of a file: \r if the first line ends with a single \r, otherwise \n. Only
 * the first line is examined, because \n may also be the first byte of binary data after a header. */
static char find_terminator(const char *at, const char *limit)
{
    while (at < limit && *at != '\n' && *at != '\r')
        at++;
    bool alone = at < limit && *at == '\r' && !(at + 1 < limit && at[1] == '\n');
    return alone ? '\r' : '\n';
}

void cloud_rewind_lines(cloud_file *file)
{
    const char *begin = (const char *)file->bytes, *limit = begin + file->size;
    file->lines = (cloud_lines){begin, limit, find_terminator(begin, limit), 0};
}

bool cloud_read_next_line(cloud_file *file, cloud_span *line)
{
    cloud_lines *lines = &file->lines;
    if (lines->at == lines->limit)
        return false;
    const char *stop = memchr(lines->at, lines->terminator, (size_t)(lines->limit - lines->at));
    *line = (cloud_span){lines->at, stop ? stop : lines->limit};
    lines->at = stop ? stop + 1 : lines->limit;
    lines->number++;
    if (line->limit > line->begin && line->limit[-1] == '\r')
        line->limit--;
    return true;
}

bool cloud_read_nonblank_line(cloud_file *file, cloud_span *line)
{
    while (cloud_read_next_line(file, line)) {
        cloud_span rest = *line, word;
        if (cloud_read_word(&rest, &word))
            return true;
    }
    return false;
}

bool cloud_read_word(cloud_span *line, cloud_span *word)
{
    while (line->begin < line->limit && cloud_is_blank(*line->begin))
        line->begin++;
    word->begin = line->begin;
    while (line->begin < line->limit && !cloud_is_blank(*line->begin))
        line->begin++;
    word->limit = line->begin;
    return word->begin < word->limit;
}

bool cloud_word_equals(cloud_span word, const char *text)
{
    size_t length = (size_t)(word.limit - word.begin);
    return length == strlen(text) && memcmp(word.begin, text, length) == 0;
}

int cloud_find_word_in_list(cloud_span word, const char *list)
{
    cloud_span rest = {list, list + strlen(list)}, listed;
    const size_t length = (size_t)(word.limit - word.begin);
    for (int i = 0; cloud_read_word(&rest, &listed); i++)
        if (length == (size_t)(listed.limit - listed.begin) && memcmp(word.begin, listed.begin, length) == 0)
            return i;
    return -1;
}

bool cloud_parse_count(cloud_span word, uint64_t *count)
{
    *count = 0;
    for (const char *at = word.begin; at < word.limit; at++) {
        if (*at < '0' || *at > '9')
            return false;
        uint64_t digit = (uint64_t)(*at - '0');
        if (*count > (UINT64_MAX - digit) / 10)
            return false;
        *count = *count * 10 + digit;
    }
    return word.begin < word.limit;
}

bool cloud_parse_coordinate(const cloud_file *file, cloud_span word, double *coordinate)
{
    const char *end;
    bool finite = number_parse(word.begin, word.limit, &end, coordinate);
    if (end == word.limit && finite)
        return true;
    if (end == word.limit)
        return cloud_fail_at_word(file, word, "is beyond the largest double");
    if (!number_parse_nonfinite(word.begin, word.limit, &end) || end != word.limit)
        return cloud_fail_at_word(file, word, "is not a number");
    *coordinate = NAN;
    return true;
}

const char *cloud_quote_word(cloud_span word, char text[CLOUD_QUOTE])
{
    enum { LONGEST = CLOUD_QUOTE - sizeof "\\xff...'" + 1 };
    const char *at = word.begin;
    int length = snprintf(text, CLOUD_QUOTE, "'");
    for (; at < word.limit && length < LONGEST; at++)
        length += snprintf(text + length, CLOUD_QUOTE - (size_t)length, *at >= ' ' && *at <= '~' ? "%c" : "\\x%02x",
                           (unsigned char)*at);
    snprintf(text + length, CLOUD_QUOTE - (size_t)length, "%s", at < word.limit ? "...'" : "'");
    return text;
}

bool cloud_fail_at_word(const cloud_file *file, cloud_span word, const char *reason)
{
    char quote[CLOUD_QUOTE];
    return cloud_fail_line(file, "%s %s", cloud_quote_word(word, quote), reason);
}

bool cloud_check_text(const cloud_file *file)
{
    const char *nul = memchr(file->bytes, '\0', file->size);
    cloud_file again = *file;
    cloud_span line;
    if (!nul)
        return true;
    cloud_rewind_lines(&again);
    while (again.lines.at <= nul)
        cloud_read_next_line(&again, &line);
    return cloud_fail_line(&again, "holds a NUL byte and is not text; supported formats are %s", CLOUD_NAMES);
}

void cloud_note_trailing_lines(cloud_file *file)
{
    cloud_span line;
    if (cloud_read_nonblank_line(file, &line)) {
        cloud_fail_line(file, "the file has more lines than its header says");
        cloud_turn_error_into_note(file);
    }
}

/* ---- Binary data -------------------------------------------------------------------------------------------- */

/* The numbers of one record, indexed by cloud_channel. */
typedef double record_numbers[CLOUD_CHANNELS];

static inline void read_column_as(cloud_scalar type, const cloud_field *field, uint64_t from, size_t count,
                                  record_numbers *numbers)
{
    const unsigned char *at = field->first + from * field->step;
    for (size_t i = 0; i < count; i++, at += field->step)
        numbers[i][field->channel] = cloud_read_scalar(type, field->big_endian, at);
}

/* Reads a field of `count` records. Frequent types have loops of their own, in which compilers turn cloud_read_scalar()
 * into few instructions. */
static void read_column(const cloud_field *field, uint64_t from, size_t count, record_numbers *numbers)
{
    const cloud_scalar type = field->type;
    if (type.kind == CLOUD_FLOAT && type.size == 4)
        read_column_as((cloud_scalar){CLOUD_FLOAT, 4}, field, from, count, numbers);
    else if (type.kind == CLOUD_FLOAT)
        read_column_as((cloud_scalar){CLOUD_FLOAT, 8}, field, from, count, numbers);
    else if (type.kind == CLOUD_UNSIGNED && type.size == 1)
        read_column_as((cloud_scalar){CLOUD_UNSIGNED, 1}, field, from, count, numbers);
    else
        read_column_as(type, field, from, count, numbers);
}

bool cloud_add_records(cloud_file *file, const cloud_field *fields, size_t field_count, uint64_t count)
{
    enum { BLOCK = 256 }; /* the numbers of this many records fit the L1 cache */
    record_numbers numbers[BLOCK];
    if (!cloud_reserve(file, count))
        return false;
    for (uint64_t from = 0; from < count; from += BLOCK) {
        const size_t block = count - from < BLOCK ? (size_t)(count - from) : BLOCK;
        cloud_report_progress(file, from, from, count);
        for (size_t k = 0; k < field_count; k++)
            read_column(&fields[k], from, block, numbers);
        for (size_t i = 0; i < block; i++)
            if (!cloud_add_point(file, numbers[i]))
                return false;
    }
    return true;
}

void cloud_note_trailing_bytes(const cloud_file *file, size_t offset)
{
    while (offset < file->size && file->bytes[offset] == 0)
        offset++;
    if (offset < file->size) {
        cloud_fail_byte(file, offset, "the file has more data than its header says");
        cloud_turn_error_into_note(file);
    }
}
