/* SPDX-License-Identifier: MIT */
/* queue.h - the queue of ticks from the program's thread to the recording thread. The number of ticks and their bytes
 * are limited. Private to viz/embed. */
#ifndef EMBED_QUEUE_H
#define EMBED_QUEUE_H

#include "batch.h"

#include <pthread.h>

typedef struct queue {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    batch_list list;
    size_t most, most_bytes; /* the maximum number of batches in the queue, and the maximum of their bytes */
    bool borrowed;           /* true: the ring owns the batches and releases them */
    bool ended;              /* true: no more batches will be added */
    bool broken;             /* true: recording has failed, and no more batches are accepted */
} queue;

bool queue_init(queue *q, size_t most, size_t most_bytes);

/* Release the queue. No thread may be waiting for the queue. */
void queue_release(queue *q);

/* Add a batch. If the queue is full, wait until it has room, or return BUSY if `wait` is false. Returns BROKEN if the
 * recording has failed. If the result is not OK, the caller still owns the batch. */
octreel_status queue_put(queue *q, batch *b, bool wait);

/* Wait for the next batch and remove it from the queue. Returns null once the queue has ended and is empty. */
batch *queue_wait_for_batch(queue *q);

/* Release the batch that queue_wait_for_batch() returned last. Call this function after the batch is recorded. */
void queue_finish_batch(queue *q, batch *b);

/* Declare that no more batches will be added. The recording thread ends after the last batch. */
void queue_end(queue *q);

/* Wake the waiting threads because the recording has failed. Batch `b` and all batches in the queue are released,
 * unless the ring owns them. From now on, queue_put() returns BROKEN. */
void queue_end_after_failure(queue *q, batch *b);

#endif
