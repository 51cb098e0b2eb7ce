/* bodies.h - the points of a game by id, and where their velocities take them. Private. */
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
    arena *memory;
    list items;        /* moving_body */
    uint32_t *slots;   /* index + 1 by hash of id, or 0; open addressing with linear probing */
    size_t slot_count; /* a power of two, or 0 */
    size_t movers;     /* bodies whose velocity is not zero */
} bodies;

void bodies_release(bodies *b);

static inline moving_body *bodies_items(const bodies *b)
{
    return b->items.items;
}

/* Whether a velocity is one, and whether it can be told at all. */
bool is_moving(const double velocity[3]);
bool is_finite_velocity(const double velocity[3]);

/* The body with this id, or null. */
moving_body *bodies_find(const bodies *b, uint64_t id);

/* Add a body that is not there yet, at rest at its position at this tick. False when there is no memory. */
bool bodies_add(bodies *b, const octree_body *body, uint64_t tick);

/* Take a body out; the last one takes its place. */
void bodies_remove(bodies *b, moving_body *body);

/* Note that a body is stored elsewhere from this tick on. */
void body_store(moving_body *body, const double to[3], uint64_t tick);

/* Where the body is at a tick: reflected at the world's faces as often as it must be. */
void body_position(const moving_body *body, const octree_box *world, uint64_t tick, double position[3]);

/* The velocity with which it goes on from there: turned on an axis where it has bounced, and where it is about to. */
void body_velocity(const moving_body *body, const octree_box *world, uint64_t tick, double velocity[3]);

#endif
