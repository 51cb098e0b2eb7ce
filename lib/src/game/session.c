/* SPDX-License-Identifier: MIT */
/* session.c - checks a session, finds the session's input for a tick, and loads the session's bodies. Also defines the
 * paper's session. */
#include "session.h"
#include "../exact/float_mode.h"
#include "game_state.h"
#include "../query/search.h"

#include <math.h>
#include <string.h>

uint64_t octree_session_length(const octree_session *session)
{
    if (!session)
        return 0;
    const size_t keys = session->keys ? strcspn(session->keys, "q") : 0;
    const bool quits = session->keys && session->keys[keys] == 'q';
    const uint64_t length = quits || keys > session->ticks ? keys : session->ticks;
    return session->unplayed < length ? length - session->unplayed : 0;
}

/* ---- Checks ------------------------------------------------------------------------------------------------- */

static octree_status check_player(const octree_player *player, const octree *tree)
{
    if ((unsigned)player->kind > OCTREE_PLAYER_NONE)
        return OCTREE_BAD_OPTION;
    if (player->kind == OCTREE_PLAYER_NONE)
        return OCTREE_OK;
    octree_status status = check_length(player->box_size);
    if (status == OCTREE_OK && player->kind == OCTREE_PLAYER_KEYS)
        status = check_length(player->step);
    if (status == OCTREE_OK && player->kind == OCTREE_PLAYER_KEYS)
        status = check_position(tree, player->position);
    return status;
}

bool is_game_key(char key)
{
    return key && strchr("dweasfn.", key);
}

static octree_status check_keys(const char *keys)
{
    for (const char *key = keys; key && *key && *key != 'q'; key++)
        if (!is_game_key(*key))
            return OCTREE_BAD_KEY;
    return OCTREE_OK;
}

static octree_status check_shape(const octree_shape *shape)
{
    if ((unsigned)shape->kind >= OCTREE_SHAPE_KINDS)
        return OCTREE_BAD_OPTION;
    const bool extends = shape->kind == OCTREE_SHAPE_BOX || shape->kind == OCTREE_SHAPE_SEGMENT;
    octree_status status = check_finite_position(shape->at);
    if (status == OCTREE_OK && extends)
        status = check_finite_position(shape->to);
    for (int i = 0; status == OCTREE_OK && shape->kind == OCTREE_SHAPE_BOX && i < 3; i++)
        if (shape->at[i] > shape->to[i])
            status = OCTREE_BAD_RANGE;
    if (status == OCTREE_OK && shape->kind == OCTREE_SHAPE_LABEL && !is_printable_text(shape->text, sizeof shape->text))
        status = OCTREE_BAD_TEXT;
    return status;
}

static octree_status check_gap(const octree_gap *gap)
{
    return *gap->why && is_printable_text(gap->why, sizeof gap->why) ? OCTREE_OK : OCTREE_BAD_TEXT;
}

static octree_status check_foreign_pairs(const octree_foreign_pairs *given)
{
    if (!given->pairs && given->pair_count)
        return OCTREE_NULL_ARGUMENT;
    for (size_t i = 0; i < given->pair_count; i++)
        if (given->pairs[i].a == given->pairs[i].b)
            return OCTREE_BAD_PAIR;
    return OCTREE_OK;
}

octree_status octree_input_check(const octree_input *input)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_input_check, input);
    if (!input || (!input->edits && input->edit_count) || (!input->queries && input->query_count) ||
        (!input->shapes && input->shape_count))
        return OCTREE_NULL_ARGUMENT;
    octree_status status = OCTREE_OK;
    for (size_t i = 0; i < input->edit_count; i++)
        if ((unsigned)input->edits[i].kind > OCTREE_EDIT_MOVE)
            return OCTREE_BAD_OPTION;
    for (size_t i = 0; status == OCTREE_OK && i < input->query_count; i++)
        status = octree_query_check(&input->queries[i]);
    for (size_t i = 0; status == OCTREE_OK && i < input->shape_count; i++)
        status = check_shape(&input->shapes[i]);
    if (status == OCTREE_OK && input->foreign)
        status = octree_foreign_check(input->foreign, NULL);
    if (status == OCTREE_OK && input->foreign_pairs)
        status = check_foreign_pairs(input->foreign_pairs);
    return status == OCTREE_OK && input->gap ? check_gap(input->gap) : status;
}

/* Check that an array of items is in ascending order of ticks; each item begins with its tick. If `distinct` is true,
 * no two ticks may be equal. */
