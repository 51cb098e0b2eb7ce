/* SPDX-License-Identifier: MIT */
/* foreign_nodes.c - draws the nodes of a foreign index like the nodes of Octreel's own tree.
 *
 * A foreign index hands its nodes as a flat list of boxes with ids, parents and kinds. Its tree may be of any sort (a
 * k-d tree, an R-tree), so nothing here relies on addresses, on a capacity, or on boxes that nest.
 *
 * Filter and lod test one node at a time. The budget works by whole levels, as for Octreel's own nodes: one pass counts
 * the nodes at each depth that pass filter and lod, and a second pass draws the levels, from the root down, that fit
 * into the budget together. A level drawn in part would look like a tree with holes. Both passes are O(nodes).
 *
 * A node keeps its own id in its element id, with one bit set that no Octreel address has there (foreign_nodes.h), so
 * that `octreel pick` can tell the two trees apart. */
#include "foreign_nodes.h"
#include "node_boxes.h"
#include "text.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

bool shows_own_tree(const layer_source *in)
{
    const view_tree tree = in->view->tree;
    return tree == TREE_OWN || tree == TREE_BOTH || (tree == TREE_AUTO && !(in->tick && in->tick->foreign.given));
}

bool shows_foreign_tree(const layer_source *in)
{
    return in->tick && in->tick->foreign.given && in->view->tree != TREE_OWN;
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

static theme_role role_of(const view *v, const octree_foreign_place *place)
{
    return v->coloring == COLORING_KIND ? theme_node_kind_role(place->kind)
                                        : node_role(v, (node_traits){.depth = place->depth, .points = place->points});
}

/* The depth as scene_box stores it: at most 255. */
static unsigned clamped_depth(const octree_foreign_place *place)
{
    return place->depth < UINT8_MAX ? place->depth : UINT8_MAX;
}

static void add_box(scene *s, const octree_foreign_place *place, scene_style style)
{
    scene_add_box(s, (scene_box){.id = foreign_element(place->node->id),
                                 .box = place->node->box,
                                 .style = style,
                                 .depth = (uint8_t)clamped_depth(place)});
}

static bool passes_filter(const scene *s, const octree_foreign_place *place)
{
    return filter_shows_box(&s->view.filter, &place->node->box, place->depth, place->leaf);
}

/* Whether a node is smaller than the view's lod and has an ancestor that may be shown. */
static bool is_small(const scene *s, const octree_foreign_place *place)
{
    const view_filter *f = &s->view.filter;
    return s->view.lod > 0 && place->parent != SIZE_MAX && !f->leaves &&
           place->depth > (f->by_depth ? f->min_depth : 0) &&
           camera_box_is_below(&s->camera, &place->node->box, s->view.lod);
}

/* ---- All nodes ---------------------------------------------------------------------------------------------- */

/* Return the deepest level that fits into the budget together with all levels above it; -1 if the root level does not
 * fit. */
static int deepest_in_budget(scene *s, const octree_foreign_state *foreign)
{
    size_t at_level[UINT8_MAX + 1] = {0}, sum = 0;
    int level = 0;
    for (size_t i = 0; i < foreign->node_count; i++)
        if (passes_filter(s, &foreign->nodes[i]) && !is_small(s, &foreign->nodes[i]))
            at_level[clamped_depth(&foreign->nodes[i])]++;
    while (level <= UINT8_MAX && (!s->view.budget || (sum += at_level[level]) <= s->view.budget))
        level++;
    return level - 1;
}

void add_foreign_nodes(scene *s, const layer_source *in)
{
    const octree_foreign_state *foreign = &in->tick->foreign;
    if (!view_shows(&s->view, LAYER_NODES))
        return;
    const int deepest = deepest_in_budget(s, foreign);
    const size_t beyond = s->tally.beyond;
    for (size_t i = 0; i < foreign->node_count; i++) {
        const octree_foreign_place *place = &foreign->nodes[i];
        if (!passes_filter(s, place))
            continue;
        const bool small = is_small(s, place), out = !small && (int)clamped_depth(place) > deepest;
        s->tally.small += small;
        s->tally.beyond += out;
        if (small || out)
            continue;
        add_box(s, place, (scene_style){.layer = LAYER_NODES, .role = (uint8_t)role_of(&s->view, place), .width = 1});
        s->tally.nodes++;
    }
    if (s->tally.beyond > beyond)
        s->tally.deepest = deepest;
}

/* ---- Visits and faults --------------------------------------------------------------------------------------- */

/* Whether a layer shows a node. A node that one query pruned and another visited is in the layer of visited nodes
 * only. */
static bool matches_layer(const octree_foreign_place *place, view_layer layer)
{
    const unsigned visited = 1u << OCTREE_NODE_VISITED, pruned = 1u << OCTREE_NODE_PRUNED, hit = 1u << OCTREE_NODE_HIT;
    if (layer == LAYER_PRUNED)
        return (place->visits & pruned) && !(place->visits & visited);
    return place->visits & (layer == LAYER_VISITED ? visited : hit);
}

void add_visited_foreign_nodes(scene *s, const layer_source *in, view_layer own)
{
    const octree_foreign_state *foreign = &in->tick->foreign;
    const bool pruned = own == LAYER_PRUNED;
    scene_style style = layer_style(own, pruned ? STROKE_CUT : STROKE_SOLID, pruned ? 1 : 2);
    for (size_t i = 0; view_shows(&s->view, own) && i < foreign->node_count; i++) {
        const octree_foreign_place *place = &foreign->nodes[i];
        if (!matches_layer(place, own) || !passes_filter(s, place))
            continue;
        const bool small = is_small(s, place);
        s->tally.small_marked += small;
        if (own != LAYER_HIT)
            style.role = (uint8_t)role_of(&s->view, place);
        if (!small)
            add_box(s, place, style);
    }
}

/* Return the text that stands beside a fault's mark. */
static const char *short_fault_text(octree_wrong_node_kind kind)
{
    static const char *const words[OCTREE_WRONG_NODE_KINDS] = {
        [OCTREE_NODE_OUTSIDE_PARENT] = "outside parent", [OCTREE_NODE_UNKNOWN_POINT] = "unknown point",
        [OCTREE_NODE_OUTSIDE_POINT] = "point outside",   [OCTREE_NODE_REPEATED_POINT] = "point twice",
        [OCTREE_NODE_LOST_POINT] = "in no node",         [OCTREE_NODE_UNKNOWN_NODE] = "",
        [OCTREE_NODE_PRUNED_POINT] = "wrongly pruned"};
    return words[kind];
}

/* An element with both bits marks a point that no foreign node lists. No other element of the layer has both. */
#define LOST_ELEMENT (FOREIGN_ELEMENT | UINT64_C(1) << 61)
#define LOST_MARK 6 /* half the size of such a mark, in half units */

/* Return the index of the first wrong node at or after `place`; node_count when there is none, or when `marked` nodes
 * are already as many as the layer marks. */
static size_t next_wrong_node(const octree_foreign_state *foreign, size_t place, size_t marked)
{
    while (place < foreign->node_count && !foreign->nodes[place].wrong)
        place++;
    return marked < OCTREE_LISTED_WRONG_NODES ? place : foreign->node_count;
}

static bool find_lost_point(const layer_source *in, size_t listed, octree_point *point)
{
    const octree_wrong_node *fault = &in->tick->foreign.listed[listed];
    return fault->kind == OCTREE_NODE_LOST_POINT && octree_game_find(in->game, fault->point, point);
}

void mark_foreign_faults(scene *s, const layer_source *in, view_layer own, text_space *occupied)
{
    const octree_foreign_state *foreign = &in->tick->foreign;
    octree_point point;
    for (size_t i = next_wrong_node(foreign, 0, 0), marked = 1; i < foreign->node_count;
         i = next_wrong_node(foreign, i + 1, marked++))
        add_box(s, &foreign->nodes[i], layer_style(own, STROKE_DASHED, 2));
    for (size_t i = 0; i < foreign->listed_count; i++) {
        if (!find_lost_point(in, i, &point))
            continue;
        scene_add_mark(s, LOST_ELEMENT | point.id, point.position, SHAPE_CROSS,
                       layer_style(own, STROKE_SOLID, LOST_MARK));
        text_space_keep_mark(occupied, s, point.position, LOST_MARK);
    }
}

/* Write a fault's text beside its mark. Return false where there is no room. */
static bool add_fault_label(scene *s, uint64_t id, const double at[3], octree_wrong_node_kind kind, view_layer own,
                            text_space *occupied)
{
    scene_label label = {.id = id, .style = layer_style(own, STROKE_SOLID, 1)};
    snprintf(label.text, sizeof label.text, "%s", short_fault_text(kind));
    return text_add_beside(occupied, s, label, at, LOST_MARK);
}

size_t label_foreign_faults(scene *s, const layer_source *in, view_layer own, text_space *occupied)
{
    const octree_foreign_state *foreign = &in->tick->foreign;
    octree_point point;
    size_t left_out = 0;
    for (size_t i = next_wrong_node(foreign, 0, 0), marked = 1; i < foreign->node_count;
         i = next_wrong_node(foreign, i + 1, marked++)) {
        octree_wrong_node_kind kind = 0;
        while (!(foreign->nodes[i].wrong >> kind & 1))
            kind++;
        const octree_foreign_node *node = foreign->nodes[i].node;
        left_out += !add_fault_label(s, foreign_element(node->id), node->box.max, kind, own, occupied);
    }
    for (size_t i = 0; i < foreign->listed_count; i++)
        if (find_lost_point(in, i, &point))
            left_out +=
                !add_fault_label(s, LOST_ELEMENT | point.id, point.position, OCTREE_NODE_LOST_POINT, own, occupied);
    return left_out;
}

/* ---- Descriptions -------------------------------------------------------------------------------------------- */

static const octree_foreign_place *find_foreign_node(const octree_foreign_state *foreign, uint64_t id)
{
    for (size_t i = 0; i < foreign->node_count; i++)
        if (foreign->nodes[i].node->id == id)
            return &foreign->nodes[i];
    return NULL;
}

void describe_foreign_node(description *d, uint64_t element)
{
    const octree_foreign_place *place = find_foreign_node(&d->tick->foreign, foreign_node_of(element));
    append_text(d, "foreign node %" PRIu64, foreign_node_of(element));
    if (!place)
        return;
    const octree_foreign_node *node = place->node;
    d->subject->foreign = place;
    append_text(d, ": %s at depth %u", place->leaf ? "leaf" : "inner node", place->depth);
    if (node->kind[0])
        append_text(d, " of kind \"%s\"", node->kind);
    if (node->has_parent)
        append_text(d, " under node %" PRIu64, node->parent);
    append_text(d, ", %zu point%s listed, box ", place->points, plural(place->points));
    append_box(d, &node->box);
    for (int kind = 0; kind < OCTREE_WRONG_NODE_KINDS; kind++)
        if (place->wrong >> kind & 1)
            append_text(d, "; wrong: %s", octree_wrong_node_words((octree_wrong_node_kind)kind));
}

void describe_foreign_fault(description *d, const described_element *element)
{
    const uint64_t id = element->id & ~LOST_ELEMENT;
    octree_point point = {.id = id};
    if (element->kind == SCENE_LABEL || element->kind == SCENE_PANEL)
        append_text(d, element->kind == SCENE_PANEL ? "the background of the text about " : " on ");
    if ((element->id & LOST_ELEMENT) != LOST_ELEMENT) {
        describe_foreign_node(d, element->id);
        return;
    }
    octree_game_find(d->game, id, &point);
    describe_point(d, id, point.position);
    append_text(d, ", which is in no foreign node");
}

const char *foreign_fault_text(const octree_foreign_state *foreign, char text[FOREIGN_FAULT_TEXT])
{
    const octree_wrong_node *fault = foreign->listed;
    char node[32] = "", point[32] = "";
    *text = 0;
    if (foreign->listed_count == 0)
        return text;
    snprintf(node, sizeof node, "node %" PRIu64 ": ", fault->node);
    snprintf(point, sizeof point, " (%" PRIu64 ")", fault->point);
    const bool has_node = fault->kind != OCTREE_NODE_LOST_POINT;
    const bool has_point = fault->kind != OCTREE_NODE_OUTSIDE_PARENT && fault->kind != OCTREE_NODE_UNKNOWN_NODE;
    snprintf(text, FOREIGN_FAULT_TEXT, "%s%s%s", has_node ? node : "", octree_wrong_node_words(fault->kind),
             has_point ? point : "");
    return text;
}
