/* SPDX-License-Identifier: MIT */
/* asked_layer.c - the layer that marks the node that `octreel inspect --node` names. */
#include "layer_type.h"
#include "node_boxes.h"
#include "octree/octree.h"

#define MARK 12 /* half the size of the mark on a node that is small on screen, in half units */

static bool applies(const layer_source *in)
{
    return in->requested != 0;
}

/* Draw the node bold, in the colour of its path in the diagram, and with a mark when it is small on screen. */
static void add_requested_node(scene *s, const layer_source *in, view_layer own)
{
    octree_node node;
    double middle[3];
    if (octree_node_at(in->tree, in->requested, &node) != OCTREE_OK)
        return;
    add_node_box(s, &node, layer_style(own, STROKE_SOLID, 2));
    if (camera_box_pixels(&s->camera, &node.box) > 2 * MARK * s->unit)
        return;
    scene_box_middle(&node.box, middle);
    scene_add_mark(s, in->requested, middle, SHAPE_LOZENGE, layer_style(own, STROKE_SOLID, MARK));
}

static void add_legend(legend *l, const layer_source *in)
{
    char address[OCTREE_ADDRESS_TEXT];
    legend_add(l, SIGN_BOLD, "node %.42s", octree_address_format(in->requested, address));
}

static void describe(description *d, const described_element *element)
{
    describe_node(d, element->id);
}

const layer_type layer_ASKED = {
    .applies = applies, .add = add_requested_node, .legend_place = 60, .legend = add_legend, .describe = describe};
