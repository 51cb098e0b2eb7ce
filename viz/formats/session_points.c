/* SPDX-License-Identifier: MIT */
/* session_points.c - reads and writes the points of a session and their velocities. The points are a list, a point
 * file or a sample. */
#include "cloud.h"
#include "file.h"
#include "hash_map.h"
#include "octree/octree.h"
#include "octree/sample.h"
#include "point_world.h"
#include "session_members.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const hash_map_item_type by_id = {sizeof(octree_game_body), hash_map_hash_id, hash_map_ids_equal};

uint32_t session_find_body(const session_loader *s, uint64_t id)
{
    return hash_map_find(&s->values.body_ids, &by_id, s->bodies, &id);
}

/* Returns whether the player is a point of its own and not one of the session's points. No other point may then have
 * the player's id. */
static bool is_player_separate(const octree_player *player)
{
    return player->kind == OCTREE_PLAYER_KEYS;
}

/* Returns the default id of a point. Default ids are 1, 2, 3 and so on in the order of the points; the player's id
 * is skipped. */
static uint64_t find_default_id(const session_loader *s, size_t place)
{
    const octree_player *player = &s->header.session.player;
    const uint64_t id = (uint64_t)place + 1;
    return is_player_separate(player) && player->id != 0 && id >= player->id ? id + 1 : id;
}

/* Allocates the bodies for `count` points. */
static bool allocate_bodies(json_reader *r, const json_place *at, size_t count)
{
    session_loader *s = r->context;
    s->bodies = calloc(count > 0 ? count : 1, sizeof *s->bodies);
    if (!s->bodies)
        return json_fail(r, at, "out of memory for %zu points", count);
    s->header.session.body_count = count;
    return true;
}

/* ---- A list ------------------------------------------------------------------------------------------------- */

/* Reads a row of a point: [x, y, z] or [x, y, z, id], then one value for each of the columns. */
static bool read_point_row(json_reader *r, json_t *row, const json_place *at, octree_game_body *body)
{
    const session_values *values = &((const session_loader *)r->context)->values;
    const size_t size = json_array_size(row);
    point_value value = {0};
    if (size != 3 && size != 4 && (values->column_count == 0 || size != 4 + values->column_count))
        return json_fail_expected(
            r, row, at,
            values->column_count
                ? "a point [x, y, z] or [x, y, z, id], or [x, y, z, id] followed by a value for each of \"columns\""
                : "a point [x, y, z] or [x, y, z, id]");
    if (!json_read_numbers(r, row, at, 0, 3, body->position) || (size > 3 && !json_read_id(r, row, at, 3, &body->id)))
        return false;
    for (size_t i = 4; i < size; i++)
        if (!session_read_column_value(r, json_array_get(row, i), &(json_place){at, NULL, i},
                                       (point_value_kind)values->columns[i - 4], &value))
            return false;
    return session_set_value(r, at, body->id, &value);
}

static bool read_point(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const session_loader *s = r->context;
    octree_game_body *body = (octree_game_body *)into + at->index;
    body->id = find_default_id(s, at->index);
    if (json_is_array(value))
        return read_point_row(r, value, at, body);
    if (json_is_object(value))
        return session_body_codec.read(r, value, at, body);
    return json_fail_expected(r, value, at, "a point [x, y, z], [x, y, z, id] or {\"id\": ..., \"position\": ...}");
}

bool session_map_bodies(json_reader *r, const json_place *at)
{
    session_loader *s = r->context;
    hash_map *map = &s->values.body_ids;
    const octree_player *player = &s->header.session.player;
    const size_t count = s->header.session.body_count;
    if (map->count == count)
        return true;
    if (!hash_map_reserve(map, &by_id, s->bodies, count))
        return json_fail(r, at, "out of memory for %zu points", count);
    while (map->count < count) {
        const uint64_t id = s->bodies[map->count].id;
        const json_place place = {at, NULL, map->count};
        const uint32_t first = session_find_body(s, id);
        if (first != HASH_MAP_NONE)
            return json_fail(r, &place, "id %" PRIu64 " already belongs to points[%" PRIu32 "] in line %zu", id, first,
                             json_find_line(r, &(json_place){at, NULL, first}));
        hash_map_add(map, &by_id, s->bodies); /* this call cannot fail, because the map has room for all bodies */
    }
    const uint32_t clash = is_player_separate(player) ? session_find_body(s, player->id) : HASH_MAP_NONE;
    return clash == HASH_MAP_NONE ||
           json_fail(r, &(json_place){at, NULL, clash}, "id %" PRIu64 " already belongs to the player", player->id);
}

