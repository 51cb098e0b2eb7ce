/* SPDX-License-Identifier: MIT */
/* contents.h - what points a program has, in whichever way it says so: by a tree, a list, or what changed. Private to
 * this folder. */
#ifndef EMBED_CONTENTS_H
#define EMBED_CONTENTS_H

#include "batch.h"
#include "octree/octree.h"

typedef enum points_source { FROM_NOTHING, FROM_TREE, FROM_LIST, FROM_CHANGES } points_source;

/* What a tree tells of its changes. */
typedef struct followed_tree {
    octree_cursor mark;   /* up to where `now`, or the table, has them; zero: it has not */
    uint64_t names;       /* of logs, that were given */
    octree_change *heard; /* in the tick that was read last */
    size_t heard_count, heard_room;
    bool lost;  /* there was no memory for one of them */
    bool whole; /* all of it was looked at, and that tick is not taken yet */
    bool busy;  /* much of it changed in the tick that was taken last: it is not asked */
} followed_tree;

/* Trees and lists are compared with what was taken last. Once a program has told of changes, or its tree has, there is
 * a table instead, which is what the program has now, and what changed in it since a tick was taken. A tree tells while
 * few of its points change in a tick; else all of it is looked at, and the table goes again. A zeroed one is empty. */
typedef struct contents {
    points_source source, read_source; /* of the last tick that had points and was taken, and of the one read last */
    points now, next, spare;           /* at the last tick that was taken, and while one is being read */
    bool tabled;
    point_table table;
    change *changes; /* in the order in which they were made */
    size_t change_count, change_room;
    size_t settled; /* so many were left when they were settled last */
    size_t kept;    /* so many were there before the tick that was read last */
    followed_tree tree;
} contents;

void contents_release(contents *c);

/* Read a tick; `about` may be null. Where a change cannot be made the sentence is that of the first, and the others are
 * made: they come with the next tick that is taken. Of a tick that is refused for anything else in here nothing is
 * made. Errors: NULL_ARGUMENT, TWO_SOURCES, OTHER_TREE, DUPLICATE_ID, BAD_ID, BAD_POINT, NO_POINT, FLOAT_MODE,
 * NO_MEMORY. */
octreel_status contents_read(contents *c, const octree_def *def, const octree *tree, const octreel_tick_info *about,
                             octreel_error *error);

/* Let a batch have what changed since the last tick that was taken. False when there is no memory. */
bool contents_add_changes(contents *c, batch *b);

/* The tick that was read last is taken. */
void contents_take(contents *c);

/* It is not, for lack of memory: unmake its changes, so that it can be handed over again. */
void contents_undo(contents *c);

#endif
