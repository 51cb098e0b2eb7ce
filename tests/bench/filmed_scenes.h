/* SPDX-License-Identifier: MIT */
/* filmed_scenes.h - the scenes that octreel-bench records, and the goals of its table. */
#ifndef BENCH_FILMED_SCENES_H
#define BENCH_FILMED_SCENES_H

#include "octree/game.h"
#include "view.h"

typedef struct filmed_scene {
    const char *name, *about;
    size_t points; /* clustered, capacity 8; 0 is the default session */
    bool moving;   /* every point has a velocity */
    bool cloud;    /* a point cloud with colours, not a game: only its page is measured */
    view_camera camera;
    double lod;           /* pixels */
    uint64_t budget;      /* boxes and points per frame; 0: any number */
    double least_times;   /* goal for frames per second, as a multiple of the naive renderer's; 0: none */
    double least_fps;     /* goal for frames per second */
    double first_ms;      /* goal for the first frame; 0: none */
    double mib;           /* goal for memory; 0: none */
    int shorter;          /* divides the number of recorded frames */
    int naive_shorter;    /* divides it once more for the naive renderer */
    double page_fps;      /* goal of its page for frames per second, tick after tick; 0: its page is not measured */
    double turn_fps;      /* the same while the view turns, for each of page_sizes */
    double page_first_ms; /* goal for the first picture of the page; 0: none */
    double page_mib;      /* goal for the memory of the page; 0: none */
    uint64_t page_ticks;  /* ticks of the page's session; 0: as many as frames are drawn */
    double page_kb;       /* goal for the page's size; 0: none */
    double scrub_ms;      /* goal for going to any tick; 0: none */
    size_t asked; /* it is also recorded with this number of queries per tick, with and without answers; 0: it is not */
} filmed_scene;

/* The sizes of the picture at which the view of a page turns. */
#define PAGE_SIZES 2
extern const int page_sizes[PAGE_SIZES][2];

/* A page whose view turns, at one of the sizes. */
typedef struct page_turning {
    double full_ms; /* a frame with all pixels, until the browser takes the next */
    double ms;      /* a frame as users see it */
    double scale;   /* the page draws this part of the pixels of an axis to be fast enough; 1: all */
} page_turning;

#define FILMED_SCENES 7
extern const filmed_scene filmed_scenes[FILMED_SCENES];

/* The goal for the additional time of comparing answers, as a share of a frame without queries. */
#define GOAL_CHECKED 1.03 /* a frame of a checked recording, as a multiple of one without checks */
#define GOAL_JUDGING 0.3

/* The view of a scene: 1280 x 720, with text. The naive renderer ignores lod and budget. */
view filmed_view(const filmed_scene *scene);
view filmed_whole_view(const filmed_scene *scene);

typedef struct filmed_session {
    octree_session session;
    octree_game_body *bodies;
    char *keys;
    octree_query *queries;
    uint64_t *answers;
} filmed_session;

/* A session with this number of ticks, with tick 0, in which the player flies. A program asks this number of queries
 * per tick, of all kinds, near its points, and answers them correctly if `answered` is set. False: out of memory. */
bool filmed_session_make(filmed_session *made, const filmed_scene *scene, uint64_t ticks, size_t asked, bool answered);
void filmed_session_release(filmed_session *made);

#endif
