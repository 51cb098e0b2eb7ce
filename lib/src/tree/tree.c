/* SPDX-License-Identifier: MIT */
/* tree.c - creates, rebuilds and destroys trees, finds points, and returns the names and sentences of statuses. */
#include "tree.h"
#include "../exact/exact.h"
#include "../exact/float_mode.h"
#include "../exact/metric.h"

#include <math.h>
#include <stdlib.h>

/* In a tree with fewer points than this, a better leaf capacity gains nothing. */
#define TUNE_LEAST 1024

/* ---- Creating and destroying ------------------------------------------------------------------------------------- */

octree_def octree_def_default(void)
{
    return (octree_def){
        .world = {{-1000, -1000, -1000}, {1000, 1000, 1000}},
        .leaf_capacity = 64,
        .max_depth = OCTREE_MAX_DEPTH,
        .full_leaf = OCTREE_GROW,
    };
}

static octree_status check_definition(const octree_def *def)
{
    if (!has_exact_double_arithmetic())
        return OCTREE_BAD_BUILD;
    if (!is_world(&def->world))
        return OCTREE_BAD_WORLD;
    if (def->leaf_capacity == 0)
        return OCTREE_BAD_CAPACITY;
    if (def->leaf_capacity == OCTREE_AUTO && def->full_leaf != OCTREE_GROW)
        return OCTREE_BAD_CAPACITY;
    const bool half_an_allocator = !def->allocator.allocate != !def->allocator.release;
    if ((def->full_leaf != OCTREE_REFUSE && def->full_leaf != OCTREE_GROW) || half_an_allocator)
        return OCTREE_BAD_OPTION;
    return OCTREE_OK;
}

static octree_def clamp_definition(octree_def def)
{
    /* under OCTREE_AUTO, a tree without points has the default capacity */
    if (def.leaf_capacity == OCTREE_AUTO)
        def.leaf_capacity = octree_def_default().leaf_capacity;
    if (def.leaf_capacity > UINT32_MAX)
        def.leaf_capacity = UINT32_MAX;
    if (def.max_depth > OCTREE_MAX_DEPTH)
        def.max_depth = OCTREE_MAX_DEPTH;
    if (!def.allocator.allocate)
        def.allocator = default_allocator();
    return def;
}

static void set_key_squares(octree *tree)
{
    tree->has_key_squares = tree->scale == 1;
    for (int i = 0; i < 3; i++) {
        const axis *a = &tree->axes[i];
        const double gap = 1 / a->keys_per_unit;
        tree->key_squares[i] = gap * gap;
        tree->key_error += gap * a->guess_error;
        tree->has_key_squares &= a->sure_span > 0;
    }
}

octree_status octree_create(const octree_def *def, octree **tree)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_create, def, tree);
    if (!tree)
        return OCTREE_NULL_ARGUMENT;
    *tree = NULL;
    return def ? create_tree(def, sizeof(node), tree) : OCTREE_NULL_ARGUMENT;
}

octree_status create_tree(const octree_def *def, size_t node_size, octree **tree)
{
    *tree = NULL;
    const octree_status status = check_definition(def);
    if (status != OCTREE_OK)
        return status;
    arena memory = {.allocator = clamp_definition(*def).allocator};
    octree *made = arena_allocate(&memory, sizeof *made);
    if (!made)
        return OCTREE_NO_MEMORY;
    *made = (octree){.def = clamp_definition(*def), .store.memory = memory, .scale = metric_scale(&def->world)};
    made->tuning = (tuning){NULL, octree_mix_default(), TUNE_LEAST};
    if (def->leaf_capacity == OCTREE_AUTO)
        made->tuning.choose = octree_tune;
    for (int i = 0; i < 3; i++)
        made->axes[i] = axis_make(def->world.min[i], def->world.max[i]);
    set_key_squares(made);
    store_init(&made->store, node_size);
    *tree = made;
    return OCTREE_OK;
}

void octree_destroy(octree *tree)
{
    if (!tree || octree_clear(tree) != OCTREE_OK)
        return;
    arena memory = tree->store.memory;
    arena_free(&memory, tree, sizeof *tree);
}

octree_status octree_clear(octree *tree)
{
    if (!tree)
        return OCTREE_NULL_ARGUMENT;
    if (is_running_callback(tree))
        return OCTREE_BUSY;
    store_release(&tree->store, &tree->root);
    change_log_stop(&tree->changes, &tree->store.memory);
    tree->root = (node){0};
    tree->tuning.due = TUNE_LEAST;
    tree->version++;
    return OCTREE_OK;
}

octree_def octree_definition(const octree *tree)
{
    return tree ? tree->def : octree_def_default();
}

