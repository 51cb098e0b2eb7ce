/* SPDX-License-Identifier: MIT */
/* must.h - calls of the library that cannot fail here. */
#ifndef TRADEOFF_MUST_H
#define TRADEOFF_MUST_H

#include "octree/octree.h"
#include "program.h"

/* Stop unless a call of the library was done. */
static inline void must(octree_status status)
{
    if (status != OCTREE_OK)
        stop_with_error("the library refuses: %s", octree_status_text(status));
}

#endif
