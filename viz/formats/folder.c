/* SPDX-License-Identifier: MIT */
/* folder.c - the names of the files of a recording, and functions that create, check and clean the recording's
 * folder. */
#include "folder.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef int status_reader(const char *path, struct stat *status); /* stat() or lstat() */

static bool create_folder(const char *path, status_reader *read_status, octreel_error *error)
{
    struct stat status;
    if (mkdir(path, 0777) == 0)
        return true;
    const int reason = errno;
    if (read_status(path, &status) != 0)
        return error_set(error, "%s: cannot create the folder: %s", path, strerror(reason));
    return S_ISDIR(status.st_mode) || error_set(error, "%s: cannot create the folder: a %s has this name", path,
                                                S_ISLNK(status.st_mode) ? "link" : "file");
}

/* Creates the parent folders of `path`: the folder before each slash at or after `from`. */
static bool create_parents(char *path, char *from, status_reader *read_status, octreel_error *error)
{
    bool ok = true;
    for (char *slash = strchr(from, '/'); ok && slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        ok = create_folder(path, read_status, error);
        *slash = '/';
    }
    return ok;
}

/* Checks that the system accepts the length of a folder's path and of the paths of files in it. mkdir() would find a
 * path that is too long only after the parent folders were created. */
static bool check_path_length(const char *folder, octreel_error *error)
{
    const size_t longest = PATH_MAX - sizeof "/" - NAME_MAX;
    size_t name = 0;
    for (const char *at = folder; *at && name <= NAME_MAX; at++)
        name = *at == '/' ? 0 : name + 1;
    if (name > NAME_MAX)
        return error_set(error, "%.60s...: cannot create the folder: a name in its path is longer than %d bytes",
                         folder, NAME_MAX);
    return strlen(folder) <= longest ||
           error_set(error, "%.60s...: cannot create the folder: its path has %zu bytes, but at most %zu are possible",
                     folder, strlen(folder), longest);
}

bool folder_create(const char *folder, octreel_error *error)
{
    if (!*folder)
        return error_set(error, "the folder's name is empty");
    if (!check_path_length(folder, error))
        return false;
    char *path = strdup(folder);
    if (!path)
        return error_no_memory(error);
    const bool ok = create_parents(path, path + 1, stat, error) && create_folder(path, stat, error);
    free(path);
    return ok;
}

bool folder_create_parents(const char *folder, const char *name, octreel_error *error)
{
    char *path = path_join(folder, name);
    if (!path)
        return error_no_memory(error);
    const bool ok = create_parents(path, path + strlen(path) - strlen(name), lstat, error);
    free(path);
    return ok;
}

void folder_remove_empty_parents(const char *folder, const char *name)
{
    char *path = path_join(folder, name);
    char *const start = path ? path + strlen(path) - strlen(name) : NULL;
    for (char *slash; path && (slash = strrchr(start, '/'));) {
        *slash = 0;
        if (rmdir(path) != 0) /* rmdir() fails if the folder is not empty */
            break;
    }
    free(path);
}

char *chunk_print_name(uint64_t first, uint64_t last, char name[CHUNK_NAME])
{
    snprintf(name, CHUNK_NAME, "ticks_%" PRIu64 "_%" PRIu64 ".jsonl", first, last);
    return name;
}

bool chunk_parse_name(const char *name, uint64_t *first, uint64_t *last)
{
    char again[CHUNK_NAME], *end;
    if (strncmp(name, "ticks_", 6) != 0)
        return false;
    *first = strtoull(name + 6, &end, 10);
    if (*end != '_')
        return false;
    *last = strtoull(end + 1, NULL, 10);
    return *first < *last && strcmp(name, chunk_print_name(*first, *last, again)) == 0;
}

const char *const recording_files[] = {"recording.json", "session.json", "renderer.json",
                                       "ticks.jsonl",    "index.html",   NULL};

