/* SPDX-License-Identifier: MIT */
// index.hpp - makes a spatial_index from a class with the members
//     Index(const octree_point *points, size_t count, size_t capacity)
//     size_t nearest(const double at[3], size_t k, double epsilon, uint64_t *ids) const
//     void ball(const double center[3], double radius, id_list &ids) const
//     void box(const octree_box &box, id_list &ids) const
// A class that derives from index_base may omit the queries that its library does not have. Exceptions are refusals.
#ifndef INDEX_HPP
#define INDEX_HPP

#include "index.h"

// The ids of an answer. It counts all ids, and stores those for which there is room.
struct id_list {
    uint64_t *ids;
    size_t room, count;

    void add(uint64_t id)
    {
        if (count < room)
            ids[count] = id;
        count++;
    }
};

// An output iterator that adds the ids of the entries that a search writes. `Id` is the member with the id.
template <class Entry, uint64_t Entry::*Id> struct id_output {
    id_list *list;

    id_output &operator=(const Entry &found)
    {
        list->add(found.*Id);
        return *this;
    }
    id_output &operator*()
    {
        return *this;
    }
    id_output &operator++()
    {
        return *this;
    }
    id_output operator++(int)
    {
        return *this;
    }
};

struct index_base {
    size_t nearest(const double[3], size_t, double, uint64_t *) const
    {
        return INDEX_REFUSED;
    }
    void ball(const double[3], double, id_list &) const
    {
        throw INDEX_REFUSED;
    }
    void box(const octree_box &, id_list &) const
    {
        throw INDEX_REFUSED;
    }
};

enum : unsigned {
    INDEX_NEAREST = 1u << OCTREE_QUERY_NEAREST,
    INDEX_NEIGHBORS = INDEX_NEAREST | 1u << OCTREE_QUERY_KNEAREST,
    INDEX_BALL = 1u << OCTREE_QUERY_RADIUS,
    INDEX_BOX = 1u << OCTREE_QUERY_RANGE,
};

template <class Index> struct index_of {
    static void *create(const octree_point *points, size_t count, const octree_box *, size_t capacity) noexcept
    try {
        return new Index(points, count, capacity);
    } catch (...) {
        return nullptr;
    }

    static void destroy(void *self)
    {
        delete static_cast<Index *>(self);
    }

    static size_t ask(const void *self, const octree_query *query, uint64_t *ids, size_t room) noexcept
    try {
        const Index &index = *static_cast<const Index *>(self);
        id_list list{ids, room, 0};
        if (query->kind == OCTREE_QUERY_RADIUS)
            index.ball(query->target, query->radius, list);
        else if (query->kind == OCTREE_QUERY_RANGE)
            index.box(query->box, list);
        else
            list.count =
                index.nearest(query->target, query->kind == OCTREE_QUERY_NEAREST ? 1 : query->k, query->epsilon, ids);
        return list.count;
    } catch (...) {
        return INDEX_REFUSED;
    }

    static spatial_index describe(const char *name, const char *version, octree_precision precision, unsigned kinds,
                                  bool approximates)
    {
        return {name, version, precision, kinds, approximates, create, destroy, ask};
    }
};

#endif