/* Returns the number of elements up to the first that is empty. Reading stops there with an error, so that no body is
 * needed for the elements after it: empty elements are the shortest, and a file of them would need the most memory. */
static size_t count_needed_bodies(const json_t *list)
{
    const size_t count = json_array_size(list);
    for (size_t i = 0; i < count; i++)
        if (json_array_size(json_array_get(list, i)) + json_object_size(json_array_get(list, i)) == 0)
            return i + 1;
    return count;
}

static bool read_point_list(json_reader *r, json_t *list, const json_place *at)
{
    session_loader *s = r->context;
    return allocate_bodies(r, at, count_needed_bodies(list)) &&
           json_read_elements(r, list, at, "a list of points", read_point, s->bodies) && session_map_bodies(r, at);
}

/* ---- Files of points and samples ---------------------------------------------------------------------------- */

/* Makes bodies of the points of a point file. The default id of a body counts all rows of the file before it,
 * including rows that were skipped. */
static bool copy_cloud_points(json_reader *r, const json_place *at, const cloud *from)
{
    session_loader *s = r->context;
    if (!allocate_bodies(r, at, from->count))
        return false;
    for (size_t i = 0; i < from->count; i++) {
        s->bodies[i].id = find_default_id(s, cloud_row_number(from, i));
        memcpy(s->bodies[i].position, from->positions[i], sizeof from->positions[i]);
    }
    return true;
}

/* Returns the path of a point file that the session names; the caller frees the path. The name "-" stands for a file
 * of this name, not for standard input. */
static char *join_file_path(const char *folder, const char *file)
{
    if (!*folder && file_is_standard_stream(file))
        folder = "./";
    const size_t length = strlen(folder), size = length + strlen(file) + 2;
    const bool separate = length > 0 && folder[length - 1] != '/';
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s%s%s", *file == '/' ? "" : folder, *file != '/' && separate ? "/" : "", file);
    return path;
}

/* Writes the note about a point file: which columns were guessed or ignored, and how many values were out of range. */
static void write_values_note(session_loader *s, const char *name)
{
    char beyond[CLOUD_OUT_OF_RANGE_TEXT];
    const char *columns = s->points.column_note;
    cloud_describe_out_of_range(s->points.out_of_range, beyond);
    if (*columns || *beyond)
        snprintf(s->note, sizeof s->note, "%.200s: %s%s%s", name, columns, *columns && *beyond ? "; " : "", beyond);
}

/* Refuses point files and samples in a recording. Otherwise opening a recording would read other files or generate
 * points. */
static bool check_files_allowed(json_reader *r, const json_place *at)
{
    const session_loader *s = r->context;
    return s->folder ||
           json_fail(r, at, "the session of a recording must list its points; files and samples are not allowed");
}

/* Reads the point file into s->points. If the file was already read to compute the world, does nothing. */
static bool load_point_file(json_reader *r, const json_t *value, const json_place *at)
{
    session_loader *s = r->context;
    if (s->points.count > 0)
        return true;
    if (!check_files_allowed(r, at))
        return false;
    char *path = join_file_path(s->folder, json_string_value(value));
    if (!path)
        return json_fail(r, at, "out of memory");
    octreel_error why;
    const bool done = cloud_read(path, NULL, &s->points, &why);
    free(path);
    if (!done)
        return error_set(r->error, "%s:%zu: points.file: %s", json_shorten_name(r->name), json_find_line(r, at),
                         why.text);
    memcpy(s->note, s->points.note, sizeof s->points.note);
    if (!*s->note)
        write_values_note(s, json_string_value(value));
    return true;
}

