/* SPDX-License-Identifier: MIT */
/* cloud_text.c - reads points from text: one point on each line, with the coordinates in the first three columns.
 *
 * Text files have no specification. The reader refuses files that could silently be read as other points: column names
 * that do not begin with x, y, z; decimal commas; mixed separators; and a first line that announces more points than
 * follow.
 *
 * The names of the columns after the third say what these columns mean. Without names, the ending of the file's name
 * may declare the meaning (choose_column_meaning()). Otherwise the meaning is guessed: three further columns are a
 * colour, four are an intensity and a colour. Every line must confirm the guess (accept_or_discard_guessed_columns()
 * gives the rules); otherwise the columns are ignored. cloud.column_note reports guessed and ignored columns to the
 * user. */
#include "cloud_format.h"
#include "file.h"
#include "number.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The two ranges that colour channels can have, as bits: integers from 0 to 255, and fractions from 0 to 1. */
enum { BYTES = 1, FRACTIONS = 2 };

/* The columns of a file after the coordinates, and the state of guessing what they mean. */
typedef struct text_columns {
    struct {
        size_t column; /* the index of the column; index 0 is the fourth column of the file */
        cloud_channel channel;
    } places[CLOUD_CHANNELS]; /* the columns that have a channel, in ascending order of their indices */
    size_t place_count;
    bool counted; /* true: a line with the number of points was read */
    bool unnamed; /* true: the file has more than three columns but no column names */
    /* true: the channels are guessed; then the members below are about the lines that were read so far */
    bool guessed;
    int ranges;  /* the ranges that contain all colour channels of all lines */
    int shifted; /* the ranges that contain the column before the colour in all lines; if the colour has such a range
                  * too, the colour might begin one column earlier */
    /* true: at least one colour, taken as a vector, does not have length 1, so the columns are not normals */
    bool no_normals;
    double brightest; /* the largest value of all colour channels */
} text_columns;

static const char *skip_blanks(cloud_span line)
{
    while (line.begin < line.limit && cloud_is_blank(*line.begin))
        line.begin++;
    return line.begin;
}

/* Returns whether the rest of a line is empty or a comment. */
static bool has_only_comment(cloud_span line)
{
    size_t left = (size_t)(line.limit - line.begin);
    return left == 0 || *line.begin == '#' || (left > 1 && line.begin[0] == '/' && line.begin[1] == '/');
}

static bool is_separator(char c)
{
    return c == ',' || c == ';';
}

/* Removes the first column from a line of column names and stores it in *column. A column ends at a blank, a comma or a
 * semicolon. Returns false if the line has no column left. */
