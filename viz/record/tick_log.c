/* SPDX-License-Identifier: MIT */
/* tick_log.c - appends lines to ticks.jsonl. The file never ends with an incomplete line. */
#include "tick_log.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/file.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool fail_with_write_error(tick_log *log, octreel_error *error, const char *more)
{
    return error_set(error, "%s: cannot be written: %s%s", log->path, strerror(errno), more);
}

/* Lock the file, then truncate it unless `keep` is set. Truncating first would remove the lines of another process. */
static bool lock_and_open(tick_log *log, int file, bool keep, octreel_error *error)
{
    if (!file_lock(file))
        return error_set(error, "%s: another process is recording into this folder", log->path);
    log->kept = keep ? lseek(file, 0, SEEK_END) : 0;
    if (log->kept >= 0 && lseek(file, 0, SEEK_SET) == 0 && (keep || ftruncate(file, 0) == 0))
        log->stream = fdopen(file, "r+b");
    return log->stream || fail_with_write_error(log, error, "");
}

bool tick_log_open(tick_log *log, const char *folder, const char *name, bool keep, octreel_error *error)
{
    *log = (tick_log){.path = path_join(folder, name)};
    if (!log->path)
        return error_no_memory(error);
    const int file = open(log->path, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0 ? fail_with_write_error(log, error, "") : lock_and_open(log, file, keep, error))
        return true;
    if (file >= 0)
        close(file);
    free(log->path);
    log->path = NULL;
    return false;
}

/* After a write error, remove the incomplete last line, close the file and set the error. Returns false. */
static bool cut_torn_line_and_fail(tick_log *log, octreel_error *error)
{
    const int reason = errno;
    fclose(log->stream);
    log->stream = NULL;
    const bool cut = truncate(log->path, log->whole) == 0;
    errno = reason;
    return fail_with_write_error(log, error, cut ? "" : "; its last line is incomplete");
}

/* Returns whether a line equals the next line of the earlier log, which can then stay in the file. */
static bool is_next_old_line(const tick_log *log, const char *line, size_t size)
{
    if (log->kept - log->whole < (off_t)size)
        return false;
    for (size_t i = 0; i < size; i++)
        if (getc(log->stream) != (unsigned char)line[i])
            return false;
    return true;
}

/* Truncate the file before the next line of the earlier log, because that line differs from the new line. */
static bool remove_old_lines(tick_log *log)
{
    log->kept = 0;
    return fseeko(log->stream, log->whole, SEEK_SET) == 0 && ftruncate(fileno(log->stream), log->whole) == 0;
}

bool tick_log_add(tick_log *log, const char *line, size_t size, octreel_error *error)
{
    if (log->kept > 0 && is_next_old_line(log, line, size)) {
        log->whole += (off_t)size;
        return true;
    }
    if (log->kept > 0 && !remove_old_lines(log))
        return cut_torn_line_and_fail(log, error);
    if (fwrite(line, 1, size, log->stream) != size || fflush(log->stream) != 0)
        return cut_torn_line_and_fail(log, error);
    log->whole += (off_t)size;
    return true;
}

bool tick_log_close(tick_log *log, bool whole, octreel_error *error)
{
    const bool cut =
        !log->stream || !whole || log->kept == 0 || remove_old_lines(log) || fail_with_write_error(log, error, "");
    if (log->stream)
        /* unlock explicitly: a child process may have the file open too, and would keep the lock */
        flock(fileno(log->stream), LOCK_UN);
    const bool ok = (!log->stream || fclose(log->stream) == 0 || fail_with_write_error(log, error, "")) && cut;
    free(log->path);
    *log = (tick_log){0};
    return ok;
}
