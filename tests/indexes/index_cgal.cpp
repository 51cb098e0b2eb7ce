/* SPDX-License-Identifier: MIT */
// index_cgal.cpp - the k-d tree of CGAL's package Spatial Searching, with the kernel Simple_cartesian<double>.
#include "index.hpp"

#include <CGAL/Fuzzy_iso_box.h>
#include <CGAL/Fuzzy_sphere.h>
#include <CGAL/Kd_tree.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>
#include <CGAL/version.h>

#include <vector>

namespace
{

using kernel = CGAL::Simple_cartesian<double>;
using place = kernel::Point_3;
using entry = std::pair<place, uint64_t>;
using traits =
    CGAL::Search_traits_adapter<entry, CGAL::First_of_pair_property_map<entry>, CGAL::Search_traits_3<kernel>>;
using near_search = CGAL::Orthogonal_k_neighbor_search<traits>;
using tree_type = near_search::Tree;

struct kd_tree : index_base {
    tree_type tree;

    static std::vector<entry> list_entries(const octree_point *points, size_t count)
    {
        std::vector<entry> all;
        for (size_t i = 0; i < count; i++)
            all.emplace_back(place(points[i].position[0], points[i].position[1], points[i].position[2]), points[i].id);
        return all;
    }

    kd_tree(const octree_point *points, size_t count, size_t capacity)
        : tree(near_search::Splitter(capacity ? unsigned(capacity) : 10))
    {
        const std::vector<entry> all = list_entries(points, count);
        tree.insert(all.begin(), all.end());
        tree.build();
    }

    size_t nearest(const double at[3], size_t k, double epsilon, uint64_t *ids) const
    {
        const near_search search(tree, place(at[0], at[1], at[2]), unsigned(k), epsilon);
        size_t count = 0;
        for (const auto &found : search)
            ids[count++] = found.first.second;
        return count;
    }

    void ball(const double center[3], double radius, id_list &ids) const
    {
        const place at(center[0], center[1], center[2]);
        tree.search(id_output<entry, &entry::second>{&ids}, CGAL::Fuzzy_sphere<traits>(at, radius, 0, tree.traits()));
    }

    void box(const octree_box &b, id_list &ids) const
    {
        const place low(b.min[0], b.min[1], b.min[2]), high(b.max[0], b.max[1], b.max[2]);
        tree.search(id_output<entry, &entry::second>{&ids}, CGAL::Fuzzy_iso_box<traits>(low, high, 0, tree.traits()));
    }
};

} // namespace

const spatial_index index_cgal = index_of<kd_tree>::describe("cgal", CGAL_VERSION_STR, OCTREE_DOUBLES,
                                                             INDEX_NEIGHBORS | INDEX_BALL | INDEX_BOX, true);
