/* ring.h - the last ticks, as they were handed over: the points of the first of them, and the changes since. Private to
 * this folder. */
#ifndef EMBED_RING_H
#define EMBED_RING_H

#include "session_filmer.h"

typedef struct ring {
    size_t most;
    batch_list list;
    points start, spare; /* at the first tick; its batch has no changes */
    uint64_t dropped;    /* ticks that are no longer in it */
} ring;

void ring_release(ring *r);

/* Take a tick over; where there are enough the first goes. False when there is no memory: then nothing has changed, and
 * the batch stays the caller's. Cost: O(points), once a tick is dropped. */
bool ring_put(ring *r, batch *b);

/* Film it all into a folder, in a thread. Errors: those of session_filmer_join(). */
octreel_status ring_write(ring *r, const filmer_settings *s, const char *folder, octreel_error *error);

#endif
