/* SPDX-License-Identifier: MIT */
/* change_layers.c - the layers of the nodes that split or merged at a tick. */
#include "foreign_nodes.h"
#include "layer_type.h"
#include "octree/octree.h"
#include "text.h"
#include "node_boxes.h"

#include <stdio.h>
#include <string.h>

/* Draw three lines through the middle of a node that split or merged: the lines in which the planes between the node's
 * octants cross. The middle of the node is the lowest corner of the node's last octant. The id of a line is the node's
 * address shifted left, plus the line's axis. The shift loses no bits: only nodes at the greatest depth have addresses
 * of 64 bits, and such nodes never split. */
static void add_plane_lines(scene *s, const layer_source *in, octree_address address, scene_style style)
{
    octree_node node;
    if (!find_shown_node(s, in->tree, address, &node))
        return;
    const octree_box last = octree_cell_box(&in->world, address << 3 | 7);
    for (unsigned axis = 0; axis < 3; axis++) {
        double ends[2][3];
        memcpy(ends[0], last.min, sizeof ends[0]);
        memcpy(ends[1], last.min, sizeof ends[1]);
        ends[0][axis] = node.box.min[axis];
        ends[1][axis] = node.box.max[axis];
        scene_add_line(s, address << 2 | axis, ends[0], ends[1], style);
    }
}

/* Return the nodes that split at this tick, or the nodes that merged, depending on the layer. */
static const octree_address *get_changed_nodes(const octree_tick *tick, view_layer layer, size_t *count)
{
    *count = layer == LAYER_SPLITS ? tick->split_count : tick->merge_count;
    return layer == LAYER_SPLITS ? tick->splits : tick->merges;
}

static void add_changes(scene *s, const layer_source *in, view_layer layer)
{
    const scene_style style = make_layer_style(layer, layer == LAYER_SPLITS ? STROKE_SOLID : STROKE_DASHED, 2);
    size_t count;
    const octree_address *nodes = get_changed_nodes(in->tick, layer, &count);
    for (size_t i = 0; view_shows_layer(&s->view, layer) && i < count; i++)
        add_plane_lines(s, in, nodes[i], style);
}

/* Add a legend line such as "2 nodes split, last 7/7/0". The address is left out if it does not fit completely. */
static void add_change_legend(legend *l, const layer_source *in)
{
    char last[OCTREE_ADDRESS_TEXT];
    size_t count;
    const bool split = l->next.layer == LAYER_SPLITS;
    const octree_address *nodes = get_changed_nodes(in->tick, l->next.layer, &count);
    legend_line *line = legend_add(l, split ? SIGN_PLUS : SIGN_DASHED_PLUS, "%zu node%s %s", count,
                                   plural_ending(count), split ? "split" : "merged");
    if (count == 0)
        return;
    octree_address_format(nodes[count - 1], last);
    const char *between = count > 1 ? ", last " : " ";
    if (strlen(line->text) + strlen(between) + strlen(last) <= LEGEND_LETTERS)
        strcat(strcat(line->text, between), last);
}

static void describe_change(description *d, const described_element *element)
{
    append_text(d, "a plane of a node that %s at this tick", element->style.layer == LAYER_SPLITS ? "split" : "merged");
    describe_node(d, ", ", element->id >> 2);
}

static bool is_change_layer_applicable(const layer_source *in)
{
    return in->game && shows_octreel_nodes(in);
}

const layer_type layer_MERGES = {.applies = is_change_layer_applicable,
                                 .add = add_changes,
                                 .legend = {.order = 110, .add_lines = add_change_legend},
                                 .describe = describe_change};

const layer_type layer_SPLITS = {.applies = is_change_layer_applicable,
                                 .add = add_changes,
                                 .legend = {.order = 100, .add_lines = add_change_legend},
                                 .describe = describe_change};
