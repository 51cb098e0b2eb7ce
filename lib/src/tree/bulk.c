/* insert_many.c - many points at once: what a node becomes is made from its old self and its share of the points. */
#include "bulk.h"
#include "undo_log.h"
#include "leaf.h"
#include "tune.h"

#include <stdlib.h>
#include <string.h>

typedef struct insertion {
    octree *tree;
    batch *batch;
    journal journal;
    list repetitions;
} insertion;

/* What was stored comes first, then the caller's points in their order: so leaves refuse as one by one. */
static int by_place(const void *a, const void *b)
{
    const morton_item *p = a, *q = b;
    return p->stored != q->stored ? q->stored - p->stored : (p->place > q->place) - (p->place < q->place);
}

/* A leaf of those of the items that it takes; the others are told why not. */
static bool make_leaf(insertion *in, morton_item *items, size_t count, node *made)
{
    const size_t capacity = in->tree->def.leaf_capacity;
    size_t taken = count;
    if (count > capacity && in->tree->def.full_leaf == OCTREE_REFUSE) {
        qsort(items, count, sizeof *items, by_place);
        taken = capacity;
    }
    if (!journal_make_leaf(&in->journal, made, (uint32_t)taken))
        return false;
    for (size_t i = 0; i < taken; i++)
        prefetch(batch_point(in->batch, &items[i])); /* they lie in the caller's order, far apart */
    for (size_t i = 0; i < taken; i++)
        leaf_put(made, batch_point(in->batch, &items[i]));
    for (size_t i = taken; i < count; i++)
        batch_set(in->batch, &items[i], OCTREE_FULL);
    return true;
}

/* The children that the items' octants become, and those that are there already. `old` is an inner node, or null. */
static bool build_children(insertion *in, const node *old, cell c, morton_item *items, size_t count, node *made);

/* Whether sorted items share one cell that cannot be divided: dividing this one would not part them. A leaf that
 * refuses asks this first, so that nothing is divided for points that are refused then; and where items do part, more
 * than a leaf's worth of them are taken, so that no division is in vain. */
static bool inseparable(const octree *tree, cell c, const morton_item *items, size_t count)
{
    const uint64_t unlike = items[0].code ^ items[count - 1].code;
    for (; may_split(tree, c); c = cell_child(c, morton_octant(items[0].code, c.depth)))
        if (morton_octant(unlike, c.depth) != 0)
            return false;
    return true;
}

/* What a cell without anything stored, or with all that was stored among the items, becomes. */
static bool build(insertion *in, cell c, morton_item *items, size_t count, node *made)
{
    const octree_def *def = &in->tree->def;
    if (count <= def->leaf_capacity || !may_split(in->tree, c) ||
        (def->full_leaf == OCTREE_REFUSE && inseparable(in->tree, c, items, count)))
        return make_leaf(in, items, count, made);
    return build_children(in, NULL, c, items, count, made);
}

/* A leaf's points and its share of the batch, in one order where the cell can be divided; where it cannot, as in a
 * crowd, nobody reads the order. There is room for twice as many. */
static void merge_items(const octree *tree, const node *leaf, cell c, const morton_item *items, size_t count,
                        morton_item *all)
{
    const size_t sum = leaf->count + count;
    for (uint32_t i = 0; i < leaf->count; i++)
        all[i] = (morton_item){morton_code(tree->axes, leaf_points(leaf)[i].position), i, true};
    memcpy(all + leaf->count, items, count * sizeof *items);
    if (may_split(tree, c))
        morton_sort(all, all + sum, sum, c.depth, batch_loose(tree));
}

/* Leave out those that the leaf holds already. Returns how many are left. */
static size_t drop_stored(const insertion *in, const node *leaf, morton_item *items, size_t count)
{
    size_t left = 0;
    for (size_t i = 0; i < count; i++) {
        const octree_point *point = batch_point(in->batch, &items[i]);
        if (leaf_find(leaf, point->position, point->id) == LEAF_NONE)
            items[left++] = items[i];
        else
            batch_set(in->batch, &items[i], OCTREE_DUPLICATE);
    }
    return left;
}

static bool add_to_leaf(insertion *in, const node *old, cell c, morton_item *items, size_t count, node *made)
{
    if (old->count == 0)
        return build(in, c, items, count, made) && journal_replace(&in->journal, old);
    count = drop_stored(in, old, items, count);
    if (count == 0)
        return true;
    const size_t room = 2 * (old->count + count) * sizeof(morton_item);
    morton_item *all = arena_take(&in->tree->memory, room);
    if (!all)
        return false;
    merge_items(in->tree, old, c, items, count, all);
    in->batch->stored = leaf_points(old);
    const bool ok = build(in, c, all, old->count + count, made) && journal_replace(&in->journal, old);
    arena_give(&in->tree->memory, all, room);
    return ok;
}

/* What a node becomes. */
static bool add(insertion *in, const node *old, cell c, morton_item *items, size_t count, node *made)
{
    *made = *old;
    if (count == 0)
        return true;
    return old->octants ? build_children(in, old, c, items, count, made) : add_to_leaf(in, old, c, items, count, made);
}

