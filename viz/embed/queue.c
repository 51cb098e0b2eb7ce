/* queue.c - see queue.h. */
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

/* The caller holds the lock, or is the last who has the queue. */
static void drop_all(queue *q)
{
    while (q->first) {
        batch *b = q->first;
        q->first = b->next;
        batch_release(b);
    }
    q->last = NULL;
    q->count = q->bytes = 0;
}

void queue_release(queue *q)
{
    drop_all(q);
    pthread_cond_destroy(&q->changed);
    pthread_mutex_destroy(&q->lock);
}

static bool has_room(const queue *q, const batch *b)
{
    return q->count == 0 || (q->count < q->most && q->bytes <= q->most_bytes && b->bytes <= q->most_bytes - q->bytes);
}

static void append(queue *q, batch *b)
{
    b->next = NULL;
    if (q->last)
        q->last->next = b;
    else
        q->first = b;
    q->last = b;
    q->count++;
    q->bytes += b->bytes;
    pthread_cond_broadcast(&q->changed);
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
        append(q, b);
    pthread_mutex_unlock(&q->lock);
    return status;
}

batch *queue_take(queue *q)
{
    pthread_mutex_lock(&q->lock);
    while (!q->first && !q->ended && !q->broken)
        pthread_cond_wait(&q->changed, &q->lock);
    batch *b = q->first;
    if (b) {
        q->first = b->next;
        q->last = q->first ? q->last : NULL;
        q->count--;
        q->bytes -= b->bytes;
        pthread_cond_broadcast(&q->changed);
    }
    pthread_mutex_unlock(&q->lock);
    return b;
}

void queue_done(queue *q)
{
    pthread_mutex_lock(&q->lock);
    q->taken++;
    pthread_cond_broadcast(&q->changed);
    pthread_mutex_unlock(&q->lock);
}

bool queue_wait_done(queue *q, uint64_t count)
{
    pthread_mutex_lock(&q->lock);
    while (q->taken < count && !q->broken)
        pthread_cond_wait(&q->changed, &q->lock);
    const bool done = q->taken >= count;
    pthread_mutex_unlock(&q->lock);
    return done;
}

void queue_end(queue *q)
{
    pthread_mutex_lock(&q->lock);
    q->ended = true;
    pthread_cond_broadcast(&q->changed);
    pthread_mutex_unlock(&q->lock);
}

void queue_break(queue *q)
{
    pthread_mutex_lock(&q->lock);
    q->broken = true;
    drop_all(q);
    pthread_cond_broadcast(&q->changed);
    pthread_mutex_unlock(&q->lock);
}
