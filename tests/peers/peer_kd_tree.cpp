/* SPDX-License-Identifier: MIT */
// peer_kd_tree.cpp - nanoflann's static k-d tree, built anew when points have moved.
//
// Its nodes are not aligned for long doubles, so that it measures in the numbers of its points. What it finds is
// compared by wider sums, and what it leaves out lies a hair farther than the bound.
#include "index_parts.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <optional>

namespace
{

template <class S> struct cloud {
    std::vector<spot<S>> all;
    planted_fault fault;

    size_t kdtree_get_point_count() const
    {
        return all.size();
    }
    S kdtree_get_pt(size_t i, size_t axis) const
    {
        return all[i].at[axis];
    }
    template <class Box> bool kdtree_get_bbox(Box &) const
    {
        return false;
    }
};

template <class S> struct metric {
    using ElementType = S;
    using DistanceType = S;
    const cloud<S> &points;

    metric(const cloud<S> &all) : points(all)
    {
    }
    S evalMetric(const S *a, uint32_t i, size_t) const
    {
        return S(square_of<S>(a, points.all[i].at));
    }
    // How far a plane is away: a child that seems twice as far is skipped.
    template <class A, class B> S accum_dist(A a, B b, size_t axis) const
    {
        const S gap = S(a - b) * (points.fault == PLANTED_CHILD && axis == 1 ? 2 : 1);
        return gap * gap;
    }
};

// Above a bound, which nanoflann takes for the square of what is too far.
template <class S> S hair_above(wide<S> bound)
{
    return std::nextafter(S(bound * (1 + 16 * std::numeric_limits<S>::epsilon())), std::numeric_limits<S>::max());
}

template <class S> struct near_set {
    using DistanceType = S;
    using IndexType = uint32_t;
    nearest_so_far<S> &best;
    const cloud<S> &points;

    bool full() const
    {
        return best.found.size() == best.asked.k;
    }
    S worstDist() const
    {
        return full() ? hair_above<S>(best.bound()) : std::numeric_limits<S>::max();
    }
    bool addPoint(S, uint32_t i)
    {
        best.add(square_of<S>(best.asked.target, points.all[i].at), points.all[i].id);
        return true;
    }
    void sort() const // nanoflann 1.5 and later ask for it
    {
    }
};

template <class S> struct ball_set {
    using DistanceType = S;
    using IndexType = uint32_t;
    const question<S> &asked;
    const cloud<S> &points;
    uint64_t *ids;
    size_t count;

    bool full() const
    {
        return true;
    }
    S worstDist() const
    {
        return hair_above<S>(asked.reach);
    }
    bool addPoint(S, uint32_t i)
    {
        if (asked.in_ball(square_of<S>(asked.target, points.all[i].at)))
            ids[count++] = points.all[i].id;
        return true;
    }
    void sort() const
    {
    }
};

template <class S> struct kd_index {
    using number = S;
    using tree_type = nanoflann::KDTreeSingleIndexAdaptor<metric<S>, cloud<S>, 3>;
    int scale = 0; // coordinates are times 2^scale, which rounds nothing, so that squares do not overflow or vanish
    cloud<S> points;
    std::optional<tree_type> tree;

    kd_index(const octree_point *list, size_t count, planted_fault fault)
    {
        double largest = 0;
        for (size_t i = 0; i < count; i++)
            for (const double x : list[i].position)
                largest = std::max(largest, std::fabs(x));
        if (largest > 0 && std::abs(std::ilogb(largest)) > 100)
            scale = -std::ilogb(largest);
        points = {std::vector<spot<S>>(count), fault};
        place(list);
        build();
    }

    void place(const octree_point *list)
    {
        for (size_t i = 0; i < points.all.size(); i++)
            points.all[i] = store<S>(
                {{scaled(list[i].position[0]), scaled(list[i].position[1]), scaled(list[i].position[2])}, list[i].id},
                points.fault);
    }

    double scaled(double x) const
    {
        return std::ldexp(x, scale);
    }

    void build()
    {
        tree.emplace(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(4));
    }

    // Points that move under a tree that is not built anew are in the wrong leaves.
    void update(const octree_point *list)
    {
        place(list);
        if (points.fault != PLANTED_STALE)
            build();
    }

    size_t ask(octree_query query, uint64_t *ids) const
    {
        for (double &x : query.target)
            x = scaled(x);
        query.radius = scaled(query.radius);
        const question<S> q(query, points.fault);
        nearest_so_far<S> best(q);
        near_set<S> nearest{best, points};
        ball_set<S> ball{q, points, ids, 0};
        if (query.kind == OCTREE_QUERY_RADIUS)
            tree->findNeighbors(ball, q.target, {});
        else
            tree->findNeighbors(nearest, q.target, {});
        return query.kind == OCTREE_QUERY_RADIUS ? ball.count : best.name(ids);
    }
};

const unsigned kinds = ALL_KINDS & ~(1u << OCTREE_QUERY_RANGE);

} // namespace

const index_peer nanoflann_doubles = peer_of<kd_index<double>>::describe("nanoflann", kinds, ALL_FAULTS);
const index_peer nanoflann_floats = peer_of<kd_index<float>>::describe("nanoflann-float", kinds, ALL_FAULTS);
