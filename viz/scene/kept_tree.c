/* SPDX-License-Identifier: MIT */
/* kept_tree.c - the cache of subtrees between ticks; kept_tree.h explains it. */
#include "kept_tree.h"
#include "array.h"
#include "octree/digest.h"
#include "octree/octree.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Returns the greatest number of changes for which the cache is used. Each change may cost a walk of the kept subtree
 * that contains it. */
static size_t find_change_limit(const octree *tree)
{
    return 16 + octree_count(tree) / 1024;
}

void kept_tree_end_walk(kept_tree *k)
{
    for (; k->passed < k->before.count; k->passed++)
        free(k->before.items[k->passed].nodes);
    k->before.count = k->passed = 0;
}

void kept_tree_remove_runs(kept_tree *k)
{
    k->box_runs.count = k->marker_runs.count = 0;
}

void kept_tree_clear(kept_tree *k)
{
    kept_tree_remove_runs(k);
    for (size_t i = 0; i < k->now.count; i++)
        free(k->now.items[i].nodes);
    k->now.count = 0;
    k->open = (kept_subtree){0};
    kept_tree_end_walk(k);
}

void kept_tree_release(kept_tree *k)
{
    kept_tree_clear(k);
    free(k->now.items);
    free(k->before.items);
    free(k->changed);
    free(k->nodes);
    free(k->box_runs.items);
    free(k->marker_runs.items);
    memset(k, 0, sizeof *k);
}

/* ---- Changes ------------------------------------------------------------------------------------------------ */

/* A key is the address of a cell at the greatest depth. Keys ascend in the order of the walk. The cell at `address`
 * contains the smallest cells with the keys from first_key_in_cell() to first_key_in_cell() + count_keys_in_cell() - 1.
 */
static uint64_t first_key_in_cell(octree_address address)
{
    return address << 3 * (OCTREE_MAX_DEPTH - octree_address_depth(address));
}

static uint64_t count_keys_in_cell(octree_address address)
{
    return UINT64_C(1) << 3 * (OCTREE_MAX_DEPTH - octree_address_depth(address));
}

/* Add the key of the leaf that contains a changed position. If this leaf was deleted, octree_locate() returns an
 * ancestor. The ancestor may lie above a kept subtree: then the kept subtree no longer exists, and the walk does not
 * look for it. */
static void add_key(kept_tree *k, const double at[3])
{
    octree_node leaf;
    k->lost = k->lost || k->changed_count >= find_change_limit(k->tree) ||
              octree_locate(k->tree, at, &leaf) != OCTREE_OK ||
              !array_grow(&k->changed, k->changed_count + 1, &k->changed_room, sizeof *k->changed);
    if (!k->lost)
        k->changed[k->changed_count++] = first_key_in_cell(leaf.address);
}

static void add_change(const octree_change *change, void *context)
{
    kept_tree *k = context;
    if (change->kind != OCTREE_INSERTED && !k->lost)
        add_key(k, change->from);
    if (change->kind != OCTREE_REMOVED && !k->lost)
        add_key(k, change->to);
}

uint64_t kept_tree_make_unique_name(void)
{
    static atomic_size_t names;
    const uint64_t name = octree_digest_word((uintptr_t)&names, atomic_fetch_add(&names, 1));
    return (size_t)name ? name : 1; /* never 0, also after conversion to size_t, the type of the names of change logs */
}

static bool read_changes(kept_tree *k, const octree *tree)
{
    k->changed_count = k->next_changed = 0;
    k->lost = false;
    k->tree = tree;
    return octree_changes_since(tree, (size_t)kept_tree_make_unique_name(), &k->cursor, add_change, k) && !k->lost;
}

/* Read the changes since the last walk from the tree's change log. Returns false if the log does not have all of these
 * changes, or if there are too many.
 *
 * Reading the log makes the tree keep logging. Logging is wasted work if there are too many changes to use. So after
 * each failure, the log is not read for a number of ticks, which grows with each further failure. */
static bool read_changes_unless_waiting(kept_tree *k, const octree *tree)
{
    enum { LONGEST_WAIT = 63 };
    if (k->wait > 0 && --k->wait > 0)
        return false;
    const bool is_first = k->cursor.log == 0, known = read_changes(k, tree);
    if (known) {
        k->backoff = 0;
        if (k->changed_count > 0)
            qsort(k->changed, k->changed_count, sizeof *k->changed, compare_uint64);
        return true;
    }
    if (is_first)
        return false;
    k->backoff = k->backoff < LONGEST_WAIT ? 2 * k->backoff + 1 : LONGEST_WAIT;
    k->wait = k->backoff;
    k->cursor = (octree_cursor){0};
    return false;
}

/* Returns whether a changed position lies in the cell at `address`. Calls must come in the order of the walk. */
static bool is_cell_changed(kept_tree *k, octree_address address)
{
    const uint64_t first = first_key_in_cell(address);
    while (k->next_changed < k->changed_count && k->changed[k->next_changed] < first)
        k->next_changed++;
    return k->next_changed < k->changed_count && k->changed[k->next_changed] - first < count_keys_in_cell(address);
}

/* ---- The walk ----------------------------------------------------------------------------------------------- */

