/* SPDX-License-Identifier: MIT */
/* scenes.h - scenes for tests: built by hand, from games, and from scaled and translated games. */
#ifndef SCENES_H
#define SCENES_H

#include "fixture.h"
#include "game_fixture.h"
#include "layer.h"
#include "tick_scene.h"
#include "recording_file.h"

/* A view with these layers. */
view view_of(int width, int height, view_camera camera, unsigned layers);

/* An empty scene of a world, without a panel; the camera that follows looks at the world's centre. */
scene empty_scene(const view *v, const octree_box *world);

/* The default session with additional queries for nearest points and a ball at every tick, a moving body, a shape of
 * each kind, and a wrong answer of a foreign index: it shows every layer. */
octree_session session_with_all_layers(void);

/* The same session without extents and pairs. */
octree_session session_of_points_with_all_layers(void);

/* The default session with every coordinate and length multiplied by `scale`, then moved by `offset`. The structure
 * must not be moved. */
#define SCALED_SESSION_ROOM 16
typedef struct scaled_session {
    octree_session session;
    octree_game_body bodies[SCALED_SESSION_ROOM];
    octree_query queries[SCALED_SESSION_ROOM];
} scaled_session;

void scale_session(scaled_session *made, double scale, double offset);

/* Play the session's next tick; the test fails if the tick cannot be played. */
void play_tick(octree_game *game);

/* Fill a scene with a game's tick, without or with heat. The test fails if the scene cannot be built. */
void build_tick(scene *s, const view *v, const octree_game *game);
void build_hot_tick(scene *s, const view *v, const octree_game *game, const heat *h);

/* Fill a scene with a tree and no game. The test fails if the scene cannot be built. */
void build_tree(scene *s, const view *v, const octree *tree, const char *title);

/* Tick 30 of the default session, with all layers and options. */
scene busy_scene(int width, int height, view_camera camera);

/* Find the pixel of a position that is in front of the camera. */
void pixel_of(const scene *s, const double position[3], double pixel[2]);

#endif
