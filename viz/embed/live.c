/* live.c - see live.h. */
#include "live.h"
#include "session_filmer.h"

static octreel_status begin(live *l, reel *r, batch *first)
{
    points start = {0}, spare = {0};
    octreel_status status = OCTREEL_NO_MEMORY;
    if (batch_apply(first, &start, &spare))
        status = reel_begin(r, l->settings, l->folder, &start, first, &l->error);
    else
        error_set(&l->error, "there is no memory");
    points_release(&start);
    points_release(&spare);
    return status;
}

/* Tick after tick, until there are no more or one fails. */
static void film_queue(live *l, reel *r)
{
    batch *b;
    while (l->status == OCTREEL_OK && (b = queue_take(&l->queue))) {
        l->status = r->film ? reel_tick(r, b, &l->error) : begin(l, r, b);
        batch_release(b);
        if (l->status == OCTREEL_OK)
            queue_done(&l->queue);
    }
}

static void work(void *context)
{
    live *l = context;
    octreel_error late;
    reel r = {0};
    film_queue(l, &r);
    const bool failed = l->status != OCTREEL_OK;
    if (failed)
        queue_break(&l->queue); /* the program need not wait for the files that come last */
    if (!r.film)
        return;
    const octreel_status ended = reel_end(&r, failed ? &late : &l->error);
    if (!failed)
        l->status = ended;
}

octreel_status live_start(live *l, const settings *s, const char *folder, const octreel_recorder_def *def)
{
    l->settings = s;
    l->folder = folder;
    if (!queue_init(&l->queue, def->queue_ticks, def->queue_bytes))
        return OCTREEL_NO_MEMORY;
    if (worker_start(&l->worker, work, l))
        return OCTREEL_OK;
    queue_release(&l->queue);
    return OCTREEL_NO_MEMORY;
}

octreel_status live_put(live *l, batch *b, bool wait)
{
    const octreel_status status = queue_put(&l->queue, b, wait);
    if (status != OCTREEL_OK) {
        batch_release(b);
        return status == OCTREEL_BROKEN ? l->status : status;
    }
    return l->ticks++ > 0 || queue_wait_done(&l->queue, 1) ? OCTREEL_OK : l->status;
}

octreel_status live_end(live *l)
{
    queue_end(&l->queue);
    worker_join(&l->worker);
    queue_release(&l->queue);
    return l->status;
}
