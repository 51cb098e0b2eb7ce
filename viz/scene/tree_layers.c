/* tree_layers.c - see tree_layers.h. */
#include "tree_layers.h"

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

void add_world(scene *s, const octree_box *world)
{
    const scene_look look = {.layer = LAYER_WORLD, .role = ROLE_WORLD, .width = 1};
    scene_add_box(s, (scene_box){.id = 0, .box = *world, .look = look});
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
    uint8_t point_width;
} tree_walk;

static void add_point(scene *s, const octree_point *point, uint8_t width)
{
    scene_marker marker = {.id = point->id, .look = {.layer = LAYER_POINTS, .role = ROLE_POINT, .width = width}};
    memcpy(marker.at, point->position, sizeof marker.at);
    scene_add_marker(s, marker);
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
        add_point(s, &sorted[i], width);
    free(sorted);
}

static octree_walk_order add_node(const octree_node *node, void *context)
{
    const tree_walk *walk = context;
    scene *s = walk->scene;
    scene_add_box(s, (scene_box){
                         .id = node->address,
                         .box = node->box,
                         .depth = (uint8_t)node->depth,
                         .look = {.layer = LAYER_NODES, .role = (uint8_t)theme_node_role(node->depth), .width = 1},
                     });
    if (node->leaf && node->count && view_shows(&s->view, LAYER_POINTS))
        add_points(s, node, walk->point_width);
    return s->out_of_memory ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

void add_tree(scene *s, const octree *tree, size_t expected)
{
    octree_walk(tree, add_node, &(tree_walk){s, expected <= 500 ? 2 : expected <= 20000 ? 1 : 0});
}
