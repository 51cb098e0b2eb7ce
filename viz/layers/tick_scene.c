/* tick_scene.c - a tick of a game as a scene: the tree, and on top of it what the tick asked and met. */
#include "tick_scene.h"
#include "answer_layers.h"
#include "change_layers.h"
#include "crossed_box.h"
#include "diagram.h"
#include "element_ids.h"
#include "heat_layers.h"
#include "layer.h"
#include "panel.h"
#include "shape_layer.h"
#include "tick_nodes.h"
#include "tree_nodes.h"
#include "velocity_layer.h"
#include "visit_layers.h"
#include "world_layer.h"

#include <string.h>

#define ASKED_MARK 12 /* half units: half the size of the mark on a node that is asked for */

static octree_box box_about(const double center[3], double size)
{
    octree_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = center[i] - size;
        box.max[i] = center[i] + size;
    }
    return box;
}

/* A line from the middle of the player's box straight down to the world's floor tells where it is in space. */
static void add_plumb_line(scene *s, const octree_tick *tick, const octree_box *world)
{
    scene_segment plumb = {.id = 0,
                           .style = {.layer = LAYER_PLAYER, .role = ROLE_FAINT, .stroke = STROKE_DASHED, .width = 1}};
    memcpy(plumb.ends[0], tick->player, sizeof plumb.ends[0]);
    memcpy(plumb.ends[1], tick->player, sizeof plumb.ends[1]);
    plumb.ends[1][2] = world->min[2];
    scene_add_segment(s, plumb);
}

static void add_player(scene *s, const octree_tick *tick, const octree_session *session)
{
    add_plumb_line(s, tick, &session->tree.world);
    scene_marker marker = {
        .id = session->player.id, .style = layer_style(LAYER_PLAYER, STROKE_SOLID, 4), .shape = SHAPE_DIAMOND};
    memcpy(marker.at, tick->player, sizeof marker.at);
    scene_add_marker(s, marker);
    scene_add_box(s, (scene_box){
                         .id = session->player.id,
                         .box = box_about(tick->player, session->player.box_size),
                         .style = {.layer = LAYER_BOX, .role = ROLE_PLAYER, .width = 1},
                     });
}

/* The ids of the lines of a collision begin with those that cross its box out, then come these. */
enum { CORNERS = 8 };

static void add_way(scene *s, uint64_t id, const double from[3], const double to[3], scene_style style)
{
    if (from[0] == to[0] && from[1] == to[1] && from[2] == to[2])
        return;
    scene_segment line = {.id = id, .style = style};
    memcpy(line.ends[0], from, sizeof line.ends[0]);
    memcpy(line.ends[1], to, sizeof line.ends[1]);
    scene_add_segment(s, line);
}

static void pick_corner(const octree_box *box, unsigned corner, double position[3])
{
    for (unsigned i = 0; i < 3; i++)
        position[i] = corner >> i & 1 ? box->max[i] : box->min[i];
}

/* The ways that met: of the corners of the player's box, which is drawn at both ends, and of each hit that moved. */
static void add_swept_ways(scene *s, const octree_tick *tick, double box_size, scene_style style)
{
    const octree_box start = box_about(tick->from, box_size), end = box_about(tick->attempt, box_size);
    double from[3], to[3];
    style.stroke = STROKE_DASHED;
    for (unsigned corner = 0; corner < CORNERS; corner++) {
        pick_corner(&start, corner, from);
        pick_corner(&end, corner, to);
        add_way(s, CROSS_LINES + corner, from, to, style);
    }
    for (size_t i = 0; i < tick->hit_count; i++)
        add_way(s, CROSS_LINES + CORNERS + i, tick->hit_from[i], tick->hits[i].position, style);
}

static void add_cross(scene *s, uint64_t id, const double at[3], scene_style style, uint8_t half)
{
    scene_marker marker = {.id = id, .style = style, .shape = SHAPE_CROSS};
    marker.style.width = half;
    memcpy(marker.at, at, sizeof marker.at);
    scene_add_marker(s, marker);
}

