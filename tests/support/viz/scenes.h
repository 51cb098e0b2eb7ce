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

/* The default session with every coordinate and length times `scale`, then moved by `offset`. It must stay where it
 * was made. */
#define SCALED_SESSION_ROOM 16
typedef struct scaled_session {
    octree_session session;
    octree_game_body bodies[SCALED_SESSION_ROOM];
    octree_query queries[SCALED_SESSION_ROOM];
} scaled_session;

void scale_session(scaled_session *made, double scale, double offset);

/* Play the session's next tick; the test fails when that fails. */
void play_tick(octree_game *game);

/* Fill a scene with a game's tick, or the test fails; without heat, and with it. */
void build_tick(scene *s, const view *v, const octree_game *game);
void build_hot_tick(scene *s, const view *v, const octree_game *game, const heat *h);

/* Fill a scene with a tree alone, or the test fails. */
void build_tree(scene *s, const view *v, const octree *tree, const char *title);

/* Tick 30 of the default session, with all layers and options. */
scene busy_scene(int width, int height, view_camera camera);

/* The pixel of a position that is before the camera. */
void pixel_of(const scene *s, const double position[3], double pixel[2]);

#endif
