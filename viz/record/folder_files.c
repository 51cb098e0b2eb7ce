/* SPDX-License-Identifier: MIT */
/* folder_files.c - writes session.json, recording.json and renderer.json, and checks whether a partial recording in a
 * folder may be resumed. */
#include "folder_files.h"
#include "frame_file.h"
#include "png_write.h"
#include "json_write.h"
#include "octree/digest.h"
#include "recording_file.h"
#include "text.h"

#include <errno.h>
#include <jansson.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Shared ------------------------------------------------------------------------------------------------ */

/* Set *same to true if the file contains exactly these bytes. Returns false with an error if the file cannot be read.
 */
static bool compare_file(const char *path, const char *bytes, size_t size, bool *same, octreel_error *error)
{
    char *there;
    size_t there_size;
    if (!file_read_whole(path, &there, &there_size, error))
        return false;
    *same = there_size == size && memcmp(there, bytes, size) == 0;
    free(there);
    return true;
}

/* Rename a finished file from `own` to `path`, unless another process has created `path` first. link() is used because
 * rename() would replace the other process's file. On a file system without links, the last process to rename wins; the
 * file that it leaves is complete. */
static bool rename_unless_exists(const char *own, const char *path, octreel_error *error)
{
    if (link(own, path) == 0 || errno == EEXIST) {
        remove(own);
        return true;
    }
    if (rename(own, path) == 0)
        return true;
    error_set(error, "%s: cannot be written: %s", path, strerror(errno));
    remove(own);
    return false;
}

/* Write a file under a temporary name that only this process uses. Then rename it to `path`, unless another process has
 * created `path`. */
static bool write_unless_exists(const folder_place *place, const char *name, const char *path, const char *bytes,
                                size_t size, octreel_error *error)
{
    char own_name[NAME_MAX + 1];
    snprintf(own_name, sizeof own_name, "%s.%s", name, place->writer);
    char *own = path_join(place->folder, own_name);
    bool ok = own ? folder_write_file(place->folder, own_name, bytes, size, error) : error_no_memory(error);
    ok = ok && rename_unless_exists(own, path, error);
    free(own);
    return ok;
}

/* Write a file unless it exists. If it exists with other bytes, fail with the error text `unlike`; if `unlike` is null,
 * accept any bytes in the existing file. */
static bool write_or_compare_file(const folder_place *place, const char *name, const char *bytes, size_t size,
                                  const char *unlike, octreel_error *error)
{
    bool same = true;
    char *path = path_join(place->folder, name);
    if (!path)
        return error_no_memory(error);
    const bool there = access(path, F_OK) == 0;
    bool ok = there || place->dry_run || write_unless_exists(place, name, path, bytes, size, error);
    ok = ok && ((!there && place->dry_run) || compare_file(path, bytes, size, &same, error)) &&
         (same || !unlike || error_set(error, "%s: %s", path, unlike));
    free(path);
    return ok;
}

static bool write_file(const folder_place *place, const char *name, const char *bytes, size_t size, const char *unlike,
                       octreel_error *error)
{
    return place->writer || place->dry_run ? write_or_compare_file(place, name, bytes, size, unlike, error)
                                           : folder_write_file(place->folder, name, bytes, size, error);
}

/* ---- Writing ------------------------------------------------------------------------------------------------ */

bool make_session_bytes(const octree_session *session, const point_values *values, session_bytes *made,
                        octreel_error *error)
{
    text_stream s;
    char *bytes;
    if (text_stream_begin(&s))
        session_write(session, values, s.stream);
    if (!text_stream_end(&s, &bytes))
        return error_no_memory(error);
    *made = (session_bytes){bytes, s.size, octree_digest_bytes(OCTREE_DIGEST_START, bytes, s.size)};
    return true;
}

bool write_session_file(const folder_place *place, const session_bytes *session, octreel_error *error)
{
    return write_file(place, "session.json", session->bytes, session->size,
                      "is another session, or was changed by hand", error);
}

/* End a text stream and write its text to a file. */
static bool write_stream(const folder_place *place, const char *name, text_stream *s, const char *unlike,
                         octreel_error *error)
{
    char *bytes;
    if (!text_stream_end(s, &bytes))
        return error_no_memory(error);
    const bool ok = write_file(place, name, bytes, s->size, unlike, error);
    free(bytes);
    return ok;
}

bool write_recording_file(const folder_place *place, const view *v, uint64_t every, octreel_error *error)
{
    text_stream s;
    if (text_stream_begin(&s))
        recording_write(s.stream, v, every);
    return write_stream(
        place, "recording.json", &s,
        "has another view (size, camera, layers, every ...), or was written by another version of octreel", error);
}

static void write_text_line(json_writer *w, const char *key, const char *text)
{
    json_start_new_line(w);
    json_write_text_member(w, key, text);
}

