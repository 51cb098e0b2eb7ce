/* session_points.c - the points of a session file: listed, from a file of points, or a sample. */
#include "cloud.h"
#include "octree/sample.h"
#include "session_ids.h"
#include "session_reader.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Whether the player has an id that no point may have. */
static bool is_apart(const octree_player *player)
{
    return player->kind == OCTREE_PLAYER_KEYS;
}

/* The id of a point that is given none: its place counted from 1, passing over the player's id. */
static uint64_t default_id(const session_reader *reader, size_t place)
{
    uint64_t id = (uint64_t)place + 1, player = reader->session->player.id;
    return is_apart(&reader->session->player) && player != 0 && id >= player ? id + 1 : id;
}

/* Make room for all points. */
static bool take_bodies(session_reader *reader, const json_place *at, size_t count)
{
    reader->bodies = calloc(count > 0 ? count : 1, sizeof *reader->bodies);
    if (!reader->bodies)
        return session_fail(reader, at, "out of memory for %zu points", count);
    reader->session->body_count = count;
    return true;
}

/* ---- A list ------------------------------------------------------------------------------------------------- */

/* [x, y, z] or [x, y, z, id] */
static bool read_row(session_reader *reader, json_t *row, const json_place *at, octree_body *body)
{
    size_t size = json_array_size(row);
    if (size != 3 && size != 4)
        return session_expected(reader, row, at, "a point [x, y, z] or [x, y, z, id]");
    for (size_t i = 0; i < 3; i++) {
        json_place place = {at, NULL, i};
        if (!session_read_number(reader, json_array_get(row, i), &place, &body->position[i]))
            return false;
    }
    return size == 3 || session_read_id(reader, json_array_get(row, 3), &(json_place){at, NULL, 3}, &body->id);
}

static bool read_point(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    static const session_member members[] = {
        {"id", session_read_id, offsetof(octree_body, id), false},
        {"position", session_read_vector, offsetof(octree_body, position), true},
        {"velocity", session_read_vector, offsetof(octree_body, velocity), false},
        {0},
    };
    octree_body *body = (octree_body *)into + at->index;
    body->id = default_id(reader, at->index);
    if (json_is_array(value))
        return read_row(reader, value, at, body);
    if (json_is_object(value))
        return session_read_members(reader, value, at, members, body);
    return session_expected(reader, value, at, "a point [x, y, z], [x, y, z, id] or {\"id\": ..., \"position\": ...}");
}

static bool fail_repeated(session_reader *reader, const json_place *at, size_t place, size_t earlier)
{
    json_place first = {at, NULL, earlier};
    return session_fail(reader, &(json_place){at, NULL, place}, "id %" PRIu64 " is taken by points[%zu] in line %zu",
                        reader->bodies[place].id, earlier, session_line(reader, &first));
}

static bool check_ids(session_reader *reader, const json_place *at)
{
    size_t count = reader->session->body_count, earlier = 0;
    if (count == 0)
        return true;
    session_id *ids = session_ids_sorted(reader->bodies, count);
    if (!ids)
        return session_fail(reader, at, "out of memory for %zu points", count);
    size_t repeated = session_ids_repeated(ids, count, &earlier);
    const octree_player *apart = &reader->session->player;
    const session_id *player = is_apart(apart) ? session_ids_find(ids, count, apart->id) : NULL;
    size_t clash = player ? player->place : count;
    free(ids);
    if (repeated < count)
        return fail_repeated(reader, at, repeated, earlier);
    return clash == count ||
           session_fail(reader, &(json_place){at, NULL, clash}, "id %" PRIu64 " is the player's", apart->id);
}

static bool read_list(session_reader *reader, json_t *list, const json_place *at)
{
    return take_bodies(reader, at, json_array_size(list)) &&
           session_read_elements(reader, list, at, "a list of points", read_point, reader->bodies) &&
           check_ids(reader, at);
}

/* ---- Positions from elsewhere ------------------------------------------------------------------------------- */

static bool take_positions(session_reader *reader, const json_place *at, double (*const positions)[3], size_t count)
{
    if (!take_bodies(reader, at, count))
        return false;
    for (size_t i = 0; i < count; i++) {
        reader->bodies[i].id = default_id(reader, i);
        memcpy(reader->bodies[i].position, positions[i], sizeof positions[i]);
    }
    return true;
}

/* The path of a file that the session names; the caller frees it. */
static char *path_in_folder(const char *folder, const char *file)
{
    size_t length = strlen(folder), size = length + strlen(file) + 2;
    bool separate = length > 0 && folder[length - 1] != '/';
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s%s%s", *file == '/' ? "" : folder, *file != '/' && separate ? "/" : "", file);
    return path;
}

static bool read_file(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    (void)into;
    if (!json_is_string(value) || json_string_length(value) == 0)
        return session_expected(reader, value, at, "the name of a file");
    cloud cloud;
    octreel_error reason;
    char *path = path_in_folder(reader->folder, json_string_value(value));
    if (!path)
        return session_fail(reader, at, "out of memory");
    bool done = cloud_read(path, NULL, &cloud, &reason);
    free(path);
    if (!done) {
        snprintf(reader->error->text, sizeof reader->error->text, "%s", reason.text);
        return false;
    }
    done = take_positions(reader, at, cloud.positions, cloud.count);
    cloud_release(&cloud);
    return done;
}

typedef struct sample {
    octree_sample_kind kind;
    uint64_t count, seed;
} sample;

static bool read_sample_kind(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    char known[96] = "";
    if (json_is_string(value) && octree_sample_parse(json_string_value(value), into))
        return true;
    for (int i = 0; i < OCTREE_SAMPLE_KINDS; i++) {
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s%s", i > 0 ? ", " : "one of ",
                 octree_sample_name((octree_sample_kind)i));
    }
    return session_expected(reader, value, at, known);
}

static bool read_sample_count(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    return session_read_whole(reader, value, at, 0, SESSION_MOST_SAMPLES, into);
}

static bool read_sample(session_reader *reader, json_t *value, const json_place *at)
{
    static const session_member members[] = {
        {"sample", read_sample_kind, offsetof(sample, kind), true},
        {"count", read_sample_count, offsetof(sample, count), true},
        {"seed", session_read_id, offsetof(sample, seed), false},
        {0},
    };
    sample wanted = {.seed = 1};
    if (!session_read_members(reader, value, at, members, &wanted))
        return false;
    size_t count = (size_t)wanted.count;
    double(*positions)[3] = malloc((count > 0 ? count : 1) * sizeof *positions);
    if (!positions)
        return session_fail(reader, at, "out of memory for %zu points", count);
    octree_status status = octree_sample(wanted.kind, wanted.seed, &reader->session->tree.world, count, positions);
    bool done = status == OCTREE_OK ? take_positions(reader, at, positions, count)
                                    : session_fail(reader, at, "%s", octree_status_text(status));
    free(positions);
    return done;
}

/* ---- All of them -------------------------------------------------------------------------------------------- */

bool session_read_points(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    static const session_member file_members[] = {{"file", read_file, 0, true}, {0}};
    if (json_is_array(value))
        return read_list(reader, value, at);
    if (json_object_get(value, "file"))
        return session_read_members(reader, value, at, file_members, into);
    if (json_object_get(value, "sample"))
        return read_sample(reader, value, at);
    return session_fail(
        reader, at, "expected a list of points, {\"file\": ...} or {\"sample\": ..., \"count\": ..., \"seed\": ...}");
}
