/* SPDX-License-Identifier: MIT */
/* contents.c - reads the points of a program from its tree, its list, or its changes: see contents.h. */
#include "contents.h"
#include "array.h"
#include "octree/digest.h"
#include "octree/octree.h"
#include "session_file.h"
#include "status.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>

void contents_release(contents *c)
{
    for (int i = 0; i < TRACKS; i++)
        track_release(&c->tracks[i]);
    points_release(&c->spare);
    *c = (contents){0};
}

static bool is_finite_place(const double at[3])
{
    return isfinite(at[0]) && isfinite(at[1]) && isfinite(at[2]);
}

static bool are_valid_extents(const double half[3])
{
    return is_finite_place(half) && half[0] >= 0 && half[1] >= 0 && half[2] >= 0;
}

#define BAD_PLACE "%s[%zu]: a coordinate is NaN or infinite"
#define BAD_EXTENTS "%s[%zu]: a half extent is negative, NaN or infinite"

/* ---- The definition of a tree ------------------------------------------------------------------------------- */

/* Check that a tree has the same world and options as the definition with which the recorder was opened. */
static octreel_status check_tree_definition(const octree_def *own, const octree *tree, octreel_error *error)
{
    const octree_def def = octree_definition(tree);
    for (int i = 0; i < 3; i++)
        if (def.world.min[i] != own->world.min[i] || def.world.max[i] != own->world.max[i])
            return status_refuse(
                error, OCTREEL_OTHER_TREE,
                "the tree's world on axis %c is [%.17g, %.17g], but the recorder was opened with [%.17g, %.17g]",
                "xyz"[i], def.world.min[i], def.world.max[i], own->world.min[i], own->world.max[i]);
    if (def.leaf_capacity != own->leaf_capacity)
        return status_refuse(error, OCTREEL_OTHER_TREE,
                             "the tree's leaf_capacity is %zu, but the recorder was opened with %zu; OCTREE_AUTO "
                             "changes the capacity: give the tree a fixed capacity",
                             def.leaf_capacity, own->leaf_capacity);
    if (def.max_depth != own->max_depth)
        return status_refuse(error, OCTREEL_OTHER_TREE,
                             "the tree's max_depth is %zu, but the recorder was opened with %zu", def.max_depth,
                             own->max_depth);
    if (def.full_leaf != own->full_leaf)
        return status_refuse(error, OCTREEL_OTHER_TREE,
                             "the tree's full_leaf differs from the definition with which the recorder was opened");
    return OCTREEL_OK;
}

/* ---- The tracks --------------------------------------------------------------------------------------------- */

static bool switch_to_tables(contents *c)
{
    points_release(&c->spare);
    return track_switch_to_table(&c->tracks[POSITIONS]) && track_switch_to_table(&c->tracks[EXTENTS]);
}

static bool switch_to_lists(contents *c)
{
    return track_switch_to_lists(&c->tracks[POSITIONS], &c->spare) &&
           track_switch_to_lists(&c->tracks[EXTENTS], &c->spare);
}

/* ---- Changes from the program ------------------------------------------------------------------------------- */

/* Change the half extents of a body as an edit says. `half` are those of an insertion, or null if they are 0. Returns
 * false if memory runs out. */
static bool change_extents(contents *c, const octree_edit *edit, const double *half)
{
    track *extents = &c->tracks[EXTENTS];
    if (!half && extents->table.count == 0) /* a program of points pays no more than this test */
        return true;
    const octree_point *old = point_table_find(&extents->table, edit->body.id);
    const double *from = old ? old->position : NULL, *to = edit->kind == OCTREE_EDIT_MOVE ? from : half;
    return from == to || track_change_point(extents, edit->body.id, from, to);
}

static octreel_status add_edit(contents *c, const octree_edit *edit, size_t number, octreel_error *error)
{
    const octree_game_body *body = &edit->body;
    const bool inserts = edit->kind == OCTREE_EDIT_INSERT, removes = edit->kind == OCTREE_EDIT_REMOVE;
    if ((unsigned)edit->kind > OCTREE_EDIT_MOVE)
        return status_refuse(error, OCTREEL_BAD_POINT, "changes[%zu]: unknown kind of edit", number);
    if (body->id >= SESSION_ID_LIMIT)
        return status_refuse(error, OCTREEL_BAD_ID, "changes[%zu]: %s: %" PRIu64, number,
                             octreel_status_text(OCTREEL_BAD_ID), body->id);
    const double *half = inserts && has_extents(body->half) ? body->half : NULL;
    if (!removes && !is_finite_place(body->position))
        return status_refuse(error, OCTREEL_BAD_POINT, BAD_PLACE, "changes", number);
    if (half && !are_valid_extents(half))
        return status_refuse(error, OCTREEL_BAD_POINT, BAD_EXTENTS, "changes", number);
    const octree_point *there = point_table_find(&c->tracks[POSITIONS].table, body->id);
    if (inserts && there)
        return status_refuse(error, OCTREEL_DUPLICATE_ID, "changes[%zu]: point %" PRIu64 " exists already", number,
                             body->id);
    if (!inserts && !there)
        return status_refuse(error, OCTREEL_NO_POINT, "changes[%zu]: point %" PRIu64 " does not exist", number,
                             body->id);
    return track_change_point(&c->tracks[POSITIONS], body->id, there ? there->position : NULL,
                              removes ? NULL : body->position) &&
                   change_extents(c, edit, half)
               ? OCTREEL_OK
               : status_fail(error, OCTREEL_NO_MEMORY);
}

