/* SPDX-License-Identifier: MIT */
/* absent.c - what a page does not have, in place of what the rooms are linked with elsewhere: files, and clouds, which
 * are files. */
#include "cloud.h"
#include "file.h"

#include <errno.h>
#include <stdio.h>

FILE *fopen(const char *path, const char *mode)
{
    (void)path;
    (void)mode;
    errno = ENOENT;
    return NULL;
}

/* In place of file_read.c and of what reads clouds: a page has no files. */
static const char absent[] = "cannot be opened: a page has no files";

FILE *file_open(const char *path, uint64_t *size, char reason[FILE_REASON])
{
    (void)path;
    (void)size;
    snprintf(reason, FILE_REASON, "%s", absent);
    return NULL;
}

bool file_read_whole(const char *path, char **bytes, size_t *size, char reason[FILE_REASON])
{
    (void)bytes;
    (void)size;
    return file_open(path, NULL, reason);
}

bool cloud_read(const char *path, const cloud_watch *watch, cloud *out, octreel_error *error)
{
    (void)watch;
    *out = (cloud){0};
    return error_set(error, "%s: %s", path, absent);
}

bool cloud_recognise(const unsigned char *bytes, size_t size)
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

size_t cloud_row(const cloud *c, size_t index)
{
    (void)c;
    return index;
}

void cloud_release(cloud *c)
{
    (void)c;
}
