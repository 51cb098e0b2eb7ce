/* SPDX-License-Identifier: MIT */
/* cloud_text.c - points as text: a line each, its first three columns x y z. */
#include "cloud_format.h"
#include "number.h"

#include <string.h>

static const char *skip_blanks(cloud_span line)
{
    while (line.begin < line.limit && cloud_is_blank(*line.begin))
        line.begin++;
    return line.begin;
}

/* True where nothing but a comment is left of a line. */
static bool is_over(cloud_span line)
{
    size_t left = (size_t)(line.limit - line.begin);
    return left == 0 || *line.begin == '#' || (left > 1 && line.begin[0] == '/' && line.begin[1] == '/');
}

static bool is_mark(char c)
{
    return c == ',' || c == ';';
}

/* Cut the next column off a line for reading names and quoting: a word that commas and semicolons end too. */
static bool next_column(cloud_span *line, cloud_span *column)
{
    while (line->begin < line->limit && (cloud_is_blank(*line->begin) || is_mark(*line->begin)))
        line->begin++;
    column->begin = line->begin;
    while (line->begin < line->limit && !cloud_is_blank(*line->begin) && !is_mark(*line->begin))
        line->begin++;
    column->limit = line->begin;
    return column->begin < column->limit;
}

static cloud_span strip_quotes(cloud_span column)
{
    if (column.begin < column.limit && *column.begin == '"')
        column.begin++;
    if (column.begin < column.limit && column.limit[-1] == '"')
        column.limit--;
    return column;
}

/* A name is what does not start like a number. */
static bool is_name(cloud_span column)
{
    const char *end;
    bool number_like = column.begin == column.limit || strchr("+-.0123456789", *column.begin);
    return !number_like && !number_parse_nonfinite(column.begin, column.limit, &end);
}

/* A line of three names or more, and nothing else. */
static bool is_header(cloud_span line)
{
    cloud_span column;
    size_t count = 0;
    for (; next_column(&line, &column); count++)
        if (!is_name(strip_quotes(column)))
            return false;
    return count >= 3;
}

/* Names are taken at their word: a file whose columns are "id,x,y,z" would make a wrong picture. A unit, as in
 * "x [m], y [m]", belongs to the name before it. */
static bool check_header(const cloud_file *file, size_t number, cloud_span line)
{
    cloud_span column;
    int index = 0;
    while (next_column(&line, &column)) {
        if (*column.begin == '[' || *column.begin == '(')
            continue;
        cloud_span name = strip_quotes(column);
        char lower = (char)(name.limit - name.begin == 1 ? *name.begin | ('a' ^ 'A') : 0);
        int axis = cloud_word_axis((cloud_span){&lower, &lower + 1});
        if (axis >= 0 && axis != index)
            return cloud_fail_line(file, number, "names column %d %c: the first three must be x y z", index + 1,
                                   "xyz"[axis]);
        index++;
    }
    return true;
}

/* Say why there is no coordinate at the front of a line. */
static bool fail_coordinate(const cloud_file *file, size_t number, cloud_span line, int axis)
{
    const char *end;
    double ignored;
    cloud_span column = line;
    if (is_over(line))
        return cloud_fail_line(file, number, "has %d of the three coordinates x y z", axis);
    if (is_mark(*line.begin))
        return cloud_fail_line(file, number, "has nothing in column %d", axis + 1);
    next_column(&line, &column);
    if (number_parse_nonfinite(column.begin, column.limit, &end) && end == column.limit)
        return cloud_fail_word(file, number, column, "is not a finite number");
    if (!number_parse(column.begin, column.limit, &end, &ignored) && end == column.limit)
        return cloud_fail_word(file, number, column, "is beyond the largest double");
    return cloud_fail_word(file, number, column, "is not a number");
}

/* Read one point. The separator after each coordinate must be like the first: decimal commas, as in "1,5;2,5;3,5"
 * or "1,5 2,5 3,5", would pass for other points. */
static bool parse_point(const cloud_file *file, size_t number, cloud_span line, double position[3])
{
    char separator = 0;
    for (int axis = 0; axis < 3; axis++) {
        cloud_span column = line;
        const char *end;
        if (!number_parse(line.begin, line.limit, &end, &position[axis]))
            return fail_coordinate(file, number, line, axis);
        line.begin = end;
        line.begin = skip_blanks(line);
        if (is_over(line)) {
            if (axis == 2)
                return true;
            return fail_coordinate(file, number, line, axis + 1);
        }
        char mark = is_mark(*line.begin) ? *line.begin : ' ';
        if (mark == ' ' && line.begin == end)
            return fail_coordinate(file, number, column, axis);
        if (separator && mark != separator)
            return cloud_fail_line(file, number, "mixes blanks, commas and semicolons between its columns");
        separator = mark;
        if (mark != ' ')
            line.begin++;
        line.begin = skip_blanks(line);
    }
    return true;
}

/* The lines, without the mark that some editors put before UTF-8. */
static cloud_lines lines_of(const cloud_file *file)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    cloud_lines lines = cloud_lines_of(file);
    if (file->size >= 3 && memcmp(lines.at, byte_order_mark, 3) == 0)
        lines.at += 3;
    return lines;
}

bool cloud_text_begins(const cloud_file *file)
{
    cloud_lines lines = lines_of(file);
    cloud_span line;
    double position[3];
    for (bool first = true; cloud_next_line(&lines, &line);) {
        line.begin = skip_blanks(line);
        if (is_over(line))
            continue;
        if (!first || !is_header(line))
            return parse_point(file, lines.number, line, position);
        first = false;
    }
    return false;
}

static bool parse_text(cloud_file *file)
{
    cloud_lines lines = lines_of(file);
    cloud_span line;
    bool first = true;
    if (!cloud_check_text(file))
        return false;
    while (cloud_next_line(&lines, &line)) {
        double position[3];
        cloud_tell(file, lines.number, (uint64_t)(lines.at - (const char *)file->bytes), file->size);
        line.begin = skip_blanks(line);
        if (is_over(line))
            continue;
        if (first && is_header(line)) {
            if (!check_header(file, lines.number, line))
                return false;
        } else if (!parse_point(file, lines.number, line, position) || !cloud_add(file, position)) {
            return false;
        }
        first = false;
    }
    return true;
}

const cloud_format cloud_text = {"x y z text", NULL, NULL, parse_text};
