/* SPDX-License-Identifier: MIT */
/* ring.h - a ring buffer that keeps a program's last ticks in memory. These ticks are recorded only on request. Private
 * to viz/embed. */
#ifndef EMBED_RING_H
#define EMBED_RING_H

#include "session_filmer.h"

/* The last ticks of a program: all points at the first tick of the ring, and the changes of each later tick. */
typedef struct ring {
    size_t most; /* the maximum number of ticks in the ring */
    batch_list list;
    /* all points at the ring's first tick, so that the batch of this tick needs no changes */
    point_table start[TRACKS];
    uint64_t dropped; /* number of ticks that were dropped from the ring */
} ring;

/* A summary of refused ticks: the number of refused ticks, and the tick number and the reason of the first. */
typedef struct losses {
    uint64_t ticks, first;
    char why[OCTREE_GAP_TEXT]; /* reason why the first of the refused ticks was refused */
} losses;

void ring_release(ring *r);

/* Add a tick. A full ring drops its first tick. On success the ring owns the batch. Returns false and changes nothing
 * if memory runs out. Cost: O(changes). */
bool ring_put(ring *r, batch *b);

/* Summarize the gaps in the ring. The first tick of the ring counts as tick 0. *ticks becomes the number of ticks and
 * gaps in the ring. */
losses ring_sum_losses(const ring *r, uint64_t *ticks);

/* Record the ring into a folder. Another thread records, and this function waits until the thread has ended. Errors:
 * the errors of session_filmer_join(). */
octreel_status ring_film(const ring *r, const filmer_settings *s, const char *folder, octreel_error *error);

#endif
