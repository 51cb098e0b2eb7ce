/* SPDX-License-Identifier: MIT */
/* queue.c - the queue of ticks from the program's thread to the recording thread: see queue.h. */
#include "queue.h"

bool queue_init(queue *q, size_t most, size_t most_bytes)
{
    *q = (queue){.most = most, .most_bytes = most_bytes};
    if (pthread_mutex_init(&q->lock, NULL) != 0)
        return false;
    if (pthread_cond_init(&q->changed, NULL) == 0)
        return true;
    pthread_mutex_destroy(&q->lock);
    return false;
}

/* Remove all batches from the queue, and release batches that the queue owns. The caller must hold the lock or be the
 * last user of the queue. */
static void remove_all_batches(queue *q)
{
    if (!q->borrowed)
        batch_list_clear(&q->list);
    q->list = (batch_list){0};
}

void queue_release(queue *q)
{
    remove_all_batches(q);
    pthread_cond_destroy(&q->changed);
    pthread_mutex_destroy(&q->lock);
}

static void release_unless_borrowed(const queue *q, batch *b)
{
    if (!q->borrowed)
        batch_release(b);
}

static void wake_and_unlock(queue *q)
{
    pthread_cond_broadcast(&q->changed);
    pthread_mutex_unlock(&q->lock);
}

static bool has_room(const queue *q, const batch *b)
{
    const batch_list *list = &q->list;
    return list->count == 0 ||
           (list->count < q->most && list->bytes <= q->most_bytes && b->bytes <= q->most_bytes - list->bytes);
}

octreel_status queue_put(queue *q, batch *b, bool wait)
{
    octreel_status status = OCTREEL_OK;
    pthread_mutex_lock(&q->lock);
    while (!q->broken && wait && !has_room(q, b))
        pthread_cond_wait(&q->changed, &q->lock);
    if (q->broken)
        status = OCTREEL_BROKEN;
    else if (!has_room(q, b))
        status = OCTREEL_BUSY;
    else
        batch_list_add(&q->list, b);
    wake_and_unlock(q);
    return status;
}

batch *queue_wait_for_batch(queue *q)
{
    pthread_mutex_lock(&q->lock);
    while (!q->list.first && !q->ended && !q->broken)
        pthread_cond_wait(&q->changed, &q->lock);
    batch *b = batch_list_remove_first(&q->list);
    wake_and_unlock(q);
    return b;
}

void queue_finish_batch(queue *q, batch *b)
{
    release_unless_borrowed(q, b);
}

void queue_end(queue *q)
{
    pthread_mutex_lock(&q->lock);
    q->ended = true;
    wake_and_unlock(q);
}

void queue_end_after_failure(queue *q, batch *b)
{
    release_unless_borrowed(q, b);
    pthread_mutex_lock(&q->lock);
    q->broken = true;
    remove_all_batches(q);
    wake_and_unlock(q);
}
