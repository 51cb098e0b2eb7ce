/* SPDX-License-Identifier: MIT */
/* recording_file.c - reads and writes recording.json by the rows of view_options.c, and reads session.json in the
 * same folder. */
#include "recording_file.h"
#include "file.h"
#include "octree/digest.h"
#include "theme.h"
#include "view_options.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* The contents of recording.json. The view must be the first member, because offsets of options in the view are used
 * as offsets in this structure. */
typedef struct recorded {
    view view;
    uint64_t every;
} recorded;

/* The members of recording.json that are not view options. The first two members are written before the view
 * options, all other members after them. */
static const json_member fixed_members[] = {
    {"octreel", &json_constant, .required = true, .about = "recording"},
    {"version", &json_version, .required = true, .max = RECORDING_VERSION, .about = "recording"},
    {"derived", &json_structure, .offset = 0, .members = view_derived_members},
    {"theme", &json_constant, .about = THEME_NAME},
    {"every", &json_uint64, offsetof(recorded, every), .max = SESSION_LAST_TICK},
};

#define FIXED_BEFORE 2
#define FIXED_MEMBERS (sizeof fixed_members / sizeof fixed_members[0])
#define MOST_MEMBERS 32

/* Lists all members of recording.json in the order in which they are written. Each member gets a line of its own. */
static void list_recording_members(json_member members[MOST_MEMBERS])
{
    size_t count = 0;
    for (size_t i = 0; i < FIXED_BEFORE; i++)
        members[count++] = fixed_members[i];
    for (size_t i = 0; view_option_at(i) && count < MOST_MEMBERS - FIXED_MEMBERS; i++)
        if (view_option_at(i)->member.name)
            members[count++] = view_option_at(i)->member;
    for (size_t i = FIXED_BEFORE; i < FIXED_MEMBERS; i++)
        members[count++] = fixed_members[i];
    members[count] = (json_member){0};
    while (count > 0)
        members[--count].line = true;
}

void recording_write(FILE *out, const view *v, uint64_t every)
{
    const recorded written = {*v, every};
    json_writer writer = {.out = out}, *w = &writer;
    json_member members[MOST_MEMBERS];
    list_recording_members(members);
    json_write_begin_object(w);
    json_write_members(w, members, &written);
    json_start_new_line(w);
    json_write_end_object(w);
    json_write_end_line(w);
}

static bool read_recording_object(json_reader *r, json_t *object)
{
    json_member members[MOST_MEMBERS];
    list_recording_members(members);
    return json_read_members(r, object, NULL, members, r->context);
}

bool recording_parse(const char *name, const char *text, size_t size, view *v, uint64_t *every, octreel_error *error)
{
    recorded found = {.view = view_make_default(), .every = 1};
    json_reader r = {.name = name, .at = text, .limit = text + size, .line = 1, .context = &found, .error = error};
    json_skip_to_object(&r);
    const bool done = json_read_object(&r, true, read_recording_object);
    *v = found.view;
    *every = found.every;
    return done;
}

bool recording_read(const char *folder, view *v, uint64_t *every, octreel_error *error)
{
    char *text = NULL, *path = path_join(folder, "recording.json");
    size_t size;
    const bool done =
        path ? file_read_whole(path, &text, &size, error) && recording_parse(path, text, size, v, every, error)
             : error_no_memory(error);
    free(text);
    free(path);
    return done;
}

/* ---- session.json --------------------------------------------------------------------------------------------- */

/* Reads a session file of a recording. With `live`, a last line without a newline is ignored, because the writing
 * program ended in the middle of this line. */
static bool read_session(const char *folder, const char *name, bool live, session_file *file, uint64_t *digest,
                         octreel_error *error)
{
    char *bytes = NULL, *path = path_join(folder, name);
    size_t size;
    bool ok = path ? file_read_whole(path, &bytes, &size, error) : error_no_memory(error);
    while (ok && live && size > 0 && bytes[size - 1] != '\n')
        size--;
    if (ok)
        *digest = octree_digest_bytes(OCTREE_DIGEST_START, bytes, size);
    ok = ok && session_parse(path, NULL, bytes, size, file, error);
    free(bytes);
    free(path);
    return ok;
}

bool read_session_file(const char *folder, session_file *file, uint64_t *digest, octreel_error *error)
{
    return read_session(folder, "session.json", false, file, digest, error);
}

bool read_live_session(const char *folder, session_file *file, octreel_error *error)
{
    uint64_t ignored;
    return read_session(folder, "session.json.live", true, file, &ignored, error);
}
