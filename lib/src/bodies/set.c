/* SPDX-License-Identifier: MIT */
/* set.c - creates sets of bodies, and inserts, removes and moves single bodies. */
#include "boxes.h"
#include "lookup.h"
#include "few_bodies.h"
#include "../exact/float_mode.h"
#include "../query/search.h"
#include "../tree/undo.h"
#include "../tree/walk.h"

/* ---- Create ------------------------------------------------------------------------------------------------- */

octree_def octree_bodies_def_default(void)
{
    octree_def def = octree_def_default();
    def.leaf_capacity = 32;
    return def;
}

static octree_status create_set(const octree_allocator *allocator, octree_bodies **bodies)
{
    arena memory = {.allocator = *allocator};
    octree_bodies *made = arena_allocate(&memory, sizeof *made);
    if (!made)
        return OCTREE_NO_MEMORY;
    memset(made, 0, sizeof *made);
    made->memory = memory;
    made->due = SIZE_MAX;
    rows_init(&made->rows, &made->memory);
    *bodies = made;
    return OCTREE_OK;
}

octree_status octree_bodies_create(const octree_def *def, octree_bodies **bodies)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_create, def, bodies);
    octree *anchor;
    if (!bodies)
        return OCTREE_NULL_ARGUMENT;
    *bodies = NULL;
    if (def && def->full_leaf == OCTREE_REFUSE)
        return OCTREE_BAD_OPTION;
    octree_status status = def ? create_tree(def, NODE_WITH_BOX, &anchor) : OCTREE_NULL_ARGUMENT;
    if (status != OCTREE_OK)
        return status;
    const octree_def clamped = octree_definition(anchor);
    status = create_set(&clamped.allocator, bodies);
    if (status != OCTREE_OK) {
        octree_destroy(anchor);
        return status;
    }
    (*bodies)->def = clamped;
    if (def->leaf_capacity == OCTREE_AUTO)
        (*bodies)->def.leaf_capacity = OCTREE_AUTO;
    (*bodies)->world_exponent = find_exponent_of_world(&def->world);
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++)
        (*bodies)->levels[i] = make_empty_level(*bodies, i);
    (*bodies)->levels[OCTREE_BODY_LEVELS - 1].tree = anchor;
    return OCTREE_OK;
}

octree_bodies show_points_as_bodies(const octree *tree, const double half[3])
{
    octree_bodies shown = {.memory.allocator = tree->def.allocator, .def = tree->def, .points = tree};
    level *l = &shown.levels[OCTREE_BODY_LEVELS - 1];
    l->tree = (octree *)(uintptr_t)tree; /* never changed: changes of the set are refused */
    l->rest = HUGE_VAL;
    for (int i = 0; i < 3; i++)
        shown.point_half[i] = l->reach[i] = half[i];
    return shown;
}

octree_status octree_bodies_of_points(const octree *tree, const double half[3], octree_bodies **bodies)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_of_points, tree, half, bodies);
    if (!bodies)
        return OCTREE_NULL_ARGUMENT;
    *bodies = NULL;
    if (!tree || !half)
        return OCTREE_NULL_ARGUMENT;
    octree_status status = check_half_extents(half);
    if (status == OCTREE_OK)
        status = create_set(&tree->def.allocator, bodies);
    if (status != OCTREE_OK)
        return status;
    const arena memory = (*bodies)->memory;
    **bodies = show_points_as_bodies(tree, half);
    (*bodies)->memory = memory;
    rows_init(&(*bodies)->rows, &(*bodies)->memory);
    return OCTREE_OK;
}

void set_half_extents(octree_bodies *set, const double reach[3], half_lookup *half_of, const void *context)
{
    memcpy(set->levels[OCTREE_BODY_LEVELS - 1].reach, reach, sizeof(double[3]));
    set->half_of = half_of;
    set->half_context = context;
}

/* Returns whether this thread is running a callback of the set, or of the tree of one of its levels. */
static bool is_running_set_callback(const octree_bodies *set)
{
    bool running = is_running_callback(listed_as(set));
    for (unsigned i = 0; visits_of_thread.depth > 0 && !set->points && i < OCTREE_BODY_LEVELS; i++)
        running |= is_running_callback(set->levels[i].tree);
    return running;
}

