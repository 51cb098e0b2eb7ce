/* SPDX-License-Identifier: MIT */
/* change_many.h - what all changes of many bodies share. Private. */
#ifndef OCTREE_BODY_CHANGE_MANY_H
#define OCTREE_BODY_CHANGE_MANY_H

#include "set.h"

/* Check the arguments that all bulk calls share, and set *changed to 0. */
octree_status check_bulk(const octree_bodies *set, const octree_body *bodies, size_t count, size_t *changed);

/* Report the failure of a whole call in the status of each body. Returns the status. */
octree_status refuse_all(octree_status status, octree_status *statuses, size_t count);

/* Replace the contents of a set by the bodies of rows, perhaps its own, unless memory runs out. */
octree_status rebuild_from_rows(octree_bodies *set, const rows *r);

#endif
