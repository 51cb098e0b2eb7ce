/* SPDX-License-Identifier: MIT */
/* edit_order.c - turns the changes of a tick into edits that the tree accepts: see edit_order.h. */
#include "edit_order.h"
#include "octree/octree.h"

#include <stdlib.h>
#include <string.h>

bool edit_order_init(edit_order *o, const octree_def *def, const batch *first)
{
    *o = (edit_order){.world = def->world};
    if (def->full_leaf == OCTREE_GROW)
        return true;
    const change_list *inserted = &first->changes[POSITIONS];
    const size_t count = inserted->count;
    octree_point *points = malloc((count ? count : 1) * sizeof *points);
    for (size_t i = 0; points && i < count; i++) {
        points[i].id = inserted->items[i].id;
        memcpy(points[i].position, inserted->items[i].to, sizeof points[i].position);
    }
    const bool made = points && octree_create(def, &o->tree) == OCTREE_OK &&
                      (count == 0 || octree_insert_many(o->tree, points, count, NULL, NULL) == OCTREE_OK);
    free(points);
    return made;
}

void edit_order_release(edit_order *o)
{
    octree_destroy(o->tree);
    free(o->edits);
    free(o->waiting);
    *o = (edit_order){0};
}

/* Make room for two edits per change, because a move may become a removal and an insertion. */
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

static bool is_inside(const edit_order *o, const double at[3])
{
    bool inside = true;
    for (int i = 0; i < 3; i++)
        inside &= at[i] >= o->world.min[i] && at[i] <= o->world.max[i];
    return inside;
}

/* Returns true if a change becomes an edit of this kind. A move out of the world becomes two edits, a removal and an
 * insertion. */
static bool needs_edit(const edit_order *o, const change *c, octree_edit_kind kind)
{
    const bool from = c->kind != OCTREE_EDIT_INSERT && is_inside(o, c->from);
    const bool to = c->kind != OCTREE_EDIT_REMOVE && is_inside(o, c->to);
    if (kind == OCTREE_EDIT_INSERT)
        return c->kind != OCTREE_EDIT_REMOVE && !(from && to);
    return from && to == (kind == OCTREE_EDIT_MOVE);
}

/* Try to make a change by an edit of the kind `kind`. *made becomes true if the edit was made, and false if a full leaf
 * has no room for the point. Returns false if memory runs out. */
static bool try_edit(edit_order *o, uint64_t tick, octree_edit_kind kind, const change *c, bool *made)
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

/* Make the edits of the kind `kind`. If `again` is false, try all changes that need an edit of this kind. If `again` is
 * true, try the waiting changes. A change waits if a full leaf had no room for its point, or if this pass removed its
 * point so that a later pass inserts the point elsewhere. Returns false if memory runs out. */
static bool make_edits_of_kind(edit_order *o, const change_list *changes, uint64_t tick, octree_edit_kind kind,
                               bool again)
{
    const size_t count = again ? o->waiting_count : changes->count;
    o->waiting_count = again ? 0 : o->waiting_count;
    for (size_t i = 0; i < count; i++) {
        const size_t index = again ? o->waiting[i] : i;
        bool made;
        if (!again && !needs_edit(o, &changes->items[index], kind))
            continue;
        if (!try_edit(o, tick, kind, &changes->items[index], &made))
            return false;
        if (!made || (again && kind == OCTREE_EDIT_REMOVE))
            o->waiting[o->waiting_count++] = index;
    }
    return true;
}

bool edit_order_make(edit_order *o, const batch *b, uint64_t tick)
{
    static const struct {
        octree_edit_kind kind;
        bool again;
    } passes[] = {{OCTREE_EDIT_REMOVE, false}, {OCTREE_EDIT_MOVE, false},  {OCTREE_EDIT_MOVE, true},
                  {OCTREE_EDIT_REMOVE, true},  {OCTREE_EDIT_INSERT, true}, {OCTREE_EDIT_INSERT, false}};
    o->count = o->waiting_count = 0;
    bool made = reserve_edits(o, b->changes[POSITIONS].count);
    for (size_t i = 0; made && i < sizeof passes / sizeof passes[0]; i++)
        made = make_edits_of_kind(o, &b->changes[POSITIONS], tick, passes[i].kind, passes[i].again);
    return made;
}
