/* diagram.h - the tree drawn as a tree: the paper's Figure 2. Private to scene.
 *
 * A row a level, the root at the top. Nodes that have room are drawn one by one, with a line from each to its parent:
 * inner nodes as squares, leaves as squares of half the side; in the colours of the space view, and those that the
 * view's filter leaves out in grey. Levels that have no room are folded: bars that tell how many nodes stand in a
 * column of the picture, each doubling a sixteenth of the row higher. See diagram_slots.h for what stands where.
 */
#ifndef SCENE_DIAGRAM_H
#define SCENE_DIAGRAM_H

#include "octree/game.h"
#include "scene.h"

/* What the diagram shows beside the tree. */
typedef struct diagram_marks {
    octree_address way;         /* the node to which the way from the root is shown; 0 for none */
    const octree_visit *visits; /* in pre-order: nodes whose lines are bold or dashed, as in the space view, */
    size_t visit_count;
    bool visited, pruned; /* as far as they were looked into, or left out */
} diagram_marks;

/* Add the diagram where the view shows one. */
void add_diagram(scene *s, const octree *tree, const diagram_marks *marks);

#endif
