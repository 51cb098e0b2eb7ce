/* game_load.c - the bodies that a session begins with, into the tree by one restructuring. */
#include "game_state.h"

#include <math.h>
#include <string.h>

/* What is to be inserted, and what became of it. */
typedef struct cargo {
    octree_point *points;
    octree_status *statuses;
    size_t count, room;
} cargo;

static bool cargo_make(arena *memory, cargo *c, size_t room)
{
    *c = (cargo){.room = room};
    if (room > SIZE_MAX / sizeof *c->points)
        return false;
    c->points = arena_take(memory, room * sizeof *c->points);
    c->statuses = c->points ? arena_take(memory, room * sizeof *c->statuses) : NULL;
    return c->statuses != NULL;
}

static void cargo_release(arena *memory, cargo *c)
{
    arena_give(memory, c->points, c->room * sizeof *c->points);
    if (c->statuses)
        arena_give(memory, c->statuses, c->room * sizeof *c->statuses);
}

static void note_speed(octree_game *game, const double velocity[3])
{
    for (int i = 0; i < 3; i++)
        if (fabs(velocity[i]) > game->fastest)
            game->fastest = fabs(velocity[i]);
}

/* A body whose velocity is not finite is refused before the tree is asked. */
static void pack(octree_game *game, cargo *c)
{
    const octree_session *session = game->session;
    for (size_t i = 0; i < session->body_count; i++) {
        const octree_body *body = &session->bodies[i];
        if (!is_finite_velocity(body->velocity))
            continue;
        note_speed(game, body->velocity);
        octree_point *point = &c->points[c->count++];
        *point = (octree_point){.id = body->id};
        memcpy(point->position, body->position, sizeof point->position);
    }
}

/* A second body with an id ends the game before there is one: that its point is in the tree then does not matter. */
static octree_status settle(octree_game *game, const cargo *c)
{
    const octree_session *session = game->session;
    size_t packed = 0;
    for (size_t i = 0; i < session->body_count; i++) {
        const octree_body *body = &session->bodies[i];
        octree_status status = game_check_body(game, body);
        if (status == OCTREE_OK)
            status = c->statuses[packed];
        packed += is_finite_velocity(body->velocity);
        status = game_settle_body(game, body, status);
        if (status == OCTREE_DUPLICATE || status == OCTREE_NO_MEMORY)
            return status;
    }
    return OCTREE_OK;
}

octree_status game_load_bodies(octree_game *game)
{
    cargo c;
    if (game->session->body_count == 0)
        return OCTREE_OK;
    octree_status status = cargo_make(&game->memory, &c, game->session->body_count) ? OCTREE_OK : OCTREE_NO_MEMORY;
    if (status == OCTREE_OK) {
        pack(game, &c);
        status = octree_insert_many(game->tree, c.points, c.count, c.statuses, NULL);
    }
    if (status == OCTREE_OK)
        status = settle(game, &c);
    cargo_release(&game->memory, &c);
    return status;
}
