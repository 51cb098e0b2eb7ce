/* SPDX-License-Identifier: MIT */
#include "paper_game.h"

#include <string.h>

#include "fixture.h"

/* The points in the player's box but for itself, which is in the tree. */
static size_t count_hits(const paper_game *game)
{
    double min[3], max[3];
    for (int axis = 0; axis < 3; axis++) {
        min[axis] = game->player.position[axis] - game->session->player.box_size;
        max[axis] = game->player.position[axis] + game->session->player.box_size;
    }
    size_t count = 0;
    brute near = {0};
    rangeQuery(game->octree.root, min, max, &count, &near);
    brute_free(&near);
    return count - 1;
}

/* The collision test and the nearest neighbour where the player stands. Algorithm 5 inserts the moving point itself,
 * so the player's own point is taken out for the test; its place in the leaf is then free, and the test cannot fail. */
static bool collides(const paper_game *game)
{
    assert_true(deletePoint(&game->octree, game->octree.root, &game->player));
    bool collided = detect_collision(&game->octree, &game->player, game->session->player.box_size);
    assert_true(insertPoint(&game->octree, game->octree.root, &game->player));
    return collided;
}

static void look(paper_game *game)
{
    game->found = findNearestNeighbor(&game->octree, game->player.position, &game->nearest, &game->distance);
}

size_t paper_game_start(paper_game *game, const octree_session *session)
{
    const octree_def *tree = &session->tree;
    *game = (paper_game){.octree = createOctree(tree->world, tree->leaf_capacity, tree->max_depth)};
    game->session = session;
    game->player.id = session->player.id;
    memcpy(game->player.position, session->player.position, sizeof game->player.position);
    assert_true(insertPoint(&game->octree, game->octree.root, &game->player));
    size_t refused = 0;
    for (size_t i = 0; i < session->body_count; i++) {
        octree_point point = {.id = session->bodies[i].id};
        memcpy(point.position, session->bodies[i].position, sizeof point.position);
        if (!insertPoint(&game->octree, game->octree.root, &point))
            refused++;
    }
    game->collided = collides(game);
    game->hits = count_hits(game);
    look(game);
    return refused;
}

/* The axis of a key and its direction; 0 for a key that does not move. */
static int direction_of(char key, int *axis)
{
    static const char up[] = "dwe";
    static const char down[] = "asf";
    for (*axis = 0; *axis < 3; ++*axis) {
        if (key == up[*axis])
            return 1;
        if (key == down[*axis])
            return -1;
    }
    return 0;
}

static void place(paper_game *game, int axis, int64_t steps)
{
    const octree_player *player = &game->session->player;
    game->steps[axis] = steps;
    game->player.position[axis] = player->position[axis] + (double)steps * player->step;
}

/* Put the player's point at its new position, or, when the leaf there is full, leave it where it was. The paper
 * ignores what insertPoint says here, and its collision test is then wrong; see detect_collision. */
static bool arrive(paper_game *game, const octree_point *from)
{
    assert_true(deletePoint(&game->octree, game->octree.root, from));
    if (insertPoint(&game->octree, game->octree.root, &game->player))
        return true;
    assert_true(insertPoint(&game->octree, game->octree.root, from));
    return false;
}

static void step(paper_game *game, int axis, int direction)
{
    octree_point from = game->player;
    int64_t steps = game->steps[axis];
    place(game, axis, steps + direction);
    if (!box_holds(&game->session->tree.world, game->player.position)) {
        game->refused = true;
        place(game, axis, steps);
        return;
    }
    game->full = !arrive(game, &from);
    if (game->full) {
        place(game, axis, steps);
        return;
    }
    game->collided = collides(game);
    game->hits = count_hits(game);
    game->moved = !game->collided;
    if (game->collided) {
        octree_point attempt = game->player;
        place(game, axis, steps);
        assert_true(deletePoint(&game->octree, game->octree.root, &attempt));
        assert_true(insertPoint(&game->octree, game->octree.root, &game->player));
    }
}

void paper_game_play_key(paper_game *game, char key)
{
    int axis;
    int direction = direction_of(key, &axis);
    game->moved = game->refused = game->full = game->collided = false;
    if (direction != 0)
        step(game, axis, direction);
    if (direction == 0 || game->refused) {
        game->collided = collides(game);
        game->hits = count_hits(game);
    }
    look(game);
}

void paper_game_end(paper_game *game)
{
    freeOctree(&game->octree);
}
