/* SPDX-License-Identifier: MIT */
#include "game_fixture.h"

#include "fixture.h"

octree_session small_session(const octree_game_body *bodies, size_t body_count)
{
    octree_session session = {.tree = define(cube(-10, 10), 2, 5, OCTREE_REFUSE)};
    session.player = (octree_player){.id = 100, .step = 1, .box_size = 0.5};
    session.bodies = bodies;
    session.body_count = body_count;
    return session;
}

octree_game *start_game(const octree_session *session)
{
    octree_game *game = NULL;
    assert_int_equal(octree_game_create(session, &game), OCTREE_OK);
    assert_non_null(game);
    return game;
}

const octree_tick *play_key(octree_game *game, char key)
{
    assert_int_equal(octree_game_step(game, key), OCTREE_OK);
    assert_valid(octree_game_tree(game));
    return octree_game_tick(game);
}
