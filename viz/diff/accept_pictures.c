/* SPDX-License-Identifier: MIT */
/* accept_pictures.c - replaces the pictures of a reference: all of them, or none if an error occurs. */
#include "accepting.h"
#include "array.h"
#include "file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- A set of files that is replaced together ---------------------------------------------------------------- */

typedef struct set_file {
    file_writer copy; /* a complete copy that is named NAME.part until it is renamed */
    char *path;       /* the final name of the copy; owned */
} set_file;

typedef struct file_set {
    set_file *files;
    size_t count, room;
} file_set;

/* Copy the file `from` into the folder of its final path, with the name NAME.part. The set takes ownership of
 * `path`. If `path` is null, the caller ran out of memory, and the function reports this. */
static bool prepare_copy(file_set *set, const char *from, char *path, octreel_error *error)
{
    const bool room = path && array_grow(&set->files, set->count + 1, &set->room, sizeof *set->files);
    if (room ? file_copy_prepare(&set->files[set->count].copy, from, path, error) : error_no_memory(error)) {
        set->files[set->count++].path = path;
        return true;
    }
    free(path);
    return false;
}

static bool rename_copies_to_references(file_set *set, octreel_error *error)
{
    for (size_t i = 0; i < set->count; i++)
        if (!file_writer_rename(&set->files[i].copy, error))
            return false;
    return true;
}

/* Remove the copies that were not renamed. */
static void release_set(file_set *set)
{
    for (size_t i = 0; i < set->count; i++) {
        file_writer_discard(&set->files[i].copy);
        free(set->files[i].path);
    }
    free(set->files);
}

/* ---- The files ----------------------------------------------------------------------------------------------- */

static char *make_final_path(const accepting *a, const diff_pair *pair)
{
    if (pair->a)
        return strdup(pair->a->path);
    return a->reference.kind == DIFF_PICTURE ? strdup(a->reference.path) : path_join(a->reference.path, pair->b->name);
}

/* Prepare a copy of a file of the recording. If the recording has no such file, or the file of the reference has the
 * same bytes, do nothing. */
static bool prepare_recording_file(const accepting *a, const char *name, file_set *set, octreel_error *error)
{
    char *from = path_join(a->frames.path, name), *to = path_join(a->reference.path, name);
    bool ok = (from && to) || error_no_memory(error);
    if (ok && access(from, F_OK) == 0 && !have_same_bytes(from, to)) {
        ok = prepare_copy(set, from, to, error);
        to = NULL;
    }
    free(from);
    free(to);
    return ok;
}

/* Prepare copies of all files that change. If a whole recording is accepted, also copy the files that describe its
 * frames. In this case, also copy frames with equal pixels, because their text chunks may name another session. */
static bool prepare_copies(const accepting *a, file_set *set, octreel_error *error)
{
    const bool whole = a->reference.kind == DIFF_RECORDING && a->options->names->count == 0;
    bool ok = true;
    for (size_t i = 0; ok && i < a->result.count; i++) {
        const diff_pair *pair = &a->result.pairs[i];
        if (a->actions[i] == CHANGED || a->actions[i] == ADDED)
            ok = (a->reference.kind == DIFF_PICTURE ||
                  folder_create_parents(a->reference.path, diff_pair_name(pair), error)) &&
                 prepare_copy(set, pair->b->path, make_final_path(a, pair), error);
        else if (whole && pair->finding == FOUND_SAME_PIXELS)
            ok = prepare_recording_file(a, diff_pair_name(pair), set, error);
    }
    for (size_t i = 0; ok && whole && recording_files[i]; i++)
        ok = prepare_recording_file(a, recording_files[i], set, error);
    return ok;
}

/* ---- Replacing ----------------------------------------------------------------------------------------------- */

/* Remove each reference that has no new frame, then the subfolders that became empty. */
static bool remove_references(const accepting *a, octreel_error *error)
{
    for (size_t i = 0; i < a->result.count; i++) {
        const diff_pair *pair = &a->result.pairs[i];
        if (a->actions[i] != REMOVED)
            continue;
        if (remove(pair->a->path) != 0)
            return error_set(error, "%s: cannot be removed: %s", pair->a->path, strerror(errno));
        folder_remove_empty_parents(a->reference.path, pair->a->name);
    }
    return true;
}

/* After a failed change, remove the empty subfolders that it created. */
static void remove_new_folders(const accepting *a)
{
    for (size_t i = 0; i < a->result.count; i++)
        if (a->actions[i] == ADDED && a->reference.kind != DIFF_PICTURE)
            folder_remove_empty_parents(a->reference.path, diff_pair_name(&a->result.pairs[i]));
}

static bool replace_files(const accepting *a, octreel_error *error)
{
    file_set set = {0};
    const bool ok =
        prepare_copies(a, &set, error) && rename_copies_to_references(&set, error) && remove_references(a, error);
    release_set(&set);
    if (!ok)
        remove_new_folders(a);
    return ok;
}

bool accept_pictures(accepting *a, octreel_error *error)
{
    const bool makes = a->is_new && a->reference.kind != DIFF_PICTURE;
    if (makes && !folder_create_for_recording(a->reference.path, error))
        return false;
    const bool ok = replace_files(a, error);
    if (!ok && makes)
        rmdir(a->reference.path); /* this call fails if the folder is not empty */
    return ok;
}
