/* element_words.h - what an element of a tick's scene is about, in words: the ids that the scene gives, taken back to
 * the nodes, points, queries and events that they stand for. */
#ifndef RECORD_ELEMENT_WORDS_H
#define RECORD_ELEMENT_WORDS_H

#include "renderer.h"
#include "heat.h"
#include "octree/game.h"

/* Room for the words about one element. */
#define ELEMENT_WORDS 512

typedef struct element_subject {
    bool has_node, has_point;
    octree_node node;         /* the node it is about; where the tree has none any more, its cell */
    bool gone;                /* there is only the cell */
    octree_point point;       /* the point it is about */
    char text[ELEMENT_WORDS]; /* such as "node 0/3: leaf at depth 2, 1 point, box (0, 0, 0) to (5, 5, 5)" */
} element_subject;

/* `s` must be the scene of the game's last tick, and `h` the heat that it was made with. */
element_subject element_words(const octree_game *game, const heat *h, const scene *s, scene_element element);

/* The layer of an element: view_layer_name(), or "diagram". */
const char *element_layer(const scene *s, scene_element element);

#endif
