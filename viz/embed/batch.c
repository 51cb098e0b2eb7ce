/* SPDX-License-Identifier: MIT */
/* batch.c - holds one tick of a program until it is recorded: see batch.h. */
#include "batch.h"
#include "session_file.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

/* ---- Changes ------------------------------------------------------------------------------------------------ */

void change_list_release(change_list *list)
{
    free(list->items);
    *list = (change_list){0};
}

bool change_make(uint64_t id, const double *from, const double *to, change *made)
{
    /* == is correct here: -0 and 0 are the same position. */
    if (from == to || (from && to && from[0] == to[0] && from[1] == to[1] && from[2] == to[2]))
        return false;
    change c = {.kind = !to ? OCTREE_EDIT_REMOVE : from ? OCTREE_EDIT_MOVE : OCTREE_EDIT_INSERT, .id = id};
    if (from)
        memcpy(c.from, from, sizeof c.from);
    if (to)
        memcpy(c.to, to, sizeof c.to);
    *made = c;
    return true;
}

bool list_comparison_has_ended(const list_comparison *lists)
{
    return lists->i == lists->before->count && lists->j == lists->after->count;
}

size_t list_next_changes(list_comparison *lists, change *changes, size_t most)
{
    const points *before = lists->before, *after = lists->after;
    size_t i = lists->i, j = lists->j, count = 0;
    while (count < most && (i < before->count || j < after->count)) {
        const octree_point *old = i < before->count ? &before->items[i] : NULL;
        const octree_point *new = j < after->count ? &after->items[j] : NULL;
        if (old && new && old->id != new->id) {
            old = old->id < new->id ? old : NULL;
            new = old ? NULL : new;
        }
        i += old != NULL;
        j += new != NULL;
        count += change_make(old ? old->id : new->id, old ? old->position : NULL, new ? new->position : NULL,
                             &changes[count]);
    }
    lists->i = i;
    lists->j = j;
    return count;
}

static int compare_changes(const void *a, const void *b)
{
    const change *c = a, *d = b;
    return c->id != d->id ? (c->id > d->id) - (c->id < d->id) : (c->order > d->order) - (c->order < d->order);
}

size_t combine_changes(change *changes, size_t count)
{
    size_t settled = 0;
    bool sorted = true;
    for (size_t i = 0; i < count; i++) {
        changes[i].order = (uint32_t)i;
        sorted = sorted && (i == 0 || changes[i - 1].id <= changes[i].id);
    }
    if (!sorted)
        qsort(changes, count, sizeof *changes, compare_changes);
    for (size_t first = 0, last; first < count; first = last + 1) {
        for (last = first; last + 1 < count && changes[last + 1].id == changes[first].id;)
            last++;
        const double *from = changes[first].kind == OCTREE_EDIT_INSERT ? NULL : changes[first].from;
        const double *to = changes[last].kind == OCTREE_EDIT_REMOVE ? NULL : changes[last].to;
        settled += change_make(changes[first].id, from, to, &changes[settled]);
    }
    return settled;
}

static void set_point_position(point_table *table, uint64_t id, const double at[3])
{
    octree_point point = {.id = id};
    memcpy(point.position, at, sizeof point.position);
    point_table_set(table, &point);
}

void change_apply(const change *c, point_table *table)
{
    if (c->kind == OCTREE_EDIT_REMOVE)
        point_table_remove(table, c->id);
    else
        set_point_position(table, c->id, c->to);
}

void change_revert(const change *c, point_table *table)
{
    if (c->kind == OCTREE_EDIT_INSERT)
        point_table_remove(table, c->id);
    else
        set_point_position(table, c->id, c->from);
}

void change_list_apply(const change_list *list, point_table *table)
{
    for (size_t i = 0; i < list->count; i++)
        change_apply(&list->items[i], table);
}

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

uint64_t gap_list_count_ticks(const gap_run *runs, size_t count)
{
    uint64_t ticks = 0;
    for (size_t i = 0; i < count; i++)
        ticks += runs[i].ticks;
    return ticks;
}

/* ---- Batches ------------------------------------------------------------------------------------------------ */

