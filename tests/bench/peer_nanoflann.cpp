/* SPDX-License-Identifier: MIT */
// peer_nanoflann.cpp - nanoflann's static k-d tree with its default leaf, in doubles and in floats. It keeps no points
// of its own; an id is a place in the array it was built from. The floats are a copy of the points.
#include "peer.h"

#include <nanoflann.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace
{

template <class T> struct cloud {
    const octree_point *points;
    std::vector<std::array<float, 3>> floats; // empty if T is double
    size_t count;

    size_t kdtree_get_point_count() const
    {
        return count;
    }
    T kdtree_get_pt(size_t i, size_t axis) const
    {
        return sizeof(T) == sizeof(float) ? T(floats[i][axis]) : T(points[i].position[axis]);
    }
    template <class Box> bool kdtree_get_bbox(Box &) const
    {
        return false;
    }
};

template <class T>
using kd_tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<T, cloud<T>>, cloud<T>, 3>;

template <class T> struct subject {
    cloud<T> all;
    std::optional<kd_tree<T>> tree;
};

template <class T> const kd_tree<T> &tree_of(const void *self)
{
    return *static_cast<const subject<T> *>(self)->tree;
}

template <class T> void *create(const octree_box *)
{
    return new subject<T>{};
}

template <class T> void destroy(void *self)
{
    delete static_cast<subject<T> *>(self);
}

template <class T> size_t memory(const void *self)
{
    auto &tree = const_cast<kd_tree<T> &>(tree_of<T>(self));
    return tree.usedMemory(tree) + static_cast<const subject<T> *>(self)->all.count * sizeof(T[3]);
}

template <class T> size_t build(void *self, const octree_point *points, const octree_point *, size_t count) noexcept
{
    auto &s = *static_cast<subject<T> *>(self);
    s.all = {points, {}, count};
    for (size_t i = 0; sizeof(T) == sizeof(float) && i < count; i++)
        s.all.floats.push_back(
            {float(points[i].position[0]), float(points[i].position[1]), float(points[i].position[2])});
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
        tree_of<double>(self).findNeighbors(found, queries[i].at, {}); // whose parameters have another name since 1.5
    }
}

template <class T, size_t K>
void nearest(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t ids[K];
        T squares[K];
        const T at[3] = {T(queries[i].at[0]), T(queries[i].at[1]), T(queries[i].at[2])};
        answers[i] = {};
        answers[i].count = tree_of<T>(self).knnSearch(at, K, ids, squares);
        for (size_t j = 0; j < answers[i].count; j++)
            answers[i].distance += std::sqrt(double(squares[j]));
    }
}

template <class T> peer describe(const char *name)
{
    peer p = {};
    p.name = name;
    p.create = create<T>;
    p.destroy = destroy<T>;
    p.memory = memory<T>;
    p.error = sizeof(T) == sizeof(float) ? 3e-4 : 0; // three rounding errors of coordinates up to 1000
    p.change[PEER_BUILD] = build<T>;
    p.ask[PEER_RADIUS] = sizeof(T) == sizeof(float) ? nullptr : radius;
    p.ask[PEER_NEAREST] = nearest<T, 1>;
    p.ask[PEER_KNN] = nearest<T, PEER_NEIGHBORS>;
    return p;
}

} // namespace

const peer peer_nanoflann = describe<double>("nanoflann");
const peer peer_nanoflann_float = describe<float>("nanoflann-float");
