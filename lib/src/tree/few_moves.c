/* SPDX-License-Identifier: MIT */
/* few_moves.c - batches of few moves: move_small_batch().
 *
 * Problem: sorting few moves and planning the changes of their leaves takes longer than moving the points one by one.
 * But a batch must happen completely or not at all, even if memory runs out in the middle; and single moves wait for a
 * cache miss at every level of every descent.
 *
 * Idea: move the points one by one in the given order, so that repeated ids and full leaves need no special care, and
 * remember how to revert each move (undo.h). In a large tree, 16 moves find their 32 paths in lockstep, so that their
 * cache misses overlap. The paths stay right until a move changes inner nodes, which is rare.
 *
 * Cost: that of single moves, and 88 bytes a move. is_small_batch_of_moves() contains the measured limits.
 */
#include "few.h"
#include "tasks.h"
#include "undo.h"

#include <string.h>

#ifndef OCTREE_CACHED_PATHS
#define OCTREE_CACHED_PATHS 30000 /* in a tree with fewer points, descents hardly wait for memory */
#endif

enum {
    MOVES_TOGETHER = 16,
    FEW_MOVES = 16, /* in a larger tree, a batch is small if fewer than a sixteenth of the stored points move */
};

/* A move that was made or refused. */
typedef struct made_move {
    octree_point old; /* the point as it was stored */
    step undo[2];
    octree_status status;
} made_move;

bool is_small_batch_of_moves(const batch *b)
{
    const size_t stored = b->tree->root.count;
    return b->count > 0 && count_tasks(b->tree, b->count) == 1 && !is_rebuild_cheaper(b->tree, b->count) &&
           (stored < OCTREE_CACHED_PATHS || b->count < stored / FEW_MOVES);
}

/* Up to MOVES_TOGETHER moves, and the paths of their positions. */
typedef struct move_group {
    octree *tree;
    size_t count;
    made_move *made;
    single_move moves[MOVES_TOGETHER];
    found_point found[MOVES_TOGETHER]; /* found[i].path is the path of the position before move i */
    path to[MOVES_TOGETHER];
} move_group;

/* Read the moves from the index `first` on, and check their positions. */
static void load_move_group(move_group *g, const batch *b, size_t first)
{
    const octree_point *points = b->points + first;
    const double(*to)[3] = b->to + first;
    uint64_t codes[2][MOVES_TOGETHER];
    compute_morton_codes(b->tree->axes, points->position, sizeof *points / sizeof(double), g->count, codes[0]);
    compute_morton_codes(b->tree->axes, to[0], 3, g->count, codes[1]);
    for (size_t i = 0; i < g->count; i++) {
        single_move *m = &g->moves[i];
        g->made[i].status = compute_code_if_unsure(b->tree, points[i].position, &codes[0][i]);
        if (g->made[i].status == OCTREE_OK)
            g->made[i].status = compute_code_if_unsure(b->tree, to[i], &codes[1][i]);
        *m = (single_move){.old = points[i], .moved.id = points[i].id, .from = codes[0][i], .to = codes[1][i]};
        memcpy(m->moved.position, to[i], sizeof m->moved.position);
        g->made[i].undo[0].kind = g->made[i].undo[1].kind = STEP_NONE;
    }
}

/* Let all paths descend together, one level at a time, so that their cache misses overlap. */
static void find_paths_together(move_group *g)
{
    path *going[2 * MOVES_TOGETHER];
    uint64_t codes[2 * MOVES_TOGETHER];
    size_t left = 0;
    for (size_t i = 0; i < g->count; i++) {
        if (g->made[i].status != OCTREE_OK)
            continue;
        going[left] = &g->found[i].path;
        codes[left++] = g->moves[i].from;
        going[left] = &g->to[i];
        codes[left++] = g->moves[i].to;
    }
    for (size_t i = 0; i < left; i++)
        begin_path(going[i], g->tree);
    while (left > 0) {
        size_t next = 0;
        for (size_t i = 0; i < left; i++) {
            path *p = going[i];
            node *child = path_end(p)->octants ? child_at(path_end(p), morton_octant(codes[i], p->depth)) : NULL;
            if (!child)
                continue;
            p->nodes[++p->depth] = child;
            prefetch_node(child);
            going[next] = p;
            codes[next++] = codes[i];
        }
        left = next;
    }
}

