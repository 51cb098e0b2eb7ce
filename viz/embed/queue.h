/* queue.h - ticks on their way from the program's thread to the worker: bounded in number and in bytes. Private to this
 * folder. */
#ifndef EMBED_QUEUE_H
#define EMBED_QUEUE_H

#include "changes.h"

#include <pthread.h>

typedef struct queue {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    batch *first, *last;
    size_t count, bytes;
    size_t most, most_bytes;
    bool ended;     /* nothing more is put */
    bool broken;    /* nothing more is taken */
    uint64_t taken; /* batches that are done with */
} queue;

bool queue_init(queue *q, size_t most, size_t most_bytes);

/* Nobody may be waiting any more. */
void queue_release(queue *q);

/* Hand a batch over. Where there is no room for it, wait, or with `wait` false return BUSY; BROKEN where nobody takes
 * any more. On failure the batch stays the caller's. */
octreel_status queue_put(queue *q, batch *b, bool wait);

/* The next batch, which is the caller's, when there is one; null when the queue has ended. */
batch *queue_take(queue *q);

/* Tell that the batch that was taken last is done with. */
void queue_done(queue *q);

/* Wait until so many are, or the queue is broken. False then. */
bool queue_wait_done(queue *q, uint64_t count);

void queue_end(queue *q);

/* Drop what is in the queue, and all that comes. */
void queue_break(queue *q);

#endif