octree_status check_set_change(const octree_bodies *set)
{
    if (!set)
        return OCTREE_NULL_ARGUMENT;
    return set->points ? OCTREE_BAD_OPTION : is_running_set_callback(set) ? OCTREE_BUSY : OCTREE_OK;
}

octree_status octree_bodies_clear(octree_bodies *bodies)
{
    const octree_status status = check_set_change(bodies);
    if (status != OCTREE_OK)
        return status;
    set_floor(bodies, (const double[3]){0, 0, 0});
    bodies->due = SIZE_MAX;
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++) {
        if (bodies->levels[i].tree)
            octree_clear(bodies->levels[i].tree);
        reset_level(bodies, i);
    }
    rows_release(&bodies->rows);
    return OCTREE_OK;
}

void octree_bodies_destroy(octree_bodies *bodies)
{
    if (!bodies || is_running_set_callback(bodies))
        return;
    for (unsigned i = 0; !bodies->points && i < OCTREE_BODY_LEVELS; i++)
        octree_destroy(bodies->levels[i].tree);
    rows_release(&bodies->rows);
    arena memory = bodies->memory;
    arena_free(&memory, bodies, sizeof *bodies);
}

/* ---- Change a single body ----------------------------------------------------------------------------------- */

octree_status check_half_extents(const double half[3])
{
    octree_status status = OCTREE_OK;
    for (int i = 0; i < 3 && status == OCTREE_OK; i++)
        status = check_length(half[i]);
    return status;
}

octree_status check_body(const octree_bodies *set, const octree_body *body)
{
    if (!body)
        return OCTREE_NULL_ARGUMENT;
    const octree_status status = check_position(anchor_of(set), body->position);
    return status == OCTREE_OK ? check_half_extents(body->half) : status;
}

octree_status check_move(const octree_bodies *set, const octree_body *from, const octree_body *to)
{
    const octree_status status = check_body(set, from);
    return status == OCTREE_OK ? check_body(set, to) : status;
}

static octree_status check_change_of_body(const octree_bodies *set, const octree_body *body)
{
    const octree_status status = check_set_change(set);
    return status == OCTREE_OK ? check_body(set, body) : status;
}

/* Make room for a body that is not stored. If its level has no tree yet, create the tree, and find the place again. */
static octree_status prepare_insertion(octree_bodies *set, const octree_body *body, found_body *place)
{
    octree **tree = &set->levels[place->level].tree;
    if (!*tree) {
        const octree_status status = create_level(set, place->level);
        if (status != OCTREE_OK)
            return status;
        find_body_for_change(set, body, NULL, place);
    }
    return rows_reserve(&set->rows, 1);
}

/* Insert the point of a body that is not stored, and for which there is room. The row is written before the tree is
 * changed. If the change of the tree fails, the row is removed again, which needs no memory. */
static octree_status insert_new_body(octree_bodies *set, const octree_body *body, const found_body *place)
{
    level *l = &set->levels[place->level];
    const uint32_t row = rows_add(&set->rows, body);
    const octree_point point = make_point(l, row, body);
    const octree_status status = insert_along_path(l->tree, &place->at.path, &point, place->code);
    if (status != OCTREE_OK) {
        rows_remove(&set->rows, row);
        return status;
    }
    change_reach(set, place->level, body->half, 1);
    fit_path(l, &place->at.path, NULL, &point);
    return OCTREE_OK;
}

/* Under OCTREE_AUTO, the tree of a level may be rebuilt with another capacity. */
static void tune_level(octree_bodies *set, unsigned number)
{
    const level *l = &set->levels[number];
    const size_t capacity = l->tree->def.leaf_capacity;
    if (!l->tree->tuning.choose)
        return;
    const unsigned begun = begin_set_callbacks(set); /* the executor */
    tune_if_due(l->tree);
    end_callbacks(begun);
    if (l->tree->def.leaf_capacity != capacity)
        fit_all(l);
}

