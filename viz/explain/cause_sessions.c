/* SPDX-License-Identifier: MIT */
/* cause_sessions.c - compares sessions and views by their JSON; see cause_compare.h. */
#include "cause_compare.h"
#include "json_read.h"
#include "text.h"
#include "recording_file.h"
#include "view_options.h"

#include <stdlib.h>
#include <string.h>

/* With JSON_DECODE_INT_AS_REAL all numbers are compared as doubles. */
#define PARSE_FLAGS ((size_t)(JSON_DECODE_INT_AS_REAL | JSON_DISABLE_EOF_CHECK))

static bool is_same_position(const double *a, const double *b, bool exact)
{
    return exact ? memcmp(a, b, 3 * sizeof *a) == 0 : a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static json_t *make_vector(const double *numbers)
{
    return json_pack("[fff]", numbers[0], numbers[1], numbers[2]);
}

/* ---- Points -------------------------------------------------------------------------------------------------- */

void cause_compare_points(cause_facts *facts, const char *where, const cause_points *a, const cause_points *b,
                          bool exact)
{
    for (size_t i = 0, j = 0; i < a->count || j < b->count;) {
        const octree_point *x = &a->points[i], *y = &b->points[j];
        const bool less = j == b->count || (i < a->count && x->id < y->id);
        const bool more = i == a->count || (j < b->count && y->id < x->id);
        if (less || more || !is_same_position(x->position, y->position, exact))
            cause_add_fact(facts, where, "",
                           less   ? CAUSE_LESS
                           : more ? CAUSE_MORE
                                  : CAUSE_OTHER,
                           (cause_fact){CAUSE_NO_TICK, less ? x->id : y->id, more ? NULL : make_vector(x->position),
                                        less ? NULL : make_vector(y->position)});
        i += !more;
        j += !less;
    }
}

static int compare_by_id(const void *a, const void *b)
{
    const uint64_t x = ((const octree_point *)a)->id, y = ((const octree_point *)b)->id;
    return (x > y) - (x < y);
}

/* Return the bodies of a session as points, in ascending order of id. The coordinates of a point are the vector at this
 * offset in its body, such as the body's position. */
static cause_points sort_bodies(const octree_session *session, size_t offset)
{
    cause_points sorted = {malloc((session->body_count + 1) * sizeof *sorted.points), session->body_count};
    for (size_t i = 0; sorted.points && i < sorted.count; i++) {
        const octree_game_body *body = &session->bodies[i];
        sorted.points[i].id = body->id;
        memcpy(sorted.points[i].position, (const char *)body + offset, sizeof body->position);
    }
    if (sorted.points)
        qsort(sorted.points, sorted.count, sizeof *sorted.points, compare_by_id);
    return sorted;
}

/* Compare one vector of the bodies. `where` is the place of the vector in a session. */
static void compare_vectors(const octree_session *a, const octree_session *b, const char *where, size_t offset,
                            cause_facts *facts)
{
    const cause_points as = sort_bodies(a, offset), bs = sort_bodies(b, offset);
    facts->out_of_memory |= !as.points || !bs.points;
    if (as.points && bs.points)
        cause_compare_points(facts, where, &as, &bs, true);
    free(as.points);
    free(bs.points);
}

static bool have_same_bodies(const octree_session *a, const octree_session *b)
{
    return a->body_count == b->body_count &&
           (a->body_count == 0 || memcmp(a->bodies, b->bodies, a->body_count * sizeof *a->bodies) == 0);
}

/* Return whether the bodies differ and both sessions generated their bodies from a seed. The generators are then
 * compared in place of the bodies. */
static bool are_both_sampled(const octree_session *a, const octree_session *b)
{
    return a->sampled.known && b->sampled.known && !have_same_bodies(a, b);
}

/* Return whether a difference between the generators was found. Such a difference explains why the bodies differ. */
static bool has_different_sample(const cause_facts *facts)
{
    for (size_t i = 0; i < facts->count; i++)
        if (strncmp(facts->groups[i].where, "sampled", 7) == 0)
            return true;
    return false;
}

static bool have_same_ids(const octree_session *a, const octree_session *b)
{
    for (size_t i = 0; i < a->body_count; i++)
        if (a->bodies[i].id != b->bodies[i].id)
            return false;
    return true;
}

/* Compare the bodies at the start of both sessions. JSON is not used for this, because a session may have a million
 * bodies. The order of bodies is compared as well: a full leaf refuses the bodies that come later. */
static void compare_bodies(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    if (have_same_bodies(a, b) || has_different_sample(facts))
        return;
    compare_vectors(a, b, "points", offsetof(octree_game_body, position), facts);
    if (cause_find_group(facts, "points", CAUSE_MORE) || cause_find_group(facts, "points", CAUSE_LESS))
        return;
    compare_vectors(a, b, "points.velocity", offsetof(octree_game_body, velocity), facts);
    compare_vectors(a, b, "points.half", offsetof(octree_game_body, half), facts);
    if (!have_same_ids(a, b))
        cause_add_whole(facts, "points", CAUSE_ORDER, NULL, NULL);
}

/* ---- Keys of the player ---------------------------------------------------------------------------------------- */

static char key_at(const octree_session *session, size_t length, uint64_t i)
{
    return i < length ? session->keys[i] : '.';
}

/* Compare the key presses of both players in the ticks that both sessions have. A session without a key press for a
 * tick has "wait" there. */
static void compare_key_presses(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    const uint64_t lengths[2] = {octree_session_length(a), octree_session_length(b)};
    const uint64_t both = lengths[0] < lengths[1] ? lengths[0] : lengths[1];
    const size_t counts[2] = {a->keys ? strlen(a->keys) : 0, b->keys ? strlen(b->keys) : 0};
    for (uint64_t i = 0; i < both && (i < counts[0] || i < counts[1]); i++) {
        const char x = key_at(a, counts[0], i), y = key_at(b, counts[1], i);
        if (x != y)
            cause_add_fact(facts, "keys", "", CAUSE_OTHER,
                           (cause_fact){i + 1, CAUSE_NO_ID, json_stringn(&x, 1), json_stringn(&y, 1)});
    }
}

/* ---- Everything else, as JSON ---------------------------------------------------------------------------------- */

/* Write a session as lines of JSON. Points, key presses and the header's "pairs" are left out, because they are
 * compared separately: the place "pairs" is that of a tick. The member "ticks" is written even if a session file would
 * leave it out. */
static char *write_session(const octree_session *session, bool sampled)
{
    octree_session rest = *session;
    text_stream s;
    char *text;
    rest.bodies = NULL;
    rest.body_count = 0;
    rest.keys = NULL;
    rest.pairs = false;
    rest.sampled.known = rest.sampled.known && sampled;
    rest.ticks = octree_session_length(session);
    rest.unplayed = 0;
    if (text_stream_begin(&s))
        session_write(&rest, NULL, s.stream);
    return text_stream_end(&s, &text) ? text : NULL;
}

/* Parse the object at *at and move *at to the end of the object. Return null at the end of the text. */
static json_t *parse_next_object(const char **at)
{
    json_error_t error;
    json_t *object = **at ? json_parse(*at, strlen(*at), PARSE_FLAGS, &error) : NULL;
    if (object)
        *at += error.position;
    *at += strspn(*at, "\n");
    return object;
}

/* Add the members "kind" and "sweep" to the player in a session's header, even if the session has no player or no
 * "sweep". */
static json_t *normalize_player(json_t *header)
{
    json_t *player = json_object_get(header, "player");
    json_t *named = json_is_null(player) ? json_object() : json_incref(player);
    const char *kind = json_is_null(player) ? "none" : json_object_get(player, "body") ? "body" : "keys";
    json_object_set_new(named, "kind", json_string(kind));
    json_object_del(named, "body");
    if (!json_is_null(player) && !json_object_get(named, "sweep"))
        json_object_set_new(named, "sweep", json_false());
    json_object_set_new(header, "player", named);
    return named;
}

/* Remove from the object `from` all members that the object `other` does not have. */
static void remove_members_missing_in(json_t *from, const json_t *other)
{
    const char *key;
    json_t *value;
    void *next;
    json_object_foreach_safe(from, next, key, value) if (!json_object_get(other, key)) json_object_del(from, key);
}

/* One line of a session's JSON: a tick with its edits, queries or shapes. */
typedef struct tick_line {
    uint64_t tick; /* UINT64_MAX: all lines have been read */
    size_t size;
} tick_line;

/* Read the tick and the size of the line at `at`, without parsing the line. */
static tick_line read_tick_line(const char *at)
{
    static const char start[] = "{\"tick\": ";
    if (strncmp(at, start, sizeof start - 1) != 0)
        return (tick_line){UINT64_MAX, 0};
    return (tick_line){strtoull(at + sizeof start - 1, NULL, 10), strcspn(at, "\n")};
}

/* Parse the line of a tick, and move *at to its end. The foreign pairs get a place of their own, because the place
 * "pairs" is that of the pairs in ticks.jsonl. */
static json_t *parse_tick_line(const char **at)
{
    json_t *object = parse_next_object(at);
    json_t *pairs = json_object_get(object, "pairs");
    json_object_del(object, "tick");
    if (pairs && json_object_set(object, "session.foreign_pairs", pairs) == 0)
        json_object_del(object, "pairs");
    return object;
}

/* Compare the tick lines of two sessions. Both texts are read in the order of ticks, so that lines of the same tick
 * meet. Equal lines are not parsed, because a session may have many lines. */
static void compare_tick_lines(cause_place place, const char *x, const char *y)
{
    for (tick_line a = read_tick_line(x), b = read_tick_line(y); a.tick != UINT64_MAX || b.tick != UINT64_MAX;
         a = read_tick_line(x), b = read_tick_line(y)) {
        const bool in_a = a.tick <= b.tick, in_b = b.tick <= a.tick;
        if (in_a && in_b && a.size == b.size && memcmp(x, y, a.size) == 0) {
            x += a.size + 1;
            y += b.size + 1;
            continue;
        }
        json_t *const objects[2] = {in_a ? parse_tick_line(&x) : NULL, in_b ? parse_tick_line(&y) : NULL};
        place.tick = in_a ? a.tick : b.tick;
        cause_compare_members(&place, objects[0], objects[1]);
        json_decref(objects[0]);
        json_decref(objects[1]);
    }
}

/* Compare the JSON lines of two sessions. If the sessions have different kinds of players, members that only one of
 * the kinds uses are skipped. */
static void compare_session_texts(const cause_place *place, const char *x, const char *y)
{
    json_t *a = parse_next_object(&x), *b = parse_next_object(&y);
    if (a && b) {
        json_t *const players[2] = {normalize_player(a), normalize_player(b)};
        remove_members_missing_in(players[0], players[1]);
        remove_members_missing_in(players[1], players[0]);
        cause_compare_members(place, a, b);
        compare_tick_lines(*place, x, y);
    } else {
        place->facts->out_of_memory = true;
    }
    json_decref(a);
    json_decref(b);
}

static void compare_sessions(const octree_session *a, const octree_session *b, cause_facts *facts)
{
    const cause_place place = {facts, "", "", CAUSE_NO_TICK, true};
    const bool sampled = are_both_sampled(a, b);
    char *texts[2] = {write_session(a, sampled), write_session(b, sampled)};
    if (!texts[0] || !texts[1])
        facts->out_of_memory = true;
    else if (strcmp(texts[0], texts[1]) != 0)
        compare_session_texts(&place, texts[0], texts[1]);
    free(texts[0]);
    free(texts[1]);
    if (a->pairs != b->pairs)
        cause_add_whole(facts, "session.pairs", CAUSE_OTHER, json_boolean(a->pairs), json_boolean(b->pairs));
    compare_key_presses(a, b, facts);
    compare_bodies(a, b, facts);
}

void cause_compare_sessions(const session_file *a, const session_file *b, cause_facts *facts)
{
    compare_sessions(&a->session, &b->session, facts);
    cause_compare_values(a, b, facts);
    cause_facts_sort(facts);
}

/* ---- Views --------------------------------------------------------------------------------------------------- */

/* Return the JSON object of a view as in recording.json. The object has a member for every option. */
static json_t *make_view_object(const cause_view *v)
{
    text_stream s;
    json_error_t error;
    char *text;
    if (text_stream_begin(&s))
        recording_write(s.stream, &v->view, v->every);
    json_t *object = text_stream_end(&s, &text) && text ? json_parse(text, strlen(text), PARSE_FLAGS, &error) : NULL;
    free(text);
    return object;
}

/* Compare an option of two views. An option is compared as one value, so a differing option is one fact. Only lists
 * of layers are compared element by element. */
static void compare_option(const cause_place *place, const view_option *option, json_t *a, json_t *b)
{
    const char *name = option->member.name;
    json_t *x = json_object_get(a, name), *y = json_object_get(b, name);
    if (cause_values_are_equal(x, y, place->exact))
        return;
    if (!option->by_element) {
        cause_add_whole(place->facts, name, CAUSE_OTHER, json_incref(x), json_incref(y));
        return;
    }
    json_t *lists[2] = {json_pack("{sO}", name, x), json_pack("{sO}", name, y)};
    place->facts->out_of_memory |= !lists[0] || !lists[1];
    cause_compare_members(place, lists[0], lists[1]);
    json_decref(lists[0]);
    json_decref(lists[1]);
}

void cause_compare_views(const cause_view *a, const cause_view *b, bool same_session, cause_facts *facts)
{
    const cause_place place = {facts, "", "", CAUSE_NO_TICK, false};
    json_t *objects[2] = {make_view_object(a), make_view_object(b)};
    facts->out_of_memory |= !objects[0] || !objects[1];
    for (size_t i = 0; objects[0] && objects[1] && view_option_at(i); i++)
        if (view_option_at(i)->member.name)
            compare_option(&place, view_option_at(i), objects[0], objects[1]);
    if (a->every != b->every)
        cause_add_whole(facts, "every", CAUSE_OTHER, json_real((double)a->every), json_real((double)b->every));
    if (same_session && facts->count == 0)
        cause_compare_members(&place, json_object_get(objects[0], "derived"), json_object_get(objects[1], "derived"));
    json_decref(objects[0]);
    json_decref(objects[1]);
}
