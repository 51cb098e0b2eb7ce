/* SPDX-License-Identifier: MIT */
/* golden_frames.c - see golden_frames.h. */
#include "golden_frames.h"
#include "view_options.h"
#include "broken_tree.h"
#include "camera.h"
#include "point_scale.h"
#include "foreign_session.h"
#include "layer.h"
#include "picture.h"
#include "octree/sample.h"
#include "tick_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SHAPES "world,nodes,points,range,radius,knearest,nearest,player,box"
#define TREE "world,nodes,points"

const golden_frame golden_frames[] = {
    {"one_leaf", "iso", SHAPES, 0, "two", 0, 0},
    {"first_split", "iso", SHAPES, 0, "three", 0, 0},
    {"depth_5", "iso", "nodes,points", 0, NULL, 0, 0},
    {"merged", "iso", "nodes,points,player", 22, NULL, 0, 0},
    {"collision", "follow", SHAPES, 193, NULL, 0, 0},
    {"refused_step", "iso", "default", 74, NULL, 0, 0},
    {"full_leaf", "follow", "default", 214, NULL, 0, 0},
    {"nearest", "front", SHAPES, 7, NULL, 0, 0},
    {"range", "side", SHAPES, 219, NULL, 0, 0},
    {"camera_top", "top", SHAPES, 12, NULL, 0, 0},
    {"camera_orbit", "orbit", SHAPES, 120, NULL, 0, 0},
    {"clustered", "iso", SHAPES, 0, "clustered", 0, 0},
    {"knearest", "follow", SHAPES, 0, "knearest", 0, 0},
    {"radius", "follow", SHAPES, 0, "radius", 0, 0},
    {"ray", "iso", "default", 0, "light", 640, 360},
    {"frustum", "iso", "default", 0, "eye", 640, 360},
    {"sweep", "iso", "default", 0, "way", 640, 360},
    {"swept", "front", SHAPES, 1, "swept", 0, 0},
    {"closeup", "iso", "default", 219, NULL, 960, 540},
    {"slice", "iso", TREE, 0, "clustered", 0, 0},
    {"region", "iso", TREE, 0, "clustered", 0, 0},
    {"fit", "iso", TREE, 0, "clustered", 0, 0},
    {"left_out", "top", TREE ",text", 0, "clustered", 640, 360},
    {"labels", "iso", TREE, 0, NULL, 640, 360},
    {"zoomed", "iso", TREE ",text", 0, "clustered", 310, 240},
    {"aa", "orbit", SHAPES, 219, NULL, 160, 90},
    {"lod", "orbit", TREE, 0, "clustered", 0, 0},
    {"budget", "iso", TREE ",text", 0, "clustered", 320, 240},
    {"diagram", "iso", SHAPES, 225, NULL, 0, 0},
    {"diagram_folded", "iso", "text", 0, "clustered", 320, 180},
    {"visited", "follow", "nodes,visited,points,range,player", 216, NULL, 0, 0},
    {"pruned", "iso", "nodes,pruned,points,player", 216, NULL, 0, 0},
    {"hit", "iso", "nodes,hit,points,range", 0, "clustered", 0, 0},
    {"splits", "follow", "nodes,splits,points,player", 9, NULL, 0, 0},
    {"merges", "follow", "nodes,merges,points,player", 22, NULL, 0, 0},
    {"visit_heat", "iso", "nodes,visit-heat", 252, NULL, 0, 0},
    {"point_heat", "iso", "world,point-heat", 30, "clustered", 0, 0},
    {"broken", "iso", "default", 0, NULL, 640, 360},
    {"velocities", "iso", "nodes,points,velocities,player", 3, "moving", 400, 225},
    {"bodies", "iso", "default", 4, "boxes", 640, 360},
    {"diagram_met", "iso", "default", 216, NULL, 640, 360},
    {"asked", "top", "nodes,asked,points", 0, "clustered", 0, 0},
    {"wrong", "iso", "world,nodes,points,nearest,radius,wrong,text", 0, "answered", 640, 360},
    {"foreign_nodes", "iso", "default", 0, "foreign", 640, 360},
    {"foreign_nodes_wrong", "iso", "default", 1, "foreign", 640, 360},
    {"visits_told", "iso", "default,visit-heat", 218, NULL, 640, 360},
    {"painted", "iso", "nodes,points,text", 0, "painted", 640, 360},
    {"painted_leaves", "orbit", "world,points,text", 0, "painted", 480, 270},
};

