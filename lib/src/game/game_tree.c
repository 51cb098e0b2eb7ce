/* game_tree.c - a game's changes to its tree, of which the survey is told, and what it then says of them. */
#include "game_state.h"
#include "plane.h"

static void touch(octree_game *game, const double place[3])
{
    survey_touch(&game->survey, &game->memory, game->tree, place);
}

octree_status game_insert(octree_game *game, const double position[3], uint64_t id)
{
    const octree_status status = octree_insert(game->tree, position, id);
    if (status == OCTREE_OK)
        touch(game, position);
    return status;
}

octree_status game_remove(octree_game *game, const double position[3], uint64_t id)
{
    const octree_status status = octree_remove(game->tree, position, id);
    if (status == OCTREE_OK)
        touch(game, position);
    return status;
}

octree_status game_move(octree_game *game, const double from[3], uint64_t id, const double to[3])
{
    const octree_status status = octree_move(game->tree, from, id, to);
    if (status != OCTREE_OK)
        return status;
    touch(game, from);
    touch(game, to);
    return OCTREE_OK;
}

/* Append the addresses of `a` that are not in `b`, both in pre-order, to `out`. False when there is no memory. */
static bool subtract(arena *memory, const list *a, const list *b, list *out)
{
    const octree_address *in_a = a->items, *in_b = b->items;
    for (size_t i = 0, j = 0; i < a->count; i++) {
        while (j < b->count && address_compare(&in_b[j], &in_a[i]) < 0)
            j++;
        if (j < b->count && in_b[j] == in_a[i])
            continue;
        octree_address *item = list_append(memory, out, sizeof *item);
        if (!item)
            return false;
        *item = in_a[i];
    }
    return true;
}

/* Splits and merges: the difference of the inner nodes of two ticks. */
static octree_status compare_inner_nodes(octree_game *game)
{
    const survey *s = &game->survey;
    if (!subtract(&game->memory, &s->inner, &s->inner_before, &game->splits) ||
        !subtract(&game->memory, &s->inner_before, &s->inner, &game->merges))
        return OCTREE_NO_MEMORY;
    game->tick.events |= game->splits.count ? OCTREE_EVENT_SPLIT : 0;
    game->tick.events |= game->merges.count ? OCTREE_EVENT_MERGED : 0;
    return OCTREE_OK;
}

octree_status game_survey(octree_game *game)
{
    const bool first = game->tick.number == 0;
    if (!first && game->survey.version == octree_version(game->tree))
        return OCTREE_OK;
    octree_status status = survey_update(&game->survey, &game->memory, game->tree);
    if (status == OCTREE_OK && !first)
        status = compare_inner_nodes(game);
    game->tick.stats = game->survey.stats;
    game->tick.tree_digest = game->survey.digest;
    return status;
}