static bool is_point_file(const json_t *value)
{
    return json_is_string(value) && json_string_length(value) > 0;
}

/* Sets the values of the points of the point file. The values in row 0 of the file belong to the point with id 1,
 * and so on. The player's id is skipped. */
static bool set_file_values(json_reader *r, const json_place *at)
{
    session_loader *s = r->context;
    point_values *values = &s->points.values;
    const octree_player *player = &s->header.session.player;
    const uint64_t place = player->id - 1; /* the index of the row whose point would have the player's id */
    if (is_player_separate(player) && player->id != 0 && place < values->count &&
        !point_values_insert_empty_row(values, (size_t)place))
        return json_fail(r, at, "out of memory for %zu points", s->points.count);
    values->first = 1;
    s->values.made = *values;
    *values = (point_values){0};
    return true;
}

static bool read_point_file(json_reader *r, json_t *value, const json_place *at, void *into)
{
    session_loader *s = r->context;
    (void)into;
    if (!is_point_file(value))
        return json_fail_expected(r, value, at, "the name of a file");
    const bool done = load_point_file(r, value, at) && copy_cloud_points(r, at, &s->points) && set_file_values(r, at);
    cloud_release(&s->points);
    return done;
}

/* If the world is to be computed from a point file, the file is read before the other members: the player needs the
 * world, and "points" is read after the player. Errors in the member "points" are reported later, when this member is
 * read. */
bool session_compute_world_from_file(json_reader *r, json_t *header)
{
    session_loader *s = r->context;
    const json_t *wanted = json_object_get(header, "points"), *file = json_object_get(wanted, "file");
    if (json_object_get(header, "world") || !is_point_file(file) || json_object_size(wanted) != 1)
        return true;
    const json_place points = {NULL, "points", 0};
    if (!load_point_file(r, file, &(json_place){&points, "file", 0}))
        return false;
    const octree_box world = find_point_world(s->points.positions, sizeof *s->points.positions, s->points.count);
    session_set_world(s, &world);
    return true;
}

JSON_NAMES(sample_name, octree_sample_name, octree_sample_kind)

#define SAMPLED(field) offsetof(octree_sampled, field)

static const json_member sample_members[] = {
    {"sample", &json_choice, SAMPLED(points.kind), .required = true, .names = sample_name},
    {"count", &json_uint64, SAMPLED(points.count), .required = true, .max = SESSION_MOST_SAMPLES},
    {"seed", &json_uint64, SAMPLED(points.seed), .max = JSON_LARGEST_WHOLE},
    {0},
};

static const json_member random_velocities_members[] = {
    {"speed", &json_nonnegative, SAMPLED(velocities.speed), .required = true},
    {"seed", &json_uint64, SAMPLED(velocities.seed), .max = JSON_LARGEST_WHOLE},
    {0},
};

const json_member session_sampled_members[] = {
    {"points", &json_structure, .given = SAMPLED(by_points), .members = sample_members},
    {"velocities", &json_structure, .given = SAMPLED(by_velocities), .members = random_velocities_members},
    {0},
};

static bool read_point_sample(json_reader *r, json_t *value, const json_place *at)
{
    session_loader *s = r->context;
    octree_sampled wanted = {.points.seed = 1, .by_points = true, .known = true};
    if (!check_files_allowed(r, at) || !json_read_members(r, value, at, sample_members, &wanted))
        return false;
    s->header.session.sampled = wanted;
    const size_t count = (size_t)wanted.points.count;
    double(*positions)[3] = malloc((count > 0 ? count : 1) * sizeof *positions);
    if (!positions)
        return json_fail(r, at, "out of memory for %zu points", count);
    const octree_status status =
        octree_sample(wanted.points.kind, wanted.points.seed, &s->header.session.tree.world, count, positions);
    const bool done = status == OCTREE_OK ? copy_cloud_points(r, at, &(cloud){.positions = positions, .count = count})
                                          : json_fail(r, at, "%s", octree_status_text(status));
    free(positions);
    return done;
}

/* ---- Points ------------------------------------------------------------------------------------------------- */

static const json_member file_members[] = {
    {"file", JSON_CODEC(read_point_file, NULL), .required = true},
    {0},
};

