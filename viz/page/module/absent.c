/* SPDX-License-Identifier: MIT */
/* absent.c - replaces functions that read files, because a page has no files. The replacements fail with an error. They
 * are linked in place of file_read.c and the cloud readers. */
#include "cloud.h"
#include "file.h"

#include <stdio.h>

static const char no_files[] = "cannot be opened: a page cannot read files";

FILE *file_open(const char *path, uint64_t *size, char reason[FILE_REASON])
{
    (void)path;
    (void)size;
    snprintf(reason, FILE_REASON, "%s", no_files);
    return NULL;
}

bool file_read_whole(const char *path, char **bytes, size_t *size, octreel_error *error)
{
    *bytes = NULL;
    *size = 0;
    return error_set(error, "%s: %s", path, no_files);
}

bool cloud_read(const char *path, const cloud_watch *watch, cloud *out, octreel_error *error)
{
    (void)watch;
    *out = (cloud){0};
    return error_set(error, "%s: %s", path, no_files);
}

bool cloud_is_recognised(const unsigned char *bytes, size_t size)
{
    (void)bytes;
    (void)size;
    return false;
}

const char *cloud_describe_out_of_range(const size_t beyond[POINT_VALUE_KINDS], char text[CLOUD_OUT_OF_RANGE_TEXT])
{
    (void)beyond;
    *text = 0;
    return text;
}

size_t cloud_row_number(const cloud *c, size_t index)
{
    (void)c;
    return index;
}

void cloud_release(cloud *c)
{
    (void)c;
}
