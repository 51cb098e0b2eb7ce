/* SPDX-License-Identifier: MIT */
/* layer_type.h - the interface of a layer. Each layer is a row in layer.h and a file that defines its layer_type, such
 * as layer_RANGE. Scenes, the legend and `octreel pick` reach a layer only through its layer_type. */
#ifndef LAYERS_LAYER_TYPE_H
#define LAYERS_LAYER_TYPE_H

#include "describe.h"
#include "layer.h"
#include "legend.h"
#include "pen.h"
#include "point_values.h"

/* The input of a scene: a tick of a game, or a tree alone. */
typedef struct layer_source {
    const view *view; /* the requested view; under DIAGRAM_ONLY the scene's layer view has fewer layers */
    const octree *tree;
    octree_box world;
    const octree_answer *answers;
    size_t answer_count;
    const point_values *values; /* colours, classes and intensities of the points; null: no values */
    const char *broken;         /* the validator's sentence; null when all invariants hold */
    octree_address broken_at;

    const octree_game *game; /* null: a tree alone */
    const octree_session *session;
    const octree_tick *tick;
    const heat *heat; /* null: the heat layers are empty */

    const char *title;        /* of a tree alone */
    octree_address requested; /* of a tree alone: the node that `inspect` was asked to mark, or 0 */
} layer_source;

/* A layer's lines in the legend: one line made of `sign` and `text`, or the lines that add_lines() adds. */
typedef struct legend_entry {
    int order; /* the legend sorts layers by it: 1 to LEGEND_LAST; 0: no lines */
    legend_sign sign;
    const char *text;
    legend_drop_order drop_order;
    void (*add_lines)(legend *l, const layer_source *in);
} legend_entry;

/* Members that a layer does not need are null or 0. `layer` is the layer itself, for files that define several. */
typedef struct layer_type {
    /* Whether the layer can have elements in this frame or in another frame of its recording; the legend then lists it.
     * Null means always, or, for a layer of answers, that a query of its kind was asked or is asked in every tick. */
    bool (*applies)(const layer_source *in);

    /* Whether a session can have elements for the layer. Null: every session can. `diff` ignores a difference in the
     * shown layers if the layer is empty in both recordings. */
    bool (*in_session)(const octree_session *session);

    /* Add the layer's elements, or the elements of one answer. A hidden layer needs no check: scene_add_* drops its
     * elements. */
    void (*add)(scene *s, const layer_source *in, view_layer layer);
    void (*add_answer)(scene *s, const octree_answer *answer, size_t place, view_layer layer);

    /* Write an answer's row in the panel. */
    void (*write_answer)(pen *p, const octree_answer *answer);

    legend_entry legend;

    /* Describe an element. Null: the id of a box is a node address, and the id of a marker is a point id. The id of an
     * answer's marker is always a point id. */
    void (*describe)(description *d, const described_element *element);
} layer_type;

#define LAYER_TYPE_DECLARE(layer, ...) extern const layer_type layer_##layer;
LAYER_MAP(LAYER_TYPE_DECLARE)
#undef LAYER_TYPE_DECLARE

extern const layer_type *const layer_types[LAYER_ALL];

/* An applies() for layers that exist only in scenes of a game. */
bool layer_in_games(const layer_source *in);

bool layer_applies(const layer_source *in, view_layer layer);

/* Return the layer that shows the answers of a query kind. */
view_layer layer_of_query(octree_query_kind kind);

#endif
