/* SPDX-License-Identifier: MIT */
/* describe.h - describes an element of a tick's scene in English: which node, point, query or event it shows. `octreel
 * pick` prints these sentences. Each layer describes its own elements (layer_type.h). */
#ifndef LAYERS_DESCRIBE_H
#define LAYERS_DESCRIBE_H

#include "heat.h"
#include "octree/game.h"
#include "scene.h"

/* The size of an element's description in bytes, including the final zero. */
#define ELEMENT_TEXT 512

typedef struct element_subject {
    bool has_node, has_point;
    octree_node node;   /* the node that the element shows; if `gone` is true, the empty cell where the node was */
    bool gone;          /* true: the tree no longer has the node */
    octree_point point; /* the point that the element shows */
    uint64_t query;     /* the number of the query that the element shows, from 1; 0: none */
    const octree_foreign_place
        *foreign; /* the foreign node that the element shows; null: none. Valid until the next tick */
    /* The description, such as "node 0/3: leaf at depth 2, 1 point, box (0, 0, 0) to (5, 5, 5)". */
    char text[ELEMENT_TEXT];
} element_subject;

/* Describe an element. `s` must be the scene of the game's last tick, and `h` the heat from which `s` was built. */
element_subject describe_element(const octree_game *game, const heat *h, const scene *s, scene_element element);

/* ---- For layers --------------------------------------------------------------------------------------------- */

/* A description to which phrases are being appended. */
typedef struct description {
    const octree_game *game;
    const octree_tick *tick;
    const heat *heat;
    element_subject *subject;
    size_t length; /* length of subject.text in bytes */
} description;

/* The facts about an element that are passed to the member `describe` of a layer_type. */
typedef struct described_element {
    scene_kind kind;
    scene_style style;
    uint64_t id;
    octree_box box; /* the element's box; valid only if `kind` is SCENE_BOX */
    double at[3];   /* the element's position; like `shape`, valid only if `kind` is SCENE_MARKER */
    scene_shape shape;
} described_element;

/* Append formatted text. Text beyond ELEMENT_TEXT is cut off. */
void append_text(description *d, const char *format, ...);

/* Append the text `before`, and then the number `value`. */
void append_number(description *d, const char *before, double value);
/* Append the text `before`, and then a position, such as "(1, 2, 3)". */
void append_position(description *d, const char *before, const double position[3]);
/* Append the text `before`, and then a box, such as "(0, 0, 0) to (5, 5, 5)". */
void append_box(description *d, const char *before, const octree_box *box);

/* Append the text `before`, and then a phrase about a node or a point. Also store the node or point in the
 * description's subject. The id of an element that shows a node of Octreel's own tree is the node's address.
 * foreign_nodes.h explains the ids of foreign nodes. */
void describe_node(description *d, const char *before, uint64_t id);
void describe_point(description *d, const char *before, uint64_t id, const double position[3]);

#endif
