/* session_ticks.c - the objects of one tick each in a session file: edits and queries. */
#include "session_reader.h"

#include <inttypes.h>
#include <string.h>

/* ---- Edits -------------------------------------------------------------------------------------------------- */

static bool read_insert(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    static const session_member members[] = {
        {"id", session_read_id, offsetof(octree_body, id), true},
        {"position", session_read_vector, offsetof(octree_body, position), true},
        {"velocity", session_read_vector, offsetof(octree_body, velocity), false},
        {0},
    };
    octree_edit *edit = into;
    edit->kind = OCTREE_EDIT_INSERT;
    return session_read_members(reader, value, at, members, &edit->body);
}

static bool read_remove(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    octree_edit *edit = into;
    edit->kind = OCTREE_EDIT_REMOVE;
    return session_read_id(reader, value, at, &edit->body.id);
}

static bool read_move(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    static const session_member members[] = {
        {"id", session_read_id, offsetof(octree_body, id), true},
        {"position", session_read_vector, offsetof(octree_body, position), true},
        {0},
    };
    octree_edit *edit = into;
    edit->kind = OCTREE_EDIT_MOVE;
    return session_read_members(reader, value, at, members, &edit->body);
}

static bool read_edit(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    static const session_member kinds[] = {
        {"insert", read_insert, 0, false},
        {"remove", read_remove, 0, false},
        {"move", read_move, 0, false},
        {0},
    };
    (void)into;
    if (json_object_size(value) != 1)
        return session_fail(reader, at, "expected one of {\"insert\": ...}, {\"remove\": ...} and {\"move\": ...}");
    octree_edit *edit = session_append(reader, at, &reader->edits, sizeof *edit);
    if (!edit)
        return false;
    *edit = (octree_edit){.tick = reader->tick};
    return session_read_members(reader, value, at, kinds, edit);
}

static bool read_edits(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    if (reader->tick == 0)
        return session_fail(reader, at, "edits begin at tick 1; what is there at tick 0 are the header's points");
    return session_read_elements(reader, value, at, "a list of edits", read_edit, into);
}

/* ---- Queries ------------------------------------------------------------------------------------------------ */

static bool read_box(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    octree_query *query = into;
    if (!session_read_box(reader, value, at, &query->box))
        return false;
    for (int i = 0; i < 3; i++)
        if (query->box.min[i] > query->box.max[i])
            return session_fail(reader, at, "min must not be above max, and is on %c", "xyz"[i]);
    return true;
}

static bool is_player(const json_t *value)
{
    return json_is_string(value) && strcmp(json_string_value(value), "player") == 0;
}

static bool read_player(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    octree_query *query = into;
    query->at_player = is_player(value);
    return query->at_player || session_expected(reader, value, at, "\"player\"");
}

static bool read_target(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    octree_query *query = into;
    query->at_player = is_player(value);
    if (query->at_player)
        return true;
    if (!json_is_array(value))
        return session_expected(reader, value, at, "\"player\" or three numbers [x, y, z]");
    return session_read_vector(reader, value, at, query->target);
}

static bool read_k(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    uint64_t k;
    if (!session_read_whole(reader, value, at, 0, UINT32_MAX, &k))
        return false;
    *(size_t *)into = (size_t)k;
    return true;
}

/* The members of each kind of query; the first bears its name. */
static const session_member query_members[OCTREE_QUERY_KINDS][SESSION_KIND_MEMBERS] = {
    [OCTREE_QUERY_RANGE] = {{"range", read_box, 0, true}, {"at", read_player, 0, false}},
    [OCTREE_QUERY_NEAREST] = {{"nearest", read_target, 0, true}},
    [OCTREE_QUERY_KNEAREST] = {{"knearest", read_k, offsetof(octree_query, k), true}, {"at", read_target, 0, true}},
    [OCTREE_QUERY_RADIUS] = {{"radius", session_read_positive, offsetof(octree_query, radius), true},
                             {"at", read_target, 0, true}},
};

static bool read_query(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    session_list *list = into;
    const int kind =
        session_read_kind(reader, value, at, query_members, OCTREE_QUERY_KINDS,
                          "{\"range\": ...}, {\"nearest\": ...}, {\"knearest\": ...} or {\"radius\": ...}");
    if (kind == OCTREE_QUERY_KINDS)
        return false;
    octree_query *query = session_append(reader, at, list, sizeof *query);
    if (!query)
        return false;
    *query = (octree_query){.tick = reader->tick, .kind = (octree_query_kind)kind};
    return session_read_members(reader, value, at, query_members[kind], query);
}

bool session_read_queries(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    session_list *list = reader->tick == OCTREE_EVERY_TICK ? &reader->standing : &reader->queries;
    (void)into;
    return session_read_elements(reader, value, at, "a list of queries", read_query, list);
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

static bool read_number_of_tick(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    uint64_t tick;
    (void)into;
    if (!session_read_whole(reader, value, at, 0, SESSION_LAST_TICK, &tick))
        return false;
    if (reader->tick != OCTREE_EVERY_TICK && tick <= reader->tick)
        return session_fail(reader, at, "tick %" PRIu64 " comes after tick %" PRIu64 "; ticks must ascend", tick,
                            reader->tick);
    reader->tick = tick;
    if (!reader->ends)
        reader->session->ticks = tick;
    return true;
}

bool session_read_tick(session_reader *reader, json_t *object)
{
    static const session_member members[] = {
        {"tick", read_number_of_tick, 0, true},
        {"edits", read_edits, 0, false},
        {"queries", session_read_queries, 0, false},
        {"shapes", session_read_shapes, 0, false},
        {0},
    };
    if (json_object_get(object, "octreel"))
        return session_fail(reader, NULL, "a second header; what follows the first are objects of one tick each");
    return session_read_members(reader, object, NULL, members, reader->session);
}
