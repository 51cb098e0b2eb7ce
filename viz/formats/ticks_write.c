/* SPDX-License-Identifier: MIT */
/* ticks_write.c - the tables of the members of a line of ticks.jsonl, and functions that write their values. */
#include "ticks_write.h"
#include "json_table.h"
#include "octree/digest.h"
#include "octree/octree.h"

#include <inttypes.h>

char *digest_print(uint64_t digest, char text[DIGEST_TEXT])
{
    snprintf(text, DIGEST_TEXT, "%016" PRIx64, digest);
    return text;
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

static void write_unsigned(json_writer *w, const void *from)
{
    json_write_integer(w, *(const unsigned *)from);
}

static void write_digest(json_writer *w, const void *from)
{
    char text[DIGEST_TEXT];
    json_write_string(w, digest_print(*(const uint64_t *)from, text));
}

static void write_point_ids(json_writer *w, const octree_point *points, size_t count)
{
    json_write_begin_array(w);
    for (size_t i = 0; i < count; i++)
        json_write_integer(w, points[i].id);
    json_write_end_array(w);
}

static void write_ids(json_writer *w, const void *from)
{
    const json_counted points = json_counted_at(from);
    write_point_ids(w, points.items, points.count);
}

static void write_addresses(json_writer *w, const void *from)
{
    const json_counted addresses = json_counted_at(from);
    char text[OCTREE_ADDRESS_TEXT];
    json_write_begin_array(w);
    for (size_t i = 0; i < addresses.count; i++)
        json_write_string(w, octree_address_format(((const octree_address *)addresses.items)[i], text));
    json_write_end_array(w);
}

/* Write the nodes that split or merged: a list, or the count and a digest if there are more than TICK_LISTED. */
static void write_nodes(json_writer *w, const void *from)
{
    const json_counted addresses = json_counted_at(from);
    uint64_t digest = OCTREE_DIGEST_START;
    if (addresses.count <= TICK_LISTED) {
        write_addresses(w, from);
        return;
    }
    for (size_t i = 0; i < addresses.count; i++)
        digest = octree_digest_word(digest, ((const octree_address *)addresses.items)[i]);
    json_write_begin_object(w);
    json_member_integer(w, "count", addresses.count);
    json_write_key(w, "digest");
    write_digest(w, &digest);
    json_write_end_object(w);
}

static bool has_count(const void *from)
{
    return *(const uint64_t *)from > 0;
}

static const json_member cost_members[] = {
    {"nodes", &json_uint64, .offset = offsetof(octree_cost, nodes)},
    {"leaves", &json_uint64, .offset = offsetof(octree_cost, leaves)},
    {"points", &json_uint64, .offset = offsetof(octree_cost, points)},
    {"pruned", &json_uint64, .offset = offsetof(octree_cost, pruned)},
    {"taken", JSON_CODEC(NULL, json_write_uint64, has_count), .offset = offsetof(octree_cost, taken)},
    {0},
};

static const json_member neighbor_members[] = {
    {"id", &json_uint64, .offset = offsetof(octree_neighbor, point.id)},
    {"position", &json_vector, .offset = offsetof(octree_neighbor, point.position)},
    {"distance", &json_number, .offset = offsetof(octree_neighbor, distance)},
    {0},
};

/* ---- Members that read several fields of the tick ----------------------------------------------------------- */

static void write_key(json_writer *w, const void *from)
{
    const char key[2] = {*(const char *)from, 0};
    if (key[0])
        json_write_string(w, key);
    else
        json_write_null(w);
}

/* Write a position of the player; null if the tick has no player. */
static void write_player_position(json_writer *w, const octree_tick *tick, const double place[3])
{
    if (tick->has_player)
        json_write_numbers(w, place, 3);
    else
        json_write_null(w);
}

static void write_player(json_writer *w, const void *from)
{
    const octree_tick *tick = from;
    write_player_position(w, tick, tick->player);
}

static void write_attempt(json_writer *w, const void *from)
{
    const octree_tick *tick = from;
    write_player_position(w, tick, tick->attempt);
}

static void write_events(json_writer *w, const void *from)
{
    const unsigned events = *(const unsigned *)from;
    json_write_begin_array(w);
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        if (events >> i & 1)
            json_write_string(w, octree_event_name(1u << i));
    json_write_end_array(w);
}

static void write_gap(json_writer *w, const void *from)
{
    json_write_string(w, *(const char *const *)from);
}

static void write_refusals(json_writer *w, const void *from)
{
    const octree_tick *tick = from;
    json_write_begin_array(w);
    for (size_t i = 0; i < tick->refusal_count; i++) {
        json_write_begin_object(w);
        json_member_integer(w, "id", tick->refusals[i].id);
        json_member_text(w, "why", octree_status_name(tick->refusals[i].why));
        json_member_vector(w, "position", tick->refusals[i].position);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

/* ---- Answers ------------------------------------------------------------------------------------------------ */

/* Write neighbours. If the query asks for several, they are a list; otherwise the one neighbour's members are members
 * of the answer, or "id" is null if there is none. */
static void write_neighbors(json_writer *w, const octree_answer *answer, bool several)
{
    if (!several && answer->count > 0) {
        json_write_members(w, neighbor_members, answer->neighbors);
        return;
    }
    json_write_key(w, several ? "neighbors" : "id");
    if (!several) {
        json_write_null(w);
        return;
    }
    json_write_begin_array(w);
    for (size_t i = 0; i < answer->count; i++)
        json_write_object(w, neighbor_members, &answer->neighbors[i]);
    json_write_end_array(w);
}

static void write_points_if_any(json_writer *w, const char *key, const octree_point *points, size_t count)
{
    if (count == 0)
        return;
    json_write_key(w, key);
    write_point_ids(w, points, count);
}

/* Write the answer of the foreign index and the judgement of it; nothing if the query has no foreign answer. */
static void write_judgement(json_writer *w, const octree_answer *answer, const octree_query_traits *about)
{
    const octree_judgement *judgement = &answer->judgement;
    if (!judgement->judged)
        return;
    json_member_begin_object(w, "judged");
    json_member_begin_array(w, "answer");
    for (size_t i = 0; i < judgement->given_count; i++)
        json_write_integer(w, judgement->given[i]);
    json_write_end_array(w);
    if (answer->precision != OCTREE_DOUBLES)
        json_member_text(w, "mode", octree_precision_name(answer->precision));
    json_member_text(w, "wrong", octree_wrong_name(judgement->wrong));
    if (judgement->wrong && judgement->wrong <= OCTREE_WRONG_SKIPPED)
        json_member_integer(w, "wrong_id", judgement->wrong_id);
    json_member_integer(w, "expected", judgement->expected);
    write_points_if_any(w, "missing", judgement->missing, judgement->missing_count);
    write_points_if_any(w, "extra", judgement->extra, judgement->extra_count);
    if (judgement->rank)
        json_member_integer(w, "rank", judgement->rank);
    if (about->neighbors)
        json_member_number(w, "ratio", judgement->ratio);
    json_write_end_object(w);
}

void tick_write_parameters(json_writer *w, const octree_answer *answer)
{
    const octree_query_traits *about = octree_query_about(answer->kind);
    for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++) {
        const octree_query_member_traits *member = octree_query_member_at(i);
        const char *value = (const char *)answer + member->in_answer, *key = member->key;
        if (!(about->members & member->bit))
            continue;
        if (member->bit == OCTREE_QUERY_HAS_TARGET)
            key = about->neighbors ? "target" : "center";
        switch (member->type) {
        case OCTREE_MEMBER_BOX:
            json_member_vector(w, "min", ((const octree_box *)value)->min);
            json_member_vector(w, "max", ((const octree_box *)value)->max);
            break;
        case OCTREE_MEMBER_POSITION:
            json_member_vector(w, key, (const double *)value);
            break;
        case OCTREE_MEMBER_COUNT:
            json_member_integer(w, key, *(const size_t *)value);
            break;
        case OCTREE_MEMBER_LENGTH:
            json_member_number(w, key, *(const double *)value);
            break;
        }
    }
}

static void write_answer(json_writer *w, const octree_answer *answer, const octree_query_traits *about)
{
    tick_write_parameters(w, answer);
    if (answer->skip == OCTREE_SKIP_ID)
        json_member_integer(w, "skip", answer->skip_id);
    if (answer->skip == OCTREE_SKIP_COINCIDENT)
        json_member_text(w, "skip", "coincident");
    if (answer->epsilon > 0)
        json_member_number(w, "epsilon", answer->epsilon);
    if (about->neighbors) {
        write_neighbors(w, answer, about->members & OCTREE_QUERY_HAS_K);
    } else {
        json_write_key(w, "ids");
        write_point_ids(w, answer->points, answer->count);
    }
    json_write_key(w, "cost");
    json_write_object(w, cost_members, &answer->cost);
    write_judgement(w, answer, about);
}

void tick_write_answer(json_writer *w, const octree_answer *answer)
{
    const octree_query_traits *about = octree_query_about(answer->kind);
    json_write_begin_object(w);
    json_member_begin_object(w, about->name);
    write_answer(w, answer, about);
    json_write_end_object(w);
    json_write_end_object(w);
}

static void write_answers(json_writer *w, const void *from)
{
    const octree_tick *tick = from;
    json_write_begin_array(w);
    for (size_t i = 0; i < tick->answer_count; i++)
        tick_write_answer(w, &tick->answers[i]);
    json_write_end_array(w);
}

/* ---- Foreign nodes ----------------------------------------------------------------------------------------- */

static bool has_foreign(const void *from)
{
    return ((const octree_tick *)from)->foreign.given;
}

static void write_wrong_node(json_writer *w, const octree_wrong_node *fault)
{
    json_write_begin_object(w);
    json_member_text(w, "wrong", octree_wrong_node_name(fault->kind));
    if (fault->kind != OCTREE_NODE_LOST_POINT)
        json_member_integer(w, "node", fault->node);
    if (fault->kind != OCTREE_NODE_OUTSIDE_PARENT && fault->kind != OCTREE_NODE_UNKNOWN_NODE)
        json_member_integer(w, "point", fault->point);
    if (fault->kind == OCTREE_NODE_PRUNED_POINT || fault->kind == OCTREE_NODE_UNKNOWN_NODE)
        json_member_integer(w, "answer", fault->answer);
    json_write_end_object(w);
}

/* Write the number of wrong findings, in total and of each kind, and the first of them. */
static void write_wrong_nodes(json_writer *w, const octree_foreign_state *foreign)
{
    json_member_begin_object(w, "wrong");
    json_member_integer(w, "count", foreign->wrong_count);
    for (int kind = 0; kind < OCTREE_WRONG_NODE_KINDS; kind++)
        if (foreign->wrong[kind])
            json_member_integer(w, octree_wrong_node_name((octree_wrong_node_kind)kind), foreign->wrong[kind]);
    json_member_begin_array(w, "first");
    for (size_t i = 0; i < foreign->listed_count; i++)
        write_wrong_node(w, &foreign->listed[i]);
    json_write_end_array(w);
    json_write_end_object(w);
}

static void write_foreign(json_writer *w, const void *from)
{
    const octree_foreign_state *foreign = &((const octree_tick *)from)->foreign;
    json_write_begin_object(w);
    json_member_integer(w, "count", foreign->node_count);
    json_member_integer(w, "leaves", foreign->leaf_count);
    json_member_integer(w, "depth", foreign->depth);
    json_write_key(w, "digest");
    write_digest(w, &foreign->digest);
    for (int met = 0; met < OCTREE_NODE_VISITS; met++)
        json_member_integer(w, octree_node_visit_name((octree_node_visit)met), foreign->visits[met]);
    write_wrong_nodes(w, foreign);
    json_write_end_object(w);
}

/* ---- The line ----------------------------------------------------------------------------------------------- */

/* The numbers of nodes that all queries of the tick visited, took whole and pruned, and of leaves with points found. */
static const json_member visit_members[] = {
    {"visited", &json_size, .offset = offsetof(octree_tick, touched[OCTREE_TRACE_VISITED])},
    {"taken", &json_size, .offset = offsetof(octree_tick, touched[OCTREE_TRACE_TAKEN])},
    {"pruned", &json_size, .offset = offsetof(octree_tick, touched[OCTREE_TRACE_PRUNED])},
    {"hit", &json_size, .offset = offsetof(octree_tick, hit_leaf_count)},
    {0},
};

static const json_member tree_members[] = {
    {"points", &json_size, .offset = offsetof(octree_tick, stats.points)},
    {"nodes", &json_size, .offset = offsetof(octree_tick, stats.nodes)},
    {"leaves", &json_size, .offset = offsetof(octree_tick, stats.leaves)},
    {"depth", JSON_CODEC(NULL, write_unsigned, NULL), .offset = offsetof(octree_tick, stats.depth)},
    {"digest", JSON_CODEC(NULL, write_digest, NULL), .offset = offsetof(octree_tick, tree_digest)},
    {0},
};

/* A line has three parts: line_members, then one of the two tables of splits and merges, then last_members. */
static const json_member line_members[] = {
    {"tick", &json_uint64, .offset = offsetof(octree_tick, number)},
    {"key", JSON_CODEC(NULL, write_key, NULL), .offset = offsetof(octree_tick, key)},
    {"player", JSON_CODEC(NULL, write_player, NULL), .offset = 0},
    {"events", JSON_CODEC(NULL, write_events, NULL), .offset = offsetof(octree_tick, events)},
    {"from", &json_vector, .offset = offsetof(octree_tick, from), .given = offsetof(octree_tick, swept)},
    {"attempt", JSON_CODEC(NULL, write_attempt, NULL), .offset = 0},
    {"hits", JSON_CODEC(NULL, write_ids, NULL), .offset = offsetof(octree_tick, hits)},
    {"hit_cost", &json_structure, .offset = offsetof(octree_tick, hit_cost), .members = cost_members},
    {"answers", JSON_CODEC(NULL, write_answers, NULL), .offset = 0},
    {"visits", &json_structure, .offset = 0, .members = visit_members},
    {"foreign_nodes", JSON_CODEC(NULL, write_foreign, has_foreign), .offset = 0},
    {"refusals", JSON_CODEC(NULL, write_refusals, NULL), .offset = 0},
    {0},
};

static const json_member node_members[] = {
    {"splits", JSON_CODEC(NULL, write_nodes, NULL), .offset = offsetof(octree_tick, splits)},
    {"merges", JSON_CODEC(NULL, write_nodes, NULL), .offset = offsetof(octree_tick, merges)},
    {0},
};

static const json_member listed_node_members[] = {
    {"splits", JSON_CODEC(NULL, write_addresses, NULL), .offset = offsetof(octree_tick, splits)},
    {"merges", JSON_CODEC(NULL, write_addresses, NULL), .offset = offsetof(octree_tick, merges)},
    {0},
};

static const json_member last_members[] = {
    {"tree", &json_structure, .offset = 0, .members = tree_members},
    {0},
};

/* The members of a tick that is a gap. */
static const json_member gap_members[] = {
    {"tick", &json_uint64, .offset = offsetof(octree_tick, number)},
    {"gap", JSON_CODEC(NULL, write_gap, NULL), .offset = offsetof(octree_tick, gap)},
    {0},
};

void tick_write(FILE *out, const octree_tick *tick, const tick_extras *extras)
{
    json_writer writer = {.out = out}, *w = &writer;
    char digest[DIGEST_TEXT];
    json_write_begin_object(w);
    if (tick->gap) {
        json_write_members(w, gap_members, tick);
    } else {
        json_write_members(w, line_members, tick);
        json_write_members(w, extras->whole ? listed_node_members : node_members, tick);
        json_write_members(w, last_members, tick);
    }
    if (extras->frame) {
        json_member_text(w, "frame", extras->frame);
        json_member_text(w, "scene", digest_print(extras->scene_digest, digest));
    }
    json_write_end_object(w);
    json_write_end_line(w);
}
