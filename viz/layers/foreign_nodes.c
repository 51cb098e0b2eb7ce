/* SPDX-License-Identifier: MIT */
/* foreign_nodes.c - draws the nodes of a foreign index in the same way as the nodes of Octreel's own tree.
 *
 * A foreign index passes its nodes as a list of boxes with ids, parents and kinds. The index may be a k-d tree, an
 * R-tree or any other tree. So this file does not rely on addresses, on a leaf capacity, or on boxes that lie inside
 * their parents' boxes.
 *
 * Filter and lod test one node at a time. The budget works by whole levels, as for Octreel's own nodes: a level of
 * which only a part is drawn would look like a tree with holes. A first pass counts the nodes at each depth that pass
 * filter and lod. A second pass draws the levels from the root down, as many as fit into the budget together. Each pass
 * is O(nodes).
 *
 * The element id of a foreign node is the node's own id with bit 62 set. In an address of Octreel, bit 62 is never the
 * highest set bit (foreign_nodes.h), so `octreel pick` can distinguish the two trees. */
#include "foreign_nodes.h"
#include "node_boxes.h"
#include "text.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

bool shows_octreel_nodes(const layer_source *in)
{
    const view_tree tree = in->view->tree;
    return tree == TREE_OWN || tree == TREE_BOTH || (tree == TREE_AUTO && !(in->tick && in->tick->foreign.given));
}

