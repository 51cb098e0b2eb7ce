/* SPDX-License-Identifier: MIT */
/* absent.c - what a page does not have, in place of what the rooms are linked with elsewhere: files, compressed clouds
 * and a graphics context. */
#include "file.h"
#include "renderer.h"

#include <errno.h>
#include <lzf.h>
#include <stdio.h>

FILE *fopen(const char *path, const char *mode)
{
    (void)path;
    (void)mode;
    errno = ENOENT;
    return NULL;
}

/* In place of file_read.c. */
static void tell_absent(char reason[FILE_REASON])
{
    snprintf(reason, FILE_REASON, "cannot be opened: a page has no files");
}

FILE *file_open(const char *path, uint64_t *size, char reason[FILE_REASON])
{
    (void)path;
    (void)size;
    tell_absent(reason);
    return NULL;
}

bool file_read_watched(const char *path, file_progress *progress, void *context, char **bytes, size_t *size,
                       char reason[FILE_REASON])
{
    (void)path;
    (void)progress;
    (void)context;
    (void)bytes;
    (void)size;
    tell_absent(reason);
    return false;
}

bool file_read_whole(const char *path, char **bytes, size_t *size, char reason[FILE_REASON])
{
    return file_read_watched(path, NULL, NULL, bytes, size, reason);
}

unsigned int lzf_decompress(const void *in, unsigned int in_size, void *out, unsigned int out_size)
{
    (void)in;
    (void)in_size;
    (void)out;
    (void)out_size;
    return 0;
}

renderer *renderer_open(int width, int height, const renderer_choice *choice, octreel_error *error)
{
    (void)choice;
    return renderer_open_memory(width, height, error);
}
