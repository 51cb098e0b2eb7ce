/* SPDX-License-Identifier: MIT */
/* foreign_nodes.h - draws and describes foreign nodes, for the layers that show nodes. */
#ifndef LAYERS_FOREIGN_NODES_H
#define LAYERS_FOREIGN_NODES_H

#include "layer_type.h"

/* The element id of a foreign node is the node's own id with bit 62 set. In an address of Octreel's tree, the number of
 * the highest set bit is always a multiple of 3, and 62 is not. So no address can be mistaken for the element id of a
 * foreign node. */
#define FOREIGN_ELEMENT (UINT64_C(1) << 62)

static inline uint64_t foreign_element_id(uint64_t node)
{
    return FOREIGN_ELEMENT | node;
}

static inline bool is_foreign_element(uint64_t id)
{
    return id >> 62 == 1;
}

/* Return the foreign node's own id, from the id of an element that shows the node. */
static inline uint64_t foreign_node_id(uint64_t id)
{
    return id & ~FOREIGN_ELEMENT;
}

/* Return whether the view shows Octreel's own tree at this tick, and whether it shows the foreign nodes. */
bool shows_octreel_nodes(const layer_source *in);
bool shows_foreign_nodes(const layer_source *in);

/* add_foreign_nodes() adds all foreign nodes that pass the view's filter, lod and budget. add_visited_foreign_nodes()
 * adds only the foreign nodes that queries visited, pruned or hit: `style.layer` selects which of the three. */
void add_foreign_nodes(scene *s, const layer_source *in);
void add_visited_foreign_nodes(scene *s, const layer_source *in, scene_style style);

/* A marker for a wrong foreign node, or for a point that no foreign node lists. */
typedef struct wrong_mark {
    uint64_t id;
    const octree_foreign_place *node; /* the wrong node; null: the marker is for a point */
    octree_wrong_node_kind kind;      /* the first error of the node */
    double at[3];                     /* where the error text begins: at the point, or at the node's upper corner */
} wrong_mark;

/* The markers of a tick: at most OCTREE_LISTED_WRONG_NODES nodes and OCTREE_LISTED_WRONG_NODES points. */
typedef struct wrong_marks {
    wrong_mark items[2 * OCTREE_LISTED_WRONG_NODES];
    size_t count;
} wrong_marks;

/* Return the markers of a tick. The result is empty if the view does not show the foreign nodes. */
wrong_marks find_marks_of_wrong_nodes(const layer_source *in);

/* mark_wrong_foreign_nodes() adds a marker for each wrong foreign node and for each point that no foreign node lists.
 * label_wrong_foreign_nodes() writes an error text beside each marker where there is room, and returns the number of
 * texts that found no room. `occupied` is the part of the picture that markers and texts already cover. */
void mark_wrong_foreign_nodes(scene *s, const wrong_marks *marks, text_space *occupied);
size_t label_wrong_foreign_nodes(scene *s, const wrong_marks *marks, text_space *occupied);

/* Append the text `before`, and then a phrase such as "foreign node 5: leaf at depth 2 of kind "leaf" under node 7, 3
 * points listed, box ...", and the node's error if it is wrong. */
void describe_foreign_node(description *d, const char *before, uint64_t element);

/* Describe an element that mark_wrong_foreign_nodes() or label_wrong_foreign_nodes() added. */
void describe_wrong_foreign_node(description *d, const described_element *element);

/* Write the first error in the tick's foreign nodes to `text`, or an empty string if there is no error. Return `text`.
 */
#define WRONG_NODE_TEXT 128
const char *wrong_node_text(const octree_foreign_state *foreign, char text[WRONG_NODE_TEXT]);

#endif
