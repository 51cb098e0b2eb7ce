/* SPDX-License-Identifier: MIT */
/* ring.h - the last ticks of a program, kept until they are wanted. Private to this folder. */
#ifndef EMBED_RING_H
#define EMBED_RING_H

#include "session_filmer.h"

/* The last ticks, as they were handed over: the points of the first of them, and the changes since. */
typedef struct ring {
    size_t most;
    batch_list list;
    point_table start; /* the points at the first tick; its batch has no changes */
    uint64_t dropped;  /* ticks that are no longer in it */
} ring;

/* Ticks that were refused. */
typedef struct losses {
    uint64_t ticks, first;
    char why[OCTREE_GAP_TEXT]; /* of the first */
} losses;

void ring_release(ring *r);

/* Take a tick over; where there are enough the first goes. False when there is no memory: then nothing has changed, and
 * the batch stays the caller's. Cost: O(changes). */
bool ring_put(ring *r, batch *b);

/* The gaps of its ticks, numbered from the first of them on; and how many ticks there are with them. */
losses ring_losses(const ring *r, uint64_t *ticks);

/* Film it all into a folder, in a thread. Errors: those of session_filmer_join(). */
octreel_status ring_film(const ring *r, const filmer_settings *s, const char *folder, octreel_error *error);

#endif
