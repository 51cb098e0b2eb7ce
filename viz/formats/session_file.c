/* SPDX-License-Identifier: MIT */
/* session_file.c - reads and writes session files, and copies and frees the arrays of sessions. */
#include "session_file.h"
#include "array.h"
#include "file.h"
#include "session_members.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* ---- Copying and freeing ------------------------------------------------------------------------------------ */

static bool fail_memory(octreel_error *error)
{
    return error_set(error, "out of memory for the session");
}

/* Replace *items by a copy; by null if there are none. False, and null, if there is no memory. */
static bool duplicate(const void **items, size_t count, size_t item_size)
{
    const void *from = *items;
    void *copy = count > 0 ? malloc(count * item_size) : NULL;
    if (copy)
        memcpy(copy, from, count * item_size);
    *items = copy;
    return copy || count == 0;
}

static bool duplicate_ids(const uint64_t **ids, size_t *count)
{
    const void *copy = *ids;
    const bool whole = duplicate(&copy, *count, sizeof **ids);
    *ids = copy;
    *count = whole ? *count : 0;
    return whole;
}

bool query_copy_ids(octree_query *query)
{
    bool whole = duplicate_ids(&query->answer, &query->answer_count);
    for (int met = 0; met < OCTREE_NODE_VISITS; met++)
        whole = duplicate_ids(&query->visits[met].ids, &query->visits[met].count) && whole;
    return whole;
}

void query_release_ids(octree_query *query)
{
    free((uint64_t *)query->answer);
    for (int met = 0; met < OCTREE_NODE_VISITS; met++)
        free((uint64_t *)query->visits[met].ids);
}

/* Free the memory that queries and foreign trees own, but not their arrays. */
static void release_owned(const octree_query *queries, size_t query_count, const octree_foreign_tree *trees,
                          size_t tree_count)
{
    for (size_t i = 0; i < query_count; i++)
        query_release_ids((octree_query *)&queries[i]);
    for (size_t i = 0; i < tree_count; i++)
        foreign_tree_release((octree_foreign_tree *)&trees[i]);
}

/* After queries and foreign trees were copied bytewise: replace the memory that they own by copies. */
static bool duplicate_owned(octree_query *queries, size_t query_count, octree_foreign_tree *trees, size_t tree_count)
{
    bool whole = true;
    for (size_t i = 0; queries && i < query_count; i++)
        whole = query_copy_ids(&queries[i]) && whole;
    for (size_t i = 0; trees && i < tree_count; i++)
        whole = foreign_tree_copy(&trees[i], &trees[i]) && whole;
    return whole;
}

bool session_copy(const octree_session *from, session_file *out, octreel_error *error)
{
    const void *bodies = from->bodies, *edits = from->edits, *queries = from->queries, *shapes = from->shapes,
               *gaps = from->gaps, *foreign = from->foreign;
    bool whole = duplicate(&bodies, from->body_count, sizeof *from->bodies);
    whole = duplicate(&edits, from->edit_count, sizeof *from->edits) && whole;
    whole = duplicate(&queries, from->query_count, sizeof *from->queries) && whole;
    whole = duplicate(&shapes, from->shape_count, sizeof *from->shapes) && whole;
    whole = duplicate(&gaps, from->gap_count, sizeof *from->gaps) && whole;
    whole = duplicate(&foreign, from->foreign_count, sizeof *from->foreign) && whole;
    whole = duplicate_owned((octree_query *)queries, from->query_count, (octree_foreign_tree *)foreign,
                            from->foreign_count) &&
            whole;
    *out = (session_file){.session = *from};
    out->session.bodies = bodies;
    out->session.edits = edits;
    out->session.queries = queries;
    out->session.query_count = queries ? from->query_count : 0;
    out->session.shapes = shapes;
    out->session.gaps = gaps;
    out->session.foreign = foreign;
    out->session.foreign_count = foreign ? from->foreign_count : 0;
    out->session.keys = NULL;
    const bool done = whole ? !from->keys || session_set_keys(out, from->keys, error) : fail_memory(error);
    if (!done)
        session_release(out);
    return done;
}

