/* SPDX-License-Identifier: MIT */
/* foreign.c - checks that the nodes of a foreign index form a forest, and keeps a copy of the current nodes with their
 * depths, kinds and point counts. */
#include "foreign.h"
#include "../exact/float_mode.h"
#include "octree/digest.h"
#include "../query/search.h"

#include <limits.h>
#include <string.h>

const char *octree_node_visit_name(octree_node_visit visit)
{
    static const char *const names[OCTREE_NODE_VISITS] = {"visited", "pruned", "hit"};
    return (unsigned)visit < OCTREE_NODE_VISITS ? names[visit] : NULL;
}

#define DEPTH_UNKNOWN UINT_MAX
/* a temporary depth: find_depths() marks with it the nodes on its path, until their real depths are known */
#define DEPTH_ON_PATH (UINT_MAX - 1)

/* ---- Checks ------------------------------------------------------------------------------------------------- */

static octree_status check_node(const octree_foreign_node *node)
{
    octree_status status = check_finite_position(node->box.min);
    if (status == OCTREE_OK)
        status = check_finite_position(node->box.max);
    if (status == OCTREE_OK)
        status = check_box(&node->box);
    if (status != OCTREE_OK)
        return status;
    if (node->id >= OCTREE_NODE_ID_LIMIT || (node->has_depth && node->depth < 0))
        return OCTREE_BAD_SIZE;
    if (node->has_points && node->points.count && !node->points.ids)
        return OCTREE_NULL_ARGUMENT;
    if (!is_printable_text(node->kind, sizeof node->kind))
        return OCTREE_BAD_TEXT;
    return (unsigned)node->precision < OCTREE_PRECISIONS ? OCTREE_OK : OCTREE_BAD_OPTION;
}

int foreign_compare_keys(const void *a, const void *b)
{
    const foreign_key *p = a, *q = b;
    return p->id != q->id ? (p->id > q->id) - (p->id < q->id) : (p->place > q->place) - (p->place < q->place);
}

static size_t find_node_place(const list *keys, uint64_t id)
{
    const foreign_key *items = keys->items;
    const size_t first = find_item_by_first_word(items, sizeof *items, keys->count, id);
    return first < keys->count && items[first].id == id ? items[first].place : SIZE_MAX;
}

static octree_status make_node_keys(arena *memory, const octree_foreign_tree *tree, list *keys, size_t *fault)
{
    bool sorted = true;
    for (size_t i = 0; i < tree->node_count; i++) {
        const octree_status status = check_node(&tree->nodes[i]);
        const foreign_key key = {tree->nodes[i].id, i};
        *fault = i;
        if (status != OCTREE_OK)
            return status;
        sorted = sorted && (i == 0 || tree->nodes[i - 1].id < key.id);
        if (!list_push(memory, keys, &key, sizeof key))
            return OCTREE_NO_MEMORY;
    }
    const foreign_key *items = keys->items;
    if (!sorted)
        list_sort(keys, sizeof *items, foreign_compare_keys);
    for (size_t i = 1; i < keys->count; i++)
        if (items[i].id == items[i - 1].id) {
            *fault = items[i].place;
            return OCTREE_DUPLICATE;
        }
    return OCTREE_OK;
}

static octree_status make_node_places(arena *memory, const octree_foreign_tree *tree, list *places, const list *keys,
                                      size_t *fault)
{
    for (size_t i = 0; i < tree->node_count; i++) {
        const octree_foreign_node *node = &tree->nodes[i];
        octree_foreign_place place = {.node = node, .parent = SIZE_MAX, .depth = DEPTH_UNKNOWN, .leaf = true};
        *fault = i;
        if (node->has_parent) {
            place.parent = find_node_place(keys, node->parent);
            if (place.parent == SIZE_MAX)
                return OCTREE_NOT_FOUND;
        }
        if (!list_push(memory, places, &place, sizeof place))
            return OCTREE_NO_MEMORY;
    }
    return OCTREE_OK;
}

/* Find the depths of a node and of its ancestors. The function walks up to an ancestor whose depth is known and marks
 * the nodes on the way. Then it walks back down and sets the depths. If the walk up reaches a marked node, the marked
 * node is its own ancestor, which is an error. */
