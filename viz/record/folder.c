/* folder.c - see folder.h. */
#include "folder.h"

#include <dirent.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool record_fail(record_error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    return false;
}

char *folder_path(const char *folder, const char *name)
{
    const size_t size = strlen(folder) + strlen(name) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s", folder, name);
    return path;
}

static bool make_one(const char *path, record_error *error)
{
    struct stat status;
    if (mkdir(path, 0777) == 0 || (stat(path, &status) == 0 && S_ISDIR(status.st_mode)))
        return true;
    return record_fail(error, "%s: the folder cannot be made: %s", path, strerror(errno));
}

static bool make_all(const char *folder, record_error *error)
{
    char *path = strdup(folder);
    if (!path)
        return record_fail(error, "there is no memory");
    bool ok = true;
    for (char *slash = strchr(path + 1, '/'); ok && slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        ok = make_one(path, error);
        *slash = '/';
    }
    ok = ok && make_one(path, error);
    free(path);
    return ok;
}

/* What tells a folder that was filmed into. */
static bool belongs_to_recording(const char *name)
{
    return strcmp(name, "recording.json") == 0 || strcmp(name, "ticks.jsonl") == 0 || strncmp(name, "frame_", 6) == 0;
}

static bool check_empty(const char *folder, record_error *error)
{
    DIR *entries = opendir(folder);
    if (!entries)
        return record_fail(error, "%s: the folder cannot be read: %s", folder, strerror(errno));
    bool ok = true;
    for (struct dirent *entry; ok && (entry = readdir(entries));)
        if (belongs_to_recording(entry->d_name))
            ok = record_fail(error, "%s: already holds a recording (%s); choose another folder, or remove it", folder,
                             entry->d_name);
    closedir(entries);
    return ok;
}

bool folder_prepare(const char *folder, record_error *error)
{
    if (!*folder)
        return record_fail(error, "the folder's name is empty");
    return make_all(folder, error) && check_empty(folder, error);
}

static bool write_whole(const char *path, const char *bytes, size_t size, record_error *error)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        return record_fail(error, "%s: cannot be written: %s", path, strerror(errno));
    const bool written = fwrite(bytes, 1, size, file) == size;
    const int first = errno;
    const bool closed = fclose(file) == 0;
    if (written && closed)
        return true;
    return record_fail(error, "%s: cannot be written: %s", path, strerror(written ? errno : first));
}

bool folder_write(const char *folder, const char *name, const char *bytes, size_t size, record_error *error)
{
    char *path = folder_path(folder, name);
    char *part = path ? malloc(strlen(path) + sizeof ".part") : NULL;
    bool ok = part != NULL;
    if (ok) {
        sprintf(part, "%s.part", path);
        ok = write_whole(part, bytes, size, error);
        if (ok && rename(part, path) != 0)
            ok = record_fail(error, "%s: cannot be renamed: %s", part, strerror(errno));
        if (!ok)
            remove(part);
    } else {
        record_fail(error, "there is no memory");
    }
    free(part);
    free(path);
    return ok;
}
