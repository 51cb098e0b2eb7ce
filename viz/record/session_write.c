/* session_write.c - a session as a file: the header with a member a line and a point a line, then a tick a line. */
#include "json_write.h"
#include "session_file.h"

#include <string.h>

static void write_whole(json_writer *writer, const char *key, uint64_t value)
{
    json_write_key(writer, key);
    json_write_integer(writer, value);
}

/* ---- The parts of the header -------------------------------------------------------------------------------- */

/* The options that a tree has in force: it clamps them. */
static void write_tree(json_writer *writer, const octree_def *def)
{
    json_write_key(writer, "tree");
    json_write_begin_object(writer);
    write_whole(writer, "capacity", def->leaf_capacity < UINT32_MAX ? def->leaf_capacity : UINT32_MAX);
    write_whole(writer, "depth", def->max_depth < OCTREE_MAX_DEPTH ? def->max_depth : OCTREE_MAX_DEPTH);
    json_write_key(writer, "full");
    json_write_string(writer, def->full_leaf == OCTREE_GROW ? "grow" : "refuse");
    json_write_end_object(writer);
}

static void write_true(json_writer *writer, const char *key)
{
    json_write_key(writer, key);
    json_write_bool(writer, true);
}

/* Where a player who is no body begins, and how it moves. */
static void write_walk(json_writer *writer, const octree_player *player)
{
    json_member_vector(writer, "position", player->position);
    json_write_key(writer, "step");
    json_write_number(writer, player->step);
}

static void write_player(json_writer *writer, const octree_player *player)
{
    json_write_key(writer, "player");
    if (player->kind == OCTREE_PLAYER_NONE) {
        json_write_null(writer);
        return;
    }
    json_write_begin_object(writer);
    write_whole(writer, "id", player->id);
    if (player->kind == OCTREE_PLAYER_BODY)
        write_true(writer, "body");
    else
        write_walk(writer, player);
    json_write_key(writer, "box_size");
    json_write_number(writer, player->box_size);
    if (player->sweep)
        write_true(writer, "sweep");
    json_write_end_object(writer);
}

/* A velocity of -0 is written too: what is read back has the same bits. */
static bool has_velocity(const octree_body *body)
{
    static const double none[3];
    return memcmp(body->velocity, none, sizeof none) != 0;
}

static void write_resting(json_writer *writer, const octree_body *body)
{
    json_write_begin_array(writer);
    for (int axis = 0; axis < 3; axis++)
        json_write_number(writer, body->position[axis]);
    json_write_integer(writer, body->id);
    json_write_end_array(writer);
}

static void write_body(json_writer *writer, const octree_body *body)
{
    json_write_begin_object(writer);
    write_whole(writer, "id", body->id);
    json_member_vector(writer, "position", body->position);
    if (has_velocity(body))
        json_member_vector(writer, "velocity", body->velocity);
    json_write_end_object(writer);
}

static void write_points(json_writer *writer, const octree_session *session)
{
    json_write_key(writer, "points");
    json_write_begin_array(writer);
    for (size_t i = 0; i < session->body_count; i++) {
        const octree_body *body = &session->bodies[i];
        json_write_newline(writer);
        if (has_velocity(body))
            write_body(writer, body);
        else
            write_resting(writer, body);
    }
    if (session->body_count > 0)
        json_write_newline(writer);
    json_write_end_array(writer);
}

/* ---- Edits and queries -------------------------------------------------------------------------------------- */

static void write_edit(json_writer *writer, const octree_edit *edit)
{
    json_write_begin_object(writer);
    switch (edit->kind) {
    case OCTREE_EDIT_INSERT:
        json_write_key(writer, "insert");
        write_body(writer, &edit->body);
        break;
    case OCTREE_EDIT_REMOVE:
        write_whole(writer, "remove", edit->body.id);
        break;
    case OCTREE_EDIT_MOVE:
        json_write_key(writer, "move");
        json_write_begin_object(writer);
        write_whole(writer, "id", edit->body.id);
        json_member_vector(writer, "position", edit->body.position);
        json_write_end_object(writer);
        break;
    }
    json_write_end_object(writer);
}