static octree_status find_depths(arena *memory, octree_foreign_place *places, size_t start, list *path)
{
    size_t at = start;
    path->count = 0;
    for (; at != SIZE_MAX && places[at].depth == DEPTH_UNKNOWN; at = places[at].parent) {
        places[at].depth = DEPTH_ON_PATH;
        if (!list_push(memory, path, &at, sizeof at))
            return OCTREE_NO_MEMORY;
    }
    if (at != SIZE_MAX && places[at].depth == DEPTH_ON_PATH)
        return OCTREE_BAD_PARENT;
    unsigned depth = at == SIZE_MAX ? 0 : places[at].depth + 1;
    while (path->count > 0) {
        octree_foreign_place *place = &places[((const size_t *)path->items)[--path->count]];
        place->depth = place->node->has_depth ? (unsigned)place->node->depth : depth;
        depth = place->depth + 1;
    }
    return OCTREE_OK;
}

/* Make the list `places` of the nodes, and the list `keys` of the nodes' ids and indices, sorted by id. Returns the
 * status of octree_foreign_check(). On an error, *fault is the index of the wrong node. */
static octree_status index_nodes(arena *memory, const octree_foreign_tree *tree, list *places, list *keys,
                                 size_t *fault)
{
    *fault = 0;
    if (!tree->nodes && tree->node_count)
        return OCTREE_NULL_ARGUMENT;
    octree_status status = make_node_keys(memory, tree, keys, fault);
    if (status == OCTREE_OK)
        status = make_node_places(memory, tree, places, keys, fault);
    octree_foreign_place *items = places->items;
    list path = {0};
    for (size_t i = 0; status == OCTREE_OK && i < places->count; i++) {
        *fault = i;
        status = find_depths(memory, items, i, &path);
        if (items[i].parent != SIZE_MAX)
            items[items[i].parent].leaf = false;
    }
    list_release(memory, &path, sizeof(size_t));
    return status;
}

octree_status octree_foreign_check(const octree_foreign_tree *tree, size_t *place)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_foreign_check, tree, place);
    size_t fault;
    if (!tree)
        return OCTREE_NULL_ARGUMENT;
    arena memory = {.allocator = default_allocator()};
    list places = {0}, keys = {0};
    const octree_status status = index_nodes(&memory, tree, &places, &keys, place ? place : &fault);
    list_release(&memory, &places, sizeof(octree_foreign_place));
    list_release(&memory, &keys, sizeof(foreign_key));
    return status;
}

/* ---- The current nodes -------------------------------------------------------------------------------------- */

static bool copy_nodes(foreign *f, const octree_foreign_tree *tree)
{
    size_t ids = 0;
    for (size_t i = 0; i < tree->node_count; i++)
        ids += tree->nodes[i].has_points ? tree->nodes[i].points.count : 0;
    const size_t size = tree->node_count * sizeof *tree->nodes + ids * sizeof(uint64_t);
    f->nodes = size ? arena_allocate(f->memory, size) : NULL;
    f->size = f->nodes ? size : 0;
    if (!f->nodes)
        return size == 0;
    uint64_t *room = (uint64_t *)(f->nodes + tree->node_count);
    for (size_t i = 0; i < tree->node_count; i++) {
        octree_foreign_node *node = &f->nodes[i];
        *node = tree->nodes[i];
        node->points.count = node->has_points ? node->points.count : 0;
        if (node->points.count)
            memcpy(room, node->points.ids, node->points.count * sizeof *room);
        node->points.ids = room;
        room += node->points.count;
    }
    return true;
}

static uint64_t digest_foreign_node(uint64_t digest, const octree_foreign_node *node)
{
    digest = octree_digest_word(digest, node->id);
    digest = octree_digest_word(digest, node->has_parent ? node->parent : UINT64_MAX);
    for (int i = 0; i < 3; i++) {
        digest = octree_digest_double(digest, node->box.min[i]);
        digest = octree_digest_double(digest, node->box.max[i]);
    }
    digest = octree_digest_word(digest, node->has_depth ? (uint64_t)node->depth : UINT64_MAX);
    digest = octree_digest_word(digest, node->has_points ? node->points.count : UINT64_MAX);
    for (size_t i = 0; i < node->points.count; i++)
        digest = octree_digest_word(digest, node->points.ids[i]);
    digest = octree_digest_bytes(digest, node->kind, strlen(node->kind));
    return octree_digest_word(digest, (uint64_t)node->precision);
}

/* Set place->kind to the index of the node's kind in the list of kinds. A new kind is appended to the list. If the list
 * is full, further kinds get the last index of the list. Returns false if memory runs out. */
