/* SPDX-License-Identifier: MIT */
/* session_file.c - reads and writes session files, and copies and frees the arrays of sessions. */
#include "session_file.h"
#include "array.h"
#include "file.h"
#include "session_members.h"

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* ---- The lists of a session --------------------------------------------------------------------------------- */

#define BODIES SESSION_LISTS

/* For each list of octree_session: the offset `at` of its pointer to the items, and the size of an item, both in
 * bytes. The number of items is stored directly after the pointer. Each item begins with its tick, except bodies,
 * which have no tick. The bodies are the last row. */
static const struct {
    size_t at, size;
} rows[SESSION_LISTS + 1] = {
    [SESSION_EDITS] = {offsetof(octree_session, edits), sizeof(octree_edit)},
    [SESSION_QUERIES] = {offsetof(octree_session, queries), sizeof(octree_query)},
    [SESSION_SHAPES] = {offsetof(octree_session, shapes), sizeof(octree_shape)},
    [SESSION_GAPS] = {offsetof(octree_session, gaps), sizeof(octree_gap)},
    [SESSION_FOREIGN] = {offsetof(octree_session, foreign), sizeof(octree_foreign_tree)},
    [SESSION_PAIRS] = {offsetof(octree_session, foreign_pairs), sizeof(octree_foreign_pairs)},
    [BODIES] = {offsetof(octree_session, bodies), sizeof(octree_game_body)},
};

static json_counted_array get_session_list(const octree_session *session, int list)
{
    return json_get_counted_array((const char *)session + rows[list].at);
}

static void set_session_list(octree_session *session, int list, const void *items, size_t count)
{
    const json_counted_array value = {items, count};
    memcpy((char *)session + rows[list].at, &value, sizeof value);
}

static void set_session_lists(octree_session *session, const session_list lists[SESSION_LISTS])
{
    for (int i = 0; i < SESSION_LISTS; i++)
        set_session_list(session, i, lists[i].items, lists[i].count);
}

static const void *get_item(const json_counted_array *list, int kind, size_t index)
{
    return (const char *)list->items + index * rows[kind].size;
}

octree_input session_collect_input(const octree_session *session)
{
    return (octree_input){.edits = session->edits,
                          .edit_count = session->edit_count,
                          .queries = session->queries,
                          .query_count = session->query_count,
                          .shapes = session->shapes,
                          .shape_count = session->shape_count,
                          .gap = session->gap_count ? session->gaps : NULL,
                          .foreign = session->foreign_count ? session->foreign : NULL,
                          .foreign_pairs = session->foreign_pairs_count ? session->foreign_pairs : NULL};
}

/* ---- Copying and freeing ------------------------------------------------------------------------------------ */

static bool fail_out_of_memory(octreel_error *error)
{
    return error_set(error, "out of memory for the session");
}

/* Replaces *items by a copy, or by null if there are no items. Returns false if memory runs out; then *items is
 * null. */
static bool duplicate_items(const void **items, size_t count, size_t item_size)
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
    const bool whole = duplicate_items(&copy, *count, sizeof **ids);
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

bool foreign_pairs_duplicate(const octree_foreign_pairs *from, octree_foreign_pairs *to)
{
    const void *pairs = from->pairs;
    const bool whole = duplicate_items(&pairs, from->pair_count, sizeof *from->pairs);
    *to = (octree_foreign_pairs){.tick = from->tick, .pairs = pairs, .pair_count = pairs ? from->pair_count : 0};
    return whole;
}

void foreign_pairs_release(octree_foreign_pairs *pairs)
{
    free((octree_pair *)pairs->pairs);
    *pairs = (octree_foreign_pairs){0};
}

/* Frees the memory that the queries, foreign trees and foreign pairs of a session own, but not the arrays in which they
 * are stored. */
static void release_owned_memory(const octree_session *session)
{
    for (size_t i = 0; i < session->query_count; i++)
        query_release_ids((octree_query *)&session->queries[i]);
    for (size_t i = 0; i < session->foreign_count; i++)
        foreign_tree_release((octree_foreign_tree *)&session->foreign[i]);
    for (size_t i = 0; i < session->foreign_pairs_count; i++)
        foreign_pairs_release((octree_foreign_pairs *)&session->foreign_pairs[i]);
}

/* The queries, foreign trees and foreign pairs of a session were copied bytewise, so they share memory with the
 * originals. Gives each copy its own memory. */
