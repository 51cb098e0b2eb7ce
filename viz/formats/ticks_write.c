/* SPDX-License-Identifier: MIT */
/* ticks_write.c - the tables of the members of a line of ticks.jsonl, and the functions that write their values. */
#include "frustum.h"
#include "ticks_write.h"
#include "frame_file.h"
#include "json_table.h"
#include "octree/digest.h"
#include "octree/octree.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

char *digest_print(uint64_t digest, char text[DIGEST_TEXT])
{
    snprintf(text, DIGEST_TEXT, "%016" PRIx64, digest);
    return text;
}

/* A codec without a reader, for members that are written but never read. */
#define WRITE(how) JSON_CODEC(NULL, how)

JSON_NAMES(precision_name, octree_precision_name, octree_precision)
JSON_NAMES(bounds_name, octree_bounds_name, octree_bounds)
JSON_NAMES(status_name, octree_status_name, octree_status)
JSON_NAMES(wrong_name, octree_wrong_name, octree_wrong_kind)
JSON_NAMES(wrong_node_name, octree_wrong_node_name, octree_wrong_node_kind)

static const char *event_kind_name(int n)
{
    return octree_event_name(1u << n);
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

static void write_digest(json_writer *w, const void *from)
{
    char text[DIGEST_TEXT];
    json_write_string(w, digest_print(*(const uint64_t *)from, text));
}

/* Write the ids of points. */
static void write_point_ids(json_writer *w, const void *from)
{
    const json_counted_array points = json_get_counted_array(from);
    json_write_begin_array(w);
    for (size_t i = 0; i < points.count; i++)
        json_write_integer(w, ((const octree_point *)points.items)[i].id);
    json_write_end_array(w);
}

static void write_addresses(json_writer *w, const void *from)
{
    const json_counted_array addresses = json_get_counted_array(from);
    char text[OCTREE_ADDRESS_TEXT];
    json_write_begin_array(w);
    for (size_t i = 0; i < addresses.count; i++)
        json_write_string(w, octree_address_format(((const octree_address *)addresses.items)[i], text));
    json_write_end_array(w);
}

/* Returns whether a list of this length is written whole. Otherwise its count and a digest are written. */
static bool is_listed(const json_writer *w, size_t count)
{
    return count <= TICK_LISTED || ((const tick_extras *)w->context)->whole;
}

static void write_count_and_digest(json_writer *w, size_t count, const uint64_t *words, size_t word_count)
{
    uint64_t digest = OCTREE_DIGEST_START;
    for (size_t i = 0; i < word_count; i++)
        digest = octree_digest_word(digest, words[i]);
    json_write_begin_object(w);
    json_write_integer_member(w, "count", count);
    json_write_key(w, "digest");
    write_digest(w, &digest);
    json_write_end_object(w);
}

/* Writes the nodes that split or merged in a tick. */
static void write_changed_nodes(json_writer *w, const void *from)
{
    const json_counted_array addresses = json_get_counted_array(from);
    if (is_listed(w, addresses.count))
        write_addresses(w, from);
    else
        write_count_and_digest(w, addresses.count, addresses.items, addresses.count);
}

/* Writes a pair of bodies as [a, b]. A pair consists of two words. */
static void write_pair(json_writer *w, const void *from)
{
    json_ids.write(w, &(json_counted_array){from, 2});
}

static void write_pairs(json_writer *w, const void *from)
{
    const json_counted_array pairs = json_get_counted_array(from);
    const uint64_t *ids = pairs.items;
    if (!is_listed(w, pairs.count)) {
        write_count_and_digest(w, pairs.count, ids, 2 * pairs.count);
        return;
    }
    json_write_begin_array(w);
    for (size_t i = 0; i < pairs.count; i++)
        write_pair(w, &ids[2 * i]);
    json_write_end_array(w);
}

static const json_member cost_members[] = {
    {"nodes", &json_uint64, .offset = offsetof(octree_cost, nodes)},
    {"leaves", &json_uint64, .offset = offsetof(octree_cost, leaves)},
    {"points", &json_uint64, .offset = offsetof(octree_cost, points)},
    {"pruned", &json_uint64, .offset = offsetof(octree_cost, pruned)},
    {"taken", &json_uint64, .offset = offsetof(octree_cost, taken), JSON_IF(octree_cost, taken)},
    {0},
};

static const json_member refusal_members[] = {
    {"id", &json_uint64, .offset = offsetof(octree_refusal, id)},
    {"why", &json_choice, .offset = offsetof(octree_refusal, why), .names = status_name},
    {"position", &json_vector, .offset = offsetof(octree_refusal, position)},
    {0},
};

/* ---- Answers ------------------------------------------------------------------------------------------------ */

static bool has_wrong_point(const void *structure)
{
    const octree_judgement *judgement = &((const octree_answer *)structure)->judgement;
    return judgement->wrong && judgement->wrong <= OCTREE_WRONG_SKIPPED;
}

static bool has_neighbors(const void *structure)
{
    return octree_query_about(((const octree_answer *)structure)->kind)->neighbors;
}

#define JUDGED(member) .offset = offsetof(octree_answer, judgement.member)

/* The members of an answer that are about a foreign index: the answer of the index, and the judgement of this
 * answer. */
static const json_member judgement_members[] = {
    {"answer", &json_ids, JUDGED(given)},
    {"mode", &json_choice, .offset = offsetof(octree_answer, precision), .names = precision_name,
     JSON_IF(octree_answer, precision)},
    {"wrong", &json_choice, JUDGED(wrong), .names = wrong_name},
    {"wrong_id", &json_uint64, JUDGED(wrong_id), .is_set = has_wrong_point},
    {"expected", &json_size, JUDGED(expected)},
    {"missing", WRITE(write_point_ids), JUDGED(missing), JSON_IF(octree_answer, judgement.missing_count)},
    {"extra", WRITE(write_point_ids), JUDGED(extra), JSON_IF(octree_answer, judgement.extra_count)},
    {"rank", &json_size, JUDGED(rank), JSON_IF(octree_answer, judgement.rank)},
    {"ratio", &json_number, JUDGED(ratio), .is_set = has_neighbors},
    {0},
};

static const json_member last_answer_members[] = {
    {"cost", &json_structure, .offset = offsetof(octree_answer, cost), .members = cost_members},
    {"judged", &json_structure, .offset = 0, .given = offsetof(octree_answer, judgement.judged),
     .members = judgement_members},
    {0},
};

/* Writes the result of a query. The result of a query for one neighbour is written as members of the answer; "id" is
 * null if no neighbour was found. The result of a query for k neighbours, and the result of any other query, is a
 * list. */
static void write_result(json_writer *w, const octree_answer *answer, const octree_query_traits *about)
{
    const json_member members[] = {
        {"id", &json_uint64, .offset = offsetof(octree_neighbor, point.id)},
        {"position", &json_vector, .offset = offsetof(octree_neighbor, point.position)},
        {about->measure, &json_number, .offset = offsetof(octree_neighbor, distance)},
        {0},
    };
    const json_member list = {.members = members, .size = sizeof(octree_neighbor)};
    if (!about->neighbors) {
        json_write_key(w, "ids");
        write_point_ids(w, &(json_counted_array){answer->points, answer->count});
    } else if (about->members & OCTREE_QUERY_HAS_K) {
        json_write_key(w, "neighbors");
        w->row = &list;
        json_structures.write(w, &(json_counted_array){answer->neighbors, answer->count});
    } else if (answer->count > 0) {
        json_write_members(w, members, answer->neighbors);
    } else {
        json_write_text_member(w, "id", NULL);
    }
}

void tick_write_query_parameters(json_writer *w, const octree_answer *answer)
{
    static const json_member rows[] = {
        [OCTREE_MEMBER_BOX] = {.codec = &json_vector},
        [OCTREE_MEMBER_POSITION] = {.codec = &json_vector},
        [OCTREE_MEMBER_DIRECTION] = {.codec = &json_vector},
        [OCTREE_MEMBER_COUNT] = {.codec = &json_size},
        [OCTREE_MEMBER_LENGTH] = {.codec = &json_number, .nonzero_size = sizeof(double)},
        [OCTREE_MEMBER_BOUNDS] = {.codec = &json_choice, .names = bounds_name, .nonzero_size = sizeof(octree_bounds)},
        [OCTREE_MEMBER_FRUSTUM] = {.codec = &json_frustum},
        [OCTREE_MEMBER_EXTENTS] = {.codec = &json_vector, .nonzero_size = sizeof(double[3])}};
    const octree_query_traits *about = octree_query_about(answer->kind);
    for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++) {
        const octree_query_member_traits *member = octree_query_member_at(i);
        json_member table[] = {rows[member->type], {0}, {0}};
        if (!(about->members & member->bit))
            continue;
        table[0].name = member->bit == OCTREE_QUERY_HAS_TARGET      ? about->place
                        : member->bit == OCTREE_QUERY_HAS_DIRECTION ? "direction"
                        : member->bit == OCTREE_QUERY_HAS_FRUSTUM   ? "half_spaces"
                        : member->bit == OCTREE_QUERY_HAS_TO        ? "to"
                                                                    : member->key;
        table[0].offset = table[0].nonzero = member->in_answer;
        if (!member->optional)
            table[0].nonzero_size = 0;
        if (member->type == OCTREE_MEMBER_BOX) {
            table[0].name = "min";
            table[1] = table[0];
            table[1].name = "max";
            table[1].offset += offsetof(octree_box, max);
        }
        json_write_members(w, table, answer);
    }
}