bool write_renderer_file(const folder_place *place, const renderer_info *info, octreel_error *error)
{
    char library[IMAGE_LIBRARY_TEXT];
    text_stream s;
    if (!text_stream_begin(&s))
        return error_no_memory(error);
    json_writer writer = {.out = s.stream}, *w = &writer;
    json_write_begin_object(w);
    write_text_line(w, "context", info->context);
    write_text_line(w, "vendor", info->vendor);
    write_text_line(w, "renderer", info->renderer);
    write_text_line(w, "version", info->version);
    write_text_line(w, "fill", info->fill);
    write_text_line(w, "png", image_print_library_versions(library));
    json_start_new_line(w);
    json_write_end_object(w);
    json_write_end_line(w);
    return write_stream(place, "renderer.json", &s, NULL, error);
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

char *describe_renderer(const renderer_info *info, char *text, size_t size)
{
    enum { LONGEST = 100 }; /* maximum number of characters of each string */
    const bool by_gl = !info->fill || strcmp(info->fill, draw_fill_name(DRAW_FILL_GL)) == 0;
    const char *const words[] = {by_gl ? NULL : "the integer rasterizer", info->context, info->renderer, info->version};
    size_t length = 0;
    snprintf(text, size, "an unknown renderer");
    for (size_t i = 0; i < sizeof words / sizeof words[0] && length < size; i++)
        if (words[i])
            length += (size_t)snprintf(text + length, size - length, "%s%.*s", length ? ", " : "", LONGEST, words[i]);
    return make_printable(text);
}

static const char *get_json_text(const json_t *object, const char *key)
{
    return json_string_value(json_object_get(object, key));
}

char *describe_recorded_renderer(const char *folder, char *text, size_t size)
{
    enum { LARGEST = 1 << 16 }; /* maximum file size in bytes: 100 times the size that octreel writes */
    char reason[FILE_REASON], *path = path_join(folder, "renderer.json");
    uint64_t bytes = 0;
    FILE *file = path ? file_open(path, &bytes, reason) : NULL;
    json_t *object = file && bytes <= LARGEST ? json_loadf(file, 0, NULL) : NULL;
    const renderer_info info = {.context = get_json_text(object, "context"),
                                .renderer = get_json_text(object, "renderer"),
                                .version = get_json_text(object, "version"),
                                .fill = get_json_text(object, "fill")};
    describe_renderer(&info, text, size);
    json_decref(object);
    if (file)
        fclose(file);
    free(path);
    return text;
}

/* ---- Resuming ----------------------------------------------------------------------------------------------- */

static bool is_empty_file(const char *folder, const char *name)
{
    struct stat status;
    char *path = path_join(folder, name);
    const bool empty = path && stat(path, &status) == 0 && S_ISREG(status.st_mode) && status.st_size == 0;
    free(path);
    return empty;
}

/* Returns whether a file with this name proves that a recording reached its first tick. A recording that was killed
 * earlier leaves at most recording.json, session.json and an empty ticks.jsonl. */
static bool is_written_after_start(const char *folder, const char *name)
{
    return folder_is_recording_file(name) && !folder_is_unfinished_file(name) && strcmp(name, "recording.json") != 0 &&
           strcmp(name, "session.json") != 0 && !(strcmp(name, "ticks.jsonl") == 0 && is_empty_file(folder, name));
}

/* Check that session.json.live, which a killed process left in the folder, contains the session with this digest. */
static bool check_live_session(const char *folder, uint64_t session_digest, octreel_error *error)
{
    session_file file;
    session_bytes made = {0};
    if (!read_live_session(folder, &file, error))
        return false;
    bool ok = make_session_bytes(&file.session, &file.values, &made, error);
    ok = ok && (made.digest == session_digest || error_set(error, "%s/session.json.live: is another session", folder));
    free(made.bytes);
    session_release(&file);
    return ok;
}

/* Check that the folder contains recording.json and session.json. The caller must list the folder before this check:
 * another process that has just begun a recording writes these two files first, so a listed file of this process passes
 * the check. `past` is a listed file that a recording writes only after its start. */
static bool check_recorded_start(const char *folder, const char *past, uint64_t session_digest, octreel_error *error)
{
    const bool view = folder_contains(folder, "recording.json"), session = folder_contains(folder, "session.json");
    if (view && !session && folder_contains(folder, "session.json.live"))
        return check_live_session(folder, session_digest, error);
    return (view && session) ||
           error_set(error, "%s: cannot resume: %s is there, but %s is missing; choose another folder", folder, past,
                     view ? "session.json" : "recording.json");
}

/* Check the session digest in the folder's first frame; the other frames are not read. A frame without a digest is
 * accepted, because the frame may be torn, or saved by an image editor. Digest 0 is accepted too: a program that
 * records itself writes 0 until its session is complete, and the program may have been killed before. */
static bool check_session_of_first_frame(const char *folder, const char *frame, uint64_t session_digest,
                                         octreel_error *error)
{
    uint64_t tick, session;
    return !frame_parse_name(frame, &tick) || !frame_read_session_digest(folder, tick, &session) || session == 0 ||
           session == session_digest ||
           error_set(error,
                     "%s/%s: shows another session than session.json; restore the original session.json, or choose "
                     "another folder",
                     folder, frame);
}

bool check_resumable(const char *folder, uint64_t session_digest, uint64_t ticks, uint64_t every, octreel_error *error)
{
    /* The first file name that is_written_after_start() accepts, and the first name of a frame. */
    const char *past = NULL, *frame = "";
    char **names = folder_names(folder, error);
    bool ok = names;
    for (size_t i = 0; ok && names[i]; i++) {
        if (!is_written_after_start(folder, names[i]))
            continue;
        past = past ? past : names[i];
        if (strncmp(names[i], "frame_", 6) != 0)
            continue;
        frame = *frame ? frame : names[i];
        if (!frame_is_name_of_recording(names[i], ticks, every))
            ok = error_set(error, "%s/%s: not a frame of this recording; remove it, or choose another folder", folder,
                           names[i]);
    }
    ok = ok && (!past || (check_recorded_start(folder, past, session_digest, error) &&
                          check_session_of_first_frame(folder, frame, session_digest, error)));
    free(names);
    return ok;
}
