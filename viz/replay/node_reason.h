/* SPDX-License-Identifier: MIT */
/* node_reason.h - explains a node at a tick: how full it is, which points the tick brought or took away, and which
 * split or merge made its cell. `octreel pick` and the page print the same explanation. */
#ifndef REPLAY_NODE_REASON_H
#define REPLAY_NODE_REASON_H

#include "json_write.h"
#include "tick_scene.h"

typedef struct node_reason {
    uint64_t tick;
    size_t points, capacity;
    bool split; /* true: the node split at this tick */
    /* The points that entered the node at this tick, and the points that left it; empty at tick 0; owned. */
    id_list arrived, left;
    node_change maker; /* the split or merge that made the node's cell; zero: the cell has existed since tick 0 */
} node_reason;

/* Returns true if the node can be explained: it is a leaf, or it split at the game's last tick. */
bool has_node_reason(const octree_game *game, const octree_node *node);

/* Explain a node of the game's last tick. `changes` must contain all splits and merges since tick 0. Returns false if
 * memory runs out. Call node_reason_release() in either case. */
bool node_reason_find(node_reason *r, const octree_game *game, const node_changes *changes, const octree_node *node);
void node_reason_release(node_reason *r);

/* Append the explanation to a printed sentence about the node: "; capacity 2; point 5 arrived at this tick; ...". */
void node_reason_print(FILE *out, const node_reason *r);

/* Write the explanation as members of a JSON object. */
void node_reason_write(json_writer *w, const node_reason *r);

#endif
