/* diagram_place.h - the diagram in pixels: where its rows and slots are. Private to the diagram's files. */
#ifndef SCENE_DIAGRAM_PLACE_H
#define SCENE_DIAGRAM_PLACE_H

#include "diagram_slots.h"
#include "scene.h"

/* In units. */
#define DIAGRAM_NODE 6 /* the side of an inner node; a leaf's is half as long */

/* Where a line meets a node: at its head from above, and at its foot from below. */
typedef struct diagram_stop {
    double x, head, foot;
} diagram_stop;

typedef struct diagram_place {
    scene *scene;
    diagram_slots slots;
    double left, width; /* of the slots */
    double top, pitch;  /* of the rows */
    unsigned rows;
    bool words;                               /* there is room for them */
    octree_address way;                       /* the node to which the way is shown; 0 for none */
    diagram_stop stops[OCTREE_MAX_DEPTH + 1]; /* the nodes on it */
} diagram_place;

/* Measure the part of the picture that the diagram has, and arrange the tree in it. False where there is no room, or no
 * memory; the scene says which. */
bool diagram_place_make(diagram_place *place, scene *s, const octree *tree);

/* Whether a node is on the way. */
bool diagram_on_way(const diagram_place *place, octree_address node, unsigned depth);

/* The stop of a node of this height whose middle is at `middle`, 0 to 1. */
diagram_stop diagram_stop_at(const diagram_place *place, unsigned depth, double middle, double height);

/* The middle of a row. */
double diagram_row(const diagram_place *place, unsigned depth);

/* A rectangle about a pixel; at least one pixel wide and high. */
void diagram_fill(const diagram_place *place, uint64_t id, double x, double y, double width, double height,
                  unsigned role);

/* The levels that are folded, as bars; and where the way leads through them. */
void add_diagram_bars(diagram_place *place, const octree *tree);

/* The rows' depths and counts, and where the way leads to. */
void add_diagram_words(const diagram_place *place, const octree_node *way);

#endif
