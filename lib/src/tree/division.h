/* SPDX-License-Identifier: MIT */
/* division.h - a large batch divided into tasks.
 *
 * Problem: several threads change one tree. Locks on nodes would cost more than the changes, and the result must not
 * depend on timing. Idea: divide the sorted items at node boundaries, so that tasks own disjoint subtrees. Each task
 * works on a part: a copy of the batch with its own memory pools and its own plan. Parts only read shared data and
 * write statuses of their own points. Afterwards the pools are joined and the plans are carried out, in a fixed order.
 * Cost: one list of jobs, and two pools per task.
 */
#ifndef OCTREE_DIVISION_H
#define OCTREE_DIVISION_H

#include "batch.h"
#include "tasks.h"

/* Work of a task on one node: to plan its successor before its parent is planned, or to visit the leaves below it. */
typedef struct job {
    const node *old; /* null: build a node from the arriving items */
    cell cell;       /* of a visit only the depth is set */
    span leaving, arriving;
    node made;
    bool ok;
} job;

typedef struct job_list {
    list jobs;   /* in the order in which planning reaches their nodes */
    size_t next; /* index of the next job whose result is used */
    bool ready;  /* all jobs are done, so that results can be used */
} job_list;

/* A node that is replaced when the plan is carried out. */
typedef struct patch {
    node *at;
    node made;
} patch;

/* A leaf that is edited in place when the plan is carried out. */
typedef struct edit {
    octree_point *points;
    uint32_t count;          /* points before the edit */
    uint8_t room, room_left; /* the capacity of the block before and after the edit, in points */
    span leaving, arriving;
} edit;

typedef struct part {
    batch batch;
    store store; /* the part's own pools, while a batch is restructured */
} part;

typedef struct division {
    unsigned tasks;
    size_t grain; /* the greatest number of items of a job */
    job_list work;
    leaf_visitor *visitor;            /* set while jobs are visits */
    size_t starts[TASKS_AT_MOST + 1]; /* index of the first job of each task */
    part parts[TASKS_AT_MOST];
} division;

/* Divide a batch if it is large, there is an executor, and there is memory. */
void create_division(batch *b);
void release_division(batch *b);

/* Create the pools of the parts, sized for `expected` additional points in all. Afterwards join them to the tree's. */
void create_part_pools(batch *b, size_t expected);
void join_part_pools(batch *b);

/* Run a task for each part, with the division as its context. Each part becomes a copy of the batch and keeps its own
 * plan. */
void run_parts(batch *b, octree_task *task);

/* Add a job. False when there is no memory. */
bool add_job(batch *b, const node *old, cell c, span leaving, span arriving);

/* Set `starts`: each task gets adjacent jobs with about the same number of items. */
void share_jobs(division *d);

/* Whether a job has planned a node with this many items. If so, take_job_result() stores that node; jobs are taken in
 * order. */
bool is_planned_by_job(const batch *b, size_t count);
bool take_job_result(batch *b, node *made);

/* Whether items become a leaf; build the node of a cell that holds only these items; build it by tasks if there are
 * many. */
bool must_be_leaf(const batch *b, cell c, span items);
bool build_node(batch *b, cell c, span items, node *made);
bool build_node_by_tasks(batch *b, cell c, span items, node *made);

/* Make the successor of a node. False when there is no memory; *made then holds the incomplete successor. */
bool change_node(batch *b, const node *old, cell c, span leaving, span arriving, node *made);

/* Add the successor of a node to the plan. False when there is no memory; the successor is then released. */
bool plan_replacement(batch *b, node *at, const node *made);

#endif
