/* SPDX-License-Identifier: MIT */
/* node_layers.c - the layers of a tree's nodes and points, within the view's filter, lod and budget.
 */
#include "filter.h"
#include "foreign_nodes.h"
#include "kept_tree.h"
#include "layer_type.h"
#include "layout.h"
#include "node_boxes.h"
#include "octree/octree.h"
#include "point_colors.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FEW_POINTS 32 /* of a leaf: sorted on the stack */

/* The context of the walk over the nodes. */
typedef struct tree_walk {
    scene *scene;
    octree_box world;
    const point_values *values;
    uint8_t point_width;
    size_t capacity;
    bool shows_nodes;                      /* of Octreel's tree; its points are shown with or without them */
    view_filter filter;                    /* of points */
    size_t at_depth[OCTREE_MAX_DEPTH + 1]; /* boxes in the scene */
    int deepest;                           /* boxes below are beyond the budget */
    uint64_t sieve;                        /* points whose digest has one of these bits are beyond the budget */
    bool drawn[OCTREE_MAX_DEPTH +
               2]; /* by depth + 1, on the way from the root: whether a box up to that depth is drawn */
    bool small[OCTREE_MAX_DEPTH + 2]; /* and whether one is smaller than the view's lod */
    kept_tree *kept;                  /* null: nothing is kept */
    size_t looser_count;              /* points that a sieve with a bit less keeps, where subtrees are kept */
    bool keeping_failed;              /* there was no memory to keep them */
} tree_walk;

static void stop_keeping(tree_walk *w)
{
    if (w->kept)
        kept_tree_clear(w->kept);
    w->kept = NULL;
}

/* ---- Points ------------------------------------------------------------------------------------------------- */

/* Remove about every other point from the scene. */
static void thin_points(tree_walk *w)
{
    scene *s = w->scene;
    size_t kept = 0;
    stop_keeping(w);
    w->sieve = finer_sieve(w->sieve);
    for (size_t i = 0; i < s->markers.count; i++) {
        const scene_marker *marker = &s->markers.items[i];
        const bool out = marker->style.layer == LAYER_POINTS && sieve_drops(w->sieve, marker->id);
        s->tally.points -= out;
        s->tally.thinned += out;
        if (!out)
            s->markers.items[kept++] = *marker;
    }
    s->markers.count = kept;
}

static void thin_points_to_budget(tree_walk *w)
{
    const scene *s = w->scene;
    while (s->view.budget && s->tally.points > s->view.budget && w->sieve != UINT64_MAX)
        thin_points(w);
}

/* Whether a point is shown, by the filter and the budget. */
static bool select_point(tree_walk *w, const octree_point *point)
{
    if (!filter_shows_point(&w->scene->view.filter, point->position))
        return false;
    const bool out = sieve_drops(w->sieve, point->id);
    w->scene->tally.thinned += out;
    if (w->kept) {
        w->kept->open.thinned += out;
        w->kept->open.looser += !sieve_drops(w->sieve >> 1, point->id);
    }
    return !out;
}

/* Points are often in order already. Else insertion sort where there are few. */
static void sort_points(octree_point *points, size_t count)
{
    size_t sorted = 1;
    while (sorted < count && octree_compare_points(&points[sorted - 1], &points[sorted]) <= 0)
        sorted++;
    if (sorted < count && count > FEW_POINTS) {
        qsort(points, count, sizeof *points, octree_compare_points);
        return;
    }
    for (size_t i = sorted; i < count; i++) {
        const octree_point it = points[i];
        size_t at = i;
        for (; at > 0 && octree_compare_points(&points[at - 1], &it) > 0; at--)
            points[at] = points[at - 1];
        points[at] = it;
    }
}

