/* SPDX-License-Identifier: MIT */
/* filmed_scenes.h - the scenes that octreel-bench records, and the goals of its table. */
#ifndef BENCH_FILMED_SCENES_H
#define BENCH_FILMED_SCENES_H

#include "octree/game.h"
#include "view.h"

typedef struct filmed_scene {
    const char *name, *about;
    size_t points; /* clustered, capacity 8; 0 is the default session */
    view_camera camera;
    double lod;          /* pixels */
    uint64_t budget;     /* boxes and points a frame; 0 is any number */
    double least_times;  /* the goal in frames a second: so many times the naive way's; 0 is none */
    double least_fps;    /* the same as a number */
    double first_ms;     /* the goal for the first frame, */
    double mib;          /* and that for memory; 0 is none */
    int shorter;         /* it is filmed for so many times fewer frames */
    int naive_shorter;   /* and by the naive way for so many times fewer again */
    double page_fps;     /* the goal of its page in frames a second; 0: its page is not measured */
    uint64_t page_ticks; /* of the page's session; 0 is as many as frames are drawn */
    double page_kb;      /* the goal for the page's size; 0 is none */
    double scrub_ms;     /* the goal for going to any tick; 0 is none */
    size_t asked;        /* it is filmed with so many queries a tick, too, answered and not; 0: it is not */
} filmed_scene;

#define FILMED_SCENES 5
extern const filmed_scene filmed_scenes[FILMED_SCENES];

/* The goal for the first frame of every page. */
#define GOAL_FIRST_MS 300.0
#define GOAL_PAGE_MIB 300.0

/* The goal for what judging the answers adds to a frame, as a share of a frame without queries. */
#define GOAL_CHECKED 1.03 /* a frame of a checked recording, as a multiple of one without checks */
#define GOAL_JUDGING 0.3

/* The view of a scene: 1280 x 720, text on. The naive way leaves nothing out. */
view filmed_view(const filmed_scene *scene);
view filmed_whole_view(const filmed_scene *scene);

typedef struct filmed_session {
    octree_session session;
    octree_body *bodies;
    char *keys;
    octree_query *queries;
    uint64_t *answers;
} filmed_session;

/* A session of so many ticks, tick 0 included, in which the player flies, and a program asks so many queries of all
 * kinds a tick, at places near its points, and, where that is wanted, answers them rightly. False when there is no
 * memory. */
bool filmed_session_make(filmed_session *made, const filmed_scene *scene, uint64_t ticks, size_t asked, bool answered);
void filmed_session_release(filmed_session *made);

#endif
