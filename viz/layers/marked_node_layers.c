/* SPDX-License-Identifier: MIT */
/* marked_node_layers.c - the two layers that mark a single node. Layer "asked" marks the node that the user requested
 * with `octreel inspect --node`. Layer "broken" marks the node in which the validator finds a broken invariant of the
 * tree. */
#include "layer_type.h"
#include "node_boxes.h"
#include "octree/octree.h"

#include <string.h>

#define MARK 12 /* half the size of the marker on a node that is small on screen, in halves of a picture unit */

/* ---- The requested node -------------------------------------------------------------------------------------- */

static bool is_node_requested(const layer_source *in)
{
    return in->requested != 0;
}

/* Draw the requested node with bold lines, in the colour of the path to this node in the diagram. If the node is small
 * on screen, add a marker. */
static void add_requested_node(scene *s, const layer_source *in, view_layer layer)
{
    octree_node node;
    double middle[3];
    if (octree_node_at(in->tree, in->requested, &node) != OCTREE_OK)
        return;
    add_node_box(s, &node, make_layer_style(layer, STROKE_SOLID, 2));
    if (camera_box_size_in_pixels(&s->camera, &node.box) > 2 * MARK * s->unit)
        return;
    scene_box_middle(&node.box, middle);
    scene_add_mark(s, in->requested, middle, SHAPE_LOZENGE, make_layer_style(layer, STROKE_SOLID, MARK));
}

static void add_requested_legend(legend *l, const layer_source *in)
{
    char address[OCTREE_ADDRESS_TEXT];
    legend_add(l, SIGN_BOLD, "node %.42s", octree_address_format(in->requested, address));
}

static void describe_requested_node(description *d, const described_element *element)
{
    describe_node(d, "", element->id);
}

const layer_type layer_ASKED = {.applies = is_node_requested,
                                .add = add_requested_node,
                                .legend = {.order = 60, .add_lines = add_requested_legend},
                                .describe = describe_requested_node};

/* ---- The node with a broken invariant ------------------------------------------------------------------------ */

/* Draw the node with the broken invariant: its box with crossed faces, and the word "broken" beside it. */
static void add_broken_node(scene *s, const layer_source *in, view_layer layer)
{
    if (!in->broken)
        return;
    const scene_style style = make_layer_style(layer, STROKE_DASHED, 2);
    const octree_box box = octree_cell_box(&in->world, in->broken_at);
    scene_label label = scene_make_label(in->broken_at, make_layer_style(layer, STROKE_DASHED, 1), " broken");
    label.in_world = true;
    memcpy(label.at, box.max, sizeof label.at);
    scene_add_outline(s, in->broken_at, &box, style);
    add_crossed_faces(s, &box, style);
    scene_add_label(s, label);
}

static void describe_broken_node(description *d, const described_element *element)
{
    if (element->kind == SCENE_SEGMENT) {
        append_text(d, "a line of the cross on a node with a broken invariant");
    } else if (element->kind == SCENE_BOX) {
        describe_node(d, "", element->id);
        append_text(d, "; an invariant of this node is broken");
    }
}

const layer_type layer_BROKEN = {.add = add_broken_node, .describe = describe_broken_node};
