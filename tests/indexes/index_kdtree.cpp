/* SPDX-License-Identifier: MIT */
// index_kdtree.cpp - libkdtree++, balanced after the points were inserted. It finds one neighbour and boxes.
#include "index.hpp"

#include <kdtree++/kdtree.hpp>

namespace
{

struct entry {
    using value_type = double;
    double at[3];
    uint64_t id;

    double operator[](size_t axis) const
    {
        return at[axis];
    }
};

struct kd_tree : index_base {
    using tree_type = KDTree::KDTree<3, entry>;
    tree_type tree;

    kd_tree(const octree_point *points, size_t count, size_t)
    {
        for (size_t i = 0; i < count; i++)
            tree.insert({{points[i].position[0], points[i].position[1], points[i].position[2]}, points[i].id});
        tree.optimise();
    }

    size_t nearest(const double at[3], size_t, double, uint64_t *ids) const
    {
        const auto found = tree.find_nearest(entry{{at[0], at[1], at[2]}, 0});
        if (found.first == tree.end())
            return 0;
        ids[0] = found.first->id;
        return 1;
    }

    void box(const octree_box &b, id_list &ids) const
    {
        tree_type::_Region_ searched;
        for (size_t i = 0; i < 3; i++) {
            searched._M_low_bounds[i] = b.min[i];
            searched._M_high_bounds[i] = b.max[i];
        }
        tree.find_within_range(searched, id_output<entry, &entry::id>{&ids});
    }
};

} // namespace

const spatial_index index_kdtree =
    index_of<kd_tree>::describe("libkdtree++", "0.7.1", OCTREE_DOUBLES, INDEX_NEAREST | INDEX_BOX, false);
