/* player.c - the player: its step, and the collision test that may take it back.
 *
 * The test asks the tree before the step is made, about the step's end and without the player's own point: what it
 * finds is what a step that is made and taken back would have met, and nothing has to be undone.
 */
#include "player.h"
#include "game_state.h"
#include "queries.h"
#include "sweep.h"

#include <string.h>

/* The direction of a key's step on an axis; 0 for none. */
static int direction_of(char key, int axis)
{
    return (key == "dwe"[axis]) - (key == "asf"[axis]);
}

bool game_is_key(char key)
{
    return key && strchr("dweasfn.", key);
}

/* ---- The collision test --------------------------------------------------------------------------------------
 *
 * Where it is swept, points at rest are asked of the tree, and bodies that this tick has moved are tested one by one:
 * their way is relative to the player's, and the tree knows its end alone.
 */

typedef struct hit_collector {
    const octree_game *game;
    point_collector hits;
} hit_collector;

static bool was_moved(const octree_game *game, const moving_body *body)
{
    return body->moved == game->tick.number;
}

static bool collect_hit(const octree_point *point, void *context)
{
    hit_collector *c = context;
    const moving_body *body = c->game->tick.swept ? bodies_find(&c->game->bodies, point->id) : NULL;
    return (body && was_moved(c->game, body)) || collect_point(point, &c->hits);
}

/* The points of the tree; when swept, but for bodies that this tick has moved. */
static octree_status collide_points(octree_game *game, const octree_point *self)
{
    const octree_tick *tick = &game->tick;
    const double *from = tick->swept ? tick->from : tick->attempt;
    const octree_search how = game_search(game, &game->tick.hit_cost);
    hit_collector found = {game, {&game->memory, &game->hits, false}};
    const octree_status status = octree_collide_swept(game->tree, from, tick->attempt, game->session->player.box_size,
                                                      self, &how, collect_hit, &found);
    return found.hits.failed ? OCTREE_NO_MEMORY : status;
}

static octree_status collide_moved(octree_game *game)
{
    const sweep box = {game->tick.from, game->tick.attempt, game->session->player.box_size};
    point_collector hits = {&game->memory, &game->hits, false};
    for (size_t i = 0; i < game->bodies.items.count; i++) {
        const moving_body *body = &bodies_items(&game->bodies)[i];
        if (!was_moved(game, body) || body->id == game->session->player.id)
            continue;
        game->tick.hit_cost.points++;
        if (!sweep_touches(&box, body->before, body->position))
            continue;
        octree_point hit = {.id = body->id};
        memcpy(hit.position, body->position, sizeof hit.position);
        if (!collect_point(&hit, &hits))
            return OCTREE_NO_MEMORY;
    }
    return OCTREE_OK;
}

/* Where the hits, which are in their order, come from. */
static octree_status trace_hits(octree_game *game)
{
    const octree_point *hits = game->hits.items;
    game->hit_from.count = 0;
    for (size_t i = 0; i < game->hits.count; i++) {
        const moving_body *body = bodies_find(&game->bodies, hits[i].id);
        const double *from = body && was_moved(game, body) ? body->before : hits[i].position;
        if (!list_push(&game->memory, &game->hit_from, from, sizeof(double[3])))
            return OCTREE_NO_MEMORY;
    }
    return OCTREE_OK;
}

octree_status game_collide(octree_game *game, const double to[3])
{
    octree_tick *tick = &game->tick;
    octree_point self = {.id = game->session->player.id};
    memcpy(self.position, tick->player, sizeof self.position);
    memcpy(tick->attempt, to, sizeof tick->attempt);
    tick->hit_cost = (octree_cost){0};
    game->hits.count = game->visits.count = 0;
    octree_status status = collide_points(game, &self);
    if (status == OCTREE_OK && tick->swept)
        status = collide_moved(game);
    sort_points(&game->hits, 0);
    if (status == OCTREE_OK && tick->swept)
        status = trace_hits(game);
    if (game->hits.count)
        tick->events |= OCTREE_EVENT_COLLIDED;
    return status;
}

/* ---- The step ----------------------------------------------------------------------------------------------- */

/* The player stays. Swept, the test is made anew for it as for one that waits: what comes its way is not missed. */
static octree_status refuse_step(octree_game *game, octree_status why, const double to[3])
{
    const octree_status status = game_note_refusal(game, game->session->player.id, why, to);
    return status == OCTREE_OK && game->session->player.sweep ? game_collide(game, game->tick.player) : status;
}

/* A step whose end is inside the world and free of hits: it can still meet a full leaf. */
static octree_status make_step(octree_game *game, const int64_t steps[3], const double to[3])
{
    const uint64_t id = game->session->player.id;
    const octree_status status = game_move(game, game->tick.player, id, to);
    if (status == OCTREE_NO_MEMORY)
        return status;
    if (status != OCTREE_OK)
        return refuse_step(game, status, to);
    memcpy(game->steps, steps, sizeof game->steps);
    memcpy(game->tick.player, to, sizeof game->tick.player);
    game->tick.events |= OCTREE_EVENT_MOVED;
    return OCTREE_OK;
}

void game_find_player(octree_game *game)
{
    octree_tick *tick = &game->tick;
    const octree_player *player = &game->session->player;
    const moving_body *body = player->kind == OCTREE_PLAYER_BODY ? bodies_find(&game->bodies, player->id) : NULL;
    if (body)
        memcpy(tick->player, body->position, sizeof tick->player);
    tick->has_player = body || player->kind == OCTREE_PLAYER_KEYS;
    memcpy(tick->from, body && body->moved == tick->number ? body->before : tick->player, sizeof tick->from);
    memcpy(tick->attempt, tick->player, sizeof tick->attempt);
    tick->swept = tick->has_player && player->sweep;
    tick->hit_cost = (octree_cost){0};
}

octree_status game_step_player(octree_game *game)
{
    game_find_player(game);
    if (!game->tick.has_player)
        return OCTREE_OK;
    const octree_player *player = &game->session->player;
    if (player->kind != OCTREE_PLAYER_KEYS)
        return game_collide(game, game->tick.player);
    int64_t steps[3];
    double to[3];
    for (int i = 0; i < 3; i++) {
        steps[i] = game->steps[i] + direction_of(game->tick.key, i);
        to[i] = player->position[i] + (double)steps[i] * player->step;
    }
    if (memcmp(steps, game->steps, sizeof steps) == 0)
        return game_collide(game, game->tick.player);
    if (check_position(game->tree, to) != OCTREE_OK) {
        game->tick.events |= OCTREE_EVENT_REFUSED;
        return game_collide(game, game->tick.player);
    }
    const octree_status status = game_collide(game, to);
    if (status != OCTREE_OK || game->hits.count)
        return status;
    return make_step(game, steps, to);
}
