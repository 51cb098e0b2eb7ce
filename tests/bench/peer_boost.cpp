/* SPDX-License-Identifier: MIT */
// peer_boost.cpp - Boost.Geometry's R-tree: packed for what does not change, quadratic and R* for what does.
#include "peer.h"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <cmath>
#include <memory>
#include <optional>

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

// A stored point of the octree is a point of Boost's as it stands.
namespace boost::geometry::traits
{
template <> struct tag<octree_point> {
    using type = point_tag;
};
template <> struct coordinate_type<octree_point> {
    using type = double;
};
template <> struct coordinate_system<octree_point> {
    using type = cs::cartesian;
};
template <> struct dimension<octree_point> : std::integral_constant<std::size_t, 3> {
};
template <std::size_t Axis> struct access<octree_point, Axis> {
    static double get(const octree_point &p)
    {
        return p.position[Axis];
    }
    static void set(octree_point &p, double value)
    {
        p.position[Axis] = value;
    }
};
} // namespace boost::geometry::traits

namespace
{

using place = bg::model::point<double, 3, bg::cs::cartesian>;
using region = bg::model::box<place>;

struct same_pair {
    bool operator()(const octree_point &a, const octree_point &b) const
    {
        return a.id == b.id && a.position[0] == b.position[0] && a.position[1] == b.position[1] &&
               a.position[2] == b.position[2];
    }
};

// Takes memory as everybody does and keeps count of it.
template <class T> struct counted : std::allocator<T> {
    template <class U> struct rebind {
        using other = counted<U>;
    };
    size_t *bytes;

    explicit counted(size_t *counter) : bytes(counter)
    {
    }
    template <class U> counted(const counted<U> &other) : bytes(other.bytes)
    {
    }
    T *allocate(size_t n)
    {
        *bytes += n * sizeof(T);
        return std::allocator<T>::allocate(n);
    }
    void deallocate(T *memory, size_t n)
    {
        *bytes -= n * sizeof(T);
        std::allocator<T>::deallocate(memory, n);
    }
};

template <class Split> struct boost_tree {
    using tree_type = bgi::rtree<octree_point, Split, bgi::indexable<octree_point>, same_pair, counted<octree_point>>;

    size_t bytes = 0;
    tree_type tree{Split(), bgi::indexable<octree_point>(), same_pair(), counted<octree_point>(&bytes)};

    static boost_tree &of(void *self)
    {
        return *static_cast<boost_tree *>(self);
    }

    static const tree_type &tree_of(const void *self)
    {
        return static_cast<const boost_tree *>(self)->tree;
    }

    static void *create(const octree_box *)
    {
        return new boost_tree;
    }

    static void destroy(void *self)
    {
        delete &of(self);
    }

    static size_t memory(const void *self)
    {
        return static_cast<const boost_tree *>(self)->bytes;
    }

    static size_t build(void *self, const octree_point *points, const octree_point *, size_t count) noexcept
    {
        boost_tree &s = of(self);
        s.tree = tree_type(points, points + count, Split(), bgi::indexable<octree_point>(), same_pair(),
                           counted<octree_point>(&s.bytes));
        return s.tree.size();
    }

    static size_t insert(void *self, const octree_point *points, const octree_point *, size_t count) noexcept
    {
        const size_t before = of(self).tree.size();
        for (size_t i = 0; i < count; i++)
            of(self).tree.insert(points[i]);
        return of(self).tree.size() - before;
    }

    static size_t remove(void *self, const octree_point *points, const octree_point *, size_t count) noexcept
    {
        size_t done = 0;
        for (size_t i = 0; i < count; i++)
            done += of(self).tree.remove(points[i]);
        return done;
    }

    static size_t move(void *self, const octree_point *points, const octree_point *to, size_t count) noexcept
    {
        size_t done = 0;
        for (size_t i = 0; i < count; i++) {
            const size_t found = of(self).tree.remove(points[i]);
            if (found)
                of(self).tree.insert(to[i]);
            done += found;
        }
        return done;
    }

    // Ask one predicate and give every point that answers it to `take`.
    template <class Predicate, class Take> static void each(const void *self, const Predicate &asked, const Take &take)
    {
        tree_of(self).query(asked, boost::make_function_output_iterator(take));
    }

    static place place_of(const peer_query &query)
    {
        return place(query.at[0], query.at[1], query.at[2]);
    }

    static region region_of(const peer_query &query)
    {
        const double *at = query.at, size = query.size;
        return region(place(at[0] - size, at[1] - size, at[2] - size), place(at[0] + size, at[1] + size, at[2] + size));
    }

    static double square(const double at[3], const octree_point &p)
    {
        const double x = p.position[0] - at[0], y = p.position[1] - at[1], z = p.position[2] - at[2];
        return x * x + y * y + z * z;
    }

    static void find(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
    {
        for (size_t i = 0; i < count; i++) {
            const auto found = tree_of(self).qbegin(bgi::intersects(place_of(queries[i])));
            answers[i] = {};
            if (found != tree_of(self).qend())
                answers[i] = {1, found->id, 0};
        }
    }

    static void box(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
    {
        for (size_t i = 0; i < count; i++) {
            peer_answer &answer = answers[i] = {};
            each(self, bgi::intersects(region_of(queries[i])), [&answer](const octree_point &p) {
                answer.count++;
                answer.ids += p.id;
            });
        }
    }

    static void radius(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
    {
        for (size_t i = 0; i < count; i++) {
            const peer_query &q = queries[i];
            peer_answer &answer = answers[i] = {};
            each(self, bgi::intersects(region_of(q)), [&answer, &q](const octree_point &p) {
                if (square(q.at, p) <= q.size * q.size) {
                    answer.count++;
                    answer.ids += p.id;
                }
            });
        }
    }

    template <unsigned K>
    static void nearest(const void *self, const peer_query *queries, size_t count, peer_answer *answers)
    {
        for (size_t i = 0; i < count; i++) {
            const peer_query &q = queries[i];
            peer_answer &answer = answers[i] = {};
            each(self, bgi::nearest(place_of(q), K), [&answer, &q](const octree_point &p) {
                answer.count++;
                answer.distance += std::sqrt(square(q.at, p));
            });
        }
    }

    static peer describe(const char *name)
    {
        peer p = {};
        p.name = name;
        p.create = create;
        p.destroy = destroy;
        p.memory = memory;
        p.ask[PEER_FIND] = find;
        p.ask[PEER_BOX] = box;
        p.ask[PEER_RADIUS] = radius;
        p.ask[PEER_NEAREST] = nearest<1>;
        p.ask[PEER_KNN] = nearest<PEER_NEIGHBORS>;
        p.ask[PEER_COLLIDE] = box;
        return p;
    }

    static peer describe_packed(const char *name)
    {
        peer p = describe(name);
        p.change[PEER_BUILD] = build;
        return p;
    }

    static peer describe_dynamic(const char *name)
    {
        peer p = describe(name);
        p.change[PEER_INSERT] = insert;
        p.change[PEER_REMOVE] = remove;
        p.change[PEER_MOVE] = move;
        return p;
    }
};

using quadratic = boost_tree<bgi::quadratic<16>>;
using rstar = boost_tree<bgi::rstar<16>>;

} // namespace

const peer peer_boost_packed = quadratic::describe_packed("boost-packed");
const peer peer_boost_quadratic = quadratic::describe_dynamic("boost-quadratic");
const peer peer_boost_rstar = rstar::describe_dynamic("boost-rstar");
