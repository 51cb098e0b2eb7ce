/* SPDX-License-Identifier: MIT */
/* indexes.c - the indexes of this build. */
#include "index.h"

#include <stddef.h>

const spatial_index *const all_indexes[] = {
    &index_octreel,
#ifdef INDEX_NANOFLANN
    &index_nanoflann,
    &index_nanoflann_float,
#endif
#ifdef INDEX_FLANN
    &index_flann,
    &index_flann_float,
#endif
#ifdef INDEX_ANN
    &index_ann,
#endif
#ifdef INDEX_CGAL
    &index_cgal,
#endif
#ifdef INDEX_BOOST
    &index_boost,
#endif
#ifdef INDEX_KDTREE
    &index_kdtree,
#endif
#define INDEX_ADDRESS(name) &index_##name,
    INDEX_MORE(INDEX_ADDRESS) NULL,
};
