/* SPDX-License-Identifier: MIT */
// index_nanoflann.cpp - nanoflann's static k-d tree, in doubles and in floats.
#include "index.hpp"

#include <nanoflann.hpp>

#include <array>
#include <string>
#include <vector>

namespace
{

template <class T> struct cloud {
    std::vector<std::array<T, 3>> places;

    size_t kdtree_get_point_count() const
    {
        return places.size();
    }
    T kdtree_get_pt(size_t i, size_t axis) const
    {
        return places[i][axis];
    }
    template <class Box> bool kdtree_get_bbox(Box &) const
    {
        return false;
    }
};

template <class T> cloud<T> copy(const octree_point *points, size_t count)
{
    cloud<T> all;
    for (size_t i = 0; i < count; i++)
        all.places.push_back({T(points[i].position[0]), T(points[i].position[1]), T(points[i].position[2])});
    return all;
}

#if NANOFLANN_VERSION >= 0x150
nanoflann::SearchParameters search(double epsilon)
{
    return nanoflann::SearchParameters(float(epsilon), false);
}
#else
nanoflann::SearchParams search(double epsilon)
{
    return nanoflann::SearchParams(32, float(epsilon), false);
}
#endif

// An answer of nanoflann names places in its list; the ids of the points are looked up.
template <class T> struct kd_tree : index_base {
    using tree_type = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<T, cloud<T>>, cloud<T>, 3>;
    const octree_point *points;
    const cloud<T> all;
    const tree_type tree;

    kd_tree(const octree_point *list, size_t count, size_t capacity)
        : points(list), all(copy<T>(list, count)), tree(3, all,
                                                        capacity ? nanoflann::KDTreeSingleIndexAdaptorParams(capacity)
                                                                 : nanoflann::KDTreeSingleIndexAdaptorParams())
    {
    }

    size_t nearest(const double at[3], size_t k, double epsilon, uint64_t *ids) const
    {
        thread_local std::vector<uint32_t> found;
        thread_local std::vector<T> squares;
        const T target[3] = {T(at[0]), T(at[1]), T(at[2])};
        found.resize(k);
        squares.resize(k);
        nanoflann::KNNResultSet<T, uint32_t> result(k);
        result.init(found.data(), squares.data());
        tree.findNeighbors(result, target, search(epsilon));
        for (size_t i = 0; i < result.size(); i++)
            ids[i] = points[found[i]].id;
        return result.size();
    }

    struct ball_result { // an id_list as nanoflann's result
        using DistanceType = T;
        using IndexType = uint32_t;
        const octree_point *points;
        T square;
        id_list &list;

        bool full() const
        {
            return true;
        }
        T worstDist() const
        {
            return square;
        }
        bool addPoint(T distance, uint32_t i)
        {
            if (distance < square) // as nanoflann's own RadiusResultSet
                list.add(points[i].id);
            return true;
        }
        void sort() const
        {
        }
    };

    void ball(const double center[3], double radius, id_list &ids) const
    {
        const T target[3] = {T(center[0]), T(center[1]), T(center[2])};
        ball_result result{points, T(radius) * T(radius), ids};
        tree.findNeighbors(result, target, search(0));
    }
};

constexpr char digit(int place)
{
    return char('0' + (NANOFLANN_VERSION >> 4 * place & 15));
}
const char version[] = {digit(2), '.', digit(1), '.', digit(0), '\0'};

} // namespace

const spatial_index index_nanoflann =
    index_of<kd_tree<double>>::describe("nanoflann", version, OCTREE_DOUBLES, INDEX_NEIGHBORS | INDEX_BALL, true);
const spatial_index index_nanoflann_float =
    index_of<kd_tree<float>>::describe("nanoflann-float", version, OCTREE_FLOATS, INDEX_NEIGHBORS | INDEX_BALL, true);
