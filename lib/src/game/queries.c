/* queries.c - what can be asked of a tree: the table of kinds, checking, asking, and the queries of a tick.
 */
#include "game_state.h"
#include "search.h"

#include <math.h>
#include <string.h>

const octree_query_traits *octree_query_about(octree_query_kind kind)
{
#define TRAITS(kind, name, members, named_by, neighbors, words) {#name, members, named_by, neighbors, words},
    static const octree_query_traits table[] = {OCTREE_QUERY_MAP(TRAITS)};
#undef TRAITS
    return (unsigned)kind < OCTREE_QUERY_KINDS ? &table[kind] : NULL;
}

const char *octree_query_name(octree_query_kind kind)
{
    const octree_query_traits *about = octree_query_about(kind);
    return about ? about->name : NULL;
}

octree_status octree_query_check(const octree_query *query)
{
    if (!query)
        return OCTREE_NULL_ARGUMENT;
    const octree_query_traits *about = octree_query_about(query->kind);
    if (!about)
        return OCTREE_BAD_OPTION;
    octree_status status = OCTREE_OK;
    if (about->members & OCTREE_QUERY_HAS_RADIUS)
        status = !isfinite(query->radius) ? OCTREE_NOT_FINITE : query->radius < 0 ? OCTREE_BAD_SIZE : OCTREE_OK;
    if (status == OCTREE_OK && about->members & OCTREE_QUERY_HAS_BOX)
        status = check_box(&query->box);
    if (status == OCTREE_OK && about->members & OCTREE_QUERY_HAS_TARGET && !query->at_player)
        status = check_finite(query->target);
    return status;
}

/* ---- Asking ------------------------------------------------------------------------------------------------- */

/* A tree that is asked, and the lists that what it finds is appended to. */
typedef struct asking {
    const octree *tree;
    octree_search how;
    point_collector points;
    list *neighbors;
} asking;

static octree_status ask_range(asking *a, octree_answer *answer)
{
    return octree_range_search(a->tree, &answer->box, &a->how, collect_point, &a->points);
}

static octree_status ask_radius(asking *a, octree_answer *answer)
{
    return octree_radius(a->tree, answer->target, answer->radius, &a->how, collect_point, &a->points);
}

static octree_status ask_knearest(asking *a, octree_answer *answer)
{
    const size_t first = a->neighbors->count, all = octree_count(a->tree);
    const size_t k = answer->k < all ? answer->k : all;
    while (a->neighbors->count < first + k)
        if (!list_append(a->points.memory, a->neighbors, sizeof(octree_neighbor)))
            return OCTREE_NO_MEMORY;
    octree_neighbor *neighbors = k ? (octree_neighbor *)a->neighbors->items + first : NULL;
    size_t found;
    const octree_status status = octree_nearest_k(a->tree, answer->target, k, &a->how, neighbors, &found);
    a->neighbors->count = first + found;
    return status;
}

static octree_status ask_nearest(asking *a, octree_answer *answer)
{
    answer->k = 1;
    return ask_knearest(a, answer);
}

/* What is asked, in world coordinates. */
static octree_answer pose(const octree_query *query, const double player[3])
{
    octree_answer answer = {.kind = query->kind, .box = query->box, .k = query->k, .radius = query->radius};
    memcpy(answer.target, query->at_player ? player : query->target, sizeof answer.target);
    for (int i = 0; query->at_player && i < 3; i++) {
        answer.box.min[i] += player[i];
        answer.box.max[i] += player[i];
    }
    return answer;
}

/* The answer says how many were appended to which list; its pointers are still null. */
static octree_status ask(asking *a, const octree_query *query, const double player[3], octree_answer *answer)
{
#define ASK(kind, name, members, named_by, neighbors, words) ask_##name,
    static octree_status (*const functions[])(asking *, octree_answer *) = {OCTREE_QUERY_MAP(ASK)};
#undef ASK
    const bool neighbors = octree_query_about(query->kind)->neighbors;
    const list *found = neighbors ? a->neighbors : a->points.points;
    const size_t first = found->count;
    *answer = pose(query, player);
    a->how.cost = &answer->cost;
    octree_status status = functions[query->kind](a, answer);
    if (a->points.failed)
        status = OCTREE_NO_MEMORY;
    answer->count = found->count - first;
    if (status == OCTREE_OK && !neighbors && answer->count)
        game_sort_points((octree_point *)found->items + first, answer->count);
    return status;
}

