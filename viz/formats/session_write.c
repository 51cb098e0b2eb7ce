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

static void write_segment(json_writer *writer, const char *name, const octree_shape *shape)
{
    json_write_key(writer, name);
    json_write_begin_array(writer);
    json_write_numbers(writer, shape->at, 3);
    json_write_numbers(writer, shape->to, 3);
    json_write_end_array(writer);
}

static void write_shape(json_writer *writer, const octree_shape *shape)
{
    const char *name = octree_shape_name(shape->kind);
    octree_box box;
    json_write_begin_object(writer);
    switch (shape->kind) {
    case OCTREE_SHAPE_BOX:
        memcpy(box.min, shape->at, sizeof box.min);
        memcpy(box.max, shape->to, sizeof box.max);
        json_member_box(writer, name, &box);
        break;
    case OCTREE_SHAPE_SEGMENT:
        write_segment(writer, name, shape);
        break;
    case OCTREE_SHAPE_LABEL:
        json_member_text(writer, name, shape->text);
        json_member_vector(writer, "at", shape->at);
        break;
    default:
        json_member_vector(writer, name, shape->at);
        break;
    }
    json_write_end_object(writer);
}

/* ---- Lists of them ------------------------------------------------------------------------------------------ */

static void write_queries(json_writer *writer, const octree_query *queries, size_t count)
{
    if (count == 0)
        return;
    json_write_key(writer, "queries");
    json_write_begin_array(writer);
    for (size_t i = 0; i < count; i++)
        write_query(writer, &queries[i]);
    json_write_end_array(writer);
}

static void write_edits(json_writer *writer, const octree_edit *edits, size_t count)
{
    if (count == 0)
        return;
    json_write_key(writer, "edits");
    json_write_begin_array(writer);
    for (size_t i = 0; i < count; i++)
        write_edit(writer, &edits[i]);
    json_write_end_array(writer);
}

static void write_shapes(json_writer *writer, const octree_shape *shapes, size_t count)
{
    if (count == 0)
        return;
    json_write_key(writer, "shapes");
    json_write_begin_array(writer);
    for (size_t i = 0; i < count; i++)
        write_shape(writer, &shapes[i]);
    json_write_end_array(writer);
}

/* ---- The file ----------------------------------------------------------------------------------------------- */

static size_t first_standing_query(const octree_session *session)
{
    size_t first = session->query_count;
    while (first > 0 && session->queries[first - 1].tick == OCTREE_EVERY_TICK)
        first--;
    return first;
}

static size_t first_standing_shape(const octree_session *session)
{
    size_t first = session->shape_count;
    while (first > 0 && session->shapes[first - 1].tick == OCTREE_EVERY_TICK)
        first--;
    return first;
}

/* What is asked and shown at every tick. */
static void write_standing(json_writer *writer, const octree_session *session)
{
    const size_t queries = first_standing_query(session), shapes = first_standing_shape(session);
    json_write_newline(writer);
    if (queries < session->query_count)
        write_queries(writer, session->queries + queries, session->query_count - queries);
    json_write_newline(writer);
    if (shapes < session->shape_count) {
        write_shapes(writer, session->shapes + shapes, session->shape_count - shapes);
        json_write_newline(writer);
    }
}

void session_write_header(const octree_session *session, FILE *out)
{
    json_writer stream = {.out = out}, *writer = &stream;
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
    if (session->ticks != SESSION_ENDLESS) {
        json_write_newline(writer);
        write_whole(writer, "ticks", session->ticks);
    }
    write_standing(writer, session);
    write_points(writer, session);
    json_write_end_object(writer);
    json_write_end_line(writer);
}

void session_write_tick(uint64_t tick, const octree_input *input, FILE *out)
{
    json_writer stream = {.out = out}, *writer = &stream;
    if (input->edit_count == 0 && input->query_count == 0 && input->shape_count == 0)
        return;
    json_write_begin_object(writer);
    write_whole(writer, "tick", tick);
    write_edits(writer, input->edits, input->edit_count);
    write_queries(writer, input->queries, input->query_count);
    write_shapes(writer, input->shapes, input->shape_count);
    json_write_end_object(writer);
    json_write_end_line(writer);
}

static uint64_t earlier(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

/* How much of a session has been written. */
typedef struct written {
    size_t edits, queries, shapes;
} written;

/* The next tick that has anything; UINT64_MAX when there is none. */
static uint64_t next_tick(const octree_session *session, const written *done, const written *all)
{
    uint64_t tick = done->edits < all->edits ? session->edits[done->edits].tick : UINT64_MAX;
    tick = earlier(tick, done->queries < all->queries ? session->queries[done->queries].tick : UINT64_MAX);
    return earlier(tick, done->shapes < all->shapes ? session->shapes[done->shapes].tick : UINT64_MAX);
}

static void write_next_tick(const octree_session *session, uint64_t tick, written *done, const written *all, FILE *out)
{
    octree_input input = {0};
    input.edits = session->edits ? session->edits + done->edits : NULL;
    for (; done->edits < all->edits && session->edits[done->edits].tick == tick; done->edits++)
        input.edit_count++;
    input.queries = session->queries ? session->queries + done->queries : NULL;
    for (; done->queries < all->queries && session->queries[done->queries].tick == tick; done->queries++)
        input.query_count++;
    input.shapes = session->shapes ? session->shapes + done->shapes : NULL;
    for (; done->shapes < all->shapes && session->shapes[done->shapes].tick == tick; done->shapes++)
        input.shape_count++;
    session_write_tick(tick, &input, out);
}

bool session_write(const octree_session *session, FILE *out)
{
    const written all = {session->edit_count, first_standing_query(session), first_standing_shape(session)};
    written done = {0};
    uint64_t tick;
    session_write_header(session, out);
    while ((tick = next_tick(session, &done, &all)) != UINT64_MAX)
        write_next_tick(session, tick, &done, &all, out);
    return fflush(out) == 0 && !ferror(out);
}
