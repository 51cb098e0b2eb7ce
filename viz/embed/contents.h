/* SPDX-License-Identifier: MIT */
/* contents.h - reads the points of a program, which passes them as a tree, a list or changes, and finds what changed.
 * Private to viz/embed. */
#ifndef EMBED_CONTENTS_H
#define EMBED_CONTENTS_H

#include "track.h"
#include "octree/octree.h"

typedef enum points_source { FROM_NOTHING, FROM_TREE, FROM_SET, FROM_LIST, FROM_CHANGES } points_source;

/* The current points of a program. Every source of points is turned into changes since the last accepted tick. The
 * lists of the tracks are used for lists, for sets of bodies, and for trees in which many points change; their tables
 * for other trees and for changes. When the source of the points changes, the other way may be used from then on.
 * A zero-initialized struct has no points. */
typedef struct contents {
    /* `source`: where the points of the last accepted tick with points came from. `read_source`: where the points of
     * the tick that was read last came from. */
    points_source source, read_source;
    track tracks[TRACKS];
    points spare;       /* scratch memory */
    octree_cursor mark; /* cursor into the tree's change log; all earlier changes in the log have been read */
    uint64_t names;     /* counter for the names of log cursors; starts at a random number */
    /* True: the tree had so many changes at the last tick that reading all its points is faster than reading its
     * log. */
    bool many_changes;
    bool log_incomplete; /* true: memory ran out while changes of the log were applied */
} contents;

void contents_release(contents *c);

/* Read the points of a tick. `about` may be null. If some changes are invalid, the error names the first invalid
 * change, and the valid changes are kept for the next accepted tick. After any other error *c is as before. Errors:
 * NULL_ARGUMENT, TWO_SOURCES, OTHER_TREE, DUPLICATE_ID, BAD_ID, BAD_POINT, NO_POINT, NO_MEMORY. */
octreel_status contents_read(contents *c, const octree_def *def, const octree *tree, const octreel_tick_info *about,
                             octreel_error *error);

/* contents_move_changes_to_batch() moves the changes since the last accepted tick into a batch.
 * contents_move_changes_from_batch() moves these changes back if the batch could not be recorded. */
void contents_move_changes_to_batch(contents *c, batch *b);
void contents_move_changes_from_batch(contents *c, batch *b);

/* Accept or refuse the tick that was read last. `status` is the reason for a refusal. If the points of a refused tick
 * came as a list or a whole tree, these points are forgotten. If changes came from the program or from the tree's log,
 * these changes are kept for the next accepted tick, except after NO_MEMORY. */
void contents_accept_tick(contents *c);
void contents_refuse_tick(contents *c, octreel_status status);

#endif
