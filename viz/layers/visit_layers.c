/* SPDX-License-Identifier: MIT */
/* visit_layers.c - the layers of the nodes that a tick's queries pruned, visited, or found points in. */
#include "foreign_nodes.h"
#include "layer_type.h"
#include "octree/octree.h"
#include "text.h"
#include "node_boxes.h"

#include <stdio.h>
#include <string.h>

static bool is_pruned(const octree_visit *visit)
{
    return visit->touch == OCTREE_TRACE_PRUNED;
}

/* Add the visited or pruned nodes of Octreel's tree. A node keeps the colour that it has in the layer of nodes; visited
 * nodes are bold, pruned nodes dashed. */
static void add_own_visits(scene *s, const layer_source *in, view_layer own)
{
    const bool pruned = own == LAYER_PRUNED;
    scene_style style = layer_style(own, pruned ? STROKE_CUT : STROKE_SOLID, pruned ? 1 : 2);
    const size_t capacity = octree_definition(in->tree).leaf_capacity;
    octree_node node;
    for (size_t i = 0; view_shows(&s->view, own) && i < in->tick->visit_count; i++) {
        const octree_visit *visit = &in->tick->visits[i];
        if (is_pruned(visit) != pruned || !find_shown_node(s, in->tree, visit->node, &node))
            continue;
        style.role = (uint8_t)node_role(&s->view, (node_traits){node.depth, node.count, capacity, node.leaf});
        add_node_box(s, &node, style);
    }
}

static void add_visits(scene *s, const layer_source *in, view_layer own)
{
    if (shows_own_tree(in))
        add_own_visits(s, in, own);
    if (shows_foreign_tree(in))
        add_visited_foreign_nodes(s, in, own);
}

static void add_own_hit_leaves(scene *s, const layer_source *in, view_layer own)
{
    octree_node node;
    for (size_t i = 0; view_shows(&s->view, own) && i < in->tick->hit_leaf_count; i++)
        if (find_shown_node(s, in->tree, in->tick->hit_leaves[i], &node))
            add_node_box(s, &node, layer_style(own, STROKE_SOLID, 2));
}

static void add_hit_leaves(scene *s, const layer_source *in, view_layer own)
{
    if (shows_own_tree(in))
        add_own_hit_leaves(s, in, own);
    if (shows_foreign_tree(in))
        add_visited_foreign_nodes(s, in, own);
}

/* Return the number of nodes with this kind of visit, in the trees that the view shows. */
static size_t count_shown_visits(const layer_source *in, size_t own, octree_node_visit visit)
{
    return (shows_own_tree(in) ? own : 0) + (shows_foreign_tree(in) ? in->tick->foreign.visits[visit] : 0);
}

static void add_pruned_legend(legend *l, const layer_source *in)
{
    const size_t pruned = count_shown_visits(in, in->tick->touched[OCTREE_TRACE_PRUNED], OCTREE_NODE_PRUNED);
    legend_add(l, SIGN_DASHES, "%zu node%s pruned", pruned, plural(pruned));
}

/* Write the counts of visited nodes and of nodes taken whole (all their points accepted without comparison) into one
 * line, or into two if they do not fit. */
static void add_visited_legend(legend *l, const layer_source *in)
{
    const size_t taken = shows_own_tree(in) ? in->tick->touched[OCTREE_TRACE_TAKEN] : 0;
    const size_t visited = count_shown_visits(in, in->tick->touched[OCTREE_TRACE_VISITED], OCTREE_NODE_VISITED);
    char rest[SCENE_TEXT];
    legend_line *line = legend_add(l, SIGN_BOLD, "%zu node%s visited", visited, plural(visited));
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

static void describe(description *d, const described_element *element)
{
    const uint8_t layer = element->style.layer;
    if (is_foreign_element(element->id)) {
        describe_foreign_node(d, element->id);
        append_text(d, "; a query %s",
                    layer == LAYER_PRUNED    ? "pruned it"
                    : layer == LAYER_VISITED ? "visited it"
                                             : "hit it");
        return;
    }
    describe_node(d, element->id);
    append_text(d, layer == LAYER_PRUNED    ? "; this tick's queries pruned it"
                   : layer == LAYER_VISITED ? "; this tick's queries visited it"
                                            : "; it holds points that this tick's queries found");
}

const layer_type layer_PRUNED = {.applies = layer_in_games,
                                 .add = add_visits,
                                 .legend_place = 80,
                                 .legend = add_pruned_legend,
                                 .describe = describe};

const layer_type layer_VISITED = {.applies = layer_in_games,
                                  .add = add_visits,
                                  .legend_place = 70,
                                  .legend = add_visited_legend,
                                  .describe = describe};

const layer_type layer_HIT = {.applies = layer_in_games,
                              .add = add_hit_leaves,
                              .legend_place = 90,
                              .legend = add_hit_legend,
                              .describe = describe};
