/* SPDX-License-Identifier: MIT */
// The library from C++: a game of the default session, and a lambda that visits points.
#include <octree/game.h>
#include <octree/octree.h>

#include <memory>
#include <vector>

int main()
{
    const octree_session session = octree_session_default();
    octree_game *made = nullptr;
    if (octree_game_create(&session, &made) != OCTREE_OK)
        return 1;
    const std::unique_ptr<octree_game, decltype(&octree_game_destroy)> game(made, octree_game_destroy);
    if (octree_game_step(game.get(), 'w') != OCTREE_OK)
        return 1;
    std::vector<uint64_t> found;
    const auto visit = [](const octree_point *point, void *context) {
        static_cast<std::vector<uint64_t> *>(context)->push_back(point->id);
        return true;
    };
    const octree *tree = octree_game_tree(game.get());
    const octree_box world = octree_definition(tree).world;
    if (octree_range(tree, &world, visit, &found) != OCTREE_OK)
        return 1;
    return found.size() == octree_count(tree) && found.size() > 1 ? 0 : 1;
}
