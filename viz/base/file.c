/* SPDX-License-Identifier: MIT */
/* file.c - writes files so that a file is either complete or unchanged; locks, copies and compares files. */
#include "file.h"
#include "number.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <unistd.h>
#include <sys/file.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>

/* ---- Paths -------------------------------------------------------------------------------------------------- */

/* Returns the separator between a folder and a name. If the folder is "", the separator is empty, because "/name" would
 * lie in the root folder. */
static const char *separator_after(const char *folder)
{
    return *folder ? "/" : "";
}

char *path_join(const char *folder, const char *name)
{
    const size_t size = strlen(folder) + strlen(name) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s%s%s", folder, separator_after(folder), name);
    return path;
}

char *path_parent_folder(const char *path)
{
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/')
        length--;
    while (length > 0 && path[length - 1] != '/')
        length--;
    return length == 0 ? strdup(".") : strndup(path, length > 1 ? length - 1 : 1);
}

const char *path_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool file_has_ending(const char *name, const char *endings)
{
    const char *dot = strrchr(name, '.');
    const size_t length = dot ? strlen(dot) : 0;
    for (const char *at = endings; length > 1 && *at; at += 1 + strcspn(at + 1, "."))
        if (1 + strcspn(at + 1, ".") == length && strncasecmp(at, dot, length) == 0)
            return true;
    return false;
}

bool path_print(const char *folder, const char *name, char path[PATH_MAX])
{
    const int length = snprintf(path, PATH_MAX, "%s%s%s", folder, separator_after(folder), name);
    return length >= 0 && length < PATH_MAX;
}

/* The path is built in a buffer on the stack. With malloc(), lack of memory would look like a missing file. */
bool folder_contains(const char *folder, const char *name)
{
    char path[PATH_MAX];
    struct stat status;
    return path_print(folder, name, path) && stat(path, &status) == 0;
}

static int is_not_dot_entry(const struct dirent *entry)
{
    return strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
}

static int compare_by_name(const struct dirent **a, const struct dirent **b)
{
    return strcmp((*a)->d_name, (*b)->d_name);
}

/* One block of memory holds the array of pointers and the bytes of all names. */
char **folder_names(const char *folder, octreel_error *error)
{
    struct dirent **entries = NULL;
    const int count = scandir(folder, &entries, is_not_dot_entry, compare_by_name);
    size_t size = 0;
    for (int i = 0; i < count; i++)
        size += strlen(entries[i]->d_name) + 1;
    char **names = count < 0 ? NULL : malloc(((size_t)count + 1) * sizeof *names + size);
    const int reason = count < 0 ? errno : ENOMEM;
    char *at = names ? (char *)(names + count + 1) : NULL;
    for (int i = 0; i < count; i++) {
        if (names) {
            names[i] = at;
            at = stpcpy(at, entries[i]->d_name) + 1;
        }
        free(entries[i]);
    }
    free(entries);
    if (names)
        names[count] = NULL;
    else if (reason == ENOMEM)
        error_no_memory(error);
    else
        error_set(error, "%s: the folder cannot be read: %s", folder, strerror(reason));
    errno = names ? errno : reason;
    return names;
}

/* ---- Locks -------------------------------------------------------------------------------------------------- */

