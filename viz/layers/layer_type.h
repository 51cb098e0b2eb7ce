/* SPDX-License-Identifier: MIT */
/* layer_type.h - what a layer does. The file of a layer in this folder defines a layer_type of its row in layer.h, such
 * as layer_RANGE; scenes, the legend and `octreel pick` use nothing else.
 */
#ifndef LAYERS_LAYER_TYPE_H
#define LAYERS_LAYER_TYPE_H

#include "describe.h"
#include "layer.h"
#include "legend.h"
#include "pen.h"
#include "point_values.h"

/* What a scene is built from: a tick of a game, or a tree alone. */
typedef struct layer_source {
    const view *view; /* as requested; under DIAGRAM_ONLY the scene's view has fewer layers */
    const octree *tree;
    octree_box world;
    const octree_answer *answers;
    size_t answer_count;
    const point_values *values; /* of its points; null: they have none */
    const char *broken;         /* what the validator found; null when all invariants hold */
    octree_address broken_at;

    const octree_game *game; /* null: a tree alone */
    const octree_session *session;
    const octree_tick *tick;
    const heat *heat; /* null: the heat layers are empty */

    const char *title;        /* of a tree alone */
    octree_address requested; /* of a tree alone: the node to mark, or 0 */
} layer_source;

/* Members that a layer does not need are null or 0. `own` is the layer itself, for files that define several. */
typedef struct layer_type {
    /* Whether the layer can have elements in this frame or others of its recording: then the legend lists it. Null:
     * always; for layers of answers, when such a query was requested or is in each tick. */
    bool (*applies)(const layer_source *in);

    /* Whether a session can have anything for the layer. Null: each can. Two recordings are not unlike by a layer that
     * is empty in both. */
    bool (*in_session)(const octree_session *session);

    /* Add the layer's elements, or those of one answer. Hidden layers need no test: scene_add_* drops their elements.
     */
    void (*add)(scene *s, const layer_source *in, view_layer own);
    void (*add_answer)(scene *s, const octree_answer *answer, size_t place, view_layer own);

    /* Write the panel's row of an answer. */
    void (*write_answer)(pen *p, const octree_answer *answer);

    /* The legend: lines are sorted by place; one line of a sign and text, or what the function adds. */
    int legend_place;
    legend_sign sign;
    legend_drop_order worth;
    const char *text;
    void (*legend)(legend *l, const layer_source *in);

    /* Describe an element. Null: the ids of boxes are nodes, those of markers points. Markers of answers are always
     * points. */
    void (*describe)(description *d, const described_element *element);
} layer_type;

#define LAYER_TYPE_DECLARE(layer, ...) extern const layer_type layer_##layer;
LAYER_MAP(LAYER_TYPE_DECLARE)
#undef LAYER_TYPE_DECLARE

extern const layer_type *const layer_types[LAYER_ALL];

/* An applies() for layers that only games have. */
bool layer_in_games(const layer_source *in);

bool layer_applies(const layer_source *in, view_layer layer);

/* The layer that shows answers of a kind of query. */
view_layer layer_of_query(octree_query_kind kind);

#endif