size_t octree_count(const octree *tree)
{
    return tree ? tree->root.count : 0;
}

uint64_t octree_version(const octree *tree)
{
    return tree ? tree->version : 0;
}

void tune_if_due(octree *tree)
{
    const size_t count = tree->root.count;
    if (!tree->tuning.choose || count < tree->tuning.due)
        return;
    tree->tuning.due = 2 * count;
    tree->tuning.choose(tree, &tree->tuning.mix);
}

/* ---- Rebuilding --------------------------------------------------------------------------------------------- */

/* Insert all points into an empty tree. Returns OUTSIDE or FULL if a point does not fit into the tree. */
static octree_status insert_all_points(octree *tree, const octree_point *points, size_t count)
{
    size_t inserted;
    for (size_t i = 0; i < count; i++)
        if (check_position(tree, points[i].position) != OCTREE_OK)
            return OCTREE_OUTSIDE;
    const octree_status status = octree_insert_many(tree, points, count, NULL, &inserted);
    return status == OCTREE_OK && inserted < count ? OCTREE_FULL : status;
}

/* Swap the contents of two trees with the same allocator. `tree` keeps its own tuning, and its version increases. */
static void swap_contents(octree *tree, octree *other)
{
    change_log_stop(&tree->changes, &tree->store.memory);
    other->changes.first = other->changes.next = tree->changes.next;
    const octree old = *tree;
    *tree = *other;
    *other = old;
    tree->version = old.version + 1;
    tree->tuning = old.tuning;
    tree->store.nodes.memory = tree->store.points.memory = &tree->store.memory;
    other->store.nodes.memory = other->store.points.memory = &other->store.memory;
}

octree_status rebuild_tree(octree *tree, const octree_def *def)
{
    octree *other;
    octree_status status = create_tree(def, tree->store.nodes.unit, &other);
    if (status != OCTREE_OK)
        return status;
    const size_t count = octree_count(tree), size = (count + 1) * sizeof(octree_point);
    octree_point *points = arena_allocate(&other->store.memory, size);
    status = OCTREE_NO_MEMORY;
    if (points) {
        /* while the executor of `tree` runs tasks of the other tree, changes of `tree` return BUSY */
        const unsigned begun = begin_callbacks(tree);
        node_copy_points(&tree->root, points);
        status = insert_all_points(other, points, count);
        end_callbacks(begun);
    }
    arena_free(&other->store.memory, points, size);
    if (status == OCTREE_OK)
        swap_contents(tree, other);
    octree_destroy(other);
    return status;
}

octree_status octree_replace_all(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *inserted)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_replace_all, tree, points, count, statuses, inserted);
    octree *other;
    if (!tree || (count && !points))
        return OCTREE_NULL_ARGUMENT;
    if (is_running_callback(tree))
        return OCTREE_BUSY;
    octree_status status = octree_create(&tree->def, &other);
    if (status != OCTREE_OK)
        return status;
    /* while the executor of `tree` runs tasks of the other tree, changes of `tree` return BUSY */
    const unsigned begun = begin_callbacks(tree);
    if (tree->def.full_leaf == OCTREE_GROW) /* no leaf refuses points */
        store_expect_points(&other->store, count);
    status = octree_insert_many(other, points, count, statuses, inserted);
    store_expect_points(&other->store, 0);
    end_callbacks(begun);
    if (status == OCTREE_OK)
        swap_contents(tree, other);
    octree_destroy(other);
    if (status == OCTREE_OK)
        tune_if_due(tree);
    return status;
}

octree_status octree_reworld(octree *tree, const octree_box *world)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_reworld, tree, world);
    if (!tree || !world)
        return OCTREE_NULL_ARGUMENT;
    if (is_running_callback(tree))
        return OCTREE_BUSY;
    octree_def def = tree->def;
    def.world = *world;
    return rebuild_tree(tree, &def);
}

octree_status octree_compact(octree *tree)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_compact, tree);
    if (!tree)
        return OCTREE_NULL_ARGUMENT;
    return is_running_callback(tree) ? OCTREE_BUSY : rebuild_tree(tree, &tree->def);
}

/* ---- Finding ------------------------------------------------------------------------------------------------ */

octree_status check_position(const octree *tree, const double position[3])
{
    if (!tree || !position)
        return OCTREE_NULL_ARGUMENT;
    if (box_contains(&tree->def.world, position))
        return OCTREE_OK;
    return is_finite_position(position) ? OCTREE_OUTSIDE : OCTREE_NOT_FINITE;
}

void extend_path(path *p, uint64_t code)
{
    for (; path_end(p)->octants; p->depth++) {
        node *child = child_at(path_end(p), morton_octant(code, p->depth));
        if (!child)
            break;
        p->nodes[p->depth + 1] = child;
    }
}

