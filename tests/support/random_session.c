/* SPDX-License-Identifier: MIT */
#include "random_session.h"

#include "fixture.h"

/* A random multiple of 1/4 in [low, high], whose ends are whole. */
static double quarter(uint64_t *state, double low, double high)
{
    return low + (double)random_below(state, (uint64_t)(4 * (high - low)) + 1) / 4;
}

/* A position of the world: half of them near its centre, so that some meet, some fill their leaf. */
static void random_position(uint64_t *state, const octree_box *world, double position[3])
{
    bool crowded = random_below(state, 2) == 0;
    for (int axis = 0; axis < 3; axis++) {
        double low = world->min[axis], high = world->max[axis];
        double middle = (double)(int64_t)((low + high) / 2);
        position[axis] = crowded ? quarter(state, middle - 2, middle + 2) : quarter(state, low, high);
    }
}

static void random_body(uint64_t *state, const octree_box *world, uint64_t id, bool moves, octree_game_body *body)
{
    *body = (octree_game_body){.id = id};
    random_position(state, world, body->position);
    for (int axis = 0; moves && axis < 3; axis++)
        body->velocity[axis] = quarter(state, -3, 3);
}

static void random_start(random_session *made, uint64_t *state)
{
    octree_session *session = &made->session;
    octree_box world;
    for (int axis = 0; axis < 3; axis++) {
        world.min[axis] = -(double)(8 + random_below(state, 40));
        world.max[axis] = (double)(8 + random_below(state, 40));
    }
    /* One after the other: compilers differ in the order of arguments. */
    const size_t depth = random_below(state, 9);
    const size_t capacity = 1 + random_below(state, 8);
    *session = (octree_session){.tree = define(world, capacity, depth, OCTREE_REFUSE)};
    session->player.id = 1000;
    random_position(state, &world, session->player.position);
    session->player.step = quarter(state, 1, 12);
    session->player.box_size = quarter(state, 0, 6);
    session->body_count = random_below(state, RANDOM_SESSION_BODIES + 1);
    session->bodies = made->bodies;
}

static void random_keys(random_session *made, uint64_t *state)
{
    static const char keys[] = "wasdefn.";
    size_t length = 1 + random_below(state, RANDOM_SESSION_KEYS);
    for (size_t i = 0; i < length; i++)
        made->keys[i] = keys[random_below(state, sizeof keys - 1)];
    made->keys[length] = '\0';
    made->session.keys = made->keys;
}

static void random_bodies(random_session *made, uint64_t *state, bool moves)
{
    for (size_t i = 0; i < made->session.body_count; i++)
        random_body(state, &made->session.tree.world, i + 1, moves && i % 3 == 0, &made->bodies[i]);
}

static const octree_query nearest_to_player = {
    .tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_NEAREST, .at_player = true};

void random_session_plain(random_session *made, uint64_t seed)
{
    uint64_t state = seed;
    random_start(made, &state);
    random_bodies(made, &state, false);
    random_keys(made, &state);
    made->queries[0] = nearest_to_player;
    made->session.queries = made->queries;
    made->session.query_count = 1;
}

/* A tick that is not before the one given. */
static uint64_t later(uint64_t *state, uint64_t tick)
{
    return tick + random_below(state, 4);
}

static void random_edits(random_session *made, uint64_t *state)
{
    octree_session *session = &made->session;
    session->edits = made->edits;
    session->edit_count = random_below(state, RANDOM_SESSION_EDITS + 1);
    uint64_t tick = 1;
    for (size_t i = 0; i < session->edit_count; i++) {
        octree_edit *edit = &made->edits[i];
        tick = later(state, tick);
        edit->tick = tick;
        edit->kind = (octree_edit_kind)random_below(state, 3);
        random_body(state, &session->tree.world, 1 + random_below(state, 2 * RANDOM_SESSION_BODIES), i % 2 == 0,
                    &edit->body);
    }
}

static void random_query(uint64_t *state, const octree_box *world, octree_query *query)
{
    /* A list of its own: a kind that is new must not change the sessions of a seed, whose digests are pinned. */
    static const octree_query_kind kinds[] = {OCTREE_QUERY_RANGE, OCTREE_QUERY_NEAREST, OCTREE_QUERY_KNEAREST,
                                              OCTREE_QUERY_RADIUS};
    query->kind = kinds[random_below(state, sizeof kinds / sizeof kinds[0])];
    query->at_player = random_below(state, 2) == 0;
    random_position(state, world, query->target);
    for (int axis = 0; axis < 3; axis++) {
        query->box.min[axis] = quarter(state, -20, 10);
        query->box.max[axis] = query->box.min[axis] + quarter(state, 0, 20);
    }
    query->k = random_below(state, 2) == 0 ? random_below(state, 6) : random_below(state, 2 * RANDOM_SESSION_BODIES);
    query->radius = quarter(state, 0, 20);
}

static void random_queries(random_session *made, uint64_t *state)
{
    octree_session *session = &made->session;
    session->queries = made->queries;
    session->query_count = 1 + random_below(state, RANDOM_SESSION_QUERIES);
    uint64_t tick = 0;
    for (size_t i = 0; i + 1 < session->query_count; i++) {
        tick = later(state, tick);
        made->queries[i] = (octree_query){.tick = tick};
        random_query(state, &session->tree.world, &made->queries[i]);
    }
    made->queries[session->query_count - 1] = nearest_to_player;
}

void random_session_full(random_session *made, uint64_t seed)
{
    uint64_t state = seed;
    random_start(made, &state);
    random_bodies(made, &state, true);
    random_keys(made, &state);
    random_edits(made, &state);
    random_queries(made, &state);
    made->session.player.sweep = random_below(&state, 3) == 0;
    made->session.ticks = random_below(&state, 2 * RANDOM_SESSION_KEYS);
}

/* One in four bodies is a point, one in sixteen may be as large as half the world, and one in four axes is flat. */
static void random_half_extents(uint64_t *state, double half[3])
{
    const bool point = random_below(state, 4) == 0, large = random_below(state, 16) == 0;
    for (int axis = 0; axis < 3; axis++) {
        const double size = quarter(state, 0, large ? 24 : 3);
        half[axis] = point || random_below(state, 4) == 0 ? 0 : size;
    }
}

void random_session_boxes(random_session *made, uint64_t seed)
{
    uint64_t state = ~seed;
    random_session_full(made, seed);
    for (size_t i = 0; i < made->session.body_count; i++)
        random_half_extents(&state, made->bodies[i].half);
    for (size_t i = 0; i < made->session.edit_count; i++)
        if (made->edits[i].kind == OCTREE_EDIT_INSERT)
            random_half_extents(&state, made->edits[i].body.half);
    made->session.pairs = true;
}

void random_session_mixed(random_session *made, uint64_t seed)
{
    if (seed % 2)
        random_session_boxes(made, seed);
    else
        random_session_full(made, seed);
}
