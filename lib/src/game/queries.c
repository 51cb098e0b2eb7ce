/* game_queries.c - the queries of a tick and their answers. */
#include "game_parts.h"

#include <string.h>

const char *octree_query_name(octree_query_kind kind)
{
    static const char *const names[OCTREE_QUERY_KINDS] = {"range", "nearest", "knearest", "radius"};
    return (unsigned)kind < OCTREE_QUERY_KINDS ? names[kind] : NULL;
}

/* The answers of boxes and balls are points, those of the others neighbours. */
static bool finds_points(octree_query_kind kind)
{
    return kind == OCTREE_QUERY_RANGE || kind == OCTREE_QUERY_RADIUS;
}

/* Begin with what is asked, in world coordinates. */
static octree_answer pose(const octree_query *query, const double player[3])
{
    octree_answer answer = {.kind = query->kind, .box = query->box, .k = query->k, .radius = query->radius};
    if (query->kind == OCTREE_QUERY_NEAREST)
        answer.k = 1;
    memcpy(answer.target, query->at_player ? player : query->target, sizeof answer.target);
    for (int i = 0; query->at_player && i < 3; i++) {
        answer.box.min[i] += player[i];
        answer.box.max[i] += player[i];
    }
    return answer;
}

/* The points in a box or a ball. */
static octree_status find_points(octree_game *game, octree_answer *answer)
{
    const size_t before = game->found.count;
    const octree_search how = game_search(game, &answer->cost);
    point_collector found = {&game->memory, &game->found, false};
    const octree_status status =
        answer->kind == OCTREE_QUERY_RANGE
            ? octree_range_search(game->tree, &answer->box, &how, collect_point, &found)
            : octree_radius(game->tree, answer->target, answer->radius, &how, collect_point, &found);
    answer->count = game->found.count - before;
    if (status != OCTREE_OK || found.failed)
        return found.failed ? OCTREE_NO_MEMORY : status;
    if (answer->count)
        game_sort_points((octree_point *)game->found.items + before, answer->count);
    return OCTREE_OK;
}

static octree_status find_neighbors(octree_game *game, octree_answer *answer, bool at_player)
{
    octree_search how = game_search(game, &answer->cost);
    how.skip = at_player ? OCTREE_SKIP_ID : OCTREE_SKIP_NONE;
    how.skip_id = game->session->player.id;
    const size_t before = game->near.count, all = octree_count(game->tree);
    const size_t k = answer->k < all ? answer->k : all;
    while (game->near.count < before + k)
        if (!list_append(&game->memory, &game->near, sizeof(octree_neighbor)))
            return OCTREE_NO_MEMORY;
    octree_neighbor *neighbors = k ? (octree_neighbor *)game->near.items + before : NULL;
    const octree_status status = octree_nearest_k(game->tree, answer->target, k, &how, neighbors, &answer->count);
    game->near.count = before + answer->count;
    return status;
}

static octree_status ask(octree_game *game, const octree_query *query, bool by_key)
{
    if (query->at_player && !game->tick.has_player)
        return OCTREE_OK;
    octree_answer *answer = list_append(&game->memory, &game->answers, sizeof *answer);
    if (!answer)
        return OCTREE_NO_MEMORY;
    *answer = pose(query, game->tick.player);
    answer->by_key = by_key;
    game->tick.asked |= 1u << query->kind;
    if (finds_points(answer->kind))
        return find_points(game, answer);
    return find_neighbors(game, answer, query->at_player);
}

octree_status game_ask(octree_game *game, const octree_input *input)
{
    const octree_session *session = game->session;
    octree_status status = OCTREE_OK;
    if (game->tick.key == 'n')
        status = ask(game, &(octree_query){.kind = OCTREE_QUERY_NEAREST, .at_player = true}, true);
    for (size_t i = 0; status == OCTREE_OK && i < input->query_count; i++)
        status = ask(game, &input->queries[i], false);
    for (size_t i = game->standing; status == OCTREE_OK && i < session->query_count; i++)
        status = ask(game, &session->queries[i], false);
    return status;
}

void game_publish_answers(octree_game *game)
{
    octree_answer *answers = game->answers.items;
    size_t points = 0, neighbors = 0;
    for (size_t i = 0; i < game->answers.count; i++) {
        octree_answer *answer = &answers[i];
        if (answer->count == 0)
            continue;
        if (finds_points(answer->kind)) {
            answer->points = (const octree_point *)game->found.items + points;
            points += answer->count;
        } else {
            answer->neighbors = (const octree_neighbor *)game->near.items + neighbors;
            neighbors += answer->count;
        }
    }
    game->tick.answers = answers;
    game->tick.answer_count = game->answers.count;
}
