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
#include <string.h>
#include <time.h>

void contents_release(contents *c)
{
    points_release(&c->now);
    points_release(&c->next);
    points_release(&c->spare);
    point_table_release(&c->table);
    free(c->changes);
    free(c->tree.heard);
    *c = (contents){0};
}

static bool is_finite_place(const double at[3])
{
    return isfinite(at[0]) && isfinite(at[1]) && isfinite(at[2]);
}

/* ---- The definition of a tree
 * ---------------------------------------------------------------------------------------------- */

/* Check that a tree has the world and the options that the recorder was opened with. */
static octreel_status check_tree(const octree_def *own, const octree *tree, octreel_error *error)
{
    const octree_def def = octree_definition(tree);
    for (int i = 0; i < 3; i++)
        if (def.world.min[i] != own->world.min[i] || def.world.max[i] != own->world.max[i])
            return status_refuse(
                error, OCTREEL_OTHER_TREE,
                "the tree's world on %c is [%.17g, %.17g], and the recorder was opened for [%.17g, %.17g]", "xyz"[i],
                def.world.min[i], def.world.max[i], own->world.min[i], own->world.max[i]);
    if (def.leaf_capacity != own->leaf_capacity)
        return status_refuse(
            error, OCTREEL_OTHER_TREE,
            "the tree's leaf_capacity is %zu, and the recorder was opened for %zu; a tree under OCTREE_AUTO "
            "changes it: give it a fixed one",
            def.leaf_capacity, own->leaf_capacity);
    if (def.max_depth != own->max_depth)
        return status_refuse(error, OCTREEL_OTHER_TREE,
                             "the tree's max_depth is %zu, and the recorder was opened for %zu", def.max_depth,
                             own->max_depth);
    if (def.full_leaf != own->full_leaf)
        return status_refuse(error, OCTREEL_OTHER_TREE,
                             "the tree's full_leaf is not that of the definition that the recorder was opened for");
    return OCTREEL_OK;
}

/* ---- Changes from the program
 * ---------------------------------------------------------------------------------------- */

static bool start_table(contents *c)
{
    if (!point_table_reserve(&c->table, c->now.count))
        return false;
    for (size_t i = 0; i < c->now.count; i++)
        point_table_put(&c->table, &c->now.items[i]);
    points_release(&c->now);
    points_release(&c->next);
    points_release(&c->spare);
    c->tabled = true;
    return true;
}

static bool make_room(contents *c, size_t more)
{
    return more == 0 || (more <= UINT32_MAX - c->change_count &&
                         array_grow(&c->changes, c->change_count + more, &c->change_room, sizeof *c->changes) &&
                         point_table_reserve(&c->table, c->table.count + more));
}

/* Bounds memory while no tick is accepted: changes that cancel out are dropped once they have doubled. */
static void settle(contents *c)
{
    enum { FEW = 1024 };
    if (c->change_count > FEW && c->change_count / 2 > c->settled)
        c->change_count = c->settled = changes_settle(c->changes, c->change_count);
}

static octreel_status add_change(contents *c, const octree_edit *edit, size_t number, octreel_error *error)
{
    const octree_body *body = &edit->body;
    const octree_point *there = point_table_find(&c->table, body->id);
    change made = {.kind = edit->kind, .id = body->id};
    if ((unsigned)edit->kind > OCTREE_EDIT_MOVE)
        return status_refuse(error, OCTREEL_BAD_POINT, "changes[%zu]: unknown kind of edit", number);
    if (body->id >= SESSION_ID_LIMIT)
        return status_refuse(error, OCTREEL_BAD_ID, "changes[%zu]: %s: %" PRIu64, number,
                             octreel_status_text(OCTREEL_BAD_ID), body->id);
    if (edit->kind != OCTREE_EDIT_REMOVE && !is_finite_place(body->position))
        return status_refuse(error, OCTREEL_BAD_POINT, "changes[%zu]: a coordinate is NaN or infinite", number);
    if (edit->kind == OCTREE_EDIT_INSERT && there)
        return status_refuse(error, OCTREEL_DUPLICATE_ID, "changes[%zu]: point %" PRIu64 " exists already", number,
                             body->id);
    if (edit->kind != OCTREE_EDIT_INSERT && !there)
        return status_refuse(error, OCTREEL_NO_POINT, "changes[%zu]: point %" PRIu64 " does not exist", number,
                             body->id);
    if (there)
        memcpy(made.from, there->position, sizeof made.from);
    if (edit->kind != OCTREE_EDIT_REMOVE)
        memcpy(made.to, body->position, sizeof made.to);
    change_make(&made, &c->table);
    c->changes[c->change_count++] = made;
    return OCTREEL_OK;
}

