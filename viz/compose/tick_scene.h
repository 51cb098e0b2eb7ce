/* SPDX-License-Identifier: MIT */
/* tick_scene.h - composes the scene of a tick of a game, or of a tree, from the layers that the view shows. */
#ifndef COMPOSE_TICK_SCENE_H
#define COMPOSE_TICK_SCENE_H

#include "closeup_course.h"
#include "heat.h"
#include "octree/game.h"
#include "point_values.h"
#include "scene.h"

/* A tick's panel shows the keys of this many ticks before and after its own. */
enum { KEYS_BEHIND = 5, KEYS_AHEAD = 6 };

/* The state that a scene needs from all ticks up to its own. All zero before tick 0. */
typedef struct tick_history {
    heat heat; /* empty unless the view shows a heat layer */
    closeup_course closeup;
} tick_history;

void tick_history_release(tick_history *h);

/* Add the game's last tick, unless it is a gap. Return false when there is no memory. */
bool tick_history_add(tick_history *h, const view *v, const octree_game *game);

/* Fill a scene with the last tick of a game. h is the history up to this tick or up to the tick before; null leaves the
 * heat layers empty. `values` may be null. Return false when there is no memory. */
bool tick_scene_build(scene *s, const view *v, const octree_game *game, const tick_history *h,
                      const point_values *values);

/* The things that a scene shows of a tree in addition to its nodes and points. */
typedef struct tree_subject {
    const char *title;
    octree_address node; /* the node to mark; the diagram shows the path to it; 0: none */
    const octree_answer *answers;
    size_t answer_count;
    const point_values *values; /* colours, classes and intensities of its points; may be null */
} tree_subject;

/* Fill a scene with a tree alone. Return false when there is no memory. */
bool tree_scene_build(scene *s, const view *v, const octree *tree, const tree_subject *subject);

#endif
