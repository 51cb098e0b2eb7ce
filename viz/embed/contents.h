/* SPDX-License-Identifier: MIT */
/* contents.h - the points of a program, which it supplies as a tree, a list, or changes. Private to this folder. */
#ifndef EMBED_CONTENTS_H
#define EMBED_CONTENTS_H

#include "batch.h"
#include "octree/octree.h"

typedef enum points_source { FROM_NOTHING, FROM_TREE, FROM_LIST, FROM_CHANGES } points_source;

/* Every source becomes `changes`: what changed since the last accepted tick.
 *
 * - A list, and a tree of which many points change, is read whole into `next` and compared with `now`, at O(n). This
 *   takes a third of the time that looking up each point in a table would take.
 * - Edits of the program, and the change log of its tree, are applied to `table`, which has the points of the tick
 *   that was read last, at O(changes).
 *
 * Either the lists or the table are in use; contents change over when the source does. Zero-initialized contents are
 * empty. */
typedef struct contents {
    points_source source, read_source; /* of the last accepted tick with points, and of the tick that was read last */
    points now, next, spare;           /* before the tick that was read last, at this tick, and scratch */
    bool tabled;
    point_table table;
    change *changes; /* in the order in which they were made */
    size_t change_count, change_room;
    size_t settled;      /* count after they were last reduced to one for each id */
    size_t kept;         /* count before the tick that was read last */
    octree_cursor mark;  /* in the tree's log: the points were read up to here */
    uint64_t names;      /* the number of names that were given to logs, from a random start */
    bool many_changes;   /* of the tree in the tick that was read last: reading it whole is then faster than a log */
    bool log_incomplete; /* memory ran out for a change of the log */
} contents;

void contents_release(contents *c);

/* Read a tick; `about` may be null. If some changes are invalid, the error is that of the first; the valid ones are
 * kept for the next accepted tick. On any other error nothing changes. Errors: NULL_ARGUMENT, TWO_SOURCES, OTHER_TREE,
 * DUPLICATE_ID, BAD_ID, BAD_POINT, NO_POINT, NO_MEMORY. */
octreel_status contents_read(contents *c, const octree_def *def, const octree *tree, const octreel_tick_info *about,
                             octreel_error *error);

/* Move the changes since the last accepted tick into a batch, or back if the batch is not recorded. */
void contents_give_changes(contents *c, batch *b);
void contents_take_changes(contents *c, batch *b);

/* Mark the tick that was read last as accepted or, with the status of its error, as refused. A list or a whole tree is
 * then forgotten. Edits and logged changes stay for the next accepted tick, except after NO_MEMORY. */
void contents_accept(contents *c);
void contents_refuse(contents *c, octreel_status status);

#endif
