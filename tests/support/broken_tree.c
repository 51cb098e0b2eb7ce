/* SPDX-License-Identifier: MIT */
#include "broken_tree.h"

#include <string.h>

#include "fixture.h"

octree_address break_tree(const octree *tree, const double position[3], const double place[3])
{
    octree_node leaf;
    assert_int_equal(octree_locate(tree, position, &leaf), OCTREE_OK);
    assert_true(leaf.leaf && leaf.count > 0);
    octree_point *stored = (octree_point *)leaf.points; /* in memory that the tree writes too */
    size_t left = leaf.count;
    for (; left > 0 && !same_position(stored->position, position); left--)
        stored++;
    assert_true(left > 0);
    memcpy(stored->position, place, sizeof stored->position);
    return leaf.address;
}