path find_path(const octree *tree, uint64_t code)
{
    /* The cast removes const, only here. A caller that changes nodes through the path has a tree that is not const. */
    path p;
    begin_path(&p, (octree *)(uintptr_t)tree);
    extend_path(&p, code);
    return p;
}

bool find_point(const octree *tree, const double position[3], uint64_t id, found_point *found)
{
    found->path = find_path(tree, morton_code(tree->axes, position));
    const node *end = path_end(&found->path);
    if (end->octants)
        return false;
    found->index = leaf_find(end, position, id);
    return found->index != LEAF_NONE;
}

/* Returns the leaf whose cell contains the shifted keys (plane.h). If there is no such leaf, returns the last node on
 * the path to these keys. */
static inline const node *find_deepest_node(const octree *tree, const uint64_t keys[3])
{
    const node *n = &tree->root;
    for (uint64_t x = keys[0], y = keys[1], z = keys[2]; n->octants; x <<= 1, y <<= 1, z <<= 1) {
        const unsigned octant = (unsigned)(x >> 63 << 2 | y >> 63 << 1 | z >> 63);
        if (!(n->octants >> octant & 1))
            break;
        n = look_up_child(n, octant);
    }
    return n;
}

/* Returns the point at a position that has the lowest id. Returns null if no point of the leaf is at the position. */
static inline const octree_point *find_lowest_id_in_leaf(const node *leaf, const double position[3])
{
    enum { TOGETHER = 64 };
    const octree_point *points = leaf_points(leaf), *found = NULL;
    for (uint32_t left = leaf->count, count; left > 0; left -= count, points += count) {
        count = left < TOGETHER ? left : TOGETHER;
        for (uint64_t equal = mask_equal_x(points, count, position[0]); equal; equal &= equal - 1) {
            const octree_point *point = &points[bits_lowest(equal)];
            if (is_same_position(point->position, position) && (!found || point->id < found->id))
                found = point;
        }
    }
    return found;
}

static inline octree_status find_id_by_keys(const octree *tree, const uint64_t keys[3], const double position[3],
                                            uint64_t *id)
{
    const node *end = find_deepest_node(tree, keys);
    const octree_point *found = end->octants ? NULL : find_lowest_id_in_leaf(end, position);
    if (found && id)
        *id = found->id;
    return found ? OCTREE_OK : OCTREE_NOT_FOUND;
}

/* Find the id at a position whose keys compute_shifted_keys() cannot compute: a position near a plane, or outside the
 * world. */
static octree_status find_id_near_plane(const octree *tree, const double position[3], uint64_t *id)
{
    const octree_status status = check_position(tree, position);
    uint64_t keys[3];
    for (int i = 0; i < 3 && status == OCTREE_OK; i++)
        keys[i] = (uint64_t)plane_key(&tree->axes[i], position[i]) << (64 - OCTREE_MAX_DEPTH);
    return status == OCTREE_OK ? find_id_by_keys(tree, keys, position, id) : status;
}

octree_status octree_find(const octree *tree, const double position[3], uint64_t *id)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_find, tree, position, id);
    uint64_t keys[3];
    if (!tree || !position)
        return OCTREE_NULL_ARGUMENT;
    if (RARELY(!compute_shifted_keys(tree->axes, position, keys)))
        return find_id_near_plane(tree, position, id);
    return find_id_by_keys(tree, keys, position, id);
}

bool octree_contains(const octree *tree, const double position[3], uint64_t id)
{
    RETURN_IN_DEFAULT_MODE(bool, octree_contains, tree, position, id);
    found_point found;
    return check_position(tree, position) == OCTREE_OK && find_point(tree, position, id, &found);
}

/* ---- Statuses, and the order of points ---------------------------------------------------------------------- */

static const struct {
    const char *word, *text;
} statuses[] = {
#define STATUS_ROW(name, word, text) {word, text},
    OCTREE_STATUS_MAP(STATUS_ROW)
#undef STATUS_ROW
};

const char *octree_status_text(octree_status status)
{
    return (unsigned)status < OCTREE_STATUS_COUNT ? statuses[status].text : "unknown status";
}

const char *octree_status_name(octree_status status)
{
    return (unsigned)status < OCTREE_STATUS_COUNT ? statuses[status].word : "unknown";
}

int octree_compare_points(const void *a, const void *b)
{
    const octree_point *p = a, *q = b;
    if (p->id != q->id)
        return p->id < q->id ? -1 : 1;
    RETURN_IN_DEFAULT_MODE(int, octree_compare_points, a, b);
    return compare_positions(p->position, q->position);
}
