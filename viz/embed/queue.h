/* SPDX-License-Identifier: MIT */
/* queue.h - the queue of ticks from the program's thread to the recording thread, bounded in count and in bytes.
 * Private to this folder. */
#ifndef EMBED_QUEUE_H
#define EMBED_QUEUE_H

#include "batch.h"

#include <pthread.h>

typedef struct queue {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    batch_list list;
    size_t most, most_bytes;
    bool borrowed; /* the queue does not own the batches */
    bool ended;    /* no more batches will be added */
    bool broken;   /* recording failed: no more batches are taken */
    bool begun;    /* the recording's folder exists */
} queue;

bool queue_init(queue *q, size_t most, size_t most_bytes);

/* No thread may be waiting on the queue. */
void queue_release(queue *q);

/* Add a batch. If the queue is full, wait, or return BUSY if `wait` is false. Returns BROKEN after a failure of the
 * recording. On failure the caller still owns the batch. */
octreel_status queue_put(queue *q, batch *b, bool wait);

/* Wait for the next batch and remove it; null after the queue has ended. */
batch *queue_take(queue *q);

/* Release the batch that was taken last, after it was recorded. */
void queue_done(queue *q, batch *b);

/* Signal that the recording has begun. */
void queue_begin(queue *q);

/* Wait until the recording has begun. False if the queue is broken. */
bool queue_wait_begun(queue *q);

void queue_end(queue *q);

/* Signal a failure: drop the batch that was taken last, the queue, and all later batches. */
void queue_break(queue *q, batch *b);

#endif
