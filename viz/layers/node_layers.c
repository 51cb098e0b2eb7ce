/* SPDX-License-Identifier: MIT */
/* node_layers.c - the layers of a tree's nodes and points, within the view's filter, lod and budget.
 *
 * One walk over the tree in pre-order adds both layers. Three rules limit the number of elements:
 *    - Filter: nodes and points that the view's filter hides are left out. Branches of the tree in which the filter
 *      shows no node are skipped.
 *    - Lod: a box that appears smaller than `lod` pixels is left out if the box of an ancestor is drawn. Boxes inside
 *      a small box are small too, so they are not measured.
 *    - Budget: at most `budget` boxes and at most `budget` points are added. Boxes are dropped by whole levels, the
 *      deepest first, because half a level would look like a tree with holes. Points are dropped by a sieve over a
 *      hash of their ids (node_boxes.h). Each finer sieve drops about half of the remaining points.
 *
 * Counting first and drawing afterwards would need two walks. Instead, the walk adds boxes and points until the budget
 * is exceeded. Then it removes the deepest level, or about every other point, from the scene, and continues without
 * that level or with that sieve. The result is the same, because levels and sieves are nested. The extra cost is at
 * most one pass over the scene for each of the 21 levels and for each bit of the sieve.
 *
 * Kept subtrees: in a large game most of the tree is the same as at the last tick, and all of it while only the camera
 * moves. kept_tree.h stores the boxes and markers of subtrees with few points. The walk copies an unchanged subtree
 * from the store and does not visit its nodes. The stored points were selected by the last picture's sieve, so the walk
 * starts with this sieve. If this picture needs a finer sieve, the store is emptied and the walk continues without it.
 * If a coarser sieve is enough, or memory runs out, the walk starts again without the store. The scene is always the
 * one that a walk without the store makes. */
#include "filter.h"
#include "foreign_nodes.h"
#include "kept_tree.h"
#include "layer_type.h"
#include "layout.h"
#include "node_boxes.h"
#include "point_names.h"
#include "octree/octree.h"
#include "point_colors.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FEW_POINTS 32 /* a leaf with at most this many points is sorted in an array on the stack, without malloc() */

/* The context of the walk over the nodes. */
typedef struct tree_walk {
    scene *scene;
    octree_box world;
    const point_values *values;
    uint8_t point_width;
    size_t capacity;
    /* True: Octreel's nodes are shown. If false, the nodes are hidden, but the points of Octreel's tree may still be
     * shown. */
    bool shows_nodes;
    view_filter filter;                    /* the filter that points must pass */
    size_t at_depth[OCTREE_MAX_DEPTH + 1]; /* at_depth[d]: number of boxes in the scene at depth d */
    int deepest;                           /* boxes deeper than this are beyond the budget */
    uint64_t sieve;                        /* points that this sieve drops are beyond the budget */
    /* On the path from the root to the current node: drawn[d + 1] is true if the box at depth d or the box of one of
     * its ancestors is drawn. */
    bool drawn[OCTREE_MAX_DEPTH + 2];
    bool small[OCTREE_MAX_DEPTH + 2]; /* small[d + 1]: the box at depth d on the path is smaller than the view's lod */
    kept_tree *kept;                  /* the store of unchanged subtrees; null: not in use */
    /* Number of points that a sieve with one bit fewer would keep; counted only if `kept` is not null. */
    size_t looser_count;
    bool keeping_failed; /* true: no memory for the store, so the walk must start again without the store */
} tree_walk;

static void abandon_kept_tree(tree_walk *w)
{
    if (w->kept)
        kept_tree_clear(w->kept);
    w->kept = NULL;
}

/* ---- Points ------------------------------------------------------------------------------------------------- */

/* Switch to the next finer sieve. Remove from the scene the points that this sieve drops, which are about half of the
 * points. */
