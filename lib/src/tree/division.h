/* SPDX-License-Identifier: MIT */
/* division.h - a large batch divided into tasks: each has a batch of its own, which is a part of the whole one.
 *
 * Inside a part nothing is divided any further. What parts share they only read; statuses are written by place.
 */
#ifndef OCTREE_DIVISION_H
#define OCTREE_DIVISION_H

#include "batch.h"
#include "tasks.h"

/* A node that a task makes ahead of its parent's. */
typedef struct job {
    const node *old; /* null: it is built of what arrives */
    cell cell;
    span leaving, arriving;
    node made;
    bool ok;
} job;

/* A node that is replaced when the plan is carried out. */
typedef struct patch {
    node *at;
    node made;
} patch;

/* A leaf that is edited in its block. */
typedef struct edit {
    octree_point *points;
    uint32_t count; /* before */
    uint8_t room, room_left;
    span leaving, arriving;
} edit;

typedef struct part {
    batch batch;
    store store; /* while a batch is restructured */
} part;

typedef struct division {
    unsigned tasks;
    size_t grain;                     /* a job has at most so many items */
    list jobs;                        /* in the order in which their nodes are met */
    size_t next;                      /* of them */
    bool ready;                       /* they are done */
    size_t starts[TASKS_AT_MOST + 1]; /* those of each task */
    part parts[TASKS_AT_MOST];
} division;

/* Divide a batch if it is worth it, there is an executor, and there is memory. */
void division_begin(batch *b);
void division_end(batch *b);

/* Give the parts pools of their own, where about so many more points than before are `expected`; and join them. */
void division_open(batch *b, size_t expected);
void division_close(batch *b);

/* Run a task for each part, as it is now the batch but for the plan that it has made. */
void division_run(batch *b, octree_task *task, void *context);

/* Whether tasks have made a node of so many items; and the next of their nodes. */
bool is_job(const batch *b, size_t count);
bool take_job(batch *b, node *made);

/* Make the node of a cell that holds only the items; divided into tasks, where there are many. */
bool becomes_leaf(const batch *b, cell c, span items);
bool build_node(batch *b, cell c, span items, node *made);
bool build_divided(batch *b, cell c, span items, node *made);

/* Make a node's successor. False when there is no memory; *made then holds what was made. */
bool change_node(batch *b, const node *old, cell c, span leaving, span arriving, node *made);

/* Let a node have a successor. False when there is no memory; nothing is allocated then. */
bool plan_patch(batch *b, node *at, const node *made);

#endif