static bool duplicate_owned_memory(const octree_session *session)
{
    bool whole = true;
    for (size_t i = 0; i < session->query_count; i++)
        whole = query_copy_ids((octree_query *)&session->queries[i]) && whole;
    for (size_t i = 0; i < session->foreign_count; i++)
        whole = foreign_tree_duplicate(&session->foreign[i], (octree_foreign_tree *)&session->foreign[i]) && whole;
    for (size_t i = 0; i < session->foreign_pairs_count; i++) {
        octree_foreign_pairs *pairs = (octree_foreign_pairs *)&session->foreign_pairs[i];
        whole = foreign_pairs_duplicate(pairs, pairs) && whole;
    }
    return whole;
}

bool session_copy(const octree_session *from, session_file *out, octreel_error *error)
{
    bool whole = true;
    *out = (session_file){.session = *from};
    out->session.keys = NULL;
    for (int i = 0; i <= BODIES; i++) {
        json_counted_array list = get_session_list(from, i);
        whole = duplicate_items(&list.items, list.count, rows[i].size) && whole;
        set_session_list(&out->session, i, list.items, list.items ? list.count : 0);
    }
    whole = duplicate_owned_memory(&out->session) && whole;
    const bool done = whole ? !from->keys || session_set_keys(out, from->keys, error) : fail_out_of_memory(error);
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
        return fail_out_of_memory(error);
    free((char *)file->session.keys);
    file->session.keys = copy;
    return true;
}

bool session_check_length(const octree_session *session, uint64_t most, octreel_error *error)
{
    const uint64_t length = octree_session_length(session), limit = most ? most : SESSION_MOST_PLAYED;
    return length <= limit || error_set(error,
                                        "the session has %" PRIu64 " ticks, more than the limit of %" PRIu64
                                        "; --max-ticks %" PRIu64 " plays it anyway",
                                        length, limit, length);
}

void session_release(session_file *file)
{
    release_owned_memory(&file->session);
    for (int i = 0; i <= BODIES; i++)
        free((void *)get_session_list(&file->session, i).items);
    free((char *)file->session.keys);
    point_values_release(&file->values);
    *file = (session_file){0};
}

/* ---- Reading ------------------------------------------------------------------------------------------------ */

bool session_read_header(json_reader *r, json_t *object)
{
    session_loader *s = r->context;
    if (!json_object_get(object, "octreel"))
        return json_fail(r, NULL, "is not a session: the first object has no \"octreel\": \"session\"");
    if (json_is_array(json_object_get(object, "pairs")))
        return json_fail(r, &(json_place){NULL, "pairs", 0},
                         "the header has true or false here; the pairs that your index found at a tick belong in the "
                         "object of that tick, such as {\"tick\": 0, \"pairs\": [[1, 2]]}");
    return session_compute_world_from_file(r, object) &&
           json_read_members(r, object, NULL, session_header_members, &s->header);
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

bool session_check_is_text(json_reader *r)
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

static bool read_objects(json_reader *r)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf"; /* some editors write a byte order mark before UTF-8 text */
    if (r->limit - r->at >= 3 && memcmp(r->at, byte_order_mark, 3) == 0)
        r->at += 3;
    if (!session_check_is_text(r))
        return false;
    if (!json_skip_to_object(r))
        return json_fail_line(r, r->line, NULL, "holds no session");
    if (!json_read_object(r, false, session_read_header))
        return false;
    while (json_skip_to_object(r))
        if (!json_read_object(r, false, session_read_tick))
            return false;
    return true;
}

/* Moves the items of a list of the header, which apply to all ticks, into the list of single ticks: before the items of
 * this list if `before` is true, otherwise after them. */
static bool move_header_list(json_reader *r, int list, bool before)
{
    session_loader *s = r->context;
    const size_t item_size = rows[list].size;
    session_list *to = &s->lists[list], *from = &s->header_lists[list];
    if (from->count == 0)
        return true;
    if (!array_grow(&to->items, to->count + from->count, &to->room, item_size))
        return json_fail(r, NULL, "out of memory after %zu items", to->count);
    char *items = to->items;
    if (before)
        memmove(items + from->count * item_size, items, to->count * item_size);
    memcpy(items + (before ? 0 : to->count) * item_size, from->items, from->count * item_size);
    to->count += from->count;
    from->count = 0;
    return true;
}

/* The foreign nodes of the header are inserted before the foreign nodes of single ticks, because those of the header
 * apply from tick 0 on. */
bool session_move_header_lists(json_reader *r)
{
    return move_header_list(r, SESSION_QUERIES, false) && move_header_list(r, SESSION_SHAPES, false) &&
           move_header_list(r, SESSION_FOREIGN, true);
}

octree_session session_assemble(const session_loader *s, const session_list lists[SESSION_LISTS])
{
    octree_session session = s->header.session;
    session.bodies = s->bodies;
    set_session_lists(&session, lists);
    return session;
}

