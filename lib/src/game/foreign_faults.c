/* SPDX-License-Identifier: MIT */
/* foreign_faults.c - what can be proved wrong about a program's nodes, by themselves and by how queries met them.
 *
 * Nothing is held against a program that need not be so: a node that says nothing of its points may have any in its
 * box, a point may be in several nodes, once in each, and boxes may overlap.
 */
#include "foreign.h"
#include "game_state.h"
#include "point.h"

#include <stdlib.h>

const char *octree_precision_name(octree_precision precision)
{
    static const char *const names[OCTREE_PRECISIONS] = {"double", "float"};
    return (unsigned)precision < OCTREE_PRECISIONS ? names[precision] : NULL;
}

static const struct {
    const char *name, *words;
} fault_rows[OCTREE_NODE_FAULTS] = {
    [OCTREE_NODE_OUTSIDE_PARENT] = {"outside_parent", "its box leaves its parent's"},
    [OCTREE_NODE_UNKNOWN_POINT] = {"unknown_point", "it lists a point that is not there"},
    [OCTREE_NODE_OUTSIDE_POINT] = {"outside_point", "it lists a point outside its box"},
    [OCTREE_NODE_REPEATED_POINT] = {"repeated_point", "it lists a point more than once"},
    [OCTREE_NODE_LOST_POINT] = {"lost_point", "a point is in no node"},
    [OCTREE_NODE_UNKNOWN_NODE] = {"unknown_node", "a query met it, and it is not there"},
    [OCTREE_NODE_PRUNED_POINT] = {"pruned_point", "a query pruned it, and its answer lacks a point in it"},
};

const char *octree_node_fault_name(octree_node_fault_kind kind)
{
    return (unsigned)kind < OCTREE_NODE_FAULTS ? fault_rows[kind].name : NULL;
}

const char *octree_node_fault_words(octree_node_fault_kind kind)
{
    return (unsigned)kind < OCTREE_NODE_FAULTS ? fault_rows[kind].words : NULL;
}

static octree_foreign_place *places_of(const foreign *f)
{
    return f->places.items;
}