static octreel_status read_changes(contents *c, const octreel_tick_info *about, octreel_error *error)
{
    octreel_status first = OCTREEL_OK;
    octreel_error later;
    if ((!c->tabled && !start_table(c)) || !make_room(c, about->change_count))
        return status_fail(error, OCTREEL_NO_MEMORY);
    c->source = FROM_CHANGES;
    for (size_t i = 0; i < about->change_count; i++) {
        const octreel_status status = add_change(c, &about->changes[i], i, first == OCTREEL_OK ? error : &later);
        first = first == OCTREEL_OK ? status : first;
    }
    return first;
}

void contents_undo(contents *c)
{
    while (c->change_count > c->kept)
        change_undo(&c->changes[--c->change_count], &c->table);
    c->tree.mark = (octree_cursor){0}; /* its log was read up to this tick */
}

/* ---- Changes from a tree's log ------------------------------------------------------------------------ */

/* With more changes, reading all points takes less time. */
static bool are_few(size_t changes, size_t points)
{
    return changes <= points / 8 + 16;
}

/* A name that no log was given before. */
static size_t make_log_name(followed_tree *f)
{
    struct timespec now = {0};
    if (f->names == 0 && timespec_get(&now, TIME_UTC))
        f->names = octree_digest_word(octree_digest_word((uintptr_t)f, (uint64_t)now.tv_nsec), (uint64_t)now.tv_sec);
    const size_t name = (size_t)octree_digest_word(0, f->names++);
    return name ? name : 1;
}

static void add_heard(const octree_change *change, void *context)
{
    followed_tree *f = context;
    if (array_grow(&f->heard, f->heard_count + 1, &f->heard_room, sizeof *f->heard))
        f->heard[f->heard_count++] = *change;
    else
        f->lost = true;
}

static bool read_log(followed_tree *f, const octree *tree)
{
    f->heard_count = 0;
    f->lost = false;
    if (f->whole || f->busy) /* the log does not continue from `now` */
        f->mark = (octree_cursor){0};
    f->whole = false;
    return !f->busy && octree_changes_since(tree, make_log_name(f), &f->mark, add_heard, f) && !f->lost;
}

/* Apply a change from the log. False if it contradicts the table, or if files cannot hold the id. */
static bool apply_heard(contents *c, const octree_change *said)
{
    const octree_point *there = point_table_find(&c->table, said->id);
    change made = {.kind = said->kind == OCTREE_INSERTED  ? OCTREE_EDIT_INSERT
                           : said->kind == OCTREE_REMOVED ? OCTREE_EDIT_REMOVE
                                                          : OCTREE_EDIT_MOVE,
                   .id = said->id};
    if (said->id >= SESSION_ID_LIMIT || !there != (said->kind == OCTREE_INSERTED))
        return false;
    for (int i = 0; there && i < 3; i++)
        if (there->position[i] != said->from[i])
            return false; /* two points have or had this id */
    memcpy(made.from, said->from, sizeof made.from);
    memcpy(made.to, said->to, sizeof made.to);
    change_make(&made, &c->table);
    c->changes[c->change_count++] = made;
    return true;
}

/* Apply all changes from the log; an insertion waits until the point with its id is removed. False without any change
 * if two points share an id, or out of memory; reading the whole tree then reports which. */
static bool apply_log(contents *c)
{
    followed_tree *f = &c->tree;
    size_t waiting = 0;
    bool made = (c->tabled || start_table(c)) && make_room(c, f->heard_count);
    for (size_t i = 0; made && i < f->heard_count; i++) {
        if (f->heard[i].kind == OCTREE_INSERTED && point_table_find(&c->table, f->heard[i].id))
            f->heard[waiting++] = f->heard[i];
        else
            made = apply_heard(c, &f->heard[i]);
    }
    for (size_t i = 0; made && i < waiting; i++)
        made = apply_heard(c, &f->heard[i]);
    if (!made)
        contents_undo(c);
    return made;
}

/* Turn the table back into `now`, the points of the last accepted tick. */
static bool list_accepted(contents *c)
{
    while (c->change_count > 0)
        change_undo(&c->changes[--c->change_count], &c->table);
    c->kept = 0;
    if (!point_table_list(&c->table, &c->now, &c->spare))
        return false;
    point_table_release(&c->table);
    c->tabled = false;
    return true;
}

static octreel_status read_whole_tree(contents *c, const octree *tree, octreel_error *error)
{
    uint64_t clash = 0;
    c->tree.whole = true;
    if (c->tabled && !list_accepted(c))
        return status_fail(error, OCTREEL_NO_MEMORY);
    const octreel_status status = points_read(&c->next, &c->spare, tree, &clash);
    if (status == OCTREEL_BAD_ID || status == OCTREEL_DUPLICATE_ID)
        return status_refuse(error, status, "%s: %" PRIu64, octreel_status_text(status), clash);
    return status == OCTREEL_OK ? status : status_fail(error, status);
}

