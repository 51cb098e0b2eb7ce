/* SPDX-License-Identifier: MIT */
// index_parts.hpp - what the peers of index_peer.h have in common, for points of doubles and of floats.
#ifndef INDEX_PARTS_HPP
#define INDEX_PARTS_HPP

#include "index_peer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

// What sums of squares are of: they neither overflow nor vanish for any two doubles, and hardly round.
template <class S> using wide = std::conditional_t<std::is_same_v<S, double>, long double, S>;

template <class S> struct spot {
    S at[3];
    uint64_t id;
};

inline float to_float(double x)
{
    const double most = std::numeric_limits<float>::max();
    return float(std::min(most, std::max(-most, x)));
}

template <class S> spot<S> store(const octree_point &point, planted_fault fault)
{
    spot<S> s{{}, point.id};
    for (int i = 0; i < 3; i++)
        s.at[i] = fault == PLANTED_ROUNDED ? S(to_float(point.position[i])) : S(point.position[i]);
    return s;
}

template <class S> std::vector<spot<S>> store_all(const octree_point *points, size_t count, planted_fault fault)
{
    std::vector<spot<S>> all;
    for (size_t i = 0; i < count; i++)
        all.push_back(store<S>(points[i], fault));
    return all;
}

template <class S> bool same_place(const spot<S> &a, const spot<S> &b)
{
    return a.at[0] == b.at[0] && a.at[1] == b.at[1] && a.at[2] == b.at[2];
}

// Every third point is in a leaf that is not told of its moves.
template <class S> bool is_stale(const spot<S> &s, planted_fault fault)
{
    return fault == PLANTED_STALE && s.id % 3 == 0;
}

template <class S> wide<S> square_of(const S a[3], const S b[3])
{
    wide<S> sum = 0;
    for (int i = 0; i < 3; i++) {
        const wide<S> difference = wide<S>(a[i]) - wide<S>(b[i]);
        sum += difference * difference;
    }
    return sum;
}

// A query as the peer computes it.
template <class S> struct question {
    S target[3], min[3], max[3];
    size_t k;
    wide<S> reach; // the square of the radius and of half of what the promise allows beyond it
    planted_fault fault;

    question(const octree_query &q, planted_fault planted) : fault(planted)
    {
        for (int i = 0; i < 3; i++) {
            target[i] = S(q.target[i]);
            min[i] = S(q.box.min[i]);
            max[i] = S(q.box.max[i]);
        }
        k = q.kind == OCTREE_QUERY_NEAREST ? 1 : q.k;
        if (fault == PLANTED_FEWER && k > 1)
            k--;
        const wide<S> radius = S(q.radius);
        reach = radius * radius;
        if (fault != PLANTED_STRICT)
            reach *= 1 + wide<S>(std::is_same_v<S, float> ? FLOAT_REACH : DOUBLE_REACH);
    }

    bool in_ball(wide<S> square) const
    {
        return fault == PLANTED_STRICT ? square < reach : square <= reach;
    }

    bool in_box(const S at[3]) const
    {
        bool in = true;
        for (int i = 0; i < 3; i++)
            in = in && at[i] >= min[i] && (fault == PLANTED_STRICT ? at[i] < max[i] : at[i] <= max[i]);
        return in;
    }
};

// The nearest so far, by distance.
template <class S> struct nearest_so_far {
    const question<S> &asked;
    std::vector<std::pair<wide<S>, uint64_t>> found;

    explicit nearest_so_far(const question<S> &q) : asked(q)
    {
    }

    // What is farther need not be looked at.
    wide<S> bound() const
    {
        const size_t last = asked.k - 1;
        if (found.size() < asked.k)
            return std::numeric_limits<wide<S>>::max();
        return found[asked.fault == PLANTED_BOUND && last > 0 ? last - 1 : last].first;
    }

    void add(wide<S> square, uint64_t id)
    {
        size_t at = found.size();
        while (at > 0 && found[at - 1].first > square)
            at--;
        if (at >= asked.k)
            return;
        found.insert(found.begin() + std::ptrdiff_t(at), {square, id});
        if (found.size() > asked.k)
            found.pop_back();
    }

    size_t name(uint64_t *ids) const
    {
        for (size_t i = 0; i < found.size(); i++)
            ids[i] = found[i].second;
        return found.size();
    }
};

// The functions of index_peer for a class of this shape: (points, count, fault), update(points), ask(query, ids).
template <class Index> struct peer_of {
    static void *create(const octree_point *points, size_t count, planted_fault fault)
    {
        return new Index(points, count, fault);
    }
    static void destroy(void *self)
    {
        delete static_cast<Index *>(self);
    }
    static void update(void *self, const octree_point *points)
    {
        static_cast<Index *>(self)->update(points);
    }
    static size_t ask(const void *self, const octree_query *query, uint64_t *ids)
    {
        return static_cast<const Index *>(self)->ask(*query, ids);
    }

    // Floats that are promised cannot be rounded.
    static index_peer describe(const char *name, unsigned kinds, unsigned faults)
    {
        const bool floats = std::is_same_v<typename Index::number, float>;
        if (floats)
            faults &= ~(1u << PLANTED_ROUNDED);
        return {
            name, floats ? OCTREE_FLOATS : OCTREE_DOUBLES, kinds, faults | 1u << PLANTED_NONE, create, destroy, update,
            ask};
    }
};

const unsigned ALL_KINDS = (1u << OCTREE_QUERY_KINDS) - 1, ALL_FAULTS = (1u << PLANTED_FAULTS) - 1;

#endif
