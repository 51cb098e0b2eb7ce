/* SPDX-License-Identifier: MIT */
/* cloud_text.c - points as text: a line each, its first three columns x y z. */
#include "array.h"
#include "cloud_format.h"
#include "number.h"

#include <math.h>
#include <string.h>

/* The columns of a file. */
typedef struct text_columns {
    signed char *channels; /* of each column from the fourth on a cloud_channel; -1: none */
    size_t count, room;
    bool unnamed;     /* there are such columns, and no names */
    bool guessed;     /* from the first line of numbers, for want of names; then: */
    bool ranges[2];   /* the channels of each line so far are in one_range */
    bool shifted[2];  /* and so is the column before them */
    bool no_normals;  /* and some are not of length 1 */
    double brightest; /* of all channels */
} text_columns;

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

static int channel_of(cloud_span name)
{
    const char lower = (char)(name.limit - name.begin == 1 ? *name.begin | ('a' ^ 'A') : 0);
    return cloud_word_channel(lower ? (cloud_span){&lower, &lower + 1} : name);
}

static bool add_column(text_columns *columns, int channel)
{
    signed char *channels = array_reserve(columns->channels, columns->count + 1, &columns->room, sizeof *channels);
    if (!channels)
        return false;
    columns->channels = channels;
    channels[columns->count++] = (signed char)channel;
    return true;
}

/* Names are taken at their word: a file whose columns are "id,x,y,z" would make a wrong picture. A unit, as in
 * "x [m], y [m]", belongs to the name before it. */
static bool read_header(cloud_file *file, size_t number, cloud_span line, text_columns *columns)
{
    cloud_span column;
    unsigned channels = 0;
    for (int index = 0; next_column(&line, &column);) {
        if (*column.begin == '[' || *column.begin == '(')
            continue;
        int channel = channel_of(strip_quotes(column));
        if (channel >= CLOUD_X && channel <= CLOUD_Z && channel != index)
            return cloud_fail_line(file, number, "names column %d %c: the first three must be x y z", index + 1,
                                   "xyz"[channel]);
        if (channel >= 0 && channels >> channel & 1)
            channel = -1;
        if (channel >= 0)
            channels |= 1U << channel;
        if (index++ >= 3 && !add_column(columns, channel))
            return cloud_fail_line(file, number, "out of memory for its names");
    }
    while (columns->count > 0 && columns->channels[columns->count - 1] < 0)
        columns->count--;
    cloud_begin_values(file, channels, 1);
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
    if (!number_parse(column.begin, column.limit, &end, &ignored) && end == column.limit)
        return cloud_fail_word(file, number, column, "is beyond the largest double");
    return cloud_fail_word(file, number, column, "is not a number");
}

/* Read the number at the front of a line, NaN for one that is not finite. *end is what follows it. */
static bool parse_coordinate(cloud_span line, const char **end, double *coordinate)
{
    if (number_parse(line.begin, line.limit, end, coordinate))
        return true;
    *coordinate = NAN;
    return *end == line.begin && number_parse_nonfinite(line.begin, line.limit, end);
}

/* Read the coordinates of a point and cut them off the line. The separator after each must be like the first: decimal
 * commas, as in "1,5;2,5;3,5" or "1,5 2,5 3,5", would pass for other points. */
static bool parse_position(const cloud_file *file, size_t number, cloud_span *rest, char *mark, double position[3])
{
    char separator = 0;
    cloud_span line = *rest;
    for (int axis = 0; axis < 3; axis++) {
        cloud_span column = line;
        const char *end;
        if (!parse_coordinate(line, &end, &position[axis]))
            return fail_coordinate(file, number, line, axis);
        line.begin = end;
        line.begin = skip_blanks(line);
        if (is_over(line)) {
            *rest = line;
            return axis == 2 || fail_coordinate(file, number, line, axis + 1);
        }
        *mark = is_mark(*line.begin) ? *line.begin : ' ';
        if (*mark == ' ' && line.begin == end)
            return fail_coordinate(file, number, column, axis);
        if (separator && *mark != separator)
            return cloud_fail_line(file, number, "mixes blanks, commas and semicolons between its columns");
        separator = *mark;
        line.begin += *mark != ' ';
        line.begin = skip_blanks(line);
    }
    *rest = line;
    return true;
}

/* Cut the next column off, which ends at such a mark, or, where that is ' ', at a blank. False at the end. */
static bool next_field(cloud_span *line, char mark, cloud_span *field)
{
    line->begin = skip_blanks(*line);
    if (is_over(*line))
        return false;
    field->begin = line->begin;
    while (!is_over(*line) && (mark == ' ' ? !cloud_is_blank(*line->begin) : *line->begin != mark))
        line->begin++;
    field->limit = line->begin;
    if (!is_over(*line))
        line->begin++;
    while (field->limit > field->begin && cloud_is_blank(field->limit[-1]))
        field->limit--;
    return true;
}

