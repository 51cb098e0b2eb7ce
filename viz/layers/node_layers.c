/* tree_nodes.c - a tree's nodes and points in a scene: those that the view shows, no smaller and no more than it says.
 */
#include "tree_nodes.h"
#include "camera.h"
#include "filter.h"
#include "layer.h"
#include "node_labels.h"
#include "thinning.h"

#include <stdlib.h>
#include <string.h>

/* What the walk over the nodes carries with it. */
typedef struct tree_walk {
    scene *scene;
    octree_box world;
    uint8_t point_width;
    size_t at_depth[OCTREE_MAX_DEPTH + 1]; /* boxes in the scene */
    int deepest;                           /* boxes below are beyond the budget */
    uint64_t sieve;                        /* points whose digest has one of these bits are beyond the budget */
    bool drawn[OCTREE_MAX_DEPTH + 2];      /* on the way from the root: a box of this depth + 1 or less is drawn; */
    bool small[OCTREE_MAX_DEPTH + 2];      /* and one is smaller than the view's lod */
} tree_walk;

/* ---- Points ------------------------------------------------------------------------------------------------- */

/* Leave out about every other one of the points that are in the scene. */
static void thin_points(tree_walk *w)
{
    scene *s = w->scene;
    size_t kept = 0;
    w->sieve = thinning_finer(w->sieve);
    for (size_t i = 0; i < s->markers.count; i++) {
        const scene_marker *marker = &s->markers.items[i];
        const bool out = marker->style.layer == LAYER_POINTS && thinning_drops(w->sieve, marker->id);
        s->tally.points -= out;
        s->tally.thinned += out;
        if (!out)
            s->markers.items[kept++] = *marker;
    }
    s->markers.count = kept;
}

/* These are in the order in which they are shown. */
static void add_sorted(tree_walk *w, const octree_point *points, size_t count)
{
    scene *s = w->scene;
    scene_add_points(s, layer_style(LAYER_POINTS, STROKE_SOLID, w->point_width), points, count);
    s->tally.points += count;
    while (s->view.budget && s->tally.points > s->view.budget && w->sieve != UINT64_MAX)
        thin_points(w);
}

static bool are_sorted(const octree_point *points, size_t count)
{
    for (size_t i = 1; i < count; i++)
        if (octree_compare_points(&points[i - 1], &points[i]) > 0)
            return false;
    return true;
}

/* Few, and often in order already. */
static void sort_few(octree_point *points, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        const octree_point it = points[i];
        size_t at = i;
        for (; at > 0 && octree_compare_points(&points[at - 1], &it) > 0; at--)
            points[at] = points[at - 1];
        points[at] = it;
    }
}

/* Whether a point is shown, by the filter and the budget. */
static bool takes_point(tree_walk *w, const octree_point *point)
{
    if (!filter_shows_point(&w->scene->view.filter, point->position))
        return false;
    const bool out = thinning_drops(w->sieve, point->id);
    w->scene->tally.thinned += out;
    return !out;
}

/* Those of a leaf's points that are shown, sorted, by way of memory for all of them. */
static void add_some(tree_walk *w, const octree_node *leaf, octree_point *some, size_t most_few)
{
    size_t count = 0;
    for (size_t i = 0; i < leaf->count; i++)
        if (takes_point(w, &leaf->points[i]))
            some[count++] = leaf->points[i];
    if (count <= most_few)
        sort_few(some, count);
    else
        qsort(some, count, sizeof *some, octree_compare_points);
    add_sorted(w, some, count);
}

/* A leaf's points come in no stated order: sort them, so that a scene does not depend on the tree's history. */
static void add_points(tree_walk *w, const octree_node *leaf)
{
    enum { FEW = 32 };
    if (!w->sieve && !filter_is_on(&w->scene->view.filter) && are_sorted(leaf->points, leaf->count)) {
        add_sorted(w, leaf->points, leaf->count);
        return;
    }
    octree_point few[FEW], *some = leaf->count <= FEW ? few : malloc(leaf->count * sizeof *some);
    if (some)
        add_some(w, leaf, some, FEW);
    else
        w->scene->out_of_memory = true;
    if (some != few)
        free(some);
}

/* ---- Nodes -------------------------------------------------------------------------------------------------- */

theme_role node_role(const view *v, unsigned depth, size_t points)
{
    switch (v->coloring) {
    case COLORING_OCCUPANCY:
        return theme_node_role(theme_occupancy_step(points));
    case COLORING_PLAIN:
        return ROLE_NODE_PLAIN;
    default:
        return theme_node_role(depth);
    }
}

/* Leave out the deepest level that is in the scene: what is shown is a whole number of levels. */
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
    s->tally.nodes -= w->at_depth[w->deepest];
    s->tally.beyond += w->at_depth[w->deepest];
    w->at_depth[w->deepest--] = 0;
}

static void add_box(tree_walk *w, const octree_node *node)
{
    scene *s = w->scene;
    if ((int)node->depth > w->deepest) {
        s->tally.beyond++;
        return;
    }
    const theme_role role = node_role(&s->view, node->depth, node->count);
    scene_add_box(s, (scene_box){
                         .id = node->address,
                         .box = node->box,
                         .depth = (uint8_t)node->depth,
                         .style = {.layer = LAYER_NODES, .role = (uint8_t)role, .width = 1},
                     });
    w->at_depth[node->depth]++;
    s->tally.nodes++;
    while (s->view.budget && s->tally.nodes > s->view.budget)
        drop_level(w);
}

/* What is in a small box is small too: it is measured once on the way down. */
static bool is_small(const tree_walk *w, const octree_node *node)
{
    const scene *s = w->scene;
    return w->small[node->depth] || (s->view.lod > 0 && camera_box_is_below(&s->camera, &node->box, s->view.lod));
}

static void show_node(tree_walk *w, const octree_node *node)
{
    scene *s = w->scene;
    const unsigned depth = node->depth;
    const bool under_drawn = w->drawn[depth], small = is_small(w, node);
    const bool shown = filter_shows_node(&s->view.filter, &w->world, node), out = shown && small && under_drawn;
    w->small[depth + 1] = small;
    w->drawn[depth + 1] = under_drawn || (shown && !out);
    s->tally.small += out;
    if (shown && !out)
        add_box(w, node);
}

static octree_walk_order add_node(const octree_node *node, void *context)
{
    tree_walk *w = context;
    scene *s = w->scene;
    const view_filter *f = &s->view.filter;
    if (!filter_enters(f, &w->world, node))
        return OCTREE_WALK_SKIP;
    if (view_shows(&s->view, LAYER_NODES))
        show_node(w, node);
    if (node->leaf && node->count && view_shows(&s->view, LAYER_POINTS) && filter_shows_points_of(f, &w->world, node))
        add_points(w, node);
    return s->out_of_memory ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

void add_tree(scene *s, const octree *tree, size_t expected)
{
    tree_walk w = {.scene = s, .world = octree_definition(tree).world, .deepest = OCTREE_MAX_DEPTH};
    w.point_width = expected <= 500 ? 2 : expected <= 20000 ? 1 : 0;
    octree_walk(tree, add_node, &w);
    s->tally.deepest = w.deepest;
    s->tally.one_in = w.sieve + 1;
    add_node_labels(s);
}
