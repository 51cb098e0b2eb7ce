/* SPDX-License-Identifier: MIT */
/* replacement.c - replaces the recording in a folder by a new one (octreel record --replace).
 *
 * The problem: if the new recording fails at its first tick, or the process is killed at any moment, the old recording
 * must survive. A recording has thousands of files, and no system call renames or removes them all at once.
 *
 * The idea: one file, recording.json, decides whether a folder has a recording; it is called the mark here. The old
 * files are moved into a folder inside the folder (FOLDER_ASIDE), and the mark is moved first. When tick 0 of the new
 * recording is filmed, the old files are removed, and the mark is removed first. If the new recording fails instead,
 * the old files are moved back, and the mark is moved last.
 *
 * The recovery after a crash therefore needs to look only for a mark in the folder aside. If there is a mark, all old
 * files exist, and those in the folder aside are moved back. If there is no mark, the old files were being removed or
 * have all been moved back, and the leftover files are removed. The next replacement begins with this recovery. A lock
 * on the folder aside prevents two processes from replacing at the same time. */
#include "replacement.h"
#include "frame_file.h"
#include "tick_log.h"

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

static bool is_ticks_file_name(const char *name)
{
    uint64_t first, last;
    return strcmp(name, "ticks.jsonl") == 0 || chunk_parse_name(name, &first, &last);
}

static bool is_frame_name(const char *name)
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

/* Returns whether a recording uses this file name. Returns false for FOLDER_ASIDE, which is the name of a folder. */
static bool is_recording_file(const char *name)
{
    if (strncmp(name, "frame_", 6) == 0)
        return is_frame_name(name);
    return strcmp(name, FOLDER_ASIDE) != 0 && (folder_is_recording_file(name) || folder_is_unfinished_file(name));
}

/* ---- Checks ------------------------------------------------------------------------------------------------- */

static bool has_recording(const char *folder)
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
    const bool has = aside && has_recording(aside);
    free(aside);
    return has;
}

/* Check one entry of a folder. Sets *past to true if the entry is a file that a recording writes only after its start.
 * A recording that was killed at its start leaves at most an empty ticks.jsonl. */
static bool check_entry(const char *folder, const char *name, bool *past, octreel_error *error)
{
    struct stat status;
    if (!is_recording_file(name))
        return !folder_is_recording_file(name) || strcmp(name, FOLDER_ASIDE) == 0 ||
               error_set(error,
                         "%s/%s: has the name of a recording's file, but is not a file of a recording; move it away, "
                         "or choose "
                         "another folder (-o)",
                         folder, name);
    char *path = path_join(folder, name);
    if (!path)
        return error_no_memory(error);
    bool ok = lstat(path, &status) == 0 && S_ISREG(status.st_mode);
    if (!ok)
        error_set(error, "%s: not a regular file; cannot replace it; choose another folder (-o)", path);
    else if (is_ticks_file_name(name) && file_is_locked(path))
        ok = error_set(error, "%s: another process is recording into this folder", path);
    else
        *past |= strcmp(name, "ticks.jsonl") != 0 || status.st_size > 0;
    free(path);
    return ok;
}

bool replacement_check(const char *folder, octreel_error *error)
{
    bool ok = true, past = false;
    char **names = folder_names(folder, error);
    if (!names)
        return errno == ENOENT;
    for (size_t i = 0; ok && names[i]; i++)
        ok = check_entry(folder, names[i], &past, error);
    free(names);
    return ok && (!past || has_recording(folder) || has_recording_aside(folder) ||
                  error_set(error,
                            "%s: cannot replace its files: recording.json is missing or belongs to another "
                            "program; choose another folder (-o)",
                            folder));
}

/* ---- Moving and removing ------------------------------------------------------------------------------------ */

static bool move_file(const char *from, const char *to, const char *name)
{
    char *old = path_join(from, name), *new = path_join(to, name);
    const bool moved = old && new && (rename(old, new) == 0 || errno == ENOENT);
    free(old);
    free(new);
    return moved;
}

/* Move a file from one folder to another; if `to` is null, remove the file. A missing file is not an error. */
static bool move_or_remove(const char *from, const char *to, const char *name)
{
    if (to)
        return move_file(from, to, name);
    char *path = path_join(from, name);
    const bool removed = path && (unlink(path) == 0 || errno == ENOENT);
    free(path);
    return removed;
}