bool file_lock(int file)
{
    return flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

bool file_is_locked(const char *path)
{
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    const bool locked = file >= 0 && !file_lock(file);
    if (file >= 0)
        close(file);
    return locked;
}

int file_lock_parent_folder(const char *path)
{
    char *parent = path_parent_folder(path);
    const int folder = parent ? open(parent, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    while (folder >= 0 && flock(folder, LOCK_EX) != 0 && errno == EINTR)
        continue;
    free(parent);
    return folder;
}

/* ---- Standard input and output ------------------------------------------------------------------------------ */

bool file_is_standard_stream(const char *path)
{
    return strcmp(path, "-") == 0;
}

const char *file_display_name(const char *path)
{
    return file_is_standard_stream(path) ? FILE_STANDARD_INPUT : path;
}

const char *file_output_display_name(const char *path)
{
    return file_is_standard_stream(path) ? "standard output" : path;
}

/* ---- Atomic writing ----------------------------------------------------------------------------------------- */

#define PART ".part"

/* Returns the file descriptor that a path such as /dev/stdout or /dev/fd/63 names, or -1. A new file must not replace
 * such a path, and opening the path again would start at a second file position. */
static int find_named_descriptor(const char *path)
{
    const char *at = strncmp(path, "/dev/fd/", 8) == 0 ? path + 8 : "";
    uint64_t number = 0;
    if (strcmp(path, "/dev/stdout") == 0)
        return STDOUT_FILENO;
    if (strcmp(path, "/dev/stderr") == 0)
        return STDERR_FILENO;
    return whole_number_parse(&at, INT_MAX, &number) && *at == 0 ? (int)number : -1;
}

bool file_is_standard_output(const char *path)
{
    return file_is_standard_stream(path) || find_named_descriptor(path) == STDOUT_FILENO;
}

static bool is_special_file(const char *path)
{
    struct stat status;
    return find_named_descriptor(path) >= 0 || (stat(path, &status) == 0 && !S_ISREG(status.st_mode));
}

#ifdef __wasi__
#define dup(descriptor) (-1) /* WASI has no copies of descriptors, and pages write no files */
#endif

/* Opens a pipe, a device or an open file for writing. If no process reads a pipe, the function fails with ENXIO;
 * without O_NONBLOCK, open() would wait for a reader. */
static FILE *open_special_file(const char *path)
{
    const int named = find_named_descriptor(path);
    const int file = named >= 0 ? dup(named) : open(path, O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    FILE *stream = file >= 0 && (named >= 0 || fcntl(file, F_SETFL, 0) == 0) ? fdopen(file, "wb") : NULL;
    if (!stream && file >= 0)
        close(file);
    return stream;
}

/* How a file_writer opens its file. */
typedef enum write_mode {
    WRITE_OUTPUT, /* write to an existing pipe or device directly; treat other paths like WRITE_REPLACING */
    /* create a new ".part" file; first remove an existing ".part" file, which could be a pipe or a link */
    WRITE_REPLACING,
    WRITE_UNIQUE /* create a new ".part" file; fail if the ".part" file already exists */
} write_mode;

static FILE *open_stream(const char *name, bool is_part, write_mode how)
{
    if (!is_part)
        return open_special_file(name);
    if (how != WRITE_UNIQUE && unlink(name) != 0 && errno != ENOENT)
        return NULL;
    return fopen(name, "wbx");
}

/* Opens the file "<path><ending>" for writing. On failure, errno is the reason. */
static bool open_writer(file_writer *file, const char *path, const char *ending, write_mode how, octreel_error *error)
{
    *file = (file_writer){.path = path};
    if (file_is_standard_stream(path)) {
        file->stream = stdout;
        return true;
    }
    const bool is_part = how != WRITE_OUTPUT || !is_special_file(path);
    const size_t size = strlen(path) + strlen(ending) + 1;
    file->temp = malloc(size);
    if (!file->temp)
        return error_no_memory(error);
    snprintf(file->temp, size, "%s%s", path, is_part ? ending : "");
    file->stream = open_stream(file->temp, is_part, how);
    if (file->stream)
        return true;
    const int reason = errno;
    struct stat status;
    error_set(error, "%s: cannot be written: %s", path,
              reason == ENXIO && stat(path, &status) == 0 && S_ISFIFO(status.st_mode)
                  ? "no process reads this pipe; start its reader first, or name a file"
                  : strerror(reason));
    free(file->temp);
    *file = (file_writer){.path = path};
    errno = reason;
    return false;
}

bool file_writer_open(file_writer *file, const char *path, octreel_error *error)
{
    return open_writer(file, path, PART, WRITE_OUTPUT, error);
}

bool file_writer_open_replacing(file_writer *file, const char *path, octreel_error *error)
{
    return open_writer(file, path, PART, WRITE_REPLACING, error);
}

/* The name of the temporary file contains the nanoseconds of the current time. If a file with this name exists, another
 * process is writing it, and the next try uses another name. */
bool file_writer_open_unique(file_writer *file, const char *path, octreel_error *error)
{
    bool ok = false;
    errno = EEXIST;
    for (int tries = 0; !ok && tries < 100 && errno == EEXIST; tries++) {
        char ending[48];
        struct timespec now;
        clock_gettime(CLOCK_REALTIME, &now);
        snprintf(ending, sizeof ending, ".%lx" PART, (unsigned long)now.tv_nsec);
        ok = open_writer(file, path, ending, WRITE_UNIQUE, error);
    }
    return ok;
}

/* Syncs a file to the disk. Returns true also if the file system does not support syncing. */
static bool sync_stream(FILE *stream)
{
    return fsync(fileno(stream)) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS;
}

static bool is_written_directly(const file_writer *file)
{
    return strcmp(file->temp, file->path) == 0;
}

static bool report_write_error(file_writer *file, int reason, octreel_error *error)
{
    error_set(error, "%s: cannot be written: %s", file->path, strerror(reason));
    return file_writer_discard(file);
}

bool file_writer_finish(file_writer *file, octreel_error *error)
{
    if (!file->temp)
        return true;
    bool ok = fflush(file->stream) == 0 && !ferror(file->stream) && (!file->lasting || sync_stream(file->stream));
    int reason = errno;
    if (fclose(file->stream) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    file->stream = NULL;
    return ok || report_write_error(file, reason, error);
}

bool file_writer_rename(file_writer *file, octreel_error *error)
{
    if (file->temp && !is_written_directly(file) && rename(file->temp, file->path) != 0)
        return report_write_error(file, errno, error);
    free(file->temp);
    file->temp = NULL;
    return true;
}

bool file_writer_close(file_writer *file, octreel_error *error)
{
    return file_writer_finish(file, error) && file_writer_rename(file, error);
}

bool file_writer_discard(file_writer *file)
{
    if (!file->temp)
        return false;
    if (file->stream)
        fclose(file->stream);
    if (!is_written_directly(file))
        remove(file->temp);
    free(file->temp);
    *file = (file_writer){.path = file->path};
    return false;
}

/* Copies a stream. Reports only read errors; file_writer_finish() reports write errors, such as a full disk. */
static bool copy_stream(FILE *in, const char *from, FILE *out, octreel_error *error)
{
    char block[1 << 16];
    for (size_t size; (size = fread(block, 1, sizeof block, in)) > 0;)
        if (fwrite(block, 1, size, out) < size)
            break;
    return !ferror(in) || error_set(error, "%s: cannot be read: %s", from, strerror(errno));
}

typedef bool writer_opener(file_writer *file, const char *path, octreel_error *error);

static bool copy_to_temporary(file_writer *file, writer_opener *open_file, bool lasting, const char *from,
                              const char *to, octreel_error *error)
{
    char reason[FILE_REASON];
    FILE *in = file_open(from, NULL, reason);
    if (!in)
        return error_set(error, "%s: %s", file_display_name(from), reason);
    bool ok = open_file(file, to, error);
    file->lasting = lasting;
    if (ok)
        ok = copy_stream(in, from, file->stream, error) ? file_writer_finish(file, error) : file_writer_discard(file);
    fclose(in);
    return ok;
}

static bool copy_and_rename(writer_opener *open_file, bool lasting, const char *from, const char *to,
                            octreel_error *error)
{
    file_writer file;
    return copy_to_temporary(&file, open_file, lasting, from, to, error) && file_writer_rename(&file, error);
}

bool file_copy_to(const char *from, const char *to, octreel_error *error)
{
    return copy_and_rename(file_writer_open_replacing, false, from, to, error);
}

bool file_copy_prepare(file_writer *file, const char *from, const char *to, octreel_error *error)
{
    return copy_to_temporary(file, file_writer_open_replacing, true, from, to, error);
}

bool file_copy_unique(const char *from, const char *to, octreel_error *error)
{
    return copy_and_rename(file_writer_open_unique, true, from, to, error);
}

/* ---- Comparison --------------------------------------------------------------------------------------------- */

static bool have_same_content(FILE *a, FILE *b)
{
    char from_a[1 << 14], from_b[1 << 14];
    for (;;) {
        const size_t size = fread(from_a, 1, sizeof from_a, a);
        if (size != fread(from_b, 1, sizeof from_b, b) || memcmp(from_a, from_b, size) != 0)
            return false;
        if (size < sizeof from_a)
            return !ferror(a) && !ferror(b);
    }
}

bool have_same_bytes(const char *a, const char *b)
{
    struct stat of_a, of_b;
    if (file_is_standard_stream(a) || file_is_standard_stream(b))
        return false;
    if (stat(a, &of_a) != 0 || stat(b, &of_b) != 0 || !S_ISREG(of_a.st_mode) || !S_ISREG(of_b.st_mode) ||
        of_a.st_size != of_b.st_size)
        return false;
    FILE *file_a = fopen(a, "rb"), *file_b = fopen(b, "rb");
    const bool same = file_a && file_b && have_same_content(file_a, file_b);
    if (file_a)
        fclose(file_a);
    if (file_b)
        fclose(file_b);
    return same;
}

bool have_same_file(const char *folder_a, const char *folder_b, const char *name)
{
    char *a = path_join(folder_a, name), *b = path_join(folder_b, name);
    const bool same = a && b && have_same_bytes(a, b);
    free(a);
    free(b);
    return same;
}

bool is_same_file(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

bool stat_parent_folder(const char *path, struct stat *status)
{
    char *parent = path_parent_folder(path);
    const bool is = parent && stat(parent, status) == 0;
    free(parent);
    return is;
}
