/* SPDX-License-Identifier: MIT */
/* boxes.h - the boxes of the nodes of a level. Private. */
#ifndef OCTREE_NODE_BOXES_H
#define OCTREE_NODE_BOXES_H

#include "../exact/lanes.h"
#include "../query/search.h"
#include "cell.h"

/* Compute the boxes of all nodes of a level. Nothing is done in a level without boxes. */
void fit_all(const level *l);

/* Update the boxes after insert_along_path() or remove_along_path(), with that path, or after both changes of one leaf.
 * `removed` and `added` may be null. */
void fit_path(const level *l, const path *p, const octree_point *removed, const octree_point *added);

/* Update the boxes after a point was added to the tree of a level, or removed from it. After a move, first call this
 * for the removal. */
void fit_point(const level *l, const octree_point *point, bool added);

/* Returns whether all boxes of a level are known and are those of its bodies. */
bool are_boxes_right(const level *l);

/* Returns an upper bound, but for rounding, of the distances from a coordinate to the positions of a level. */
static inline double find_farthest(const level *l, int axis, double origin)
{
    return larger(fabs(l->tree->axes[axis].min - origin), fabs(l->tree->axes[axis].max - origin));
}

/* Returns the box of the node of a depth above 0 on a path. */
static inline octree_box *box_on_path(const path *p, unsigned depth)
{
    const node *parent = p->nodes[depth - 1];
    return boxes_of_group(children_of(parent), bits_count8(parent->octants)) + (p->nodes[depth] - children_of(parent));
}

/* The boxes of the children of a node, for queries. */
typedef struct sibling_boxes {
    const octree_box *items;
    unsigned count;
} sibling_boxes;

/* Returns the boxes of the children of a node. `c` is its cell if nodes have no boxes, which are then made; else null.
 */
static inline sibling_boxes boxes_of_children(const node *n, const divided_cell *c, octree_box made[8])
{
    const unsigned count = bits_look_up_count8(n->octants);
    if (!c)
        return (sibling_boxes){boxes_of_group(children_of(n), count), count};
    make_boxes_of_children(n, c, made);
    return (sibling_boxes){made, count};
}

/* Returns the cells that boxes_of_children() needs: null if nodes have boxes. */
static inline const divided_cell *cell_of_root(const level *l, divided_cell *root)
{
    if (has_boxes(&l->tree->store))
        return NULL;
    divide_root_cell(l, root);
    return root;
}

static inline const divided_cell *cell_of_child(const level *l, const node *n, const divided_cell *c, unsigned index,
                                                divided_cell *child)
{
    if (!c || children_of(n)[index].octants == 0)
        return NULL;
    divide_child(l, n, c, index, child);
    return child;
}

static inline unsigned mask_of_siblings(const sibling_boxes *b)
{
    return (1u << b->count) - 1;
}

/* Returns a mask of octants from a mask of the children of a node. */
static inline unsigned spread_mask(const node *n, unsigned children)
{
    unsigned spread = 0;
    if (n->octants == 0xff)
        return children;
    for (unsigned octants = n->octants; octants; octants &= octants - 1, children >>= 1)
        spread |= mask_if(children & 1, octants & (0 - octants));
    return spread;
}

/* Start to load what is below some children, given as a mask. */
static inline void prefetch_children(const node *n, unsigned children)
{
    for (; children; children &= children - 1)
        prefetch_memory(children_of(n)[bits_lowest(children)].below);
}

/* Returns the address of the child with an index. Only a tracer reads it; without one, the parent's is returned. */
static inline octree_address address_of_sibling(const meter *m, octree_address parent, const node *n, unsigned index)
{
    return m->how->trace ? parent << 3 | bits_lowest(spread_mask(n, 1u << index)) : parent;
}

/* Count and trace children that are pruned, given as a mask of the children of a node. */
static inline void meter_record_pruned_siblings(meter *m, octree_address parent, const node *n, unsigned children)
{
    if (m->how->trace)
        meter_record_pruned(m, parent, spread_mask(n, children));
    else
        m->count.pruned += bits_look_up_count8(children);
}

/* The boxes of as many siblings as there are lanes. */
typedef struct few_boxes {
    lanes min[3], max[3];
} few_boxes;

/* Load a group of boxes that begins at an index; see begin_of_group(). */
static inline few_boxes load_few_boxes(const sibling_boxes *b, unsigned begin)
{
    const octree_box *group[LANES];
    few_boxes few;
    for (unsigned i = 0; i < LANES; i++)
        group[i] = &b->items[lane_index(b->count, begin, i)];
    lanes_load_boxes(few.min, few.max, group);
    return few;
}

#endif
