/* SPDX-License-Identifier: MIT */
// peer_grid.cpp - a uniform grid of buckets, each with the box of its points.
#include "index_parts.hpp"

#include <algorithm>

namespace
{

template <class S> struct grid {
    using number = S;
    enum { SIDE = 6 };

    struct cell {
        std::vector<size_t> spots;
        S min[3], max[3]; // of all that has ever been in it
    };

    planted_fault fault;
    std::vector<spot<S>> all;
    std::vector<int> home; // the cell of each
    cell cells[SIDE * SIDE * SIDE];
    S low[3], high[3];

    grid(const octree_point *points, size_t count, planted_fault planted)
        : fault(planted), all(store_all<S>(points, count, planted)), home(count)
    {
        for (int i = 0; i < 3; i++) {
            low[i] = high[i] = all[0].at[i];
            for (const spot<S> &s : all) {
                low[i] = std::min(low[i], s.at[i]);
                high[i] = std::max(high[i], s.at[i]);
            }
        }
        for (size_t i = 0; i < count; i++)
            put(i);
    }

    // Beyond the grid it is the outermost cell. Halves, since a difference may overflow.
    int index_of(S x, int axis) const
    {
        const S part = (x / 2 - low[axis] / 2) / (high[axis] / 2 - low[axis] / 2) * SIDE;
        return part >= SIDE ? SIDE - 1 : part > 0 ? int(part) : 0; // a NaN is 0
    }

    int cell_of(const S at[3]) const
    {
        return (index_of(at[0], 0) * SIDE + index_of(at[1], 1)) * SIDE + index_of(at[2], 2);
    }

    void put(size_t i)
    {
        home[i] = cell_of(all[i].at);
        cell &c = cells[home[i]];
        for (int axis = 0; axis < 3; axis++) {
            const S x = all[i].at[axis];
            c.min[axis] = c.spots.empty() ? x : std::min(c.min[axis], x);
            c.max[axis] = c.spots.empty() ? x : std::max(c.max[axis], x);
        }
        c.spots.push_back(i);
    }

    void update(const octree_point *points)
    {
        for (size_t i = 0; i < all.size(); i++) {
            const spot<S> moved = store<S>(points[i], fault);
            if (same_place(moved, all[i]))
                continue;
            all[i] = moved;
            if (is_stale(moved, fault))
                continue;
            std::vector<size_t> &old = cells[home[i]].spots;
            old.erase(std::find(old.begin(), old.end(), i));
            put(i);
        }
    }

    // The square of how far a cell is away.
    wide<S> gap(const cell &c, const S at[3]) const
    {
        S nearest[3];
        for (int axis = 0; axis < 3; axis++)
            nearest[axis] = std::clamp(at[axis], c.min[axis], c.max[axis]);
        return square_of<S>(nearest, at);
    }

    size_t ask_nearest(const question<S> &q, uint64_t *ids) const
    {
        nearest_so_far<S> best(q);
        const int count = SIDE * SIDE * SIDE, begin = cell_of(q.target);
        for (int n = 0; n < count; n++) {
            const cell &c = cells[(begin + n) % count];
            if (c.spots.empty() || gap(c, q.target) > best.bound() || (n == 1 && fault == PLANTED_CHILD))
                continue;
            for (const size_t i : c.spots)
                best.add(square_of<S>(all[i].at, q.target), all[i].id);
        }
        return best.name(ids);
    }

    size_t ask_ball(const question<S> &q, uint64_t *ids) const
    {
        size_t count = 0;
        const int last = SIDE * SIDE * SIDE - (fault == PLANTED_BOUND),
                  skipped = fault == PLANTED_CHILD ? last / 2 : -1;
        for (int n = 0; n < last; n++) {
            if (cells[n].spots.empty() || n == skipped || !(gap(cells[n], q.target) <= q.reach))
                continue;
            for (const size_t i : cells[n].spots)
                if (q.in_ball(square_of<S>(all[i].at, q.target)))
                    ids[count++] = all[i].id;
        }
        return count;
    }

    size_t ask_box(const question<S> &q, uint64_t *ids) const
    {
        size_t count = 0;
        int first[3], last[3];
        for (int axis = 0; axis < 3; axis++) {
            first[axis] = index_of(q.min[axis], axis);
            last[axis] = index_of(q.max[axis], axis) - (fault == PLANTED_BOUND);
        }
        for (int x = first[0]; x <= last[0]; x++)
            for (int y = first[1]; y <= last[1]; y++)
                for (int z = first[2] + (fault == PLANTED_CHILD && last[2] > first[2]); z <= last[2]; z++)
                    for (const size_t i : cells[(x * SIDE + y) * SIDE + z].spots)
                        if (q.in_box(all[i].at))
                            ids[count++] = all[i].id;
        return count;
    }

    size_t ask(const octree_query &query, uint64_t *ids) const
    {
        const question<S> q(query, fault);
        if (query.kind == OCTREE_QUERY_RANGE)
            return ask_box(q, ids);
        return query.kind == OCTREE_QUERY_RADIUS ? ask_ball(q, ids) : ask_nearest(q, ids);
    }
};

} // namespace

const index_peer grid_doubles = peer_of<grid<double>>::describe("grid", ALL_KINDS, ALL_FAULTS);
const index_peer grid_floats = peer_of<grid<float>>::describe("grid-float", ALL_KINDS, ALL_FAULTS);