bool session_set_keys(session_file *file, const char *keys, octreel_error *error)
{
    if (!session_check_keys(keys, error))
        return false;
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
    release_owned(file->session.queries, file->session.query_count, file->session.foreign, file->session.foreign_count);
    free((octree_query *)file->session.queries);
    free((octree_shape *)file->session.shapes);
    free((octree_gap *)file->session.gaps);
    free((octree_foreign_tree *)file->session.foreign);
    point_values_release(&file->values);
    *file = (session_file){0};
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

bool session_read_header(json_reader *r, json_t *object)
{
    session_loader *s = r->context;
    if (!json_object_get(object, "octreel"))
        return json_fail(r, NULL, "is not a session: the first object has no \"octreel\": \"session\"");
    return session_read_file_world(r, object) && json_read_members(r, object, NULL, session_header_members, &s->header);
}

bool session_read_tick(json_reader *r, json_t *object)
{
    session_tick ignored;
    if (json_object_get(object, "octreel"))
        return json_fail(r, NULL, "this is a second header; only objects of ticks may follow the first");
    if (json_object_get(object, "gap") && json_object_size(object) > 2)
        return json_fail(r, NULL, "a tick with \"gap\" must have no other member but \"tick\"");
    return json_read_members(r, object, NULL, session_tick_members, &ignored);
}

bool session_check_text(json_reader *r)
{
    const size_t size = (size_t)(r->limit - r->at);
    if (size > INT_MAX)
        return json_fail_line(r, 1, NULL, "is larger than 2 GiB; keep the points in a file of their own");
    const char *nul = memchr(r->at, 0, size);
    if (!nul)
        return true;
    for (; r->at < nul; r->at++)
        r->line += *r->at == '\n';
    return json_fail_line(r, r->line, NULL, "holds a NUL byte, so it is not text");
}

static bool read_stream(json_reader *r)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf"; /* some editors put it before UTF-8 */
    if (r->limit - r->at >= 3 && memcmp(r->at, byte_order_mark, 3) == 0)
        r->at += 3;
    if (!session_check_text(r))
        return false;
    if (!json_next_object(r))
        return json_fail_line(r, r->line, NULL, "holds no session");
    if (!json_read_object(r, false, session_read_header))
        return false;
    while (json_next_object(r))
        if (!json_read_object(r, false, session_read_tick))
            return false;
    return true;
}

/* Add the items of a list of the header to the list of single ticks: before its items or after them. */
static bool add_header_items(json_reader *r, int list, size_t item_size, bool before)
{
    session_loader *s = r->context;
    session_list *to = &s->lists[list], *from = &s->standing[list];
    if (from->count == 0)
        return true;
    char *items = array_reserve(to->items, to->count + from->count, &to->room, item_size);
    if (!items)
        return json_fail(r, NULL, "out of memory after %zu items", to->count);
    if (before)
        memmove(items + from->count * item_size, items, to->count * item_size);
    memcpy(items + (before ? 0 : to->count) * item_size, from->items, from->count * item_size);
    to->items = items;
    to->count += from->count;
    from->count = 0;
    return true;
}

/* Foreign nodes come first, because those of the header apply from tick 0 on. */
bool session_append_standing(json_reader *r)
{
    return add_header_items(r, SESSION_QUERIES, sizeof(octree_query), false) &&
           add_header_items(r, SESSION_SHAPES, sizeof(octree_shape), false) &&
           add_header_items(r, SESSION_FOREIGN, sizeof(octree_foreign_tree), true);
}

octree_session session_assemble(const session_loader *s, const session_list lists[SESSION_LISTS])
{
    octree_session session = s->header.session;
    session.bodies = s->bodies;
    session.edits = lists[SESSION_EDITS].items;
    session.edit_count = lists[SESSION_EDITS].count;
    session.queries = lists[SESSION_QUERIES].items;
    session.query_count = lists[SESSION_QUERIES].count;
    session.shapes = lists[SESSION_SHAPES].items;
    session.shape_count = lists[SESSION_SHAPES].count;
    session.gaps = lists[SESSION_GAPS].items;
    session.gap_count = lists[SESSION_GAPS].count;
    session.foreign = lists[SESSION_FOREIGN].items;
    session.foreign_count = lists[SESSION_FOREIGN].count;
    return session;
}

void session_clear_lists(session_list lists[SESSION_LISTS])
{
    release_owned(lists[SESSION_QUERIES].items, lists[SESSION_QUERIES].count, lists[SESSION_FOREIGN].items,
                  lists[SESSION_FOREIGN].count);
    for (int i = 0; i < SESSION_LISTS; i++)
        lists[i].count = 0;
}

void session_release_lists(session_list lists[SESSION_LISTS])
{
    session_clear_lists(lists);
    for (int i = 0; i < SESSION_LISTS; i++)
        free(lists[i].items);
}

bool session_parse(const char *name, const char *folder, const char *text, size_t size, session_file *out,
                   octreel_error *error)
{
    session_loader loader = {.folder = folder, .header = {.session = session_default_header()}};
    loader.tick = OCTREE_EVERY_TICK;
    json_reader r = {.name = name, .at = text, .limit = text + size, .line = 1, .context = &loader, .error = error};
    const bool done = read_stream(&r) && session_end_values(&r) && session_append_standing(&r);
    *out = (session_file){.session = session_assemble(&loader, loader.lists), .values = loader.values.made};
    memcpy(out->note, loader.note, sizeof out->note);
    session_release_lists(loader.standing);
    cloud_release(&loader.points);
    session_release_listed(&loader.values);
    if (!done)
        session_release(out);
    return done;
}

