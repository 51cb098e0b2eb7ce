/* SPDX-License-Identifier: MIT */
/* foreign_nodes.h - the foreign nodes, for the layers that show nodes. */
#ifndef LAYERS_FOREIGN_NODES_H
#define LAYERS_FOREIGN_NODES_H

#include "layer_type.h"

/* Elements of a program's nodes have ids that no address of Octreel's is: those begin with a bit at a multiple of 3. */
#define FOREIGN_ELEMENT (UINT64_C(1) << 62)

static inline uint64_t foreign_element(uint64_t node)
{
    return FOREIGN_ELEMENT | node;
}

static inline bool is_foreign_element(uint64_t id)
{
    return id >> 62 == 1;
}

/* The node that an element is of. */
static inline uint64_t foreign_node_of(uint64_t id)
{
    return id & ~FOREIGN_ELEMENT;
}

/* Which of the two trees the view shows of this tick. */
bool shows_own_tree(const layer_source *in);
bool shows_foreign_tree(const layer_source *in);

/* All nodes, within the view's filter, lod and budget; and those that queries met, for the layers visited, pruned and
 * hit. */
void add_foreign_nodes(scene *s, const layer_source *in);
void add_visited_foreign_nodes(scene *s, const layer_source *in, view_layer own);

/* The nodes that are wrong and the points that are in none, for the layer `own`; then, for as many as have room, what
 * is wrong, of a node its first fault. Returns for how many there was none. */
void mark_foreign_faults(scene *s, const layer_source *in, view_layer own, text_space *occupied);
size_t label_foreign_faults(scene *s, const layer_source *in, view_layer own, text_space *occupied);

/* "node 5 of the program: leaf "leaf" at depth 2 under node 7, 3 points listed, box ...", and what is wrong with it. */
void describe_foreign_node(description *d, uint64_t element);

/* An element of these. */
void describe_foreign_fault(description *d, const described_element *element);

/* The first of the tick's faults, such as "node 60 lists point 4 outside its box"; empty where there is none. */
#define FOREIGN_FAULT_TEXT 128
const char *foreign_fault_text(const octree_foreign_state *foreign, char text[FOREIGN_FAULT_TEXT]);

#endif