void session_clear_lists(session_list lists[SESSION_LISTS])
{
    octree_session session = {.keys = NULL};
    set_session_lists(&session, lists);
    release_owned_memory(&session);
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
    session_loader loader = {.folder = folder, .header = {.session = session_make_default_header()}};
    loader.tick = OCTREE_EVERY_TICK;
    json_reader r = {.name = name, .at = text, .limit = text + size, .line = 1, .context = &loader, .error = error};
    const bool done = read_objects(&r) && session_merge_listed_values(&r) && session_move_header_lists(&r);
    *out = (session_file){.session = session_assemble(&loader, loader.lists), .values = loader.values.made};
    memcpy(out->note, loader.note, sizeof out->note);
    session_release_lists(loader.header_lists);
    cloud_release(&loader.points);
    session_release_values(&loader.values);
    if (!done)
        session_release(out);
    return done;
}

bool session_read(const char *path, session_file *out, octreel_error *error)
{
    char *text;
    size_t size;
    *out = (session_file){0};
    if (!file_read_whole(path, &text, &size, error))
        return false;
    const char *slash = strrchr(path, '/');
    char *folder = strndup(path, slash ? (size_t)(slash - path) + 1 : 0);
    const bool done =
        folder ? session_parse(file_display_name(path), folder, text, size, out, error) : fail_out_of_memory(error);
    free(folder);
    free(text);
    return done;
}

/* ---- Writing ------------------------------------------------------------------------------------------------ */

static uint64_t get_tick(const json_counted_array *list, int kind, size_t index)
{
    return *(const uint64_t *)get_item(list, kind, index);
}

/* Queries and shapes that apply to every tick are written in the header. In the session's arrays, these items are at
 * the end. */
void session_write_header(const octree_session *session, const point_values *values, FILE *out)
{
    octree_session every_tick = {.keys = NULL};
    for (int i = SESSION_QUERIES; i <= SESSION_SHAPES; i++) {
        const json_counted_array all = get_session_list(session, i);
        size_t first = all.count;
        while (first > 0 && get_tick(&all, i, first - 1) == OCTREE_EVERY_TICK)
            first--;
        if (first < all.count)
            set_session_list(&every_tick, i, get_item(&all, i, first), all.count - first);
    }
    const session_header header = {*session, session_collect_input(&every_tick), values};
    json_writer writer = {.out = out, .context = values};
    json_write_object(&writer, session_header_members, &header);
    json_write_end_line(&writer);
}

void session_write_tick(uint64_t tick, const octree_input *input, const point_values *values, FILE *out)
{
    json_writer writer = {.out = out, .context = values};
    if (input->edit_count == 0 && input->query_count == 0 && input->shape_count == 0 && !input->gap &&
        !input->foreign && !input->foreign_pairs)
        return;
    json_write_object(&writer, session_tick_members, &(session_tick){tick, *input});
    json_write_end_line(&writer);
}

/* Returns the smallest tick of all unwritten items, or OCTREE_EVERY_TICK if no item is unwritten. */
static uint64_t find_next_tick(const json_counted_array unwritten[SESSION_LISTS])
{
    uint64_t next = OCTREE_EVERY_TICK;
    for (int i = 0; i < SESSION_LISTS; i++)
        if (unwritten[i].count > 0 && get_tick(&unwritten[i], i, 0) < next)
            next = get_tick(&unwritten[i], i, 0);
    return next;
}

bool session_write(const octree_session *session, const point_values *values, FILE *out)
{
    json_counted_array unwritten[SESSION_LISTS];
    for (int i = 0; i < SESSION_LISTS; i++)
        unwritten[i] = get_session_list(session, i);
    session_write_header(session, values, out);
    for (uint64_t tick; (tick = find_next_tick(unwritten)) != OCTREE_EVERY_TICK;) {
        octree_session now = {.keys = NULL}; /* a session that has only the items of this tick */
        for (int i = 0; i < SESSION_LISTS; i++) {
            json_counted_array *list = &unwritten[i];
            size_t count = 0;
            while (count < list->count && get_tick(list, i, count) == tick)
                count++;
            set_session_list(&now, i, list->items, count);
            if (count > 0)
                *list = (json_counted_array){get_item(list, i, count), list->count - count};
        }
        /* if the tick is a gap, only the gap is written, because the game plays no other input in this tick */
        const octree_input input = now.gap_count ? (octree_input){.gap = now.gaps} : session_collect_input(&now);
        session_write_tick(tick, &input, values, out);
    }
    return fflush(out) == 0 && !ferror(out);
}