static bool are_looks_equal(const kept_look *a, const kept_look *b)
{
    const bool same_colors = a->paints == b->paints && a->point_color == b->point_color && a->values == b->values &&
                             memcmp(&a->scale, &b->scale, sizeof a->scale) == 0;
    return a->coloring == b->coloring && a->boxes == b->boxes && a->points == b->points && a->capacity == b->capacity &&
           a->point_width == b->point_width && (!a->paints || same_colors) && a->paints == b->paints;
}

/* Find the changes since the last walk. If the state is the same as in the last walk, there are no changes. Returns
 * false if the changes are unknown. */
static bool find_changes(kept_tree *k, const octree *tree, uint64_t state)
{
    const bool same = state != 0 && k->state == state;
    k->state = state;
    if (same) {
        k->changed_count = k->next_changed = 0;
        return true;
    }
    if (k->cursor.log == 0)
        kept_tree_clear(k); /* a new log does not list earlier changes */
    return read_changes_unless_waiting(k, tree);
}

bool kept_tree_begin_walk(kept_tree *k, const octree *tree, const kept_look *look, uint64_t state)
{
    const bool usable = octree_count(tree) >= KEPT_FEWEST && find_changes(k, tree, state);
    if (!usable || !are_looks_equal(&k->look, look)) {
        kept_tree_clear(k);
        k->sieve = 0;
    }
    k->look = *look;
    if (!usable)
        return false;
    k->names = make_digest_names();
    const kept_list before = k->before;
    k->before = k->now;
    k->now = before;
    return true;
}

const kept_subtree *kept_tree_find_subtree(kept_tree *k, octree_address address)
{
    const bool changed = is_cell_changed(k, address);
    const uint64_t first = first_key_in_cell(address);
    for (; k->passed < k->before.count && first_key_in_cell(k->before.items[k->passed].address) < first; k->passed++)
        free(k->before.items[k->passed].nodes);
    kept_subtree *there = k->passed < k->before.count ? &k->before.items[k->passed] : NULL;
    if (changed || !there || there->address != address || !ARRAY_GROW(&k->now, 1))
        return NULL;
    k->passed++;
    k->now.items[k->now.count] = *there;
    return &k->now.items[k->now.count++];
}

/* ---- Collecting a subtree ----------------------------------------------------------------------------------- */

void kept_tree_begin_subtree(kept_tree *k, octree_address address, const scene *s)
{
    k->open = (kept_subtree){.address = address};
    k->first_marker = s->markers.count;
}

bool kept_tree_add_node(kept_tree *k, const scene_box *box)
{
    if (!array_grow(&k->nodes, k->open.node_count + 1, &k->node_room, sizeof *k->nodes))
        return false;
    k->nodes[k->open.node_count++] = (kept_node){.box = *box, .digest = digest_box(&k->names, box), .count = 1};
    return true;
}

bool kept_tree_is_collecting(const kept_tree *k, const octree_node *node)
{
    if (!k->open.address)
        return false;
    const unsigned above = octree_address_depth(k->open.address);
    return node->depth >= above && node->address >> 3 * (node->depth - above) == k->open.address;
}

/* Set the subtree size (`count`) of each node. The nodes are visited from last to first, so that the counts of a node's
 * children are known before the count of the node. */
static void set_subtree_sizes(kept_subtree *subtree)
{
    for (uint32_t i = subtree->node_count; i-- > 0;) {
        uint32_t next = i + 1;
        while (next < subtree->node_count && subtree->nodes[next].box.depth > subtree->nodes[i].box.depth)
            next += subtree->nodes[next].count;
        subtree->nodes[i].count = next - i;
    }
}

static digest_run digest_markers(const digest_names *names, const scene_marker *markers, size_t count)
{
    digest_run run = {.end = count, .power = 1};
    for (size_t i = 0; i < count; i++) {
        run.sum = run.sum * DIGEST_BASE + digest_marker(names, &markers[i]);
        run.power *= DIGEST_BASE;
    }
    return run;
}

/* If memory runs out, the run is not recorded, and scene_digest() hashes the run's elements one by one. */
void kept_tree_add_run(digest_runs *runs, size_t first, digest_run run)
{
    if (run.end == 0 || !ARRAY_GROW(runs, 1))
        return;
    run.first += first;
    run.end += first;
    runs->items[runs->count++] = run;
}

bool kept_tree_end_subtree(kept_tree *k, const scene *s)
{
    kept_subtree made = k->open;
    made.marker_count = (uint32_t)(s->markers.count - k->first_marker);
    const size_t nodes = made.node_count * sizeof *made.nodes, markers = made.marker_count * sizeof *made.markers;
    const bool grown = ARRAY_GROW(&k->now, 1);
    k->open = (kept_subtree){0};
    made.nodes = grown ? malloc(nodes + markers + 1) : NULL;
    if (!made.nodes)
        return false;
    made.markers = (scene_marker *)(made.nodes + made.node_count);
    if (nodes > 0)
        memcpy(made.nodes, k->nodes, nodes);
    if (markers > 0)
        memcpy(made.markers, s->markers.items + k->first_marker, markers);
    set_subtree_sizes(&made);
    made.run = digest_markers(&k->names, made.markers, made.marker_count);
    k->now.items[k->now.count++] = made;
    return true;
}
