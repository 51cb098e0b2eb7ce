/* SPDX-License-Identifier: MIT */
/* queue.h - ticks on their way from the program's thread to the one that films: bounded in number and in bytes. Private
 * to this folder. */
#ifndef EMBED_QUEUE_H
#define EMBED_QUEUE_H

#include "batch.h"

#include <pthread.h>

typedef struct queue {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    batch_list list;
    size_t most, most_bytes;
    bool borrowed; /* the batches are not released by the queue */
    bool ended;    /* nothing more is put */
    bool broken;   /* nothing more is taken */
    bool begun;    /* there is a recording to film into */
} queue;

bool queue_init(queue *q, size_t most, size_t most_bytes);

/* No thread may be waiting. */
void queue_release(queue *q);

/* Hand a batch over. Where there is no room for it, wait, or with `wait` false return BUSY; BROKEN where none is taken
 * any more. On failure the batch stays the caller's. */
octreel_status queue_put(queue *q, batch *b, bool wait);

/* The next batch, when there is one; null when the queue has ended. */
batch *queue_take(queue *q);

/* Let go of the batch that was taken last: it was filmed. */
void queue_done(queue *q, batch *b);

/* There is a recording to film into: who waits for that is woken. */
void queue_begin(queue *q);

/* Wait for it, or until the queue is broken. False then. */
bool queue_wait_begun(queue *q);

void queue_end(queue *q);

/* Drop what is in the queue, the batch that was taken last, and all that comes. */
void queue_break(queue *q, batch *b);

#endif