static octree_status check_tick_order(const void *items, size_t size, size_t count, bool distinct)
{
    if (!items && count)
        return OCTREE_NULL_ARGUMENT;
    const char *item = items;
    for (size_t i = 1; i < count; i++, item += size) {
        const int order = compare_first_words(item, item + size);
        if (order > 0 || (order == 0 && distinct))
            return OCTREE_BAD_ORDER;
    }
    return OCTREE_OK;
}

octree_status game_check_session(const octree_session *s, const octree *tree)
{
    const octree_input changes = {.edits = s->edits,
                                  .edit_count = s->edit_count,
                                  .queries = s->queries,
                                  .query_count = s->query_count,
                                  .shapes = s->shapes,
                                  .shape_count = s->shape_count};
    octree_status status = check_player(&s->player, tree);
    if (status == OCTREE_OK)
        status = check_keys(s->keys);
    if (status == OCTREE_OK)
        status = octree_input_check(&changes);
    if (status == OCTREE_OK && s->edit_count && s->edits[0].tick == 0)
        status = OCTREE_BAD_ORDER;
    if (status == OCTREE_OK)
        status = check_tick_order(s->edits, sizeof *s->edits, s->edit_count, false);
    if (status == OCTREE_OK)
        status = check_tick_order(s->queries, sizeof *s->queries, s->query_count, false);
    if (status == OCTREE_OK)
        status = check_tick_order(s->shapes, sizeof *s->shapes, s->shape_count, false);
    if (status == OCTREE_OK)
        status = check_tick_order(s->gaps, sizeof *s->gaps, s->gap_count, true);
    for (size_t i = 0; status == OCTREE_OK && i < s->gap_count; i++)
        status = check_gap(&s->gaps[i]);
    if (status == OCTREE_OK)
        status = check_tick_order(s->foreign, sizeof *s->foreign, s->foreign_count, true);
    for (size_t i = 0; status == OCTREE_OK && i < s->foreign_count; i++)
        status = octree_foreign_check(&s->foreign[i], NULL);
    if (status == OCTREE_OK)
        status = check_tick_order(s->foreign_pairs, sizeof *s->foreign_pairs, s->foreign_pairs_count, true);
    for (size_t i = 0; status == OCTREE_OK && i < s->foreign_pairs_count; i++)
        status = check_foreign_pairs(&s->foreign_pairs[i]);
    return status;
}

/* ---- The input of a tick ------------------------------------------------------------------------------------ */

/* Returns the items that belong to a tick, and stores their number in *found. Returns null if the tick has no items. */
static const void *find_items_of_tick(const void *items, size_t size, size_t count, uint64_t tick, size_t *found)
{
    const size_t first = find_item_by_first_word(items, size, count, tick);
    *found = (tick < OCTREE_EVERY_TICK ? find_item_by_first_word(items, size, count, tick + 1) : count) - first;
    return *found ? (const char *)items + first * size : NULL;
}

const octree_gap *octree_session_gap(const octree_session *session, uint64_t tick)
{
    size_t found;
    return session ? find_items_of_tick(session->gaps, sizeof *session->gaps, session->gap_count, tick, &found) : NULL;
}

octree_input session_input(const octree_session *s, uint64_t tick)
{
    octree_input input = {.gap = octree_session_gap(s, tick)};
    size_t found;
    input.edits = find_items_of_tick(s->edits, sizeof *s->edits, s->edit_count, tick, &input.edit_count);
    input.queries = find_items_of_tick(s->queries, sizeof *s->queries, s->query_count, tick, &input.query_count);
    input.shapes = find_items_of_tick(s->shapes, sizeof *s->shapes, s->shape_count, tick, &input.shape_count);
    input.foreign = find_items_of_tick(s->foreign, sizeof *s->foreign, s->foreign_count, tick, &found);
    input.foreign_pairs =
        find_items_of_tick(s->foreign_pairs, sizeof *s->foreign_pairs, s->foreign_pairs_count, tick, &found);
    return input;
}

/* ---- Loading ------------------------------------------------------------------------------------------------ */

/* Store in points[] the points of all bodies that the game does not refuse. Returns the number of points. Also sets
 * game->fastest. */
static size_t collect_valid_bodies(octree_game *game, octree_point *points)
{
    size_t count = 0;
    for (size_t i = 0; i < game->session->body_count; i++) {
        const octree_game_body *body = &game->session->bodies[i];
        if (check_numbers_of_body(body) != OCTREE_OK)
            continue;
        for (int axis = 0; axis < 3; axis++)
            game->fastest = larger(game->fastest, fabs(body->velocity[axis]));
        points[count].id = body->id;
        memcpy(points[count++].position, body->position, sizeof points->position);
    }
    return count;
}

