/* SPDX-License-Identifier: MIT */
/* filmed_scenes.c - see filmed_scenes.h. */
#include "filmed_scenes.h"
#include "octree/octree.h"
#include "octree/sample.h"
#include "recording_file.h"

#include <stdlib.h>
#include <string.h>

const int page_sizes[PAGE_SIZES][2] = {{1280, 720}, {2560, 1440}};

const filmed_scene filmed_scenes[FILMED_SCENES] = {
    {.name = "S",
     .about = "the default session, still camera",
     .camera = CAMERA_ISO,
     .lod = 2,
     .budget = 250000,
     .least_times = 25,
     .first_ms = 300,
     .mib = 200,
     .shorter = 1,
     .naive_shorter = 10,
     .page_fps = 60,
     .turn_fps = 60,
     .page_first_ms = 300,
     .page_mib = 300,
     .page_ticks = 253,
     .page_kb = 400},
    {.name = "M",
     .about = "2,000 clustered points, orbiting camera",
     .points = 2000,
     .camera = CAMERA_ORBIT,
     .lod = 2,
     .budget = 250000,
     .least_times = 25,
     .first_ms = 300,
     .mib = 200,
     .shorter = 1,
     .naive_shorter = 10,
     .page_fps = 60,
     .turn_fps = 60,
     .page_first_ms = 300,
     .page_mib = 300,
     .page_ticks = 10000,
     .scrub_ms = 100,
     .asked = 100},
    {.name = "L",
     .about = "100,000 points, orbiting camera, nothing left out",
     .points = 100000,
     .camera = CAMERA_ORBIT,
     .least_times = 20,
     .first_ms = 300,
     .mib = 200,
     .shorter = 2,
     .naive_shorter = 15,
     .page_fps = 15,
     .turn_fps = 60,
     .page_first_ms = 300,
     .page_mib = 300},
    {.name = "L-lod2",
     .about = "the same with --lod 2",
     .points = 100000,
     .camera = CAMERA_ORBIT,
     .lod = 2,
     .budget = 250000,
     .least_times = 28,
     .first_ms = 300,
     .mib = 200,
     .shorter = 2,
     .naive_shorter = 15},
    {.name = "moving",
     .about = "100,000 moving points, --lod 2",
     .points = 100000,
     .moving = true,
     .camera = CAMERA_ISO,
     .lod = 2,
     .budget = 250000,
     .least_times = 3,
     .mib = 200,
     .shorter = 10,
     .naive_shorter = 3,
     .page_fps = 5,
     .turn_fps = 60,
     .page_mib = 300},
    {.name = "1M-lod2",
     .about = "1,000,000 points, orbiting camera, --lod 2",
     .points = 1000000,
     .camera = CAMERA_ORBIT,
     .lod = 2,
     .budget = 250000,
     .least_fps = 25,
     .first_ms = 1000,
     .shorter = 10,
     .naive_shorter = 20,
     .page_fps = 10,
     .turn_fps = 15,
     .page_first_ms = 3000},
    {.name = "cloud",
     .about = "the page of a cloud of 1,000,000 colored points",
     .points = 1000000,
     .cloud = true,
     .camera = CAMERA_ISO,
     .lod = 2,
     .budget = 250000,
     .shorter = 2,
     .naive_shorter = 1,
     .page_fps = 10,
     .turn_fps = 15,
     .page_first_ms = 3000},
};

view filmed_view(const filmed_scene *scene)
{
    view v = view_make_default();
    v.width = 1280;
    v.height = 720;
    v.camera = scene->camera;
    v.lod = scene->lod;
    v.budget = scene->budget;
    if (scene->cloud) {
        v.point_color = POINTS_BY_FILE;
        v.shade = SHADE_EDL;
    }
    return v;
}

view filmed_whole_view(const filmed_scene *scene)
{
    view v = filmed_view(scene);
    v.lod = 0;
    v.budget = 0;
    return v;
}

/* Repeat all keys of a session except q, which ends it. */
static char *repeat_keys(const char *keys, uint64_t count)
{
    char *repeated = calloc(count + 1, 1);
    const size_t length = strlen(keys);
    for (uint64_t i = 0; repeated && i < count; i++)
        repeated[i] = keys[i % length];
    return repeated;
}