/* A fault of the node at a place; SIZE_MAX: of none that there is. */
static bool accuse(octree_game *game, size_t place, octree_node_fault fault)
{
    foreign *f = &game->foreign;
    game->tick.foreign.faults[fault.kind]++;
    if (place != SIZE_MAX) {
        fault.node = places_of(f)[place].node->id;
        places_of(f)[place].faults |= 1u << fault.kind;
    }
    return f->faults.count == OCTREE_LISTED_NODE_FAULTS || list_push(&game->memory, &f->faults, &fault, sizeof fault);
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

static octree_box rounded_box(const octree_box *box)
{
    octree_box rounded;
    for (int i = 0; i < 3; i++) {
        rounded.min[i] = round_to_float(box->min[i]);
        rounded.max[i] = round_to_float(box->max[i]);
    }
    return rounded;
}

bool foreign_holds(const octree_foreign_node *node, const double position[3])
{
    if (box_contains(&node->box, position) || node->precision == OCTREE_DOUBLES)
        return box_contains(&node->box, position);
    const octree_box box = rounded_box(&node->box);
    const double rounded[3] = {round_to_float(position[0]), round_to_float(position[1]), round_to_float(position[2])};
    return box_contains(&box, rounded);
}

/* A child of floats is compared in floats, and so is one whose parent is. */
static bool is_within_parent(const octree_foreign_node *child, const octree_foreign_node *parent)
{
    octree_box inner = child->box, outer = parent->box;
    if (child->precision == OCTREE_FLOATS || parent->precision == OCTREE_FLOATS) {
        inner = rounded_box(&inner);
        outer = rounded_box(&outer);
    }
    return box_contains(&outer, inner.min) && box_contains(&outer, inner.max);
}

/* ---- Nodes by themselves ------------------------------------------------------------------------------------ */

static bool check_parents(octree_game *game)
{
    const octree_foreign_place *places = places_of(&game->foreign);
    bool whole = true;
    for (size_t i = 0; whole && i < game->foreign.places.count; i++)
        if (places[i].parent != SIZE_MAX && !is_within_parent(places[i].node, places[places[i].parent].node))
            whole = accuse(game, i, (octree_node_fault){.kind = OCTREE_NODE_OUTSIDE_PARENT});
    return whole;
}

/* The points that a node lists. */
static bool check_points(octree_game *game, size_t place)
{
    foreign *f = &game->foreign;
    const octree_foreign_node *node = places_of(f)[place].node;
    bool whole = true;
    for (size_t i = 0; whole && i < node->points.count; i++) {
        octree_point point;
        const uint64_t id = node->points.ids[i];
        if (!octree_game_find(game, id, &point))
            whole = accuse(game, place, (octree_node_fault){.kind = OCTREE_NODE_UNKNOWN_POINT, .point = id});
        else if (!foreign_holds(node, point.position))
            whole = accuse(game, place, (octree_node_fault){.kind = OCTREE_NODE_OUTSIDE_POINT, .point = id});
        whole = whole && list_push(&game->memory, &f->holdings, &(foreign_holding){id, place}, sizeof(foreign_holding));
    }
    return whole;
}

static bool is_same_holding(const foreign_holding *a, const foreign_holding *b)
{
    return a->id == b->id && a->place == b->place;
}

static int compare_by_place(const void *a, const void *b)
{
    const foreign_holding *p = a, *q = b;
    return p->place != q->place ? (p->place > q->place) - (p->place < q->place) : (p->id > q->id) - (p->id < q->id);
}

/* The points that a node lists more than once, by node and then by point. The holdings are sorted. */
static bool accuse_repeated(octree_game *game)
{
    foreign *f = &game->foreign;
    const foreign_holding *items = f->holdings.items;
    bool whole = true;
    f->repeated.count = 0;
    for (size_t i = 1; whole && i < f->holdings.count; i++)
        if (is_same_holding(&items[i], &items[i - 1]) && !(i > 1 && is_same_holding(&items[i], &items[i - 2])))
            whole = list_push(&game->memory, &f->repeated, &items[i], sizeof *items);
    const foreign_holding *repeated = f->repeated.items;
    if (f->repeated.count > 1)
        qsort(f->repeated.items, f->repeated.count, sizeof *repeated, compare_by_place);
    for (size_t i = 0; whole && i < f->repeated.count; i++)
        whole = accuse(game, repeated[i].place,
                       (octree_node_fault){.kind = OCTREE_NODE_REPEATED_POINT, .point = repeated[i].id});
    return whole;
}

static int compare_holdings(const void *a, const void *b)
{
    const foreign_holding *p = a, *q = b;
    return p->id != q->id ? (p->id > q->id) - (p->id < q->id) : (p->place > q->place) - (p->place < q->place);
}

/* The first holding of a point; the others follow it. */
static size_t first_holding(const foreign *f, uint64_t point)
{
    const foreign_holding *items = f->holdings.items;
    size_t first = 0, end = f->holdings.count;
    while (first < end) {
        const size_t middle = first + (end - first) / 2;
        if (items[middle].id < point)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

static bool is_listed(const foreign *f, uint64_t point)
{
    const size_t first = first_holding(f, point);
    return first < f->holdings.count && ((const foreign_holding *)f->holdings.items)[first].id == point;
}

static bool holds_by_box(const octree_foreign_place *place)
{
    return place->leaf && !place->node->has_points;
}

/* ---- Points that no node holds ------------------------------------------------------------------------------ */

typedef struct holding_search {
    octree_game *game;
    const octree_foreign_node *leaf;
    size_t lost; /* bodies that nobody holds so far */
} holding_search;

static bool hold_point(const octree_point *point, void *context)
{
    holding_search *s = context;
    const bodies *all = &s->game->bodies;
    const moving_body *body = bodies_find(all, point->id);
    bool *held = s->game->foreign.held.items;
    if (body && !held[body - bodies_items(all)] && foreign_holds(s->leaf, point->position)) {
        held[body - bodies_items(all)] = true;
        s->lost--;
    }
    return s->lost > 0;
}

/* A box that has all that rounds into a leaf of floats. */
static octree_box reach_of(const octree_foreign_node *leaf)
{
    octree_box box = leaf->box;
    for (int i = 0; leaf->precision == OCTREE_FLOATS && i < 3; i++) {
        box.min[i] -= fabs(box.min[i]) * 0x1p-22 + 0x1p-148;
        box.max[i] += fabs(box.max[i]) * 0x1p-22 + 0x1p-148;
    }
    return box;
}

static void hold_by_boxes(octree_game *game, holding_search *search)
{
    const octree_foreign_place *places = places_of(&game->foreign);
    for (size_t i = 0; search->lost > 0 && i < game->foreign.places.count; i++) {
        if (!holds_by_box(&places[i]))
            continue;
        const octree_box box = reach_of(places[i].node);
        search->leaf = places[i].node;
        octree_range(game->tree, &box, hold_point, search); /* such a box is not refused */
    }
}

static int compare_ids(const void *a, const void *b)
{
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

/* By id, whatever the order of the bodies is. */
static bool accuse_lost(octree_game *game)
{
    foreign *f = &game->foreign;
    const bool *held = f->held.items;
    bool whole = true;
    f->lost.count = 0;
    for (size_t i = 0; whole && i < game->bodies.items.count; i++)
        if (!held[i])
            whole = list_push(&game->memory, &f->lost, &bodies_items(&game->bodies)[i].id, sizeof(uint64_t));
    uint64_t *ids = f->lost.items;
    if (f->lost.count > 1)
        qsort(ids, f->lost.count, sizeof *ids, compare_ids);
    for (size_t i = 0; whole && i < f->lost.count; i++)
        whole = accuse(game, SIZE_MAX, (octree_node_fault){.kind = OCTREE_NODE_LOST_POINT, .point = ids[i]});
    return whole;
}

static octree_status find_lost_points(octree_game *game)
{
    foreign *f = &game->foreign;
    holding_search search = {.game = game};
    f->held.count = 0;
    for (size_t i = 0; i < game->bodies.items.count; i++) {
        const bool held = is_listed(f, bodies_items(&game->bodies)[i].id);
        if (!list_push(&game->memory, &f->held, &held, sizeof held))
            return OCTREE_NO_MEMORY;
        search.lost += !held;
    }
    hold_by_boxes(game, &search);
    return search.lost == 0 || accuse_lost(game) ? OCTREE_OK : OCTREE_NO_MEMORY;
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

void foreign_begin_tick(octree_game *game)
{
    enum { OF_QUERIES = 1 << OCTREE_NODE_UNKNOWN_NODE | 1 << OCTREE_NODE_PRUNED_POINT };
    foreign *f = &game->foreign;
    octree_foreign_state *state = &game->tick.foreign;
    if (!state->given)
        return;
    const size_t *met = f->met.items;
    for (size_t i = 0; i < f->met.count; i++) {
        places_of(f)[met[i]].met = 0;
        places_of(f)[met[i]].faults &= ~(unsigned)OF_QUERIES;
    }
    f->met.count = 0;
    state->fresh = false;
    for (int kind = 0; kind < OCTREE_MET_KINDS; kind++)
        state->met[kind] = 0;
}

/* All kinds of faults but those of queries. */
static octree_status find_standing(octree_game *game)
{
    foreign *f = &game->foreign;
    octree_foreign_state *state = &game->tick.foreign;
    memset(state->faults, 0, sizeof state->faults);
    f->faults.count = f->holdings.count = 0;
    for (size_t i = 0; i < f->places.count; i++)
        places_of(f)[i].faults = 0;
    bool whole = check_parents(game);
    for (size_t i = 0; whole && i < f->places.count; i++)
        whole = check_points(game, i);
    if (!whole)
        return OCTREE_NO_MEMORY;
    if (f->holdings.count > 1)
        qsort(f->holdings.items, f->holdings.count, sizeof(foreign_holding), compare_holdings);
    const octree_status status = accuse_repeated(game) ? find_lost_points(game) : OCTREE_NO_MEMORY;
    f->standing = f->faults.count;
    memcpy(f->standing_counts, state->faults, sizeof state->faults);
    f->checked = status == OCTREE_OK;
    f->version = octree_version(game->tree);
    return status;
}

octree_status foreign_check(octree_game *game)
{
    foreign *f = &game->foreign;
    if (!game->tick.foreign.given)
        return OCTREE_OK;
    if (!f->checked || f->version != octree_version(game->tree))
        return find_standing(game);
    f->faults.count = f->standing;
    memcpy(game->tick.foreign.faults, f->standing_counts, sizeof f->standing_counts);
    return OCTREE_OK;
}

/* ---- Queries ------------------------------------------------------------------------------------------------ */

typedef struct meeting {
    octree_game *game;
    size_t answer; /* the place of the query's */
} meeting;

static foreign_mark *marks_of(const foreign *f)
{
    return f->marks.items;
}

static bool note_met(const meeting *m, octree_met met, uint64_t id)
{
    foreign *f = &m->game->foreign;
    const size_t place = foreign_find(f, id);
    if (place == SIZE_MAX)
        return accuse(m->game, place,
                      (octree_node_fault){.kind = OCTREE_NODE_UNKNOWN_NODE, .node = id, .answer = m->answer});
    octree_foreign_place *node = &places_of(f)[place];
    m->game->tick.foreign.met[met] += !(node->met >> met & 1);
    node->met |= 1u << met;
    foreign_mark *mark = &marks_of(f)[place];
    const bool first = mark->query != f->query;
    if (first || mark->met == OCTREE_MET_PRUNED) /* what was looked into was not left out */
        *mark = (foreign_mark){.query = f->query, .met = met};
    return list_push(&m->game->memory, &f->met, &place, sizeof place);
}

/* The first node from a place up that the query met, where that is a pruned one; else SIZE_MAX. */
static size_t pruned_above(const foreign *f, size_t place)
{
    while (place != SIZE_MAX && marks_of(f)[place].query != f->query)
        place = places_of(f)[place].parent;
    return place != SIZE_MAX && marks_of(f)[place].met == OCTREE_MET_PRUNED ? place : SIZE_MAX;
}

/* Visit the places that hold a point, until a visitor says no. */
static void for_each_holder(const meeting *m, const octree_point *point, bool (*visit)(size_t place, void *),
                            void *context)
{
    const foreign *f = &m->game->foreign;
    const foreign_holding *items = f->holdings.items;
    const size_t first = first_holding(f, point->id);
    bool on = true;
    for (size_t i = first; on && i < f->holdings.count && items[i].id == point->id; i++)
        on = visit(items[i].place, context);
    if (first < f->holdings.count && items[first].id == point->id)
        return;
    for (size_t i = 0; on && i < f->places.count; i++)
        if (holds_by_box(&places_of(f)[i]) && foreign_holds(places_of(f)[i].node, point->position))
            on = visit(i, context);
}

typedef struct holder_count {
    const foreign *foreign;
    size_t pruned, others;
} holder_count;

static bool count_holder(size_t place, void *context)
{
    holder_count *c = context;
    const bool pruned = pruned_above(c->foreign, place) != SIZE_MAX;
    c->pruned += pruned;
    c->others += !pruned;
    return pruned;
}

/* Whether the query pruned all nodes that hold a point. */
static bool is_pruned(const octree_point *point, void *context)
{
    const meeting *m = context;
    const octree_player *player = &m->game->session->player;
    holder_count count = {.foreign = &m->game->foreign};
    if (player->kind == OCTREE_PLAYER_KEYS && point->id == player->id)
        return false;
    for_each_holder(m, point, count_holder, &count);
    return count.pruned > 0 && count.others == 0;
}

typedef struct blaming {
    const meeting *meeting;
    const octree_point *point;
    bool failed;
} blaming;

/* Each node once a query, with the first such point. */
static bool blame_holder(size_t place, void *context)
{
    blaming *b = context;
    octree_game *game = b->meeting->game;
    const size_t pruned = pruned_above(&game->foreign, place);
    foreign_mark *mark = &marks_of(&game->foreign)[pruned];
    if (!mark->blamed)
        b->failed |= !accuse(
            game, pruned,
            (octree_node_fault){.kind = OCTREE_NODE_PRUNED_POINT, .point = b->point->id, .answer = b->meeting->answer});
    mark->blamed = true;
    return !b->failed;
}

static octree_status blame(const octree_point *point, void *context)
{
    blaming b = {.meeting = context, .point = point};
    for_each_holder(context, point, blame_holder, &b);
    return b.failed ? OCTREE_NO_MEMORY : OCTREE_OK;
}

octree_status foreign_meet(const judging *about)
{
    octree_game *game = about->game;
    const octree_query *query = about->query;
    meeting m = {game, game->answers.count - 1};
    bool whole = true;
    game->foreign.query++;
    for (int met = 0; met < OCTREE_MET_KINDS; met++)
        for (size_t i = 0; whole && i < query->met[met].count; i++)
            whole = note_met(&m, (octree_met)met, query->met[met].ids[i]);
    if (!whole)
        return OCTREE_NO_MEMORY;
    return query->met[OCTREE_MET_PRUNED].count ? judge_without(about, is_pruned, blame, &m) : OCTREE_OK;
}