/* Add the bodies to the game. `statuses` are the results of inserting the points of the bodies into the tree. If an id
 * is a duplicate, the tree may already hold the point of the second body; this does no harm, because
 * octree_game_create() then fails. */
static octree_status add_bodies(octree_game *game, const octree_status *statuses)
{
    for (size_t i = 0; i < game->session->body_count; i++) {
        const octree_game_body *body = &game->session->bodies[i];
        octree_status status = game_check_body(game, body);
        if (status == OCTREE_OK)
            status = *statuses;
        statuses += check_numbers_of_body(body) == OCTREE_OK;
        if (status == OCTREE_DUPLICATE)
            return status;
        if (!game_add_body(game, body, status))
            return OCTREE_NO_MEMORY;
    }
    return OCTREE_OK;
}

octree_status game_load_bodies(octree_game *game)
{
    const size_t room = game->session->body_count;
    if (room == 0 || room > SIZE_MAX / sizeof(octree_point))
        return room ? OCTREE_NO_MEMORY : OCTREE_OK;
    octree_point *points = arena_allocate(&game->memory, room * sizeof *points);
    octree_status *statuses = arena_allocate(&game->memory, room * sizeof *statuses);
    octree_status status = OCTREE_NO_MEMORY;
    if (points && statuses)
        status = octree_insert_many(game->tree, points, collect_valid_bodies(game, points), statuses, NULL);
    if (status == OCTREE_OK)
        status = add_bodies(game, statuses);
    arena_free(&game->memory, points, room * sizeof *points);
    arena_free(&game->memory, statuses, room * sizeof *statuses);
    return status;
}

/* ---- The paper's session ------------------------------------------------------------------------------------ */

/* The bodies of the example in the paper. The id of a body is its number in the paper's list. The sixth point of that
 * list, (0, 0, 0), is the player. Three points share one cell of depth 5, so tick 0 refuses one of these points. */
static const octree_game_body paper_bodies[] = {
    {.id = 1, .position = {-50, -50, 100}},    {.id = 2, .position = {900, -900, -900}},
    {.id = 3, .position = {900, 900, 900}},    {.id = 4, .position = {-100, -100, 100}},
    {.id = 5, .position = {-1, 2, 3}},         {.id = 7, .position = {750, 750, 750}},
    {.id = 8, .position = {800, 800, 800}},    {.id = 9, .position = {500, 500, 500}},
    {.id = 10, .position = {750, 750, 800}},   {.id = 11, .position = {975, 975, 1000}},
    {.id = 12, .position = {1000, 1000, 975}},
};

static const char paper_keys[] =
    "n.eeasnassdn." /* the player has three collisions near the origin */
    /* The player moves down to the lowest corner of the world. */
    "asfasfasfasfasfasfasfasfasfasfasfasfasfasfasfasfasfasf"
    /* The player moves against the three faces at the lowest corner. */
    "sffffnasf."
    /* The player moves to point 2, then against the face x = 1000. */
    "ddweddwedddddddddddddddddddddddddddddddddnddwddddn"
    "ewaewaewaewaewaewaewaewaewaewa" /* the player moves up to point 9 */
    "ewewewewewewewewewewewewewewewwwneee.n"
    "dwedwedwedweddewn.en"   /* the player moves into the cell whose leaf is full */
    "dwendweenaweeeen"       /* the player moves against the face z = 1000 */
    "wddnwaawwdnwfaffssn.."; /* the player moves to point 11, then against the face y = 1000 */

#define CORNER(at)                                                                                                     \
    {                                                                                                                  \
        .tick = at, .kind = OCTREE_QUERY_RANGE, .box = { {700, 700, 700}, {1000, 1000, 1000} }                         \
    }

/* Range queries around the full cell in the corner, at the ticks at which the player is there. */
static const octree_query paper_queries[] = {
    CORNER(212), CORNER(213), CORNER(214), CORNER(215), CORNER(216), CORNER(217),
    CORNER(218), CORNER(219), CORNER(220), CORNER(221), CORNER(222), CORNER(223),
};

octree_session octree_session_default(void)
{
    octree_session session = {
        .tree = octree_def_default(),
        .player = {.id = 6, .position = {0, 0, 0}, .step = 50, .box_size = 30},
        .bodies = paper_bodies,
        .body_count = sizeof paper_bodies / sizeof paper_bodies[0],
        .keys = paper_keys,
        .queries = paper_queries,
        .query_count = sizeof paper_queries / sizeof paper_queries[0],
    };
    session.tree.leaf_capacity = 2;
    session.tree.max_depth = 5;
    /* The paper refuses a point that meets a full leaf; octree_def_default() keeps every point. */
    session.tree.full_leaf = OCTREE_REFUSE;
    return session;
}
