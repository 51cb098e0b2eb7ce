/* game_finish.c - how a tick ends: its queries, and the tick as the caller sees it. */
#include "game_state.h"

static void publish(octree_game *game)
{
    octree_tick *tick = &game->tick;
    game_publish_answers(game);
    tick->hits = game->hits.items;
    tick->hit_count = game->hits.count;
    tick->hit_from = tick->swept ? game->hit_from.items : NULL;
    tick->refusals = game->refusals.items;
    tick->refusal_count = game->refusals.count;
    tick->splits = game->splits.items;
    tick->split_count = game->splits.count;
    tick->merges = game->merges.items;
    tick->merge_count = game->merges.count;
}

octree_status game_finish_tick(octree_game *game, const octree_input *input)
{
    octree_status status = OCTREE_OK;
    if (game->tick.number == 0 && game->tick.has_player)
        status = game_collide(game, game->tick.player);
    if (status == OCTREE_OK)
        status = game_ask(game, input);
    if (status == OCTREE_OK)
        status = game_survey(game);
    if (status == OCTREE_OK)
        status = game_show_shapes(game, input);
    if (status == OCTREE_OK)
        status = game_note_movers(game);
    if (status != OCTREE_OK)
        return status;
    publish(game);
    return game_finish_visits(game);
}
