/* SPDX-License-Identifier: MIT */
/* tick_lines.c - see tick_lines.h. */
#include "tick_lines.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "fixture.h"

json_t *json_read(const char *text)
{
    json_error_t error;
    json_t *value = json_loads(text, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &error);
    if (value == NULL)
        fail_msg("%s in %.300s", error.text, text);
    assert_true(json_is_object(value));
    return value;
}

json_t *json_member(const json_t *object, const char *name)
{
    json_t *value = json_object_get(object, name);
    if (value == NULL)
        fail_msg("there is no member %s", name);
    return value;
}

void assert_members(const json_t *object, const char *names)
{
    char copy[512];
    size_t count = 0;
    snprintf(copy, sizeof copy, "%s", names);
    for (char *name = strtok(copy, " "); name != NULL; name = strtok(NULL, " "), count++)
        json_member(object, name);
    assert_int_equal(json_object_size(object), count);
}

void assert_whole_number(const json_t *value, uint64_t expected)
{
    assert_true(json_is_real(value));
    assert_true(json_real_value(value) == (double)expected);
}

void assert_digest(const json_t *value, uint64_t expected)
{
    char text[17];
    snprintf(text, sizeof text, "%016" PRIx64, expected);
    assert_true(json_is_string(value));
    assert_string_equal(json_string_value(value), text);
}

/* The same bits: what is printed must read back to what it was, the sign of zero included. */
static void assert_number(const json_t *value, double expected)
{
    const double read = json_real_value(value);
    assert_true(json_is_real(value));
    assert_memory_equal(&read, &expected, sizeof read);
}

static void assert_position(const json_t *object, const char *name, const double expected[3])
{
    const json_t *list = json_member(object, name);
    assert_int_equal(json_array_size(list), 3);
    for (size_t i = 0; i < 3; i++)
        assert_number(json_array_get(list, i), expected[i]);
}

/* A place of the player. */
static void assert_place(const json_t *line, const char *name, const octree_tick *tick, const double place[3])
{
    if (tick->has_player)
        assert_position(line, name, place);
    else
        assert_true(json_is_null(json_member(line, name)));
}

static void assert_ids(const json_t *list, const octree_point *points, size_t count)
{
    assert_true(json_is_array(list));
    assert_int_equal(json_array_size(list), count);
    for (size_t i = 0; i < count; i++)
        assert_whole_number(json_array_get(list, i), points[i].id);
}

static void assert_addresses(const json_t *list, const octree_address *addresses, size_t count)
{
    char text[OCTREE_ADDRESS_TEXT];
    assert_true(json_is_array(list));
    assert_int_equal(json_array_size(list), count);
    for (size_t i = 0; i < count; i++)
        assert_string_equal(json_string_value(json_array_get(list, i)), octree_address_format(addresses[i], text));
}

/* The names are the header's, in the order of their bits. */
static void assert_events(const json_t *list, unsigned events)
{
    static const char *const names[OCTREE_EVENT_KINDS] = {"moved", "refused", "collided", "full",
                                                          "split", "merged",  "wrong",    "overlapped"};
    size_t at = 0;
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        if ((events & 1u << i) != 0)
            assert_string_equal(json_string_value(json_array_get(list, at++)), names[i]);
    assert_int_equal(json_array_size(list), at);
}

static void assert_refusals(const json_t *list, const octree_tick *tick)
{
    assert_int_equal(json_array_size(list), tick->refusal_count);
    for (size_t i = 0; i < tick->refusal_count; i++) {
        const json_t *row = json_array_get(list, i);
        assert_members(row, "id why position");
        assert_whole_number(json_member(row, "id"), tick->refusals[i].id);
        assert_string_equal(json_string_value(json_member(row, "why")), octree_status_name(tick->refusals[i].why));
        assert_position(row, "position", tick->refusals[i].position);
    }
}

static void assert_cost(const json_t *object, const char *name, const octree_cost *expected)
{
    const json_t *cost = json_member(object, name);
    assert_members(cost, expected->taken ? "nodes leaves points pruned taken" : "nodes leaves points pruned");
    if (expected->taken)
        assert_whole_number(json_member(cost, "taken"), expected->taken);
    assert_whole_number(json_member(cost, "nodes"), expected->nodes);
    assert_whole_number(json_member(cost, "leaves"), expected->leaves);
    assert_whole_number(json_member(cost, "points"), expected->points);
    assert_whole_number(json_member(cost, "pruned"), expected->pruned);
}

static void assert_range(const json_t *range, const octree_answer *answer)
{
    assert_members(range, "min max ids cost");
    assert_position(range, "min", answer->box.min);
    assert_position(range, "max", answer->box.max);
    assert_ids(json_member(range, "ids"), answer->points, answer->count);
}