/* Find the paths of a move's two positions. The search for the second path begins where the two paths part. */
static void find_paths_of_move(move_group *g, size_t i)
{
    const single_move *m = &g->moves[i];
    path *from = &g->found[i].path, *to = &g->to[i];
    begin_path(from, g->tree);
    extend_path(from, m->from);
    begin_path_beside(to, m->to, from, m->from);
    extend_path(to, m->to);
}

/* Make the moves of a group one by one. The paths that were found together are used until a move changes paths. Returns
 * the number of moves that were processed: all moves, or the moves before the first move for which memory ran out. */
static size_t make_group_of_moves(move_group *g)
{
    bool are_found = g->tree->root.count >= OCTREE_CACHED_PATHS;
    if (are_found)
        find_paths_together(g);
    for (size_t i = 0; i < g->count; i++) {
        made_move *m = &g->made[i];
        if (m->status != OCTREE_OK)
            continue;
        if (are_found) {
            extend_path(&g->found[i].path, g->moves[i].from);
            extend_path(&g->to[i], g->moves[i].to);
        } else {
            find_paths_of_move(g, i);
        }
        m->status = move_along_paths(g->tree, &g->moves[i], &g->found[i], &g->to[i], m->undo);
        if (m->status == OCTREE_NO_MEMORY)
            return i;
        m->old = g->moves[i].old;
        are_found = are_found && !has_changed_paths(m->undo);
    }
    return g->count;
}

static single_move make_single_move(const batch *b, const made_move *made, size_t i)
{
    single_move m = {.old = made[i].old, .moved = arriving_point(b, &(morton_item){.place = (uint32_t)i})};
    m.from = morton_code(b->tree->axes, m.old.position);
    m.to = morton_code(b->tree->axes, m.moved.position);
    return m;
}

/* Make all moves. Returns false if memory runs out; the tree is then as before. */
static bool make_moves(const batch *b, made_move *made)
{
    move_group g;
    size_t done = 0, count = 0;
    g.tree = b->tree;
    g.count = 0;
    for (; done < b->count && count == g.count; done += count) {
        g.count = b->count - done < MOVES_TOGETHER ? b->count - done : MOVES_TOGETHER;
        g.made = made + done;
        load_move_group(&g, b, done);
        count = make_group_of_moves(&g);
    }
    if (done == b->count)
        return true;
    while (done-- > 0)
        if (made[done].status == OCTREE_OK) {
            const single_move m = make_single_move(b, made, done);
            revert_move(b->tree, &m, made[done].undo);
        }
    return false;
}

/* After all moves are made, free the memory that was kept for reverting them, and log them. Returns the number of
 * points that moved. */
static size_t complete_moves(const batch *b, const made_move *made)
{
    size_t moved = 0;
    for (size_t i = 0; i < b->count; i++) {
        if (b->statuses)
            b->statuses[i] = made[i].status;
        if (made[i].status != OCTREE_OK)
            continue;
        finish_move(b->tree, &made[i].old, made[i].undo);
        moved++;
        if (change_log_is_on(&b->tree->changes))
            change_log_append(b->tree, OCTREE_MOVED, &made[i].old, b->to[i]);
    }
    return moved;
}

octree_status move_small_batch(const batch *b, size_t *done)
{
    arena *memory = &b->tree->store.memory;
    const uint64_t version = b->tree->version;
    made_move few[FEW_AT_ONCE];
    const size_t size = b->count > FEW_AT_ONCE ? b->count * sizeof *few : 0;
    made_move *made = size ? arena_allocate(memory, size) : few;
    if (!made)
        return OCTREE_NO_MEMORY;
    const bool ok = make_moves(b, made);
    const size_t moved = ok ? complete_moves(b, made) : 0;
    b->tree->version = version + (moved > 0);
    if (ok && done)
        *done = moved;
    arena_free(memory, size ? made : NULL, size);
    return ok ? OCTREE_OK : OCTREE_NO_MEMORY;
}