/* A leaf's points come in no defined order: they are sorted, so that a scene does not depend on the tree's history. */
static void add_points(tree_walk *w, const octree_node *leaf)
{
    scene *s = w->scene;
    octree_point few[FEW_POINTS], *some = leaf->count <= FEW_POINTS ? few : malloc(leaf->count * sizeof *some);
    size_t count = 0;
    s->out_of_memory = s->out_of_memory || !some;
    for (size_t i = 0; some && i < leaf->count; i++)
        if (select_point(w, &leaf->points[i]))
            some[count++] = leaf->points[i];
    sort_points(some, count);
    scene_style style = layer_style(LAYER_POINTS, STROKE_SOLID, w->point_width);
    style.role = view_paints_points(&s->view) ? ROLE_OWN : style.role;
    const size_t before = s->markers.count;
    scene_add_points(s, some, count, SHAPE_SQUARE, style);
    if (style.role == ROLE_OWN)
        color_points(&s->view, w->values, leaf, s->markers.items + before, s->markers.count - before);
    s->tally.points += count;
    thin_points_to_budget(w);
    if (some != few)
        free(some);
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

/* Remove the deepest level from the scene, so that only whole levels are shown. */
static void drop_level(tree_walk *w)
{
    scene *s = w->scene;
    while (w->deepest > 0 && w->at_depth[w->deepest] == 0)
        w->deepest--;
    size_t kept = 0;
    for (size_t i = 0; i < s->boxes.count; i++) {
        const scene_box *box = &s->boxes.items[i];
        if (box->style.layer != LAYER_NODES || box->depth != w->deepest)
            s->boxes.items[kept++] = *box;
    }
    s->boxes.count = kept;
    if (w->kept)
        kept_tree_forget_runs(w->kept);
    s->tally.nodes -= w->at_depth[w->deepest];
    s->tally.beyond += w->at_depth[w->deepest];
    w->at_depth[w->deepest--] = 0;
}

static scene_box make_node_box(const tree_walk *w, const octree_node *node)
{
    const node_traits look = {node->depth, node->count, w->capacity, node->leaf};
    const scene_style style = {.layer = LAYER_NODES, .role = (uint8_t)node_role(&w->scene->view, look), .width = 1};
    return (scene_box){.id = node->address, .box = node->box, .style = style, .depth = (uint8_t)node->depth};
}

static void add_box(tree_walk *w, const scene_box *box)
{
    scene *s = w->scene;
    if ((int)box->depth > w->deepest) {
        s->tally.beyond++;
        return;
    }
    scene_add_box(s, *box);
    w->at_depth[box->depth]++;
    s->tally.nodes++;
    while (s->view.budget && s->tally.nodes > s->view.budget)
        drop_level(w);
}

/* Boxes inside a small box are small too, and need not be measured. */
static bool is_small(const tree_walk *w, const scene_box *box)
{
    const scene *s = w->scene;
    return w->small[box->depth] || (s->view.lod > 0 && camera_box_is_below(&s->camera, &box->box, s->view.lod));
}

/* Whether a node that the filter shows is shown, and all below it may be. */
static bool show_box(tree_walk *w, const scene_box *box, bool by_filter)
{
    const unsigned depth = box->depth;
    const bool under_drawn = w->drawn[depth], small = is_small(w, box), out = by_filter && small && under_drawn;
    w->small[depth + 1] = small;
    w->drawn[depth + 1] = under_drawn || (by_filter && !out);
    if (by_filter && !out)
        add_box(w, box);
    return !out;
}

static void show_node(tree_walk *w, const octree_node *node)
{
    scene *s = w->scene;
    const scene_box box = make_node_box(w, node);
    s->tally.small += !show_box(w, &box, filter_shows_node(&s->view.filter, &w->world, node));
    w->keeping_failed = w->keeping_failed || (w->kept && !kept_tree_add_node(w->kept, &box));
}

/* ---- Kept subtrees ------------------------------------------------------------------------------------------ */

/* All below a node that is left out is left out too: no filter is on. */
static void add_kept_subtree(tree_walk *w, const kept_subtree *kept)
{
    scene *s = w->scene;
    const size_t first_marker = s->markers.count, first_box = s->boxes.count;
    digest_run run = {.power = 1};
    scene_add_markers(s, kept->markers, kept->marker_count);
    if (s->markers.count - first_marker == kept->run.end)
        kept_tree_add_run(&w->kept->marker_runs, first_marker, kept->run);
    s->tally.points += kept->marker_count;
    s->tally.thinned += kept->thinned;
    w->looser_count += kept->looser;
    for (uint32_t i = 0; i < kept->node_count;) {
        const kept_node *node = &kept->nodes[i];
        const bool shown = show_box(w, &node->box, true);
        s->tally.small += shown ? 0 : node->count;
        i += shown ? 1 : node->count;
        run.sum = shown ? run.sum * DIGEST_BASE + node->digest : run.sum;
        run.power *= shown ? DIGEST_BASE : 1;
        run.end += shown;
    }
    if (s->boxes.count - first_box == run.end)
        kept_tree_add_run(&w->kept->box_runs, first_box, run);
    thin_points_to_budget(w);
}

static void close_kept_subtree(tree_walk *w)
{
    if (!w->kept || !w->kept->open.address)
        return;
    w->looser_count += w->kept->open.looser;
    w->keeping_failed = w->keeping_failed || !kept_tree_close(w->kept, w->scene);
}

/* Whether a subtree was added as it was kept. Else it is collected, where it is not a part of another. */
static bool reuse_kept_subtree(tree_walk *w, const octree_node *node)
{
    if (kept_tree_collects(w->kept, node))
        return false;
    close_kept_subtree(w);
    if (node->count > KEPT_POINTS && !node->leaf)
        return false;
    const kept_subtree *found = kept_tree_find(w->kept, node->address);
    if (found)
        add_kept_subtree(w, found);
    else
        kept_tree_open(w->kept, node->address, w->scene);
    return found != NULL;
}

/* ---- The walk ----------------------------------------------------------------------------------------------- */

static octree_walk_order add_node(const octree_node *node, void *context)
{
    tree_walk *w = context;
    scene *s = w->scene;
    if (!filter_enters(&w->filter, &w->world, node) || (w->kept && reuse_kept_subtree(w, node)))
        return OCTREE_WALK_SKIP;
    if (w->shows_nodes)
        show_node(w, node);
    if (node->leaf && node->count && view_shows(&s->view, LAYER_POINTS) &&
        filter_shows_points_of(&w->filter, &w->world, node))
        add_points(w, node);
    return s->out_of_memory || w->keeping_failed ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

/* What is kept from tick to tick: where the whole tree is shown, and each point as it is alone. */
static kept_tree *get_kept_tree(const tree_walk *w, const layer_source *in)
{
    scene *s = w->scene;
    if (!in->game || in->values || filter_is_on(&w->filter) || view_paints_points(&s->view) || !shows_own_tree(in) ||
        shows_foreign_tree(in) || (!s->kept && octree_count(in->tree) < KEPT_FEWEST))
        return NULL;
    s->kept = s->kept ? s->kept : calloc(1, sizeof *s->kept);
    return s->kept;
}

static bool begin_kept_tree(tree_walk *w, const octree *tree, kept_tree *kept)
{
    const view *v = &w->scene->view;
    const kept_look look = {.coloring = v->coloring,
                            .boxes = w->shows_nodes,
                            .points = view_shows(v, LAYER_POINTS),
                            .capacity = w->capacity,
                            .point_width = w->point_width};
    if (!kept || !kept_tree_begin(kept, tree, &look))
        return false;
    w->kept = kept;
    w->sieve = kept->sieve;
    return true;
}

/* With the sieve of the last tick, unless a looser one would do now. False when it has to be done unchanged. */
static bool walk_with_kept_tree(tree_walk *w, const octree *tree)
{
    octree_walk(tree, add_node, w);
    close_kept_subtree(w);
    if (w->kept)
        kept_tree_end(w->kept);
    return !w->keeping_failed && (!w->kept || w->sieve == 0 || w->looser_count > w->scene->view.budget);
}

static void walk_tree(tree_walk *w, const layer_source *in)
{
    scene *s = w->scene;
    const tree_walk unchanged = *w;
    const scene before = *s;
    kept_tree *kept = get_kept_tree(w, in);
    if (!begin_kept_tree(w, in->tree, kept)) {
        octree_walk(in->tree, add_node, w);
    } else if (!walk_with_kept_tree(w, in->tree)) {
        stop_keeping(w);
        *w = unchanged;
        s->boxes.count = before.boxes.count;
        s->markers.count = before.markers.count;
        s->tally = before.tally;
        octree_walk(in->tree, add_node, w);
    }
    if (kept)
        kept->sieve = w->sieve;
}

/* ---- Labels ------------------------------------------------------------------------------------------------- */

/* Write the path of a node, or the id of a program's, into the middle of its box, if it fits into the box on screen, so
 * that it is clear whose it is, and covers no other. */
static bool add_label(scene *s, text_space *words, const scene_box *box)
{
    scene_label label = {.id = box->id, .style = {.layer = LAYER_NODES, .role = ROLE_TEXT, .width = 1}};
    char text[OCTREE_ADDRESS_TEXT];
    double middle[3], pixel[2];
    scene_box_middle(&box->box, middle);
    if (is_foreign_element(box->id))
        snprintf(text, sizeof text, "%" PRIu64, foreign_node_of(box->id));
    else
        octree_address_format(box->id, text);
    snprintf(label.text, sizeof label.text, "%s", text);
    const double width = (double)(strlen(label.text) + 1) * s->text.width;
    if (!camera_pixel(&s->camera, middle, pixel) || camera_box_pixels(&s->camera, &box->box) < width ||
        !text_space_take(words, s, label.text, pixel, label.at))
        return false;
    text_add_on_ground(s, &label, ROLE_PANEL);
    return true;
}

/* Shallow nodes first, then by address. */
static void add_labels(scene *s)
{
    text_space words = text_space_of(s); /* the axes' numbers */
    unsigned deepest = 0;
    for (size_t i = 0; i < s->boxes.count; i++)
        if (s->boxes.items[i].style.layer == LAYER_NODES && s->boxes.items[i].depth > deepest)
            deepest = s->boxes.items[i].depth;
    for (unsigned depth = 0; depth <= deepest; depth++)
        for (size_t i = 0; i < s->boxes.count; i++)
            if (s->boxes.items[i].style.layer == LAYER_NODES && s->boxes.items[i].depth == depth)
                s->tally.labels += add_label(s, &words, &s->boxes.items[i]);
}

/* ---- The layers --------------------------------------------------------------------------------------------- */

/* How much farther from each other points are of which one in so many is kept. They are kept at random, which leaves
 * gaps that are wider than those of a scan. */
static double thinned_spacing(uint64_t one_in)
{
    return one_in > 1 ? 1.3 * sqrt((double)one_in) : 1;
}

/* Both layers in one walk. Points are drawn smaller where there are many: for a game by the session's number, so that
 * it does not change from tick to tick. */
static void add(scene *s, const layer_source *in, view_layer own)
{
    const size_t expected = in->game ? in->session->body_count : octree_count(in->tree);
    tree_walk w = {.scene = s, .world = in->world, .values = in->values, .deepest = OCTREE_MAX_DEPTH};
    w.capacity = octree_definition(in->tree).leaf_capacity;
    w.point_width = expected <= 500 ? 2 : expected <= 20000 ? 1 : 0;
    w.shows_nodes = view_shows(&s->view, LAYER_NODES) && shows_own_tree(in);
    w.filter = s->view.filter;
    if (!shows_own_tree(in))
        w.filter.by_depth = false; /* which are those of the other tree */
    walk_tree(&w, in);
    s->tally.deepest = w.deepest;
    if (shows_foreign_tree(in))
        add_foreign_nodes(s, in);
    s->tally.one_in = w.sieve + 1;
    s->spacing = view_paints_points(&s->view) ? s->view.point_scale.of.spacing * thinned_spacing(s->tally.one_in) : 0;
    if (s->view.labels && view_shows(&s->view, own))
        add_labels(s);
}

/* A line for each kind that has a colour; Octreel's nodes have none. */
static void add_kinds_legend(legend *l, const layer_source *in)
{
    const size_t count = shows_foreign_tree(in) ? in->tick->foreign.kind_count : 0;
    const size_t own = count > THEME_NODE_KINDS ? THEME_NODE_KINDS - 1 : count;
    if (shows_own_tree(in))
        legend_add(l, SIGN_BOLD, "node");
    for (size_t i = 0; i < own; i++)
        legend_add(l, SIGN_BOLD, "node: %s", in->tick->foreign.kinds[i][0] ? in->tick->foreign.kinds[i] : "no kind")
            ->role = theme_node_kind_role((unsigned)i);
    if (count > own)
        legend_add(l, SIGN_BOLD, "node: any other kind")->role = theme_node_kind_role((unsigned)own);
}

/* A program's tree has no capacity, and so another scale. */
static void add_occupancy_legend(legend *l, const layer_source *in)
{
    const view *v = &l->scene->view;
    const bool diagram = view_shows(v, LAYER_DIAGRAM);
    if (shows_own_tree(in) || diagram)
        legend_add(l, SIGN_RAMP, "leaves, 0-%zu+ points", octree_definition(in->tree).leaf_capacity)->steps =
            THEME_NODE_DEPTHS;
    if ((shows_own_tree(in) && !v->filter.leaves) || diagram)
        legend_add(l, SIGN_BOLD, "inner node")->role = ROLE_WORLD;
    if (shows_foreign_tree(in))
        legend_add(l, SIGN_RAMP, "program's, 0-%u+ points", THEME_MOST_POINTS)->steps = THEME_NODE_DEPTHS;
}

static void add_legend(legend *l, const layer_source *in)
{
    const size_t deepest = shows_foreign_tree(in) ? OCTREE_MAX_DEPTH : octree_definition(in->tree).max_depth;
    if (l->scene->view.coloring == COLORING_KIND)
        add_kinds_legend(l, in);
    else if (l->scene->view.coloring == COLORING_DEPTH)
        legend_add_depths(l, "nodes, depth", deepest);
    else if (l->scene->view.coloring == COLORING_OCCUPANCY)
        add_occupancy_legend(l, in);
    else
        legend_add(l, SIGN_BOLD, "node");
}

static void describe(description *d, const described_element *element)
{
    if (element->kind == SCENE_PANEL)
        append_text(d, "the background of the address of ");
    else if (element->kind == SCENE_LABEL)
        append_text(d, " on ");
    if (is_foreign_element(element->id))
        describe_foreign_node(d, element->id);
    else
        describe_node(d, element->id);
}

const layer_type layer_NODES = {.add = add, .legend_place = 50, .legend = add_legend, .describe = describe};

const layer_type layer_POINTS = {.legend_place = 30, .legend = add_point_legend, .worth = DROP_EARLY};
