/* ticks_write.c - see ticks_write.h. */
#include "ticks_write.h"
#include "json_write.h"

#include <inttypes.h>

char *digest_print(uint64_t digest, char text[DIGEST_TEXT])
{
    snprintf(text, DIGEST_TEXT, "%016" PRIx64, digest);
    return text;
}

static void write_digest(json_writer *w, const char *key, uint64_t digest)
{
    char text[DIGEST_TEXT];
    json_write_key(w, key);
    json_write_string(w, digest_print(digest, text));
}

/* A place of the player, or null where there is none. */
static void write_place(json_writer *w, const char *key, const octree_tick *tick, const double place[3])
{
    if (tick->has_player) {
        json_member_vector(w, key, place);
        return;
    }
    json_write_key(w, key);
    json_write_null(w);
}

static void write_events(json_writer *w, unsigned events)
{
    json_write_key(w, "events");
    json_write_begin_array(w);
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        if (events >> i & 1)
            json_write_string(w, octree_event_name(1u << i));
    json_write_end_array(w);
}

static void write_ids(json_writer *w, const char *key, const octree_point *points, size_t count)
{
    json_write_key(w, key);
    json_write_begin_array(w);
    for (size_t i = 0; i < count; i++)
        json_write_integer(w, points[i].id);
    json_write_end_array(w);
}

static void write_addresses(json_writer *w, const char *key, const octree_address *addresses, size_t count)
{
    char text[OCTREE_ADDRESS_TEXT];
    json_write_key(w, key);
    json_write_begin_array(w);
    for (size_t i = 0; i < count; i++)
        json_write_string(w, octree_address_format(addresses[i], text));
    json_write_end_array(w);
}

static void write_refusals(json_writer *w, const octree_tick *tick)
{
    json_write_key(w, "refusals");
    json_write_begin_array(w);
    for (size_t i = 0; i < tick->refusal_count; i++) {
        json_write_begin_object(w);
        json_write_key(w, "id");
        json_write_integer(w, tick->refusals[i].id);
        json_write_key(w, "why");
        json_write_string(w, octree_status_name(tick->refusals[i].why));
        json_member_vector(w, "position", tick->refusals[i].position);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

/* The members of an object that tell a neighbour. */
static void write_neighbor(json_writer *w, const octree_neighbor *neighbor)
{
    json_write_key(w, "id");
    json_write_integer(w, neighbor->point.id);
    json_member_vector(w, "position", neighbor->point.position);
    json_write_key(w, "distance");
    json_write_number(w, neighbor->distance);
}

static void write_nearest(json_writer *w, const octree_answer *answer)
{
    json_member_vector(w, "target", answer->target);
    if (answer->count) {
        write_neighbor(w, answer->neighbors);
    } else {
        json_write_key(w, "id");
        json_write_null(w);
    }
}

static void write_knearest(json_writer *w, const octree_answer *answer)
{
    json_member_vector(w, "target", answer->target);
    json_write_key(w, "k");
    json_write_integer(w, answer->k);
    json_write_key(w, "neighbors");
    json_write_begin_array(w);
    for (size_t i = 0; i < answer->count; i++) {
        json_write_begin_object(w);
        write_neighbor(w, &answer->neighbors[i]);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

static void write_range(json_writer *w, const octree_answer *answer)
{
    json_member_vector(w, "min", answer->box.min);
    json_member_vector(w, "max", answer->box.max);
    write_ids(w, "ids", answer->points, answer->count);
}

static void write_radius(json_writer *w, const octree_answer *answer)
{
    json_member_vector(w, "center", answer->target);
    json_write_key(w, "radius");
    json_write_number(w, answer->radius);
    write_ids(w, "ids", answer->points, answer->count);
}

static void write_cost(json_writer *w, const char *key, const octree_cost *cost)
{
    json_write_key(w, key);
    json_write_begin_object(w);
    json_member_integer(w, "nodes", cost->nodes);
    json_member_integer(w, "leaves", cost->leaves);
    json_member_integer(w, "points", cost->points);
    json_member_integer(w, "pruned", cost->pruned);
    json_write_end_object(w);
}

static void write_answers(json_writer *w, const octree_tick *tick)
{
    static void (*const writers[OCTREE_QUERY_KINDS])(json_writer *, const octree_answer *) = {
        [OCTREE_QUERY_RANGE] = write_range,
        [OCTREE_QUERY_NEAREST] = write_nearest,
        [OCTREE_QUERY_KNEAREST] = write_knearest,
        [OCTREE_QUERY_RADIUS] = write_radius,
    };
    json_write_key(w, "answers");
    json_write_begin_array(w);
    for (size_t i = 0; i < tick->answer_count; i++) {
        const octree_answer *answer = &tick->answers[i];
        json_write_begin_object(w);
        json_write_key(w, octree_query_name(answer->kind));
        json_write_begin_object(w);
        writers[answer->kind](w, answer);
        write_cost(w, "cost", &answer->cost);
        json_write_end_object(w);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

/* How many nodes all questions of the tick met in each way, and how many leaves hold what was found. */
static void write_visits(json_writer *w, const octree_tick *tick)
{
    json_write_key(w, "visits");
    json_write_begin_object(w);
    json_member_integer(w, "visited", tick->touched[OCTREE_TOUCH_VISITED]);
    json_member_integer(w, "taken", tick->touched[OCTREE_TOUCH_TAKEN]);
    json_member_integer(w, "pruned", tick->touched[OCTREE_TOUCH_PRUNED]);
    json_member_integer(w, "hit", tick->hit_leaf_count);
    json_write_end_object(w);
}

static void write_tree(json_writer *w, const octree_tick *tick)
{
    json_write_key(w, "tree");
    json_write_begin_object(w);
    json_member_integer(w, "points", tick->stats.points);
    json_member_integer(w, "nodes", tick->stats.nodes);
    json_member_integer(w, "leaves", tick->stats.leaves);
    json_member_integer(w, "depth", tick->stats.depth);
    write_digest(w, "digest", tick->tree_digest);
    json_write_end_object(w);
}

void tick_write(FILE *out, const octree_tick *tick, const tick_extras *extras)
{
    json_writer writer = {.out = out}, *w = &writer;
    const char key[2] = {tick->key, 0};
    json_write_begin_object(w);
    json_write_key(w, "tick");
    json_write_integer(w, tick->number);
    json_write_key(w, "key");
    if (tick->key)
        json_write_string(w, key);
    else
        json_write_null(w);
    write_place(w, "player", tick, tick->player);
    write_events(w, tick->events);
    if (tick->swept)
        json_member_vector(w, "from", tick->from);
    write_place(w, "attempt", tick, tick->attempt);
    write_ids(w, "hits", tick->hits, tick->hit_count);
    write_cost(w, "hit_cost", &tick->hit_cost);
    write_answers(w, tick);
    write_visits(w, tick);
    write_refusals(w, tick);
    write_addresses(w, "splits", tick->splits, tick->split_count);
    write_addresses(w, "merges", tick->merges, tick->merge_count);
    write_tree(w, tick);
    if (extras->frame) {
        json_write_key(w, "frame");
        json_write_string(w, extras->frame);
        write_digest(w, "scene", extras->scene_digest);
    }
    json_write_end_object(w);
    json_write_end_line(w);
}
