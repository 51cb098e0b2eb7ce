/* session_velocities.c - the velocities of a session file: listed by id, or random. */
#include "octree/sample.h"
#include "session_ids.h"
#include "session_reader.h"

#include <inttypes.h>
#include <stdlib.h>

/* ---- A list ------------------------------------------------------------------------------------------------- */

/* The points by id, and which of them has been given its velocity. */
typedef struct receivers {
    session_id *ids;
    bool *given;
} receivers;

/* [id, vx, vy, vz] */
static bool read_row(session_reader *reader, json_t *row, const json_place *at, void *into)
{
    const receivers *points = into;
    uint64_t id;
    if (!json_is_array(row) || json_array_size(row) != 4)
        return session_expected(reader, row, at, "[id, vx, vy, vz]");
    if (!session_read_id(reader, json_array_get(row, 0), &(json_place){at, NULL, 0}, &id))
        return false;
    size_t count = reader->session->body_count;
    const session_id *point = count > 0 ? session_ids_find(points->ids, count, id) : NULL;
    if (!point)
        return session_fail(reader, at, "no point has the id %" PRIu64, id);
    if (points->given[point->place])
        return session_fail(reader, at, "the point with the id %" PRIu64 " was given a velocity before", id);
    points->given[point->place] = true;
    for (size_t i = 0; i < 3; i++) {
        json_place place = {at, NULL, i + 1};
        if (!session_read_number(reader, json_array_get(row, i + 1), &place, &reader->bodies[point->place].velocity[i]))
            return false;
    }
    return true;
}

static bool read_list(session_reader *reader, json_t *list, const json_place *at)
{
    receivers points = {0};
    size_t count = reader->session->body_count;
    if (count > 0) {
        points.ids = session_ids_sorted(reader->bodies, count);
        points.given = calloc(count, sizeof *points.given);
    }
    bool ready = count == 0 || (points.ids && points.given);
    bool done = ready ? session_read_elements(reader, list, at, "a list of velocities", read_row, &points)
                      : session_fail(reader, at, "out of memory for %zu points", count);
    free(points.ids);
    free(points.given);
    return done;
}

/* ---- Random ones -------------------------------------------------------------------------------------------- */

typedef struct random_velocities {
    double speed;
    uint64_t seed;
} random_velocities;

static bool read_random(session_reader *reader, json_t *value, const json_place *at)
{
    static const session_member members[] = {
        {"speed", session_read_positive, offsetof(random_velocities, speed), true},
        {"seed", session_read_id, offsetof(random_velocities, seed), false},
        {0},
    };
    random_velocities wanted = {.seed = 1};
    if (!session_read_members(reader, value, at, members, &wanted))
        return false;
    for (size_t i = 0; i < reader->session->body_count; i++)
        for (int axis = 0; axis < 3; axis++)
            reader->bodies[i].velocity[axis] = wanted.speed * (2 * octree_random_unit(&wanted.seed) - 1);
    return true;
}

bool session_read_velocities(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    (void)into;
    if (json_is_array(value))
        return read_list(reader, value, at);
    if (json_is_object(value))
        return read_random(reader, value, at);
    return session_expected(reader, value, at, "a list of [id, vx, vy, vz] or {\"speed\": ..., \"seed\": ...}");
}
