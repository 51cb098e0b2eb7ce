/* SPDX-License-Identifier: MIT */
/* indexes.c - the indexes of this build. */
#include "index.h"

#include <stdio.h>

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

char *list_libraries(void)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    for (size_t i = 0; all_indexes[i]; i++)
        fprintf(out, "%s%s %s", i == 0 ? "" : ", ", all_indexes[i]->name, all_indexes[i]->version);
    if (*INDEX_LEFT_OUT)
        fprintf(out, "; not installed and left out:%s", INDEX_LEFT_OUT);
    fclose(out);
    return text;
}
