/* SPDX-License-Identifier: MIT */
/* heat_layers.c - the heat layers: a marker in the middle of each leaf. The marker's size and brightness grow with the
 * number of visits or points that the leaf has had since tick 0. */
#include "heat_layers.h"
#include "layer_type.h"
#include "octree/octree.h"
#include "text.h"

#include <inttypes.h>

unsigned heat_step(uint64_t amount, unsigned shift)
{
    return theme_step_of_doubling_ramp(amount >> shift, shift);
}

/* The context of the walk that adds a marker to each leaf. */
typedef struct heat_walk {
    scene *scene;
    const layer_source *in;
    view_layer layer;
} heat_walk;

static unsigned heat_shift(view_layer layer)
{
    return layer == LAYER_VISIT_HEAT ? HEAT_VISITS_SHIFT : HEAT_POINTS_SHIFT;
}

/* Return half the width of a leaf's marker. The result is at most half the leaf's size on screen, so that markers do
 * not cover each other. */
static unsigned mark_width(const scene *s, const octree_box *leaf, unsigned step)
{
    const double most = camera_box_size_in_pixels(&s->camera, leaf) / (2 * s->unit);
    const unsigned width = step + 1;
    return width < most ? width : most > 0 ? (unsigned)most : 0;
}

static octree_walk_order add_leaf(const octree_node *node, void *context)
{
    heat_walk *w = context;
    scene *s = w->scene;
    const view_filter *f = &s->view.filter;
    if (!filter_shows_subtree(f, &w->in->world, node))
        return OCTREE_WALK_SKIP;
    if (!node->leaf || !filter_shows_node(f, &w->in->world, node))
        return OCTREE_WALK_ON;
    const heat_cell heat_of_node = heat_get_cell(w->in->heat, node->address);
    const bool visits = w->layer == LAYER_VISIT_HEAT;
    const uint64_t amount = visits ? heat_of_node.visits : heat_of_node.points;
    if (amount) {
        double middle[3];
        const unsigned step = heat_step(amount, heat_shift(w->layer));
        scene_box_middle(&node->box, middle);
        scene_add_mark(s, node->address, middle, visits ? SHAPE_SQUARE : SHAPE_DIAMOND,
                       make_role_style(w->layer, theme_node_role(step), STROKE_SOLID, mark_width(s, &node->box, step)));
    }
    return s->out_of_memory ? OCTREE_WALK_STOP : OCTREE_WALK_ON;
}

static void add_heat(scene *s, const layer_source *in, view_layer layer)
{
    heat_walk w = {s, in, layer};
    if (in->heat && view_shows_layer(&s->view, layer))
        octree_walk(in->tree, add_leaf, &w);
}

static void add_heat_legend(legend *l, const layer_source *in)
{
    const bool visits = l->next.layer == LAYER_VISIT_HEAT;
    (void)in;
    legend_add(l, SIGN_GROWING_RAMP, "%s 1-%" PRIu64 "+ %s", visits ? "square" : "diamond",
               HEAT_LAST(heat_shift(l->next.layer)), visits ? "visits" : "points");
}

static void describe_heat(description *d, const described_element *element)
{
    const heat_cell heat_of_node = heat_get_cell(d->heat, element->id);
    const uint64_t ticks = d->tick->number + 1;
    if (element->style.layer == LAYER_VISIT_HEAT)
        append_text(d, "visited in %" PRIu64 " of", heat_of_node.visits);
    else
        append_text(d, "%" PRIu64 " point%s summed over", heat_of_node.points, plural_ending(heat_of_node.points));
    append_text(d, " %" PRIu64 " tick%s", ticks, plural_ending(ticks));
    describe_node(d, ", ", element->id);
}

const layer_type layer_VISIT_HEAT = {.applies = is_game_scene,
                                     .add = add_heat,
                                     .legend = {.order = 170, .add_lines = add_heat_legend},
                                     .describe = describe_heat};

const layer_type layer_POINT_HEAT = {.applies = is_game_scene,
                                     .add = add_heat,
                                     .legend = {.order = 180, .add_lines = add_heat_legend},
                                     .describe = describe_heat};