/* NaN where a field is no number. */
static double number_of(cloud_span field)
{
    double number = NAN;
    const char *end;
    field = strip_quotes(field);
    return number_parse(field.begin, field.limit, &end, &number) && end == field.limit ? number : NAN;
}

/* What the columns after the coordinates hold; what is missing is NaN. Returns how many columns there are, of those
 * that count and one more. */
static size_t parse_values(cloud_span line, char mark, const text_columns *columns, double numbers[CLOUD_CHANNELS])
{
    cloud_span field;
    size_t i = 0;
    for (int channel = CLOUD_Z + 1; channel < CLOUD_CHANNELS; channel++)
        numbers[channel] = NAN;
    for (; i < columns->count && next_field(&line, mark, &field); i++)
        if (columns->channels[i] >= 0)
            numbers[columns->channels[i]] = number_of(field);
    return i + next_field(&line, mark, &field);
}

/* ---- Columns without names ---------------------------------------------------------------------------------- */

/* By the first line of numbers: three more columns may be r g b, four intensity r g b. */
static bool guess_columns(cloud_file *file, cloud_span rest, char mark, text_columns *columns)
{
    static const signed char channels[] = {CLOUD_INTENSITY, CLOUD_RED, CLOUD_GREEN, CLOUD_BLUE};
    const unsigned color = 1U << CLOUD_RED | 1U << CLOUD_GREEN | 1U << CLOUD_BLUE;
    cloud_span field;
    size_t count = 0;
    while (next_field(&rest, mark, &field))
        count++;
    columns->unnamed = count > 0;
    if (count != 3 && count != 4)
        return true;
    for (size_t i = 4 - count; i < 4; i++)
        if (!add_column(columns, channels[i]))
            return cloud_fail(file, "out of memory");
    columns->guessed = true;
    for (int range = 0; range < 2; range++) {
        columns->ranges[range] = true;
        columns->shifted[range] = count == 4;
    }
    cloud_begin_values(file, color | (count == 4 ? 1U << CLOUD_INTENSITY : 0), 1);
    return true;
}

/* The ranges that channels may have: bytes, and fractions. */
enum { BYTES, FRACTIONS };

static bool is_in_range(double number, int range)
{
    return range == BYTES ? number >= 0 && number <= 255 && number == floor(number) : number >= 0 && number <= 1;
}

static void forget(cloud_file *file, text_columns *columns)
{
    cloud_drop_values(file);
    memset(file->out->beyond, 0, sizeof file->out->beyond);
    columns->count = 0;
    columns->guessed = false;
}

/* Each line must bear it out. */
static void check_guess(cloud_file *file, text_columns *columns, size_t count, const double *numbers)
{
    bool fits = false;
    double square = 0;
    for (int range = 0; range < 2; range++) {
        for (int i = 0; i < 3; i++)
            columns->ranges[range] = columns->ranges[range] && is_in_range(numbers[CLOUD_RED + i], range);
        columns->shifted[range] = columns->shifted[range] && is_in_range(numbers[CLOUD_INTENSITY], range);
        fits = fits || columns->ranges[range];
    }
    for (int i = 0; i < 3; i++) {
        square += numbers[CLOUD_RED + i] * numbers[CLOUD_RED + i];
        columns->brightest = fmax(columns->brightest, numbers[CLOUD_RED + i]);
    }
    columns->no_normals |= fabs(square - 1) > 0.01;
    if (!fits || count != columns->count || (count == 4 && isnan(numbers[CLOUD_INTENSITY])))
        forget(file, columns);
}

/* What was decided is said. */
static void end_guess(cloud_file *file, text_columns *columns)
{
    const int range = columns->ranges[BYTES] ? BYTES : FRACTIONS;
    const bool bright = range == BYTES ? columns->brightest >= 128 : columns->brightest >= 0.5 && columns->no_normals;
    const bool four = columns->count == 4, read = columns->guessed && bright && !columns->shifted[range];
    if (read && range == BYTES)
        file->out->decided = four ? "columns 4 to 7, which have no names, are read as intensity r g b"
                                  : "columns 4 to 6, which have no names, are read as r g b";
    else if (read)
        file->out->decided = four ? "columns 4 to 7, which have no names, are read as intensity r g b, from 0 to 1"
                                  : "columns 4 to 6, which have no names, are read as r g b, from 0 to 1";
    else if (columns->guessed && bright)
        file->out->decided = "columns 4 to 7 may be r g b and another or intensity r g b, and are not read: a first "
                             "line with their names, as in x y z intensity r g b, says what they are";
    else
        file->out->decided = "the columns from the fourth on have no names and are not read: a first line with the "
                             "names of all, as in x y z r g b, says what they are";
    if (!read)
        forget(file, columns);
}

