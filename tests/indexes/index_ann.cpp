/* SPDX-License-Identifier: MIT */
// index_ann.cpp - the k-d tree of ANN (Arya and Mount), which is in doubles.
#include "index.hpp"

#include <ANN/ANN.h>

#include <limits>
#include <vector>

namespace
{

struct kd_tree : index_base {
    const octree_point *points;
    std::vector<ANNpoint> places;
    ANNkd_tree tree;

    static std::vector<ANNpoint> list_places(const octree_point *points, size_t count)
    {
        std::vector<ANNpoint> places;
        for (size_t i = 0; i < count; i++)
            places.push_back(const_cast<ANNpoint>(points[i].position)); // which ANN only reads
        return places;
    }

    kd_tree(const octree_point *list, size_t count, size_t capacity)
        : points(list), places(list_places(list, count)),
          tree(places.data(), int(count), 3, capacity ? int(capacity) : 1)
    {
    }

    // ANN refuses more neighbours than points by ending the program.
    size_t nearest(const double at[3], size_t k, double epsilon, uint64_t *ids) const
    {
        std::vector<ANNidx> found(k);
        std::vector<ANNdist> squares(k);
        k = std::min(k, places.size());
        if (k == 0)
            return 0;
        const_cast<ANNkd_tree &>(tree).annkSearch(const_cast<ANNpoint>(at), int(k), found.data(), squares.data(),
                                                  epsilon);
        size_t count = 0;
        for (size_t i = 0; i < k; i++)
            if (found[i] != ANN_NULL_IDX)
                ids[count++] = points[found[i]].id;
        return count;
    }

    // Two searches, as its manual says: the first counts.
    void ball(const double center[3], double radius, id_list &ids) const
    {
        auto &searched = const_cast<ANNkd_tree &>(tree);
        auto *const at = const_cast<ANNpoint>(center);
        const int count = searched.annkFRSearch(at, radius * radius, 0);
        std::vector<ANNidx> found(static_cast<size_t>(count) + 1);
        std::vector<ANNdist> squares(found.size());
        searched.annkFRSearch(at, radius * radius, count, found.data(), squares.data());
        for (int i = 0; i < count; i++)
            if (found[size_t(i)] != ANN_NULL_IDX)
                ids.add(points[found[size_t(i)]].id);
    }
};

} // namespace

const spatial_index index_ann =
    index_of<kd_tree>::describe("ann", ANNversion, OCTREE_DOUBLES, INDEX_NEIGHBORS | INDEX_BALL, true);