static bool read_next_column_name(cloud_span *line, cloud_span *column)
{
    while (line->begin < line->limit && (cloud_is_blank(*line->begin) || is_separator(*line->begin)))
        line->begin++;
    column->begin = line->begin;
    while (line->begin < line->limit && !cloud_is_blank(*line->begin) && !is_separator(*line->begin))
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

/* Returns whether a column is a name, that is, does not begin like a number. */
static bool is_column_name(cloud_span column)
{
    const char *end;
    bool number_like = column.begin == column.limit || strchr("+-.0123456789", *column.begin);
    return !number_like && !number_parse_nonfinite(column.begin, column.limit, &end);
}

/* Returns whether a line consists of at least three column names. */
static bool is_column_header(cloud_span line)
{
    cloud_span column;
    size_t count = 0;
    for (; read_next_column_name(&line, &column); count++)
        if (!is_column_name(strip_quotes(column)))
            return false;
    return count >= 3;
}

static int find_channel(cloud_span name)
{
    const char lower = (char)(name.limit - name.begin == 1 ? *name.begin | ('a' ^ 'A') : 0);
    return cloud_find_channel(lower ? (cloud_span){&lower, &lower + 1} : name);
}

static void add_column(text_columns *columns, size_t column, cloud_channel channel)
{
    columns->places[columns->place_count].column = column;
    columns->places[columns->place_count++].channel = channel;
}

/* Reads the line of column names. The first three columns must be x, y and z, so names such as "id,x,y,z" are
 * refused. A unit, as in "x [m], y [m]", is part of the name before it. `full` is the assumed full scale of colours
 * for cloud_select_channels(). */
static bool read_column_names(cloud_file *file, cloud_span line, unsigned full, text_columns *columns)
{
    cloud_span column;
    *columns = (text_columns){0};
    file->channels = 0;
    *file->out->column_note = 0;
    for (int index = 0; read_next_column_name(&line, &column);) {
        if (*column.begin == '[' || *column.begin == '(')
            continue;
        int channel = find_channel(strip_quotes(column));
        if (channel >= CLOUD_X && channel <= CLOUD_Z && channel != index)
            return cloud_fail_line(file, "names column %d %c; the first three columns must be x y z", index + 1,
                                   "xyz"[channel]);
        if (index >= 3 && cloud_add_channel(file, channel, strip_quotes(column)))
            add_column(columns, (size_t)index - 3, (cloud_channel)channel);
        index++;
    }
    cloud_select_channels(file, full);
    return true;
}

static cloud_span strip_comment(cloud_span line)
{
    cloud_span rest = line;
    while (!has_only_comment(rest))
        rest.begin++;
    return (cloud_span){line.begin, rest.begin};
}

/* Removes the first column from a line and stores it in *field. The line has no comment. A column ends at
 * `separator`; the separator ' ' stands for any blank. Returns false if the line has no column left. */
static bool read_next_column(cloud_span *line, char separator, cloud_span *field)
{
    field->begin = line->begin = skip_blanks(*line);
    while (line->begin < line->limit && (separator == ' ' ? !cloud_is_blank(*line->begin) : *line->begin != separator))
        line->begin++;
    field->limit = line->begin;
    const bool found = field->begin < line->limit;
    line->begin += line->begin < line->limit;
    while (field->limit > field->begin && cloud_is_blank(field->limit[-1]))
        field->limit--;
    return found;
}

/* Returns the separator of a line: the comma or semicolon after the first column, or ' ' if there is none. */
static char find_separator(cloud_span line)
{
    while (line.begin < line.limit && !cloud_is_blank(*line.begin) && !is_separator(*line.begin))
        line.begin++;
    line.begin = skip_blanks(line);
    return line.begin < line.limit && is_separator(*line.begin) ? *line.begin : ' ';
}

/* Parses the coordinates of a point. Removes the coordinates, and a comment, from the line. All separators of the
 * line must be the same. Otherwise decimal commas, as in "1,5;2,5;3,5" or "1,5 2,5 3,5", would be read as other
 * points. */
static bool parse_position(const cloud_file *file, cloud_span *line, char *separator, double position[3])
{
    static const char mixed[] = "mixes blanks, commas and semicolons between its columns; use only one of them";
    cloud_span field;
    *line = strip_comment(*line);
    *separator = find_separator(*line);
    for (int axis = 0; axis < 3; axis++) {
        if (!read_next_column(line, *separator, &field))
            return cloud_fail_line(file, "has only %d of the three coordinates x y z", axis);
        if (field.begin == field.limit)
            return cloud_fail_line(file, "column %d is empty", axis + 1);
        if (cloud_parse_coordinate(file, field, &position[axis]))
            continue;
        for (const char *at = field.begin; at < field.limit; at++)
            if (cloud_is_blank(*at) || is_separator(*at))
                return cloud_fail_line(file, "%s", mixed);
        return false;
    }
    line->begin = skip_blanks(*line);
    return *separator != ' ' || line->begin == line->limit || !is_separator(*line->begin) ||
           cloud_fail_line(file, "%s", mixed);
}

/* Returns the number in a field, or NaN if the field is not a number. */
static double parse_field(cloud_span field)
{
    double number = NAN;
    const char *end;
    field = strip_quotes(field);
    return number_parse(field.begin, field.limit, &end, &number) && end == field.limit ? number : NAN;
}

/* Parses the columns after the coordinates, up to the last column that has a channel. A missing column becomes NaN.
 * Returns the number of parsed columns. If further columns follow, returns one more. */
static size_t parse_values(cloud_span line, char separator, const text_columns *columns, double numbers[CLOUD_CHANNELS])
{
    cloud_span field;
    size_t i = 0, next = 0;
    for (int channel = CLOUD_Z + 1; channel < CLOUD_CHANNELS; channel++)
        numbers[channel] = NAN;
    for (; next < columns->place_count && read_next_column(&line, separator, &field); i++)
        if (columns->places[next].column == i)
            numbers[columns->places[next++].channel] = parse_field(field);
    return i + read_next_column(&line, separator, &field);
}

/* ---- Columns without names ---------------------------------------------------------------------------------- */

/* Chooses the meaning of the unnamed columns after the coordinates, by the ending of the file's name and the number of
 * columns. `rest` is the first line of numbers, without the coordinates. columns->guessed becomes true if the ending
 * does not declare the meaning. */
static void choose_column_meaning(cloud_file *file, cloud_span rest, char separator, text_columns *columns)
{
    static const struct {
        /* the ending of the file's name for which this row holds; null: any ending, and the meaning is guessed */
        const char *ending;
        /* true: the row holds only after a line with the number of points; then colours are integers from 0 to 255 */
        bool counted;
        size_t count;
        const char *names;
    } rows[] = {
        {".xyzrgb", false, 3, "x y z r g b"},       {".xyzn", false, 3, "x y z nx ny nz"},
        {".pts", true, 1, "x y z intensity"},       {".pts", true, 3, "x y z r g b"},
        {".pts", true, 4, "x y z intensity r g b"}, {NULL, false, 3, "x y z r g b"},
        {NULL, false, 4, "x y z intensity r g b"},
    };
    const bool counted = columns->counted;
    cloud_span field;
    size_t count = 0;
    while (read_next_column(&rest, separator, &field))
        count++;
    columns->unnamed = count > 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *ending = rows[i].ending, *names = rows[i].names;
        if (rows[i].count != count || (rows[i].counted && !counted) || (ending && !file_has_ending(file->name, ending)))
            continue;
        read_column_names(file, (cloud_span){names, names + strlen(names)}, rows[i].counted ? 255 : 1, columns);
        columns->unnamed = columns->guessed = !ending;
        columns->ranges = BYTES | FRACTIONS;
        columns->shifted = count == 4 ? BYTES | FRACTIONS : 0;
        return;
    }
}

