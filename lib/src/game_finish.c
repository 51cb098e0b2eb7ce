/* game_finish.c - how a tick ends: its queries, its splits and merges, and the tick as the caller sees it. */
#include "game_parts.h"
#include "node_set.h"

/* Splits and merges: the difference of the inner nodes of two ticks. */
static octree_status compare_node_sets(octree_game *game)
{
    const bool first = !game->has_set;
    if (!first && game->set_version == octree_version(game->tree))
        return OCTREE_OK;
    const list before = game->inner;
    game->inner = game->inner_before;
    game->inner_before = before;
    game->has_set = true;
    game->set_version = octree_version(game->tree);
    if (!node_set_fill(&game->memory, &game->inner, game->tree))
        return OCTREE_NO_MEMORY;
    if (first)
        return OCTREE_OK;
    if (!node_set_subtract(&game->memory, &game->inner, &game->inner_before, &game->splits) ||
        !node_set_subtract(&game->memory, &game->inner_before, &game->inner, &game->merges))
        return OCTREE_NO_MEMORY;
    game->tick.events |= game->splits.count ? OCTREE_EVENT_SPLIT : 0;
    game->tick.events |= game->merges.count ? OCTREE_EVENT_MERGED : 0;
    return OCTREE_OK;
}

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
        status = compare_node_sets(game);
    if (status == OCTREE_OK)
        status = game_show_shapes(game, input);
    if (status == OCTREE_OK)
        status = game_note_movers(game);
    if (status != OCTREE_OK)
        return status;
    publish(game);
    return game_finish_visits(game);
}