static bool read_points(json_reader *r, json_t *value, const json_place *at, void *into)
{
    if (json_is_array(value))
        return read_point_list(r, value, at);
    if (json_object_get(value, "file"))
        return json_read_members(r, value, at, file_members, into);
    if (json_object_get(value, "sample"))
        return read_point_sample(r, value, at);
    return json_fail(r, at,
                     "expected a list of points, {\"file\": ...} or {\"sample\": ..., \"count\": ..., \"seed\": ...}");
}

/* Writes a point. A point with a velocity or half extents is written as an object, any other point as a row. A velocity
 * of -0 counts as a velocity, so that it is restored exactly. */
static void write_point(json_writer *w, const octree_game_body *body)
{
    if (json_has_nonzero_byte(body->velocity, sizeof body->velocity) ||
        json_has_nonzero_byte(body->half, sizeof body->half)) {
        session_body_codec.write(w, body);
        return;
    }
    json_write_begin_array(w);
    json_write_elements(w, body->position, 3);
    json_write_integer(w, body->id);
    session_write_column_values(w, body->id);
    json_write_end_array(w);
}

static void write_points(json_writer *w, const void *from)
{
    const octree_session *session = from;
    json_write_begin_array(w);
    for (size_t i = 0; i < session->body_count; i++) {
        json_start_new_line(w);
        write_point(w, &session->bodies[i]);
    }
    if (session->body_count > 0)
        json_start_new_line(w);
    json_write_end_array(w);
}

const json_codec session_points_codec = {read_points, write_points};

/* ---- Velocities --------------------------------------------------------------------------------------------- */

/* Reads a row of "velocities": [id, vx, vy, vz]. */
static bool read_velocity(json_reader *r, json_t *row, const json_place *at, void *into)
{
    const session_loader *s = r->context;
    bool *given = into; /* given[i]: body i was given a velocity */
    uint64_t id;
    if (json_array_size(row) != 4)
        return json_fail_expected(r, row, at, "[id, vx, vy, vz]");
    if (!json_read_id(r, row, at, 0, &id))
        return false;
    const uint32_t place = session_find_body(s, id);
    if (place == HASH_MAP_NONE)
        return json_fail(r, at, "no point has the id %" PRIu64, id);
    if (given[place])
        return json_fail(r, at, "the point with the id %" PRIu64 " already has a velocity in this list", id);
    given[place] = true;
    return json_read_numbers(r, row, at, 1, 3, s->bodies[place].velocity);
}

static bool read_velocity_list(json_reader *r, json_t *list, const json_place *at)
{
    const session_loader *s = r->context;
    const size_t count = s->header.session.body_count;
    bool *given = calloc(count > 0 ? count : 1, sizeof *given);
    const bool done = (given || json_fail(r, at, "out of memory for %zu points", count)) && session_map_bodies(r, at) &&
                      json_read_elements(r, list, at, "a list of velocities", read_velocity, given);
    free(given);
    return done;
}

static bool read_random_velocities(json_reader *r, json_t *value, const json_place *at)
{
    session_loader *s = r->context;
    octree_sampled *sampled = &s->header.session.sampled;
    sampled->velocities.seed = 1;
    if (!json_read_members(r, value, at, random_velocities_members, sampled))
        return false;
    sampled->by_velocities = sampled->known = true;
    uint64_t state = sampled->velocities.seed;
    for (size_t i = 0; i < s->header.session.body_count; i++)
        for (int axis = 0; axis < 3; axis++)
            s->bodies[i].velocity[axis] = sampled->velocities.speed * (2 * octree_random_unit(&state) - 1);
    return true;
}

static bool read_velocities(json_reader *r, json_t *value, const json_place *at, void *into)
{
    (void)into;
    if (json_is_array(value))
        return read_velocity_list(r, value, at);
    if (json_is_object(value))
        return read_random_velocities(r, value, at);
    return json_fail_expected(r, value, at, "a list of [id, vx, vy, vz] or {\"speed\": ..., \"seed\": ...}");
}

const json_codec session_velocities_codec = {read_velocities, NULL};
