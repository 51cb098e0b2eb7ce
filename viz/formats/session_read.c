/* session_read.c - session files: opening, the stream of objects, and the session they make. */
#include "session_reader.h"
#include "file.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* ---- The stream --------------------------------------------------------------------------------------------- */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* Pass over characters, counting lines. */
static void pass(session_reader *reader, size_t count)
{
    for (const char *end = reader->object + count; reader->object < end; reader->object++)
        reader->line += *reader->object == '\n';
}

/* Go to the next object. False at the end of the text. */
static bool find_object(session_reader *reader)
{
    const char *at = reader->object;
    while (at < reader->limit && is_blank(*at))
        at++;
    pass(reader, (size_t)(at - reader->object));
    return reader->object < reader->limit;
}

/* Parse and read the object at hand, and go to behind it. */
static bool read_object(session_reader *reader, bool (*read)(session_reader *reader, json_t *object))
{
    /* Numbers are doubles alone: -0 keeps its sign, and ids end where doubles cease to hold every integer. */
    const size_t flags = JSON_REJECT_DUPLICATES | JSON_DISABLE_EOF_CHECK | JSON_DECODE_INT_AS_REAL;
    json_error_t parsed;
    json_t *object = json_loadb(reader->object, (size_t)(reader->limit - reader->object), flags, &parsed);
    if (!object && parsed.line < 1)
        return session_fail_line(reader, reader->line, "", "out of memory");
    if (!object)
        return session_fail_parsed(reader, &parsed);
    bool done = json_is_object(object) ? read(reader, object) : session_expected(reader, object, NULL, "an object");
    json_decref(object);
    pass(reader, (size_t)parsed.position);
    return done;
}

static bool check_text(session_reader *reader)
{
    size_t size = (size_t)(reader->limit - reader->object);
    if (size > INT_MAX)
        return session_fail_line(reader, 1, "", "is larger than 2 GiB; keep the points in a file of their own");
    const char *nul = memchr(reader->object, '\0', size);
    if (!nul)
        return true;
    pass(reader, (size_t)(nul - reader->object));
    return session_fail_line(reader, reader->line, "", "holds a NUL byte, so it is no text");
}

/* The byte order mark that some editors put before UTF-8. */
static void skip_mark(session_reader *reader)
{
    static const char mark[] = "\xef\xbb\xbf";
    if (reader->limit - reader->object >= 3 && memcmp(reader->object, mark, 3) == 0)
        reader->object += 3;
}

static bool read_stream(session_reader *reader)
{
    skip_mark(reader);
    if (!check_text(reader))
        return false;
    if (!find_object(reader))
        return session_fail_line(reader, reader->line, "", "holds no session");
    if (!read_object(reader, session_read_header))
        return false;
    while (find_object(reader))
        if (!read_object(reader, session_read_tick))
            return false;
    return true;
}

/* ---- The session -------------------------------------------------------------------------------------------- */

/* What is of every tick comes last in a session, though it is the first in its file. */
static bool append_standing(session_reader *reader, session_list *list, const session_list *standing, size_t size)
{
    for (size_t i = 0; i < standing->count; i++) {
        void *item = session_append(reader, NULL, list, size);
        if (!item)
            return false;
        memcpy(item, (const char *)standing->items + i * size, size);
    }
    return true;
}

static bool append_all_standing(session_reader *reader)
{
    return append_standing(reader, &reader->queries, &reader->standing, sizeof(octree_query)) &&
           append_standing(reader, &reader->shapes, &reader->standing_shapes, sizeof(octree_shape));
}

/* Hand the reader's arrays over to the session. */
static void adopt_arrays(session_reader *reader)
{
    octree_session *session = reader->session;
    session->bodies = reader->bodies;
    session->keys = reader->keys;
    session->edits = reader->edits.items;
    session->edit_count = reader->edits.count;
    session->queries = reader->queries.items;
    session->query_count = reader->queries.count;
    session->shapes = reader->shapes.items;
    session->shape_count = reader->shapes.count;
}

bool session_parse(const char *name, const char *folder, const char *text, size_t size, session_file *out,
                   octreel_error *error)
{
    session_reader reader = {.name = name,
                             .folder = folder,
                             .object = text,
                             .limit = text + size,
                             .line = 1,
                             .session = &out->session,
                             .error = error};
    *out = (session_file){0};
    bool done = read_stream(&reader) && append_all_standing(&reader);
    adopt_arrays(&reader);
    free(reader.standing.items);
    free(reader.standing_shapes.items);
    if (!done)
        session_release(out);
    return done;
}

/* ---- Files -------------------------------------------------------------------------------------------------- */

/* The folder of a path, with its final slash; "" is the current one. The caller frees it. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return strndup(path, slash ? (size_t)(slash - path) + 1 : 0);
}

bool session_read(const char *path, session_file *out, octreel_error *error)
{
    char reason[FILE_REASON];
    char *text;
    size_t size;
    *out = (session_file){0};
    if (!file_read_whole(path, &text, &size, reason)) {
        snprintf(error->text, sizeof error->text, "%s: %s", session_name_end(path), reason);
        return false;
    }
    char *folder = folder_of(path);
    bool done = folder && session_parse(path, folder, text, size, out, error);
    if (!folder)
        snprintf(error->text, sizeof error->text, "%s: out of memory", session_name_end(path));
    free(folder);
    free(text);
    return done;
}