static void thin_points_once(tree_walk *w)
{
    scene *s = w->scene;
    size_t kept = 0;
    abandon_kept_tree(w);
    w->sieve = make_finer_sieve(w->sieve);
    for (size_t i = 0; i < s->markers.count; i++) {
        const scene_marker *marker = &s->markers.items[i];
        const bool out = marker->style.layer == LAYER_POINTS && sieve_rejects_id(w->sieve, marker->id);
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
        thin_points_once(w);
}

/* Return whether filter and sieve keep a point. Also count the points that the sieve drops. */
static bool select_point(tree_walk *w, const octree_point *point)
{
    if (!filter_shows_point(&w->scene->view.filter, point->position))
        return false;
    const bool out = sieve_rejects_id(w->sieve, point->id);
    w->scene->tally.thinned += out;
    if (w->kept) {
        w->kept->open.thinned += out;
        w->kept->open.looser += !sieve_rejects_id(w->sieve >> 1, point->id);
    }
    return !out;
}

/* Sort points by octree_compare_points(). If the points are not already sorted, an insertion sort handles few points,
 * and qsort() many. */
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

/* Add the points of a leaf, sorted by id. The order in which a leaf stores its points depends on the tree's history,
 * and a scene must not depend on that history. */
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
    scene_style style = make_layer_style(LAYER_POINTS, STROKE_SOLID, w->point_width);
    style.role = view_paints_points(&s->view) ? ROLE_OWN : style.role;
    const size_t before = s->markers.count;
    scene_add_points(s, some, count, SHAPE_SQUARE, style);
    if (style.role == ROLE_OWN && s->markers.count > before)
        color_points(&s->view, w->values, leaf, s->markers.items + before, s->markers.count - before);
    s->tally.points += count;
    thin_points_to_budget(w);
    if (some != few)
        free(some);
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

/* Remove the boxes at the greatest depth from the scene. */
static void drop_deepest_level(tree_walk *w)
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
        kept_tree_remove_runs(w->kept);
    s->tally.nodes -= w->at_depth[w->deepest];
    s->tally.beyond += w->at_depth[w->deepest];
    w->at_depth[w->deepest--] = 0;
}

static scene_box make_node_box(const tree_walk *w, const octree_node *node)
{
    const node_traits look = {node->depth, node->count, w->capacity, node->leaf};
    const scene_style style = make_role_style(LAYER_NODES, node_role(&w->scene->view, look), STROKE_SOLID, 1);
    return (scene_box){node->address, style, (uint8_t)node->depth, node->box};
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
        drop_deepest_level(w);
}

/* Add a node's box if filter and lod allow it. `by_filter` is true if the filter shows the node. Return false if the
 * filter shows the node but the lod leaves out its box. */
static bool show_box(tree_walk *w, const scene_box *box, bool by_filter)
{
    const scene *s = w->scene;
    const unsigned depth = box->depth;
    const bool under_drawn = w->drawn[depth], /* a box inside a small box is small too, so it need not be measured */
        small = w->small[depth] || (s->view.lod > 0 && camera_is_box_smaller_than(&s->camera, &box->box, s->view.lod));
    const bool out = by_filter && small && under_drawn;
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

/* Copy a stored subtree into the scene. If the lod leaves out a node, all nodes below it are left out too. No lower
 * node needs a test of its own, because the store is used only without a filter. */
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
    w->keeping_failed = w->keeping_failed || !kept_tree_end_subtree(w->kept, w->scene);
}

/* If the store has the subtree of a node, copy it into the scene and return true. Otherwise return false, and begin to
 * store the subtree, unless it has too many points or lies inside a subtree that is already being stored. */
static bool reuse_kept_subtree(tree_walk *w, const octree_node *node)
{
    if (kept_tree_is_collecting(w->kept, node))
        return false;
    close_kept_subtree(w);
    if (node->count > KEPT_POINTS && !node->leaf)
        return false;
    const kept_subtree *found = kept_tree_find_subtree(w->kept, node->address);
    if (found)
        add_kept_subtree(w, found);
    else
        kept_tree_begin_subtree(w->kept, node->address, w->scene);
    return found != NULL;
}

/* ---- The walk ----------------------------------------------------------------------------------------------- */

