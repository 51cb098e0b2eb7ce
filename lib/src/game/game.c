/* game.c - the game loop: one tick after another, in the order that game.h states. */
#include "float_rules.h"
#include "game_state.h"

#include <string.h>

/* Edits, queries and shapes begin with their tick. */
static uint64_t tick_of(const void *items, size_t size, size_t i)
{
    uint64_t tick;
    memcpy(&tick, (const char *)items + i * size, sizeof tick);
    return tick;
}

/* The items of a tick, which are then behind *next; their number into *count. */
static const void *take_items(const void *items, size_t size, size_t end, uint64_t tick, size_t *next, size_t *count)
{
    while (*next < end && tick_of(items, size, *next) < tick)
        ++*next;
    const size_t first = *next;
    while (*next < end && tick_of(items, size, *next) == tick)
        ++*next;
    *count = *next - first;
    return *count ? (const char *)items + first * size : NULL;
}

/* What the session has for its next tick; 0 is the key of the first. */
static octree_input own_input(octree_game *game, char key)
{
    const octree_session *s = game->session;
    const uint64_t tick = key ? game->tick.number + 1 : 0;
    octree_input input = {.key = key};
    input.edits = take_items(s->edits, sizeof *s->edits, s->edit_count, tick, &game->next_edit, &input.edit_count);
    input.queries =
        take_items(s->queries, sizeof *s->queries, game->standing, tick, &game->next_query, &input.query_count);
    input.shapes =
        take_items(s->shapes, sizeof *s->shapes, game->standing_shapes, tick, &game->next_shape, &input.shape_count);
    return input;
}

/* The first of those of every tick, which come last. */
static size_t first_standing(const void *items, size_t size, size_t count)
{
    while (count > 0 && tick_of(items, size, count - 1) == OCTREE_EVERY_TICK)
        count--;
    return count;
}

/* Halves first: no world overflows. */
static octree_status place_player(octree_game *game)
{
    const octree_player *player = &game->session->player;
    const octree_box *world = &game->session->tree.world;
    for (int i = 0; i < 3; i++)
        game->tick.player[i] = world->min[i] / 2 + world->max[i] / 2;
    if (player->kind != OCTREE_PLAYER_KEYS)
        return OCTREE_OK;
    memcpy(game->tick.player, player->position, sizeof game->tick.player);
    return game_insert(game, player->position, player->id);
}

static octree_status start(octree_game *game)
{
    const octree_session *session = game->session;
    octree_status status = game_check_session(session, game->tree);
    if (status == OCTREE_OK)
        status = place_player(game);
    if (status == OCTREE_OK)
        status = game_load_bodies(game);
    game_find_player(game);
    const octree_input input = own_input(game, 0);
    if (status == OCTREE_OK)
        status = game_finish_tick(game, &input);
    return status;
}

octree_status octree_game_create(const octree_session *session, octree_game **game)
{
    if (!game)
        return OCTREE_NULL_ARGUMENT;
    *game = NULL;
    if (!session || (!session->bodies && session->body_count) || (!session->edits && session->edit_count) ||
        (!session->queries && session->query_count) || (!session->shapes && session->shape_count))
        return OCTREE_NULL_ARGUMENT;
    octree *tree;
    octree_status status = octree_create(&session->tree, &tree);
    if (status != OCTREE_OK)
        return status;
    arena memory = {.allocator = octree_definition(tree).allocator};
    octree_game *made = arena_take(&memory, sizeof *made);
    if (!made) {
        octree_destroy(tree);
        return OCTREE_NO_MEMORY;
    }
    *made = (octree_game){.session = session, .tree = tree, .memory = memory};
    made->bodies.memory = &made->memory;
    made->standing = first_standing(session->queries, sizeof *session->queries, session->query_count);
    made->standing_shapes = first_standing(session->shapes, sizeof *session->shapes, session->shape_count);
    status = start(made);
    if (status == OCTREE_OK)
        *game = made;
    else
        octree_game_destroy(made);
    return status;
}

