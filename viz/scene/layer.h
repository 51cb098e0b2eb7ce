/* SPDX-License-Identifier: MIT */
/* layer.h - the layers of a scene, one row each.
 *
 * To add a layer, add:
 *   1. a row in LAYER_MAP below, in painter's order
 *   2. a file in viz/layers that defines its layer_type (layer_type.h)
 *   3. a test of this file in tests/viz/layers
 *   4. a row in the tables of test_describe.c, test_legend.c and test_picture.c (tests/viz)
 *   5. a row in tests/support/viz/golden_frames.c, with the layer's golden frame
 *   6. a row in test_view.c, if the layer is hidden by default
 * If the layer shows data that octree_tick does not have, add the data to octree_tick first. If the layer needs a new
 * colour, add a row to theme.h. If a recording's page is to plot a curve of the layer's data, add a line to CURVES in
 * viz/page/viewer/facts.js.
 */
#ifndef SCENE_LAYER_H
#define SCENE_LAYER_H

#include "query_looks.h"
#include "scene.h"

/* One row for each layer, in painter's order: later rows lie on top. The columns of a row: the layer's name; a phrase
 * for the layer in sentences; its description in --help; its main colour (theme.h); whether the layer fades with
 * distance as much as the tree does; whether the layer is shown by default. Scene digests hash the names. */
#define LAYER_MAP(X)                                                                                                   \
    X(WORLD, "world", "the world",                                                                                     \
      "the world's box, the slice and the region, axes with numbers, and in zoomed pictures a scale bar", ROLE_WORLD,  \
      true, true)                                                                                                      \
    X(NODES, "nodes", "nodes", "the boxes of the nodes", ROLE_NODE_PLAIN, true, true)                                  \
    X(VISIT_HEAT, "visit-heat", "heat", "leaves, by the number of ticks in which queries visited them", ROLE_NODE,     \
      false, false)                                                                                                    \
    X(POINT_HEAT, "point-heat", "heat", "leaves, by the number of their points, summed over all ticks", ROLE_NODE,     \
      false, false)                                                                                                    \
    X(PRUNED, "pruned", "pruned nodes", "nodes that the tick's queries pruned", ROLE_NODE_2, true, true)               \
    X(VISITED, "visited", "visited nodes", "nodes that the tick's queries visited, or took whole", ROLE_NODE_2, false, \
      true)                                                                                                            \
    X(HIT, "hit", "leaves with hits", "leaves with points that the queries found", ROLE_HIT, false, true)              \
    X(MERGES, "merges", "merges", "inner nodes that became leaves in the tick", ROLE_CHANGE, false, true)              \
    X(SPLITS, "splits", "splits", "leaves that split in the tick", ROLE_CHANGE, false, true)                           \
    X(POINTS, "points", "points", "the points in the tree", ROLE_POINT, true, true)                                    \
    X(BODIES, "bodies", "bodies", "the boxes of bodies with extent", ROLE_POINT, true, true)                           \
    X(VELOCITIES, "velocities", "velocities", "arrows that show where moving points will go", ROLE_FAINT, true, true)  \
    X(ASKED, "asked", "the node given by --node", "the node of inspect --node", ROLE_PLAYER, false, true)              \
    QUERY_LOOKS(QUERY_LAYER, X)                                                                                        \
    X(PLAYER, "player", "the player", "the player, and a line down to the floor", ROLE_PLAYER, false, true)            \
    X(BOX, "box", "the collision box", "the player's collision box, and the points in it", ROLE_COLLISION, false,      \
      true)                                                                                                            \
    X(PAIRS, "pairs", "overlaps", "where the boxes of two bodies overlap", ROLE_COLLISION, false, true)                \
    X(SHAPES, "shapes", "shapes",                                                                                      \
      "the session's shapes, which are not in the tree: boxes, segments, points and labels", ROLE_SHAPE, false, true)  \
    X(WRONG, "wrong", "wrong answers",                                                                                 \
      "wrong answers, nodes and pairs of a foreign index, and missing and extra points", ROLE_WRONG, false, true)      \
    X(BROKEN, "broken", "the broken node", "the node in which the validator finds a broken invariant", ROLE_WARNING,   \
      false, true)                                                                                                     \
    X(TEXT, "text", "text", "the text column, the caption, the legend and all labels", ROLE_TEXT, false, true)         \
    X(CLOSEUP, "closeup", "the close-up", "the frame of the close-up, and the part of the world that it shows",        \
      ROLE_FAINT, false, false)                                                                                        \
    X(DIAGRAM, "diagram", "the diagram", "the diagram of the tree, where view.diagram places it", ROLE_BACKGROUND,     \
      false, false)

typedef enum view_layer {
#define LAYER_ENUM(layer, ...) LAYER_##layer,
    LAYER_MAP(LAYER_ENUM)
#undef LAYER_ENUM
        LAYER_ALL,
    LAYER_COUNT = LAYER_CLOSEUP /* the number of layers that view.layers can select, one bit each */
} view_layer;

typedef struct layer_row {
    /* examples of name, words and help: "pruned", "pruned nodes", "nodes that the tick's queries pruned" */
    const char *name, *words, *help;
    uint8_t role; /* the layer's colour, a theme_role */
    bool fades;
} layer_row;

extern const layer_row layer_rows[LAYER_ALL];

#define VIEW_ALL_LAYERS ((1u << LAYER_COUNT) - 1)
#define VIEW_HEAT_LAYERS (1u << LAYER_VISIT_HEAT | 1u << LAYER_POINT_HEAT)

#define LAYER_DEFAULT_BIT(layer, name, words, help, role, fades, shown) | (shown ? 1u << LAYER_##layer : 0)
#define VIEW_DEFAULT_LAYERS ((0u LAYER_MAP(LAYER_DEFAULT_BIT)) & VIEW_ALL_LAYERS)

/* Parse a list of layer names separated by commas. The list may contain "all", "default" and "none". A name after "-",
 * as in "-text", removes a layer; a list that begins with "-" starts from the default layers. If a name is unknown,
 * returns false and sets *bad to this name. */
bool view_layers_parse(const char *list, unsigned *layers, const char **bad);

static inline bool view_shows_layer(const view *v, view_layer layer)
{
    return layer == LAYER_DIAGRAM   ? v->diagram != DIAGRAM_NONE
           : layer == LAYER_CLOSEUP ? v->closeup
                                    : v->layers >> layer & 1;
}

/* Return the style of an element. make_role_style() uses the colour of `role`, make_layer_style() the colour of the
 * layer. */
static inline scene_style make_role_style(view_layer layer, unsigned role, scene_stroke stroke, unsigned width)
{
    return (scene_style){(uint8_t)layer, (uint8_t)role, (uint8_t)stroke, (uint8_t)width};
}

static inline scene_style make_layer_style(view_layer layer, scene_stroke stroke, unsigned width)
{
    return make_role_style(layer, layer_rows[layer].role, stroke, width);
}

#endif
