/* visit_layers.h - the layers of what a tick's questions met: nodes looked into, nodes left out, leaves of what was
 * found. Private.
 */
#ifndef SCENE_VISIT_LAYERS_H
#define SCENE_VISIT_LAYERS_H

#include "octree/game.h"
#include "scene.h"

/* A box for each node that the tick met and the view shows, with its address as id. */
void add_visits(scene *s, const octree_game *game);

#endif