const size_t golden_frame_count = sizeof golden_frames / sizeof golden_frames[0];

/* What else the views of some frames have. */
static const struct {
    const char *name;
    view view;
} views[] = {
    {"slice", {.filter = {.slice = 'z', .slice_at = -600}}},
    {"region", {.filter = {.by_region = true, .region = {{-900, -900, -300}, {100, 0, 300}}}}},
    {"fit", {.fit = FIT_POINTS, .filter = {.by_region = true, .region = {{-900, -900, -900}, {0, 0, 0}}}}},
    {"labels", {.labels = true}},
    {"zoomed", {.zoom = 6, .center = {.given = true, .place = {-400, -200, -400}}}},
    {"aa", {.aa = 4}},
    {"closeup", {.closeup = true}},
    {"lod", {.lod = 12}},
    {"budget", {.budget = 100}},
    {"foreign_nodes", {.coloring = COLORING_KIND}},
    {"diagram", {.diagram = DIAGRAM_BESIDE}},
    {"diagram_met", {.diagram = DIAGRAM_BESIDE}},
    {"diagram_folded", {.diagram = DIAGRAM_ONLY, .coloring = COLORING_OCCUPANCY}},
    {"painted", {.point_color = POINTS_BY_HEIGHT, .shade = SHADE_EDL}},
    {"painted_leaves", {.point_color = POINTS_BY_LEAF, .shade = SHADE_EDL}},
    {"left_out",
     {.coloring = COLORING_OCCUPANCY, .filter = {.leaves = true, .by_depth = true, .min_depth = 2, .max_depth = 4}}},
};

static view view_of_frame(const golden_frame *frame)
{
    view v = {0};
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++)
        if (strcmp(views[i].name, frame->name) == 0)
            v = views[i].view;
    v.width = frame->width ? frame->width : 320;
    v.height = frame->height ? frame->height : 180;
    v.zoom = v.zoom > 0 ? v.zoom : 1;
    v.aa = v.aa > 0 ? v.aa : 1;
    return v;
}

static const octree_game_body few[] = {{.id = 1, .position = {500, 500, 500}},
                                       {.id = 2, .position = {-500, -500, -500}}};

static const octree_query around[] = {
    {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{-900, -400, -300}, {100, 600, 300}}}};

static const octree_query neighbors[] = {{.kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = 6}};
static const octree_query ball[] = {{.kind = OCTREE_QUERY_RADIUS, .at_player = true, .radius = 500}};

/* What a program answered, of points with ids from 100 on: one farther than another, and a ball without one of its
 * points and with one outside. */
static const uint64_t too_far[] = {114}, other[] = {118, 120, 133, 159};
static const octree_query answered[] = {{.tick = OCTREE_EVERY_TICK,
                                         .kind = OCTREE_QUERY_NEAREST,
                                         .target = {-300, -600, 500},
                                         .answered = true,
                                         .answer = too_far,
                                         .answer_count = 1},
                                        {.tick = OCTREE_EVERY_TICK,
                                         .kind = OCTREE_QUERY_RADIUS,
                                         .target = {600, 0, -200},
                                         .radius = 400,
                                         .answered = true,
                                         .answer = other,
                                         .answer_count = 4}};

