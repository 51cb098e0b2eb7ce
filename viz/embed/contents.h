/* SPDX-License-Identifier: MIT */
/* contents.h - the points of a program, which it supplies as a tree, a list, or changes. Private to this folder. */
#ifndef EMBED_CONTENTS_H
#define EMBED_CONTENTS_H

#include "batch.h"
#include "octree/octree.h"

typedef enum points_source { FROM_NOTHING, FROM_TREE, FROM_LIST, FROM_CHANGES } points_source;

/* A cursor into the change log of the program's tree. */
typedef struct followed_tree {
    octree_cursor mark;   /* `now`, or the table, has the changes up to here; zero: there is no valid mark */
    uint64_t names;       /* count of names that were given to logs */
    octree_change *heard; /* the changes of the tick that was read last */
    size_t heard_count, heard_room;
    bool lost;  /* memory ran out for one of them */
    bool whole; /* the whole tree was read for a tick that is not accepted yet */
    bool busy;  /* many points changed in the last accepted tick: reading the whole tree is faster than its log */
} followed_tree;

/* The recorder needs the changes since the last accepted tick. There are two ways to them:
 *
 * - Whole contents: a tree or a list is read into `next` and compared with `now`, that of the last accepted tick. This
 *   costs O(n) at each tick.
 * - Changes: the program gives them, or its tree's change log does. `table` then holds the current points, and
 * `changes` all changes since the last accepted tick. This costs O(changes).
 *
 * A tree is read by its log while few of its points change; otherwise it is read whole, and the table is dropped.
 * Zero-initialized contents are empty. */
typedef struct contents {
    points_source source, read_source; /* of the last accepted tick with points, and of the tick that was read last */
    points now, next, spare;           /* of the last accepted tick, of the tick that is read, and scratch */
    bool tabled;
    point_table table;
    change *changes; /* since the last accepted tick, in the order in which they were made */
    size_t change_count, change_room;
    size_t settled; /* count after they were last reduced to one for each id */
    size_t kept;    /* count before the tick that was read last */
    followed_tree tree;
} contents;

void contents_release(contents *c);

/* Read a tick; `about` may be null. If some changes are invalid, the error is that of the first; the valid ones are
 * kept for the next accepted tick. On any other error nothing changes. Errors: NULL_ARGUMENT, TWO_SOURCES, OTHER_TREE,
 * DUPLICATE_ID, BAD_ID, BAD_POINT, NO_POINT, FLOAT_MODE, NO_MEMORY. */
octreel_status contents_read(contents *c, const octree_def *def, const octree *tree, const octreel_tick_info *about,
                             octreel_error *error);

/* Copy the changes since the last accepted tick into a batch. False if out of memory. */
bool contents_add_changes(contents *c, batch *b);

/* Mark the tick that was read last as accepted. */
void contents_accept(contents *c);

/* Revert the tick that was read last, after memory ran out, so that the program can give it again. */
void contents_undo(contents *c);

#endif
