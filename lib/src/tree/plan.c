/* SPDX-License-Identifier: MIT */
/* plan.c - makes and carries out the plan of a batch, by tasks if the batch is large.
 *
 * Problem: restructure.c plans one node after the other. A large batch should use several threads, and the result must
 * be the same for any number of threads.
 *
 * Idea: first walk the nodes as restructure.c would, without planning, down to nodes with few enough items (points) for
 * a task, and list these nodes as jobs. Tasks plan the jobs; each task has memory pools of its own, which borrow free
 * blocks from the tree's pools. Then plan the nodes above the jobs' nodes. Where this second walk reaches a job's node
 * again, it takes the next result from the list of jobs. Both walks have the same order, so the next result is always
 * that of this node. The division into jobs depends only on counts, never on timing.
 *
 * Carrying out a plan edits leaves, replaces nodes and frees the old nodes. It allocates nothing, so it cannot fail.
 */
#include "division.h"
#include "grid_fill.h"

#include <stdlib.h>
#include <string.h>

/* ---- Jobs: the nodes that tasks plan ------------------------------------------------------------------------ */

/* Add a job for each node that build_node() would build and that has at most `grain` items, in the order in which
 * build_node() reaches these nodes. Nodes below such a node get no job. Returns false if memory runs out. */
static bool add_build_jobs(batch *b, cell c, span items)
{
    if (items.count <= b->division->grain)
        return add_job(b, NULL, c, (span){NULL, 0}, items);
    if (must_be_leaf(b, c, items))
        return true;
    span shares[8];
    divide_items_by_octant(items, c.depth, shares);
    for (unsigned octant = 0; octant < 8; octant++)
        if (shares[octant].count > 0 && !add_build_jobs(b, cell_child(c, octant), shares[octant]))
            return false;
    return true;
}

/* Add a job for each node that change_node() would change and that has at most `grain` items, in the order in which
 * change_node() reaches these nodes. Nodes below such a node get no job. A leaf with more items gets no job here;
 * build_node_by_tasks() divides its items later. Returns false if memory runs out. */
static bool add_change_jobs(batch *b, const node *old, cell c, span leaving, span arriving)
{
    static const node empty = {0};
    const size_t count = leaving.count + arriving.count;
    if (count == 0 || (arriving.count == 0 && leaving.count == old->count))
        return true;
    if (count <= b->division->grain)
        return add_job(b, old, c, leaving, arriving);
    if (leaving.count == old->count)
        return add_build_jobs(b, c, arriving);
    if (!old->octants || fits_leaf(b->tree, old->count - leaving.count + arriving.count))
        return true;
    span out[8], in[8];
    divide_items_by_octant(leaving, c.depth, out);
    divide_items_by_octant(arriving, c.depth, in);
    for (unsigned octant = 0; octant < 8; octant++) {
        const node *child = child_at(old, octant);
        if (!add_change_jobs(b, child ? child : &empty, cell_child(c, octant), out[octant], in[octant]))
            return false;
    }
    return true;
}

static void plan_jobs_of_part(size_t number, void *context)
{
    division *d = context;
    batch *b = &d->parts[number].batch;
    job *jobs = d->work.jobs.items;
    for (size_t i = d->starts[number]; i < d->starts[number + 1]; i++) {
        job *j = &jobs[i];
        j->ok = j->old ? change_node(b, j->old, j->cell, j->leaving, j->arriving, &j->made)
                       : build_node(b, j->cell, j->arriving, &j->made);
        if (!j->ok)
            return;
    }
}

/* Free the list of jobs, and the unused results of jobs. */
static void release_jobs(batch *b)
{
    static const node none = {0};
    job_list *work = &b->division->work;
    const job *jobs = work->jobs.items;
    for (; work->next < work->jobs.count; work->next++)
        node_release_unshared(b->store, &jobs[work->next].made, jobs[work->next].old ? jobs[work->next].old : &none);
    list_release(&b->store->memory, &work->jobs, sizeof(job));
    *work = (job_list){.ready = false};
}

/* Run all jobs. Returns false if memory runs out; the jobs are then removed from the list. */
static bool run_jobs(batch *b)
{
    job_list *work = &b->division->work;
    const job *jobs = work->jobs.items;
    assign_jobs_to_tasks(b->division);
    run_task_for_each_part(b, plan_jobs_of_part);
    work->ready = true;
    for (size_t i = 0; i < work->jobs.count; i++)
        work->ready = work->ready && jobs[i].ok;
    if (work->ready)
        return true;
    release_jobs(b);
    return false;
}

bool is_planned_by_job(const batch *b, size_t count)
{
    return b->division && b->division->work.ready && count <= b->division->grain;
}

bool get_next_job_result(batch *b, node *made)
{
    job_list *work = &b->division->work;
    *made = ((const job *)work->jobs.items)[work->next++].made;
    return true;
}

/* Build the node of one large leaf in parallel, with a job list of its own. The job list of the whole batch is set
 * aside and restored afterwards. */
bool build_node_by_tasks(batch *b, cell c, span items, node *made)
{
    if (!b->division)
        return build_node(b, c, items, made);
    const job_list outer = b->division->work;
    b->division->work = (job_list){.ready = false};
    const bool ok = add_build_jobs(b, c, items) && run_jobs(b) && build_node(b, c, items, made);
    release_jobs(b);
    b->division->work = outer;
    return ok;
}

/* ---- The plan ----------------------------------------------------------------------------------------------- */

/* Edit a leaf in place. Arriving points first overwrite leaving points, and the remaining arriving points are appended.
 * If more points leave than arrive, the last points of the leaf overwrite the remaining leaving points. */
