/* live.h - ticks are filmed by a worker as they come. Private to this folder. */
#ifndef EMBED_LIVE_H
#define EMBED_LIVE_H

#include "queue.h"
#include "settings.h"
#include "worker.h"

typedef struct live {
    const settings *settings;
    const char *folder;
    queue queue;
    worker worker;
    uint64_t ticks; /* that were put */
    /* The worker's, until the queue is broken or the worker has ended. */
    octreel_status status;
    octreel_error error;
} live;

/* Start the worker. Errors: NO_MEMORY. */
octreel_status live_start(live *l, const settings *s, const char *folder, const octreel_recorder_def *def);

/* Hand a tick over, which is not the caller's any more; wait for the first to be filmed. Errors: BUSY, and those of
 * reel_begin() and reel_tick(), with the sentence in l->error. */
octreel_status live_put(live *l, batch *b, bool wait);

/* Film what is left and complete the recording. Errors: the first that there was. */
octreel_status live_end(live *l);

#endif