/* Copy an array and add its size to the bytes of the batch. Returns null if memory runs out or the array is empty. */
static void *copy_into_batch(batch *b, const void *from, size_t count, size_t item_size)
{
    void *to = count > 0 && count <= SIZE_MAX / item_size ? malloc(count * item_size) : NULL;
    if (to) {
        memcpy(to, from, count * item_size);
        b->bytes += count * item_size;
    }
    return to;
}

static bool copy_tick_info(batch *b, const octreel_tick_info *about)
{
    b->query_count = about->query_count;
    b->shape_count = about->shape_count;
    b->shapes = copy_into_batch(b, about->shapes, about->shape_count, sizeof *about->shapes);
    if (b->shape_count && !b->shapes)
        return false;
    b->queries = copy_into_batch(b, about->queries, about->query_count, sizeof *about->queries);
    bool whole = b->queries || b->query_count == 0;
    /* After a failed copy, continue with the other queries: no copied query may keep a pointer into the program's
     * memory. */
    for (size_t i = 0; b->queries && i < b->query_count; i++) {
        octree_query *query = &b->queries[i];
        query->answer = whole ? copy_into_batch(b, query->answer, query->answer_count, sizeof *query->answer) : NULL;
        whole = whole && (query->answer || query->answer_count == 0);
        for (int met = 0; met < OCTREE_NODE_VISITS; met++) {
            octree_ids *ids = &query->visits[met];
            ids->ids = whole ? copy_into_batch(b, ids->ids, ids->count, sizeof *ids->ids) : NULL;
            whole = whole && (ids->ids || ids->count == 0);
        }
        /* A larger k finds no more points, because no tree holds more than UINT32_MAX points. The recorder's files
         * cannot hold a larger k. */
        if (query->k > UINT32_MAX)
            query->k = UINT32_MAX;
    }
    return whole;
}

batch *batch_make_gaps(const gap_list *gaps)
{
    batch *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->bytes = sizeof *b;
    b->is_gap = true;
    b->gap_count = gaps->count;
    b->gaps = copy_into_batch(b, gaps->runs, gaps->count, sizeof *gaps->runs);
    if (b->gaps || gaps->count == 0)
        return b;
    batch_release(b);
    return NULL;
}

static bool copy_foreign(batch *b, const octree_foreign_tree *foreign)
{
    if (!foreign_tree_duplicate(foreign, &b->foreign))
        return false;
    b->has_foreign = true;
    b->bytes += foreign->node_count * sizeof *foreign->nodes;
    for (size_t i = 0; i < foreign->node_count; i++)
        b->bytes += foreign->nodes[i].points.count * sizeof(uint64_t);
    return true;
}

static bool copy_pairs(batch *b, const octree_foreign_pairs *pairs)
{
    b->has_pairs = foreign_pairs_duplicate(pairs, &b->pairs);
    b->bytes += b->pairs.pair_count * sizeof *b->pairs.pairs;
    return b->has_pairs;
}

batch *batch_make(const gap_list *gaps, const octreel_tick_info *about, const octree_foreign_tree *foreign)
{
    batch *b = batch_make_gaps(gaps);
    if (!b)
        return NULL;
    b->is_gap = false;
    if ((!about || copy_tick_info(b, about)) && (!foreign || copy_foreign(b, foreign)) &&
        (!about || !about->foreign_pairs || copy_pairs(b, about->foreign_pairs)))
        return b;
    batch_release(b);
    return NULL;
}

void batch_combine_changes(batch *b)
{
    for (int i = 0; i < TRACKS; i++)
        b->changes[i].count = combine_changes(b->changes[i].items, b->changes[i].count);
}

void batch_release(batch *b)
{
    if (!b)
        return;
    free(b->gaps);
    for (int i = 0; i < TRACKS; i++)
        change_list_release(&b->changes[i]);
    for (size_t i = 0; b->queries && i < b->query_count; i++)
        query_release_ids(&b->queries[i]);
    free(b->queries);
    free(b->shapes);
    foreign_tree_release(&b->foreign);
    foreign_pairs_release(&b->pairs);
    free(b);
}

void batch_list_add(batch_list *list, batch *b)
{
    b->next = NULL;
    *(list->last ? &list->last->next : &list->first) = b;
    list->last = b;
    list->count++;
    list->bytes += b->bytes;
}

batch *batch_list_remove_first(batch_list *list)
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
        batch_release(batch_list_remove_first(list));
}