static const octree_game_body crossing[] = {
    {.id = 1, .position = {50, -50, -250}},
    {.id = 2, .position = {300, 0, 600}, .velocity = {-100, 0, -1400}},
    {.id = 3, .position = {50, 0, 0}},
    {.id = 4, .position = {-200, 0, 900}, .velocity = {700, 0, -200}},
};

/* Many points of a kind, and one query. */
static octree_session sampled_session(octree_sample_kind kind, const octree_query *query, octree_game_body *bodies,
                                      size_t count)
{
    octree_session session = octree_session_default();
    double positions[GOLDEN_MOST_BODIES][3];
    octree_sample(kind, 5, &session.tree.world, count, positions);
    for (size_t i = 0; i < count; i++)
        bodies[i] = (octree_game_body){.id = i + 100, .position = {positions[i][0], positions[i][1], positions[i][2]}};
    session.tree.leaf_capacity = 4;
    session.tree.max_depth = OCTREE_MAX_DEPTH;
    session.bodies = bodies;
    session.body_count = count;
    session.queries = query;
    session.query_count = 1;
    return session;
}

/* Points at rest and points that move, some of which bounce soon. */
static octree_session moving_session(octree_game_body *bodies)
{
    octree_session session = sampled_session(OCTREE_SAMPLE_UNIFORM, NULL, bodies, 30);
    double velocities[30][3];
    const octree_box speeds = {{-90, -90, -90}, {90, 90, 90}};
    octree_sample(OCTREE_SAMPLE_UNIFORM, 9, &speeds, 30, velocities);
    for (size_t i = 0; i < 24; i++)
        memcpy(bodies[i].velocity, velocities[i], sizeof velocities[i]);
    session.query_count = 0;
    return session;
}

/* Boxes of several sizes: the player runs into body 1, bodies 2 and 3 overlap, and a query finds bodies 5 and 6. The
 * same session is tests/examples/boxes.json. */
static const octree_game_body boxes[] = {
    {.id = 1, .position = {-20, -60, -60}, .half = {16, 24, 24}},
    {.id = 2, .position = {40, 40, -60}, .half = {30, 12, 40}},
    {.id = 3, .position = {52, 2, -30}, .velocity = {0, 6, 0}, .half = {14, 14, 14}},
    {.id = 4, .position = {64, -70, 40}, .velocity = {-6, 3, 0}, .half = {9, 9, 9}},
    {.id = 5, .position = {-60, 40, 50}, .half = {20, 16, 8}},
    {.id = 6, .position = {-30, 84, 66}, .velocity = {0, -2, 0}, .half = {5, 5, 5}},
    {.id = 7, .position = {80, -80, -60}},
    {.id = 8, .position = {-80, 80, -50}},
    {.id = 9, .position = {80, 80, 70}},
};

static const octree_query shelf[] = {
    {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RANGE, .box = {{-80, 20, 30}, {-10, 90, 90}}}};

static octree_session session_of_boxes(void)
{
    octree_session session = octree_session_default();
    session.tree.world = (octree_box){{-100, -100, -100}, {100, 100, 100}};
    session.tree.leaf_capacity = 4;
    session.player = (octree_player){.id = 0, .position = {-70, -60, -60}, .step = 10, .box_size = 10};
    session.keys = "d.dd";
    session.bodies = boxes;
    session.body_count = sizeof boxes / sizeof boxes[0];
    session.queries = shelf;
    session.query_count = 1;
    session.pairs = true;
    return session;
}

/* A ray from the player hits two of six boxes, and passes others. */
static const octree_game_body targets[] = {
    {.id = 1, .position = {-200, -200, -100}, .half = {100, 200, 300}},
    {.id = 2, .position = {300, 200, 200}, .half = {200, 50, 200}},
    {.id = 3, .position = {700, 600, 600}, .half = {100, 100, 100}},
    {.id = 4, .position = {-600, 700, 200}, .half = {200, 100, 100}},
    {.id = 5, .position = {500, -600, -400}, .half = {100, 300, 200}},
    {.id = 6, .position = {650, 500, 450}, .half = {50, 100, 50}},
};

