/* SPDX-License-Identifier: MIT */
/* golden_frames.h - the reference frames in golden/; each shows one thing. */
#ifndef GOLDEN_FRAMES_H
#define GOLDEN_FRAMES_H

#include "context.h"
#include "folder.h"
#include "image.h"
#include "octree/game.h"
#include "scene.h"

typedef struct golden_frame {
    const char *name; /* golden/<name>.ref.png */
    const char *camera;
    const char *layers;
    uint64_t tick;      /* of the session that `points` selects */
    const char *points; /* null: the default session; "two", "three" or "clustered": points in its world; "knearest",
                           "radius" or "answered": queries about sampled points; "swept"; "foreign": foreign nodes */
    int width, height;  /* 0: 320 x 180 */
} golden_frame;

extern const golden_frame golden_frames[];
extern const size_t golden_frame_count;

#define GOLDEN_MOST_BODIES 400

/* A game and its view. The structure must not be moved. */
typedef struct golden_play {
    octree_session session;
    octree_game_body bodies[GOLDEN_MOST_BODIES];
    view view;
    octree_game *game;
} golden_play;

/* Whether the frame shows a tick of a session. Two frames show a tree without a session: "asked", and "broken" with a
 * broken tree. */
bool golden_is_played(const golden_frame *frame);

/* Open the session of a frame at tick 0. The caller destroys the game. */
bool golden_open(const golden_frame *frame, golden_play *play, octreel_error *error);

/* Compose the scene of a frame; the caller releases *s, also on failure. */
bool golden_scene(const golden_frame *frame, scene *s, octreel_error *error);

/* Draw a frame. `renderer` receives the name of the renderer. */
bool golden_draw(const golden_frame *frame, draw_fill fill, image *drawn, char *renderer, size_t size,
                 octreel_error *error);

#endif
