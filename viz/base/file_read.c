/* SPDX-License-Identifier: MIT */
/* file_read.c - opens and reads files and standard input. */
#include "array.h"
#include "file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* The bytes of standard input. Standard input can be read only once, so file_open() keeps its bytes here. */
static struct {
    bool read;
    /* the bytes; null: standard input was not read yet, or the caller of file_read_with_progress() owns its bytes */
    char *bytes;
    size_t size;
} standard;

/* ---- Reading ------------------------------------------------------------------------------------------------ */

static bool set_reason(char reason[FILE_REASON], const char *what)
{
    snprintf(reason, FILE_REASON, "%s: %s", what, strerror(errno));
    return false;
}

/* Opens a regular file, and refuses other files. Opening a pipe would wait for the process at its other end; reading a
 * device may never end. */
static FILE *open_regular_file(const char *path, uint64_t *size, char reason[FILE_REASON])
{
    struct stat status;
    FILE *stream = NULL;
    if (stat(path, &status) != 0)
        set_reason(reason, "cannot be opened");
    else if (!S_ISREG(status.st_mode))
        snprintf(reason, FILE_REASON, "is not a regular file");
    else if (!(stream = fopen(path, "rb")))
        set_reason(reason, "cannot be opened");
    *size = stream ? (uint64_t)status.st_size : 0;
    return stream;
}

/* A stream that is read to its end. `total` is the expected number of bytes, or 0 if the number is unknown. */
typedef struct reading {
    FILE *stream;
    uint64_t total;
    file_progress *progress;
    void *context;
    char *bytes; /* the bytes read so far; always has room for at least one more byte */
    size_t size, room;
} reading;

static bool read_block(reading *r, size_t *got)
{
    const size_t most = (size_t)1 << 20;
    const bool full = r->room < r->size + 2;
    if (!array_grow(&r->bytes, full ? r->size + most : r->room, &r->room, 1))
        return false;
    const size_t left = r->room - r->size - 1;
    *got = fread(r->bytes + r->size, 1, left < most ? left : most, r->stream);
    r->size += *got;
    if (r->progress && *got > 0)
        r->progress(r->size, r->total, r->context);
    return true;
}

/* Reads a stream to its end. The first buffer for a regular file is larger than the file, so that the last read finds
 * the end of the file without growing the buffer. */
static bool read_stream(reading *r, char reason[FILE_REASON])
{
    size_t got = 1;
    bool has_memory = r->total < SIZE_MAX - 2;
    r->bytes = has_memory && r->total > 0 ? malloc((size_t)r->total + 2) : NULL;
    r->room = r->bytes ? (size_t)r->total + 2 : 0;
    has_memory = has_memory && (r->bytes || r->total == 0);
    while (has_memory && got > 0)
        has_memory = read_block(r, &got);
    if (has_memory && !ferror(r->stream))
        return true;
    if (has_memory)
        set_reason(reason, "cannot be read");
    else
        snprintf(reason, FILE_REASON, "out of memory for the file's %ju bytes",
                 (uintmax_t)(r->total > r->size ? r->total : r->size));
    free(r->bytes);
    return false;
}

/* Reads standard input. Its size is known only if it is redirected from a regular file. */
static bool read_standard_input(file_progress *progress, void *context, char **bytes, size_t *size,
                                char reason[FILE_REASON])
{
    struct stat status;
    const bool regular = fstat(fileno(stdin), &status) == 0 && S_ISREG(status.st_mode);
    reading r = {stdin, regular ? (uint64_t)status.st_size : 0, progress, context, NULL, 0, 0};
    if (standard.read) {
        snprintf(reason, FILE_REASON, "can be read only once, and has already been read as another input");
        return false;
    }
    standard.read = true;
    if (!read_stream(&r, reason))
        return false;
    *bytes = r.bytes;
    *size = r.size;
    return true;
}

FILE *file_open(const char *path, uint64_t *size, char reason[FILE_REASON])
{
    uint64_t ignored;
    if (!file_is_standard_stream(path))
        return open_regular_file(path, size ? size : &ignored, reason);
    if (!standard.bytes && !read_standard_input(NULL, NULL, &standard.bytes, &standard.size, reason))
        return NULL;
    *(size ? size : &ignored) = standard.size;
    FILE *stream = standard.size > 0 ? fmemopen(standard.bytes, standard.size, "rb") : NULL;
    if (!stream && standard.size > 0)
        set_reason(reason, "cannot be opened");
    else if (!stream)
        snprintf(reason, FILE_REASON, "is empty");
    return stream;
}

/* Copies the bytes of standard input that file_open() kept. A copy is affordable, because inputs that file_open() opens
 * are small. */
static bool copy_stored_input(char **bytes, size_t *size, char reason[FILE_REASON])
{
    *size = standard.size;
    *bytes = malloc(standard.size + 1);
    if (!*bytes) {
        snprintf(reason, FILE_REASON, "out of memory for the file's %zu bytes", standard.size);
        return false;
    }
    memcpy(*bytes, standard.bytes, standard.size);
    return true;
}

bool file_read_with_progress(const char *path, file_progress *progress, void *context, char **bytes, size_t *size,
                             octreel_error *error)
{
    reading r = {.progress = progress, .context = context};
    char reason[FILE_REASON];
    bool read;
    *bytes = NULL;
    *size = 0;
    if (file_is_standard_stream(path)) {
        read = standard.bytes ? copy_stored_input(bytes, size, reason)
                              : read_standard_input(progress, context, bytes, size, reason);
    } else {
        r.stream = open_regular_file(path, &r.total, reason);
        read = r.stream && read_stream(&r, reason);
        if (r.stream)
            fclose(r.stream);
        *bytes = read ? r.bytes : NULL;
        *size = read ? r.size : 0;
    }
    return read || error_set(error, "%s: %s", file_display_name(path), reason);
}

bool file_read_whole(const char *path, char **bytes, size_t *size, octreel_error *error)
{
    return file_read_with_progress(path, NULL, NULL, bytes, size, error);
}