void tick_write_answer(json_writer *w, const octree_answer *answer)
{
    const octree_query_traits *about = octree_query_about(answer->kind);
    json_write_begin_object(w);
    json_begin_object_member(w, about->name);
    tick_write_query_parameters(w, answer);
    if (answer->skip == OCTREE_SKIP_ID)
        json_write_integer_member(w, "skip", answer->skip_id);
    if (answer->skip == OCTREE_SKIP_COINCIDENT)
        json_write_text_member(w, "skip", "coincident");
    if (answer->epsilon > 0)
        json_write_number_member(w, "epsilon", answer->epsilon);
    write_result(w, answer, about);
    json_write_members(w, last_answer_members, answer);
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

static bool has_node(const void *structure)
{
    return ((const octree_wrong_node *)structure)->kind != OCTREE_NODE_LOST_POINT;
}

static bool has_point(const void *structure)
{
    const octree_wrong_node_kind kind = ((const octree_wrong_node *)structure)->kind;
    return kind != OCTREE_NODE_OUTSIDE_PARENT && kind != OCTREE_NODE_UNKNOWN_NODE;
}

static bool has_foreign_answer(const void *structure)
{
    const octree_wrong_node_kind kind = ((const octree_wrong_node *)structure)->kind;
    return kind == OCTREE_NODE_PRUNED_POINT || kind == OCTREE_NODE_UNKNOWN_NODE;
}

static const json_member wrong_node_members[] = {
    {"wrong", &json_choice, .offset = offsetof(octree_wrong_node, kind), .names = wrong_node_name},
    {"node", &json_uint64, .offset = offsetof(octree_wrong_node, node), .is_set = has_node},
    {"point", &json_uint64, .offset = offsetof(octree_wrong_node, point), .is_set = has_point},
    {"answer", &json_size, .offset = offsetof(octree_wrong_node, answer), .is_set = has_foreign_answer},
    {0},
};

/* Writes how many nodes are wrong, in total and of each kind, and the first few wrong nodes. */
static void write_wrong_nodes(json_writer *w, const void *from)
{
    const octree_foreign_state *foreign = from;
    json_write_begin_object(w);
    json_write_integer_member(w, "count", foreign->wrong_count);
    for (int kind = 0; kind < OCTREE_WRONG_NODE_KINDS; kind++)
        if (foreign->wrong[kind])
            json_write_integer_member(w, wrong_node_name(kind), foreign->wrong[kind]);
    json_begin_array_member(w, "first");
    for (size_t i = 0; i < foreign->listed_count; i++)
        json_write_object(w, wrong_node_members, &foreign->listed[i]);
    json_write_end_array(w);
    json_write_end_object(w);
}

#define FOREIGN(member) .offset = offsetof(octree_foreign_state, member)

static const json_member foreign_members[] = {
    {"count", &json_size, FOREIGN(node_count)},
    {"leaves", &json_size, FOREIGN(leaf_count)},
    {"depth", &json_int, FOREIGN(depth)},
    {"digest", WRITE(write_digest), FOREIGN(digest)},
    {"visited", &json_size, FOREIGN(visits[OCTREE_NODE_VISITED])},
    {"pruned", &json_size, FOREIGN(visits[OCTREE_NODE_PRUNED])},
    {"hit", &json_size, FOREIGN(visits[OCTREE_NODE_HIT])},
    {"wrong", WRITE(write_wrong_nodes), .offset = 0},
    {0},
};

/* ---- Foreign pairs ----------------------------------------------------------------------------------------- */

static bool has_wrong_pair(const void *structure)
{
    const octree_wrong_kind wrong = ((const octree_pair_judgement *)structure)->wrong;
    return wrong && wrong <= OCTREE_WRONG_DUPLICATE;
}

#define PAIRS(member) .offset = offsetof(octree_pair_judgement, member)

static const json_member foreign_pairs_members[] = {
    {"given", WRITE(write_pairs), PAIRS(given)},
    {"wrong", &json_choice, PAIRS(wrong), .names = wrong_name},
    {"wrong_pair", WRITE(write_pair), PAIRS(wrong_pair), .is_set = has_wrong_pair},
    {"expected", &json_size, PAIRS(expected)},
    {"missing", WRITE(write_pairs), PAIRS(missing), JSON_IF(octree_pair_judgement, missing_count)},
    {"extra", WRITE(write_pairs), PAIRS(extra), JSON_IF(octree_pair_judgement, extra_count)},
    {0},
};

void tick_write_foreign_pairs(json_writer *w, const octree_pair_judgement *pairs)
{
    json_write_object(w, foreign_pairs_members, pairs);
}

/* ---- The line ----------------------------------------------------------------------------------------------- */

static void write_key(json_writer *w, const void *from)
{
    const char key[2] = {*(const char *)from, 0};
    if (key[0])
        json_write_string(w, key);
    else
        json_write_null(w);
}

#define TICK(member) .offset = offsetof(octree_tick, member)

/* Counts over all queries of the tick: the nodes that were visited, accepted as a whole and pruned, and the leaves
 * in which points were found. */
static const json_member visit_members[] = {
    {"visited", &json_size, TICK(touched[OCTREE_TRACE_VISITED])},
    {"taken", &json_size, TICK(touched[OCTREE_TRACE_TAKEN])},
    {"pruned", &json_size, TICK(touched[OCTREE_TRACE_PRUNED])},
    {"hit", &json_size, TICK(hit_leaf_count)},
    {0},
};

static const json_member tree_members[] = {
    {"points", &json_size, TICK(stats.points)},         {"nodes", &json_size, TICK(stats.nodes)},
    {"leaves", &json_size, TICK(stats.leaves)},         {"depth", &json_int, TICK(stats.depth)},
    {"digest", WRITE(write_digest), TICK(tree_digest)}, {0},
};

/* The members of a line of ticks.jsonl. If the tick has no player, the positions of the player are null. */
static const json_member line_members[] = {
    {"tick", &json_uint64, TICK(number)},
    {"key", WRITE(write_key), TICK(key)},
    {"player", &json_vector, TICK(player), .given = offsetof(octree_tick, has_player), .nullable = true},
    {"events", &json_set, TICK(events), .names = event_kind_name},
    {"from", &json_vector, TICK(from), .given = offsetof(octree_tick, swept)},
    {"attempt", &json_vector, TICK(attempt), .given = offsetof(octree_tick, has_player), .nullable = true},
    {"hits", WRITE(write_point_ids), TICK(hits)},
    {"hit_cost", &json_structure, TICK(hit_cost), .members = cost_members},
    {"pairs", WRITE(write_pairs), TICK(pairs), JSON_IF(octree_tick, pair_count)},
    {"foreign_pairs", &json_structure, TICK(foreign_pairs), .given = offsetof(octree_tick, foreign_pairs.judged),
     .members = foreign_pairs_members},
    {"answers", WRITE(write_answers), .offset = 0},
    {"visits", &json_structure, .offset = 0, .members = visit_members},
    {"foreign_nodes", &json_structure, TICK(foreign), .given = offsetof(octree_tick, foreign.given),
     .members = foreign_members},
    {"refusals", &json_structures, TICK(refusals), .size = sizeof(octree_refusal), .members = refusal_members},
    {"splits", WRITE(write_changed_nodes), TICK(splits)},
    {"merges", WRITE(write_changed_nodes), TICK(merges)},
    {"tree", &json_structure, .offset = 0, .members = tree_members},
    {0},
};

/* The members of a line of ticks.jsonl whose tick is a gap. */
static const json_member gap_members[] = {
    {"tick", &json_uint64, TICK(number)},
    {"gap", WRITE(json_write_text), TICK(gap)},
    {0},
};

void tick_write(FILE *out, const octree_tick *tick, const tick_extras *extras)
{
    json_writer writer = {.out = out, .context = extras}, *w = &writer;
    char digest[DIGEST_TEXT];
    json_write_begin_object(w);
    json_write_members(w, tick->gap ? gap_members : line_members, tick);
    if (extras->frame) {
        json_write_text_member(w, "frame", extras->frame);
        json_write_text_member(w, "scene", digest_print(extras->scene_digest, digest));
    }
    json_write_end_object(w);
    json_write_end_line(w);
}

bool tick_read_scene_digest(const char *line, size_t size, uint64_t tick, uint64_t *scene)
{
    char name[FRAME_NAME], expected[FRAME_NAME + DIGEST_TEXT + 32];
    const size_t tail = strlen("0123456789abcdef\"}\n");
    if (size < tail)
        return false;
    *scene = strtoull(line + size - tail, NULL, 16);
    const size_t length =
        (size_t)snprintf(expected, sizeof expected, "\"frame\": \"%s\", \"scene\": \"%016" PRIx64 "\"}\n",
                         frame_print_name(tick, name), *scene);
    return size > length && memcmp(line + size - length, expected, length) == 0;
}
