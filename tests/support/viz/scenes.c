/* SPDX-License-Identifier: MIT */
/* scenes.c - see scenes.h. */
#include "scenes.h"

#include <string.h>

view view_of(int width, int height, view_camera camera, unsigned layers)
{
    return (view){.width = width, .height = height, .camera = camera, .layers = layers, .zoom = 1, .aa = 1};
}

scene empty_scene(const view *v, const octree_box *world)
{
    scene s = {0};
    double center[3];
    scene_set_view(&s, v);
    for (int axis = 0; axis < 3; axis++)
        center[axis] = world->min[axis] / 2 + world->max[axis] / 2;
    s.camera = camera_make(v, (camera_window){0, 0, v->width, v->height}, world, center, 0);
    return s;
}

/* One of each kind, within the world of the default session. */
static const octree_shape all_shapes[] = {
    {OCTREE_EVERY_TICK, OCTREE_SHAPE_BOX, {-400, 100, -300}, {-100, 300, 0}, ""},
    {OCTREE_EVERY_TICK, OCTREE_SHAPE_SEGMENT, {-900, -900, 0}, {900, 900, 0}, ""},
    {OCTREE_EVERY_TICK, OCTREE_SHAPE_POINT, {300, -300, 300}, {0}, ""},
    {OCTREE_EVERY_TICK, OCTREE_SHAPE_LABEL, {300, -300, 300}, {0}, "goal"},
};

/* The default session's queries, which are ranges at ticks 212 to 223, and two at every tick; and two more bodies,
 * boxes that overlap in the first ticks. One of them crosses the world where the player does not come. */
/* The moving body, which is never the nearest to where it is asked. */
static const uint64_t far_answer[] = {700};

static octree_session make_session_with_all_layers(octree_game_body bodies[32])
{
    static octree_query queries[32];
    octree_session session = octree_session_default();
    size_t count = session.query_count;
    assert_true(session.body_count + 2 < 32);
    memcpy(bodies, session.bodies, session.body_count * sizeof *bodies);
    bodies[session.body_count++] =
        (octree_game_body){.id = 700, .position = {-900, 700, -600}, .velocity = {3, -2.5, 0.25}, .half = {60, 30, 45}};
    bodies[session.body_count++] = (octree_game_body){.id = 701, .position = {-850, 650, -580}, .half = {80, 40, 20}};
    session.pairs = true;
    session.bodies = bodies;
    assert_true(count + 6 <= sizeof queries / sizeof queries[0]);
    memcpy(queries, session.queries, count * sizeof *queries);
    queries[count++] =
        (octree_query){.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = 4};
    queries[count++] =
        (octree_query){.tick = OCTREE_EVERY_TICK, .kind = OCTREE_QUERY_RADIUS, .at_player = true, .radius = 450};
    queries[count++] = (octree_query){.tick = OCTREE_EVERY_TICK,
                                      .kind = OCTREE_QUERY_RAY,
                                      .target = {-950, -900, -850},
                                      .direction = {3, 3, 3},
                                      .k = 2,
                                      .thickness = 100};
    queries[count++] = (octree_query){.tick = OCTREE_EVERY_TICK,
                                      .kind = OCTREE_QUERY_SWEEP,
                                      .target = {-900, 800, 900},
                                      .to = {900, 700, 600},
                                      .half = {90, 150, 200},
                                      .k = 2};
    queries[count++] =
        (octree_query){.tick = OCTREE_EVERY_TICK,
                       .kind = OCTREE_QUERY_FRUSTUM,
                       .frustum = {{{{-1, 0, 0}, 100}, {{2, 1, 0}, 900}, {{-1, 2, 1}, 1100}, {{0, -1, 3}, 1500}}, 4}};
    queries[count++] = (octree_query){.tick = OCTREE_EVERY_TICK,
                                      .kind = OCTREE_QUERY_NEAREST,
                                      .target = {-400, 800, 200},
                                      .answered = true,
                                      .answer = far_answer,
                                      .answer_count = 1};
    session.queries = queries;
    session.query_count = count;
    session.shapes = all_shapes;
    session.shape_count = sizeof all_shapes / sizeof all_shapes[0];
    return session;
}

octree_session session_with_all_layers(void)
{
    static octree_game_body bodies[32];
    return make_session_with_all_layers(bodies);
}

octree_session session_of_points_with_all_layers(void)
{
    static octree_game_body bodies[32];
    octree_session session = make_session_with_all_layers(bodies);
    for (size_t i = 0; i < session.body_count; i++)
        memset(bodies[i].half, 0, sizeof bodies[i].half);
    session.pairs = false;
    return session;
}

static void scale_positions(double (*positions)[3], size_t count, double scale, double offset)
{
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            positions[i][axis] = positions[i][axis] * scale + offset;
}

void scale_session(scaled_session *made, double scale, double offset)
{
    made->session = octree_session_default();
    octree_session *session = &made->session;
    assert_true(session->body_count <= SCALED_SESSION_ROOM && session->query_count <= SCALED_SESSION_ROOM);
    memcpy(made->bodies, session->bodies, session->body_count * sizeof *session->bodies);
    memcpy(made->queries, session->queries, session->query_count * sizeof *session->queries);
    session->bodies = made->bodies;
    session->queries = made->queries;
    for (size_t i = 0; i < session->body_count; i++)
        scale_positions(&made->bodies[i].position, 1, scale, offset);
    for (size_t i = 0; i < session->query_count; i++) {
        octree_query *query = &made->queries[i];
        const double base = query->at_player ? 0 : offset;
        scale_positions(&query->box.min, 1, scale, base);
        scale_positions(&query->box.max, 1, scale, base);
        scale_positions(&query->target, 1, scale, offset);
        query->radius *= scale;
    }
    scale_positions(&session->tree.world.min, 1, scale, offset);
    scale_positions(&session->tree.world.max, 1, scale, offset);
    scale_positions(&session->player.position, 1, scale, offset);
    session->player.step *= scale;
    session->player.box_size *= scale;
}

void play_tick(octree_game *game)
{
    assert_int_equal(octree_game_advance(game), OCTREE_OK);
}

void build_tick(scene *s, const view *v, const octree_game *game)
{
    build_hot_tick(s, v, game, NULL);
}

void build_hot_tick(scene *s, const view *v, const octree_game *game, const heat *h)
{
    tick_history history = {.heat = h ? *h : (heat){0}};
    assert_true(tick_scene_build(s, v, game, &history, NULL));
    assert_int_equal(s->refused, 0);
}

void build_tree(scene *s, const view *v, const octree *tree, const char *title)
{
    assert_true(tree_scene_build(s, v, tree, &(tree_subject){.title = title}));
}

scene busy_scene(int width, int height, view_camera camera)
{
    const octree_session session = octree_session_default();
    const view v = view_of(width, height, camera, VIEW_ALL_LAYERS);
    octree_game *game = start_game(&session);
    scene s = {0};
    for (int tick = 0; tick < 30; tick++)
        play_tick(game);
    build_tick(&s, &v, game);
    octree_game_destroy(game);
    return s;
}

void pixel_of(const scene *s, const double position[3], double pixel[2])
{
    double seen[3];
    camera_transform(&s->camera, position, seen);
    camera_project(&s->camera, seen, pixel);
}
