/* SPDX-License-Identifier: MIT */
// index_flann.cpp - the k-d tree of FLANN for few dimensions, in doubles and in floats.
#include "index.hpp"

#include <flann/flann.hpp>

#include <vector>

namespace
{

template <class T> std::vector<T> copy(const octree_point *points, size_t count)
{
    std::vector<T> all;
    for (size_t i = 0; i < count; i++)
        for (const double x : points[i].position)
            all.push_back(T(x));
    return all;
}

template <class T> struct kd_tree : index_base {
    using tree_type = flann::KDTreeSingleIndex<flann::L2_Simple<T>>;
    const octree_point *points;
    std::vector<T> all;
    tree_type tree;

    kd_tree(const octree_point *list, size_t count, size_t capacity)
        : points(list), all(copy<T>(list, count)),
          tree(flann::Matrix<T>(all.data(), count, 3), flann::KDTreeSingleIndexParams(capacity ? int(capacity) : 10))
    {
        tree.buildIndex();
    }

    static flann::SearchParams search(double epsilon)
    {
        flann::SearchParams how(flann::FLANN_CHECKS_UNLIMITED, float(epsilon), false);
        how.use_heap = flann::FLANN_False;
        return how;
    }

    size_t nearest(const double at[3], size_t k, double epsilon, uint64_t *ids) const
    {
        T target[3] = {T(at[0]), T(at[1]), T(at[2])};
        flann::KNNSimpleResultSet<T> result(k);
        thread_local std::vector<size_t> found;
        thread_local std::vector<T> squares;
        found.resize(k);
        squares.resize(k);
        tree.findNeighbors(result, target, search(epsilon));
        const size_t count = std::min(result.size(), k);
        result.copy(found.data(), squares.data(), count, false);
        for (size_t i = 0; i < count; i++)
            ids[i] = points[found[i]].id;
        return count;
    }

    void ball(const double center[3], double radius, id_list &ids) const
    {
        T target[3] = {T(center[0]), T(center[1]), T(center[2])};
        std::vector<std::vector<size_t>> found;
        std::vector<std::vector<T>> squares;
        flann::SearchParams how = search(0);
        how.max_neighbors = -1;
        tree.radiusSearch(flann::Matrix<T>(target, 1, 3), found, squares, float(radius * radius), how);
        for (const size_t i : found[0])
            ids.add(points[i].id);
    }
};

} // namespace

const spatial_index index_flann =
    index_of<kd_tree<double>>::describe("flann", FLANN_VERSION_, OCTREE_DOUBLES, INDEX_NEIGHBORS | INDEX_BALL, true);
const spatial_index index_flann_float = index_of<kd_tree<float>>::describe("flann-float", FLANN_VERSION_, OCTREE_FLOATS,
                                                                           INDEX_NEIGHBORS | INDEX_BALL, true);