/* ---- Outside of a game -------------------------------------------------------------------------------------- */

/* The items of a list in a block of just their size; null for none, and when there is no memory. */
static void *take_items(arena *memory, list *l, size_t item_size)
{
    void *items = l->count ? arena_take(memory, l->count * item_size) : NULL;
    if (items)
        memcpy(items, l->items, l->count * item_size);
    list_release(memory, l, item_size);
    return items;
}

octree_status octree_query_answer(const octree *tree, const octree_query *query, const double player[3],
                                  const octree_search *how, octree_answer *answer)
{
    if (!answer)
        return OCTREE_NULL_ARGUMENT;
    *answer = (octree_answer){0};
    octree_status status = tree ? octree_query_check(query) : OCTREE_NULL_ARGUMENT;
    if (status == OCTREE_OK && query->at_player && !player)
        status = OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return status;
    arena memory = {.allocator = tree->def.allocator};
    list points = {0}, neighbors = {0};
    asking a = {tree, search_or_default(how), {&memory, &points, false}, &neighbors};
    octree_answer made;
    status = ask(&a, query, player, &made);
    made.points = take_items(&memory, &points, sizeof(octree_point));
    made.neighbors = take_items(&memory, &neighbors, sizeof(octree_neighbor));
    if (status == OCTREE_OK && made.count && !made.points && !made.neighbors)
        status = OCTREE_NO_MEMORY;
    if (status == OCTREE_OK)
        *answer = made;
    else
        octree_answer_release(tree, &made);
    return status;
}

void octree_answer_release(const octree *tree, octree_answer *answer)
{
    if (!tree || !answer)
        return;
    arena memory = {.allocator = tree->def.allocator};
    arena_give(&memory, (void *)answer->points, answer->count * sizeof *answer->points);
    arena_give(&memory, (void *)answer->neighbors, answer->count * sizeof *answer->neighbors);
    *answer = (octree_answer){0};
}

/* ---- The queries of a tick ---------------------------------------------------------------------------------- */

static octree_status ask_in_game(octree_game *game, const octree_query *query, bool by_key)
{
    if (query->at_player && !game->tick.has_player)
        return OCTREE_OK;
    octree_answer *answer = list_append(&game->memory, &game->answers, sizeof *answer);
    if (!answer)
        return OCTREE_NO_MEMORY;
    asking a = {game->tree, game_search(game, NULL), {&game->memory, &game->found, false}, &game->near};
    a.how.skip = query->at_player ? OCTREE_SKIP_ID : OCTREE_SKIP_NONE;
    a.how.skip_id = game->session->player.id;
    const octree_status status = ask(&a, query, game->tick.player, answer);
    answer->by_key = by_key;
    game->tick.asked |= 1u << query->kind;
    return status;
}

octree_status game_ask(octree_game *game, const octree_input *input)
{
    const octree_session *session = game->session;
    octree_status status = OCTREE_OK;
    if (game->tick.key == 'n')
        status = ask_in_game(game, &(octree_query){.kind = OCTREE_QUERY_NEAREST, .at_player = true}, true);
    for (size_t i = 0; status == OCTREE_OK && i < input->query_count; i++)
        status = ask_in_game(game, &input->queries[i], false);
    for (size_t i = game->standing; status == OCTREE_OK && i < session->query_count; i++)
        status = ask_in_game(game, &session->queries[i], false);
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
        if (octree_query_about(answer->kind)->neighbors) {
            answer->neighbors = (const octree_neighbor *)game->near.items + neighbors;
            neighbors += answer->count;
        } else {
            answer->points = (const octree_point *)game->found.items + points;
            points += answer->count;
        }
    }
    game->tick.answers = answers;
    game->tick.answer_count = game->answers.count;
}
