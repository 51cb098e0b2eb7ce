/* game_player.c - who the player is; its step, and the collision test that may take it back.
 *
 * The test asks the tree before the step is made, about the step's end and without the player's own point: what it
 * finds is what a step that is made and taken back would have met, and nothing has to be undone.
 */
#include "game_state.h"
#include "tree.h"

#include <string.h>

static const struct {
    char key;
    int axis; /* -1: no step */
    int direction;
} keys[] = {
    {'w', 1, 1}, {'s', 1, -1}, {'d', 0, 1}, {'a', 0, -1}, {'e', 2, 1}, {'f', 2, -1}, {'n', -1, 0}, {'.', -1, 0},
};

#define KEY_COUNT (sizeof keys / sizeof keys[0])

static size_t key_index(char key)
{
    size_t i = 0;
    while (i < KEY_COUNT && keys[i].key != key)
        i++;
    return i;
}

bool game_is_key(char key)
{
    return key_index(key) < KEY_COUNT;
}

/* The player's place after a net number of steps on each axis. */
static void place_after(const octree_player *player, const int64_t steps[3], double position[3])
{
    for (int i = 0; i < 3; i++)
        position[i] = player->position[i] + (double)steps[i] * player->step;
}

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

bool game_is_players(const octree_game *game, uint64_t id)
{
    return game->session->player.kind == OCTREE_PLAYER_KEYS && id == game->session->player.id;
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
    const size_t key = key_index(game->tick.key);
    if (keys[key].axis < 0 || game->session->player.kind != OCTREE_PLAYER_KEYS)
        return game_collide(game, game->tick.player);
    int64_t steps[3];
    memcpy(steps, game->steps, sizeof steps);
    steps[keys[key].axis] += keys[key].direction;
    double to[3];
    place_after(&game->session->player, steps, to);
    if (check_position(game->tree, to) != OCTREE_OK) {
        game->tick.events |= OCTREE_EVENT_REFUSED;
        return game_collide(game, game->tick.player);
    }
    const octree_status status = game_collide(game, to);
    if (status != OCTREE_OK || game->hits.count)
        return status;
    return make_step(game, steps, to);
}
