/* SPDX-License-Identifier: MIT */
#include "kept_tree.h"
#include "array.h"
#include "octree/digest.h"
#include "octree/octree.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Changes that are worth following: each may take a walk of a subtree. */
static size_t most_touched(const octree *tree)
{
    return 16 + octree_count(tree) / 1024;
}

/* Free what was not met. */
void kept_tree_end(kept_tree *k)
{
    for (; k->met < k->before.count; k->met++)
        free(k->before.items[k->met].nodes);
    k->before.count = k->met = 0;
}

void kept_tree_forget_runs(kept_tree *k)
{
    k->box_runs.count = k->marker_runs.count = 0;
}

void kept_tree_clear(kept_tree *k)
{
    kept_tree_forget_runs(k);
    for (size_t i = 0; i < k->now.count; i++)
        free(k->now.items[i].nodes);
    k->now.count = 0;
    k->open = (kept_subtree){0};
    kept_tree_end(k);
}

void kept_tree_release(kept_tree *k)
{
    kept_tree_clear(k);
    free(k->now.items);
    free(k->before.items);
    free(k->touched);
    free(k->nodes);
    free(k->box_runs.items);
    free(k->marker_runs.items);
    memset(k, 0, sizeof *k);
}

/* ---- What has changed --------------------------------------------------------------------------------------- */

/* The first place in the cell of an address in the order of a walk; and how many there are. */
static uint64_t first_place(octree_address address)
{
    return address << 3 * (OCTREE_MAX_DEPTH - octree_address_depth(address));
}

static uint64_t place_count(octree_address address)
{
    return UINT64_C(1) << 3 * (OCTREE_MAX_DEPTH - octree_address_depth(address));
}

typedef struct listener {
    kept_tree *kept;
    const octree *tree;
} listener;

/* Where a leaf has become empty, the node above it counts, which may be above what is kept: that does no harm. */
static void touch(const listener *l, const double at[3])
{
    kept_tree *k = l->kept;
    octree_node leaf;
    uint64_t *places = array_reserve(k->touched, k->touched_count + 1, &k->touched_room, sizeof *places);
    k->touched = places ? places : k->touched;
    k->lost = k->lost || !places || k->touched_count >= most_touched(l->tree) ||
              octree_locate(l->tree, at, &leaf) != OCTREE_OK;
    if (!k->lost)
        places[k->touched_count++] = first_place(leaf.address);
}

static void hear(const octree_change *change, void *context)
{
    const listener *l = context;
    if (change->kind != OCTREE_INSERTED && !l->kept->lost)
        touch(l, change->from);
    if (change->kind != OCTREE_REMOVED && !l->kept->lost)
        touch(l, change->to);
}

/* A name that no log has had. */
static size_t next_name(void)
{
    static atomic_size_t names;
    const size_t name = (size_t)octree_digest_word((uintptr_t)&names, atomic_fetch_add(&names, 1));
    return name ? name : 1;
}

static int compare_places(const void *a, const void *b)
{
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return p < q ? -1 : p > q;
}

static bool ask(kept_tree *k, const octree *tree)
{
    k->touched_count = k->next_touched = 0;
    k->lost = false;
    return octree_changes_since(tree, next_name(), &k->mark, hear, &(listener){k, tree}) && !k->lost;
}

/* A tree that is asked keeps its changes, which is in vain where there are many: it is then left alone for a while, and
 * what it has changed meanwhile is not wanted. */
static bool learn_changes(kept_tree *k, const octree *tree)
{
    enum { MOST_PATIENCE = 63 };
    if (k->wait > 0 && --k->wait > 0)
        return false;
    const bool anew = k->mark.log == 0, known = ask(k, tree);
    if (known) {
        k->patience = 0;
        if (k->touched_count > 0)
            qsort(k->touched, k->touched_count, sizeof *k->touched, compare_places);
        return true;
    }
    if (anew)
        return false;
    k->patience = k->patience < MOST_PATIENCE ? 2 * k->patience + 1 : MOST_PATIENCE;
    k->wait = k->patience;
    k->mark = (octree_cursor){0};
    return false;
}

static bool is_touched(kept_tree *k, octree_address address)
{
    const uint64_t first = first_place(address);
    while (k->next_touched < k->touched_count && k->touched[k->next_touched] < first)
        k->next_touched++;
    return k->next_touched < k->touched_count && k->touched[k->next_touched] - first < place_count(address);
}

/* ---- A walk ------------------------------------------------------------------------------------------------- */