/* Move or remove all files of a recording except recording.json. */
static bool move_or_remove_all_but_mark(const char *from, const char *to)
{
    octreel_error ignored;
    char **names = folder_names(from, &ignored);
    bool ok = names;
    for (size_t i = 0; ok && names[i]; i++)
        if (is_recording_file(names[i]) && strcmp(names[i], mark) != 0)
            ok = move_or_remove(from, to, names[i]);
    free(names);
    return ok;
}

static bool restore_old_recording(const replacement *r)
{
    return move_or_remove_all_but_mark(r->aside, r->folder) && move_file(r->aside, r->folder, mark);
}

static bool remove_recording(const char *folder)
{
    return move_or_remove(folder, NULL, mark) && move_or_remove_all_but_mark(folder, NULL);
}

/* Empty the folder FOLDER_ASIDE if a killed process left files in it. If the outer folder has a recording.json, the
 * process was killed during the first tick of the new recording, which is removed. Otherwise the new recording has at
 * most an empty ticks.jsonl and an unfinished recording.json. */
static bool recover_from_crash(const replacement *r, octreel_error *error)
{
    bool ok = true;
    if (!has_recording(r->aside))
        ok = remove_recording(r->aside);
    else
        ok = (folder_contains(r->folder, mark) ? remove_recording(r->folder)
                                               : move_or_remove(r->folder, NULL, unfinished_mark)) &&
             restore_old_recording(r);
    return ok || error_set(error, "%s: cannot move the old recording back: %s", r->aside, strerror(errno));
}

/* ---- Set aside ---------------------------------------------------------------------------------------------- */

static void release_replacement(replacement *r)
{
    if (r->aside && r->lock >= 0) {
        rmdir(r->aside);
        close(r->lock);
    }
    free(r->folder);
    free(r->aside);
    *r = (replacement){0};
}

/* Returns true if the name FOLDER_ASIDE still belongs to the folder that was opened. Before this process got the lock,
 * the process that held the lock may have removed the folder. */
static bool is_aside_folder_unchanged(const replacement *r)
{
    struct stat open, named;
    return fstat(r->lock, &open) == 0 && stat(r->aside, &named) == 0 && is_same_file(&open, &named);
}

static bool create_aside_folder(replacement *r, octreel_error *error)
{
    if (mkdir(r->aside, 0777) != 0 && errno != EEXIST)
        return error_set(error, "%s: cannot create the folder: %s", r->aside, strerror(errno));
    r->lock = open(r->aside, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (r->lock < 0 && errno != ENOENT)
        return error_set(error, "%s: cannot open the folder: %s", r->aside, strerror(errno));
    if (r->lock >= 0 && (flock(r->lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
        is_aside_folder_unchanged(r))
        return true;
    if (r->lock >= 0)
        close(r->lock);
    r->lock = -1;
    return error_set(error, "%s: another process is replacing the recording", r->folder);
}

static bool move_recording_aside(replacement *r, octreel_error *error)
{
    if (move_file(r->folder, r->aside, mark) && move_or_remove_all_but_mark(r->folder, r->aside))
        return true;
    error_set(error, "%s: cannot move the old recording aside: %s", r->folder, strerror(errno));
    restore_old_recording(r);
    return false;
}

bool replacement_begin(replacement *r, const char *folder, octreel_error *error)
{
    *r = (replacement){.folder = strdup(folder), .aside = path_join(folder, FOLDER_ASIDE), .lock = -1};
    bool ok = (r->folder && r->aside) || error_no_memory(error);
    ok = ok && folder_create(folder, error) && replacement_check(folder, error);
    /* check again, because another process may have changed the folder before this process had the lock */
    ok = ok && create_aside_folder(r, error) && replacement_check(folder, error);
    ok = ok && recover_from_crash(r, error) && move_recording_aside(r, error);
    if (!ok)
        release_replacement(r);
    return ok;
}

void replacement_remove_old(replacement *r)
{
    if (r->aside)
        remove_recording(r->aside);
    release_replacement(r);
}

bool replacement_undo(replacement *r)
{
    const bool set = r->aside;
    if (set && remove_recording(r->folder))
        restore_old_recording(r);
    release_replacement(r);
    return set;
}

void replacement_remove_leftovers(const char *folder)
{
    char *aside = path_join(folder, FOLDER_ASIDE);
    if (aside && folder_contains(folder, FOLDER_ASIDE) && remove_recording(aside))
        rmdir(aside);
    free(aside);
}
