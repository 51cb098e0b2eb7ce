/* visit_layers.c - see visit_layers.h. */
#include "visit_layers.h"
#include "layer.h"
#include "tick_nodes.h"
#include "tree_nodes.h"

/* A node keeps the colour that it has in the tree. What was looked into is bold, what was left out is dashed. */
static void add_met(scene *s, const octree *tree, const octree_visit *visit)
{
    static const scene_style styles[OCTREE_TOUCH_KINDS] = {
        [OCTREE_TOUCH_VISITED] = {.layer = LAYER_VISITED, .stroke = STROKE_SOLID, .width = 2},
        [OCTREE_TOUCH_TAKEN] = {.layer = LAYER_VISITED, .stroke = STROKE_SOLID, .width = 2},
        [OCTREE_TOUCH_PRUNED] = {.layer = LAYER_PRUNED, .stroke = STROKE_CUT, .width = 1},
    };
    octree_node node;
    scene_style style = styles[visit->touch];
    if (!view_shows(&s->view, style.layer) || !tick_node_shown(s, tree, visit->node, &node))
        return;
    style.role = (uint8_t)node_role(&s->view, node.depth, node.count);
    add_node_box(s, &node, style);
}

void add_visits(scene *s, const octree_game *game)
{
    const scene_style hit_style = layer_style(LAYER_HIT, STROKE_SOLID, 2);
    const octree_tick *tick = octree_game_tick(game);
    const octree *tree = octree_game_tree(game);
    octree_node node;
    for (size_t i = 0; i < tick->visit_count; i++)
        add_met(s, tree, &tick->visits[i]);
    for (size_t i = 0; view_shows(&s->view, LAYER_HIT) && i < tick->hit_leaf_count; i++)
        if (tick_node_shown(s, tree, tick->hit_leaves[i], &node))
            add_node_box(s, &node, hit_style);
}
