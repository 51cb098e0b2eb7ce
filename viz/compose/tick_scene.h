/* SPDX-License-Identifier: MIT */
/* tick_scene.h - composes the scene of a tick of a game, or of a tree, from the layers that the view shows. */
#ifndef COMPOSE_TICK_SCENE_H
#define COMPOSE_TICK_SCENE_H

#include "closeup_course.h"
#include "heat.h"
#include "node_changes.h"
#include "octree/game.h"
#include "point_values.h"
#include "scene.h"
#include "velocity_layer.h"

/* The panel shows the key presses of this many ticks before and after its own tick. */
enum { KEYS_BEHIND = 5, KEYS_AHEAD = 6 };

/* The result of octree_check() for the tree of a tick. */
typedef struct tick_check {
    bool done;
    const char *broken; /* a sentence about the first violated invariant; null: no invariant is violated */
    octree_address where;
} tick_check;

/* The facts of all ticks up to a scene's tick that the scene needs. All members are 0 before tick 0. */
typedef struct tick_history {
    heat heat; /* number of visits and points of leaves so far; empty if the view shows no heat layer */
    closeup_course closeup;
    node_changes changes; /* empty unless changes.tracked is set at tick 0 */
    /* Results that are kept because the scene of one tick may be built for many cameras. `built` is this tick, and
     * `state` is a number that names the state of the tick's tree; 0: no scene was built yet. */
    uint64_t built, state;
    tick_check check;
    arrow_counts arrows;
} tick_history;

void tick_history_release(tick_history *h);

/* Add the game's last tick to the history, unless it is a gap. Return false if memory runs out. */
bool tick_history_add(tick_history *h, const view *v, const octree_game *game);

/* Build the scene of the last tick of a game. `h` is the history up to that tick or up to the previous tick; if `h` is
 * null, the heat layers have no elements. `values` may be null. Return false if memory runs out. */
bool tick_scene_build(scene *s, const view *v, const octree_game *game, tick_history *h, const point_values *values);

/* The things that a scene of a tree shows in addition to the tree's nodes and points. */
typedef struct tree_subject {
    const char *title;
    octree_address node; /* the node that is marked in the scene, and to which the diagram shows the path; 0: none */
    const octree_answer *answers;
    size_t answer_count;
    const point_values *values; /* colours, classes and intensities of the tree's points; may be null */
    /* keeps results between calls, for a tree whose scene is built for many cameras while the tree does not change;
     * may be null */
    tick_history *history;
} tree_subject;

/* Build the scene of a tree without a game. Return false if memory runs out. */
bool tree_scene_build(scene *s, const view *v, const octree *tree, const tree_subject *subject);

#endif
