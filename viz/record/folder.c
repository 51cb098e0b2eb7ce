/* folder.c - see folder.h. */
#include "folder.h"
#include "parts.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Sentences begin with a path: of one that is too long the beginning goes, never the reason at its end. */
bool record_fail(record_error *error, const char *format, ...)
{
    char whole[PATH_MAX + sizeof error->text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(whole, sizeof whole, format, arguments);
    va_end(arguments);
    const size_t length = strlen(whole), room = sizeof error->text - 1;
    if (length <= room)
        snprintf(error->text, sizeof error->text, "%s", whole);
    else
        snprintf(error->text, sizeof error->text, "...%s", whole + length - room + 3);
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

bool folder_has(const char *folder, const char *name)
{
    struct stat status;
    char *path = folder_path(folder, name);
    const bool there = path && stat(path, &status) == 0;
    free(path);
    return there;
}

static bool make_one(const char *path, record_error *error)
{
    struct stat status;
    if (mkdir(path, 0777) == 0)
        return true;
    const int reason = errno;
    if (stat(path, &status) != 0)
        return record_fail(error, "%s: the folder cannot be made: %s", path, strerror(reason));
    return S_ISDIR(status.st_mode) || record_fail(error, "%s: the folder cannot be made: a file is in its place", path);
}

bool folder_make(const char *folder, record_error *error)
{
    if (!*folder)
        return record_fail(error, "the folder's name is empty");
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

/* A recording's files beside its frames. */
static const char *const recording_files[] = {"recording.json", "session.json", "renderer.json", "ticks.jsonl",
                                              "index.html"};

#define RECORDING_FILES (sizeof recording_files / sizeof recording_files[0])

const char *folder_fact_name(size_t i)
{
    return i < RECORDING_FILES ? recording_files[i] : NULL;
}

bool folder_is_name(const char *name)
{
    uint64_t first, last;
    for (size_t i = 0; i < RECORDING_FILES; i++)
        if (strcmp(name, recording_files[i]) == 0)
            return true;
    return strncmp(name, "frame_", 6) == 0 || part_parse_name(name, &first, &last);
}

static bool check_empty(const char *folder, record_error *error)
{
    DIR *entries = opendir(folder);
    if (!entries)
        return record_fail(error, "%s: the folder cannot be read: %s", folder, strerror(errno));
    bool ok = true;
    for (struct dirent *entry; ok && (entry = readdir(entries));)
        if (folder_is_name(entry->d_name))
            ok = record_fail(error, "%s: already holds a recording (%s); choose another folder, or remove it", folder,
                             entry->d_name);
    closedir(entries);
    return ok;
}

bool folder_prepare(const char *folder, record_error *error)
{
    return folder_make(folder, error) && check_empty(folder, error);
}

static bool is_there_but_no_file(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && !S_ISREG(status.st_mode);
}

bool part_open(part_file *file, const char *path, record_error *error)
{
    const size_t size = strlen(path) + sizeof ".part";
    *file = (part_file){.path = path, .part = malloc(size)};
    if (!file->part)
        return record_fail(error, "there is no memory");
    snprintf(file->part, size, "%s%s", path, is_there_but_no_file(path) ? "" : ".part");
    file->stream = fopen(file->part, "wb");
    if (file->stream)
        return true;
    record_fail(error, "%s: cannot be written: %s", path, strerror(errno));
    free(file->part);
    return false;
}

bool part_close(part_file *file, record_error *error)
{
    const bool direct = strcmp(file->part, file->path) == 0;
    bool ok = fflush(file->stream) == 0 && !ferror(file->stream);
    int reason = errno;
    if (fclose(file->stream) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    if (ok && !direct && rename(file->part, file->path) != 0) {
        ok = false;
        reason = errno;
    }
    if (!ok && !direct)
        remove(file->part);
    free(file->part);
    return ok || record_fail(error, "%s: cannot be written: %s", file->path, strerror(reason));
}

bool part_abandon(part_file *file)
{
    fclose(file->stream);
    if (strcmp(file->part, file->path) != 0)
        remove(file->part);
    free(file->part);
    return false;
}

bool folder_write(const char *folder, const char *name, const char *bytes, size_t size, record_error *error)
{
    char *path = folder_path(folder, name);
    part_file file;
    bool ok = path ? part_open(&file, path, error) : record_fail(error, "there is no memory");
    if (ok) {
        fwrite(bytes, 1, size, file.stream); /* part_close tells */
        ok = part_close(&file, error);
    }
    free(path);
    return ok;
}

void folder_abandon(const char *folder)
{
    for (size_t i = 0; i < RECORDING_FILES; i++) {
        char *path = folder_path(folder, recording_files[i]);
        if (path)
            remove(path);
        free(path);
    }
}

/* What stands behind the name of a file while it is written, or of a session while a program makes it: "part", "live",
 * or the writer's word of folder_write_once(), which is a part's name. */
static bool is_of_writer(const char *ending)
{
    char word[PART_NAME];
    uint64_t first, last;
    const size_t length = strlen(ending), part = sizeof ".part" - 1;
    if (strcmp(ending, "part") == 0 || strcmp(ending, "live") == 0)
        return true;
    const bool also = length > part && strcmp(ending + length - part, ".part") == 0;
    snprintf(word, sizeof word, "%.*s", (int)(also ? length - part : length), ending);
    return part_parse_name(word, &first, &last);
}

bool folder_is_unfinished(const char *name)
{
    const char *end = strrchr(name, '.');
    if (strncmp(name, "frame_", 6) == 0)
        return end && strcmp(end, ".part") == 0;
    for (size_t i = 0; i < RECORDING_FILES; i++) {
        const size_t length = strlen(recording_files[i]);
        if (strncmp(name, recording_files[i], length) == 0 && name[length] == '.')
            return is_of_writer(name + length + 1);
    }
    return false;
}

static bool remove_entry(const char *folder, const char *name, record_error *error)
{
    char *path = folder_path(folder, name);
    const bool removed = path && (remove(path) == 0 || errno == ENOENT);
    free(path);
    return removed || record_fail(error, "%s/%s: cannot be removed: %s", folder, name, strerror(errno));
}

bool folder_sweep(const char *folder, record_error *error)
{
    uint64_t first, last;
    DIR *entries = opendir(folder);
    if (!entries)
        return record_fail(error, "%s: the folder cannot be read: %s", folder, strerror(errno));
    bool ok = true;
    for (struct dirent *entry; ok && (entry = readdir(entries));)
        if (folder_is_unfinished(entry->d_name) || part_parse_name(entry->d_name, &first, &last))
            ok = remove_entry(folder, entry->d_name, error);
    closedir(entries);
    return ok;
}
