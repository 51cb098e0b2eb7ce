/* SPDX-License-Identifier: MIT */
/* player_layers.c - two layers. The first shows the player; the second shows the player's collision box and the points
 * that the box hits. */
#include "body_boxes.h"
#include "layer_type.h"
#include "node_boxes.h"

#include <string.h>

static bool session_has_player(const layer_source *in)
{
    return find_player(in);
}

/* Draw the player, and a vertical line from the player down to the world's floor. The line lets readers see where in
 * space the player is. */
static void add_player(scene *s, const layer_source *in, view_layer layer)
{
    const double *at = in->tick->player;
    if (!in->tick->has_player)
        return;
    scene_add_line(s, 0, at, (double[]){at[0], at[1], in->world.min[2]},
                   make_role_style(layer, ROLE_FAINT, STROKE_DASHED, 1));
    scene_add_mark(s, in->session->player.id, at, SHAPE_DIAMOND, make_layer_style(layer, STROKE_SOLID, 4));
}

static void describe_player(description *d, const described_element *element)
{
    if (element->kind == SCENE_SEGMENT)
        append_text(d, "the line from the player down to the world's floor");
    else
        describe_point(d, "the player, ", element->id, element->at);
}

const layer_type layer_PLAYER = {
    .applies = session_has_player,
    .add = add_player,
    .legend = {.order = 10, .sign = SIGN_SQUARE, .text = "player", .drop_order = DROP_FIRST},
    .describe = describe_player};

/* ---- The collision box -------------------------------------------------------------------------------------- */

/* The id of the box with which the collision test found a hit. The box around the player has the player's id
 * instead. */
#define COLLISION_ID UINT64_MAX

/* The lines of a collision have the ids 0, 1, 2 ... in this order: CROSS_LINES lines that cross out the box, one path
 * for each of the box's CORNERS corners, and one path for each hit point. */
enum { CORNERS = 8 };

static octree_box box_around(const double center[3], double size)
{
    octree_box box;
    for (int i = 0; i < 3; i++) {
        box.min[i] = center[i] - size;
        box.max[i] = center[i] + size;
    }
    return box;
}

static void add_path_line(scene *s, uint64_t id, const double from[3], const double to[3], scene_style style)
{
    if (from[0] != to[0] || from[1] != to[1] || from[2] != to[2])
        scene_add_line(s, id, from, to, style);
}

/* Draw the paths of a swept collision test: the path of each corner of the player's box, and the path of each hit point
 * that moved. */
static void add_swept_paths(scene *s, const octree_tick *tick, double box_size, scene_style style)
{
    const octree_box start = box_around(tick->from, box_size), end = box_around(tick->attempt, box_size);
    double from[3], to[3];
    for (unsigned corner = 0; corner < CORNERS; corner++) {
        box_corner(&start, corner, from);
        box_corner(&end, corner, to);
        add_path_line(s, CROSS_LINES + corner, from, to, style);
    }
    for (size_t i = 0; i < tick->hit_count; i++)
        add_path_line(s, CROSS_LINES + CORNERS + i, tick->hit_from[i], tick->hits[i].position, style);
}

/* Draw the box of a hit body, if it has an extent. */
static void add_hit_body(scene *s, const layer_source *in, uint64_t id, view_layer layer)
{
    octree_body body;
    if (!octree_game_find_body(in->game, id, &body) || !has_extent(body.half))
        return;
    const octree_box box = box_of_body(&body);
    scene_add_outline(s, id, &box, make_layer_style(layer, STROKE_SOLID, 2));
}

/* Draw the box of the collision test with crossed faces, and a cross on each hit point. If the box is small on screen,
 * also draw a large cross of fixed size. */
static void add_hit_box(scene *s, const layer_source *in, view_layer layer)
{
    const octree_tick *tick = in->tick;
    const double size = in->session->player.box_size;
    const octree_box box = box_around(tick->attempt, size);
    scene_add_outline(s, COLLISION_ID, &box, make_layer_style(layer, STROKE_SOLID, 2));
    add_crossed_faces(s, &box, make_layer_style(layer, STROKE_SOLID, 1));
    if (tick->swept)
        add_swept_paths(s, tick, size, make_layer_style(layer, STROKE_DASHED, 1));
    scene_add_mark(s, in->session->player.id, tick->attempt, SHAPE_CROSS, make_layer_style(layer, STROKE_SOLID, 28));
    for (size_t i = 0; i < tick->hit_count; i++) {
        scene_add_mark(s, tick->hits[i].id, tick->hits[i].position, SHAPE_CROSS,
                       make_layer_style(layer, STROKE_SOLID, 6));
        add_hit_body(s, in, tick->hits[i].id, layer);
    }
}

static void add_collision_box(scene *s, const layer_source *in, view_layer layer)
{
    const octree_box box = box_around(in->tick->player, in->session->player.box_size);
    if (in->tick->has_player)
        scene_add_outline(s, in->session->player.id, &box, make_role_style(layer, ROLE_PLAYER, STROKE_SOLID, 1));
    if (in->tick->hit_count)
        add_hit_box(s, in, layer);
}

static void add_collision_legend(legend *l, const layer_source *in)
{
    if (in->tick->hit_count == 0)
        return;
    legend_add(l, SIGN_CROSS, "collision");
    if (in->tick->swept)
        legend_add(l, SIGN_DASHES, "path to a hit");
}

static void describe_collision_box(description *d, const described_element *element)
{
    if (element->kind == SCENE_BOX) {
        const bool hit = element->id == COLLISION_ID;
        octree_body body;
        if (!hit && element->id != octree_game_session(d->game)->player.id &&
            octree_game_find_body(d->game, element->id, &body)) {
            describe_point(d, "the box of ", body.id, body.position);
            append_text(d, ", in the player's collision box");
            return;
        }
        append_box(d, hit ? "the collision box that hit something, " : "the player's collision box, ", &element->box);
    } else if (element->kind == SCENE_SEGMENT) {
        append_text(d, element->id < CROSS_LINES ? "a line of the cross on the collision box"
                                                 : "a line of the path that the collision test swept");
    } else if (element->id == octree_game_session(d->game)->player.id) { /* the player never hits itself */
        append_text(d, "the cross on the collision box");
    } else {
        describe_point(d, "", element->id, element->at);
        append_text(d, ", in the player's collision box");
    }
}

const layer_type layer_BOX = {.applies = session_has_player,
                              .add = add_collision_box,
                              .legend = {.order = 155, .add_lines = add_collision_legend},
                              .describe = describe_collision_box};
