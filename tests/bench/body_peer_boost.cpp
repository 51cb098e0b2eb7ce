/* SPDX-License-Identifier: MIT */
// body_peer_boost.cpp - Boost.Geometry's R-tree of boxes with the quadratic rule.
#include "body_peer.h"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

namespace
{

using place = bg::model::point<double, 3, bg::cs::cartesian>;
using box = bg::model::box<place>;
using entry = std::pair<box, uint64_t>;
using tree = bgi::rtree<entry, bgi::quadratic<16>>;

entry make_entry(const octree_body &b)
{
    const double *p = b.position, *h = b.half;
    return {box(place(p[0] - h[0], p[1] - h[1], p[2] - h[2]), place(p[0] + h[0], p[1] + h[1], p[2] + h[2])), b.id};
}

void *create(const octree_box *)
{
    return new tree;
}

void destroy(void *self)
{
    delete static_cast<tree *>(self);
}

void build(void *self, const octree_body *bodies, const octree_body *, size_t count)
{
    std::vector<entry> entries;
    entries.reserve(count);
    for (size_t i = 0; i < count; i++)
        entries.push_back(make_entry(bodies[i]));
    *static_cast<tree *>(self) = tree(entries); // packed
}

void insert(void *self, const octree_body *bodies, const octree_body *, size_t count)
{
    for (size_t i = 0; i < count; i++)
        static_cast<tree *>(self)->insert(make_entry(bodies[i]));
}

void remove(void *self, const octree_body *bodies, const octree_body *, size_t count)
{
    for (size_t i = 0; i < count; i++)
        static_cast<tree *>(self)->remove(make_entry(bodies[i]));
}

void move(void *self, const octree_body *bodies, const octree_body *to, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        remove(self, &bodies[i], nullptr, 1);
        insert(self, &to[i], nullptr, 1);
    }
}

void move_all(void *self, const octree_body *, const octree_body *to, size_t count)
{
    build(self, to, nullptr, count);
}

box make_box(const octree_box &b)
{
    return box(place(b.min[0], b.min[1], b.min[2]), place(b.max[0], b.max[1], b.max[2]));
}

void search(const void *self, const octree_region *regions, size_t count, body_answer *answers)
{
    const tree &t = *static_cast<const tree *>(self);
    for (size_t i = 0; i < count; i++) {
        answers[i] = {};
        for (auto it = t.qbegin(bgi::intersects(make_box(regions[i].box))); it != t.qend(); ++it) {
            answers[i].count++;
            answers[i].ids += it->second;
        }
    }
}

void find_nearest(const void *self, const octree_region *regions, size_t count, body_answer *answers)
{
    const tree &t = *static_cast<const tree *>(self);
    for (size_t i = 0; i < count; i++) {
        const place target(regions[i].center[0], regions[i].center[1], regions[i].center[2]);
        answers[i] = {};
        for (auto it = t.qbegin(bgi::nearest(target, 1)); it != t.qend(); ++it) {
            answers[i].count++;
            answers[i].at = bg::distance(target, it->first);
        }
    }
}

void find_pairs(const void *self, const octree_region *, size_t, body_answer *answers)
{
    const tree &t = *static_cast<const tree *>(self);
    answers[0] = {};
    for (const entry &e : t)
        for (auto it = t.qbegin(bgi::intersects(e.first)); it != t.qend(); ++it)
            if (e.second < it->second) {
                answers[0].count++;
                answers[0].ids += e.second + it->second;
            }
}

} // namespace

const body_peer body_peer_boost = {
    "boost",
    create,
    destroy,
    nullptr,
    0,
    {build, insert, remove, move, move_all},
    {search, nullptr, nullptr, nullptr, find_nearest, find_pairs},
};