octree_status octree_bodies_insert(octree_bodies *bodies, const octree_body *body)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_insert, bodies, body);
    octree_status status = check_change_of_body(bodies, body);
    if (status != OCTREE_OK)
        return status;
    const octree_body added = *body;
    found_body place;
    if (find_body_for_change(bodies, &added, NULL, &place))
        return OCTREE_DUPLICATE;
    status = prepare_insertion(bodies, &added, &place);
    if (status == OCTREE_OK)
        status = insert_new_body(bodies, &added, &place);
    if (status == OCTREE_OK) {
        tune_level(bodies, place.level);
        rebuild_if_due(bodies);
    }
    return status;
}

octree_status octree_bodies_remove(octree_bodies *bodies, const octree_body *body)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_remove, bodies, body);
    octree_status status = check_change_of_body(bodies, body);
    if (status != OCTREE_OK)
        return status;
    const octree_body removed = *body;
    found_body found;
    if (!find_body_for_change(bodies, &removed, NULL, &found))
        return OCTREE_NOT_FOUND;
    const level *l = &bodies->levels[found.level];
    const octree_point point = stored_point(&found.at);
    status = remove_along_path(l->tree, &found.at, found.code);
    if (status == OCTREE_OK) {
        fit_path(l, &found.at.path, &point, NULL);
        change_reach(bodies, found.level, removed.half, -1);
        rows_remove(&bodies->rows, found.row);
    }
    return status;
}

/* Move a point from one tree to another. The memory for the removal is allocated first, so that nothing can fail after
 * the insertion. */
static octree_status move_to_level(octree *old, const octree_point *from, octree *new, const octree_point *to)
{
    prepared_removal leaving;
    octree_status status = prepare_removal(old, from->position, from->id, &leaving);
    if (status != OCTREE_OK)
        return status;
    status = octree_insert(new, to->position, to->id);
    if (status == OCTREE_OK)
        make_removal(old, &leaving);
    else
        cancel_removal(old, &leaving);
    return status;
}

static octree_status move_within_level(octree *tree, const octree_point *leaving, const octree_point *arriving,
                                       found_body *from, const found_body *to)
{
    const single_move m = {.old = *leaving, .moved = *arriving, .from = from->code, .to = to->code};
    return move_found_point(tree, &m, &from->at, &to->at.path, NULL);
}

/* Move the point of a body, perhaps from one level to another, and update the boxes. `from` and `to` are the body's
 * places before and after the move. */
static octree_status move_point(octree_bodies *set, const octree_body *moved, found_body *from, const found_body *to)
{
    level *l = &set->levels[from->level], *next = &set->levels[to->level];
    const octree_point leaving = stored_point(&from->at), arriving = make_point(next, from->row, moved);
    const bool stays_in_leaf = l == next && path_end(&from->at.path) == path_end(&to->at.path);
    octree_status status = create_level(set, to->level);
    if (status == OCTREE_OK)
        status = l == next ? move_within_level(l->tree, &leaving, &arriving, from, to)
                           : move_to_level(l->tree, &leaving, next->tree, &arriving);
    if (status != OCTREE_OK)
        return status;
    if (stays_in_leaf) { /* then no node has changed */
        fit_path(l, &to->at.path, &leaving, &arriving);
    } else {
        fit_point(l, &leaving, false);
        fit_point(next, &arriving, true);
    }
    return OCTREE_OK;
}

/* Check a move, and find the places of the moved body before and after. */
static octree_status find_moved_body(octree_bodies *set, const octree_body *from, const octree_body *to,
                                     found_body *old, found_body *moved)
{
    const octree_status status = check_move(set, from, to);
    if (status != OCTREE_OK)
        return status;
    if (!find_body_for_change(set, from, NULL, old))
        return OCTREE_NOT_FOUND;
    return !find_body_for_change(set, to, old, moved) || moved->row == old->row ? OCTREE_OK : OCTREE_DUPLICATE;
}

