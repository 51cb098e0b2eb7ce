/* SPDX-License-Identifier: MIT */
// index_boost.cpp - the R-tree of Boost.Geometry, packed. It has no epsilon and no ball.
#include "index.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/version.hpp>

#include <vector>

namespace
{

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using place = bg::model::point<double, 3, bg::cs::cartesian>;
using entry = std::pair<place, uint64_t>;
using tree_type = bgi::rtree<entry, bgi::dynamic_rstar>;

place to_place(const double at[3])
{
    return {at[0], at[1], at[2]};
}

struct r_tree : index_base {
    tree_type tree;

    static std::vector<entry> list_entries(const octree_point *points, size_t count)
    {
        std::vector<entry> all;
        for (size_t i = 0; i < count; i++)
            all.emplace_back(to_place(points[i].position), points[i].id);
        return all;
    }

    r_tree(const octree_point *points, size_t count, size_t capacity)
        : tree(list_entries(points, count), bgi::dynamic_rstar(capacity ? capacity : 16))
    {
    }

    size_t nearest(const double at[3], size_t k, double, uint64_t *ids) const
    {
        size_t count = 0;
        for (auto found = tree.qbegin(bgi::nearest(to_place(at), unsigned(k))); found != tree.qend(); ++found)
            ids[count++] = found->second;
        return count;
    }

    void box(const octree_box &b, id_list &ids) const
    {
        const bg::model::box<place> searched(to_place(b.min), to_place(b.max));
        for (auto found = tree.qbegin(bgi::intersects(searched)); found != tree.qend(); ++found)
            ids.add(found->second);
    }
};

#define TEXT(x) #x
#define TEXT_OF(x) TEXT(x)

} // namespace

const spatial_index index_boost =
    index_of<r_tree>::describe("boost", BOOST_LIB_VERSION, OCTREE_DOUBLES, INDEX_NEIGHBORS | INDEX_BOX, false);
