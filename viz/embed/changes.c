/* SPDX-License-Identifier: MIT */
/* changes.c - how the points of a tree change from tick to tick. */
#include "changes.h"
#include "array.h"
#include "session_file.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

/* ---- Points ------------------------------------------------------------------------------------------------- */

/* Ids are sorted byte by byte, from the lowest: the bytes of those below SESSION_ID_LIMIT. */
enum { DIGITS = 7, DIGIT_VALUES = 256 };

void points_release(points *p)
{
    free(p->items);
    *p = (points){0};
}

static bool reserve_points(points *p, size_t count)
{
    octree_point *items = array_reserve(p->items, count, &p->room, sizeof *items);
    p->items = items ? items : p->items;
    return items || count == 0;
}

static octree_walk_order add_leaf(const octree_node *node, void *context)
{
    points *p = context;
    if (!node->leaf)
        return OCTREE_WALK_ON;
    if (node->count > p->room - p->count)
        return OCTREE_WALK_STOP; /* cannot happen: there is room for all */
    if (node->count > 0)
        memcpy(p->items + p->count, node->points, node->count * sizeof *p->items);
    p->count += node->count;
    return OCTREE_WALK_ON;
}

static unsigned digit_of(uint64_t id, int digit)
{
    return (unsigned)(id >> (8 * digit)) & (DIGIT_VALUES - 1);
}

/* Order by one digit, equal ones as they were. False when all points have the same: nothing is moved then. */
static bool sort_by_digit(const points *from, octree_point *to, const size_t counts[DIGIT_VALUES], int digit)
{
    size_t starts[DIGIT_VALUES], sum = 0;
    for (int i = 0; i < DIGIT_VALUES; i++) {
        if (counts[i] == from->count)
            return false;
        starts[i] = sum;
        sum += counts[i];
    }
    for (size_t i = 0; i < from->count; i++)
        to[starts[digit_of(from->items[i].id, digit)]++] = from->items[i];
    return true;
}

static void swap(points *a, points *b)
{
    const points other = *a;
    *a = *b;
    *b = other;
}

static void sort_by_id(points *p, points *spare)
{
    size_t counts[DIGITS][DIGIT_VALUES] = {{0}};
    for (size_t i = 0; i < p->count; i++)
        for (int digit = 0; digit < DIGITS; digit++)
            counts[digit][digit_of(p->items[i].id, digit)]++;
    for (int digit = 0; digit < DIGITS; digit++) {
        if (!sort_by_digit(p, spare->items, counts[digit], digit))
            continue;
        spare->count = p->count;
        swap(p, spare);
    }
}

octreel_status points_read(points *p, points *spare, const octree *tree, uint64_t *clash)
{
    const size_t count = octree_count(tree);
    p->count = 0;
    if (count == 0)
        return OCTREEL_OK;
    if (!reserve_points(p, count) || !reserve_points(spare, count))
        return OCTREEL_NO_MEMORY;
    if (octree_walk(tree, add_leaf, p) != OCTREE_OK)
        return OCTREEL_FLOAT_MODE;
    for (size_t i = 0; i < p->count; i++) {
        *clash = p->items[i].id;
        if (*clash >= SESSION_ID_LIMIT)
            return OCTREEL_BAD_ID;
    }
    sort_by_id(p, spare);
    for (size_t i = 1; i < p->count; i++) {
        *clash = p->items[i].id;
        if (*clash == p->items[i - 1].id)
            return OCTREEL_DUPLICATE_ID;
    }
    return OCTREEL_OK;
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
    if (!reserve_points(spare, p->count + b->change_count))
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
    swap(p, spare);
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

/* ---- Edits -------------------------------------------------------------------------------------------------- */

bool edit_order_init(edit_order *o, const octree_def *def, const points *now)
{
    *o = (edit_order){0};
    if (def->full_leaf == OCTREE_GROW)
        return true;
    return octree_create(def, &o->tree) == OCTREE_OK &&
           (now->count == 0 || octree_insert_many(o->tree, now->items, now->count, NULL, NULL) == OCTREE_OK);
}

void edit_order_release(edit_order *o)
{
    octree_destroy(o->tree);
    free(o->edits);
    free(o->waiting);
    *o = (edit_order){0};
}

/* Each change is one edit, or two: out and in again. */
static bool reserve_edits(edit_order *o, size_t changes)
{
    if (changes <= o->room)
        return true;
    octree_edit *edits = realloc(o->edits, 2 * changes * sizeof *edits);
    o->edits = edits ? edits : o->edits;
    size_t *waiting = realloc(o->waiting, changes * sizeof *waiting);
    o->waiting = waiting ? waiting : o->waiting;
    if (!edits || !waiting)
        return false;
    o->room = changes;
    return true;
}

/* Make a change as an edit of this kind, where there is room for it. False when there is no memory; *made is whether
 * it was made. */
static bool try_change(edit_order *o, uint64_t tick, octree_edit_kind kind, const change *c, bool *made)
{
    octree_status status = OCTREE_OK;
    if (o->tree && kind == OCTREE_EDIT_REMOVE)
        status = octree_remove(o->tree, c->from, c->id);
    else if (o->tree && kind == OCTREE_EDIT_MOVE)
        status = octree_move(o->tree, c->from, c->id, c->to);
    else if (o->tree)
        status = octree_insert(o->tree, c->to, c->id);
    *made = status != OCTREE_FULL && status != OCTREE_NO_MEMORY;
    if (*made) {
        octree_edit *edit = &o->edits[o->count++];
        *edit = (octree_edit){.tick = tick, .kind = kind, .body.id = c->id};
        if (kind != OCTREE_EDIT_REMOVE)
            memcpy(edit->body.position, c->to, sizeof edit->body.position);
    }
    return status != OCTREE_NO_MEMORY;
}

/* Make the changes of a kind; those that find no room wait. */
static bool make_all(edit_order *o, const batch *b, uint64_t tick, octree_edit_kind kind, size_t *waiting)
{
    for (size_t i = 0; i < b->change_count; i++) {
        bool made;
        if (b->changes[i].kind != kind)
            continue;
        if (!try_change(o, tick, kind, &b->changes[i], &made))
            return false;
        if (!made)
            o->waiting[(*waiting)++] = i;
    }
    return true;
}

/* Make all waiting changes as edits of this kind; those that still find no room stay in the list. */
static bool make_waiting(edit_order *o, const batch *b, uint64_t tick, octree_edit_kind kind, size_t *waiting)
{
    size_t left = 0;
    for (size_t i = 0; i < *waiting; i++) {
        bool made;
        if (!try_change(o, tick, kind, &b->changes[o->waiting[i]], &made))
            return false;
        if (!made || kind == OCTREE_EDIT_REMOVE) /* to be put back in */
            o->waiting[left++] = o->waiting[i];
    }
    *waiting = left;
    return true;
}

bool edit_order_make(edit_order *o, const batch *b, uint64_t tick)
{
    size_t waiting = 0;
    o->count = 0;
    return reserve_edits(o, b->change_count) && make_all(o, b, tick, OCTREE_EDIT_REMOVE, &waiting) &&
           make_all(o, b, tick, OCTREE_EDIT_MOVE, &waiting) && make_waiting(o, b, tick, OCTREE_EDIT_MOVE, &waiting) &&
           make_waiting(o, b, tick, OCTREE_EDIT_REMOVE, &waiting) &&
           make_waiting(o, b, tick, OCTREE_EDIT_INSERT, &waiting) && make_all(o, b, tick, OCTREE_EDIT_INSERT, &waiting);
}