bool folder_is_recording_file(const char *name)
{
    uint64_t first, last;
    for (size_t i = 0; recording_files[i]; i++)
        if (strcmp(name, recording_files[i]) == 0)
            return true;
    return strncmp(name, "frame_", 6) == 0 || strcmp(name, FOLDER_ASIDE) == 0 || chunk_parse_name(name, &first, &last);
}

/* Sets the error that a folder already contains `name`, a file of a recording. Returns false. */
static bool fail_with_existing_file(const char *folder, const char *name, octreel_error *error)
{
    if (folder_contains(folder, "recording.json") || folder_contains(folder, FOLDER_ASIDE))
        return error_set(error,
                         "%s: already holds a recording: complete it (--resume), replace it (--replace), "
                         "or choose another folder (-o)",
                         folder);
    return error_set(error, "%s: already holds %s, which a recording could overwrite: choose another folder (-o)",
                     folder, name);
}

static bool check_no_recording_files(const char *folder, octreel_error *error)
{
    char **names = folder_names(folder, error);
    bool ok = names;
    for (size_t i = 0; ok && names[i]; i++)
        ok = !folder_is_recording_file(names[i]) || fail_with_existing_file(folder, names[i], error);
    free(names);
    return ok;
}

bool folder_create_for_recording(const char *folder, octreel_error *error)
{
    return folder_create(folder, error) && check_no_recording_files(folder, error);
}

bool folder_write_file(const char *folder, const char *name, const char *bytes, size_t size, octreel_error *error)
{
    char *path = path_join(folder, name);
    file_writer file;
    bool ok = path ? file_writer_open_replacing(&file, path, error) : error_no_memory(error);
    if (ok) {
        /* the result is ignored, because file_writer_close() reports write errors */
        fwrite(bytes, 1, size, file.stream);
        ok = file_writer_close(&file, error);
    }
    free(path);
    return ok;
}

void folder_remove_recording_files(const char *folder)
{
    for (size_t i = 0; recording_files[i]; i++) {
        char *path = path_join(folder, recording_files[i]);
        if (path)
            remove(path);
        free(path);
    }
}

/* Returns whether a suffix marks an incomplete file. The suffix "part" marks a file that is being written. The
 * suffix "live" marks the session of a running program. The name of a chunk, with or without ".part", marks a file
 * of one of several processes that record chunks. */
static bool is_unfinished_suffix(const char *ending)
{
    char word[CHUNK_NAME];
    uint64_t first, last;
    const size_t length = strlen(ending), part = sizeof ".part" - 1;
    if (strcmp(ending, "part") == 0 || strcmp(ending, "live") == 0)
        return true;
    const bool also = length > part && strcmp(ending + length - part, ".part") == 0;
    snprintf(word, sizeof word, "%.*s", (int)(also ? length - part : length), ending);
    return chunk_parse_name(word, &first, &last);
}

bool folder_is_unfinished_file(const char *name)
{
    const char *end = strrchr(name, '.');
    if (strncmp(name, "frame_", 6) == 0)
        return end && strcmp(end, ".part") == 0;
    for (size_t i = 0; recording_files[i]; i++) {
        const size_t length = strlen(recording_files[i]);
        if (strncmp(name, recording_files[i], length) == 0 && name[length] == '.')
            return is_unfinished_suffix(name + length + 1);
    }
    return false;
}

bool folder_remove_file(const char *folder, const char *name, octreel_error *error)
{
    char *path = path_join(folder, name);
    const bool removed = path && (remove(path) == 0 || errno == ENOENT);
    free(path);
    return removed || error_set(error, "%s/%s: cannot be removed: %s", folder, name, strerror(errno));
}

bool folder_remove_leftovers(const char *folder, octreel_error *error)
{
    uint64_t first, last;
    char **names = folder_names(folder, error);
    bool ok = names;
    for (size_t i = 0; ok && names[i]; i++)
        if (folder_is_unfinished_file(names[i]) || chunk_parse_name(names[i], &first, &last))
            ok = folder_remove_file(folder, names[i], error);
    free(names);
    return ok;
}
