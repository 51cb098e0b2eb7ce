/* SPDX-License-Identifier: MIT */
/* cloud_values.c - finds the colours, intensities and classes of a cloud by the names of its columns or fields, and
 * converts the numbers in the file to these values. */
#include "cloud_format.h"
#include "number.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* ---- Names -------------------------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    cloud_channel channel;
} names[] = {
    {"red", CLOUD_RED},           {"green", CLOUD_GREEN},
    {"blue", CLOUD_BLUE},         {"r", CLOUD_RED},
    {"g", CLOUD_GREEN},           {"b", CLOUD_BLUE},
    {"diffuse_red", CLOUD_RED},   {"diffuse_green", CLOUD_GREEN},
    {"diffuse_blue", CLOUD_BLUE}, {"rgb", CLOUD_PACKED},
    {"rgba", CLOUD_PACKED},       {"intensity", CLOUD_INTENSITY},
    {"class", CLOUD_CLASS},       {"classification", CLOUD_CLASS},
    {"label", CLOUD_CLASS},
};

int cloud_find_channel(cloud_span word)
{
    static const char before[] = "scalar_";
    size_t length = (size_t)(word.limit - word.begin);
    if (length == 1 && *word.begin >= 'x' && *word.begin <= 'z')
        return *word.begin - 'x';
    if (length >= sizeof before && strncasecmp(word.begin, before, sizeof before - 1) == 0) {
        word.begin += sizeof before - 1;
        length -= sizeof before - 1;
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strlen(names[i].name) == length && strncasecmp(word.begin, names[i].name, length) == 0)
            return (int)names[i].channel;
    return -1;
}

bool cloud_parse_channel(const cloud_file *file, cloud_span word, int channel, double *number)
{
    uint64_t whole;
    uint32_t bits;
    if (channel == CLOUD_PACKED && cloud_parse_count(word, &whole)) {
        *number = (double)whole;
        return true;
    }
    if (!cloud_parse_coordinate(file, word, number))
        return false;
    if (channel == CLOUD_PACKED && fabs(*number) <= FLT_MAX) {
        const float narrow = (float)*number;
        memcpy(&bits, &narrow, sizeof bits);
        *number = bits;
    }
    return true;
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

enum { UNIT = 1, BYTE = 255, WORD = 65535 };

/* Adds a value's name to the note on ignored values. The name "_" is not added: it marks padding in PCD files. */
static void add_ignored_value_to_note(const cloud_file *file, cloud_span word)
{
    char quote[CLOUD_QUOTE], *note = file->out->column_note;
    const size_t length = strlen(note), left = sizeof file->out->column_note - length;
    if (cloud_word_equals(word, "_"))
        return;
    if (left > CLOUD_QUOTE + sizeof ", , ...")
        snprintf(note + length, left, "%s%s",
                 length ? ", " : "these values are ignored: ", cloud_quote_word(word, quote));
    else if (note[length - 1] != '.')
        snprintf(note + length, left, ", ...");
}

bool cloud_add_channel(cloud_file *file, int channel, cloud_span name)
{
    const unsigned bit = channel < 0 ? 0 : 1U << channel;
    const bool added = bit & ~file->channels;
    file->channels |= bit;
    if (added)
        file->channel_names[channel] = name;
    else
        add_ignored_value_to_note(file, name);
    return added;
}

void cloud_select_channels(cloud_file *file, unsigned full)
{
    const unsigned three = file->channels & CLOUD_COLOR;
    const unsigned ignored = three == CLOUD_COLOR ? file->channels & 1U << CLOUD_PACKED : three;
    file->channels &= ~(ignored | 1U << CLOUD_X | 1U << CLOUD_Y | 1U << CLOUD_Z);
    file->out->color_full = three == CLOUD_COLOR ? full : BYTE;
    for (int i = 0; i < CLOUD_CHANNELS; i++)
        if (ignored >> i & 1)
            add_ignored_value_to_note(file, file->channel_names[i]);
}

void cloud_discard_values(cloud_file *file)
{
    file->channels = 0;
    point_values_release(&file->out->values);
}

/* Raises the full scale of colours after a channel exceeded the old scale. All earlier channels were within the old
 * scale, so their 8-bit values can be rescaled. From 1 to 255: an earlier channel was at most 1, and becomes 0 or 1 of
 * 255. From 255 to 65535: an earlier channel was at most 255, which is less than one 8-bit step of the new scale, and
 * becomes 0. */
static void raise_full_scale(cloud *points)
{
    const bool unit = points->color_full == UNIT;
    for (size_t i = 0; i < points->values.count; i++)
        for (int j = 0; j < 3; j++) {
            unsigned char *channel = &points->values.rows[i].color[j];
            *channel = unit && *channel > BYTE / 2;
        }
    points->color_full = unit ? BYTE : WORD;
}

static unsigned char convert_to_byte(double number, unsigned full)
{
    if (full == WORD)
        return (unsigned char)((unsigned)number >> 8);
    return (unsigned char)(number * (full == UNIT ? BYTE : 1) + 0.5);
}

static bool convert_color(cloud *points, const double *channels, unsigned char color[3])
{
    for (int i = 0; i < 3; i++)
        if (!(channels[i] >= 0 && channels[i] <= WORD))
            return false;
    for (int i = 0; i < 3; i++)
        while (channels[i] > points->color_full)
            raise_full_scale(points);
    for (int i = 0; i < 3; i++)
        color[i] = convert_to_byte(channels[i], points->color_full);
    return true;
}

static bool unpack_color(double number, unsigned char color[3])
{
    if (!(number >= 0 && number <= UINT32_MAX))
        return false;
    const uint32_t packed = (uint32_t)number;
    for (int i = 0; i < 3; i++)
        color[i] = (unsigned char)(packed >> (16 - 8 * i));
    return true;
}

static bool has_channel(const cloud_file *file, cloud_channel channel)
{
    return file->channels >> channel & 1;
}

/* Records whether a point has a value of a kind, and returns `valid`. If the value is not valid, counts it as out of
 * range. NaN and infinity are not counted, because many files mark missing values with them. */
static bool set_value_presence(const cloud_file *file, point_value_kind kind, bool valid, const double *numbers,
                               size_t count, point_value *value)
{
    bool finite = !valid;
    for (size_t i = 0; finite && i < count; i++)
        finite = isfinite(numbers[i]);
    file->out->out_of_range[kind] += finite;
    file->out->values.kinds |= (unsigned)valid << kind;
    value->has[kind] = valid;
    return valid;
}

const char *cloud_describe_out_of_range(const size_t count[POINT_VALUE_KINDS], char text[CLOUD_OUT_OF_RANGE_TEXT])
{
    static const struct {
        const char *one, *many;
    } words[POINT_VALUE_KINDS] = {[POINT_COLOR] = {"colour beyond 0 to 65535", "colours beyond 0 to 65535"},
                                  [POINT_INTENSITY] = {"intensity beyond a float", "intensities beyond a float"},
                                  [POINT_CLASS] = {"class that is not an integer from 0 to 65535",
                                                   "classes that are not integers from 0 to 65535"}};
    size_t length = 0, sum = 0;
    *text = 0;
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++) {
        if (count[kind] == 0)
            continue;
        length += (size_t)snprintf(text + length, CLOUD_OUT_OF_RANGE_TEXT - length, "%s%zu %s", length ? ", " : "",
                                   count[kind], count[kind] == 1 ? words[kind].one : words[kind].many);
        sum += count[kind];
    }
    if (sum)
        snprintf(text + length, CLOUD_OUT_OF_RANGE_TEXT - length, " %s left out", sum == 1 ? "is" : "are");
    return text;
}

