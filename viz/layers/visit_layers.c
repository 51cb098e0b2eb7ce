/* SPDX-License-Identifier: MIT */
/* visit_layers.c - the layers of the nodes that a tick's queries pruned or visited, and of the leaves in which the
 * queries found points. */
#include "foreign_nodes.h"
#include "layer_type.h"
#include "octree/octree.h"
#include "text.h"
#include "node_boxes.h"

#include <stdio.h>
#include <string.h>

/* Return the address of a node that `layer` shows: for the layer of hits, the i-th leaf in which a query found points;
 * for the other layers the i-th visit's node, or 0 if the layer does not show this kind of visit. */
static octree_address find_visited_node(const octree_tick *tick, view_layer layer, size_t i)
{
    if (layer == LAYER_HIT)
        return tick->hit_leaves[i];
    const bool pruned = tick->visits[i].touch == OCTREE_TRACE_PRUNED;
    return pruned == (layer == LAYER_PRUNED) ? tick->visits[i].node : 0;
}

/* Add the nodes of the layer `layer`. Visited and pruned nodes have the same colour as in the layer of nodes. Visited
 * nodes have bold lines, pruned nodes dashed lines. */
static void add_visits(scene *s, const layer_source *in, view_layer layer)
{
    const octree_tick *tick = in->tick;
    const size_t count = layer == LAYER_HIT ? tick->hit_leaf_count : tick->visit_count;
    const size_t capacity = octree_definition(in->tree).leaf_capacity;
    const bool pruned = layer == LAYER_PRUNED;
    scene_style style = make_layer_style(layer, pruned ? STROKE_CUT : STROKE_SOLID, pruned ? 1 : 2);
    octree_node node;
    if (!view_shows_layer(&s->view, layer))
        return;
    for (size_t i = 0; shows_octreel_nodes(in) && i < count; i++) {
        const octree_address address = find_visited_node(tick, layer, i);
        if (!address || !find_shown_node(s, in->tree, address, &node))
            continue;
        if (layer != LAYER_HIT)
            style.role = (uint8_t)node_role(&s->view, (node_traits){node.depth, node.count, capacity, node.leaf});
        add_node_box(s, &node, style);
    }
    if (shows_foreign_nodes(in))
        add_visited_foreign_nodes(s, in, style);
}

/* Return the number of nodes with a visit of the kind `visit` in the trees that the view shows. `octreel` is the number
 * of such nodes in Octreel's own tree. */
static size_t count_shown_visits(const layer_source *in, size_t octreel, octree_node_visit visit)
{
    return (shows_octreel_nodes(in) ? octreel : 0) + (shows_foreign_nodes(in) ? in->tick->foreign.visits[visit] : 0);
}

static void add_pruned_legend(legend *l, const layer_source *in)
{
    const size_t pruned = count_shown_visits(in, in->tick->touched[OCTREE_TRACE_PRUNED], OCTREE_NODE_PRUNED);
    legend_add(l, SIGN_DASHES, "%zu node%s pruned", pruned, plural_ending(pruned));
}

/* Add legend lines with the number of visited nodes and the number of nodes taken whole: nodes whose points a query
 * accepted without comparing them. The two numbers share a line if they fit. */
static void add_visited_legend(legend *l, const layer_source *in)
{
    const size_t taken = shows_octreel_nodes(in) ? in->tick->touched[OCTREE_TRACE_TAKEN] : 0;
    const size_t visited = count_shown_visits(in, in->tick->touched[OCTREE_TRACE_VISITED], OCTREE_NODE_VISITED);
    char rest[SCENE_TEXT];
    legend_line *line = legend_add(l, SIGN_BOLD, "%zu node%s visited", visited, plural_ending(visited));
    const int length = snprintf(rest, sizeof rest, "%zu taken whole", taken);
    if (taken && strlen(line->text) + strlen(", ") + (size_t)length > LEGEND_LETTERS)
        legend_add(l, SIGN_NONE, "%s", rest);
    else if (taken)
        strcat(strcat(line->text, ", "), rest);
}

static void add_hit_legend(legend *l, const layer_source *in)
{
    const size_t leaves = count_shown_visits(in, in->tick->hit_leaf_count, OCTREE_NODE_HIT);
    legend_add(l, SIGN_FRAME, "%zu %s hit", leaves, leaves == 1 ? "leaf" : "leaves");
}

static void describe_visit(description *d, const described_element *element)
{
    const uint8_t layer = element->style.layer;
    describe_node(d, "", element->id);
    append_text(d, layer == LAYER_PRUNED    ? "; this tick's queries pruned it"
                   : layer == LAYER_VISITED ? "; this tick's queries visited it"
                                            : "; it holds points that this tick's queries found");
}

const layer_type layer_PRUNED = {.applies = is_game_scene,
                                 .add = add_visits,
                                 .legend = {.order = 80, .add_lines = add_pruned_legend},
                                 .describe = describe_visit};

const layer_type layer_VISITED = {.applies = is_game_scene,
                                  .add = add_visits,
                                  .legend = {.order = 70, .add_lines = add_visited_legend},
                                  .describe = describe_visit};

const layer_type layer_HIT = {.applies = is_game_scene,
                              .add = add_visits,
                              .legend = {.order = 90, .add_lines = add_hit_legend},
                              .describe = describe_visit};
