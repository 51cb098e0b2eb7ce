/* SPDX-License-Identifier: MIT */
/* node_boxes.c - chooses the colours of nodes, and adds the boxes of single nodes. */
#include "node_boxes.h"
#include "octree/octree.h"

theme_role node_role(const view *v, node_traits node)
{
    switch (v->coloring) {
    case COLORING_OCCUPANCY:
        if (node.capacity == 0)
            return theme_node_role(theme_step_of_doubling_ramp(node.points, 1));
        return node.leaf ? theme_node_role(theme_step_of_even_ramp(node.points, node.capacity)) : ROLE_WORLD;
    case COLORING_PLAIN:
    case COLORING_KIND:
        return ROLE_NODE_PLAIN;
    default:
        return theme_node_role(node.depth);
    }
}

void add_node_box(scene *s, const octree_node *node, scene_style style)
{
    scene_add_box(s, (scene_box){.id = node->address, .box = node->box, .style = style, .depth = (uint8_t)node->depth});
}

bool is_left_out_by_lod(const scene *s, const octree_box *box, unsigned depth)
{
    const view_filter *f = &s->view.filter;
    return s->view.lod > 0 && !f->leaves && depth > (f->by_depth ? f->min_depth : 0) &&
           camera_is_box_smaller_than(&s->camera, box, s->view.lod);
}

bool is_position_shown(const view_filter *f, const octree *tree, const octree_box *world, const double position[3])
{
    octree_node leaf;
    return !filter_is_set(f) || (filter_shows_point(f, position) && octree_locate(tree, position, &leaf) == OCTREE_OK &&
                                 filter_shows_points_of(f, world, &leaf));
}

bool find_shown_node(scene *s, const octree *tree, octree_address address, octree_node *node)
{
    const octree_box world = octree_definition(tree).world;
    if (octree_node_at(tree, address, node) != OCTREE_OK)
        *node = (octree_node){.address = address,
                              .depth = octree_address_depth(address),
                              .leaf = true,
                              .box = octree_cell_box(&world, address)};
    if (!filter_shows_node(&s->view.filter, &world, node))
        return false;
    const bool small = is_left_out_by_lod(s, &node->box, node->depth);
    s->tally.small_marked += small;
    return !small;
}

void add_crossed_faces(scene *s, const octree_box *box, scene_style style)
{
    for (unsigned face = 0; face < 6; face++) {
        for (unsigned diagonal = 0; diagonal < 2; diagonal++) {
            double ends[2][3];
            const unsigned fixed = face / 2, across = (fixed + 1) % 3, along = (fixed + 2) % 3;
            for (unsigned end = 0; end < 2; end++) {
                ends[end][fixed] = face % 2 ? box->max[fixed] : box->min[fixed];
                ends[end][across] = end ? box->max[across] : box->min[across];
                ends[end][along] = end != diagonal ? box->max[along] : box->min[along];
            }
            scene_add_line(s, face * 2 + diagonal, ends[0], ends[1], style);
        }
    }
}
