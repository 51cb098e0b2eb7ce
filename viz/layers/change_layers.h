/* change_layers.h - the layers of what happened to the tree's nodes: splits, merges, and what must never happen.
 * Private.
 */
#ifndef SCENE_CHANGE_LAYERS_H
#define SCENE_CHANGE_LAYERS_H

#include "octree/game.h"
#include "scene.h"

/* What the validator found. */
typedef struct finding {
    const char *broken; /* its sentence; null when all invariants hold */
    octree_address where;
} finding;

/* Ask the validator, where the view shows what it finds. */
finding find_broken(const view *v, const octree *tree);

/* Three lines through each node that split or merged at this tick, where its planes cross. Their ids are the node's
 * address and the line's axis: see change_line_id. */
void add_changes(scene *s, const octree_game *game);

/* The node at which an invariant is broken: crossed out, with the word beside it. */
void add_broken(scene *s, const octree_box *world, const finding *found);

#endif
