/* game_collide.c - the collision test of a tick.
 *
 * Where it is swept, points at rest are asked of the tree, and bodies that this tick has moved are tested one by one:
 * their way is relative to the player's, and the tree knows its end alone.
 */
#include "game_state.h"
#include "sweep.h"

#include <string.h>

typedef struct resting_collector {
    const octree_game *game;
    point_collector hits;
} resting_collector;

static bool was_moved(const octree_game *game, const moving_body *body)
{
    return body->moved == game->tick.number;
}

static bool collect_resting(const octree_point *point, void *context)
{
    resting_collector *c = context;
    const moving_body *body = bodies_find(&c->game->bodies, point->id);
    return (body && was_moved(c->game, body)) || collect_point(point, &c->hits);
}

static octree_status collide_resting(octree_game *game, const octree_point *self)
{
    const octree_tick *tick = &game->tick;
    const octree_search how = game_search(game, &game->tick.hit_cost);
    resting_collector found = {game, {&game->memory, &game->hits, false}};
    const octree_status status = octree_collide_swept(
        game->tree, tick->from, tick->attempt, game->session->player.box_size, self, &how, collect_resting, &found);
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
        double(*from)[3] = list_append(&game->memory, &game->hit_from, sizeof *from);
        if (!from)
            return OCTREE_NO_MEMORY;
        const moving_body *body = bodies_find(&game->bodies, hits[i].id);
        memcpy(*from, body && was_moved(game, body) ? body->before : hits[i].position, sizeof *from);
    }
    return OCTREE_OK;
}

static octree_status collide_at_end(octree_game *game, const octree_point *self)
{
    const octree_search how = game_search(game, &game->tick.hit_cost);
    point_collector hits = {&game->memory, &game->hits, false};
    const octree_status status = octree_collide_search(game->tree, game->tick.attempt, game->session->player.box_size,
                                                       self, &how, collect_point, &hits);
    return hits.failed ? OCTREE_NO_MEMORY : status;
}

static octree_status collide_on_the_way(octree_game *game, const octree_point *self)
{
    const octree_status status = collide_resting(game, self);
    return status == OCTREE_OK ? collide_moved(game) : status;
}

octree_status game_collide(octree_game *game, const double to[3])
{
    octree_tick *tick = &game->tick;
    octree_point self = {.id = game->session->player.id};
    memcpy(self.position, tick->player, sizeof self.position);
    memcpy(tick->attempt, to, sizeof tick->attempt);
    tick->hit_cost = (octree_cost){0};
    game->hits.count = game->visits.count = 0;
    octree_status status = tick->swept ? collide_on_the_way(game, &self) : collide_at_end(game, &self);
    game_sort_points(game->hits.items, game->hits.count);
    if (status == OCTREE_OK && tick->swept)
        status = trace_hits(game);
    if (game->hits.count)
        tick->events |= OCTREE_EVENT_COLLIDED;
    return status;
}