void octree_game_destroy(octree_game *game)
{
    if (!game)
        return;
    octree_destroy(game->tree);
    bodies_release(&game->bodies);
    arena memory = game->memory;
    list_release(&memory, &game->hits, sizeof(octree_point));
    list_release(&memory, &game->hit_from, sizeof(double[3]));
    list_release(&memory, &game->found, sizeof(octree_point));
    list_release(&memory, &game->near, sizeof(octree_neighbor));
    list_release(&memory, &game->refusals, sizeof(octree_refusal));
    list_release(&memory, &game->answers, sizeof(octree_answer));
    survey_release(&game->survey, &memory);
    list_release(&memory, &game->splits, sizeof(octree_address));
    list_release(&memory, &game->merges, sizeof(octree_address));
    list_release(&memory, &game->visits, sizeof(octree_visit));
    list_release(&memory, &game->hit_leaves, sizeof(octree_address));
    list_release(&memory, &game->shapes, sizeof(octree_shape));
    list_release(&memory, &game->movers, sizeof(octree_body));
    arena_give(&memory, game, sizeof *game);
}

static void begin_tick(octree_game *game, char key)
{
    game->hits.count = game->found.count = game->near.count = 0;
    game->refusals.count = game->answers.count = 0;
    game->splits.count = game->merges.count = 0;
    game->visits.count = game->hit_leaves.count = game->movers.count = 0;
    game->tick.number++;
    game->tick.key = key;
    game->tick.events = 0;
}

/* `given` is null where the session has what happens. */
static octree_status step(octree_game *game, char key, const octree_input *given)
{
    if (!float_mode_is_default())
        return OCTREE_FLOAT_MODE;
    if (key == 'q') {
        game->quit = true;
        return OCTREE_OK;
    }
    if (!game_is_key(key))
        return OCTREE_BAD_KEY;
    const octree_input own = own_input(game, key), *input = given ? given : &own;
    begin_tick(game, key);
    octree_status status = game_apply_edits(game, input);
    if (status == OCTREE_OK)
        status = game_move_bodies(game);
    if (status == OCTREE_OK)
        status = game_step_player(game);
    if (status == OCTREE_OK)
        status = game_finish_tick(game, input);
    return status;
}

octree_status octree_game_step(octree_game *game, char key)
{
    return game ? step(game, key, NULL) : OCTREE_NULL_ARGUMENT;
}

octree_status octree_game_play(octree_game *game, const octree_input *input)
{
    if (!game || !input)
        return OCTREE_NULL_ARGUMENT;
    const octree_status status = octree_input_check(input);
    return status == OCTREE_OK ? step(game, input->key ? input->key : '.', input) : status;
}

uint64_t octree_session_length(const octree_session *session)
{
    if (!session)
        return 0;
    const size_t keys = session->keys ? strcspn(session->keys, "q") : 0;
    const bool quits = session->keys && session->keys[keys] == 'q';
    return quits || keys > session->ticks ? keys : session->ticks;
}

bool octree_game_over(const octree_game *game)
{
    return !game || game->quit || game->tick.number >= octree_session_length(game->session);
}

octree_status octree_game_advance(octree_game *game)
{
    if (!game)
        return OCTREE_NULL_ARGUMENT;
    if (octree_game_over(game))
        return OCTREE_NOT_FOUND;
    const char *keys = game->session->keys;
    const size_t key_count = keys ? strlen(keys) : 0;
    return octree_game_step(game, game->tick.number < key_count ? keys[game->tick.number] : '.');
}

const octree_tick *octree_game_tick(const octree_game *game)
{
    return game ? &game->tick : NULL;
}

const octree *octree_game_tree(const octree_game *game)
{
    return game ? game->tree : NULL;
}

const octree_session *octree_game_session(const octree_game *game)
{
    return game ? game->session : NULL;
}

double octree_game_fastest(const octree_game *game)
{
    return game ? game->fastest : 0;
}

const char *octree_event_name(octree_event event)
{
    static const char *const names[OCTREE_EVENT_KINDS] = {"moved", "refused", "collided", "full", "split", "merged"};
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        if (event == 1u << i)
            return names[i];
    return NULL;
}
