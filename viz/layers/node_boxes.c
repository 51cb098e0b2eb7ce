/* tick_nodes.c - see tick_nodes.h. */
#include "tick_nodes.h"
#include "filter.h"

/* Those above it are met before it is: one of them is shown, unless the filter begins with this one. */
static bool lies_in_a_shown_one(const view_filter *f, unsigned depth)
{
    return !f->leaves && depth > (f->by_depth ? f->min_depth : 0);
}

bool tick_node_shown(scene *s, const octree *tree, octree_address address, octree_node *node)
{
    const view_filter *f = &s->view.filter;
    const octree_box world = octree_definition(tree).world;
    if (octree_node_at(tree, address, node) != OCTREE_OK)
        *node = (octree_node){.address = address,
                              .depth = octree_address_depth(address),
                              .leaf = true,
                              .box = octree_cell_box(&world, address)};
    if (!filter_shows_node(f, &world, node))
        return false;
    const bool small = lies_in_a_shown_one(f, node->depth) && camera_box_is_below(&s->camera, &node->box, s->view.lod);
    s->tally.small_met += small;
    return !small;
}

void add_node_box(scene *s, const octree_node *node, scene_style style)
{
    scene_add_box(s, (scene_box){.id = node->address, .box = node->box, .style = style, .depth = (uint8_t)node->depth});
}