static bool assign_node_kind(foreign *f, octree_foreign_place *place)
{
    const char(*kinds)[OCTREE_NODE_KIND] = f->kinds.items;
    const size_t last = place->kind; /* the kind of the previous node, which is usually also the kind of this node */
    place->kind = 0;
    if (last < f->kinds.count && strcmp(kinds[last], place->node->kind) == 0)
        place->kind = (unsigned)last;
    else
        while (place->kind < f->kinds.count && strcmp(kinds[place->kind], place->node->kind) != 0)
            place->kind++;
    if (place->kind < f->kinds.count)
        return true;
    if (place->kind < OCTREE_NODE_KINDS)
        return list_push(f->memory, &f->kinds, place->node->kind, OCTREE_NODE_KIND);
    place->kind = OCTREE_NODE_KINDS - 1;
    return true;
}

/* Add to each node's count the points of all its descendants. A walk starts at each leaf and goes up. The walk goes on
 * to a parent only when the parent's last child is done. */
static void sum_points_below(foreign *f)
{
    octree_foreign_place *places = f->places.items;
    foreign_mark *marks = f->marks.items;
    for (size_t i = 0; i < f->places.count; i++)
        if (places[i].parent != SIZE_MAX)
            marks[places[i].parent].pending++;
    for (size_t i = 0; i < f->places.count; i++)
        for (size_t at = places[i].leaf ? i : SIZE_MAX; at != SIZE_MAX;) {
            const size_t parent = places[at].parent;
            places[at].points += places[at].node->points.count;
            if (parent != SIZE_MAX)
                places[parent].points += places[at].points;
            at = parent != SIZE_MAX && --marks[parent].pending == 0 ? parent : SIZE_MAX;
        }
}

bool foreign_set_nodes(foreign *f, const octree_foreign_tree *tree)
{
    octree_foreign_state *state = &f->state;
    size_t fault;
    arena_free(f->memory, f->nodes, f->size);
    f->places.count = f->keys.count = f->marks.count = f->visits.count = 0;
    if (!copy_nodes(f, tree))
        return false;
    const octree_foreign_tree copy = {.nodes = f->nodes, .node_count = tree->node_count};
    if (index_nodes(f->memory, &copy, &f->places, &f->keys, &fault) != OCTREE_OK)
        return false;
    state->given = state->fresh = true;
    state->digest = OCTREE_DIGEST_START;
    state->leaf_count = state->depth = 0;
    f->checked = false;
    octree_foreign_place *places = f->places.items;
    for (size_t i = 0; i < f->places.count; i++) {
        places[i].kind = i ? places[i - 1].kind : 0;
        if (!assign_node_kind(f, &places[i]) ||
            !list_push(f->memory, &f->marks, &(foreign_mark){.query = 0}, sizeof(foreign_mark)))
            return false;
        state->digest = digest_foreign_node(state->digest, places[i].node);
        state->leaf_count += places[i].leaf;
        state->depth = places[i].depth > state->depth ? places[i].depth : state->depth;
    }
    sum_points_below(f);
    return true;
}

void foreign_release(foreign *f)
{
    arena_free(f->memory, f->nodes, f->size);
    list_release(f->memory, &f->places, sizeof(octree_foreign_place));
    list_release(f->memory, &f->keys, sizeof(foreign_key));
    list_release(f->memory, &f->marks, sizeof(foreign_mark));
    list_release(f->memory, &f->holdings, sizeof(foreign_holding));
    list_release(f->memory, &f->kinds, OCTREE_NODE_KIND);
    list_release(f->memory, &f->repeated, sizeof(foreign_holding));
    list_release(f->memory, &f->wrong, sizeof(octree_wrong_node));
    list_release(f->memory, &f->visits, sizeof(size_t));
    list_release(f->memory, &f->unlisted, sizeof(unlisted_point));
}

size_t foreign_find_node(const foreign *f, uint64_t id)
{
    return find_node_place(&f->keys, id);
}

size_t foreign_find_first_holding(const foreign *f, uint64_t point)
{
    return find_item_by_first_word(f->holdings.items, sizeof(foreign_holding), f->holdings.count, point);
}

void foreign_update_state(foreign *f)
{
    octree_foreign_state *state = &f->state;
    if (!state->given)
        return;
    state->nodes = f->places.items;
    state->node_count = f->places.count;
    state->listed = f->wrong.items;
    state->listed_count = f->wrong.count;
    state->kinds = f->kinds.items;
    state->kind_count = f->kinds.count;
    state->wrong_count = 0;
    for (int kind = 0; kind < OCTREE_WRONG_NODE_KINDS; kind++)
        state->wrong_count += state->wrong[kind];
}
