/* folder_files.c - see folder_files.h. */
#include "folder_files.h"
#include "image.h"
#include "json_write.h"
#include "octree/digest.h"
#include "view_file.h"
#include "whole_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A stream into memory that becomes a file of the folder. */
typedef struct memory_file {
    FILE *stream;
    char *bytes;
    size_t size;
} memory_file;

static bool begin_file(memory_file *file, record_error *error)
{
    *file = (memory_file){0};
    file->stream = open_memstream(&file->bytes, &file->size);
    return file->stream || record_fail(error, "there is no memory");
}

/* `unlike` is said of a file that is there with other bytes; null: those are as good. */
static bool put_file(const memory_file *file, const folder_place *place, const char *name, const char *unlike,
                     record_error *error)
{
    bool same;
    if (!place->writer)
        return folder_write(place->folder, name, file->bytes, file->size, error);
    if (!folder_write_once(place->folder, name, place->writer, file->bytes, file->size, &same, error))
        return false;
    return same || !unlike || record_fail(error, "%s/%s: %s", place->folder, name, unlike);
}

static bool end_file(memory_file *file, const folder_place *place, const char *name, const char *unlike,
                     record_error *error)
{
    const bool whole = !ferror(file->stream);
    const bool closed = fclose(file->stream) == 0;
    const bool ok = whole && closed ? put_file(file, place, name, unlike, error)
                                    : record_fail(error, "there is no memory for %s", name);
    free(file->bytes);
    return ok;
}

bool write_session_file(const folder_place *place, const octree_session *session, uint64_t *digest, record_error *error)
{
    memory_file file;
    if (!begin_file(&file, error))
        return false;
    session_write(session, file.stream);
    fflush(file.stream);
    *digest = octree_digest_bytes(OCTREE_DIGEST_START, file.bytes, file.size);
    return end_file(&file, place, "session.json", "is another session, or was changed by hand", error);
}

/* That of octree_digest_bytes(), piece by piece: a session may be large. */
static uint64_t digest_stream(FILE *in)
{
    unsigned char bytes[1 << 13];
    uint64_t digest = OCTREE_DIGEST_START, size = 0;
    size_t got;
    while ((got = fread(bytes, 1, sizeof bytes, in)) > 0) {
        size += got;
        for (size_t i = 0; i < got; i += 8) {
            uint64_t word = 0;
            for (size_t j = 0; j < 8 && i + j < got; j++)
                word |= (uint64_t)bytes[i + j] << (8 * j);
            digest = octree_digest_word(digest, word);
        }
    }
    return octree_digest_word(digest, size);
}

bool digest_session_file(const char *path, uint64_t *digest, record_error *error)
{
    FILE *in = fopen(path, "rb");
    if (!in)
        return record_fail(error, "%s: cannot be opened: %s", path, strerror(errno));
    *digest = digest_stream(in);
    const bool ok = !ferror(in);
    fclose(in);
    return ok || record_fail(error, "%s: cannot be read", path);
}

bool read_session_file(const char *folder, session_file *file, uint64_t *digest, record_error *error)
{
    char reason[WHOLE_FILE_REASON], *bytes, *path = folder_path(folder, "session.json");
    session_error unread;
    size_t size;
    if (!path)
        return record_fail(error, "there is no memory");
    bool ok = whole_file_read(path, &bytes, &size, reason) || record_fail(error, "%s: %s", path, reason);
    if (ok) {
        *digest = octree_digest_bytes(OCTREE_DIGEST_START, bytes, size);
        ok = session_parse(path, folder, bytes, size, file, &unread) || record_fail(error, "%s", unread.text);
        free(bytes);
    }
    free(path);
    return ok;
}

bool read_live_session(const char *folder, session_file *file, record_error *error)
{
    char reason[WHOLE_FILE_REASON], *bytes, *path = folder_path(folder, "session.json.live");
    session_error unread;
    size_t size;
    if (!path)
        return record_fail(error, "there is no memory");
    bool ok = whole_file_read(path, &bytes, &size, reason) || record_fail(error, "%s: %s", path, reason);
    if (ok) {
        while (size > 0 && bytes[size - 1] != '\n')
            size--;
        ok = session_parse(path, folder, bytes, size, file, &unread) || record_fail(error, "%s", unread.text);
        free(bytes);
    }
    free(path);
    return ok;
}

static void write_text(json_writer *w, const char *key, const char *text)
{
    json_write_newline(w);
    json_member_text(w, key, text);
}

static void write_count(json_writer *w, const char *key, uint64_t value)
{
    json_write_newline(w);
    json_member_integer(w, key, value);
}

static void end_object(json_writer *w)
{
    json_write_newline(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

bool write_recording_file(const folder_place *place, const view *v, uint64_t every, record_error *error)
{
    memory_file file;
    if (!begin_file(&file, error))
        return false;
    json_writer writer = {.out = file.stream}, *w = &writer;
    json_write_begin_object(w);
    write_text(w, "octreel", "recording");
    write_count(w, "version", 1);
    view_write(w, v);
    write_text(w, "theme", theme_name());
    write_count(w, "every", every);
    end_object(w);
    return end_file(&file, place, "recording.json", "tells of another view (size, camera, layers, every ...)", error);
}

bool write_renderer_file(const folder_place *place, const renderer_info *info, record_error *error)
{
    char library[IMAGE_LIBRARY_TEXT];
    memory_file file;
    if (!begin_file(&file, error))
        return false;
    json_writer writer = {.out = file.stream}, *w = &writer;
    json_write_begin_object(w);
    write_text(w, "context", info->context);
    write_text(w, "vendor", info->vendor);
    write_text(w, "renderer", info->renderer);
    write_text(w, "version", info->version);
    write_text(w, "png", image_library(library));
    end_object(w);
    return end_file(&file, place, "renderer.json", NULL, error);
}
