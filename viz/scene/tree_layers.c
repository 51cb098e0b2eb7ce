/* tree_layers.c - see tree_layers.h. */
#include "tree_layers.h"
#include "filter.h"

#include <stdlib.h>
#include <string.h>

void begin_scene(scene *s, const view *v, const octree_box *world, const double player[3], uint64_t tick, int panel)
{
    scene_clear(s);
    s->view = *v;
    s->unit = view_unit(v);
    const camera_window window = {panel, 0, v->width - panel, v->height};
    s->camera = camera_make(v, window, world, player, tick);
}

/* Where the slice and the region are: ids 1 and 2 beside the world's own box. */
static void add_filter(scene *s, const octree_box *world)
{
    const view_filter *f = &s->view.filter;
    const scene_look look = {.layer = LAYER_WORLD, .role = ROLE_FAINT, .style = STYLE_DASHED, .width = 1};
    octree_box plane = *world;
    if (f->slice) {
        plane.min[f->slice - 'x'] = plane.max[f->slice - 'x'] = f->slice_at;
        scene_add_box(s, (scene_box){.id = 1, .box = plane, .look = look});
    }
    if (f->by_region)
        scene_add_box(s, (scene_box){.id = 2, .box = f->region, .look = look});
}

void add_world(scene *s, const octree_box *world)
{
    const scene_look look = {.layer = LAYER_WORLD, .role = ROLE_WORLD, .width = 1};
    scene_add_box(s, (scene_box){.id = 0, .box = *world, .look = look});
    add_filter(s, world);
    for (int i = 0; i < 3; i++) {
        scene_label letter = {.id = (uint64_t)i, .in_world = true, .look = look, .text = {(char)('x' + i), 0}};
        letter.look.role = ROLE_FAINT;
        memcpy(letter.at, world->min, sizeof letter.at);
        letter.at[i] = world->max[i];
        scene_add_label(s, letter);
    }
}

/* What the walk over the nodes carries with it. */
typedef struct tree_walk {
    scene *scene;
    octree_box world;
    uint8_t point_width;
} tree_walk;

static void add_point(scene *s, const octree_point *point, uint8_t width)
{
    scene_marker marker = {.id = point->id, .look = {.layer = LAYER_POINTS, .role = ROLE_POINT, .width = width}};
    memcpy(marker.at, point->position, sizeof marker.at);
    scene_add_marker(s, marker);
    s->tally.points++;
}

/* A leaf's points come in no stated order: sort them, so that a scene does not depend on the tree's history. */
static void add_points(scene *s, const octree_node *leaf, uint8_t width)
{
    octree_point *sorted = malloc(leaf->count * sizeof *sorted);
    if (!sorted) {
        s->out_of_memory = true;
        return;
    }
    memcpy(sorted, leaf->points, leaf->count * sizeof *sorted);
    qsort(sorted, leaf->count, sizeof *sorted, octree_compare_points);
    for (size_t i = 0; i < leaf->count; i++)
        if (filter_shows_point(&s->view.filter, sorted[i].position))
            add_point(s, &sorted[i], width);
    free(sorted);
}

static theme_role role_of(const view *v, const octree_node *node)
{
    switch (v->coloring) {
    case COLORING_OCCUPANCY:
        return theme_node_role(theme_occupancy_step(node->count));
    case COLORING_PLAIN:
        return ROLE_NODE_PLAIN;
    default:
        return theme_node_role(node->depth);
    }
}

static void add_box(scene *s, const octree_node *node)
{
    scene_add_box(s, (scene_box){
                         .id = node->address,
                         .box = node->box,
                         .depth = (uint8_t)node->depth,
                         .look = {.layer = LAYER_NODES, .role = (uint8_t)role_of(&s->view, node), .width = 1},
                     });
    s->tally.nodes++;
}

static octree_walk_order add_node(const octree_node *node, void *context)
{
    const tree_walk *walk = context;
    scene *s = walk->scene;
    const view_filter *f = &s->view.filter;
    if (!filter_enters(f, &walk->world, node))
        return OCTREE_WALK_SKIP;
    if (filter_shows_node(f, &walk->world, node) && view_shows(&s->view, LAYER_NODES))
        add_box(s, node);
    if (node->leaf && node->count && view_shows(&s->view, LAYER_POINTS) &&
        filter_shows_points_of(f, &walk->world, node))
        add_points(s, node, walk->point_width);
    return s->out_of_memory ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

void add_tree(scene *s, const octree *tree, size_t expected)
{
    const uint8_t width = expected <= 500 ? 2 : expected <= 20000 ? 1 : 0;
    octree_walk(tree, add_node, &(tree_walk){s, octree_definition(tree).world, width});
}
