/* cloud.c - point-cloud files: opening, telling the formats apart, and the growing array of points. */
#include "cloud_format.h"
#include "file.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- Result and errors -------------------------------------------------------------------------------------- */

/* The array grows to powers of two, so that it is full exactly when its count is one. */
static bool grow(cloud *points)
{
    size_t capacity = points->count > 0 ? 2 * points->count : 1;
    if (capacity > SIZE_MAX / sizeof *points->positions)
        return false;
    void *grown = realloc(points->positions, capacity * sizeof *points->positions);
    if (!grown)
        return false;
    points->positions = grown;
    return true;
}

bool cloud_add(cloud_file *file, const double position[3])
{
    cloud *points = file->out;
    if (!isfinite(position[0]) || !isfinite(position[1]) || !isfinite(position[2])) {
        points->skipped++;
        return true;
    }
    bool full = (points->count & (points->count - 1)) == 0;
    if (full && !grow(points))
        return cloud_fail(file, "out of memory after %zu points", points->count);
    memcpy(points->positions[points->count++], position, sizeof *points->positions);
    return true;
}

void cloud_tell(const cloud_file *file, uint64_t times, uint64_t done, uint64_t total)
{
    if (file->watch && times % 65536 == 0)
        file->watch->step((double)done / (double)total, file->watch->context);
}

static void write_error(const cloud_file *file, const char *place, const char *format, va_list arguments)
{
    enum { LONGEST_NAME = 192 };
    char reason[256];
    size_t length = strlen(file->name);
    const char *name = length > LONGEST_NAME ? file->name + (length - LONGEST_NAME) : file->name;
    vsnprintf(reason, sizeof reason, format, arguments);
    snprintf(file->error->text, sizeof file->error->text, "%s:%s %s", name, place, reason);
}

bool cloud_fail(const cloud_file *file, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_error(file, "", format, arguments);
    va_end(arguments);
    return false;
}

bool cloud_fail_line(const cloud_file *file, size_t line, const char *format, ...)
{
    char place[32];
    va_list arguments;
    snprintf(place, sizeof place, "%zu:", line);
    va_start(arguments, format);
    write_error(file, place, format, arguments);
    va_end(arguments);
    return false;
}

bool cloud_fail_byte(const cloud_file *file, size_t offset, const char *format, ...)
{
    char place[32];
    va_list arguments;
    snprintf(place, sizeof place, "byte %zu:", offset);
    va_start(arguments, format);
    write_error(file, place, format, arguments);
    va_end(arguments);
    return false;
}

/* ---- Formats ------------------------------------------------------------------------------------------------ */

typedef bool (*cloud_parser)(cloud_file *file);

typedef struct cloud_format {
    const char *ending;
    bool (*recognise)(const cloud_file *file);
    cloud_parser parse;
} cloud_format;

static const cloud_format formats[] = {
    {".ply", cloud_is_ply, cloud_parse_ply},
    {".pcd", cloud_is_pcd, cloud_parse_pcd},
};

static bool has_ending(const char *name, const char *ending)
{
    size_t length = strlen(name), tail = strlen(ending);
    return length >= tail && strcasecmp(name + (length - tail), ending) == 0;
}

static cloud_parser choose_parser(const cloud_file *file)
{
    size_t count = sizeof formats / sizeof *formats;
    for (size_t i = 0; i < count; i++)
        if (formats[i].recognise(file))
            return formats[i].parse;
    for (size_t i = 0; i < count; i++)
        if (has_ending(file->name, formats[i].ending))
            return formats[i].parse;
    return cloud_parse_text;
}

static bool parse_filled(cloud_file *file)
{
    if (file->size > 0 && !choose_parser(file)(file))
        return false;
    if (file->out->count > 0)
        return true;
    if (file->out->skipped > 0)
        return cloud_fail(file, "holds no points: all %zu have a NaN or an infinity", file->out->skipped);
    return cloud_fail(file, "holds no points");
}

static bool parse(cloud_file *file)
{
    *file->out = (cloud){0};
    bool parsed = parse_filled(file);
    if (!parsed)
        cloud_release(file->out);
    return parsed;
}

bool cloud_parse(const char *name, const unsigned char *bytes, size_t size, cloud *out, octreel_error *error)
{
    return parse(&(cloud_file){name, bytes, size, out, error, NULL});
}

void cloud_release(cloud *cloud)
{
    free(cloud->positions);
    memset(cloud, 0, sizeof *cloud);
}

bool cloud_read(const char *path, const cloud_watch *watch, cloud *out, octreel_error *error)
{
    char *bytes, reason[FILE_REASON];
    size_t size;
    *out = (cloud){0};
    if (!file_read_whole(path, &bytes, &size, reason)) {
        cloud_file file = {path, NULL, 0, out, error, NULL};
        return cloud_fail(&file, "%s", reason);
    }
    const bool done = parse(&(cloud_file){path, (const unsigned char *)bytes, size, out, error, watch});
    free(bytes);
    return done;
}
