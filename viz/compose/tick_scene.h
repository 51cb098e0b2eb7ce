/* SPDX-License-Identifier: MIT */
/* tick_scene.h - builds the scene of a tree, or of a tick of a game, with the layers that its view shows. */
#ifndef COMPOSE_TICK_SCENE_H
#define COMPOSE_TICK_SCENE_H

#include "closeup_course.h"
#include "heat.h"
#include "octree/game.h"
#include "point_values.h"
#include "scene.h"

/* A tick's panel has the keys of so many ticks before its own, and after it. */
enum { KEYS_BEHIND = 5, KEYS_AHEAD = 6 };

/* What the ticks up to one leave behind for its scene. All zero: before tick 0. */
typedef struct tick_history {
    heat heat; /* where the view shows it */
    closeup_course closeup;
} tick_history;

void tick_history_release(tick_history *h);

/* Add the game's last tick, unless it is a gap. False when there is no memory. */
bool tick_history_add(tick_history *h, const view *v, const octree_game *game);

/* Fill a scene with the last tick of a game, as seen by a view. h is the history up to this tick, or up to the one
 * before; null stands for none, which leaves the heat layers empty. The values of points may be null. False when there
 * is no memory. */
bool tick_scene_build(scene *s, const view *v, const octree_game *game, const tick_history *h,
                      const point_values *values);

/* What is shown of a tree in addition to its nodes and points. */
typedef struct tree_subject {
    const char *title;
    octree_address node; /* it is marked, and the diagram shows the path to it; 0: none */
    const octree_answer *answers;
    size_t answer_count;
    const point_values *values; /* of its points; may be null */
} tree_subject;

/* Fill a scene with a tree alone. False when there is no memory. */
bool tree_scene_build(scene *s, const view *v, const octree *tree, const tree_subject *subject);

#endif
