/* game.c - the game loop: one tick after another, in the order that game.h states. */
#include "float_rules.h"
#include "game_state.h"
#include "player.h"
#include "queries.h"
#include "session.h"

#include <string.h>

const char *octree_event_name(octree_event event)
{
    static const char *const names[OCTREE_EVENT_KINDS] = {"moved", "refused", "collided", "full", "split", "merged"};
    for (unsigned i = 0; i < OCTREE_EVENT_KINDS; i++)
        if (event == 1u << i)
            return names[i];
    return NULL;
}

const char *octree_shape_name(octree_shape_kind kind)
{
    static const char *const names[OCTREE_SHAPE_KINDS] = {"box", "segment", "point", "label"};
    return (unsigned)kind < OCTREE_SHAPE_KINDS ? names[kind] : NULL;
}

/* ---- The end of a tick -------------------------------------------------------------------------------------- */

static octree_status list_shapes(octree_game *game, const octree_shape *shapes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        octree_shape shape = shapes[i];
        shape.tick = game->tick.number;
        if (!list_push(&game->memory, &game->shapes, &shape, sizeof shape))
            return OCTREE_NO_MEMORY;
    }
    return OCTREE_OK;
}

/* Ask the queries and show the shapes of a tick, and then those of every tick. */
static octree_status ask_and_show(octree_game *game, const octree_input *input)
{
    const octree_input always = session_input(game->session, OCTREE_EVERY_TICK);
    octree_status status = game_ask_by_key(game);
    if (status == OCTREE_OK)
        status = game_ask(game, input->queries, input->query_count);
    if (status == OCTREE_OK)
        status = game_ask(game, always.queries, always.query_count);
    if (status == OCTREE_OK)
        status = game_finish_asking(game);
    if (status == OCTREE_OK)
        status = list_shapes(game, input->shapes, input->shape_count);
    if (status == OCTREE_OK)
        status = list_shapes(game, always.shapes, always.shape_count);
    return status;
}

/* The tick's splits and merges, and the digest and statistics of its tree. */
static octree_status summarize_tree(octree_game *game)
{
    tree_summary *summary = &game->summary;
    const bool first = game->tick.number == 0;
    if (!first && summary->version == octree_version(game->tree))
        return OCTREE_OK;
    octree_status status = tree_summary_update(summary, &game->memory, game->tree);
    if (status == OCTREE_OK && !first && !tree_summary_compare(summary, &game->memory, &game->splits, &game->merges))
        status = OCTREE_NO_MEMORY;
    game->tick.events |= game->splits.count ? OCTREE_EVENT_SPLIT : 0;
    game->tick.events |= game->merges.count ? OCTREE_EVENT_MERGED : 0;
    game->tick.stats = summary->stats;
    game->tick.tree_digest = summary->digest;
    return status;
}

/* The lists do not grow any more: let the tick point to them. */
static void publish(octree_game *game)
{
#define PUBLISH(name, shown_count, type)                                                                               \
    game->tick.name = game->name.items;                                                                                \
    game->tick.shown_count = game->name.count;
    GAME_SHOWN_LISTS(PUBLISH)
#undef PUBLISH
    game->tick.hit_from = game->tick.swept ? game->hit_from.items : NULL;
}

static octree_status finish_tick(octree_game *game, const octree_input *input)
{
    octree_status status = OCTREE_OK;
    if (game->tick.number == 0 && game->tick.has_player)
        status = game_collide(game, game->tick.player);
    if (status == OCTREE_OK)
        status = ask_and_show(game, input);
    if (status == OCTREE_OK)
        status = summarize_tree(game);
    if (status == OCTREE_OK)
        status = game_list_movers(game);
    if (status == OCTREE_OK)
        publish(game);
    return status;
}

/* ---- The beginning and the end of a game -------------------------------------------------------------------- */

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
    if (status != OCTREE_OK)
        return status;
    game_find_player(game);
    const octree_input input = session_input(session, 0);
    return finish_tick(game, &input);
}

octree_status octree_game_create(const octree_session *session, octree_game **game)
{
    if (!game)
        return OCTREE_NULL_ARGUMENT;
    *game = NULL;
    if (!session || (!session->bodies && session->body_count))
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
    arena memory = game->memory;
    bodies_release(&game->bodies, &memory);
    tree_summary_release(&game->summary, &memory);
#define RELEASE(name, shown_count, type) list_release(&memory, &game->name, sizeof(type));
    GAME_LISTS(RELEASE)
#undef RELEASE
    arena_give(&memory, game, sizeof *game);
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

static void begin_tick(octree_game *game, char key)
{
#define CLEAR(name, shown_count, type) game->name.count = 0;
    GAME_LISTS(CLEAR)
#undef CLEAR
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
    const octree_input own = session_input(game->session, game->tick.number + 1), *input = given ? given : &own;
    begin_tick(game, key);
    octree_status status = game_apply_edits(game, input);
    if (status == OCTREE_OK)
        status = game_move_bodies(game);
    if (status == OCTREE_OK)
        status = game_step_player(game);
    if (status == OCTREE_OK)
        status = finish_tick(game, input);
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