octree_status octree_bodies_move(octree_bodies *bodies, const octree_body *from, const octree_body *to)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_bodies_move, bodies, from, to);
    found_body here, there;
    octree_status status = check_set_change(bodies);
    if (status == OCTREE_OK)
        status = find_moved_body(bodies, from, to, &here, &there);
    if (status != OCTREE_OK)
        return status;
    const octree_body old = *from, moved = *to;
    const unsigned begun = begin_set_callbacks(bodies);
    status = move_point(bodies, &moved, &here, &there);
    end_callbacks(begun);
    if (status != OCTREE_OK)
        return status;
    if (!is_same_position(old.half, moved.half)) {
        change_reach(bodies, here.level, old.half, -1);
        change_reach(bodies, there.level, moved.half, 1);
    }
    rows_replace(&bodies->rows, here.row, &moved);
    return OCTREE_OK;
}

/* ---- Read --------------------------------------------------------------------------------------------------- */

size_t octree_bodies_count(const octree_bodies *bodies)
{
    return !bodies ? 0 : bodies->points ? octree_count(bodies->points) : bodies->rows.count;
}

octree_def octree_bodies_definition(const octree_bodies *bodies)
{
    return octree_definition(bodies ? anchor_of(bodies) : NULL);
}

bool octree_bodies_contain(const octree_bodies *bodies, const octree_body *body)
{
    RETURN_IN_DEFAULT_MODE(bool, octree_bodies_contain, bodies, body);
    if (!bodies || !body || check_body(bodies, body) != OCTREE_OK)
        return false;
    if (bodies->points) {
        octree_body stored;
        const octree_point point = {.position = {body->position[0], body->position[1], body->position[2]},
                                    .id = body->id};
        return octree_contains(bodies->points, body->position, body->id) &&
               is_same_position(load_body(bodies, &point, &stored)->half, body->half);
    }
    found_body found;
    return find_body(bodies, body, &found);
}

const octree *octree_bodies_level(const octree_bodies *bodies, unsigned level, double reach[3])
{
    if (!bodies || level >= OCTREE_BODY_LEVELS)
        return NULL;
    if (reach)
        memcpy(reach, bodies->levels[level].reach, sizeof bodies->levels[level].reach);
    return bodies->levels[level].tree;
}

void octree_bodies_at(const octree_bodies *bodies, const octree_point *point, octree_body *body)
{
    octree_body scratch;
    *body = *load_body(bodies, point, &scratch);
}

size_t octree_bodies_memory(const octree_bodies *bodies)
{
    size_t bytes = bodies ? bodies->memory.bytes : 0;
    for (unsigned i = 0; bodies && !bodies->points && i < OCTREE_BODY_LEVELS; i++)
        bytes += bodies->levels[i].tree ? bodies->levels[i].tree->store.memory.bytes : 0;
    return bytes;
}

/* An octree_node_visitor: add the digests of the bodies of a leaf. */
typedef struct summation {
    const octree_bodies *set;
    uint64_t sum;
} summation;

static octree_walk_order add_leaf_digests(const octree_node *node, void *context)
{
    summation *s = context;
    octree_body scratch;
    for (size_t i = 0; node->leaf && i < node->count; i++)
        s->sum += digest_body(load_body(s->set, &node->points[i], &scratch));
    return OCTREE_WALK_ON;
}

uint64_t octree_bodies_digest(const octree_bodies *bodies)
{
    RETURN_IN_DEFAULT_MODE(uint64_t, octree_bodies_digest, bodies);
    if (!bodies)
        return 0;
    summation s = {bodies, 0};
    for (unsigned i = 0; i < OCTREE_BODY_LEVELS; i++)
        if (bodies->levels[i].tree)
            octree_walk(bodies->levels[i].tree, add_leaf_digests, &s);
    const octree_def *def = bodies->points ? &bodies->points->def : &bodies->def;
    return digest_of_definition(def, s.sum);
}

int octree_compare_bodies(const void *a, const void *b)
{
    const octree_body *x = a, *y = b;
    if (x->id != y->id)
        return x->id < y->id ? -1 : 1;
    RETURN_IN_DEFAULT_MODE(int, octree_compare_bodies, a, b);
    const int order = compare_positions(x->position, y->position);
    return order ? order : compare_positions(x->half, y->half);
}
