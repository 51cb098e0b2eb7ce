/* game_bodies.c - the first two parts of a tick: edits, and points that move by velocity. */
#include "game_state.h"

#include <string.h>

octree_status game_note_refusal(octree_game *game, uint64_t id, octree_status why, const double position[3])
{
    octree_refusal *refusal = list_append(&game->memory, &game->refusals, sizeof *refusal);
    if (!refusal)
        return OCTREE_NO_MEMORY;
    *refusal = (octree_refusal){id, why, {position[0], position[1], position[2]}};
    if (why == OCTREE_FULL)
        game->tick.events |= OCTREE_EVENT_FULL;
    if (why == OCTREE_OUTSIDE)
        game->tick.events |= OCTREE_EVENT_REFUSED;
    return OCTREE_OK;
}

/* A refusal by the tree is part of the game; no memory is the end of it. */
static octree_status note_unless_done(octree_game *game, uint64_t id, octree_status status, const double position[3])
{
    if (status == OCTREE_OK || status == OCTREE_NO_MEMORY)
        return status;
    const octree_status noted = game_note_refusal(game, id, status, position);
    return noted == OCTREE_OK ? status : noted;
}

/* An edit comes before the motion of its own tick: what it places moves on from there at once. */
static uint64_t origin_tick(const octree_game *game)
{
    return game->tick.number ? game->tick.number - 1 : 0;
}

octree_status game_check_body(const octree_game *game, const octree_body *body)
{
    if (game_is_players(game, body->id) || bodies_find(&game->bodies, body->id))
        return OCTREE_DUPLICATE;
    return is_finite_velocity(body->velocity) ? OCTREE_OK : OCTREE_NOT_FINITE;
}

octree_status game_settle_body(octree_game *game, const octree_body *body, octree_status status)
{
    if (status == OCTREE_OK && !bodies_add(&game->bodies, body, origin_tick(game)))
        return OCTREE_NO_MEMORY;
    return note_unless_done(game, body->id, status, body->position);
}

static octree_status insert_body(octree_game *game, const octree_body *body)
{
    octree_status status = game_check_body(game, body);
    if (status == OCTREE_OK)
        status = game_insert(game, body->position, body->id);
    return game_settle_body(game, body, status);
}

static octree_status remove_body(octree_game *game, const octree_edit *edit)
{
    static const double nowhere[3] = {0, 0, 0}; /* a removal says no place: only its id is read */
    moving_body *body = bodies_find(&game->bodies, edit->body.id);
    octree_status status = OCTREE_NOT_FOUND;
    if (body)
        status = game_remove(game, body->position, body->id);
    if (status == OCTREE_OK)
        bodies_remove(&game->bodies, body);
    return note_unless_done(game, edit->body.id, status, nowhere);
}

static octree_status move_body(octree_game *game, const octree_edit *edit)
{
    moving_body *body = bodies_find(&game->bodies, edit->body.id);
    octree_status status = OCTREE_NOT_FOUND;
    if (body)
        status = game_move(game, body->position, body->id, edit->body.position);
    if (status == OCTREE_OK) {
        body_store(body, edit->body.position, game->tick.number);
        memcpy(body->origin, edit->body.position, sizeof body->origin);
        body->since = origin_tick(game);
    }
    return note_unless_done(game, edit->body.id, status, edit->body.position);
}

static octree_status apply_edit(octree_game *game, const octree_edit *edit)
{
    switch (edit->kind) {
    case OCTREE_EDIT_INSERT:
        return insert_body(game, &edit->body);
    case OCTREE_EDIT_REMOVE:
        return remove_body(game, edit);
    default:
        return move_body(game, edit);
    }
}

octree_status game_apply_edits(octree_game *game, const octree_input *input)
{
    for (size_t i = 0; i < input->edit_count; i++)
        if (apply_edit(game, &input->edits[i]) == OCTREE_NO_MEMORY)
            return OCTREE_NO_MEMORY;
    return OCTREE_OK;
}

octree_status game_move_bodies(octree_game *game)
{
    if (game->bodies.movers == 0)
        return OCTREE_OK;
    for (size_t i = 0; i < game->bodies.items.count; i++) {
        moving_body *body = &bodies_items(&game->bodies)[i];
        if (!is_moving(body->velocity))
            continue; /* its bits stay too: -0.0 plus nothing would be +0.0 */
        double to[3];
        body_position(body, &game->session->tree.world, game->tick.number, to);
        if (memcmp(to, body->position, sizeof to) == 0)
            continue;
        const octree_status status = game_move(game, body->position, body->id, to);
        if (status == OCTREE_OK)
            body_store(body, to, game->tick.number);
        if (note_unless_done(game, body->id, status, to) == OCTREE_NO_MEMORY)
            return OCTREE_NO_MEMORY;
    }
    return OCTREE_OK;
}

octree_status game_note_movers(octree_game *game)
{
    const bodies *all = &game->bodies;
    for (size_t i = 0; all->movers && i < all->items.count; i++) {
        const moving_body *body = &bodies_items(all)[i];
        octree_body now = {.id = body->id};
        if (!is_moving(body->velocity))
            continue;
        memcpy(now.position, body->position, sizeof now.position);
        body_velocity(body, &game->session->tree.world, game->tick.number, now.velocity);
        if (!is_moving(now.velocity))
            continue; /* it is so fast that it stays where it is */
        octree_body *mover = list_append(&game->memory, &game->movers, sizeof *mover);
        if (!mover)
            return OCTREE_NO_MEMORY;
        *mover = now;
    }
    game->tick.movers = game->movers.items;
    game->tick.mover_count = game->movers.count;
    return OCTREE_OK;
}
