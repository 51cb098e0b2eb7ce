/* SPDX-License-Identifier: MIT */
// peer_nanoflann.cpp - nanoflann's static k-d tree in doubles with its default leaf. It keeps no points of its own; an
// id is a place in the array it was built from.
#include "peer.h"

#include <nanoflann.hpp>

#include <cmath>
#include <optional>

namespace
{

struct cloud {
    const octree_point *points;
    size_t count;

    size_t kdtree_get_point_count() const
    {
        return count;
    }
    double kdtree_get_pt(size_t i, size_t axis) const
    {
        return points[i].position[axis];
    }
    template <class Box> bool kdtree_get_bbox(Box &) const
    {
        return false;
    }
};

using kd_tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, cloud>, cloud, 3>;

struct subject {
    cloud all;
    std::optional<kd_tree> tree;
};

const kd_tree &tree_of(const void *self)
{
    return *static_cast<const subject *>(self)->tree;
}

void *create(const octree_box *)
{
    return new subject{};
}

void destroy(void *self)
{
    delete static_cast<subject *>(self);
}

size_t memory(const void *self)
{
    auto &tree = const_cast<kd_tree &>(tree_of(self));
    return tree.usedMemory(tree) + static_cast<const subject *>(self)->all.count * sizeof(double[3]);
}

size_t build(void *self, const octree_point *points, const octree_point *, size_t count) noexcept
{
    auto &s = *static_cast<subject *>(self);
    s.all = {points, count};
    s.tree.emplace(3, s.all);
    return count;
}

// Adds up what lies within a squared radius.
struct hits {
    using DistanceType = double; // this and sort() are asked for by nanoflann 1.5 and later
    using IndexType = uint32_t;  // and this by 1.12
    double square;
    peer_answer &answer;

    bool full() const
    {
        return true;
    }
    double worstDist() const
    {
        return square;
    }
    bool addPoint(double distance, uint32_t id)
    {
        if (distance <= square) {
            answer.count++;
            answer.ids += id;
        }
        return true;
    }
    void sort() const
    {
    }
};

void radius(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        answers[i] = {};
        hits found{queries[i].size * queries[i].size, answers[i]};
        tree_of(self).findNeighbors(found, queries[i].at, {}); // whose parameters have another name since 1.5
    }
}

template <size_t K> void nearest(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t ids[K];
        double squares[K];
        answers[i] = {};
        answers[i].count = tree_of(self).knnSearch(queries[i].at, K, ids, squares);
        for (size_t j = 0; j < answers[i].count; j++)
            answers[i].distance += std::sqrt(squares[j]);
    }
}

peer describe()
{
    peer p = {};
    p.name = "nanoflann";
    p.create = create;
    p.destroy = destroy;
    p.memory = memory;
    p.change[PEER_BUILD] = build;
    p.ask[PEER_RADIUS] = radius;
    p.ask[PEER_NEAREST] = nearest<1>;
    p.ask[PEER_KNN] = nearest<PEER_NEIGHBORS>;
    return p;
}

} // namespace

const peer peer_nanoflann = describe();
