/* whole_file.c - see whole_file.h. */
#include "whole_file.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool refuse(char reason[WHOLE_FILE_REASON], const char *what)
{
    snprintf(reason, WHOLE_FILE_REASON, "%s: %s", what, strerror(errno));
    return false;
}

/* Read up to *size bytes, and set it to what was there. */
static bool read_bytes(const char *path, char *bytes, size_t *size, char reason[WHOLE_FILE_REASON])
{
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return refuse(reason, "cannot be opened");
    *size = fread(bytes, 1, *size, stream);
    bool whole = !ferror(stream);
    if (!whole)
        refuse(reason, "cannot be read");
    fclose(stream);
    return whole;
}

bool whole_file_read(const char *path, char **bytes, size_t *size, char reason[WHOLE_FILE_REASON])
{
    struct stat status;
    *bytes = NULL;
    if (stat(path, &status) != 0)
        return refuse(reason, "cannot be opened");
    /* Opening a pipe would wait for its other end; a device may never end. */
    if (!S_ISREG(status.st_mode)) {
        snprintf(reason, WHOLE_FILE_REASON, "is not a regular file");
        return false;
    }
    *size = (size_t)status.st_size;
    *bytes = (uintmax_t)status.st_size < SIZE_MAX ? malloc(*size + 1) : NULL;
    if (!*bytes) {
        snprintf(reason, WHOLE_FILE_REASON, "out of memory for its %jd bytes", (intmax_t)status.st_size);
        return false;
    }
    if (read_bytes(path, *bytes, size, reason))
        return true;
    free(*bytes);
    *bytes = NULL;
    return false;
}
