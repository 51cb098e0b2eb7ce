/* folder_files.c - see folder_files.h. */
#include "folder_files.h"
#include "png_write.h"
#include "json_write.h"
#include "octree/digest.h"
#include "recording_file.h"
#include "file.h"

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

static bool begin_file(memory_file *file, octreel_error *error)
{
    *file = (memory_file){0};
    file->stream = open_memstream(&file->bytes, &file->size);
    return file->stream || error_no_memory(error);
}

/* False, and nothing is left of it, where there is no memory. */
static bool close_file(memory_file *file, const char *name, octreel_error *error)
{
    const bool whole = !ferror(file->stream);
    if (fclose(file->stream) == 0 && whole)
        return true;
    free(file->bytes);
    return error_set(error, "there is no memory for %s", name);
}

/* `unlike` is said of a file that is there with other bytes; null: those are as good. */
static bool put_file(const char *bytes, size_t size, const folder_place *place, const char *name, const char *unlike,
                     octreel_error *error)
{
    bool same;
    if (!place->writer && !place->look)
        return folder_write(place->folder, name, bytes, size, error);
    if (!(place->look ? folder_compare(place->folder, name, bytes, size, &same, error)
                      : folder_write_once(place->folder, name, place->writer, bytes, size, &same, error)))
        return false;
    return same || !unlike || error_set(error, "%s/%s: %s", place->folder, name, unlike);
}

static bool end_file(memory_file *file, const folder_place *place, const char *name, const char *unlike,
                     octreel_error *error)
{
    if (!close_file(file, name, error))
        return false;
    const bool ok = put_file(file->bytes, file->size, place, name, unlike, error);
    free(file->bytes);
    return ok;
}

bool make_session_bytes(const octree_session *session, session_bytes *made, octreel_error *error)
{
    memory_file file;
    if (!begin_file(&file, error))
        return false;
    session_write(session, file.stream);
    if (!close_file(&file, "session.json", error))
        return false;
    *made = (session_bytes){file.bytes, file.size, octree_digest_bytes(OCTREE_DIGEST_START, file.bytes, file.size)};
    return true;
}

bool write_session_file(const folder_place *place, const session_bytes *session, octreel_error *error)
{
    return put_file(session->bytes, session->size, place, "session.json", "is another session, or was changed by hand",
                    error);
}

/* That of octree_digest_bytes(), in pieces of whole words: a session may be large. */
static uint64_t digest_stream(FILE *in)
{
    unsigned char bytes[1 << 13];
    uint64_t digest = OCTREE_DIGEST_START, size = 0;
    size_t got;
    while ((got = fread(bytes, 1, sizeof bytes, in)) > 0) {
        size += got;
        digest = octree_digest_words(digest, bytes, got);
    }
    return octree_digest_word(digest, size);
}

bool digest_session_file(const char *path, uint64_t *digest, octreel_error *error)
{
    FILE *in = fopen(path, "rb");
    if (!in)
        return error_set(error, "%s: cannot be opened: %s", path, strerror(errno));
    *digest = digest_stream(in);
    const bool ok = !ferror(in);
    fclose(in);
    return ok || error_set(error, "%s: cannot be read", path);
}

/* The text of a session in a folder, and where it is, for messages. The caller frees both. */
typedef struct session_text {
    char *path, *bytes;
    size_t size;
} session_text;

static bool read_text(const char *folder, const char *name, session_text *text, octreel_error *error)
{
    char reason[FILE_REASON];
    text->path = path_join(folder, name);
    if (!text->path)
        return error_no_memory(error);
    if (file_read_whole(text->path, &text->bytes, &text->size, reason))
        return true;
    error_set(error, "%s: %s", text->path, reason);
    free(text->path);
    return false;
}

static bool parse_text(session_text *text, const char *folder, session_file *file, octreel_error *error)
{
    octreel_error unread;
    const bool ok = session_parse(text->path, folder, text->bytes, text->size, file, &unread);
    free(text->bytes);
    free(text->path);
    return ok || error_set(error, "%s", unread.text);
}

bool read_session_file(const char *folder, session_file *file, uint64_t *digest, octreel_error *error)
{
    session_text text;
    if (!read_text(folder, "session.json", &text, error))
        return false;
    *digest = octree_digest_bytes(OCTREE_DIGEST_START, text.bytes, text.size);
    return parse_text(&text, folder, file, error);
}

bool read_live_session(const char *folder, session_file *file, octreel_error *error)
{
    session_text text;
    if (!read_text(folder, "session.json.live", &text, error))
        return false;
    while (text.size > 0 && text.bytes[text.size - 1] != '\n')
        text.size--;
    return parse_text(&text, folder, file, error);
}

static void write_text(json_writer *w, const char *key, const char *text)
{
    json_write_newline(w);
    json_member_text(w, key, text);
}

static void end_object(json_writer *w)
{
    json_write_newline(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

bool write_recording_file(const folder_place *place, const view *v, uint64_t every, octreel_error *error)
{
    memory_file file;
    if (!begin_file(&file, error))
        return false;
    recording_write(file.stream, v, every);
    return end_file(&file, place, "recording.json", "tells of another view (size, camera, layers, every ...)", error);
}

bool write_renderer_file(const folder_place *place, const renderer_info *info, octreel_error *error)
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
