/* layer_type.h - what a layer does. The file of a layer in this folder defines a layer_type of its row in layer.h, such
 * as layer_RANGE; that is all that the scene, the legend and those who ask what is at a pixel go by.
 */
#ifndef LAYERS_LAYER_TYPE_H
#define LAYERS_LAYER_TYPE_H

#include "describe.h"
#include "layer.h"
#include "legend.h"
#include "pen.h"

/* What a scene is made of: a tick of a game, or a tree alone. */
typedef struct layer_source {
    const view *view; /* as it was asked for; where the diagram is alone, the scene's has fewer layers */
    const octree *tree;
    octree_box world;
    const octree_answer *answers;
    size_t answer_count;
    const char *broken; /* what the validator found, null where all invariants hold, */
    octree_address broken_at;

    const octree_game *game; /* null: a tree alone */
    const octree_session *session;
    const octree_tick *tick;
    const heat *heat; /* null: not counted */

    const char *title;    /* of a tree alone, */
    octree_address asked; /* and the node that is asked for, or 0 */
} layer_source;

/* Members that are null or 0 are what a layer does not have. `own` is the layer itself, for files with several. */
typedef struct layer_type {
    /* Whether the layer can have something in it, in this frame or others of its recording; then it is listed in the
     * legend. Null: always, or where there are answers in it or will be. */
    bool (*applies)(const layer_source *in);

    /* Add the layer's elements; of a layer of answers, those of one. Layers that are not shown need no test: a scene
     * leaves their elements out. */
    void (*add)(scene *s, const layer_source *in, view_layer own);
    void (*add_answer)(scene *s, const octree_answer *answer, size_t place, view_layer own);

    /* The row of an answer in the panel. */
    void (*write_answer)(pen *p, const octree_answer *answer);

    /* The legend: sorted by these places, a line of a sign and words, or what a function adds. */
    int legend_place;
    legend_sign sign;
    legend_worth worth;
    const char *text;
    void (*legend)(legend *l, const layer_source *in);

    /* Say what an element is about. Where this is null: boxes are of nodes, markers on points, by their ids; and so are
     * the markers of answers. */
    void (*describe)(description *d, const described *element);
} layer_type;

#define LAYER_TYPE_DECLARE(layer, ...) extern const layer_type layer_##layer;
LAYER_MAP(LAYER_TYPE_DECLARE)
#undef LAYER_TYPE_DECLARE

extern const layer_type *const layer_types[LAYER_COUNT + 1];

/* applies() of layers that only games have. */
bool layer_in_games(const layer_source *in);

bool layer_applies(const layer_source *in, view_layer layer);

/* The layer of the answers to queries of a kind has the kind's name. */
view_layer layer_of_query(octree_query_kind kind);

#endif