static bool same_look(const kept_look *a, const kept_look *b)
{
    return a->coloring == b->coloring && a->boxes == b->boxes && a->points == b->points && a->capacity == b->capacity &&
           a->point_width == b->point_width;
}

bool kept_tree_begin(kept_tree *k, const octree *tree, const kept_look *look)
{
    const bool worth = octree_count(tree) >= KEPT_FEWEST && learn_changes(k, tree);
    if (!worth || !same_look(&k->look, look)) {
        kept_tree_clear(k);
        k->sieve = 0;
    }
    k->look = *look;
    if (!worth)
        return false;
    k->names = digest_names_make();
    const kept_list before = k->before;
    k->before = k->now;
    k->now = before;
    return true;
}

const kept_subtree *kept_tree_find(kept_tree *k, octree_address address)
{
    const bool touched = is_touched(k, address);
    const uint64_t first = first_place(address);
    for (; k->met < k->before.count && first_place(k->before.items[k->met].address) < first; k->met++)
        free(k->before.items[k->met].nodes);
    kept_subtree *there = k->met < k->before.count ? &k->before.items[k->met] : NULL;
    kept_subtree *items = array_reserve(k->now.items, k->now.count + 1, &k->now.room, sizeof *items);
    k->now.items = items ? items : k->now.items;
    if (!items || touched || !there || there->address != address)
        return NULL;
    k->met++;
    items[k->now.count] = *there;
    return &items[k->now.count++];
}

/* ---- A subtree ---------------------------------------------------------------------------------------------- */

void kept_tree_open(kept_tree *k, octree_address address, const scene *s)
{
    k->open = (kept_subtree){.address = address};
    k->first_marker = s->markers.count;
}

bool kept_tree_add_node(kept_tree *k, const scene_box *box)
{
    kept_node *nodes = array_reserve(k->nodes, k->open.node_count + 1, &k->node_room, sizeof *nodes);
    if (!nodes)
        return false;
    k->nodes = nodes;
    nodes[k->open.node_count++] = (kept_node){.box = *box, .digest = digest_box(&k->names, box), .count = 1};
    return true;
}

bool kept_tree_collects(const kept_tree *k, const octree_node *node)
{
    if (!k->open.address)
        return false;
    const unsigned above = octree_address_depth(k->open.address);
    return node->depth >= above && node->address >> 3 * (node->depth - above) == k->open.address;
}

/* From the last node up. */
static void count_nodes(kept_subtree *of)
{
    for (uint32_t i = of->node_count; i-- > 0;) {
        uint32_t next = i + 1;
        while (next < of->node_count && of->nodes[next].box.depth > of->nodes[i].box.depth)
            next += of->nodes[next].count;
        of->nodes[i].count = next - i;
    }
}

static digest_run run_of(const digest_names *names, const scene_marker *markers, size_t count)
{
    digest_run run = {.end = count, .power = 1};
    for (size_t i = 0; i < count; i++) {
        run.sum = run.sum * DIGEST_BASE + digest_marker(names, &markers[i]);
        run.power *= DIGEST_BASE;
    }
    return run;
}

/* Without memory the run is digested anew. */
void kept_tree_add_run(digest_runs *runs, size_t first, digest_run run)
{
    digest_run *items = run.end > 0 ? array_reserve(runs->items, runs->count + 1, &runs->room, sizeof *items) : NULL;
    if (!items)
        return;
    runs->items = items;
    run.first += first;
    run.end += first;
    items[runs->count++] = run;
}

bool kept_tree_close(kept_tree *k, const scene *s)
{
    kept_subtree made = k->open;
    kept_subtree *items = array_reserve(k->now.items, k->now.count + 1, &k->now.room, sizeof *items);
    made.marker_count = (uint32_t)(s->markers.count - k->first_marker);
    const size_t nodes = made.node_count * sizeof *made.nodes, markers = made.marker_count * sizeof *made.markers;
    k->now.items = items ? items : k->now.items;
    k->open = (kept_subtree){0};
    made.nodes = items ? malloc(nodes + markers + 1) : NULL;
    if (!made.nodes)
        return false;
    made.markers = (scene_marker *)(made.nodes + made.node_count);
    if (nodes > 0)
        memcpy(made.nodes, k->nodes, nodes);
    if (markers > 0)
        memcpy(made.markers, s->markers.items + k->first_marker, markers);
    count_nodes(&made);
    made.run = run_of(&k->names, made.markers, made.marker_count);
    items[k->now.count++] = made;
    return true;
}
