/* session_file.c - sessions that own their arrays: copying, keys, freeing. */
#include "session_file.h"
#include "session_reader.h"

#include <stdlib.h>
#include <string.h>

static bool fail_memory(octreel_error *error)
{
    snprintf(error->text, sizeof error->text, "out of memory for the session");
    return false;
}

/* Replace *items by a copy of them, null when there are none; null with false when there is no memory. */
static bool duplicate(const void **items, size_t count, size_t item_size)
{
    const void *from = *items;
    void *copy = count > 0 ? malloc(count * item_size) : NULL;
    if (copy)
        memcpy(copy, from, count * item_size);
    *items = copy;
    return copy || count == 0;
}

bool session_copy(const octree_session *from, session_file *out, octreel_error *error)
{
    const void *bodies = from->bodies, *edits = from->edits, *queries = from->queries, *shapes = from->shapes;
    bool whole = duplicate(&bodies, from->body_count, sizeof *from->bodies);
    whole = duplicate(&edits, from->edit_count, sizeof *from->edits) && whole;
    whole = duplicate(&queries, from->query_count, sizeof *from->queries) && whole;
    whole = duplicate(&shapes, from->shape_count, sizeof *from->shapes) && whole;
    out->session = *from;
    out->session.bodies = bodies;
    out->session.edits = edits;
    out->session.queries = queries;
    out->session.shapes = shapes;
    out->session.keys = NULL;
    bool done = whole ? !from->keys || session_set_keys(out, from->keys, error) : fail_memory(error);
    if (!done)
        session_release(out);
    return done;
}

bool session_set_keys(session_file *file, const char *keys, octreel_error *error)
{
    char reason[SESSION_KEYS_REASON];
    if (!session_check_keys(keys, reason)) {
        snprintf(error->text, sizeof error->text, "%s", reason);
        return false;
    }
    char *copy = strdup(keys);
    if (!copy)
        return fail_memory(error);
    free((char *)file->session.keys);
    file->session.keys = copy;
    return true;
}

void session_release(session_file *file)
{
    free((octree_body *)file->session.bodies);
    free((char *)file->session.keys);
    free((octree_edit *)file->session.edits);
    free((octree_query *)file->session.queries);
    free((octree_shape *)file->session.shapes);
    *file = (session_file){0};
}