static octreel_status read_edits(contents *c, const octreel_tick_info *about, octreel_error *error)
{
    octreel_status first = OCTREEL_OK;
    octreel_error later;
    if (!switch_to_tables(c))
        return status_fail(error, OCTREEL_NO_MEMORY);
    c->source = FROM_CHANGES;
    for (size_t i = 0; i < about->change_count; i++) {
        const octreel_status status = add_edit(c, &about->changes[i], i, first == OCTREEL_OK ? error : &later);
        if (status == OCTREEL_NO_MEMORY)
            return status_fail(error, status);
        first = first == OCTREEL_OK ? status : first;
    }
    return first;
}

/* ---- A list, a set of bodies, or a whole tree ---------------------------------------------------------------- */

/* Read all points of a tree, or of the set or the list in `about` if the tree is null. */
static octreel_status read_all_points(contents *c, const octree *tree, const octreel_tick_info *about, uint64_t *clash)
{
    points *positions = &c->tracks[POSITIONS].next, *extents = &c->tracks[EXTENTS].next;
    if (about->body_set || about->bodies)
        return points_read_bodies(positions, extents, &c->spare, about->body_set, about->bodies,
                                  about->body_set ? octree_bodies_count(about->body_set) : about->body_count, clash);
    extents->count = 0;
    return points_read(positions, &c->spare, tree, about->points, tree ? octree_count(tree) : about->point_count,
                       clash);
}

/* Compare all points with the points of the tick before. */
static octreel_status read_and_compare(contents *c, const octree *tree, const octreel_tick_info *about,
                                       octreel_error *error)
{
    uint64_t clash = 0;
    const char *list = about->points ? "points" : "bodies";
    const bool listed = about->points || about->bodies;
    if (!switch_to_lists(c))
        return status_fail(error, OCTREEL_NO_MEMORY);
    const octreel_status status = read_all_points(c, tree, about, &clash);
    if (status == OCTREEL_DUPLICATE_ID && listed)
        return status_refuse(error, status, "%s: two %s have the id %" PRIu64, list, list, clash);
    if (status == OCTREEL_DUPLICATE_ID || status == OCTREEL_BAD_ID)
        return status_refuse(error, status, "%s%s%s: %" PRIu64, listed ? list : "", listed ? ": " : "",
                             octreel_status_text(status), clash);
    if (status != OCTREEL_OK)
        return status_fail(error, status);
    return track_compare_lists(&c->tracks[POSITIONS], c->many_changes) &&
                   track_compare_lists(&c->tracks[EXTENTS], c->many_changes)
               ? OCTREEL_OK
               : status_fail(error, OCTREEL_NO_MEMORY);
}

static octreel_status read_list_or_set(contents *c, const octreel_tick_info *about, octreel_error *error)
{
    for (size_t i = 0; i < about->point_count; i++)
        if (!is_finite_place(about->points[i].position))
            return status_refuse(error, OCTREEL_BAD_POINT, BAD_PLACE, "points", i);
    for (size_t i = 0; i < about->body_count; i++)
        if (!is_finite_place(about->bodies[i].position))
            return status_refuse(error, OCTREEL_BAD_POINT, BAD_PLACE, "bodies", i);
        else if (!are_valid_extents(about->bodies[i].half))
            return status_refuse(error, OCTREEL_BAD_POINT, BAD_EXTENTS, "bodies", i);
    return read_and_compare(c, NULL, about, error);
}

/* ---- Changes from a tree's log ------------------------------------------------------------------------------ */

/* Returns a new name for a cursor into a tree's change log. The name was not used before and is never 0. */
static size_t choose_cursor_name(contents *c)
{
    struct timespec now = {0};
    if (c->names == 0 && timespec_get(&now, TIME_UTC))
        c->names = octree_digest_word(octree_digest_word((uintptr_t)c, (uint64_t)now.tv_nsec), (uint64_t)now.tv_sec);
    const size_t name = (size_t)octree_digest_word(0, c->names++);
    return name ? name : 1;
}

/* Apply a change from a tree's log to the table. If two points of the tree have the same id, the table has only one of
 * them, and the changes of the other point are ignored. */