static const octree_query beam[] = {
    {.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RAY, .at_player = true, .direction = {8, 6, 5}, .k = 2}};

static octree_session session_of_ray(void)
{
    octree_session session = octree_session_default();
    session.player = (octree_player){.position = {-900, -700, -500}, .box_size = 50};
    session.bodies = targets;
    session.body_count = sizeof targets / sizeof targets[0];
    session.queries = beam;
    session.query_count = 1;
    return session;
}

/* The frustum of a camera at the player, which looks along x: it sees some of the boxes, and cuts others. */
static const octree_query eye[] = {{.tick = OCTREE_EVERY_TICK,
                                    .kind = OCTREE_QUERY_FRUSTUM,
                                    .at_player = true,
                                    .frustum = {{{{-1, 0, 0}, -150},
                                                 {{1, 0, 0}, 1500},
                                                 {{-0.5, 1, 0}, 0},
                                                 {{-0.5, -1, 0}, 0},
                                                 {{-0.4, 0, 1}, 0},
                                                 {{-0.4, 0, -1}, 0}},
                                                6}}};

static octree_session session_of_frustum(void)
{
    octree_session session = session_of_ray();
    session.player = (octree_player){.position = {-900, -300, -200}, .box_size = 40};
    session.queries = eye;
    return session;
}

/* A box that moves from the player to the far corner, and hits two of the boxes. */
static const octree_query way[] = {{.tick = OCTREE_EVERY_TICK,
                                    .kind = OCTREE_QUERY_SWEEP,
                                    .at_player = true,
                                    .to = {1600, 1200, 1000},
                                    .half = {100, 80, 60},
                                    .k = 2}};

static octree_session session_of_sweep(void)
{
    octree_session session = session_of_ray();
    session.queries = way;
    return session;
}

/* A step over one point and past another, which comes along the same way from above. */
static octree_session swept_session(void)
{
    octree_session session = octree_session_default();
    session.player =
        (octree_player){.id = 6, .position = {-600, 0, -300}, .step = 1200, .box_size = 100, .sweep = true};
    session.keys = "d";
    session.bodies = crossing;
    session.body_count = sizeof crossing / sizeof crossing[0];
    session.query_count = 0;
    return session;
}

/* A saddle of 400 points, and a part of it raised. */
static octree_session saddle_session(octree_game_body bodies[GOLDEN_MOST_BODIES])
{
    octree_session session = octree_session_default();
    for (uint64_t i = 0; i < GOLDEN_MOST_BODIES; i++) {
        const double x = (double)(i % 20) * 80 - 760, y = (double)(i / 20) * 80 - 760;
        const bool raised = fabs(x) < 250 && fabs(y) < 250;
        bodies[i] = (octree_game_body){.id = 100 + i, .position = {x, y, (x * x - y * y) / 1900 + (raised ? 450 : 0)}};
    }
    session.tree.leaf_capacity = 16;
    session.bodies = bodies;
    session.body_count = GOLDEN_MOST_BODIES;
    session.query_count = 0;
    return session;
}

static octree_session session_of(const golden_frame *frame, octree_game_body bodies[GOLDEN_MOST_BODIES])
{
    octree_session session = octree_session_default();
    if (!frame->points)
        return session;
    switch (frame->points[0]) {
    case 'a':
        session = sampled_session(OCTREE_SAMPLE_UNIFORM, answered, bodies, 60);
        session.query_count = 2;
        return session;
    case 'b':
        return session_of_boxes();
    case 'c': /* 400 clustered points, and a region that some of them are in */
        return sampled_session(OCTREE_SAMPLE_CLUSTERED, around, bodies, GOLDEN_MOST_BODIES);
    case 'f':
        return foreign_session();
    case 'k':
        return sampled_session(OCTREE_SAMPLE_UNIFORM, neighbors, bodies, 60);
    case 'l':
        return session_of_ray();
    case 'e':
        return session_of_frustum();
    case 'm':
        return moving_session(bodies);
    case 'p':
        return saddle_session(bodies);
    case 'r':
        return sampled_session(OCTREE_SAMPLE_UNIFORM, ball, bodies, 60);
    case 's':
        return swept_session();
    case 'w':
        return session_of_sweep();
    default:
        break;
    }
    session.bodies = few;
    session.body_count = frame->points[1] == 'w' ? 1 : 2; /* the player is a point too */
    session.queries = NULL;
    session.query_count = 0;
    return session;
}