static int find_ranges_containing(double number)
{
    return (number >= 0 && number <= 255 && number == floor(number) ? BYTES : 0) |
           (number >= 0 && number <= 1 ? FRACTIONS : 0);
}

static void discard_guessed_columns(cloud_file *file, text_columns *columns)
{
    cloud_discard_values(file);
    memset(file->out->out_of_range, 0, sizeof file->out->out_of_range);
    columns->place_count = 0;
    columns->guessed = false;
}

/* Compares the guessed meaning of the columns with the numbers of a line. If the numbers contradict the guess,
 * discards the guess. */
static void check_guessed_columns(cloud_file *file, text_columns *columns, size_t count, const double *numbers)
{
    double square = 0;
    columns->shifted &= find_ranges_containing(numbers[CLOUD_INTENSITY]);
    for (int i = 0; i < 3; i++) {
        columns->ranges &= find_ranges_containing(numbers[CLOUD_RED + i]);
        square += numbers[CLOUD_RED + i] * numbers[CLOUD_RED + i];
        columns->brightest = fmax(columns->brightest, numbers[CLOUD_RED + i]);
    }
    columns->no_normals |= fabs(square - 1) > 0.01;
    if (!columns->ranges || count != columns->place_count || (count == 4 && isnan(numbers[CLOUD_INTENSITY])))
        discard_guessed_columns(file, columns);
}

/* Decides after the last line whether the guessed columns are colours. At least one channel must be bright. If the
 * channels are fractions, at least one colour must not have length 1, because normals have length 1. If there are
 * four columns, the first must have a number outside the range of colour channels; otherwise the first three columns
 * could be the colour. */
static void accept_or_discard_guessed_columns(cloud_file *file, text_columns *columns)
{
    const int range = columns->ranges & BYTES ? BYTES : FRACTIONS;
    const bool bright = range == BYTES ? columns->brightest >= 128 : columns->brightest >= 0.5 && columns->no_normals;
    const bool four = columns->place_count == 4, read = columns->guessed && bright && !(columns->shifted & range);
    char *note = file->out->column_note;
    const size_t size = sizeof file->out->column_note;
    if (read)
        snprintf(note, size, "columns 4 to %d have no names and are read as %sr g b%s", four ? 7 : 6,
                 four ? "intensity " : "", range == BYTES ? "" : ", from 0 to 1");
    else if (columns->guessed && bright)
        snprintf(note, size,
                 "columns 4 to 7 have no names and are ignored: they may be r g b and another value, or intensity "
                 "r g b; add a first line with names, such as x y z intensity r g b");
    else
        snprintf(note, size,
                 "the columns from the fourth on have no names and are ignored; add a first line with the names of all "
                 "columns, such as x y z r g b");
    if (!read)
        discard_guessed_columns(file, columns);
}

