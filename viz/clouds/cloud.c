/* SPDX-License-Identifier: MIT */
#include "cloud_format.h"
#include "file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- Formats ------------------------------------------------------------------------------------------------ */

static const cloud_format *const formats[] = {
#define CLOUD_FORMAT_ROW(name) &cloud_##name,
    CLOUD_FORMAT_MAP(CLOUD_FORMAT_ROW)
#undef CLOUD_FORMAT_ROW
};

enum { FORMATS = sizeof formats / sizeof formats[0] };

char *cloud_format_names(char text[CLOUD_FORMAT_NAMES])
{
    size_t length = 0;
    for (int i = FORMATS - 1; i >= 0 && length < CLOUD_FORMAT_NAMES; i--)
        length += (size_t)snprintf(text + length, CLOUD_FORMAT_NAMES - length, "%s%s", formats[i]->name,
                                   i > 1    ? ", "
                                   : i == 1 ? " and "
                                            : "");
    return text;
}

static bool has_ending(const char *name, const char *ending)
{
    const size_t length = strlen(name), tail = strlen(ending);
    return length >= tail && strcasecmp(name + (length - tail), ending) == 0;
}

/* By the contents, else by the ending; else it is the last, which is text. */
static const cloud_format *choose_format(const cloud_file *file)
{
    for (int i = 0; i < FORMATS; i++)
        if (formats[i]->recognise && formats[i]->recognise(file))
            return formats[i];
    for (int i = 0; i < FORMATS; i++)
        if (formats[i]->ending && has_ending(file->name, formats[i]->ending))
            return formats[i];
    return formats[FORMATS - 1];
}

bool cloud_begins(const unsigned char *bytes, size_t size)
{
    octreel_error ignored;
    const cloud_file file = {.name = "", .bytes = bytes, .size = size, .error = &ignored};
    for (int i = 0; size > 0 && i < FORMATS; i++)
        if (formats[i]->recognise && formats[i]->recognise(&file))
            return true;
    return size > 0 && cloud_text_begins(&file);
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

static bool parse_filled(cloud_file *file)
{
    if (file->size > 0 && !choose_format(file)->parse(file))
        return false;
    cloud_end_values(file);
    if (file->out->count > 0)
        return true;
    if (file->out->skipped > 0)
        return cloud_fail(file, "holds no points: all %zu are %s", file->out->skipped, file->out->why_skipped);
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
    return parse(&(cloud_file){.name = name, .bytes = bytes, .size = size, .out = out, .error = error});
}

size_t cloud_row(const cloud *c, size_t index)
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

static void on_block(uint64_t done, uint64_t total, void *context)
{
    const cloud_watch *watch = context;
    watch->read(done, total, watch->context);
}

bool cloud_read(const char *path, const cloud_watch *watch, cloud *out, octreel_error *error)
{
    char *bytes, reason[FILE_REASON];
    size_t size;
    const bool watched = watch && watch->read;
    *out = (cloud){0};
    if (!file_read_watched(path, watched ? on_block : NULL, (void *)watch, &bytes, &size, reason))
        return error_set(error, "%s: %s", file_title(path), reason);
    const bool done = parse(&(cloud_file){.name = file_title(path),
                                          .bytes = (const unsigned char *)bytes,
                                          .size = size,
                                          .out = out,
                                          .error = error,
                                          .watch = watch});
    free(bytes);
    return done;
}
