/* SPDX-License-Identifier: MIT */
/* bodies.h - the points of a game by id: edits, and where their velocities take them. Private. */
#ifndef OCTREE_BODIES_H
#define OCTREE_BODIES_H

#include "pool.h"
#include "octree/game.h"

/* A body's place is computed from its origin and the ticks since then, never by adding tick by tick. */
typedef struct moving_body {
    uint64_t id;
    double position[3]; /* as stored in the tree */
    double origin[3];
    double velocity[3];
    uint64_t since;   /* the tick of the origin */
    uint64_t moved;   /* the last tick that moved it; UINT64_MAX before there is one */
    double before[3]; /* where it was stored before that tick */
} moving_body;

typedef struct bodies {
    list items;        /* moving_body */
    uint32_t *slots;   /* index + 1 by hash of id, or 0; open addressing with linear probing */
    size_t slot_count; /* a power of two, or 0 */
    size_t movers;     /* bodies whose velocity is not zero */
} bodies;

void bodies_release(bodies *b, arena *memory);

static inline moving_body *bodies_items(const bodies *b)
{
    return b->items.items;
}

/* The body with this id, or null. */
moving_body *bodies_find(const bodies *b, uint64_t id);

/* Change the tree: as octree_insert() and octree_move(). */
octree_status game_insert(octree_game *game, const double position[3], uint64_t id);
octree_status game_move(octree_game *game, const double from[3], uint64_t id, const double to[3]);

/* Note that the tree did not take a body. NO_MEMORY, or OK. */
octree_status game_note_refusal(octree_game *game, uint64_t id, octree_status why, const double position[3]);

/* Whether a body may be inserted at all: DUPLICATE for an id that is taken, NOT_FINITE for its velocity, OK. */
octree_status game_check_body(const octree_game *game, const octree_body *body);

/* Add a body that is in the tree, or note its refusal with this status, which is returned; or NO_MEMORY. */
octree_status game_add_body(octree_game *game, const octree_body *body, octree_status status);

octree_status game_apply_edits(octree_game *game, const octree_input *input);

/* Move the bodies by their velocities, and list those that have one as they are after the tick. */
octree_status game_move_bodies(octree_game *game);
octree_status game_list_movers(octree_game *game);

#endif