bool shows_foreign_nodes(const layer_source *in)
{
    return in->tick && in->tick->foreign.given && in->view->tree != TREE_OWN;
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

static theme_role choose_foreign_role(const view *v, const octree_foreign_place *place)
{
    return v->coloring == COLORING_KIND ? theme_node_kind_role(place->kind)
                                        : node_role(v, (node_traits){.depth = place->depth, .points = place->points});
}

/* Return the depth of a node as scene_box stores it: at most 255. */
static unsigned clamped_depth(const octree_foreign_place *place)
{
    return place->depth < UINT8_MAX ? place->depth : UINT8_MAX;
}

static void add_box(scene *s, const octree_foreign_place *place, scene_style style)
{
    const uint64_t id = foreign_element_id(place->node->id);
    scene_add_box(s, (scene_box){id, style, (uint8_t)clamped_depth(place), place->node->box});
}

static bool passes_filter(const scene *s, const octree_foreign_place *place)
{
    return filter_shows_box(&s->view.filter, &place->node->box, place->depth, place->leaf);
}

/* Return whether a node is smaller than the view's lod and has an ancestor that the view may show. */
static bool is_below_lod(const scene *s, const octree_foreign_place *place)
{
    return place->parent != SIZE_MAX && is_left_out_by_lod(s, &place->node->box, place->depth);
}

/* ---- All nodes ---------------------------------------------------------------------------------------------- */

/* Return the deepest level that fits into the budget together with all levels above it. Return -1 if not even the root
 * level fits. */
static int find_deepest_level_in_budget(scene *s, const octree_foreign_state *foreign)
{
    size_t at_level[UINT8_MAX + 1] = {0}, sum = 0;
    int level = 0;
    for (size_t i = 0; i < foreign->node_count; i++)
        if (passes_filter(s, &foreign->nodes[i]) && !is_below_lod(s, &foreign->nodes[i]))
            at_level[clamped_depth(&foreign->nodes[i])]++;
    while (level <= UINT8_MAX && (!s->view.budget || (sum += at_level[level]) <= s->view.budget))
        level++;
    return level - 1;
}

void add_foreign_nodes(scene *s, const layer_source *in)
{
    const octree_foreign_state *foreign = &in->tick->foreign;
    if (!view_shows_layer(&s->view, LAYER_NODES))
        return;
    const int deepest = find_deepest_level_in_budget(s, foreign);
    const size_t beyond = s->tally.beyond;
    for (size_t i = 0; i < foreign->node_count; i++) {
        const octree_foreign_place *place = &foreign->nodes[i];
        if (!passes_filter(s, place))
            continue;
        const bool small = is_below_lod(s, place), out = !small && (int)clamped_depth(place) > deepest;
        s->tally.small += small;
        s->tally.beyond += out;
        if (small || out)
            continue;
        add_box(s, place, make_role_style(LAYER_NODES, choose_foreign_role(&s->view, place), STROKE_SOLID, 1));
        s->tally.nodes++;
    }
    if (s->tally.beyond > beyond)
        s->tally.deepest = deepest;
}

/* ---- Visited nodes ------------------------------------------------------------------------------------------- */

/* Return whether the layer `layer` shows a node. If one query pruned the node and another query visited it, only the
 * layer of visited nodes shows the node. */
static bool is_shown_by_layer(const octree_foreign_place *place, unsigned layer)
{
    const unsigned visited = 1u << OCTREE_NODE_VISITED, pruned = 1u << OCTREE_NODE_PRUNED, hit = 1u << OCTREE_NODE_HIT;
    if (layer == LAYER_PRUNED)
        return (place->visits & pruned) && !(place->visits & visited);
    return place->visits & (layer == LAYER_VISITED ? visited : hit);
}

void add_visited_foreign_nodes(scene *s, const layer_source *in, scene_style style)
{
    const octree_foreign_state *foreign = &in->tick->foreign;
    for (size_t i = 0; i < foreign->node_count; i++) {
        const octree_foreign_place *place = &foreign->nodes[i];
        if (!is_shown_by_layer(place, style.layer) || !passes_filter(s, place))
            continue;
        const bool small = is_below_lod(s, place);
        s->tally.small_marked += small;
        if (style.layer != LAYER_HIT)
            style.role = (uint8_t)choose_foreign_role(&s->view, place);
        if (!small)
            add_box(s, place, style);
    }
}

/* ---- Wrong nodes --------------------------------------------------------------------------------------------- */

/* The marker of a point that no foreign node lists has both of these bits set in its id. No other element of this layer
 * has both. */
#define LOST_ELEMENT (FOREIGN_ELEMENT | UINT64_C(1) << 61)
/* Half the size of the marker of a point that no foreign node lists, in halves of a picture unit. */
#define LOST_MARK 6

wrong_marks find_marks_of_wrong_nodes(const layer_source *in)
{
    const octree_foreign_state *foreign = &in->tick->foreign;
    wrong_marks marks = {.count = 0};
    if (!shows_foreign_nodes(in))
        return marks;
    for (size_t i = 0; i < foreign->node_count && marks.count < OCTREE_LISTED_WRONG_NODES; i++) {
        const octree_foreign_place *node = &foreign->nodes[i];
        octree_wrong_node_kind kind = 0;
        while (node->wrong && !(node->wrong >> kind & 1))
            kind++;
        const double *at = node->node->box.max;
        if (node->wrong)
            marks.items[marks.count++] =
                (wrong_mark){foreign_element_id(node->node->id), node, kind, {at[0], at[1], at[2]}};
    }
    for (size_t i = 0; i < foreign->listed_count; i++) {
        octree_point point;
        const double *at = point.position;
        if (foreign->listed[i].kind == OCTREE_NODE_LOST_POINT &&
            octree_game_find(in->game, foreign->listed[i].point, &point))
            marks.items[marks.count++] =
                (wrong_mark){LOST_ELEMENT | point.id, NULL, OCTREE_NODE_LOST_POINT, {at[0], at[1], at[2]}};
    }
    return marks;
}

void mark_wrong_foreign_nodes(scene *s, const wrong_marks *marks, text_space *occupied)
{
    for (size_t i = 0; i < marks->count; i++) {
        if (marks->items[i].node) {
            add_box(s, marks->items[i].node, make_layer_style(LAYER_WRONG, STROKE_DASHED, 2));
            continue;
        }
        scene_add_mark(s, marks->items[i].id, marks->items[i].at, SHAPE_CROSS,
                       make_layer_style(LAYER_WRONG, STROKE_SOLID, LOST_MARK));
        text_space_reserve_mark(occupied, s, marks->items[i].at, LOST_MARK);
    }
}

size_t label_wrong_foreign_nodes(scene *s, const wrong_marks *marks, text_space *occupied)
{
    static const char *const words[OCTREE_WRONG_NODE_KINDS] = {
        [OCTREE_NODE_OUTSIDE_PARENT] = "outside parent", [OCTREE_NODE_UNKNOWN_POINT] = "unknown point",
        [OCTREE_NODE_OUTSIDE_POINT] = "point outside",   [OCTREE_NODE_REPEATED_POINT] = "point twice",
        [OCTREE_NODE_LOST_POINT] = "in no node",         [OCTREE_NODE_UNKNOWN_NODE] = "",
        [OCTREE_NODE_PRUNED_POINT] = "wrongly pruned"};
    const scene_style style = make_layer_style(LAYER_WRONG, STROKE_SOLID, 1);
    size_t left_out = 0;
    for (size_t i = 0; i < marks->count; i++)
        left_out += !text_space_add_label_beside(
            occupied, s, scene_make_label(marks->items[i].id, style, "%s", words[marks->items[i].kind]),
            marks->items[i].at, LOST_MARK);
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

void describe_foreign_node(description *d, const char *before, uint64_t element)
{
    const octree_foreign_place *place = find_foreign_node(&d->tick->foreign, foreign_node_id(element));
    append_text(d, "%sforeign node %" PRIu64, before, foreign_node_id(element));
    if (!place)
        return;
    const octree_foreign_node *node = place->node;
    d->subject->foreign = place;
    append_text(d, ": %s at depth %u", place->leaf ? "leaf" : "inner node", place->depth);
    if (node->kind[0])
        append_text(d, " of kind \"%s\"", node->kind);
    if (node->has_parent)
        append_text(d, " under node %" PRIu64, node->parent);
    append_text(d, ", %zu point%s listed", place->points, plural_ending(place->points));
    append_box(d, ", box ", &node->box);
    for (int kind = 0; kind < OCTREE_WRONG_NODE_KINDS; kind++)
        if (place->wrong >> kind & 1)
            append_text(d, "; wrong: %s", octree_wrong_node_words((octree_wrong_node_kind)kind));
}

void describe_wrong_foreign_node(description *d, const described_element *element)
{
    octree_point point = {.id = element->id & ~LOST_ELEMENT};
    const char *before = element->kind == SCENE_PANEL   ? "the background of the text about "
                         : element->kind == SCENE_LABEL ? " on "
                                                        : "";
    if ((element->id & LOST_ELEMENT) != LOST_ELEMENT) {
        describe_foreign_node(d, before, element->id);
        return;
    }
    octree_game_find(d->game, point.id, &point);
    describe_point(d, before, point.id, point.position);
    append_text(d, ", which is in no foreign node");
}

const char *wrong_node_text(const octree_foreign_state *foreign, char text[WRONG_NODE_TEXT])
{
    const octree_wrong_node *first = foreign->listed;
    char node[32] = "", point[32] = "";
    *text = 0;
    if (foreign->listed_count == 0)
        return text;
    snprintf(node, sizeof node, "node %" PRIu64 ": ", first->node);
    snprintf(point, sizeof point, " (%" PRIu64 ")", first->point);
    const bool has_node = first->kind != OCTREE_NODE_LOST_POINT;
    const bool has_point = first->kind != OCTREE_NODE_OUTSIDE_PARENT && first->kind != OCTREE_NODE_UNKNOWN_NODE;
    snprintf(text, WRONG_NODE_TEXT, "%s%s%s", has_node ? node : "", octree_wrong_node_words(first->kind),
             has_point ? point : "");
    return text;
}
