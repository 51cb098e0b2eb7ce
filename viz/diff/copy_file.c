/* copy_file.c - see copy_file.h. */
#include "copy_file.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

/* A full disk shows in part_close(). */
static bool copy_stream(FILE *in, const char *from, FILE *out, record_error *error)
{
    char block[1 << 16];
    for (size_t size; (size = fread(block, 1, sizeof block, in)) > 0;)
        if (fwrite(block, 1, size, out) < size)
            break;
    return !ferror(in) || record_fail(error, "%s: cannot be read: %s", from, strerror(errno));
}

bool copy_file(const char *from, const char *to, record_error *error)
{
    struct stat status;
    part_file file;
    if (stat(from, &status) == 0 && !S_ISREG(status.st_mode))
        return record_fail(error, "%s: it is no regular file", from);
    FILE *in = fopen(from, "rb");
    if (!in)
        return record_fail(error, "%s: cannot be opened: %s", from, strerror(errno));
    bool ok = part_open(&file, to, error);
    if (ok)
        ok = copy_stream(in, from, file.stream, error) ? part_close(&file, error) : part_abandon(&file);
    fclose(in);
    return ok;
}