static octree_walk_order add_node(const octree_node *node, void *context)
{
    tree_walk *w = context;
    scene *s = w->scene;
    if (!filter_shows_subtree(&w->filter, &w->world, node) || (w->kept && reuse_kept_subtree(w, node)))
        return OCTREE_WALK_SKIP;
    if (w->shows_nodes)
        show_node(w, node);
    if (node->leaf && node->count && view_shows_layer(&s->view, LAYER_POINTS) &&
        filter_shows_points_of(&w->filter, &w->world, node))
        add_points(w, node);
    return s->out_of_memory || w->keeping_failed ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

/* Return the store of subtrees, or null if the store must not be used. The store has only nodes of Octreel's tree, and
 * the changes of this tree must be known. The store is not used with a filter, nor for a small tree, which is walked as
 * fast without the store. */
static kept_tree *get_kept_tree(const tree_walk *w, const layer_source *in)
{
    scene *s = w->scene;
    if ((!in->game && in->state == 0) || filter_is_set(&w->filter) || !shows_octreel_nodes(in) ||
        shows_foreign_nodes(in) || (!s->kept && octree_count(in->tree) < KEPT_FEWEST))
        return NULL;
    s->kept = s->kept ? s->kept : calloc(1, sizeof *s->kept);
    return s->kept;
}

static bool begin_kept_tree(tree_walk *w, const layer_source *in, kept_tree *kept)
{
    const view *v = &w->scene->view;
    const kept_look look = {.coloring = v->coloring,
                            .boxes = w->shows_nodes,
                            .points = view_shows_layer(v, LAYER_POINTS),
                            .paints = view_paints_points(v),
                            .point_color = v->point_color,
                            .scale = v->point_scale.of,
                            .values = in->values,
                            .capacity = w->capacity,
                            .point_width = w->point_width};
    if (!kept || !kept_tree_begin_walk(kept, in->tree, &look, in->state))
        return false;
    w->kept = kept;
    w->sieve = kept->sieve;
    return true;
}

/* Finish a walk that used the store. Return false if the walk must be repeated without the store, because memory ran
 * out or because a coarser sieve is enough. */
static bool end_kept_tree(tree_walk *w)
{
    close_kept_subtree(w);
    if (w->kept)
        kept_tree_end_walk(w->kept);
    return !w->keeping_failed && (!w->kept || w->sieve == 0 || w->looser_count > w->scene->view.budget);
}

static void walk_tree(tree_walk *w, const layer_source *in, kept_tree *kept)
{
    scene *s = w->scene;
    const tree_walk initial = *w;
    const size_t boxes = s->boxes.count, markers = s->markers.count;
    const scene_tally tally = s->tally;
    const bool stores = begin_kept_tree(w, in, kept);
    octree_walk(in->tree, add_node, w);
    if (stores && !end_kept_tree(w)) {
        abandon_kept_tree(w);
        *w = initial;
        s->boxes.count = boxes;
        s->markers.count = markers;
        s->tally = tally;
        octree_walk(in->tree, add_node, w);
    }
    if (kept)
        kept->sieve = w->sieve;
}

/* ---- Labels ------------------------------------------------------------------------------------------------- */

/* Write the address of a node, or the id of a foreign node, into the middle of the node's box. Return false, and add no
 * label, if the label is wider than the box on screen or would cover another label. Readers could take a label wider
 * than its box for a label of a neighbouring box. */
static bool add_label(scene *s, text_space *words, const scene_box *box)
{
    char address[OCTREE_ADDRESS_TEXT];
    double middle[3], pixel[2];
    scene_box_middle(&box->box, middle);
    if (is_foreign_element(box->id))
        snprintf(address, sizeof address, "%" PRIu64, foreign_node_id(box->id));
    else
        octree_address_format(box->id, address);
    scene_label label =
        scene_make_label(box->id, make_role_style(LAYER_NODES, ROLE_TEXT, STROKE_SOLID, 1), "%s", address);
    const double width = (double)(strlen(label.text) + 1) * s->text.width;
    if (!camera_find_pixel(&s->camera, middle, pixel) || camera_box_size_in_pixels(&s->camera, &box->box) < width ||
        !text_space_reserve_text(words, s, label.text, pixel, label.at))
        return false;
    scene_add_label_on_ground(s, &label, ROLE_PANEL);
    return true;
}

/* Label the boxes of nodes. Boxes at smaller depths come first; boxes at the same depth are labelled in the order of
 * the walk. */
static void add_labels(scene *s)
{
    /* text_space_make() reserves the areas of the numbers on the axes, so that no label of a node covers them. */
    text_space words = text_space_make(s);
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

/* Return the factor by which the distance between points grows if a sieve keeps one point in `one_in`. The factor
 * includes 1.3 because a sieve keeps points at random, which leaves wider gaps than the regular points of a scan. */
static double find_spacing_factor(uint64_t one_in)
{
    return one_in > 1 ? 1.3 * sqrt((double)one_in) : 1;
}

/* Add the layers of nodes and points in one walk. The more points there are, the smaller each point is drawn. In a game
 * the size of a point follows from the number of points in the session, so that the size does not change from tick to
 * tick. */
static void add_nodes_and_points(scene *s, const layer_source *in, view_layer layer)
{
    const size_t expected = in->game ? in->session->body_count : octree_count(in->tree);
    tree_walk w = {.scene = s, .world = in->world, .values = in->values, .deepest = OCTREE_MAX_DEPTH};
    w.capacity = octree_definition(in->tree).leaf_capacity;
    w.point_width = expected <= MOST_NAMED_POINTS ? 3 : expected <= 500 ? 2 : expected <= 20000 ? 1 : 0;
    w.shows_nodes = view_shows_layer(&s->view, LAYER_NODES) && shows_octreel_nodes(in);
    w.filter = s->view.filter;
    if (!shows_octreel_nodes(in))
        /* The depths in the view's filter are depths of the foreign tree. They do not apply to the points, which belong
         * to Octreel's tree. */
        w.filter.by_depth = false;
    walk_tree(&w, in, get_kept_tree(&w, in));
    s->tally.deepest = w.deepest;
    if (shows_foreign_nodes(in))
        add_foreign_nodes(s, in);
    s->tally.one_in = w.sieve + 1;
    s->spacing =
        view_paints_points(&s->view) ? s->view.point_scale.of.spacing * find_spacing_factor(s->tally.one_in) : 0;
    if (s->view.labels && view_shows_layer(&s->view, layer))
        add_labels(s);
}

/* Add a legend line for each kind of foreign node that has a colour. Octreel's own nodes have no kinds. */
static void add_kinds_legend(legend *l, const layer_source *in)
{
    const size_t count = shows_foreign_nodes(in) ? in->tick->foreign.kind_count : 0;
    /* Number of kinds of foreign nodes that get a legend line of their own. */
    const size_t named = count > THEME_NODE_KINDS ? THEME_NODE_KINDS - 1 : count;
    if (shows_octreel_nodes(in))
        legend_add(l, SIGN_BOLD, "node");
    for (size_t i = 0; i < named; i++)
        legend_add(l, SIGN_BOLD, "node: %s", in->tick->foreign.kinds[i][0] ? in->tick->foreign.kinds[i] : "no kind")
            ->role = theme_node_kind_role((unsigned)i);
    if (count > named)
        legend_add(l, SIGN_BOLD, "node: any other kind")->role = theme_node_kind_role((unsigned)named);
}

/* Add the legend's colour bars of occupancy. A foreign index has no leaf capacity, so its nodes have a colour bar of
 * their own. */
static void add_occupancy_legend(legend *l, const layer_source *in)
{
    const view *v = &l->scene->view;
    const bool diagram = view_shows_layer(v, LAYER_DIAGRAM);
    if (shows_octreel_nodes(in) || diagram)
        legend_add(l, SIGN_RAMP, "leaves, 0-%zu+ points", octree_definition(in->tree).leaf_capacity)->steps =
            THEME_NODE_DEPTHS;
    if ((shows_octreel_nodes(in) && !v->filter.leaves) || diagram)
        legend_add(l, SIGN_BOLD, "inner node")->role = ROLE_WORLD;
    if (shows_foreign_nodes(in))
        legend_add(l, SIGN_RAMP, "foreign, 0-%u+ points", THEME_MOST_POINTS)->steps = THEME_NODE_DEPTHS;
}

static void add_node_legend(legend *l, const layer_source *in)
{
    const size_t deepest = shows_foreign_nodes(in) ? OCTREE_MAX_DEPTH : find_depth_of_tree(in);
    if (l->scene->view.coloring == COLORING_KIND)
        add_kinds_legend(l, in);
    else if (l->scene->view.coloring == COLORING_DEPTH)
        legend_add_depths(l, "nodes, depth", deepest);
    else if (l->scene->view.coloring == COLORING_OCCUPANCY)
        add_occupancy_legend(l, in);
    else
        legend_add(l, SIGN_BOLD, "node");
}

static void describe_node_element(description *d, const described_element *element)
{
    const char *before = element->kind == SCENE_PANEL   ? "the background of the address of "
                         : element->kind == SCENE_LABEL ? " on "
                                                        : "";
    describe_node(d, before, element->id);
}

const layer_type layer_NODES = {.add = add_nodes_and_points,
                                .legend = {.order = 50, .add_lines = add_node_legend},
                                .describe = describe_node_element};

static void describe_point_element(description *d, const described_element *element)
{
    if (element->kind == SCENE_MARKER)
        describe_point(d, "", element->id, element->at);
    else
        append_text(d, element->kind == SCENE_PANEL ? "the background of the id of a point" : ", the id of a point");
}

const layer_type layer_POINTS = {.describe = describe_point_element,
                                 .legend = {.order = 30, .add_lines = add_point_legend, .drop_order = DROP_FIRST}};
