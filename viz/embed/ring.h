/* SPDX-License-Identifier: MIT */
/* ring.h - a ring buffer of a program's last ticks, recorded only on request. Private to this folder. */
#ifndef EMBED_RING_H
#define EMBED_RING_H

#include "session_filmer.h"

/* The last ticks: the points of the first, and for each later one its changes. */
typedef struct ring {
    size_t most;
    batch_list list;
    point_table start; /* the points at the first tick; its batch has no changes */
    uint64_t dropped;  /* count of ticks that the ring no longer has */
} ring;

/* A summary of refused ticks. */
typedef struct losses {
    uint64_t ticks, first;
    char why[OCTREE_GAP_TEXT]; /* reason for the first */
} losses;

void ring_release(ring *r);

/* Add a tick; a full ring drops its first. On success the ring owns the batch. False, with nothing changed, if out of
 * memory. Cost: O(changes). */
bool ring_put(ring *r, batch *b);

/* Sum up the gaps in the ring, numbered from its first tick; *ticks is the count of its ticks and gaps. */
losses ring_losses(const ring *r, uint64_t *ticks);

/* Record the ring into a folder, in a thread. Errors: those of session_filmer_join(). */
octreel_status ring_film(const ring *r, const filmer_settings *s, const char *folder, octreel_error *error);

#endif
