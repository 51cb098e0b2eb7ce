/* SPDX-License-Identifier: MIT */
/* replacement.c - a recording makes room for another one in its folder.
 *
 * recording.json is the first file that is set aside, the first that is removed and the last that is put back. So
 * whatever is interrupted: where the folder aside has one, its files are to be put back; where it has none, they are to
 * be removed. */
#include "replacement.h"
#include "frame_file.h"
#include "tick_log.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static const char mark[] = "recording.json", unfinished_mark[] = "recording.json.part";

/* ---- Names -------------------------------------------------------------------------------------------------- */

static bool is_log(const char *name)
{
    uint64_t first, last;
    return strcmp(name, "ticks.jsonl") == 0 || chunk_parse_name(name, &first, &last);
}

static bool is_frame(const char *name)
{
    char whole[FRAME_NAME + sizeof ".part"];
    uint64_t tick;
    const size_t length = strlen(name), part = sizeof ".part" - 1;
    const bool unfinished = length > part && strcmp(name + length - part, ".part") == 0;
    if (length >= sizeof whole)
        return false;
    snprintf(whole, sizeof whole, "%.*s", (int)(length - (unfinished ? part : 0)), name);
    return frame_parse_name(whole, &tick);
}

/* Whether a recording has files of this name; FOLDER_ASIDE is none of them. */
static bool is_of_recording(const char *name)
{
    if (strncmp(name, "frame_", 6) == 0)
        return is_frame(name);
    return strcmp(name, FOLDER_ASIDE) != 0 && (folder_is_name(name) || folder_is_unfinished(name));
}

/* ---- Checked ------------------------------------------------------------------------------------------------ */

static bool is_recording(const char *folder)
{
    char *path = path_join(folder, mark);
    struct stat status;
    const bool there = path && lstat(path, &status) == 0 && S_ISREG(status.st_mode);
    json_t *object = there ? json_load_file(path, JSON_DISABLE_EOF_CHECK, NULL) : NULL;
    const char *what = json_string_value(json_object_get(object, "octreel"));
    const bool is = what && strcmp(what, "recording") == 0;
    json_decref(object);
    free(path);
    return is;
}

static bool has_recording_aside(const char *folder)
{
    char *aside = path_join(folder, FOLDER_ASIDE);
    const bool has = aside && is_recording(aside);
    free(aside);
    return has;
}

/* *past: there is more than the first moment of a recording leaves, which is an empty log. */
static bool check_entry(const char *folder, const char *name, bool *past, octreel_error *error)
{
    struct stat status;
    if (!is_of_recording(name))
        return !folder_is_name(name) || strcmp(name, FOLDER_ASIDE) == 0 ||
               error_set(error,
                         "%s/%s: is no file of a recording, which would not be replaced: move it away, or choose "
                         "another folder (-o)",
                         folder, name);
    char *path = path_join(folder, name);
    if (!path)
        return error_no_memory(error);
    bool ok = lstat(path, &status) == 0 && S_ISREG(status.st_mode);
    if (!ok)
        error_set(error, "%s: is not a regular file, so what is there is not replaced: choose another folder (-o)",
                  path);
    else if (is_log(name) && file_is_locked(path))
        ok = error_set(error, "%s: another process is filming into it", path);
    else
        *past |= strcmp(name, "ticks.jsonl") != 0 || status.st_size > 0;
    free(path);
    return ok;
}

bool replacement_check(const char *folder, octreel_error *error)
{
    bool ok = true, past = false;
    DIR *entries = opendir(folder);
    if (!entries)
        return errno == ENOENT || error_set(error, "%s: the folder cannot be read: %s", folder, strerror(errno));
    for (struct dirent *entry; ok && (entry = readdir(entries));)
        ok = check_entry(folder, entry->d_name, &past, error);
    closedir(entries);
    return ok && (!past || is_recording(folder) || has_recording_aside(folder) ||
                  error_set(error,
                            "%s: what it holds is not replaced, since its recording.json is missing or is no "
                            "recording's: choose another folder (-o)",
                            folder));
}

/* ---- Moved and removed -------------------------------------------------------------------------------------- */

static bool move_one(const char *from, const char *to, const char *name)
{
    char *old = path_join(from, name), *new = path_join(to, name);
    const bool moved = old && new && (rename(old, new) == 0 || errno == ENOENT);
    free(old);
    free(new);
    return moved;
}