/* ---- The file ----------------------------------------------------------------------------------------------- */

/* The lines, without the mark that some editors put before UTF-8. */
static cloud_lines lines_of(const cloud_file *file)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    cloud_lines lines = cloud_lines_of(file);
    if (file->size >= 3 && memcmp(lines.at, byte_order_mark, 3) == 0)
        lines.at += 3;
    return lines;
}

/* The number of points, which is the first line of a .pts file: digits, and nothing else. */
static bool is_count(cloud_span line, double *count)
{
    const char *end;
    cloud_span rest = line;
    while (rest.begin < rest.limit && '0' <= *rest.begin && *rest.begin <= '9')
        rest.begin++;
    const char *limit = rest.begin;
    rest.begin = skip_blanks(rest);
    return limit > line.begin && is_over(rest) && number_parse(line.begin, limit, &end, count);
}

bool cloud_text_begins(const cloud_file *file)
{
    cloud_lines lines = lines_of(file);
    cloud_span line;
    double position[3], count;
    char mark = ' ';
    for (bool first = true; cloud_next_line(&lines, &line);) {
        line.begin = skip_blanks(line);
        if (is_over(line))
            continue;
        if (!first || (!is_header(line) && !is_count(line, &count)))
            return parse_position(file, lines.number, &line, &mark, position);
        first = false;
    }
    return false;
}

/* Of a point that is skipped the other columns say nothing. */
static bool parse_point(cloud_file *file, size_t number, cloud_span line, bool named, text_columns *columns)
{
    double numbers[CLOUD_CHANNELS];
    char mark = ' ';
    if (!parse_position(file, number, &line, &mark, numbers))
        return false;
    if (cloud_skips(file, numbers))
        return true;
    if (file->out->count == 0 && !named && !guess_columns(file, line, mark, columns))
        return false;
    if (columns->count > 0) {
        const size_t count = parse_values(line, mark, columns, numbers);
        if (columns->guessed)
            check_guess(file, columns, count, numbers);
    }
    return cloud_add(file, numbers);
}

/* The names of columns in a comment, as CloudCompare writes them. */
static bool is_named_comment(cloud_span *line)
{
    cloud_span rest = *line, column;
    while (rest.begin < rest.limit && (*rest.begin == '#' || *rest.begin == '/' || cloud_is_blank(*rest.begin)))
        rest.begin++;
    const cloud_span names = rest;
    for (int i = 0; i < 3; i++)
        if (!next_column(&rest, &column) || channel_of(strip_quotes(column)) != i)
            return false;
    *line = names;
    return is_header(names);
}

/* A line of names or a count of points comes before the first point; a comment that names columns may come before it.
 * Points beyond the count are read as well. */
static bool parse_lines(cloud_file *file, text_columns *columns)
{
    cloud_lines lines = lines_of(file);
    cloud_span line;
    bool first = true, named = false, has_header = false;
    double count = 0, points = 0;
    size_t counted = 0; /* the line of the count */
    while (cloud_next_line(&lines, &line)) {
        cloud_tell(file, lines.number, (uint64_t)(lines.at - (const char *)file->bytes), file->size);
        line.begin = skip_blanks(line);
        const bool comment = is_over(line);
        if (comment && !(first && !named && is_named_comment(&line)))
            continue;
        if (first && !has_header && (comment || is_header(line))) {
            named = true;
            has_header = !comment;
            columns->count = 0;
            if (!read_header(file, lines.number, line, columns))
                return false;
        } else if (first && !has_header && !counted && is_count(line, &count)) {
            counted = lines.number;
        } else {
            if (!parse_point(file, lines.number, line, named, columns))
                return false;
            first = false;
            points++;
        }
    }
    return points >= count ||
           cloud_fail_line(file, counted, "counts %.0f points, and there are %.0f: the file is cut short", count,
                           points);
}

static bool parse_text(cloud_file *file)
{
    text_columns columns = {0};
    const bool done = cloud_check_text(file) && parse_lines(file, &columns);
    if (done && columns.unnamed)
        end_guess(file, &columns);
    free(columns.channels);
    return done;
}

const cloud_format cloud_text = {"x y z text", NULL, NULL, parse_text};
