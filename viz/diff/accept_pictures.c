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
    file_writer copy; /* the complete copy, NAME.part, which is not renamed yet */
    char *path;       /* its final name; owned */
} set_file;

typedef struct file_set {
    set_file *files;
    size_t count, room;
} file_set;

/* Copy a file to NAME.part beside its final path. The set takes ownership of `path`; null: out of memory. */
static bool set_aside(file_set *set, const char *from, char *path, octreel_error *error)
{
    set_file *grown = path ? array_reserve(set->files, set->count + 1, &set->room, sizeof *grown) : NULL;
    if (!grown) {
        free(path);
        return error_no_memory(error);
    }
    set->files = grown;
    set_file *file = &grown[set->count];
    file->path = path;
    if (file_copy_prepare(&file->copy, from, path, error)) {
        set->count++;
        return true;
    }
    free(path);
    return false;
}

static bool put_in_place(file_set *set, octreel_error *error)
{
    for (size_t i = 0; i < set->count; i++)
        if (!file_writer_place(&set->files[i].copy, error))
            return false;
    return true;
}

/* Remove the copies that were not renamed. */
static void release(file_set *set)
{
    for (size_t i = 0; i < set->count; i++) {
        file_writer_abandon(&set->files[i].copy);
        free(set->files[i].path);
    }
    free(set->files);
}

/* ---- The files ----------------------------------------------------------------------------------------------- */

static char *place_of(const accepting *a, const diff_pair *pair)
{
    if (pair->a)
        return strdup(pair->a->path);
    return a->reference.kind == DIFF_PICTURE ? strdup(a->reference.path) : path_join(a->reference.path, pair->b->name);
}

static bool write_pictures(const accepting *a, file_set *set, octreel_error *error)
{
    for (size_t i = 0; i < a->result.count; i++) {
        const diff_pair *pair = &a->result.pairs[i];
        if ((a->actions[i] == CHANGED || a->actions[i] == ADDED) &&
            !set_aside(set, pair->b->path, place_of(a, pair), error))
            return false;
    }
    return true;
}

static bool copy_fact(const accepting *a, const char *name, file_set *set, octreel_error *error)
{
    char *from = path_join(a->frames.path, name), *to = path_join(a->reference.path, name);
    bool ok = (from && to) || error_no_memory(error);
    if (ok && access(from, F_OK) == 0 && !have_same_bytes(from, to)) {
        ok = set_aside(set, from, to, error);
        to = NULL;
    }
    free(from);
    free(to);
    return ok;
}

/* Add the other files of a recording, which describe its frames, and the frames with equal pixels, since their text
 * chunks may name another session. */
static bool write_facts(const accepting *a, file_set *set, octreel_error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && i < a->result.count; i++)
        if (a->result.pairs[i].finding == FOUND_SAME_PIXELS)
            ok = copy_fact(a, diff_pair_name(&a->result.pairs[i]), set, error);
    for (size_t i = 0; ok && folder_file_name(i); i++)
        ok = copy_fact(a, folder_file_name(i), set, error);
    return ok;
}

/* ---- Replacing ----------------------------------------------------------------------------------------------- */

static bool remove_gone(const accepting *a, octreel_error *error)
{
    for (size_t i = 0; i < a->result.count; i++) {
        const diff_pair *pair = &a->result.pairs[i];
        if (a->actions[i] == REMOVED && remove(pair->a->path) != 0)
            return error_set(error, "%s: cannot be removed: %s", pair->a->path, strerror(errno));
    }
    return true;
}

static bool replace_files(const accepting *a, octreel_error *error)
{
    file_set set = {0};
    const bool facts = a->reference.kind == DIFF_RECORDING && a->options->names->count == 0;
    const bool ok = write_pictures(a, &set, error) && (!facts || write_facts(a, &set, error)) &&
                    put_in_place(&set, error) && remove_gone(a, error);
    release(&set);
    return ok;
}

bool accept_pictures(accepting *a, octreel_error *error)
{
    const bool makes = a->is_new && a->reference.kind != DIFF_PICTURE;
    if (makes && !folder_prepare(a->reference.path, error))
        return false;
    const bool ok = replace_files(a, error);
    if (!ok && makes)
        rmdir(a->reference.path); /* unless something is in it */
    return ok;
}
