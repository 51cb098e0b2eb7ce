/* SPDX-License-Identifier: MIT */
/* division.h - a large batch divided into tasks.
 *
 * Problem: several threads change one tree. Locks on nodes would cost more than the changes, and the result must not
 * depend on timing.
 *
 * Idea: divide the sorted items at node boundaries, so that tasks own disjoint subtrees. Each task works on a part: a
 * copy of the batch with its own memory pools and its own plan. Parts only read shared data and write statuses of their
 * own points. Afterwards the pools are joined and the plans are carried out, in a fixed order. Cost: one list of jobs,
 * and two pools per task.
 */
#ifndef OCTREE_DIVISION_H
#define OCTREE_DIVISION_H

#include "batch.h"
#include "tasks.h"

/* The work of a task on one node. Either plan the node's successor before its parent is planned, or visit the leaves
 * below the node. */
typedef struct job {
    const node *old; /* null: there is no old node; build one from the arriving items */
    cell cell;       /* the node's cell; a job that visits leaves sets only its depth */
    span leaving, arriving;
    node made;
    bool ok;
} job;

typedef struct job_list {
    list jobs;   /* a list of job, in the order in which planning reaches their nodes */
    size_t next; /* the index of the next job whose result is used */
    bool ready;  /* true: all jobs are done, so their results can be used */
} job_list;

/* A node that is replaced when the plan is carried out. */
typedef struct patch {
    node *at;
    node made;
} patch;

/* A leaf that is edited in place when the plan is carried out. */
typedef struct edit {
    octree_point *points;
    uint32_t count;          /* the number of points before the edit */
    uint8_t room, room_left; /* the capacity of the block before and after the edit, in points */
    span leaving, arriving;
} edit;

typedef struct part {
    batch batch;
    store store; /* the part's own memory pools, used while a batch is restructured */
} part;

typedef struct division {
    unsigned tasks;
    size_t grain; /* the greatest number of items in a job */
    job_list work;
    leaf_visitor *visitor;            /* the function that visiting jobs call for each leaf */
    size_t starts[TASKS_AT_MOST + 1]; /* the index of the first job of each task */
    part parts[TASKS_AT_MOST];
} division;

/* Divide a batch into parts if it is large, there is an executor, and there is memory for the division. */
void create_division(batch *b);
void release_division(batch *b);

/* Create the memory pools of the parts, for `expected` additional points in all parts together. join_part_pools() later
 * joins these pools to the tree's pools. */
void create_part_pools(batch *b, size_t expected);
void join_part_pools(batch *b);

/* Run a task for each part. The task's context is the division. Each part becomes a copy of the batch but keeps its own
 * plan. */
void run_parts(batch *b, octree_task *task);

/* Add a job. False when there is no memory. */
bool add_job(batch *b, const node *old, cell c, span leaving, span arriving);

/* Give each task adjacent jobs with about the same number of items: set `starts`. */
void share_jobs(division *d);

/* Whether a job has planned a node with this many items. If so, take_job_result() stores that node in *made. Results
 * are taken in the order of the jobs. */
bool is_planned_by_job(const batch *b, size_t count);
bool take_job_result(batch *b, node *made);

/* must_be_leaf() is true if the items become a leaf. build_node() builds the node of a cell that holds only these
 * items. build_node_by_tasks() does the same, by tasks if there are many items. Both return false when there is no
 * memory. */
bool must_be_leaf(const batch *b, cell c, span items);
bool build_node(batch *b, cell c, span items, node *made);
bool build_node_by_tasks(batch *b, cell c, span items, node *made);

/* Make the successor of a node in *made. False when there is no memory; *made then holds the incomplete successor. */
bool change_node(batch *b, const node *old, cell c, span leaving, span arriving, node *made);

/* Add the successor of a node to the plan. False when there is no memory; the successor is then released. */
bool plan_replacement(batch *b, node *at, const node *made);

#endif