static bool scatter(filmed_session *made, size_t count, bool moving)
{
    uint64_t random = 1;
    double(*positions)[3] = malloc(count * sizeof *positions);
    made->bodies = calloc(count, sizeof *made->bodies);
    const bool ok = positions && made->bodies &&
                    octree_sample(OCTREE_SAMPLE_CLUSTERED, 1, &made->session.tree.world, count, positions) == OCTREE_OK;
    for (size_t i = 0; ok && i < count; i++) {
        made->bodies[i].id = i + 1;
        memcpy(made->bodies[i].position, positions[i], sizeof positions[i]);
        for (int axis = 0; moving && axis < 3; axis++)
            made->bodies[i].velocity[axis] = (double)(octree_random(&random) % 601) / 100 - 3;
    }
    free(positions);
    return ok;
}

/* ---- Answered queries --------------------------------------------------------------------------------------- */

static void ask(octree_query *queries, size_t count, size_t asked, const octree_game_body *bodies, size_t body_count)
{
    enum { NEIGHBORS = 8, REACH = 20 };
    uint64_t random = 1;
    for (size_t i = 0; i < count; i++) {
        octree_query *q = &queries[i];
        const octree_game_body *body = &bodies[octree_random(&random) % body_count];
        *q = (octree_query){.tick = i / asked, .kind = i % OCTREE_QUERY_RAY, .k = NEIGHBORS, .radius = REACH};
        for (int axis = 0; axis < 3; axis++) {
            q->target[axis] = body->position[axis] + (double)(octree_random(&random) % REACH) - REACH / 2;
            q->box.min[axis] = q->target[axis] - REACH;
            q->box.max[axis] = q->target[axis] + REACH;
        }
    }
}

/* Store the ids of an answer in `ids`, unless that is null. Returns their number. */
static size_t ids_of(const octree_answer *answer, uint64_t *ids)
{
    for (size_t i = 0; ids && i < answer->count; i++)
        ids[i] = octree_query_about(answer->kind)->neighbors ? answer->neighbors[i].point.id : answer->points[i].id;
    return answer->count;
}

/* Play the session without answers, and use the game's answers as those of the program: the ids go to `ids`; null: they
 * are only counted. */
static bool play_answers(filmed_session *made, uint64_t *ids, size_t *count)
{
    octree_game *game;
    octree_query *query = made->queries;
    bool ok = octree_game_create(&made->session, &game) == OCTREE_OK;
    *count = 0;
    while (ok) {
        const octree_tick *tick = octree_game_tick(game);
        for (size_t i = 0; i < tick->answer_count; i++) {
            uint64_t *to = ids ? ids + *count : NULL;
            const size_t found = ids_of(&tick->answers[i], to);
            if (tick->answers[i].by_key)
                continue;
            query->answer = to;
            query++->answer_count = found;
            *count += found;
        }
        if (octree_game_over(game))
            break;
        ok = octree_game_advance(game) == OCTREE_OK;
    }
    octree_game_destroy(game);
    return ok;
}

static bool add_queries(filmed_session *made, size_t asked, uint64_t ticks)
{
    octree_session *session = &made->session;
    const size_t count = ticks * asked;
    made->queries = malloc(count * sizeof *made->queries);
    if (!made->queries)
        return false;
    ask(made->queries, count, asked, made->bodies, session->body_count);
    session->queries = made->queries;
    session->query_count = count;
    return true;
}

static bool add_answers(filmed_session *made)
{
    size_t ids;
    if (!play_answers(made, NULL, &ids))
        return false;
    made->answers = malloc((ids + 1) * sizeof *made->answers);
    if (!made->answers || !play_answers(made, made->answers, &ids))
        return false;
    for (size_t i = 0; i < made->session.query_count; i++)
        made->queries[i].answered = true;
    return true;
}

/* ---- Sessions ----------------------------------------------------------------------------------------------- */

bool filmed_session_make(filmed_session *made, const filmed_scene *scene, uint64_t ticks, size_t asked, bool answered)
{
    const octree_session paper = octree_session_default();
    *made = (filmed_session){.session = paper};
    made->keys = repeat_keys(scene->points ? "wdwdenasasfn" : paper.keys, ticks - 1);
    bool ok = made->keys != NULL;
    if (scene->points) {
        made->session = (octree_session){.tree = octree_def_default(), .player = {.step = 5, .box_size = 3}};
        made->session.tree.leaf_capacity = 8;
        made->session.tree.full_leaf = OCTREE_GROW;
        ok = ok && scatter(made, scene->points, scene->moving);
        made->session.bodies = made->bodies;
        made->session.body_count = scene->points;
    }
    made->session.keys = made->keys;
    ok = ok && (asked == 0 || add_queries(made, asked, ticks)) && (!answered || add_answers(made));
    if (!ok)
        filmed_session_release(made);
    return ok;
}

void filmed_session_release(filmed_session *made)
{
    free(made->bodies);
    free(made->keys);
    free(made->queries);
    free(made->answers);
    *made = (filmed_session){0};
}
