/* SPDX-License-Identifier: MIT */
/* division.h - divides a large batch into tasks.
 *
 * Problem: several threads change one tree. Locks on nodes would cost more than the changes, and the result must not
 * depend on timing.
 *
 * Idea: sort the items (a point's Morton code and index), and divide them at the boundaries of nodes, so that tasks own
 * disjoint subtrees. Each task works on a part: a copy of the batch with its own memory pools and its own plan. Parts
 * only read shared data and write statuses of their own points. Afterwards the pools are joined and the plans are
 * carried out, in a fixed order. Cost: one list of jobs, and two pools per task.
 */
#ifndef OCTREE_DIVISION_H
#define OCTREE_DIVISION_H

#include "batch.h"
#include "tasks.h"

/* The work of a task on one node: either to plan the node's successor (the node that replaces it), or to visit the
 * leaves below the node. */
typedef struct job {
    /* the node before the batch; null: there is no old node, and a new node is built from the arriving items */
    const node *old;
    cell cell; /* the node's cell; in a job that visits leaves only its depth is set */
    span leaving, arriving;
    node made;
    bool ok;
} job;

typedef struct job_list {
    list jobs;   /* a list of struct job, in the order in which the planning reaches the jobs' nodes */
    size_t next; /* the index of the next job whose result will be used */
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
    uint32_t count;          /* the number of points in the leaf before the edit */
    uint8_t room, room_left; /* the capacity of the leaf's block before the edit, and after it, in points */
    span leaving, arriving;
} edit;

typedef struct part {
    batch batch;
    store store; /* the part's own memory pools, used while a batch is restructured */
} part;

typedef struct division {
    unsigned tasks;
    size_t grain; /* the maximum number of items in a job */
    job_list work;
    leaf_visitor *visitor;            /* the function that jobs call for each leaf, if they visit leaves */
    size_t starts[TASKS_AT_MOST + 1]; /* the index of the first job of each task */
    part parts[TASKS_AT_MOST];
} division;

/* Divide a batch into parts if the batch is large, if the tree has an executor, and if there is enough memory. */
void divide_work_of_batch(batch *b);
void release_work_division(batch *b);

/* Create the memory pools of the parts. All parts together expect to store `expected` additional points.
 * join_part_pools() later joins these pools to the tree's pools. */
void create_part_pools(batch *b, size_t expected);
void join_part_pools(batch *b);

/* Run a task for each part. The task's context is the division. Each part becomes a copy of the batch, but keeps its
 * own plan. */
void run_task_for_each_part(batch *b, octree_task *task);

/* Add a job. Returns false if memory runs out. */
bool add_job(batch *b, const node *old, cell c, span leaving, span arriving);

/* Assign the jobs to the tasks: set `starts`, so that each task gets adjacent jobs with about the same number of
 * items. */
void assign_jobs_to_tasks(division *d);

/* is_planned_by_job() returns whether a job has planned the successor of a node with this many items. If so,
 * get_next_job_result() stores the successor in *made and returns true. Each call gets the result of the next job, so
 * the nodes must be reached in the order of the jobs. */
bool is_planned_by_job(const batch *b, size_t count);
bool get_next_job_result(batch *b, node *made);

/* must_be_leaf() returns whether the items become a leaf. build_node() builds the node of a cell that holds only these
 * items. build_node_by_tasks() does the same, by tasks if there are many items. Both build functions return false if
 * memory runs out. */
bool must_be_leaf(const batch *b, cell c, span items);
bool build_node(batch *b, cell c, span items, node *made);
bool build_node_by_tasks(batch *b, cell c, span items, node *made);

/* Make the successor of a node in *made. Returns false if memory runs out; *made is then incomplete. */
bool change_node(batch *b, const node *old, cell c, span leaving, span arriving, node *made);

/* Add to the plan that *made replaces the node `at`. Returns false if memory runs out; *made is then released. */
bool plan_replacement(batch *b, node *at, const node *made);

#endif
