/* SPDX-License-Identifier: MIT */
/* node_changes.h - why a node of a game's tree looks as it does: which split or merge made its cell, and which points
 * the last tick brought or took away.
 *
 * The problem: a tree keeps no history, and a tick lists its splits and merges, but not the points that it moved.
 *
 * The idea: for each address, keep the last split or merge there. Before each tick, store the positions of all points
 * that the tick may change: the bodies with a velocity, the bodies of the tick's edits, and the player. After the tick,
 * octree_locate() tells which of the old and new positions lie in a node.
 *
 * The cost: O(splits + merges + bodies with a velocity + edits) for each tick, and 32 bytes for each address at which a
 * node ever split or merged. So only the programs that explain nodes track the changes. */
#ifndef SCENE_NODE_CHANGES_H
#define SCENE_NODE_CHANGES_H

#include "array.h"
#include "hash_map.h"
#include "octree/game.h"

#include <stdbool.h>

/* A split or a merge of a node. A zeroed struct means no change. */
typedef struct node_change {
    octree_address node;
    uint64_t tick;
    size_t points; /* the number of points in the node after the tick; 0: the node no longer existed */
    bool split;    /* true: the node became an inner node; false: the node ceased to be an inner node */
} node_change;

/* A point before a tick. */
typedef struct earlier_point {
    uint64_t id;
    bool existed;
    double position[3]; /* valid if the point existed */
} earlier_point;

/* A zeroed struct tracks nothing. Set `tracked` at tick 0. */
typedef struct node_changes {
    bool tracked;
    node_change *items; /* the last change of each address */
    size_t room;
    hash_map places;             /* maps an address to the index of its change */
    ARRAY(earlier_point) before; /* the points that the last tick may have changed; a point can occur several times */
    size_t next_edit;            /* the index of the session's first edit after the last played tick */
} node_changes;

typedef ARRAY(uint64_t) id_list;

void node_changes_release(node_changes *c);

/* Store the points that the game's next tick may change. `input` is the input of that tick; if it is null, the session
 * has the input. Returns false if memory runs out. */
bool node_changes_begin_tick(node_changes *c, const octree_game *game, const octree_input *input);

/* Store the splits and merges of the game's last tick. Returns false if memory runs out. */
bool node_changes_end_tick(node_changes *c, const octree_game *game);

/* Returns the change that made the cell of a node: the last split of its parent or, if it is later, the merge of its
 * own children. All members are 0 if the cell has existed since tick 0. */
node_change node_changes_find_origin(const node_changes *c, octree_address node);

/* List the ids of the points that arrived in a node in the game's last tick, and of the points that left the node. Both
 * lists are in ascending order. The caller frees the items of both lists. Returns false if memory runs out. */
bool node_changes_list_points(const node_changes *c, const octree_game *game, const octree_node *node, id_list *arrived,
                              id_list *left);

/* Returns whether `address` is the address `node` or the address of one of its descendants. */
bool is_descendant_or_self(octree_address address, octree_address node);

#endif
