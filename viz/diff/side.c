/* SPDX-License-Identifier: MIT */
/* side.c - opens a side of a comparison and lists its frames. */
#include "side.h"
#include "baseline.h"
#include "file_kind.h"
#include "frame_file.h"
#include "recording_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *diff_kind_name(diff_kind kind)
{
    static const char *const names[] = {
        [DIFF_PICTURE] = "picture",
        [DIFF_FOLDER] = "folder",
        [DIFF_RECORDING] = "recording",
        [DIFF_BASELINE] = "baseline",
    };
    return names[kind];
}

/* Return the part of a path after the last slash, or "stdin" for standard input. */
static const char *display_base_name(const char *path)
{
    return file_is_standard_stream(path) ? "stdin" : path_base_name(path);
}

static bool is_frame_name(const diff_side *side, const char *name)
{
    uint64_t tick;
    if (side->kind == DIFF_RECORDING)
        return frame_parse_name(name, &tick);
    return name[diff_stem_length(name)];
}

/* Return whether recording.json says that the recording was made without frames. If recording.json cannot be read,
 * return false. The error is reported later, when the recording is explained. */
static bool is_without_frames(const diff_side *side)
{
    octreel_error ignored;
    uint64_t every = 1;
    view v;
    return side->kind == DIFF_RECORDING && recording_read(side->path, &v, &every, &ignored) && every == 0;
}

bool diff_is_evidence_folder(const char *folder)
{
    char text[sizeof EVIDENCE_MARKER_BEGINNING - 1], reason[FILE_REASON], *path = path_join(folder, EVIDENCE_MARKER);
    FILE *file = path ? file_open(path, NULL, reason) : NULL;
    const bool is = file && fread(text, 1, sizeof text, file) == sizeof text &&
                    memcmp(text, EVIDENCE_MARKER_BEGINNING, sizeof text) == 0;
    if (file)
        fclose(file);
    free(path);
    return is;
}

static bool is_folder_left_out(const diff_search *search, const char *folder, const struct stat *status)
{
    struct stat other;
    for (size_t i = 0; i < sizeof search->left_out / sizeof search->left_out[0]; i++)
        if (search->left_out[i] && stat(search->left_out[i], &other) == 0 && is_same_file(status, &other))
            return true;
    return diff_is_evidence_folder(folder);
}

static bool add_frames_of_folder(diff_side *side, const diff_search *search, const char *below, octreel_error *error);

/* Add a frame, or the frames of a subfolder. A frame whose file was removed after its name was read is added, too,
 * and is later reported as unreadable. */
static bool add_entry(diff_side *side, const diff_search *search, const char *name, octreel_error *error)
{
    const bool flat = search->flat || side->kind == DIFF_RECORDING;
    struct stat status = {0};
    char *path = path_join(side->path, name);
    bool ok = path || error_no_memory(error);
    if (ok && !flat && lstat(path, &status) != 0 && errno != ENOENT)
        ok = error_set(error, "%s: %s", path, strerror(errno));
    else if (ok && S_ISDIR(status.st_mode))
        ok = is_folder_left_out(search, path, &status) || add_frames_of_folder(side, search, name, error);
    else if (ok && is_frame_name(side, name))
        ok = diff_side_add_frame(side, name, (frame_digest){0}, error);
    free(path);
    return ok;
}

/* Add the frames of one folder: the folder of the side if `below` is "", else the subfolder `below`. */
static bool add_frames_of_folder(diff_side *side, const diff_search *search, const char *below, octreel_error *error)
{
    char *path = *below ? path_join(side->path, below) : strdup(side->path);
    char **names = path ? folder_names(path, error) : NULL;
    bool ok = names || (!path && error_no_memory(error));
    for (size_t i = 0; ok && names[i]; i++) {
        if (names[i][0] == '.')
            continue;
        char *name = path_join(below, names[i]);
        ok = name ? add_entry(side, search, name, error) : error_no_memory(error);
        free(name);
    }
    free(names);
    free(path);
    return ok;
}

static bool read_folder(diff_side *side, const diff_search *search, octreel_error *error)
{
    side->kind = folder_contains(side->path, "recording.json") ? DIFF_RECORDING : DIFF_FOLDER;
    side->no_frames = is_without_frames(side);
    if (!side->no_frames && !add_frames_of_folder(side, search, "", error))
        return false;
    diff_side_sort_frames(side);
    return true;
}

static bool read_file(diff_side *side, octreel_error *error)
{
    switch (file_kind_of_input(side->source)) {
    case KIND_PNG:
        side->kind = DIFF_PICTURE;
        return diff_side_add_frame(side, display_base_name(side->source), (frame_digest){0}, error);
    case KIND_BASELINE:
        return baseline_read(side, error);
    default:
        if (!file_is_standard_stream(side->source) && access(side->path, R_OK) != 0)
            return error_set(error, "%s: %s", side->path, strerror(errno));
        return error_set(error, "%s: not a PNG file, a folder, or a baseline", side->path);
    }
}

bool diff_side_open(diff_side *side, const char *path, const diff_search *search, octreel_error *error)
{
    static const diff_search everything = {false, {NULL}};
    struct stat status;
    bool ok;
    *side = (diff_side){.path = file_display_name(path), .source = path};
    if (file_is_standard_stream(path))
        ok = read_file(side, error);
    else if (stat(path, &status) != 0)
        ok = error_set(error, "%s: %s", path, strerror(errno));
    else if (S_ISDIR(status.st_mode))
        ok = read_folder(side, search ? search : &everything, error);
    else if (S_ISREG(status.st_mode))
        ok = read_file(side, error);
    else
        ok = error_set(error, "%s: neither a file nor a folder", path);
    if (!ok)
        diff_side_release(side);
    return ok;
}
