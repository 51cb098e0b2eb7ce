/* ring.c - see ring.h. */
#include "ring.h"
#include "session_filmer.h"
#include "worker.h"

#include <stdlib.h>

void ring_release(ring *r)
{
    while (r->first) {
        batch *b = r->first;
        r->first = b->next;
        batch_release(b);
    }
    points_release(&r->start);
    points_release(&r->spare);
    *r = (ring){0};
}

/* Let the points of the first tick be those of this one. */
static bool start_at(ring *r, batch *b)
{
    if (!batch_apply(b, &r->start, &r->spare))
        return false;
    free(b->changes);
    b->changes = NULL;
    b->change_count = 0;
    return true;
}

static void drop_first(ring *r)
{
    batch *b = r->first;
    r->first = b->next;
    r->last = r->first ? r->last : NULL;
    r->count--;
    r->dropped++;
    batch_release(b);
}

bool ring_put(ring *r, batch *b)
{
    const bool full = r->count == r->most;
    batch *second = r->first && r->first->next ? r->first->next : b;
    b->next = NULL;
    if ((full || r->count == 0) && !start_at(r, second))
        return false;
    if (full)
        drop_first(r);
    if (r->last)
        r->last->next = b;
    else
        r->first = b;
    r->last = b;
    r->count++;
    return true;
}

typedef struct writing {
    ring *ring;
    const settings *settings;
    const char *folder;
    octreel_status status;
    octreel_error *error;
} writing;

static void film_all(void *context)
{
    writing *w = context;
    reel r;
    octreel_error late;
    w->status = reel_begin(&r, w->settings, w->folder, &w->ring->start, w->ring->first, w->error);
    if (w->status != OCTREEL_OK)
        return;
    for (batch *b = w->ring->first->next; b && w->status == OCTREEL_OK; b = b->next)
        w->status = reel_tick(&r, b, w->error);
    const octreel_status ended = reel_end(&r, w->status == OCTREEL_OK ? w->error : &late);
    w->status = w->status == OCTREEL_OK ? ended : w->status;
}

octreel_status ring_write(ring *r, const settings *s, const char *folder, octreel_error *error)
{
    writing w = {.ring = r, .settings = s, .folder = folder, .error = error};
    worker thread;
    if (!worker_start(&thread, film_all, &w)) {
        error_set(error, "a thread cannot be started");
        return OCTREEL_NO_MEMORY;
    }
    worker_join(&thread);
    return w.status;
}