static void assert_neighbor(const json_t *object, const char *measure, const octree_neighbor *neighbor)
{
    assert_whole_number(json_member(object, "id"), neighbor->point.id);
    assert_position(object, "position", neighbor->point.position);
    assert_number(json_member(object, measure), neighbor->distance);
}

static void assert_nearest(const json_t *nearest, const octree_answer *answer)
{
    assert_members(nearest, answer->count ? "target id position distance cost" : "target id cost");
    assert_position(nearest, "target", answer->target);
    if (answer->count)
        assert_neighbor(nearest, "distance", &answer->neighbors[0]);
    else
        assert_true(json_is_null(json_member(nearest, "id")));
}

static void assert_knearest(const json_t *knearest, const octree_answer *answer)
{
    const json_t *neighbors = json_member(knearest, "neighbors");
    assert_members(knearest, "target k neighbors cost");
    assert_position(knearest, "target", answer->target);
    assert_whole_number(json_member(knearest, "k"), answer->k);
    assert_int_equal(json_array_size(neighbors), answer->count);
    for (size_t i = 0; i < answer->count; i++) {
        assert_members(json_array_get(neighbors, i), "id position distance");
        assert_neighbor(json_array_get(neighbors, i), "distance", &answer->neighbors[i]);
    }
}

static void assert_ray(const json_t *ray, const octree_answer *answer)
{
    char names[80];
    const json_t *hits = json_member(ray, "neighbors");
    snprintf(names, sizeof names, "origin direction k%s%s neighbors cost", answer->thickness > 0 ? " thickness" : "",
             answer->length > 0 ? " length" : "");
    assert_members(ray, names);
    assert_position(ray, "origin", answer->target);
    assert_position(ray, "direction", answer->direction);
    assert_whole_number(json_member(ray, "k"), answer->k);
    assert_int_equal(json_array_size(hits), answer->count);
    for (size_t i = 0; i < answer->count; i++) {
        assert_members(json_array_get(hits, i), "id position t");
        assert_neighbor(json_array_get(hits, i), "t", &answer->neighbors[i]);
    }
}

static void assert_sweep(const json_t *sweep, const octree_answer *answer)
{
    const bool extended = answer->half[0] > 0 || answer->half[1] > 0 || answer->half[2] > 0;
    const json_t *hits = json_member(sweep, "neighbors");
    assert_members(sweep, extended ? "from k to half neighbors cost" : "from k to neighbors cost");
    assert_position(sweep, "from", answer->target);
    assert_position(sweep, "to", answer->to);
    if (extended)
        assert_position(sweep, "half", answer->half);
    assert_whole_number(json_member(sweep, "k"), answer->k);
    assert_int_equal(json_array_size(hits), answer->count);
    for (size_t i = 0; i < answer->count; i++)
        assert_neighbor(json_array_get(hits, i), "t", &answer->neighbors[i]);
}

static void assert_radius(const json_t *radius, const octree_answer *answer)
{
    assert_members(radius, "center radius ids cost");
    assert_position(radius, "center", answer->target);
    assert_number(json_member(radius, "radius"), answer->radius);
    assert_ids(json_member(radius, "ids"), answer->points, answer->count);
}

static void assert_frustum(const json_t *frustum, const octree_answer *answer)
{
    const json_t *spaces = json_member(frustum, "half_spaces");
    assert_members(frustum, "half_spaces ids cost");
    assert_int_equal(json_array_size(spaces), answer->frustum.count);
    for (size_t i = 0; i < answer->frustum.count; i++)
        for (size_t k = 0; k < 4; k++)
            assert_number(json_array_get(json_array_get(spaces, i), k),
                          k < 3 ? answer->frustum.half_spaces[i].normal[k] : answer->frustum.half_spaces[i].offset);
    assert_ids(json_member(frustum, "ids"), answer->points, answer->count);
}

static void assert_answers(const json_t *list, const octree_tick *tick)
{
    static const struct {
        const char *name;
        void (*assert_told)(const json_t *, const octree_answer *);
    } kinds[OCTREE_QUERY_KINDS] = {
        [OCTREE_QUERY_RANGE] = {"range", assert_range},
        [OCTREE_QUERY_NEAREST] = {"nearest", assert_nearest},
        [OCTREE_QUERY_KNEAREST] = {"knearest", assert_knearest},
        [OCTREE_QUERY_RADIUS] = {"radius", assert_radius},
        [OCTREE_QUERY_RAY] = {"ray", assert_ray},
        [OCTREE_QUERY_FRUSTUM] = {"frustum", assert_frustum},
        [OCTREE_QUERY_SWEEP] = {"sweep", assert_sweep},
    };
    assert_int_equal(json_array_size(list), tick->answer_count);
    for (size_t i = 0; i < tick->answer_count; i++) {
        const json_t *answer = json_array_get(list, i);
        const octree_query_kind kind = tick->answers[i].kind;
        assert_members(answer, kinds[kind].name);
        kinds[kind].assert_told(json_member(answer, kinds[kind].name), &tick->answers[i]);
        assert_cost(json_member(answer, kinds[kind].name), "cost", &tick->answers[i].cost);
    }
}