/* The box that was tested, crossed out, and a cross on everything in it. A box that appears small is a blot, of which
 * only the colour tells what it is: so a larger cross lies on it, whatever its size. */
static void add_collision(scene *s, const octree_tick *tick, const octree_session *session)
{
    if (tick->hit_count == 0)
        return;
    const scene_style style = layer_style(LAYER_BOX, STROKE_SOLID, 1);
    const octree_box box = box_about(tick->attempt, session->player.box_size);
    scene_box outline = {.id = COLLISION_BOX_ID, .box = box, .style = style};
    outline.style.width = 2;
    scene_add_box(s, outline);
    add_crossed_faces(s, &box, style);
    if (tick->swept)
        add_swept_ways(s, tick, session->player.box_size, style);
    add_cross(s, session->player.id, tick->attempt, style, 28);
    for (size_t i = 0; i < tick->hit_count; i++)
        add_cross(s, tick->hits[i].id, tick->hits[i].position, style, 6);
}

/* The leaf that the player is in. */
static octree_address leaf_of(const octree *tree, const double position[3])
{
    octree_node leaf;
    return octree_locate(tree, position, &leaf) == OCTREE_OK ? leaf.address : 0;
}

bool tick_scene_build(scene *s, const view *v, const octree_game *game, const heat *h)
{
    const octree_tick *tick = octree_game_tick(game);
    const octree_session *session = octree_game_session(game);
    const octree *tree = octree_game_tree(game);
    const finding found = find_broken(v, tree);
    begin_scene(s, v, &session->tree.world, tick->player, tick->number);
    add_world(s, &session->tree.world);
    add_tree(s, tree, session->body_count);
    add_heat(s, tree, h);
    add_visits(s, game);
    add_changes(s, game);
    add_velocities(s, game);
    add_answers(s, tick->answers, tick->answer_count);
    if (tick->has_player)
        add_player(s, tick, session);
    add_collision(s, tick, session);
    add_shapes(s, tick);
    add_broken(s, &session->tree.world, &found);
    add_diagram(s, tree,
                &(diagram_marks){.way = tick->has_player ? leaf_of(tree, tick->player) : 0,
                                 .visits = tick->visits,
                                 .visit_count = tick->visit_count,
                                 .visited = view_shows(v, LAYER_VISITED),
                                 .pruned = view_shows(v, LAYER_PRUNED)});
    add_tick_panel(s, game, &found);
    return !s->out_of_memory;
}

/* Bold, in the colour of the way to it in the diagram; and where it appears small, a mark that is seen. */
static void add_asked(scene *s, const octree *tree, octree_address address)
{
    octree_node node;
    const scene_style style = layer_style(LAYER_ASKED, STROKE_SOLID, 2);
    if (!address || octree_node_at(tree, address, &node) != OCTREE_OK)
        return;
    add_node_box(s, &node, style);
    if (camera_box_pixels(&s->camera, &node.box) > 2 * ASKED_MARK * s->unit)
        return;
    scene_marker mark = {.id = address, .style = style, .shape = SHAPE_LOZENGE};
    mark.style.width = ASKED_MARK;
    for (int i = 0; i < 3; i++)
        mark.at[i] = node.box.min[i] / 2 + node.box.max[i] / 2;
    scene_add_marker(s, mark);
}

bool look_scene_build(scene *s, const view *v, const octree *tree, const tree_look *about)
{
    const octree_box world = octree_definition(tree).world;
    const octree_box *framed = v->fit == FIT_BOX ? &v->focus : &world;
    const finding found = find_broken(v, tree);
    double center[3]; /* what a camera follows where nobody plays */
    for (int i = 0; i < 3; i++)
        center[i] = framed->min[i] / 2 + framed->max[i] / 2;
    begin_scene(s, v, &world, center, 0);
    add_world(s, &world);
    add_tree(s, tree, octree_count(tree));
    add_asked(s, tree, about->node);
    add_answers(s, about->answers, about->answer_count);
    add_broken(s, &world, &found);
    add_diagram(s, tree, &(diagram_marks){.way = about->node});
    add_tree_panel(s, tree, about, &found);
    return !s->out_of_memory;
}
