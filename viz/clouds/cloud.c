/* SPDX-License-Identifier: MIT */
/* cloud.c - loads a point-cloud file, chooses its format, and calls the reader of that format. */
#include "cloud_format.h"
#include "file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Formats ------------------------------------------------------------------------------------------------ */

static const struct {
    const cloud_format *format;
    const char *endings;
} rows[] = {
#define CLOUD_FORMAT_ROW(id, names, endings) {&cloud_##id, endings},
    CLOUD_FORMAT_MAP(CLOUD_FORMAT_ROW)
#undef CLOUD_FORMAT_ROW
};

enum { FORMATS = sizeof rows / sizeof rows[0] };

/* Returns the format that recognises the contents of a file, or null if no format does. */
static const cloud_format *recognise_format(cloud_file *file)
{
    for (int i = 0; i < FORMATS; i++)
        if (rows[i].format->recognise && rows[i].format->recognise(file))
            return rows[i].format;
    return NULL;
}

/* Choose the format by the contents. If no format recognises the contents, choose by the ending of the file's name.
 * If the ending is unknown, choose text. */
static const cloud_format *choose_format(cloud_file *file)
{
    const cloud_format *found = recognise_format(file);
    for (int i = 0; !found && i < FORMATS; i++)
        if (file_has_ending(file->name, rows[i].endings))
            found = rows[i].format;
    return found ? found : &cloud_text;
}

bool cloud_is_recognised(const unsigned char *bytes, size_t size)
{
    octreel_error ignored;
    cloud_file file = {.name = "", .bytes = bytes, .size = size, .error = &ignored};
    return size > 0 && (recognise_format(&file) || cloud_text_is_recognised(&file));
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

static bool parse_points(cloud_file *file)
{
    if (file->size > 0 && !choose_format(file)->parse(file))
        return false;
    cloud_discard_absent_values(file);
    if (file->out->count > 0)
        return true;
    if (file->out->skipped > 0)
        return cloud_fail(file, "holds no points that can be read: all %zu are %s", file->out->skipped,
                          file->out->why_skipped);
    return cloud_fail(file, "holds no points");
}

static bool parse_cloud_file(cloud_file *file)
{
    *file->out = (cloud){0};
    bool parsed = parse_points(file);
    if (!parsed)
        cloud_release(file->out);
    return parsed;
}

bool cloud_parse(const char *name, const unsigned char *bytes, size_t size, cloud *out, octreel_error *error)
{
    return parse_cloud_file(&(cloud_file){.name = name, .bytes = bytes, .size = size, .out = out, .error = error});
}

size_t cloud_row_number(const cloud *c, size_t index)
{
    return c->rows ? c->rows[index] : index;
}

void cloud_release(cloud *cloud)
{
    free(cloud->positions);
    free(cloud->rows);
    point_values_release(&cloud->values);
    memset(cloud, 0, sizeof *cloud);
}

bool cloud_read(const char *path, const cloud_watch *watch, cloud *out, octreel_error *error)
{
    char *bytes;
    size_t size;
    *out = (cloud){0};
    if (!file_read_with_progress(path, watch ? watch->read : NULL, watch ? watch->context : NULL, &bytes, &size, error))
        return false;
    const bool done = parse_cloud_file(&(cloud_file){.name = file_display_name(path),
                                                     .bytes = (const unsigned char *)bytes,
                                                     .size = size,
                                                     .out = out,
                                                     .error = error,
                                                     .watch = watch});
    free(bytes);
    return done;
}
