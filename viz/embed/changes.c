/* batch.c - see batch.h. */
#include "changes.h"

#include <stdlib.h>
#include <string.h>

/* ---- Changes ------------------------------------------------------------------------------------------------ */

/* By value: whether a zero has a sign is no change. */
static bool is_there_still(const octree_point *before, const octree_point *after)
{
    return before->position[0] == after->position[0] && before->position[1] == after->position[1] &&
           before->position[2] == after->position[2];
}

/* Where the changes of each kind go next; while they are counted, none has a place. */
typedef struct change_sink {
    change *changes;
    size_t next[OCTREE_EDIT_MOVE + 1];
} change_sink;

static void put(change_sink *sink, octree_edit_kind kind, const octree_point *before, const octree_point *after)
{
    const size_t place = sink->next[kind]++;
    if (!sink->changes)
        return;
    change *c = &sink->changes[place];
    *c = (change){.kind = kind, .id = before ? before->id : after->id};
    if (before)
        memcpy(c->from, before->position, sizeof c->from);
    if (after)
        memcpy(c->to, after->position, sizeof c->to);
}

static void compare(const points *before, const points *after, change_sink *sink)
{
    size_t i = 0, j = 0;
    while (i < before->count || j < after->count) {
        const octree_point *old = i < before->count ? &before->items[i] : NULL;
        const octree_point *new = j < after->count ? &after->items[j] : NULL;
        if (!new || (old && old->id < new->id)) {
            put(sink, OCTREE_EDIT_REMOVE, old, NULL);
            i++;
        } else if (!old || new->id < old->id) {
            put(sink, OCTREE_EDIT_INSERT, NULL, new);
            j++;
        } else {
            if (!is_there_still(old, new))
                put(sink, OCTREE_EDIT_MOVE, old, new);
            i++;
            j++;
        }
    }
}

/* ---- A batch ------------------------------------------------------------------------------------------------ */

/* Copy items, counting their bytes. False when there is no memory. */
static bool copy(batch *b, void **to, const void *from, size_t count, size_t item_size)
{
    if (count == 0)
        return true;
    *to = count <= SIZE_MAX / item_size ? malloc(count * item_size) : NULL;
    if (!*to)
        return false;
    memcpy(*to, from, count * item_size);
    b->bytes += count * item_size;
    return true;
}

static bool copy_about(batch *b, const octreel_tick_info *about)
{
    void *queries = NULL, *shapes = NULL;
    const bool ok = copy(b, &queries, about->queries, about->query_count, sizeof *about->queries) &&
                    copy(b, &shapes, about->shapes, about->shape_count, sizeof *about->shapes);
    b->queries = queries;
    b->shapes = shapes;
    b->query_count = about->query_count;
    b->shape_count = about->shape_count;
    return ok;
}

/* Files hold no more neighbours than a tree has points, at most. */
static void clamp_queries(batch *b)
{
    for (size_t i = 0; i < b->query_count; i++)
        if (b->queries[i].k > UINT32_MAX)
            b->queries[i].k = UINT32_MAX;
}

static bool find_changes(batch *b, const points *before, const points *after)
{
    change_sink sink = {0};
    compare(before, after, &sink);
    const size_t removals = sink.next[OCTREE_EDIT_REMOVE], moves = sink.next[OCTREE_EDIT_MOVE];
    b->change_count = removals + moves + sink.next[OCTREE_EDIT_INSERT];
    if (b->change_count == 0)
        return true;
    b->changes = malloc(b->change_count * sizeof *b->changes);
    if (!b->changes)
        return false;
    b->bytes += b->change_count * sizeof *b->changes;
    sink = (change_sink){.changes = b->changes,
                         .next = {[OCTREE_EDIT_MOVE] = removals, [OCTREE_EDIT_INSERT] = removals + moves}};
    compare(before, after, &sink);
    return true;
}

batch *batch_make(const points *before, const points *after, const octreel_tick_info *about)
{
    batch *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->bytes = sizeof *b;
    if (find_changes(b, before, after) && (!about || copy_about(b, about))) {
        clamp_queries(b);
        return b;
    }
    batch_release(b);
    return NULL;
}

void batch_release(batch *b)
{
    if (!b)
        return;
    free(b->changes);
    free(b->queries);
    free(b->shapes);
    free(b);
}

/* ---- Making them -------------------------------------------------------------------------------------------- */

/* The changes of each kind, as far as they are made. */
typedef struct change_place {
    const change *at[OCTREE_EDIT_MOVE + 1], *end[OCTREE_EDIT_MOVE + 1];
} change_place;

static change_place sort_out(const batch *b)
{
    change_place place = {0};
    const change *at = b->changes, *end = b->changes ? b->changes + b->change_count : NULL;
    static const octree_edit_kind order[] = {OCTREE_EDIT_REMOVE, OCTREE_EDIT_MOVE, OCTREE_EDIT_INSERT};
    for (int i = 0; i < 3; i++) {
        place.at[order[i]] = at;
        while (at < end && at->kind == order[i])
            at++;
        place.end[order[i]] = at;
    }
    return place;
}

/* Whether the next change of a kind is about this id; it is then passed. */
static const change *take(change_place *place, octree_edit_kind kind, uint64_t id)
{
    return place->at[kind] < place->end[kind] && place->at[kind]->id == id ? place->at[kind]++ : NULL;
}

static void append(points *p, uint64_t id, const double position[3])
{
    octree_point *point = &p->items[p->count++];
    point->id = id;
    memcpy(point->position, position, sizeof point->position);
}

/* Insertions up to an id, or all that are left. */
static void append_insertions(points *p, change_place *place, uint64_t below)
{
    const octree_edit_kind kind = OCTREE_EDIT_INSERT;
    for (; place->at[kind] < place->end[kind] && place->at[kind]->id < below; place->at[kind]++)
        append(p, place->at[kind]->id, place->at[kind]->to);
}

bool batch_apply(const batch *b, points *p, points *spare)
{
    change_place place = sort_out(b);
    if (!points_reserve(spare, p->count + b->change_count))
        return false;
    spare->count = 0;
    for (size_t i = 0; i < p->count; i++) {
        const octree_point *point = &p->items[i];
        append_insertions(spare, &place, point->id);
        const change *moved = take(&place, OCTREE_EDIT_MOVE, point->id);
        if (!take(&place, OCTREE_EDIT_REMOVE, point->id))
            append(spare, point->id, moved ? moved->to : point->position);
    }
    append_insertions(spare, &place, UINT64_MAX);
    const points old = *p;
    *p = *spare;
    *spare = old;
    return true;
}