static void apply_leaf_edit(batch *b, const edit *e)
{
    uint32_t count = e->count;
    size_t taken = 0;
    /* fill the last gap first, so that the leaf's last point is never a leaving point */
    for (size_t i = e->leaving.count; i-- > 0;) {
        octree_point *gap = &e->points[e->leaving.items[i].index];
        *gap = taken < e->arriving.count ? arriving_point(b, &e->arriving.items[taken++]) : e->points[--count];
    }
    while (taken < e->arriving.count)
        e->points[count++] = arriving_point(b, &e->arriving.items[taken++]);
    if (e->room_left < e->room)
        pool_free(&b->store->points, e->points + e->room_left, e->room - e->room_left);
}

static void apply_plan(batch *b)
{
    const edit *edits = b->edits.items;
    for (size_t i = 0; i < b->edits.count; i++)
        apply_leaf_edit(b, &edits[i]);
    const patch *patches = b->patches.items;
    for (size_t i = 0; i < b->patches.count; i++) {
        const node old = *patches[i].at;
        *patches[i].at = patches[i].made;
        node_release_unshared(b->store, &old, &patches[i].made);
    }
}

static void apply_plan_of_part(size_t number, void *context)
{
    apply_plan(&((division *)context)->parts[number].batch);
}

static void release_planned_nodes(batch *b)
{
    const patch *patches = b->patches.items;
    for (size_t i = 0; i < b->patches.count; i++)
        node_release_unshared(b->store, &patches[i].made, patches[i].at);
}

static void release_plan_lists(batch *b)
{
    list_release(&b->store->memory, &b->patches, sizeof(patch));
    list_release(&b->store->memory, &b->edits, sizeof(edit));
}

/* Carry out the plans, or drop them. The plans of the parts come first, because their nodes lie below the nodes of the
 * batch's own plan. */
static void apply_or_drop_plan(batch *b, bool succeeds)
{
    division *d = b->division;
    if (d && succeeds)
        run_tasks(b->tree, apply_plan_of_part, d->tasks, d);
    for (unsigned i = 0; d && i < d->tasks; i++) {
        if (!succeeds)
            release_planned_nodes(&d->parts[i].batch);
        release_plan_lists(&d->parts[i].batch);
    }
    if (succeeds)
        apply_plan(b);
    else
        release_planned_nodes(b);
    release_plan_lists(b);
}

static void combine_part_flags(batch *b)
{
    for (unsigned i = 0; b->division && i < b->division->tasks; i++) {
        b->duplicate |= b->division->parts[i].batch.duplicate;
        b->overflow |= b->division->parts[i].batch.overflow;
    }
}

/* ---- Building anew -------------------------------------------------------------------------------------- */

/* Build a densely packed tree in new memory pools. If this succeeds, the new tree replaces the old tree. */
octree_status rebuild_from_batch(batch *b)
{
    octree *tree = b->tree;
    const pool old_nodes = tree->store.nodes, old_points = tree->store.points;
    node made = {0};
    b->overflow = b->to && !b->grid && can_overflow(b, &tree->root, root_cell(), b->arriving);
    if (b->overflow)
        return OCTREE_OK;
    store_init(&tree->store, tree->store.nodes.unit);
    create_part_pools(b, b->arriving.count);
    const bool ok = b->grid ? build_from_grid(b, &made) : build_node_by_tasks(b, root_cell(), b->arriving, &made);
    join_part_pools(b);
    b->overflow = b->overflow || (ok && b->to && b->grid && can_overflow_when_rebuilt(tree, &made));
    const bool succeeds = ok && !b->overflow;
    const pool nodes = tree->store.nodes, points = tree->store.points;
    if (succeeds) {
        tree->store.nodes = old_nodes;
        tree->store.points = old_points;
    }
    store_release(&tree->store, succeeds ? &tree->root : &made);
    tree->store.nodes = succeeds ? nodes : old_nodes;
    tree->store.points = succeeds ? points : old_points;
    tree->root = succeeds ? made : tree->root;
    return ok ? OCTREE_OK : OCTREE_NO_MEMORY;
}

/* ---- Restructuring ------------------------------------------------------------------------------------------ */

/* Make the plan. Returns false if memory runs out; the caller must then drop the patches and edits made so far. */
static bool plan_changes(batch *b)
{
    octree *tree = b->tree;
    node made = {0};
    if (b->division && !(add_change_jobs(b, &tree->root, root_cell(), b->leaving, b->arriving) && run_jobs(b))) {
        release_jobs(b);
        return false;
    }
    bool ok = change_node(b, &tree->root, root_cell(), b->leaving, b->arriving, &made);
    if (b->division)
        release_jobs(b);
    if (!ok)
        node_release_unshared(&tree->store, &made, &tree->root);
    combine_part_flags(b);
    return ok && plan_replacement(b, &tree->root, &made);
}

octree_status restructure_tree(batch *b)
{
    b->duplicate = b->overflow = false;
    const size_t stored = b->tree->root.count;
    if (b->grid || (stored > 0 && b->leaving.count == stored && b->arriving.count == stored))
        return rebuild_from_batch(b);
    create_part_pools(b, b->arriving.count > b->leaving.count ? b->arriving.count - b->leaving.count : 0);
    const bool ok = plan_changes(b);
    apply_or_drop_plan(b, ok && !(b->to && (b->duplicate || b->overflow)));
    join_part_pools(b);
    return ok ? OCTREE_OK : OCTREE_NO_MEMORY;
}