bool golden_is_played(const golden_frame *frame)
{
    return strcmp(frame->name, "broken") != 0 && strcmp(frame->name, "asked") != 0;
}

bool golden_open(const golden_frame *frame, golden_play *play, octreel_error *error)
{
    const view_option *camera = view_find_option("camera"), *layers = view_find_option("layers");
    play->session = session_of(frame, play->bodies);
    play->view = view_of_frame(frame);
    if (!camera->parse(camera, frame->camera, &play->view, error) ||
        !layers->parse(layers, frame->layers, &play->view, error))
        return false;
    if (octree_game_create(&play->session, &play->game) != OCTREE_OK)
        return error_set(error, "%s: the session cannot be played", frame->name);
    camera_fit_points(&play->view, octree_game_tree(play->game));
    return point_scale_compute(&play->view, octree_game_tree(play->game), NULL) || error_no_memory(error);
}

/* One point is written into another's cell. */
static void break_game(const octree_game *game)
{
    const octree_game_body *first = octree_game_session(game)->bodies;
    break_tree(octree_game_tree(game), first->position, octree_game_tick(game)->player);
}

/* One frame is of the tree alone, and of a node in it. */
static bool build_scene(scene *s, const golden_frame *frame, const view *v, const octree_game *game, tick_history *h)
{
    octree_address asked;
    octree_node node;
    if (strcmp(frame->name, "asked") != 0)
        return tick_scene_build(s, v, game, h, NULL);
    return octree_address_parse("6/0", &asked) && octree_node_at(octree_game_tree(game), asked, &node) == OCTREE_OK &&
           tree_scene_build(s, v, octree_game_tree(game), &(tree_subject){.title = frame->name, .node = asked});
}

bool golden_scene(const golden_frame *frame, scene *s, octreel_error *error)
{
    golden_play play;
    *s = (scene){0};
    if (!golden_open(frame, &play, error))
        return false;
    octree_game *game = play.game;
    tick_history h = {0};
    bool ok = tick_history_add(&h, &play.view, game);
    for (uint64_t tick = 0; tick < frame->tick; tick++) {
        octree_game_advance(game);
        ok = ok && tick_history_add(&h, &play.view, game);
    }
    if (strcmp(frame->name, "broken") == 0)
        break_game(game);
    ok = (ok && build_scene(s, frame, &play.view, game, &h)) || error_set(error, "%s: there is no scene", frame->name);
    tick_history_release(&h);
    octree_game_destroy(game);
    return ok;
}

bool golden_draw(const golden_frame *frame, draw_fill fill, image *drawn, char *renderer, size_t size,
                 octreel_error *error)
{
    picture p = {0};
    scene s;
    bool ok = golden_scene(frame, &s, error) && picture_open(&p, &s.view, &(renderer_choice){.fill = fill}, error);
    if (ok)
        snprintf(renderer, size, "%s, %s", renderer_describe(p.renderer).renderer,
                 renderer_describe(p.renderer).version);
    ok = ok && picture_draw(&p, &s, error);
    if (ok) {
        *drawn = p.frame;
        p.frame.pixels = NULL;
    }
    scene_release(&s);
    picture_close(&p);
    return ok;
}
