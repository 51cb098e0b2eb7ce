/* game_shapes.c - what a tick shows that is not the game's own. */
#include "game_state.h"

const char *octree_shape_name(octree_shape_kind kind)
{
    static const char *const names[OCTREE_SHAPE_KINDS] = {"box", "segment", "point", "label"};
    return (unsigned)kind < OCTREE_SHAPE_KINDS ? names[kind] : NULL;
}

static bool copy_shapes(octree_game *game, const octree_shape *shapes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        octree_shape *shape = list_append(&game->memory, &game->shapes, sizeof *shape);
        if (!shape)
            return false;
        *shape = shapes[i];
        shape->tick = game->tick.number;
    }
    return true;
}

octree_status game_show_shapes(octree_game *game, const octree_input *input)
{
    const octree_session *session = game->session;
    const size_t standing = session->shape_count - game->standing_shapes;
    game->shapes.count = 0;
    if (!copy_shapes(game, input->shapes, input->shape_count) ||
        (standing && !copy_shapes(game, session->shapes + game->standing_shapes, standing)))
        return OCTREE_NO_MEMORY;
    game->tick.shapes = game->shapes.items;
    game->tick.shape_count = game->shapes.count;
    return OCTREE_OK;
}
