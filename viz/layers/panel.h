/* panel.h - the column of text at the left: what this tick is about, and what the colours mean. Private. */
#ifndef SCENE_PANEL_H
#define SCENE_PANEL_H

#include "change_layers.h"
#include "octree/game.h"
#include "tick_scene.h"

void add_tick_panel(scene *s, const octree_game *game, const finding *found);
void add_tree_panel(scene *s, const octree *tree, const tree_look *about, const finding *found);

#endif
