/* panel_legend.h - what colours and lines mean, at the foot of the column; and how many nodes there are of those that
 * the tick is about. Private to the panel's files.
 */
#ifndef SCENE_PANEL_LEGEND_H
#define SCENE_PANEL_LEGEND_H

#include "panel_pen.h"
#include "tick_scene.h"

/* A line for each layer of the view that can have something in it, and for the marks of the diagram. Where the column
 * has no room for all of them, as many are left out as need be: first of those that have nothing in this frame, then of
 * those that explain themselves, then of queries, whose answers are told in their colours; then those that have
 * no room below the first ones, and the legend ends in how many lines these would be. */
void write_tick_legend(pen *p, const octree_game *game);
void write_tree_legend(pen *p, const octree *tree, const tree_look *about);

#endif