/* To null: they are removed. */
static bool take_one(const char *from, const char *to, const char *name)
{
    if (to)
        return move_one(from, to, name);
    char *path = path_join(from, name);
    const bool removed = path && (unlink(path) == 0 || errno == ENOENT);
    free(path);
    return removed;
}

/* Of all files of a recording but its mark. */
static bool take_rest(const char *from, const char *to)
{
    DIR *entries = opendir(from);
    bool ok = entries;
    for (struct dirent *entry; ok && (entry = readdir(entries));)
        if (is_of_recording(entry->d_name) && strcmp(entry->d_name, mark) != 0)
            ok = take_one(from, to, entry->d_name);
    if (entries)
        closedir(entries);
    return ok;
}

static bool put_back(const replacement *r)
{
    return take_rest(r->aside, r->folder) && move_one(r->aside, r->folder, mark);
}

static bool remove_all(const char *folder)
{
    return take_one(folder, NULL, mark) && take_rest(folder, NULL);
}

/* What a process has left that was killed; the folder aside is empty then. Where the new recording has its mark it
 * has begun, and was in its first tick; before that it has but an empty log. */
static bool recover(const replacement *r, octreel_error *error)
{
    bool ok = true;
    if (!is_recording(r->aside))
        ok = remove_all(r->aside);
    else
        ok = (folder_has(r->folder, mark) ? remove_all(r->folder) : take_one(r->folder, NULL, unfinished_mark)) &&
             put_back(r);
    return ok || error_set(error, "%s: what is there cannot be put back: %s", r->aside, strerror(errno));
}

/* ---- Set aside ---------------------------------------------------------------------------------------------- */

static void release(replacement *r)
{
    if (r->aside && r->lock >= 0) {
        rmdir(r->aside);
        close(r->lock);
    }
    free(r->folder);
    free(r->aside);
    *r = (replacement){0};
}

/* Whether the folder that is open is still there: who had it before may have removed it. */
static bool is_there(const replacement *r)
{
    struct stat open, named;
    return fstat(r->lock, &open) == 0 && stat(r->aside, &named) == 0 && is_same_file(&open, &named);
}

static bool make_aside(replacement *r, octreel_error *error)
{
    if (mkdir(r->aside, 0777) != 0 && errno != EEXIST)
        return error_set(error, "%s: the folder cannot be made: %s", r->aside, strerror(errno));
    r->lock = open(r->aside, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (r->lock < 0 && errno != ENOENT)
        return error_set(error, "%s: the folder cannot be opened: %s", r->aside, strerror(errno));
    if (r->lock >= 0 && (flock(r->lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) && is_there(r))
        return true;
    if (r->lock >= 0)
        close(r->lock);
    r->lock = -1;
    return error_set(error, "%s: another process is replacing the recording", r->folder);
}

static bool set_aside(replacement *r, octreel_error *error)
{
    if (move_one(r->folder, r->aside, mark) && take_rest(r->folder, r->aside))
        return true;
    error_set(error, "%s: what is there cannot be replaced: %s", r->folder, strerror(errno));
    put_back(r);
    return false;
}

bool replacement_begin(replacement *r, const char *folder, octreel_error *error)
{
    *r = (replacement){.folder = strdup(folder), .aside = path_join(folder, FOLDER_ASIDE), .lock = -1};
    bool ok = (r->folder && r->aside) || error_no_memory(error);
    ok = ok && folder_make(folder, error) && replacement_check(folder, error);
    ok = ok && make_aside(r, error) && replacement_check(folder, error); /* others may have been faster */
    ok = ok && recover(r, error) && set_aside(r, error);
    if (!ok)
        release(r);
    return ok;
}

void replacement_end(replacement *r)
{
    if (r->aside)
        remove_all(r->aside);
    release(r);
}

bool replacement_undo(replacement *r)
{
    const bool set = r->aside;
    if (set && remove_all(r->folder))
        put_back(r);
    release(r);
    return set;
}

void replacement_sweep(const char *folder)
{
    char *aside = path_join(folder, FOLDER_ASIDE);
    if (aside && folder_has(folder, FOLDER_ASIDE) && remove_all(aside))
        rmdir(aside);
    free(aside);
}
