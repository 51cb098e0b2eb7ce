/* reel.h - ticks as they were handed over become a recording: those of the queue as they come, those of a ring when
 * they are wanted. One thread, from begin to end. Private to this folder. */
#ifndef EMBED_REEL_H
#define EMBED_REEL_H

#include "edit_order.h"
#include "film_live.h"
#include "settings.h"

typedef struct reel {
    film_live *film;
    edit_order order;
    uint64_t tick;
} reel;

/* Film tick 0 into a folder: these points, and the queries and shapes of a batch. Errors, with the sentence:
 * CANNOT_DRAW, BAD_FOLDER, NO_MEMORY; there is nothing to be ended then. */
octreel_status reel_begin(reel *r, const settings *s, const char *folder, const points *start, batch *first,
                          octreel_error *error);

/* Film the next tick. Errors: BROKEN. */
octreel_status reel_tick(reel *r, batch *b, octreel_error *error);

/* Complete the recording. Errors: BROKEN. */
octreel_status reel_end(reel *r, octreel_error *error);

#endif
