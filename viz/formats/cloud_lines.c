/* cloud_lines.c - the lines and words of a text file, and of the headers of binary ones. */
#include "cloud_format.h"
#include "number.h"

#include <math.h>
#include <string.h>

/* Lines that end in \r alone have no other end: in binary data a \n may follow the header's last one. */
static char find_terminator(const char *at, const char *limit)
{
    while (at < limit && *at != '\n' && *at != '\r')
        at++;
    bool alone = at < limit && *at == '\r' && !(at + 1 < limit && at[1] == '\n');
    return alone ? '\r' : '\n';
}

cloud_lines cloud_lines_of(const cloud_file *file)
{
    const char *begin = (const char *)file->bytes;
    const char *limit = begin + file->size;
    return (cloud_lines){begin, limit, find_terminator(begin, limit), 0};
}

bool cloud_next_line(cloud_lines *lines, cloud_span *line)
{
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

bool cloud_next_filled_line(cloud_lines *lines, cloud_span *line)
{
    while (cloud_next_line(lines, line)) {
        cloud_span rest = *line, word;
        if (cloud_next_word(&rest, &word))
            return true;
    }
    return false;
}

bool cloud_is_blank(char c)
{
    return c == ' ' || c == '\t';
}

bool cloud_next_word(cloud_span *line, cloud_span *word)
{
    while (line->begin < line->limit && cloud_is_blank(*line->begin))
        line->begin++;
    word->begin = line->begin;
    while (line->begin < line->limit && !cloud_is_blank(*line->begin))
        line->begin++;
    word->limit = line->begin;
    return word->begin < word->limit;
}

bool cloud_word_is(cloud_span word, const char *text)
{
    size_t length = (size_t)(word.limit - word.begin);
    return length == strlen(text) && memcmp(word.begin, text, length) == 0;
}

int cloud_word_axis(cloud_span word)
{
    bool single = word.limit - word.begin == 1;
    return single && *word.begin >= 'x' && *word.begin <= 'z' ? *word.begin - 'x' : -1;
}

bool cloud_word_count(cloud_span word, uint64_t *count)
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

bool cloud_word_coordinate(const cloud_file *file, size_t line, cloud_span word, double *coordinate)
{
    char quote[CLOUD_QUOTE];
    const char *end;
    bool finite = number_parse(word.begin, word.limit, &end, coordinate);
    if (end == word.limit && finite)
        return true;
    if (end == word.limit)
        return cloud_fail_line(file, line, "%s is beyond the largest double", cloud_quote(word, quote));
    if (!number_parse_nonfinite(word.begin, word.limit, &end) || end != word.limit)
        return cloud_fail_line(file, line, "%s is not a number", cloud_quote(word, quote));
    *coordinate = NAN;
    return true;
}

const char *cloud_quote(cloud_span word, char text[CLOUD_QUOTE])
{
    static const char digits[] = "0123456789abcdef";
    static const char ending[] = "...'";
    size_t length = 0;
    text[length++] = '\'';
    for (const char *at = word.begin; at < word.limit; at++) {
        unsigned char c = (unsigned char)*at;
        if (length + 4 + sizeof ending > CLOUD_QUOTE) {
            memcpy(text + length, ending, sizeof ending);
            return text;
        }
        if (c >= ' ' && c <= '~') {
            text[length++] = (char)c;
            continue;
        }
        text[length++] = '\\';
        text[length++] = 'x';
        text[length++] = digits[c >> 4];
        text[length++] = digits[c & 15];
    }
    text[length++] = '\'';
    text[length] = '\0';
    return text;
}

bool cloud_check_text(const cloud_file *file)
{
    const char *nul = memchr(file->bytes, '\0', file->size);
    cloud_lines lines = cloud_lines_of(file);
    cloud_span line;
    if (!nul)
        return true;
    while (lines.at <= nul)
        cloud_next_line(&lines, &line);
    return cloud_fail_line(file, lines.number, "holds a NUL byte, so it is no text; known are x y z text, PLY and PCD");
}

bool cloud_check_no_lines(const cloud_file *file, cloud_lines *lines)
{
    cloud_span line;
    if (cloud_next_filled_line(lines, &line))
        return cloud_fail_line(file, lines->number, "more lines follow than the header counts");
    return true;
}