static void apply_logged_change(const octree_change *logged, void *context)
{
    contents *c = context;
    if (logged->id >= SESSION_ID_LIMIT)
        return;
    track *positions = &c->tracks[POSITIONS];
    const octree_point *there = point_table_find(&positions->table, logged->id);
    change unused;
    if (logged->kind != OCTREE_INSERTED && (!there || change_make(logged->id, there->position, logged->from, &unused)))
        return;
    c->log_incomplete |= !track_change_point(positions, logged->id, there ? there->position : NULL,
                                             logged->kind == OCTREE_REMOVED ? NULL : logged->to);
}

/* Read the changes since the last read from the tree's change log, and apply them to the table. Returns false if the
 * log no longer has all these changes, or if the table then has fewer points than the tree. The table lacks a point if
 * another point has the same id, or if the id is too large for the recorder's files. */
static bool read_log(contents *c, const octree *tree)
{
    c->log_incomplete = false;
    if (c->many_changes) /* A zero cursor does not ask for the tree's change log, so the tree may stop keeping a log. */
        c->mark = (octree_cursor){0};
    if (c->many_changes || (c->mark.log != 0 && !switch_to_tables(c)))
        return false;
    return octree_changes_since(tree, choose_cursor_name(c), &c->mark, apply_logged_change, c) && !c->log_incomplete &&
           c->tracks[POSITIONS].table.count == octree_count(tree);
}

static octreel_status read_tree(contents *c, const octree_def *def, const octree *tree, const octreel_tick_info *about,
                                octreel_error *error)
{
    const track *positions = &c->tracks[POSITIONS];
    octreel_status status = check_tree_definition(def, tree, error);
    if (status == OCTREEL_OK && !read_log(c, tree))
        status = read_and_compare(c, tree, about, error);
    c->many_changes = positions->changes.count - positions->kept > octree_count(tree) / 8 + 16;
    return status;
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

/* Find the source of this tick's points: tree, set, list or changes. If the program passes no points at this tick, the
 * source of the previous tick is used again, with an empty list of points or with no changes. */
static octreel_status choose_points_source(contents *c, const octree *tree, const octreel_tick_info *about,
                                           octreel_error *error)
{
    const bool points = about->points || about->point_count, bodies = about->bodies || about->body_count;
    const bool set = about->body_set, changes = about->changes || about->change_count;
    c->read_source = tree               ? FROM_TREE
                     : set              ? FROM_SET
                     : points || bodies ? FROM_LIST
                     : changes          ? FROM_CHANGES
                                        : c->source;
    if ((points && !about->points) || (bodies && !about->bodies) || (changes && !about->changes))
        return status_fail(error, OCTREEL_NULL_ARGUMENT);
    if ((tree != NULL) + set + points + bodies + changes > 1 ||
        (c->source != FROM_NOTHING && (c->source == FROM_TREE) != (c->read_source == FROM_TREE)))
        return status_fail(error, OCTREEL_TWO_SOURCES);
    const bool omitted = (c->read_source == FROM_TREE && !tree) || (c->read_source == FROM_SET && !set);
    return omitted ? status_fail(error, OCTREEL_NULL_ARGUMENT) : OCTREEL_OK;
}

octreel_status contents_read(contents *c, const octree_def *def, const octree *tree, const octreel_tick_info *about,
                             octreel_error *error)
{
    static const octreel_tick_info nothing;
    about = about ? about : &nothing;
    for (int i = 0; i < TRACKS; i++)
        track_begin_tick(&c->tracks[i]);
    const octreel_status status = choose_points_source(c, tree, about, error);
    if (status != OCTREEL_OK)
        return status;
    if (c->read_source == FROM_TREE)
        return read_tree(c, def, tree, about, error);
    if (c->read_source == FROM_CHANGES)
        return read_edits(c, about, error);
    return read_list_or_set(c, about, error);
}

void contents_move_changes_to_batch(contents *c, batch *b)
{
    for (int i = 0; i < TRACKS; i++) {
        change_list *from = &c->tracks[i].changes, *to = &b->changes[i];
        if (from->count == 0)
            continue;
        change *fitting = realloc(from->items, from->count * sizeof *fitting);
        *to = (change_list){fitting ? fitting : from->items, from->count, from->count};
        b->bytes += from->count * sizeof *fitting;
        *from = (change_list){0};
    }
}

void contents_move_changes_from_batch(contents *c, batch *b)
{
    for (int i = 0; i < TRACKS; i++) {
        if (b->changes[i].count == 0) /* contents_move_changes_to_batch() had none to move */
            continue;
        c->tracks[i].changes = b->changes[i];
        b->changes[i] = (change_list){0};
    }
}

void contents_accept_tick(contents *c)
{
    c->source = c->read_source;
    for (int i = 0; i < TRACKS; i++)
        track_accept_tick(&c->tracks[i]);
}

void contents_refuse_tick(contents *c, octreel_status status)
{
    if (c->tracks[POSITIONS].tabled && status != OCTREEL_NO_MEMORY)
        return;
    for (int i = 0; i < TRACKS; i++)
        track_revert_tick(&c->tracks[i]);
    c->mark = (octree_cursor){0}; /* the changes of the refused tick are lost, so the log cannot be continued */
}
