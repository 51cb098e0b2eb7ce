/* heat_layers.c - see heat_layers.h. */
#include "heat_layers.h"
#include "filter.h"
#include "layer.h"

unsigned heat_step(uint64_t amount, unsigned shift)
{
    unsigned step = 0;
    while (step < HEAT_STEPS - 1 && amount >> shift) {
        amount >>= shift;
        step++;
    }
    return step;
}

/* What the walk over the leaves carries with it. */
typedef struct heat_walk {
    scene *scene;
    const heat *heat;
    octree_box world;
} heat_walk;

/* No larger than half of what is seen of its leaf: marks do not cover each other. */
static uint8_t mark_width(const scene *s, const octree_box *leaf, unsigned step)
{
    const double most = camera_box_pixels(&s->camera, leaf) / (2 * s->unit);
    const unsigned width = step + 1;
    return (uint8_t)(width < most ? width : most > 0 ? most : 0);
}

static void add_mark(scene *s, const octree_node *leaf, view_layer layer, scene_shape shape, unsigned step)
{
    const scene_style style = {
        .layer = (uint8_t)layer, .role = (uint8_t)theme_node_role(step), .width = mark_width(s, &leaf->box, step)};
    scene_marker marker = {.id = leaf->address, .style = style, .shape = (uint8_t)shape};
    for (int i = 0; i < 3; i++)
        marker.at[i] = leaf->box.min[i] / 2 + leaf->box.max[i] / 2;
    scene_add_marker(s, marker);
}

static octree_walk_order add_leaf(const octree_node *node, void *context)
{
    heat_walk *w = context;
    const view *v = &w->scene->view;
    if (!filter_enters(&v->filter, &w->world, node))
        return OCTREE_WALK_SKIP;
    if (!node->leaf || !filter_shows_node(&v->filter, &w->world, node))
        return OCTREE_WALK_ON;
    const heat_cell seen = heat_at(w->heat, node->address);
    if (seen.visits)
        add_mark(w->scene, node, LAYER_VISIT_HEAT, SHAPE_SQUARE, heat_step(seen.visits, HEAT_VISITS_SHIFT));
    if (seen.points)
        add_mark(w->scene, node, LAYER_POINT_HEAT, SHAPE_DIAMOND, heat_step(seen.points, HEAT_POINTS_SHIFT));
    return w->scene->out_of_memory ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

void add_heat(scene *s, const octree *tree, const heat *h)
{
    heat_walk w = {s, h, octree_definition(tree).world};
    if (h && s->view.layers & VIEW_HEAT_LAYERS)
        octree_walk(tree, add_leaf, &w);
}
