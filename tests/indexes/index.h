/* SPDX-License-Identifier: MIT */
/* index.h - one interface for spatial indexes whose answers are measured: Octreel's and those of other libraries, each
 * as its library comes, without corrections.
 *
 * To add an index, write a file index_NAME.cpp or index_NAME.c that defines `const spatial_index index_NAME`;
 * index_nanoflann.cpp is a short example, and index.hpp makes the functions from a class. Then configure with
 *     cmake -DOCTREEL_INDEXES="/path/index_NAME.cpp" -DOCTREEL_INDEX_INCLUDES="/path/of/its/headers"
 * Both options are lists, separated by semicolons. test_indexes checks the answers of each index. */
#ifndef INDEX_H
#define INDEX_H

#include "more_indexes.h" /* INDEX_MORE and INDEX_LEFT_OUT, which CMake writes */
#include "octree/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The number of ids that an index returns if it refuses a query. */
#define INDEX_REFUSED SIZE_MAX

typedef struct spatial_index {
    const char *name;
    const char *version;        /* of its library */
    octree_precision precision; /* of its coordinates and distances */
    unsigned kinds;             /* bit mask 1 << octree_query_kind: the queries that it answers */
    bool approximates;          /* false: it ignores octree_query.epsilon */
    /* Build an index of points with different ids in a world. `capacity`: points of a leaf; 0: the library's default.
     * Returns null if the library refuses the points or memory runs out. The points outlive the index. */
    void *(*create)(const octree_point *points, size_t count, const octree_box *world, size_t capacity);
    void (*destroy)(void *self);
    /* Answer a query. Stores at most `room` ids. Returns the number of ids of the answer, or INDEX_REFUSED. The epsilon
     * of a query for neighbours is passed to the library, whatever it means there. */
    size_t (*ask)(const void *self, const octree_query *query, uint64_t *ids, size_t room);
} spatial_index;

/* All indexes of this build, in the order of tables; null ends the list. */
extern const spatial_index *const all_indexes[];

/* The names and versions of all indexes, such as "octreel 0.1.0, ann 1.1.2", and the names of those that were not
 * installed. Must be freed; null if memory runs out. */
char *list_libraries(void);

extern const spatial_index index_octreel, index_nanoflann, index_nanoflann_float, index_flann, index_flann_float,
    index_ann, index_cgal, index_boost, index_kdtree;

#define INDEX_DECLARE(name) extern const spatial_index index_##name;
INDEX_MORE(INDEX_DECLARE)

#ifdef __cplusplus
}
#endif

#endif