/* ---- Whole file --------------------------------------------------------------------------------------------- */

/* Begins reading lines. Skips the byte order mark that some editors write before UTF-8 text. */
static void begin_reading_lines(cloud_file *file)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    cloud_rewind_lines(file);
    if (file->size >= 3 && memcmp(file->bytes, byte_order_mark, 3) == 0)
        file->lines.at += 3;
}

/* Returns whether a line is a single integer. The first line of a .pts file is such an integer: the number of
 * points. */
static bool is_point_count(cloud_span line, uint64_t *count)
{
    cloud_span field;
    uint64_t number;
    line = strip_comment(line);
    if (!read_next_column(&line, ' ', &field) || !cloud_parse_count(field, &number) || skip_blanks(line) < line.limit)
        return false;
    *count = number;
    return true;
}

bool cloud_text_is_recognised(cloud_file *file)
{
    cloud_span line;
    uint64_t count;
    double position[3];
    char separator;
    begin_reading_lines(file);
    for (bool first = true; cloud_read_next_line(file, &line);) {
        line.begin = skip_blanks(line);
        if (has_only_comment(line))
            continue;
        if (!first || (!is_column_header(line) && !is_point_count(line, &count)))
            return parse_position(file, &line, &separator, position);
        first = false;
    }
    return false;
}

/* Reads a line that contains a point. If the point is skipped, its values are not read and do not affect the guess
 * of the columns. */
static bool parse_point(cloud_file *file, cloud_span line, bool named, text_columns *columns)
{
    double numbers[CLOUD_CHANNELS];
    char separator;
    if (!parse_position(file, &line, &separator, numbers))
        return false;
    if (cloud_skip_nonfinite(file, numbers))
        return true;
    if (file->out->count == 0 && !named)
        choose_column_meaning(file, line, separator, columns);
    if (columns->place_count > 0) {
        const size_t count = parse_values(line, separator, columns, numbers);
        if (columns->guessed)
            check_guessed_columns(file, columns, count, numbers);
    }
    return cloud_add_point(file, numbers);
}

/* CloudCompare writes the column names in a comment. Returns whether a comment contains column names. If so, sets
 * *line to the names. */
static bool is_comment_with_column_names(cloud_span *line)
{
    cloud_span rest = *line, column;
    while (rest.begin < rest.limit && (*rest.begin == '#' || *rest.begin == '/' || cloud_is_blank(*rest.begin)))
        rest.begin++;
    const cloud_span names = rest;
    for (int i = 0; i < 3; i++)
        if (!read_next_column_name(&rest, &column) || find_channel(strip_quotes(column)) != i)
            return false;
    *line = names;
    return is_column_header(names);
}

/* Reads all lines. Before the first point there may be a comment with column names, then a line with either column
 * names or the number of points. If more points follow than this number, all of them are read. If fewer points
 * follow, this is an error. */
static bool parse_lines(cloud_file *file, text_columns *columns)
{
    cloud_span line;
    bool named = false, has_header = false;
    uint64_t count = 0, points = 0;
    size_t count_line = 0; /* the line number of the line that holds the number of points; 0: no such line */
    begin_reading_lines(file);
    while (cloud_read_next_line(file, &line)) {
        cloud_report_progress(file, file->lines.number, (uint64_t)(file->lines.at - (const char *)file->bytes),
                              file->size);
        line.begin = skip_blanks(line);
        const bool comment = has_only_comment(line), first = points == 0;
        if (comment && !(first && !named && is_comment_with_column_names(&line)))
            continue;
        if (first && !has_header && (comment || is_column_header(line))) {
            named = true;
            has_header = !comment;
            if (!read_column_names(file, line, 1, columns))
                return false;
        } else if (first && !has_header && !count_line && is_point_count(line, &count)) {
            count_line = file->lines.number;
            columns->counted = true;
        } else {
            if (!parse_point(file, line, named, columns))
                return false;
            points++;
        }
    }
    file->lines.number = count_line;
    return points >= count ||
           cloud_fail_line(file, "says that %" PRIu64 " points follow, but %" PRIu64 " do: the file is truncated",
                           count, points);
}

static bool parse_text(cloud_file *file)
{
    text_columns columns = {0};
    const bool done = cloud_check_text(file) && parse_lines(file, &columns);
    if (done && columns.unnamed)
        accept_or_discard_guessed_columns(file, &columns);
    return done;
}

const cloud_format cloud_text = {NULL, parse_text};
