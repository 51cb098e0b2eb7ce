/* SPDX-License-Identifier: MIT */
/* edit_order.c - turns the changes of a tick into edits that the tree accepts: see edit_order.h. */
#include "edit_order.h"
#include "octree/octree.h"

#include <stdlib.h>
#include <string.h>

/* Apply the changes of the points' extents in a batch to o->extents. Returns false if memory runs out. */
static bool update_extents(edit_order *o, const batch *b)
{
    const change_list *resized = &b->changes[EXTENTS];
    if (!point_table_reserve(&o->extents, o->extents.count + resized->count))
        return false;
    change_list_apply(resized, &o->extents);
    return true;
}

bool edit_order_init(edit_order *o, const octree_def *def, const batch *first)
{
    *o = (edit_order){.world = def->world};
    if (!update_extents(o, first))
        return false;
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
    point_table_release(&o->extents);
    free(o->edits);
    free(o->waiting);
    *o = (edit_order){0};
}

/* Make room for two edits per change, because a move or a change of extents may become a removal and an insertion. */
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

octree_game_body edit_order_make_body(const edit_order *o, uint64_t id, const double at[3])
{
    octree_game_body body = {.id = id};
    const octree_point *extents = point_table_find(&o->extents, id);
    memcpy(body.position, at, sizeof body.position);
    if (extents)
        memcpy(body.half, extents->position, sizeof body.half);
    return body;
}

static void add_edit(edit_order *o, uint64_t tick, octree_edit_kind kind, uint64_t id, const double at[3])
{
    octree_edit *edit = &o->edits[o->count++];
    *edit = (octree_edit){.tick = tick, .kind = kind, .body.id = id};
    if (kind == OCTREE_EDIT_INSERT)
        edit->body = edit_order_make_body(o, id, at);
    else if (kind == OCTREE_EDIT_MOVE)
        memcpy(edit->body.position, at, sizeof edit->body.position);
}

/* Remove the bodies whose extents change, and insert them again at their places, before they move: the collision test
 * then covers their whole way. Bodies that leave the world or are removed are left out, and so are bodies that are not
 * in the game yet: their insertion has the new extents. Where bodies have extents, leaves grow, so o->tree is null. */
static void replace_resized_bodies(edit_order *o, const octree_game *game, const batch *b, uint64_t tick)
{
    const change_list *moves = &b->changes[POSITIONS], *resized = &b->changes[EXTENTS];
    for (size_t i = 0, move = 0; i < resized->count; i++) {
        const uint64_t id = resized->items[i].id;
        octree_body body;
        while (move < moves->count && moves->items[move].id < id)
            move++;
        const bool moved = move < moves->count && moves->items[move].id == id;
        if ((moved && needs_edit(o, &moves->items[move], OCTREE_EDIT_REMOVE)) ||
            !octree_game_find_body(game, id, &body))
            continue;
        add_edit(o, tick, OCTREE_EDIT_REMOVE, id, NULL);
        add_edit(o, tick, OCTREE_EDIT_INSERT, id, body.position);
    }
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
    if (*made)
        add_edit(o, tick, kind, c->id, c->to);
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

bool edit_order_make(edit_order *o, const octree_game *game, const batch *b, uint64_t tick)
{
    static const struct {
        octree_edit_kind kind;
        bool again;
    } passes[] = {{OCTREE_EDIT_REMOVE, false}, {OCTREE_EDIT_MOVE, false},  {OCTREE_EDIT_MOVE, true},
                  {OCTREE_EDIT_REMOVE, true},  {OCTREE_EDIT_INSERT, true}, {OCTREE_EDIT_INSERT, false}};
    o->count = o->waiting_count = 0;
    bool made = reserve_edits(o, b->changes[POSITIONS].count + b->changes[EXTENTS].count) && update_extents(o, b);
    if (made)
        replace_resized_bodies(o, game, b, tick);
    for (size_t i = 0; made && i < sizeof passes / sizeof passes[0]; i++)
        made = make_edits_of_kind(o, &b->changes[POSITIONS], tick, passes[i].kind, passes[i].again);
    return made;
}
