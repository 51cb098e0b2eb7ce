/* survey.c - see survey.h. */
#include "tree_summary.h"
#include "walk.h"

#include <stdlib.h>
#include <string.h>

#define SURVEY_PART 512

/* More places than these are not worth being told apart: most parts would be looked at anyway. */
static size_t most_touched(const octree *tree)
{
    enum { ALWAYS = 4096, POINTS = 64 };
    const size_t some = tree->root.count / POINTS;
    return some > ALWAYS ? some : ALWAYS;
}

/* A subtree of SURVEY_PART points or fewer whose parent has more, or a leaf. */
typedef struct part {
    octree_address address;
    size_t first_inner, inner_count; /* in the list of inner nodes */
    octree_stats stats;
    uint64_t sum; /* of digest_node() */
} part;

/* What one survey carries with it, from left to right: all of these lists are in the order of the parts. */
typedef struct surveying {
    survey *to;
    arena *memory;
    const octree *tree;
    size_t next_before, next_touched;
    uint64_t sum;
    bool out_of_memory;
} surveying;

void survey_touch(survey *s, arena *memory, const octree *tree, const double place[3])
{
    if (!s->known)
        return;
    uint64_t *code = s->touched.count < most_touched(tree) ? list_append(memory, &s->touched, sizeof *code) : NULL;
    if (code)
        *code = morton_code(tree->axes, place);
    else
        s->known = false;
}

void survey_release(survey *s, arena *memory)
{
    list_release(memory, &s->touched, sizeof(uint64_t));
    list_release(memory, &s->parts, sizeof(part));
    list_release(memory, &s->parts_before, sizeof(part));
    list_release(memory, &s->inner, sizeof(octree_address));
    list_release(memory, &s->inner_before, sizeof(octree_address));
}

/* ---- A part ------------------------------------------------------------------------------------------------- */

static void add_inner(surveying *w, octree_address address)
{
    octree_address *item = list_append(w->memory, &w->to->inner, sizeof *item);
    if (item)
        *item = address;
    else
        w->out_of_memory = true;
}

static void look_at(octree_stats *stats, uint64_t *sum, const node *n, octree_address address)
{
    count_node(stats, n, octree_address_depth(address));
    *sum += digest_node(n, address);
}

/* The nodes of a part, in pre-order. */
static void look_below(surveying *w, part *p, const node *n, octree_address address)
{
    look_at(&p->stats, &p->sum, n, address);
    if (n->octants == 0)
        return;
    add_inner(w, address);
    prefetch_below(n);
    const node *child = children_of(n);
    for (unsigned octant = 0; octant < 8; octant++)
        if (n->octants >> octant & 1)
            look_below(w, p, child++, address << 3 | octant);
}

/* The part that was at this address at the last survey, or null. */
static const part *part_before(surveying *w, octree_address address)
{
    const part *before = w->to->parts_before.items;
    const size_t count = w->to->parts_before.count;
    while (w->next_before < count && address_compare(&before[w->next_before].address, &address) < 0)
        w->next_before++;
    return w->next_before < count && before[w->next_before].address == address ? &before[w->next_before] : NULL;
}

/* Whether a place in the cell at an address was touched. */
static bool is_touched(surveying *w, octree_address address)
{
    const uint64_t *codes = w->to->touched.items;
    const size_t count = w->to->touched.count;
    const unsigned below = 3 * (OCTREE_MAX_DEPTH - octree_address_depth(address));
    const uint64_t first = (address ^ UINT64_C(1) << 3 * octree_address_depth(address)) << below;
    while (w->next_touched < count && codes[w->next_touched] < first)
        w->next_touched++;
    return w->next_touched < count && codes[w->next_touched] - first < UINT64_C(1) << below;
}

static void keep_inner(surveying *w, const part *before)
{
    const octree_address *addresses = w->to->inner_before.items;
    for (size_t i = 0; i < before->inner_count && !w->out_of_memory; i++)
        add_inner(w, addresses[before->first_inner + i]);
}

static void add_part(surveying *w, const node *n, octree_address address)
{
    const part *before = part_before(w, address);
    part *p = list_append(w->memory, &w->to->parts, sizeof *p);
    if (!p) {
        w->out_of_memory = true;
        return;
    }
    const bool kept = before && !is_touched(w, address);
    const size_t first_inner = w->to->inner.count;
    *p = kept ? *before : (part){.address = address};
    if (kept) {
        keep_inner(w, before);
    } else {
        look_below(w, p, n, address);
    }
    p->first_inner = first_inner;
    p->inner_count = w->to->inner.count - first_inner;
}

/* ---- The whole ---------------------------------------------------------------------------------------------- */

static void add_stats(octree_stats *to, const octree_stats *of)
{
    to->nodes += of->nodes;
    to->leaves += of->leaves;
    to->depth = of->depth > to->depth ? of->depth : to->depth;
    to->largest_leaf = of->largest_leaf > to->largest_leaf ? of->largest_leaf : to->largest_leaf;
    for (unsigned depth = 0; depth <= of->depth; depth++) {
        to->nodes_at_depth[depth] += of->nodes_at_depth[depth];
        to->leaves_at_depth[depth] += of->leaves_at_depth[depth];
    }
}

static bool is_part(const node *n)
{
    return n->octants == 0 || n->count <= SURVEY_PART;
}

/* The nodes above the parts, in pre-order, and between them the parts. */
static void look_at_all(surveying *w, const node *n, octree_address address)
{
    if (w->out_of_memory)
        return;
    if (is_part(n)) {
        add_part(w, n, address);
        return;
    }
    look_at(&w->to->stats, &w->sum, n, address);
    add_inner(w, address);
    const node *child = children_of(n);
    for (unsigned octant = 0; octant < 8; octant++)
        if (n->octants >> octant & 1)
            look_at_all(w, child++, address << 3 | octant);
}

static void add_up_parts(surveying *w)
{
    const part *parts = w->to->parts.items;
    for (size_t i = 0; i < w->to->parts.count; i++) {
        w->sum += parts[i].sum;
        add_stats(&w->to->stats, &parts[i].stats);
    }
}

static void swap_with_before(list *now, list *before)
{
    const list kept = *before;
    *before = *now;
    *now = kept;
    now->count = 0;
}

static int compare_codes(const void *a, const void *b)
{
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return p < q ? -1 : p > q;
}

octree_status survey_update(survey *s, arena *memory, const octree *tree)
{
    surveying w = {.to = s, .memory = memory, .tree = tree};
    swap_with_before(&s->parts, &s->parts_before);
    swap_with_before(&s->inner, &s->inner_before);
    if (!s->known || s->capacity != tree->def.leaf_capacity)
        s->parts_before.count = 0;
    if (s->touched.count > 1)
        qsort(s->touched.items, s->touched.count, sizeof(uint64_t), compare_codes);
    s->stats = (octree_stats){.points = tree->root.count, .memory = tree->store.memory.bytes};
    look_at_all(&w, &tree->root, OCTREE_ROOT);
    add_up_parts(&w);
    s->digest = digest_of_sum(tree, w.sum);
    s->known = !w.out_of_memory;
    s->version = tree->version;
    s->capacity = tree->def.leaf_capacity;
    s->touched.count = 0;
    return s->known ? OCTREE_OK : OCTREE_NO_MEMORY;
}
