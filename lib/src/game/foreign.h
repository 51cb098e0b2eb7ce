/* SPDX-License-Identifier: MIT */
/* foreign.h - a program's own tree in a game: its nodes, and what is wrong with them. Private. */
#ifndef OCTREE_FOREIGN_STATE_H
#define OCTREE_FOREIGN_STATE_H

#include "judge.h"
#include "octree/game.h"
#include "pool.h"

/* A node by its id. */
typedef struct foreign_key {
    uint64_t id;
    size_t place;
} foreign_key;

/* A point by its id, and the place of a node that lists it. */
typedef foreign_key foreign_holding;

/* What the query that is asked at the moment says of a node. */
typedef struct foreign_mark {
    uint64_t query; /* which: foreign.query; else nothing */
    octree_met met;
    bool blamed;
} foreign_mark;

/* The nodes in force, and what is known of them. All zero before there are any. */
typedef struct foreign {
    octree_foreign_node *nodes; /* a copy, one block with the ids of their points */
    size_t size;                /* of it, in bytes */
    list places;                /* octree_foreign_place */
    list keys;                  /* foreign_key, by id */
    list marks;                 /* foreign_mark, by place */
    list holdings;              /* foreign_holding, by point and then place */
    list kinds;                 /* char[OCTREE_NODE_KIND] */
    list repeated;              /* foreign_holding: points that their nodes list more than once */
    list faults;                /* octree_node_fault */
    list met;                   /* size_t: the places that the tick's queries met, some twice */
    list lost;                  /* room for uint64_t: ids of points that nobody holds */
    list held;                  /* room for bool, by place of the body */
    size_t standing;            /* the first faults: those that are so without any query */
    size_t standing_counts[OCTREE_NODE_FAULTS];
    uint64_t query;   /* counts the queries that met nodes */
    uint64_t version; /* of the tree that the standing faults are about */
    bool checked;
} foreign;

/* What the places of these nodes, their keys and the order of their parents are; an error as octree_foreign_check has
 * it. */
octree_status foreign_index(arena *memory, const octree_foreign_tree *tree, list *places, list *keys, size_t *fault);

/* Put a tree in force. NO_MEMORY, or OK. */
octree_status foreign_install(octree_game *game, const octree_foreign_tree *tree);
void foreign_release(foreign *f, arena *memory);

/* The place of a node by its id; SIZE_MAX where there is none. */
size_t foreign_find(const foreign *f, uint64_t id);

/* Whether a node's box has a position, by the node's precision. */
bool foreign_holds(const octree_foreign_node *node, const double position[3]);

/* Forget what the last tick's queries met. */
void foreign_begin_tick(octree_game *game);

/* After all changes of a tick: find what is wrong with the nodes by themselves. NO_MEMORY, or OK. Cost: O(n log n) for
 * n nodes and points that they list, where the tree or the nodes have changed; where leaves list no points, that of a
 * range search for each of them. */
octree_status foreign_check(octree_game *game);

/* Note how a query met the nodes, and what is wrong with that. NO_MEMORY, or OK. */
octree_status foreign_meet(const judging *about);

/* Whether a query says what can be judged by the true answer alone. */
static inline bool query_is_judged(const octree_query *query)
{
    return query->answered || query->met[OCTREE_MET_PRUNED].count > 0;
}

/* Show it in the tick; the lists do not grow any more. */
void foreign_publish(octree_game *game);

#endif