static void write_place(json_writer *writer, const char *key, const octree_query *query)
{
    if (!query->at_player) {
        json_member_vector(writer, key, query->target);
        return;
    }
    json_write_key(writer, key);
    json_write_string(writer, "player");
}

static void write_query(json_writer *writer, const octree_query *query)
{
    const char *name = octree_query_name(query->kind);
    json_write_begin_object(writer);
    switch (query->kind) {
    case OCTREE_QUERY_RANGE:
        json_member_box(writer, name, &query->box);
        if (query->at_player)
            write_place(writer, "at", query);
        break;
    case OCTREE_QUERY_KNEAREST: /* no tree holds more */
        write_whole(writer, name, query->k < UINT32_MAX ? query->k : UINT32_MAX);
        write_place(writer, "at", query);
        break;
    case OCTREE_QUERY_RADIUS:
        json_write_key(writer, name);
        json_write_number(writer, query->radius);
        write_place(writer, "at", query);
        break;
    default:
        write_place(writer, name, query);
        break;
    }
    json_write_end_object(writer);
}

/* Write the queries of one tick, which begin at `first`, if there are any. Returns the first behind them. */
static size_t write_queries(json_writer *writer, const octree_session *session, size_t first, uint64_t tick)
{
    size_t i = first;
    if (i == session->query_count || session->queries[i].tick != tick)
        return i;
    json_write_key(writer, "queries");
    json_write_begin_array(writer);
    for (; i < session->query_count && session->queries[i].tick == tick; i++)
        write_query(writer, &session->queries[i]);
    json_write_end_array(writer);
    return i;
}

/* The same for edits. */
static size_t write_edits(json_writer *writer, const octree_session *session, size_t first, uint64_t tick)
{
    size_t i = first;
    if (i == session->edit_count || session->edits[i].tick != tick)
        return i;
    json_write_key(writer, "edits");
    json_write_begin_array(writer);
    for (; i < session->edit_count && session->edits[i].tick == tick; i++)
        write_edit(writer, &session->edits[i]);
    json_write_end_array(writer);
    return i;
}

/* ---- The file ----------------------------------------------------------------------------------------------- */

/* `standing` is the first query of every tick. */
static void write_header(json_writer *writer, const octree_session *session, size_t standing)
{
    json_write_begin_object(writer);
    json_write_key(writer, "octreel");
    json_write_string(writer, "session");
    write_whole(writer, "version", 1);
    json_write_newline(writer);
    json_member_box(writer, "world", &session->tree.world);
    json_write_newline(writer);
    write_tree(writer, &session->tree);
    json_write_newline(writer);
    write_player(writer, &session->player);
    if (session->keys) {
        json_write_newline(writer);
        json_write_key(writer, "keys");
        json_write_string(writer, session->keys);
    }
    json_write_newline(writer);
    write_whole(writer, "ticks", session->ticks);
    json_write_newline(writer);
    write_queries(writer, session, standing, OCTREE_EVERY_TICK);
    json_write_newline(writer);
    write_points(writer, session);
    json_write_end_object(writer);
    json_write_end_line(writer);
}

static uint64_t earlier(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

static void write_ticks(json_writer *writer, const octree_session *session, size_t standing)
{
    size_t edit = 0, query = 0;
    while (edit < session->edit_count || query < standing) {
        uint64_t edited = edit < session->edit_count ? session->edits[edit].tick : UINT64_MAX;
        uint64_t tick = earlier(edited, query < standing ? session->queries[query].tick : UINT64_MAX);
        json_write_begin_object(writer);
        write_whole(writer, "tick", tick);
        edit = write_edits(writer, session, edit, tick);
        query = write_queries(writer, session, query, tick);
        json_write_end_object(writer);
        json_write_end_line(writer);
    }
}

bool session_write(const octree_session *session, FILE *out)
{
    json_writer writer = {.out = out};
    size_t standing = session->query_count;
    while (standing > 0 && session->queries[standing - 1].tick == OCTREE_EVERY_TICK)
        standing--;
    write_header(&writer, session, standing);
    write_ticks(&writer, session, standing);
    return fflush(out) == 0 && !ferror(out);
}
