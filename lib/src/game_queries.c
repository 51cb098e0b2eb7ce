/* game_queries.c - the last part of a tick: its queries, its splits and merges, and the tick as the caller sees it. */
#include "game_parts.h"
#include "node_set.h"

#include <string.h>

static octree_status answer_range(octree_game *game, const octree_query *query, octree_answer *answer)
{
    answer->box = query->box;
    for (int i = 0; query->at_player && i < 3; i++) {
        answer->box.min[i] += game->tick.player[i];
        answer->box.max[i] += game->tick.player[i];
    }
    const size_t before = game->found.count;
    point_collector found = {&game->memory, &game->found, false};
    octree_status status = octree_range(game->tree, &answer->box, collect_point, &found);
    answer->count = game->found.count - before;
    if (status != OCTREE_OK || found.failed)
        return found.failed ? OCTREE_NO_MEMORY : status;
    if (answer->count)
        game_sort_points((octree_point *)game->found.items + before, answer->count);
    return OCTREE_OK;
}

static octree_status answer_nearest(octree_game *game, const octree_query *query, octree_answer *answer)
{
    memcpy(answer->target, query->at_player ? game->tick.player : query->target, sizeof answer->target);
    const octree_skip skip = query->at_player ? OCTREE_SKIP_ID : OCTREE_SKIP_NONE;
    const octree_status status =
        octree_nearest(game->tree, answer->target, skip, game->session->player.id, &answer->neighbor);
    answer->found = status == OCTREE_OK;
    return status == OCTREE_NOT_FOUND ? OCTREE_OK : status;
}

static octree_status ask(octree_game *game, const octree_query *query, bool by_key)
{
    octree_answer *answer = list_append(&game->memory, &game->answers, sizeof *answer);
    if (!answer)
        return OCTREE_NO_MEMORY;
    *answer = (octree_answer){.kind = query->kind, .by_key = by_key};
    if (query->kind == OCTREE_QUERY_RANGE)
        return answer_range(game, query, answer);
    return answer_nearest(game, query, answer);
}

static octree_status ask_all(octree_game *game)
{
    const octree_session *session = game->session;
    octree_status status = OCTREE_OK;
    if (game->tick.key == 'n')
        status = ask(game, &(octree_query){.kind = OCTREE_QUERY_NEAREST, .at_player = true}, true);
    while (game->next_query < session->query_count && session->queries[game->next_query].tick < game->tick.number)
        game->next_query++;
    for (size_t i = game->next_query; status == OCTREE_OK && i < session->query_count; i++)
        if (session->queries[i].tick == game->tick.number || session->queries[i].tick == OCTREE_EVERY_TICK)
            status = ask(game, &session->queries[i], false);
    return status;
}

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

/* The lists do not grow any more: let the tick point into them. */
static void publish(octree_game *game)
{
    octree_tick *tick = &game->tick;
    octree_answer *answers = game->answers.items;
    const octree_point *found = game->found.items;
    for (size_t i = 0; i < game->answers.count; i++) {
        answers[i].points = answers[i].count ? found : NULL;
        if (answers[i].count)
            found += answers[i].count;
    }
    tick->hits = game->hits.items;
    tick->hit_count = game->hits.count;
    tick->refusals = game->refusals.items;
    tick->refusal_count = game->refusals.count;
    tick->splits = game->splits.items;
    tick->split_count = game->splits.count;
    tick->merges = game->merges.items;
    tick->merge_count = game->merges.count;
    tick->answers = answers;
    tick->answer_count = game->answers.count;
}

octree_status game_finish_tick(octree_game *game)
{
    octree_status status = OCTREE_OK;
    if (game->tick.number == 0)
        status = game_collide(game, game->tick.player);
    if (status == OCTREE_OK)
        status = ask_all(game);
    if (status == OCTREE_OK)
        status = compare_node_sets(game);
    if (status == OCTREE_OK)
        publish(game);
    return status;
}
