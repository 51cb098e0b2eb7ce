/* session_ids.h - which point has an id. Nobody but the session reader includes this. */
#ifndef RECORD_SESSION_IDS_H
#define RECORD_SESSION_IDS_H

#include "octree/game.h"

/* The id of a body, and its place in their list. */
typedef struct session_id {
    uint64_t id;
    size_t place;
} session_id;

/* The ids of at least one body, ascending, equal ones by their places. The caller frees them. Null when there is no
 * memory. Cost: O(count log count). */
session_id *session_ids_sorted(const octree_body *bodies, size_t count);

/* The entry of an id, or null. Cost: O(log count). */
const session_id *session_ids_find(const session_id *ids, size_t count, uint64_t id);

/* The first place whose id has an earlier place, which is written to *earlier; `count` when there is none.
 * Cost: O(count). */
size_t session_ids_repeated(const session_id *ids, size_t count, size_t *earlier);

#endif
