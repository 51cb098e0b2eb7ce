/* SPDX-License-Identifier: MIT */
/* game_bodies.h - the bodies of a game, found by id: edits of bodies, and their motion. Private. */
#ifndef OCTREE_GAME_BODIES_H
#define OCTREE_GAME_BODIES_H

#include "../tree/pool.h"
#include "octree/game.h"

/* A body and its motion. The position is computed from the origin and the number of ticks since the motion started, not
 * from the position in the previous tick. */
typedef struct moving_body {
    uint64_t id;
    double position[3]; /* the position that the tree stores */
    double origin[3];
    double velocity[3];
    uint64_t since;   /* the tick at which the body was at the position `origin` */
    uint64_t moved;   /* the last tick that moved the body; UINT64_MAX: no tick has moved it */
    double before[3]; /* the position that the tree stored before the tick `moved` */
    /* the number of the last run of edits that moved the body (see bodies.runs); 0: no run has moved the body */
    size_t run;
    double half[3]; /* the half extents of its box */
} moving_body;

typedef struct bodies {
    list items; /* a list of moving_body */
    /* A hash table of ids with linear probing; a slot holds 1 + an index of `items`, or 0 if the slot is empty. */
    uint32_t *slots;
    size_t slot_count; /* the length of `slots`: a power of two, or 0 */
    size_t movers;     /* the number of bodies whose velocity is not zero */
    size_t extended;   /* the number of bodies whose half extents are not all zero */
    double reach[3];   /* the largest half extents, axis by axis */
    bool reach_stale;  /* true: `reach` may be too large, because a body with extent was removed */
    size_t runs;       /* the number of runs of edits so far; a run is a sequence of edits that move different bodies */
} bodies;

void bodies_release(bodies *b, arena *memory);

static inline moving_body *bodies_items(const bodies *b)
{
    return b->items.items;
}

/* Returns the body with an id, or null if no body has the id. The pointer is valid until a body is added or removed. */
moving_body *bodies_find(const bodies *b, uint64_t id);

/* Insert or move a point in the tree, and record the changed positions for the tree summary. Returns the status of
 * octree_insert() or octree_move(). */
octree_status game_insert_point(octree_game *game, const double position[3], uint64_t id);
octree_status game_move_point(octree_game *game, const double from[3], uint64_t id, const double to[3]);

/* Add a refusal to the tick. Returns false if memory runs out. */
bool game_record_refusal(octree_game *game, uint64_t id, octree_status why, const double position[3]);

/* Check whether a body can be inserted. Returns DUPLICATE if its id is in use, NOT_FINITE if its velocity or its
 * half extents are not finite, BAD_SIZE if a half extent is negative, otherwise OK. */
octree_status game_check_body(const octree_game *game, const octree_game_body *body);

/* Returns the status of game_check_body() that does not depend on the game: OK, NOT_FINITE or BAD_SIZE. */
octree_status check_numbers_of_body(const octree_game_body *body);

/* Add a body whose point is already in the tree if `status` is OK. Otherwise record that the body was refused, with
 * `status` as the reason. Returns false if memory runs out. */
bool game_add_body(octree_game *game, const octree_game_body *body, octree_status status);

/* The parts of a tick, in this order. game_apply_edits() applies the edits in order. game_list_movers() lists the
 * bodies with a velocity and where each is at this tick; no later part adds or removes a body. game_move_bodies() moves
 * these bodies. The three return false if memory runs out. game_settle_movers() gives each mover the position that the
 * tree stores, which is another one if a full leaf refused the move, and drops bodies whose path overflows
 * (reflect_path()), because they do not move. */
bool game_apply_edits(octree_game *game, const octree_input *input);
bool game_list_movers(octree_game *game);
bool game_move_bodies(octree_game *game);
void game_settle_movers(octree_game *game);

#endif
