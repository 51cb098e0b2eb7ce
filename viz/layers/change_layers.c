/* change_layers.c - see change_layers.h. */
#include "change_layers.h"
#include "crossed_box.h"
#include "element_ids.h"
#include "layer.h"
#include "tick_nodes.h"

#include <string.h>

finding find_broken(const view *v, const octree *tree)
{
    finding found = {.where = OCTREE_ROOT};
    if (view_shows(v, LAYER_BROKEN))
        found.broken = octree_check(tree, &found.where);
    return found;
}

/* Where a cell's three planes cross: the lowest corner of its last octant. */
static void add_planes(scene *s, const octree *tree, octree_address address, scene_style style)
{
    octree_node node;
    if (!tick_node_shown(s, tree, address, &node))
        return;
    const octree_box world = octree_definition(tree).world;
    const octree_box last = octree_cell_box(&world, address << 3 | 7);
    for (unsigned axis = 0; axis < 3; axis++) {
        scene_segment line = {.id = change_line_id(address, axis), .style = style};
        memcpy(line.ends[0], last.min, sizeof line.ends[0]);
        memcpy(line.ends[1], last.min, sizeof line.ends[1]);
        line.ends[0][axis] = node.box.min[axis];
        line.ends[1][axis] = node.box.max[axis];
        scene_add_segment(s, line);
    }
}

void add_changes(scene *s, const octree_game *game)
{
    const scene_style split = layer_style(LAYER_SPLITS, STROKE_SOLID, 2);
    const scene_style merged = layer_style(LAYER_MERGES, STROKE_DASHED, 2);
    const octree_tick *tick = octree_game_tick(game);
    const octree *tree = octree_game_tree(game);
    for (size_t i = 0; view_shows(&s->view, LAYER_SPLITS) && i < tick->split_count; i++)
        add_planes(s, tree, tick->splits[i], split);
    for (size_t i = 0; view_shows(&s->view, LAYER_MERGES) && i < tick->merge_count; i++)
        add_planes(s, tree, tick->merges[i], merged);
}

void add_broken(scene *s, const octree_box *world, const finding *found)
{
    if (!found->broken)
        return;
    const scene_style style = layer_style(LAYER_BROKEN, STROKE_DASHED, 2);
    const octree_box box = octree_cell_box(world, found->where);
    scene_label word = {.id = found->where, .in_world = true, .style = style, .text = " broken"};
    scene_add_box(s, (scene_box){.id = found->where, .box = box, .style = style});
    add_crossed_faces(s, &box, style);
    memcpy(word.at, box.max, sizeof word.at);
    word.style.width = 1;
    scene_add_label(s, word);
}
