/* SPDX-License-Identifier: MIT */
/* ring.c - a ring buffer of a program's last ticks: see ring.h. */
#include "ring.h"
#include "error.h"

#include <stdlib.h>
#include <string.h>

void ring_release(ring *r)
{
    batch_list_clear(&r->list);
    for (int i = 0; i < TRACKS; i++)
        point_table_release(&r->start[i]);
    *r = (ring){0};
}

static void clear_changes(batch *b)
{
    for (int i = 0; i < TRACKS; i++)
        change_list_release(&b->changes[i]);
}

/* Make a tick the first tick of the ring: apply its changes to the points in r->start, and drop the gaps before the
 * tick. Returns false if memory runs out. */
static bool restart_ring_at(ring *r, batch *b)
{
    for (int i = 0; i < TRACKS; i++)
        if (!point_table_reserve(&r->start[i], r->start[i].count + b->changes[i].count))
            return false;
    for (int i = 0; i < TRACKS; i++)
        change_list_apply(&b->changes[i], &r->start[i]);
    clear_changes(b);
    r->dropped += gap_list_count_ticks(b->gaps, b->gap_count);
    b->gap_count = 0;
    return true;
}

/* Move the foreign nodes of a tick to the next tick, unless the next tick has foreign nodes itself. Foreign nodes stay
 * valid until a tick has new foreign nodes. */
static void move_foreign_nodes(batch *from, batch *to)
{
    if (!from->has_foreign || to->has_foreign)
        return;
    to->foreign = from->foreign;
    to->has_foreign = true;
    from->foreign = (octree_foreign_tree){0};
}

bool ring_put(ring *r, batch *b)
{
    const bool full = r->list.count == r->most;
    batch *first = r->list.first, *second = first && first->next ? first->next : b;
    if ((full || !first) && !restart_ring_at(r, second))
        return false;
    if (full) {
        first = batch_list_remove_first(&r->list);
        move_foreign_nodes(first, second);
        batch_release(first);
        r->dropped++;
    }
    batch_list_add(&r->list, b);
    return true;
}

losses ring_sum_losses(const ring *r, uint64_t *ticks)
{
    losses lost = {0};
    *ticks = 0;
    for (const batch *b = r->list.first; b; b = b->next) {
        if (b->gap_count > 0 && lost.ticks == 0) {
            lost.first = *ticks;
            memcpy(lost.why, b->gaps[0].why, sizeof lost.why);
        }
        const uint64_t gaps = gap_list_count_ticks(b->gaps, b->gap_count);
        lost.ticks += gaps;
        *ticks += gaps + !b->is_gap;
    }
    return lost;
}

/* Make the insertions of all points of a table, sorted by id. Returns false if memory runs out. */
static bool make_insertions(const point_table *start, change_list *made)
{
    const points none = {0};
    points listed = {0}, spare = {0};
    made->items = malloc((start->count + 1) * sizeof *made->items);
    const bool ok = made->items && point_table_list(start, &listed, &spare);
    if (ok)
        made->count =
            list_next_changes(&(list_comparison){.before = &none, .after = &listed}, made->items, listed.count);
    points_release(&listed);
    points_release(&spare);
    return ok;
}

/* Give the first tick of the ring the insertions of all points in r->start. Returns false if memory runs out. */
static bool add_insertions(const ring *r)
{
    bool ok = true;
    for (int i = 0; ok && i < TRACKS; i++)
        ok = make_insertions(&r->start[i], &r->list.first->changes[i]);
    return ok;
}

static octreel_status film_list(const ring *r, const filmer_settings *s, const char *folder, octreel_error *error)
{
    queue ticks;
    session_filmer f = {.settings = s, .folder = folder, .queue = &ticks};
    if (!queue_init(&ticks, 0, 0)) {
        error_no_memory(error);
        return OCTREEL_NO_MEMORY;
    }
    ticks.list = r->list;
    ticks.borrowed = ticks.ended = true;
    octreel_status status = session_filmer_start(&f);
    if (status == OCTREEL_OK)
        status = session_filmer_join(&f);
    else
        error_set(&f.error, "cannot start a thread");
    queue_release(&ticks);
    if (status != OCTREEL_OK)
        *error = f.error;
    return status;
}

octreel_status ring_film(const ring *r, const filmer_settings *s, const char *folder, octreel_error *error)
{
    octreel_status status = OCTREEL_NO_MEMORY;
    if (add_insertions(r))
        status = film_list(r, s, folder, error);
    else
        error_no_memory(error);
    clear_changes(r->list.first);
    return status;
}
