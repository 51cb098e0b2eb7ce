/* SPDX-License-Identifier: MIT */
/* layer_type.h - the interface of a layer. Each layer has a row in layer.h and a file that defines its layer_type, such
 * as layer_RANGE. Scenes, the legend and `octreel pick` use a layer only through its layer_type. */
#ifndef LAYERS_LAYER_TYPE_H
#define LAYERS_LAYER_TYPE_H

#include "describe.h"
#include "layer.h"
#include "legend.h"
#include "pen.h"
#include "point_values.h"

#include "octree/octree.h"

/* The input of a scene: a tick of a game, or a tree without a game. */
typedef struct layer_source {
    const view *view; /* the view as the user requested it; with DIAGRAM_ONLY the scene's own view has fewer layers */
    const octree *tree;
    uint64_t state; /* a name of the state of `tree`, see kept_tree_begin_walk(); 0: unknown */
    octree_box world;
    const octree_answer *answers;
    size_t answer_count;
    const point_values *values; /* colours, classes and intensities of the points; null: no values */
    const char *broken;         /* the tree's broken invariant as a sentence; null: no invariant is broken */
    octree_address broken_at;

    const octree_game *game; /* the game; null: the scene shows a tree without a game */
    const octree_session *session;
    const octree_tick *tick;
    /* counts that the pictures of a tick share, see velocity_layer.h; null: each picture counts its arrows */
    struct arrow_counts *arrows;
    const heat *heat; /* visits and points of the nodes so far; null: the heat layers have no elements */

    const char *title; /* the title of the text column; only for a tree without a game */
    /* the node that the user asked to mark (octreel inspect --node), or 0; only for a tree without a game */
    octree_address requested;
} layer_source;

/* Returns the position of the player, or null if there is no player. A player that is a body need not exist in every
 * tick; see octree_tick.has_player for its position then. */
static inline const double *find_player(const layer_source *in)
{
    return in->game && in->session->player.kind != OCTREE_PLAYER_NONE ? in->tick->player : NULL;
}

/* Returns the depth of the tree's deepest node. Cost: O(1) in a game, which knows
 * the depth; O(nodes) for a tree without a game. */
static inline size_t find_depth_of_tree(const layer_source *in)
{
    octree_stats stats;
    return in->tick ? in->tick->stats.depth : octree_statistics(in->tree, &stats) == OCTREE_OK ? stats.depth : 0;
}

/* A layer's lines in the legend: either one line with `sign` and `text`, or the lines that add_lines() adds. */
typedef struct legend_entry {
    int order; /* position of the layer in the legend from below, 1 to LEGEND_LAST; 0: no lines */
    legend_sign sign;
    const char *text;
    legend_drop_order drop_order;
    void (*add_lines)(legend *l, const layer_source *in);
} legend_entry;

/* The functions and data of a layer. A layer that does not need a member leaves it null or 0. The argument `layer` is
 * the layer itself, because some files define several layers. */
typedef struct layer_type {
    /* Return whether the layer can have elements in this frame. A null `applies` means: always. */
    bool (*applies)(const layer_source *in);

    /* Return whether a session can have elements for the layer. Null means that every session can. If neither of two
     * compared sessions can, `octreel diff` does not report that only one of the recordings shows the layer. */
    bool (*in_session)(const octree_session *session);

    /* add() adds the layer's elements. add_answer() adds the elements of the answer with the index
     * `place`. These functions need not check
     * whether the view hides the layer: scene_add_*() drops the elements of hidden layers. */
    void (*add)(scene *s, const layer_source *in, view_layer layer);
    void (*add_answer)(scene *s, const layer_source *in, size_t place, view_layer layer);

    /* Write the row of an answer in the text column. */
    void (*write_answer)(pen *p, const octree_answer *answer);

    legend_entry legend;

    /* Describe an element. If `describe` is null, the element's id alone describes the element: the id of a box is a
     * node address, and the id of a marker is a point id. In a layer of answers the id of a marker is always a point
     * id. */
    void (*describe)(description *d, const described_element *element);
} layer_type;

#define LAYER_TYPE_DECLARE(layer, ...) extern const layer_type layer_##layer;
LAYER_MAP(LAYER_TYPE_DECLARE)
#undef LAYER_TYPE_DECLARE

extern const layer_type *const layer_types[LAYER_ALL];

/* Return whether the scene shows a game, not a tree without a game. For the member `applies` of a layer_type. */
bool is_game_scene(const layer_source *in);

/* Return the layer that shows the answers of a query kind. */
view_layer layer_of_query(octree_query_kind kind);

#endif
