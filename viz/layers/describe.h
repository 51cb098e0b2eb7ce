/* SPDX-License-Identifier: MIT */
/* describe.h - a description in words of an element of a tick's scene: the node, point, query or event that its id
 * stands for. Each layer describes its own elements (layer_type.h).
 */
#ifndef LAYERS_DESCRIBE_H
#define LAYERS_DESCRIBE_H

#include "heat.h"
#include "octree/game.h"
#include "scene.h"

/* Room for the words about one element. */
#define ELEMENT_TEXT 512

typedef struct element_subject {
    bool has_node, has_point;
    octree_node node;   /* the node that it shows, or its cell when the tree no longer has the node */
    bool gone;          /* the tree no longer has the node */
    octree_point point; /* the point that it shows */
    const octree_foreign_place
        *foreign;            /* the node of the program's tree that it shows, until the next tick; or null */
    char text[ELEMENT_TEXT]; /* such as "node 0/3: leaf at depth 2, 1 point, box (0, 0, 0) to (5, 5, 5)" */
} element_subject;

/* s must be the scene of the game's last tick, and h the heat that it was built with. */
element_subject describe_element(const octree_game *game, const heat *h, const scene *s, scene_element element);

/* ---- For layers --------------------------------------------------------------------------------------------- */

/* A description under construction. */
typedef struct description {
    const octree_game *game;
    const octree_tick *tick;
    const heat *heat;
    element_subject *subject;
    size_t length; /* of the text */
} description;

/* What layers read of an element. */
typedef struct described_element {
    scene_kind kind;
    scene_style style;
    uint64_t id;
    octree_box box; /* of a box */
    double at[3];   /* of a marker */
    scene_shape shape;
} described_element;

/* Append words; cut at ELEMENT_TEXT. */
void append_text(description *d, const char *format, ...);
void append_number(description *d, double value);
void append_position(description *d, const double place[3]); /* "(1, 2, 3)" */
void append_box(description *d, const octree_box *box);      /* "(0, 0, 0) to (5, 5, 5)" */

/* The node or point becomes the description's subject. */
void describe_node(description *d, octree_address address);
void describe_point(description *d, uint64_t id, const double position[3]);

#endif