bool session_read(const char *path, session_file *out, octreel_error *error)
{
    char reason[FILE_REASON];
    char *text;
    size_t size;
    *out = (session_file){0};
    if (!file_read_whole(path, &text, &size, reason))
        return error_set(error, "%s: %s", json_name_end(file_title(path)), reason);
    const char *slash = strrchr(path, '/');
    char *folder = strndup(path, slash ? (size_t)(slash - path) + 1 : 0);
    const bool done = folder ? session_parse(file_title(path), folder, text, size, out, error) : fail_memory(error);
    free(folder);
    free(text);
    return done;
}

/* ---- Writing ------------------------------------------------------------------------------------------------ */

/* Queries and shapes of every tick are the last ones in the session's arrays. */
void session_write_header(const octree_session *session, const point_values *values, FILE *out)
{
    session_header header = {.session = *session, .values = values};
    octree_input *standing = &header.standing;
    for (size_t i = session->query_count; i > 0 && session->queries[i - 1].tick == OCTREE_EVERY_TICK; i--) {
        standing->queries = &session->queries[i - 1];
        standing->query_count++;
    }
    for (size_t i = session->shape_count; i > 0 && session->shapes[i - 1].tick == OCTREE_EVERY_TICK; i--) {
        standing->shapes = &session->shapes[i - 1];
        standing->shape_count++;
    }
    json_writer writer = {.out = out, .context = values};
    json_write_object(&writer, session_header_members, &header);
    json_write_end_line(&writer);
}

void session_write_tick(uint64_t tick, const octree_input *input, const point_values *values, FILE *out)
{
    json_writer writer = {.out = out, .context = values};
    if (input->edit_count == 0 && input->query_count == 0 && input->shape_count == 0 && !input->gap && !input->foreign)
        return;
    json_write_object(&writer, session_tick_members, &(session_tick){tick, *input});
    json_write_end_line(&writer);
}

/* The parts of a session's arrays that have not been written yet. */
typedef struct unwritten {
    octree_input input;
    const octree_gap *gaps;
    size_t gap_count;
    const octree_foreign_tree *foreign;
    size_t foreign_count;
    uint64_t tick; /* the next tick to write; OCTREE_EVERY_TICK if there is none */
} unwritten;

static void find_next_tick(unwritten *left)
{
    const octree_input *i = &left->input;
    left->tick = i->edit_count ? i->edits->tick : OCTREE_EVERY_TICK;
    if (i->query_count && i->queries->tick < left->tick)
        left->tick = i->queries->tick;
    if (i->shape_count && i->shapes->tick < left->tick)
        left->tick = i->shapes->tick;
    if (left->gap_count && left->gaps->tick < left->tick)
        left->tick = left->gaps->tick;
    if (left->foreign_count && left->foreign->tick < left->tick)
        left->tick = left->foreign->tick;
}

/* Remove the items of the next tick from the front of the unwritten parts, and return them. A gap has no other items.
 */
static octree_input remove_next_tick(unwritten *left)
{
    octree_input *i = &left->input, taken = *i;
    taken.edit_count = taken.query_count = taken.shape_count = 0;
    for (; i->edit_count && i->edits->tick == left->tick; i->edits++, i->edit_count--)
        taken.edit_count++;
    for (; i->query_count && i->queries->tick == left->tick; i->queries++, i->query_count--)
        taken.query_count++;
    for (; i->shape_count && i->shapes->tick == left->tick; i->shapes++, i->shape_count--)
        taken.shape_count++;
    if (left->foreign_count && left->foreign->tick == left->tick) {
        taken.foreign = left->foreign++;
        left->foreign_count--;
    }
    if (left->gap_count == 0 || left->gaps->tick > left->tick)
        return taken;
    left->gap_count--;
    return (octree_input){.gap = left->gaps++};
}

bool session_write(const octree_session *session, const point_values *values, FILE *out)
{
    unwritten left = {.input = {.edits = session->edits,
                                .edit_count = session->edit_count,
                                .queries = session->queries,
                                .query_count = session->query_count,
                                .shapes = session->shapes,
                                .shape_count = session->shape_count},
                      .gaps = session->gaps,
                      .gap_count = session->gap_count,
                      .foreign = session->foreign,
                      .foreign_count = session->foreign_count};
    session_write_header(session, values, out);
    for (find_next_tick(&left); left.tick != OCTREE_EVERY_TICK; find_next_tick(&left)) {
        const uint64_t tick = left.tick;
        const octree_input input = remove_next_tick(&left);
        session_write_tick(tick, &input, values, out);
    }
    return fflush(out) == 0 && !ferror(out);
}
