/* SPDX-License-Identifier: MIT */
// peer_rtree.cpp - Boost.Geometry's R-tree, in which points are moved one by one.
#include "index_parts.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

namespace
{

template <class S> struct rtree_index {
    using number = S;
    using place = bg::model::point<wide<S>, 3, bg::cs::cartesian>;
    using region = bg::model::box<place>;
    using value = std::pair<place, size_t>;

    planted_fault fault;
    std::vector<spot<S>> all;
    bgi::rtree<value, bgi::quadratic<8>> tree;
    S plane; // of the root: half of the points are on either side of it on x, or thereabouts

    static place place_of(const S at[3])
    {
        return place(at[0], at[1], at[2]);
    }

    rtree_index(const octree_point *points, size_t count, planted_fault planted)
        : fault(planted), all(store_all<S>(points, count, planted)), plane(all[count / 2].at[0])
    {
        for (size_t i = 0; i < count; i++)
            tree.insert({place_of(all[i].at), i});
    }

    void update(const octree_point *points)
    {
        for (size_t i = 0; i < all.size(); i++) {
            const spot<S> moved = store<S>(points[i], fault);
            if (same_place(moved, all[i]) || is_stale(moved, fault))
                continue;
            tree.remove({place_of(all[i].at), i});
            all[i] = moved;
            tree.insert({place_of(moved.at), i});
        }
    }

    // Whether a value is in the child that is skipped: the one that the target is not in.
    bool is_seen(const value &v, const S target[3]) const
    {
        return fault != PLANTED_CHILD || (all[v.second].at[0] < plane) == (target[0] < plane);
    }

    size_t ask_nearest(const question<S> &q, uint64_t *ids) const
    {
        size_t count = 0;
        const auto seen = [&](const value &v) { return is_seen(v, q.target); };
        tree.query(bgi::nearest(place_of(q.target), unsigned(q.k)) && bgi::satisfies(seen),
                   boost::make_function_output_iterator([&](const value &v) { ids[count++] = all[v.second].id; }));
        return count;
    }

    // What the tree finds in a region, and a test takes.
    template <class Test>
    size_t ask_region(const place &min, place max, const S begin[3], uint64_t *ids, const Test &test) const
    {
        size_t count = 0;
        if (fault == PLANTED_BOUND)
            bg::set<2>(max, bg::get<1>(max));
        if (bg::get<2>(max) < bg::get<2>(min))
            return 0;
        tree.query(bgi::intersects(region(min, max)), boost::make_function_output_iterator([&](const value &v) {
                       if (is_seen(v, begin) && test(all[v.second]))
                           ids[count++] = all[v.second].id;
                   }));
        return count;
    }

    size_t ask_ball(const question<S> &q, uint64_t *ids) const
    {
        const wide<S> most = std::numeric_limits<wide<S>>::max();
        const wide<S> reach = std::sqrt(q.reach) * (1 + 4 * std::numeric_limits<wide<S>>::epsilon());
        wide<S> low[3], high[3];
        for (int i = 0; i < 3; i++) { // outwards, since these are rounded
            low[i] = std::nextafter(q.target[i] - reach, -most);
            high[i] = std::nextafter(q.target[i] + reach, most);
        }
        const place min(low[0], low[1], low[2]), max(high[0], high[1], high[2]);
        return ask_region(min, max, q.target, ids,
                          [&](const spot<S> &s) { return q.in_ball(square_of<S>(s.at, q.target)); });
    }

    size_t ask(const octree_query &query, uint64_t *ids) const
    {
        const question<S> q(query, fault);
        if (query.kind == OCTREE_QUERY_RADIUS)
            return ask_ball(q, ids);
        if (query.kind == OCTREE_QUERY_RANGE)
            return ask_region(place_of(q.min), place_of(q.max), q.min, ids,
                              [&](const spot<S> &s) { return q.in_box(s.at) || fault == PLANTED_BOUND; });
        return ask_nearest(q, ids);
    }
};

} // namespace

const index_peer boost_doubles = peer_of<rtree_index<double>>::describe("boost", ALL_KINDS, ALL_FAULTS);
const index_peer boost_floats = peer_of<rtree_index<float>>::describe("boost-float", ALL_KINDS, ALL_FAULTS);
