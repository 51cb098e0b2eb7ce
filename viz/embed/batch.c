/* SPDX-License-Identifier: MIT */
/* batch.c - what was handed over in a tick, as the change since the tick before. */
#include "batch.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

/* ---- Gaps --------------------------------------------------------------------------------------------------- */

void gap_list_add(gap_list *list, const char *why)
{
    gap_run run = {.ticks = 1};
    snprintf(run.why, sizeof run.why, "%s", why);
    make_printable(run.why);
    const bool same = list->count > 0 && strcmp(list->runs[list->count - 1].why, run.why) == 0;
    if (same || list->count == MOST_GAP_RUNS)
        list->runs[list->count - 1].ticks++;
    else
        list->runs[list->count++] = run;
}

uint64_t gap_list_ticks(const gap_run *runs, size_t count)
{
    uint64_t ticks = 0;
    for (size_t i = 0; i < count; i++)
        ticks += runs[i].ticks;
    return ticks;
}

/* ---- Batches ------------------------------------------------------------------------------------------------ */

/* By value: whether a zero has a sign is no change. */
static bool same_place(const octree_point *a, const octree_point *b)
{
    return a->position[0] == b->position[0] && a->position[1] == b->position[1] && a->position[2] == b->position[2];
}

static change make_change(const octree_point *before, const octree_point *after)
{
    change c = {.kind = !after    ? OCTREE_EDIT_REMOVE
                        : !before ? OCTREE_EDIT_INSERT
                                  : OCTREE_EDIT_MOVE,
                .id = before ? before->id : after->id};
    if (before)
        memcpy(c.from, before->position, sizeof c.from);
    if (after)
        memcpy(c.to, after->position, sizeof c.to);
    return c;
}

/* Write the changes; null: count them. */
static size_t compare(const points *before, const points *after, change *changes)
{
    size_t i = 0, j = 0, count = 0;
    while (i < before->count || j < after->count) {
        const octree_point *old = i < before->count ? &before->items[i] : NULL;
        const octree_point *new = j < after->count ? &after->items[j] : NULL;
        if (old && new && old->id != new->id) {
            old = old->id < new->id ? old : NULL;
            new = old ? NULL : new;
        }
        i += old != NULL;
        j += new != NULL;
        if (old && new &&same_place(old, new))
            continue;
        if (changes)
            changes[count] = make_change(old, new);
        count++;
    }
    return count;
}

/* Copy items, counting their bytes. Null when there is no memory, or nothing to copy. */
static void *copy(batch *b, const void *from, size_t count, size_t item_size)
{
    void *to = count > 0 && count <= SIZE_MAX / item_size ? malloc(count * item_size) : NULL;
    if (to) {
        memcpy(to, from, count * item_size);
        b->bytes += count * item_size;
    }
    return to;
}

static bool copy_about(batch *b, const octreel_tick_info *about)
{
    b->query_count = about->query_count;
    b->shape_count = about->shape_count;
    b->queries = copy(b, about->queries, about->query_count, sizeof *about->queries);
    b->shapes = copy(b, about->shapes, about->shape_count, sizeof *about->shapes);
    if ((b->query_count && !b->queries) || (b->shape_count && !b->shapes))
        return false;
    bool whole = true;
    for (size_t i = 0; i < b->query_count; i++) {
        octree_query *query = &b->queries[i];
        query->answer = whole ? copy(b, query->answer, query->answer_count, sizeof *query->answer) : NULL;
        whole = whole && (query->answer || query->answer_count == 0);
        /* Files hold no more neighbours than a tree has points, at most. */
        if (query->k > UINT32_MAX)
            query->k = UINT32_MAX;
    }
    return whole;
}

static bool find_changes(batch *b, const points *before, const points *after)
{
    b->change_count = compare(before, after, NULL);
    if (b->change_count == 0)
        return true;
    b->changes = malloc(b->change_count * sizeof *b->changes);
    if (!b->changes)
        return false;
    b->bytes += b->change_count * sizeof *b->changes;
    compare(before, after, b->changes);
    return true;
}

batch *batch_make_gaps(const gap_list *gaps)
{
    batch *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->bytes = sizeof *b;
    b->is_gap = true;
    b->gap_count = gaps->count;
    b->gaps = copy(b, gaps->runs, gaps->count, sizeof *gaps->runs);
    if (b->gaps || gaps->count == 0)
        return b;
    batch_release(b);
    return NULL;
}

batch *batch_make(const points *before, const points *after, const gap_list *gaps, const octreel_tick_info *about)
{
    batch *b = batch_make_gaps(gaps);
    if (!b)
        return NULL;
    b->is_gap = false;
    if (find_changes(b, before, after) && (!about || copy_about(b, about)))
        return b;
    batch_release(b);
    return NULL;
}

void batch_release(batch *b)
{
    if (!b)
        return;
    free(b->gaps);
    free(b->changes);
    for (size_t i = 0; b->queries && i < b->query_count; i++)
        free((uint64_t *)b->queries[i].answer);
    free(b->queries);
    free(b->shapes);
    free(b);
}

bool batch_apply(const batch *b, points *p, points *spare)
{
    size_t next = 0;
    if (!points_reserve(spare, p->count + b->change_count))
        return false;
    spare->count = 0;
    for (size_t i = 0; i < b->change_count; i++) {
        const change *c = &b->changes[i];
        for (; next < p->count && p->items[next].id < c->id; next++)
            spare->items[spare->count++] = p->items[next];
        next += c->kind != OCTREE_EDIT_INSERT;
        if (c->kind == OCTREE_EDIT_REMOVE)
            continue;
        octree_point *point = &spare->items[spare->count++];
        point->id = c->id;
        memcpy(point->position, c->to, sizeof point->position);
    }
    for (; next < p->count; next++)
        spare->items[spare->count++] = p->items[next];
    points_swap(p, spare);
    return true;
}

void batch_list_add(batch_list *list, batch *b)
{
    b->next = NULL;
    *(list->last ? &list->last->next : &list->first) = b;
    list->last = b;
    list->count++;
    list->bytes += b->bytes;
}

batch *batch_list_take(batch_list *list)
{
    batch *b = list->first;
    if (!b)
        return NULL;
    list->first = b->next;
    list->last = list->first ? list->last : NULL;
    list->count--;
    list->bytes -= b->bytes;
    return b;
}

void batch_list_clear(batch_list *list)
{
    while (list->first)
        batch_release(batch_list_take(list));
}
