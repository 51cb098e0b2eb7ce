/* SPDX-License-Identifier: MIT */
/* session_filmer.c - a thread that records a program's ticks: see session_filmer.h. */
#include "session_filmer.h"
#include "error.h"
#include "session_file.h"

#include <fenv.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

/* ---- Ticks -------------------------------------------------------------------------------------------------- */

/* Set the tick number of a batch's queries, shapes, foreign nodes and foreign pairs, because the program does not set
 * this number. */
static void set_tick_number(batch *b, uint64_t tick)
{
    for (size_t i = 0; i < b->query_count; i++)
        b->queries[i].tick = tick;
    for (size_t i = 0; i < b->shape_count; i++)
        b->shapes[i].tick = tick;
    b->foreign.tick = b->pairs.tick = tick;
}

/* Returns an array with the points that a batch inserts; the caller frees it. */
static octree_game_body *make_bodies(const edit_order *order, const change_list *inserted)
{
    octree_game_body *bodies = calloc(inserted->count ? inserted->count : 1, sizeof *bodies);
    for (size_t i = 0; bodies && i < inserted->count; i++)
        bodies[i] = edit_order_make_body(order, inserted->items[i].id, inserted->items[i].to);
    return bodies;
}

static octreel_status fail_out_of_memory(session_filmer *f, octreel_status status)
{
    error_no_memory(&f->error);
    return status;
}

/* Record tick 0, which has the points that the first batch inserts. If `gap` is null, tick 0 also has the batch's
 * queries and shapes. Otherwise tick 0 is a gap. */
static octreel_status film_first_tick(session_filmer *f, const batch *first, const octree_gap *gap)
{
    const filmer_settings *s = f->settings;
    film_options film = s->film;
    const change_list *inserted = &first->changes[POSITIONS];
    octree_game_body *bodies = NULL;
    if (!edit_order_init(&f->order, &s->tree, first) || !(bodies = make_bodies(&f->order, inserted)))
        return fail_out_of_memory(f, OCTREEL_NO_MEMORY);
    const octree_session session = {.tree = s->tree,
                                    .player = s->player,
                                    .ticks = SESSION_ENDLESS,
                                    .bodies = bodies,
                                    .body_count = inserted->count,
                                    .queries = first->queries,
                                    .query_count = gap ? 0 : first->query_count,
                                    .shapes = first->shapes,
                                    .shape_count = gap ? 0 : first->shape_count,
                                    .foreign = &first->foreign,
                                    .foreign_count = first->has_foreign && !gap,
                                    .foreign_pairs = &first->pairs,
                                    .foreign_pairs_count = first->has_pairs && !gap,
                                    .gaps = gap,
                                    .gap_count = gap != NULL};
    film.folder = f->folder;
    f->live = live_open(&session, &film, &f->error);
    free(bodies);
    if (!f->live)
        return OCTREEL_CANNOT_DRAW;
    if (!live_begin(f->live, &f->error))
        return OCTREEL_BAD_FOLDER;
    return live_film_first_tick(f->live, &f->error) ? OCTREEL_OK : OCTREEL_BROKEN;
}

static octreel_status film_input(session_filmer *f, const octree_input *input)
{
    return live_film_tick(f->live, input, &f->error) ? OCTREEL_OK : OCTREEL_BROKEN;
}

/* Record the tick of a batch. `has_changes` is false if tick 0 was a gap of this batch: tick 0 has then already used
 * the batch's points. */
static octreel_status film_next_batch(session_filmer *f, const batch *b, bool has_changes)
{
    f->order.count = 0;
    if (has_changes && !edit_order_make(&f->order, live_game(f->live), b, f->tick))
        return fail_out_of_memory(f, OCTREEL_BROKEN);
    return film_input(f, &(octree_input){.key = '.',
                                         .edits = f->order.edits,
                                         .edit_count = f->order.count,
                                         .queries = b->queries,
                                         .query_count = b->query_count,
                                         .shapes = b->shapes,
                                         .shape_count = b->shape_count,
                                         .foreign = b->has_foreign ? &b->foreign : NULL,
                                         .foreign_pairs = b->has_pairs ? &b->pairs : NULL});
}

/* Record the ticks that were refused before the tick of a batch. */
static octreel_status film_gaps(session_filmer *f, const batch *b)
{
    octreel_status status = OCTREEL_OK;
    for (size_t i = 0; i < b->gap_count; i++) {
        octree_gap gap = {0};
        memcpy(gap.why, b->gaps[i].why, sizeof gap.why);
        for (uint64_t left = b->gaps[i].ticks; status == OCTREEL_OK && left > 0; left--) {
            status = f->tick == 0 ? film_first_tick(f, b, &gap) : film_input(f, &(octree_input){.gap = &gap});
            f->tick++;
        }
    }
    return status;
}

static octreel_status film_batch(session_filmer *f, batch *b)
{
    const bool begun = f->tick > 0;
    batch_combine_changes(b); /* the recording thread sorts the changes, to save time in the program's thread */
    octreel_status status = film_gaps(f, b);
    if (status != OCTREEL_OK || b->is_gap)
        return status;
    set_tick_number(b, f->tick);
    status = f->tick == 0 ? film_first_tick(f, b, NULL) : film_next_batch(f, b, begun);
    f->tick++;
    return status;
}

/* ---- The thread --------------------------------------------------------------------------------------------- */

/* Record ticks until the queue ends or a tick fails. f->status is set before a waiting program is woken, so that after
 * a failure the program can read the status at once and need not wait until the last files are written. */
static void film_queue(session_filmer *f)
{
    batch *b;
    while (f->status == OCTREEL_OK && (b = queue_wait_for_batch(f->queue))) {
        f->status = film_batch(f, b);
        (f->status == OCTREEL_OK ? queue_finish_batch : queue_end_after_failure)(f->queue, b);
    }
}

static void *run_filmer_thread(void *context)
{
    session_filmer *f = context;
    octreel_error late;
    fesetenv(FE_DFL_ENV); /* set the default floating-point mode, because a new thread inherits the program's mode */
    film_queue(f);
    edit_order_release(&f->order);
    const bool whole = f->status == OCTREEL_OK;
    if (f->live && !live_close(f->live, SESSION_ENDLESS, NULL, whole ? &f->error : &late) && whole)
        f->status = OCTREEL_BROKEN;
    return NULL;
}

octreel_status session_filmer_start(session_filmer *f)
{
    sigset_t all, before;
    sigfillset(&all);
    /* Block all signals in this thread now, because the new thread inherits the signal mask. */
    if (pthread_sigmask(SIG_SETMASK, &all, &before) != 0)
        return OCTREEL_NO_MEMORY;
    const bool started = pthread_create(&f->thread, NULL, run_filmer_thread, f) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started ? OCTREEL_OK : OCTREEL_NO_MEMORY;
}

octreel_status session_filmer_join(session_filmer *f)
{
    pthread_join(f->thread, NULL);
    return f->status;
}