static bool build_children(insertion *in, const node *old, cell c, morton_item *items, size_t count, node *made)
{
    static const node empty = {0};
    size_t shares[8] = {0};
    unsigned octants = old ? old->octants : 0;
    for (size_t at = 0; at < count;) {
        const unsigned octant = morton_octant(items[at].code, c.depth);
        shares[octant] = batch_share(items + at, count - at, c.depth);
        octants |= 1u << octant;
        at += shares[octant];
    }
    node *group = journal_make_group(&in->journal, bits_count8(octants));
    *made = (node){.below = group, .octants = (uint8_t)octants};
    for (unsigned octant = 0; group && octant < 8; octant++) {
        if (!(octants >> octant & 1))
            continue;
        const node *before = old ? child_at(old, octant) : NULL;
        if (!add(in, before ? before : &empty, cell_child(c, octant), items, shares[octant], group))
            return false;
        made->count += group->count;
        items += shares[octant];
        group++;
    }
    return group && (!old || journal_replace(&in->journal, old));
}

/* A point of the batch, and its place there. */
typedef struct placed {
    octree_point point;
    uint32_t place;
} placed;

static int compare_placed(const void *a, const void *b)
{
    const placed *p = a, *q = b;
    const int order = octree_compare_points(&p->point, &q->point);
    return order ? order : (p->place > q->place) - (p->place < q->place);
}

/* A point that repeats an earlier one of the batch. */
typedef struct repetition {
    uint32_t place, first;
} repetition;

/* Of sorted points of one code the first of each becomes an item, the others are noted. */
static bool note_repetitions(insertion *in, const placed *sorted, size_t count, morton_item *items, size_t *left)
{
    const placed *first = NULL;
    for (const placed *p = sorted; p < sorted + count; p++) {
        if (!first || octree_compare_points(&first->point, &p->point) != 0) {
            first = p;
            items[(*left)++].place = p->place;
            continue;
        }
        repetition *r = list_append(&in->tree->memory, &in->repetitions, sizeof *r);
        if (!r)
            return false;
        *r = (repetition){p->place, first->place};
        if (in->batch->statuses)
            in->batch->statuses[p->place] = OCTREE_DUPLICATE;
    }
    return true;
}

/* Leave out those of the items of one code that repeat an earlier one. *left receives how many are left. */
static bool drop_alike(insertion *in, morton_item *items, size_t count, size_t *left)
{
    *left = 0;
    placed *sorted = arena_take(&in->tree->memory, count * sizeof *sorted);
    if (!sorted)
        return false;
    for (size_t i = 0; i < count; i++)
        sorted[i] = (placed){*batch_point(in->batch, &items[i]), items[i].place};
    qsort(sorted, count, sizeof *sorted, compare_placed);
    const bool ok = note_repetitions(in, sorted, count, items, left);
    arena_give(&in->tree->memory, sorted, count * sizeof *sorted);
    return ok;
}

/* Take those that repeat an earlier one out of the batch: they must not make leaves split. */
static bool drop_repetitions(insertion *in)
{
    batch *b = in->batch;
    size_t left = 0;
    for (size_t start = 0, end, some; start < b->count; start = end, left += some) {
        for (end = start + 1; end < b->count && b->items[end].code == b->items[start].code; end++)
            ;
        some = 1;
        if (end - start > 1 && !drop_alike(in, b->items + start, end - start, &some))
            return false;
        memmove(b->items + left, b->items + start, some * sizeof *b->items);
    }
    b->count = left;
    return true;
}

/* What repeats a point that its leaf refused would have been refused too. */
static void judge_repetitions(const insertion *in)
{
    const repetition *all = in->repetitions.items;
    octree_status *statuses = in->batch->statuses;
    for (size_t i = 0; statuses && i < in->repetitions.count; i++)
        if (statuses[all[i].first] == OCTREE_FULL)
            statuses[all[i].place] = OCTREE_FULL;
}

static octree_status insert_batch(insertion *in)
{
    octree *tree = in->tree;
    batch *b = in->batch;
    node root;
    if (b->repeated && !drop_repetitions(in))
        return OCTREE_NO_MEMORY;
    if (b->count > UINT32_MAX - tree->root.count)
        return OCTREE_TOO_MANY;
    if (!add(in, &tree->root, root_cell(), b->items, b->count, &root)) {
        journal_abandon(&in->journal);
        return OCTREE_NO_MEMORY;
    }
    judge_repetitions(in);
    if (root.count == tree->root.count)
        journal_abandon(&in->journal); /* nothing was taken */
    else
        journal_commit(&in->journal, root);
    return OCTREE_OK;
}

octree_status octree_insert_many(octree *tree, const octree_point *points, size_t count, octree_status *statuses,
                                 size_t *inserted)
{
    if (!tree || (!points && count))
        return OCTREE_NULL_ARGUMENT;
    batch b;
    insertion in = {.tree = tree, .batch = &b, .journal = {.tree = tree}};
    const uint32_t before = tree->root.count;
    octree_status status = batch_begin(&b, tree, points, count, statuses);
    if (status == OCTREE_OK)
        status = insert_batch(&in);
    if (status == OCTREE_OK && inserted)
        *inserted = tree->root.count - before;
    list_release(&tree->memory, &in.repetitions, sizeof(repetition));
    batch_end(&b);
    tune_if_due(tree);
    return status;
}