static void assert_visits(const json_t *object, const octree_tick *tick)
{
    size_t touched[OCTREE_TRACE_KINDS] = {0};
    for (size_t i = 0; i < tick->visit_count; i++)
        touched[tick->visits[i].touch]++;
    assert_members(object, "visited taken pruned hit");
    assert_whole_number(json_member(object, "visited"), touched[OCTREE_TRACE_VISITED]);
    assert_whole_number(json_member(object, "taken"), touched[OCTREE_TRACE_TAKEN]);
    assert_whole_number(json_member(object, "pruned"), touched[OCTREE_TRACE_PRUNED]);
    assert_whole_number(json_member(object, "hit"), tick->hit_leaf_count);
}

/* What a walk counts. */
typedef struct census {
    size_t points, nodes, leaves;
    unsigned depth;
} census;

static octree_walk_order count_node(const octree_node *node, void *context)
{
    census *counted = context;
    counted->nodes++;
    counted->leaves += node->leaf;
    counted->points += node->leaf ? node->count : 0;
    counted->depth = node->depth > counted->depth ? node->depth : counted->depth;
    return OCTREE_WALK_ON;
}

static void assert_tree(const json_t *object, const octree *tree)
{
    census counted = {0, 0, 0, 0};
    assert_int_equal(octree_walk(tree, count_node, &counted), OCTREE_OK);
    assert_members(object, "points nodes leaves depth digest");
    assert_whole_number(json_member(object, "points"), counted.points);
    assert_whole_number(json_member(object, "nodes"), counted.nodes);
    assert_whole_number(json_member(object, "leaves"), counted.leaves);
    assert_whole_number(json_member(object, "depth"), counted.depth);
    assert_digest(json_member(object, "digest"), octree_digest(tree));
}

static void assert_key(const json_t *value, char key)
{
    const char expected[2] = {key, '\0'};
    if (key == '\0')
        assert_true(json_is_null(value));
    else
        assert_string_equal(json_string_value(value), expected);
}

/* Up to 256 pairs are listed; more are counted. */
static void assert_pairs(const json_t *pairs, const octree_tick *tick)
{
    if (tick->pair_count > 256) {
        assert_members(pairs, "count digest");
        assert_whole_number(json_member(pairs, "count"), tick->pair_count);
        return;
    }
    assert_int_equal(json_array_size(pairs), tick->pair_count);
    for (size_t i = 0; i < tick->pair_count; i++) {
        assert_int_equal(json_array_size(json_array_get(pairs, i)), 2);
        assert_whole_number(json_array_get(json_array_get(pairs, i), 0), tick->pairs[i].a);
        assert_whole_number(json_array_get(json_array_get(pairs, i), 1), tick->pairs[i].b);
    }
}

void assert_line_has_facts(const json_t *line, const octree_tick *tick, const octree *tree)
{
    static const char always[] =
        "tick key player events attempt hits hit_cost answers visits refusals splits merges tree";
    char names[160];
    snprintf(names, sizeof names, "%s%s%s%s", always, json_object_get(line, "frame") == NULL ? "" : " frame scene",
             tick->swept ? " from" : "", tick->pair_count ? " pairs" : "");
    assert_members(line, names);
    if (tick->swept)
        assert_position(line, "from", tick->from);
    assert_whole_number(json_member(line, "tick"), tick->number);
    assert_key(json_member(line, "key"), tick->key);
    assert_place(line, "player", tick, tick->player);
    assert_place(line, "attempt", tick, tick->attempt);
    assert_events(json_member(line, "events"), tick->events);
    assert_ids(json_member(line, "hits"), tick->hits, tick->hit_count);
    if (tick->pair_count)
        assert_pairs(json_member(line, "pairs"), tick);
    assert_cost(line, "hit_cost", &tick->hit_cost);
    assert_answers(json_member(line, "answers"), tick);
    assert_visits(json_member(line, "visits"), tick);
    assert_refusals(json_member(line, "refusals"), tick);
    assert_addresses(json_member(line, "splits"), tick->splits, tick->split_count);
    assert_addresses(json_member(line, "merges"), tick->merges, tick->merge_count);
    assert_tree(json_member(line, "tree"), tree);
}