/* Returns whether a number is a class, that is, an integer from 0 to 65535. */
static bool is_class(double number)
{
    return number >= 0 && number <= UINT16_MAX && number == (uint16_t)number;
}

void cloud_convert_values(cloud_file *file, const double *numbers, point_value *value)
{
    const double *color = numbers + CLOUD_RED, *packed = numbers + CLOUD_PACKED;
    const double *intensity = numbers + CLOUD_INTENSITY, *class = numbers + CLOUD_CLASS;
    if (has_channel(file, CLOUD_RED))
        set_value_presence(file, POINT_COLOR, convert_color(file->out, color, value->color), color, 3, value);
    else if (has_channel(file, CLOUD_PACKED))
        set_value_presence(file, POINT_COLOR, unpack_color(*packed, value->color), packed, 1, value);
    if (has_channel(file, CLOUD_INTENSITY) &&
        set_value_presence(file, POINT_INTENSITY, fabs(*intensity) <= FLT_MAX, intensity, 1, value))
        value->intensity = (float)*intensity;
    if (has_channel(file, CLOUD_CLASS) && set_value_presence(file, POINT_CLASS, is_class(*class), class, 1, value))
        value->class = (uint16_t) * class;
}

void cloud_discard_zero_values(cloud_file *file)
{
    static const char *const words[] = {"", "colours", "intensities", "colours and intensities"};
    point_values *v = &file->out->values;
    unsigned zero = v->kinds & (1U << POINT_COLOR | 1U << POINT_INTENSITY);
    for (size_t i = 0; i < v->count; i++) {
        const point_value *row = &v->rows[i];
        if (row->color[0] || row->color[1] || row->color[2])
            zero &= ~(1U << POINT_COLOR);
        if (row->intensity != 0)
            zero &= ~(1U << POINT_INTENSITY);
    }
    v->kinds &= ~zero;
    for (size_t i = 0; zero && i < v->count; i++)
        for (int kind = 0; kind < POINT_VALUE_KINDS; kind++)
            v->rows[i].has[kind] &= !(zero >> kind & 1);
    if (zero)
        snprintf(file->out->column_note, sizeof file->out->column_note,
                 "%s are zero in every point and are treated as missing", words[zero]);
}

void cloud_discard_absent_values(cloud_file *file)
{
    point_values *v = &file->out->values;
    if (v->kinds == 0)
        cloud_discard_values(file);
    if (!(v->kinds >> POINT_COLOR & 1))
        file->out->color_full = 0;
}