static octreel_status read_tree(contents *c, const octree_def *def, const octree *tree, octreel_error *error)
{
    const octreel_status status = check_tree(def, tree, error);
    if (status != OCTREEL_OK)
        return status;
    if (read_log(&c->tree, tree) && are_few(c->tree.heard_count, octree_count(tree)) && apply_log(c))
        return OCTREEL_OK;
    return read_whole_tree(c, tree, error);
}

/* ---- A list ---------------------------------------------------------------------------------------------- */

/* Change the table to the list that was read. */
static bool apply_list(contents *c)
{
    if (!point_table_list(&c->table, &c->now, &c->spare))
        return false;
    const size_t count = changes_between(&c->now, &c->next, NULL);
    if (!make_room(c, count))
        return false;
    changes_between(&c->now, &c->next, c->changes + c->change_count);
    for (const size_t end = c->change_count + count; c->change_count < end; c->change_count++)
        change_make(&c->changes[c->change_count], &c->table);
    return true;
}

static octreel_status read_list(contents *c, const octree_point *list, size_t count, octreel_error *error)
{
    uint64_t clash = 0;
    for (size_t i = 0; i < count; i++)
        if (!is_finite_place(list[i].position))
            return status_refuse(error, OCTREEL_BAD_POINT, "points[%zu]: a coordinate is NaN or infinite", i);
    const octreel_status status = points_read_list(&c->next, &c->spare, list, count, &clash);
    if (status == OCTREEL_BAD_ID)
        return status_refuse(error, status, "points: %s: %" PRIu64, octreel_status_text(status), clash);
    if (status == OCTREEL_DUPLICATE_ID)
        return status_refuse(error, status, "points: two points have the id %" PRIu64, clash);
    return status == OCTREEL_OK && (!c->tabled || apply_list(c)) ? OCTREEL_OK : status_fail(error, OCTREEL_NO_MEMORY);
}

/* ---- A tick ------------------------------------------------------------------------------------------------- */

/* Find how the program gives its points. If it gives none, the source stays: a list is then empty, and changes are
 * none. */
static octreel_status find_source(contents *c, const octree *tree, const octreel_tick_info *about, octreel_error *error)
{
    const bool list = about && (about->points || about->point_count);
    const bool changes = about && (about->changes || about->change_count);
    c->read_source = tree ? FROM_TREE : list ? FROM_LIST : changes ? FROM_CHANGES : c->source;
    if ((list && !about->points) || (changes && !about->changes))
        return status_fail(error, OCTREEL_NULL_ARGUMENT);
    if ((tree != NULL) + list + changes > 1 ||
        (c->source != FROM_NOTHING && (c->source == FROM_TREE) != (c->read_source == FROM_TREE)))
        return status_fail(error, OCTREEL_TWO_SOURCES);
    return c->read_source == FROM_TREE && !tree ? status_fail(error, OCTREEL_NULL_ARGUMENT) : OCTREEL_OK;
}

octreel_status contents_read(contents *c, const octree_def *def, const octree *tree, const octreel_tick_info *about,
                             octreel_error *error)
{
    settle(c);
    c->kept = c->change_count;
    const octreel_status status = find_source(c, tree, about, error);
    if (status != OCTREEL_OK)
        return status;
    if (c->read_source == FROM_TREE)
        return read_tree(c, def, tree, error);
    if (c->read_source == FROM_CHANGES)
        return about ? read_changes(c, about, error) : OCTREEL_OK;
    return read_list(c, about ? about->points : NULL, about ? about->point_count : 0, error);
}

bool contents_add_changes(contents *c, batch *b)
{
    const size_t most = c->tabled ? c->change_count : changes_between(&c->now, &c->next, NULL);
    c->tree.busy = c->source == FROM_TREE && !c->tabled && !are_few(most, c->now.count);
    if (most == 0)
        return true;
    b->changes = most <= SIZE_MAX / sizeof *b->changes ? malloc(most * sizeof *b->changes) : NULL;
    if (!b->changes)
        return false;
    b->bytes += most * sizeof *b->changes;
    if (c->tabled)
        memcpy(b->changes, c->changes, most * sizeof *b->changes);
    else
        changes_between(&c->now, &c->next, b->changes);
    b->change_count = most;
    b->unsettled = c->tabled;
    return true;
}

void contents_accept(contents *c)
{
    c->source = c->read_source;
    c->change_count = c->settled = 0;
    c->tree.whole = false;
    if (!c->tabled)
        points_swap(&c->now, &c->next); /* the next tick is compared with this one */
}
