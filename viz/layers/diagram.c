/* diagram.c - see diagram.h. */
#include "diagram.h"
#include "diagram_place.h"
#include "element_ids.h"
#include "filter.h"
#include "layer.h"
#include "layout.h"
#include "tree_nodes.h"

#include <math.h>

#define RING 2 /* units that the ring around a node on the way is larger than what is in it, both sides together */

static scene_style line_style(theme_role role, scene_stroke stroke, unsigned width)
{
    return (scene_style){
        .layer = LAYER_DIAGRAM, .role = (uint8_t)role, .stroke = (uint8_t)stroke, .width = (uint8_t)width};
}

/* The order of a walk: the root first, and each node before its children. */
static int compare_nodes(octree_address a, octree_address b)
{
    const unsigned depth_a = octree_address_depth(a), depth_b = octree_address_depth(b);
    const octree_address p = depth_a < depth_b ? a << 3 * (depth_b - depth_a) : a;
    const octree_address q = depth_b < depth_a ? b << 3 * (depth_a - depth_b) : b;
    return p != q ? (p < q ? -1 : 1) : (depth_a > depth_b) - (depth_a < depth_b);
}

/* How the tick met a node; null where it did not. */
static const octree_visit *find_visit(const diagram_marks *marks, octree_address node)
{
    size_t low = 0, high = marks->visit_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const int order = compare_nodes(marks->visits[middle].node, node);
        if (order == 0)
            return &marks->visits[middle];
        low = order < 0 ? middle + 1 : low;
        high = order < 0 ? high : middle;
    }
    return NULL;
}

/* The line to a node from above: bold where it was looked into, dashed where it was left out. */
static scene_style style_of(const diagram_place *p, const diagram_marks *marks, octree_address node, theme_role role)
{
    const octree_visit *visit = find_visit(marks, node);
    const bool pruned = visit && marks->pruned && visit->touch == OCTREE_TOUCH_PRUNED;
    const bool visited = visit && marks->visited && visit->touch != OCTREE_TOUCH_PRUNED;
    p->scene->tally.marked_visited += visited;
    p->scene->tally.marked_pruned += pruned;
    return line_style(role, pruned ? STROKE_DASHED : STROKE_SOLID, visited ? 2 : 1);
}

/* As high as the row allows, and as wide as the slot: a leaf is half as large as an inner node. */
static void measure(const diagram_place *p, const diagram_node *node, double size[2])
{
    const int unit = p->scene->unit;
    const double largest = (node->leaf ? DIAGRAM_NODE / 2 : DIAGRAM_NODE) * unit;
    size[0] = fmax(fmin(largest, p->width * (node->right - node->left) - unit), 1);
    size[1] = fmax(fmin(largest, p->pitch - 2 * unit), 1);
}

static unsigned role_of(const diagram_place *p, const diagram_node *node, const octree_box *world)
{
    const octree_node asked = {.depth = node->depth, .leaf = node->leaf, .box = node->box};
    const view *v = &p->scene->view;
    return filter_shows_node(&v->filter, world, &asked) ? node_role(v, node->depth, node->points) : ROLE_WORLD;
}

/* From the foot of a node to the head of its child. */
static void add_line(const diagram_place *p, octree_address child, const diagram_stop *from, const diagram_stop *to,
                     scene_style style)
{
    scene_add_segment(p->scene, (scene_segment){.id = child,
                                                .in_picture = true,
                                                .ends = {{from->x, from->foot, 0}, {to->x, to->head, 0}},
                                                .style = style});
}

/* A ring around a node on the way, which a dark one keeps apart from the node's own colour. */
static void add_ring(const diagram_place *p, unsigned depth, double x, const double size[2])
{
    const double y = diagram_row(p, depth);
    for (int dark = 0; dark < 2; dark++) {
        const double more = (dark ? RING : 2 * RING) * p->scene->unit;
        diagram_fill(p, dark ? diagram_ring_id(depth) : diagram_way_id(depth), x, y, size[0] + more, size[1] + more,
                     dark ? ROLE_BACKGROUND : ROLE_PLAYER);
    }
}

static void add_node(diagram_place *p, const diagram_node *node, double x, const double size[2], unsigned role)
{
    if (diagram_on_way(p, node->address, node->depth))
        add_ring(p, node->depth, x, size);
    diagram_fill(p, node->address, x, diagram_row(p, node->depth), size[0], size[1], role);
    p->scene->tally.drawn++;
}

/* The nodes that have room, and the lines between them; or those on the way, which are to lie on top. */
static void add_nodes(diagram_place *p, const octree_box *world, const diagram_marks *marks, bool on_way)
{
    diagram_stop stops[OCTREE_MAX_DEPTH + 1]; /* of the ancestors: parents come before their children */
    for (size_t i = 0; i < p->slots.count; i++) {
        const diagram_node *node = &p->slots.nodes[i];
        const unsigned depth = node->depth, role = role_of(p, node, world);
        double size[2];
        measure(p, node, size);
        stops[depth] = diagram_stop_at(p, depth, (node->left + node->right) / 2, size[1]);
        if (diagram_on_way(p, node->address, depth) != on_way)
            continue;
        if (on_way)
            p->stops[depth] = stops[depth];
        else if (depth)
            add_line(p, node->address, &stops[depth - 1], &stops[depth],
                     style_of(p, marks, node->address, (theme_role)role));
        add_node(p, node, stops[depth].x, size, role);
    }
}

/* The way from the root, on top of the other lines and of bars. */
static void add_way(const diagram_place *p)
{
    const unsigned deep = octree_address_depth(p->way);
    for (unsigned depth = 0; depth <= deep; depth++) {
        const diagram_stop *at = &p->stops[depth];
        if (depth)
            add_line(p, p->way >> 3 * (deep - depth), at - 1, at, line_style(ROLE_PLAYER, STROKE_SOLID, 2));
        if (depth > p->slots.deepest)
            diagram_fill(p, diagram_way_id(depth), at->x, diagram_row(p, depth), RING * p->scene->unit,
                         at->foot - at->head, ROLE_PLAYER);
        p->scene->tally.way++;
    }
}

/* What the space view may have drawn beyond its part is covered. */
static void add_ground(scene *s)
{
    const camera_window w = layout_diagram(&s->view);
    scene_add_panel(s, (scene_panel){.id = DIAGRAM_GROUND_ID,
                                     .x = (int)w.x,
                                     .y = (int)w.y,
                                     .width = (int)w.width,
                                     .height = (int)w.height,
                                     .style = {.layer = LAYER_DIAGRAM, .role = ROLE_BACKGROUND}});
}

void add_diagram(scene *s, const octree *tree, const diagram_marks *marks)
{
    const octree_box world = octree_definition(tree).world;
    diagram_place p;
    octree_node end;
    if (!view_shows(&s->view, LAYER_DIAGRAM))
        return;
    add_ground(s);
    if (!diagram_place_make(&p, s, tree))
        return;
    p.way = marks->way && octree_node_at(tree, marks->way, &end) == OCTREE_OK ? marks->way : 0;
    add_diagram_bars(&p, tree);
    add_nodes(&p, &world, marks, false);
    add_nodes(&p, &world, marks, true);
    if (p.way)
        add_way(&p);
    if (p.words)
        add_diagram_words(&p, p.way ? &end : NULL);
    diagram_slots_release(&p.slots);
}
