/* game_check.c - what a session must be before it is played. */
#include "game_state.h"
#include "search.h"

#include <math.h>

static octree_status check_player(const octree_player *player, const octree *tree)
{
    if ((unsigned)player->kind > OCTREE_PLAYER_NONE)
        return OCTREE_BAD_OPTION;
    if (player->kind == OCTREE_PLAYER_NONE)
        return OCTREE_OK;
    if (player->kind == OCTREE_PLAYER_BODY)
        return !isfinite(player->box_size) ? OCTREE_NOT_FINITE : player->box_size < 0 ? OCTREE_BAD_SIZE : OCTREE_OK;
    if (!isfinite(player->step) || !isfinite(player->box_size))
        return OCTREE_NOT_FINITE;
    if (player->step < 0 || player->box_size < 0)
        return OCTREE_BAD_SIZE;
    return check_position(tree, player->position);
}

static octree_status check_keys(const octree_session *session)
{
    for (const char *key = session->keys; key && *key && *key != 'q'; key++)
        if (!game_is_key(*key))
            return OCTREE_BAD_KEY;
    return OCTREE_OK;
}

static bool is_edit(const octree_edit *edit)
{
    return (unsigned)edit->kind <= OCTREE_EDIT_MOVE;
}

static octree_status check_edits(const octree_session *session)
{
    for (size_t i = 0; i < session->edit_count; i++) {
        if (!is_edit(&session->edits[i]))
            return OCTREE_BAD_OPTION;
        if (session->edits[i].tick == 0 || (i > 0 && session->edits[i].tick < session->edits[i - 1].tick))
            return OCTREE_BAD_ORDER;
    }
    return OCTREE_OK;
}

static bool is_text(const char text[OCTREE_SHAPE_TEXT])
{
    size_t length = 0;
    while (length < OCTREE_SHAPE_TEXT && text[length] >= ' ' && text[length] <= '~')
        length++;
    return length < OCTREE_SHAPE_TEXT && text[length] == 0;
}

static octree_status check_shape(const octree_shape *shape)
{
    if ((unsigned)shape->kind >= OCTREE_SHAPE_KINDS)
        return OCTREE_BAD_OPTION;
    const bool extends = shape->kind == OCTREE_SHAPE_BOX || shape->kind == OCTREE_SHAPE_SEGMENT;
    octree_status status = check_finite(shape->at);
    if (status == OCTREE_OK && extends)
        status = check_finite(shape->to);
    for (int i = 0; status == OCTREE_OK && shape->kind == OCTREE_SHAPE_BOX && i < 3; i++)
        if (shape->at[i] > shape->to[i])
            status = OCTREE_BAD_RANGE;
    if (status == OCTREE_OK && shape->kind == OCTREE_SHAPE_LABEL && !is_text(shape->text))
        status = OCTREE_BAD_TEXT;
    return status;
}

static octree_status check_shapes(const octree_session *session)
{
    octree_status status = OCTREE_OK;
    for (size_t i = 0; status == OCTREE_OK && i < session->shape_count; i++) {
        status = check_shape(&session->shapes[i]);
        if (i > 0 && session->shapes[i].tick < session->shapes[i - 1].tick)
            status = OCTREE_BAD_ORDER;
    }
    return status;
}

static octree_status check_queries(const octree_session *session)
{
    octree_status status = OCTREE_OK;
    for (size_t i = 0; status == OCTREE_OK && i < session->query_count; i++) {
        status = octree_query_check(&session->queries[i]);
        if (i > 0 && session->queries[i].tick < session->queries[i - 1].tick)
            status = OCTREE_BAD_ORDER;
    }
    return status;
}

octree_status octree_input_check(const octree_input *input)
{
    if (!input || (!input->edits && input->edit_count) || (!input->queries && input->query_count) ||
        (!input->shapes && input->shape_count))
        return OCTREE_NULL_ARGUMENT;
    octree_status status = OCTREE_OK;
    for (size_t i = 0; i < input->edit_count; i++)
        if (!is_edit(&input->edits[i]))
            return OCTREE_BAD_OPTION;
    for (size_t i = 0; status == OCTREE_OK && i < input->query_count; i++)
        status = octree_query_check(&input->queries[i]);
    for (size_t i = 0; status == OCTREE_OK && i < input->shape_count; i++)
        status = check_shape(&input->shapes[i]);
    return status;
}

octree_status game_check_session(const octree_session *session, const octree *tree)
{
    octree_status status = check_player(&session->player, tree);
    if (status == OCTREE_OK)
        status = check_keys(session);
    if (status == OCTREE_OK)
        status = check_edits(session);
    if (status == OCTREE_OK)
        status = check_queries(session);
    if (status == OCTREE_OK)
        status = check_shapes(session);
    return status;
}
