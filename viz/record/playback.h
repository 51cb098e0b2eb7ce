/* SPDX-License-Identifier: MIT */
/* playback.h - plays a session and makes a scene, a frame and a line of ticks.jsonl from each tick.
 *
 *   playback p;
 *   bool ok = playback_open(&p, session, values, &view, &error) && playback_open_picture(&p, &target, &error) &&
 *             playback_run(&p, &(film_share){.last = ticks}, sink, context, NULL, &error);
 *   playback_close(&p);
 *
 * Every frame of Octreel is made here: frames of recordings by one or several processes, of programs that record
 * themselves, and of octreel verify. If playback_open_picture() is not called, ticks are played and nothing is drawn.
 */
#ifndef RECORD_PLAYBACK_H
#define RECORD_PLAYBACK_H

#include "frame_checks.h"
#include "frame_file.h"
#include "point_values.h"
#include "scene.h"
#include "tick_scene.h"
#include "ticks_write.h"
#include "watcher.h"

#include <stdatomic.h>

typedef enum playback_frames {
    FRAMES_SHOW,  /* draw frames into playback.picture, but write no files */
    FRAMES_WRITE, /* draw frames and write them into the folder */
    FRAMES_KEEP,  /* keep existing frame files that are complete and correct; draw and write all other frames */
} playback_frames;

/* The ticks first to last - 1 of a session. If `claims` is not null, several jobs film these ticks, and this job has
 * the number `index`. A job films each frame that no other job has claimed, and the ticks up to the next frame. */
typedef struct film_share {
    uint64_t first, last;
    unsigned index;
    /* One byte for each frame, in memory that all jobs share: 1 if a job has claimed the frame. The first byte belongs
     * to the frame of the tick `first`, or to the last frame before this tick. */
    atomic_uchar *claims;
} film_share;

/* Returns the number of frames of a share, which is the number of its claims. */
uint64_t share_count_frames(const film_share *share, uint64_t every);

/* The choice of the ticks that have frames, and of the folder into which frames are written. */
typedef struct playback_target {
    playback_frames frames;
    const char *folder; /* the folder for frames; not used with FRAMES_SHOW */
    uint64_t every;     /* ticks 0, every, 2 * every ... have a frame unless the tick is a gap; 0: no frames */
    renderer_choice renderer;
} playback_target;

typedef struct playback {
    view view; /* the view, with its camera and scales fitted to tick 0 */
    octree_game *game;
    const point_values *values; /* values of the session's points; may be null */
    /* Not null: the session is a cloud, and its scenes show a tree without a game. The answers and values of the
     * subject are not read. Not owned. */
    const tree_subject *cloud;
    tick_history history; /* history of all ticks played so far */
    scene scene;
    playback_target target;
    film_share share;           /* the share of the ticks that playback_run() films */
    uint64_t claimed;           /* one more than the number of the last frame that the job tried to claim */
    bool owns_claimed;          /* true: the job films that frame */
    frame_checks checks;        /* the result of the frame checks; used with DRAW_FILL_CHECKED */
    char unchecked[FRAME_NAME]; /* if the frame in playback.picture is not yet checked: its name; otherwise "" */
    /* Digest of session.json, written into frames; set by the caller or by learn_session(). */
    uint64_t session_digest;
    /* A function that sets the session digest; called before the first frame is written; may be null. */
    void (*learn_session)(uint64_t *digest, void *context);
    void *learn_context;
    picture picture;
    tick_extras extras;
    char *line;
} playback;

/* The result of playback_film_tick() for one tick. */
typedef struct film_step {
    uint64_t tick;
    unsigned events;      /* events of the tick, as bits of octree_event */
    size_t refusals;      /* number of refused points, edits and steps */
    bool foreign_nodes;   /* the tick shows the nodes of a foreign index */
    bool gap;             /* the tick is a gap: its content is unknown, so it has no data */
    bool filmed;          /* the tick has a frame */
    bool kept;            /* the frame existed already and was correct, so it was not drawn */
    unsigned over_budget; /* kinds of elements that the view's budget left out, as bits LEFT_OUT_* of scene.h */
    /* Kinds of elements left out because they are smaller than the view's lod, as bits LEFT_OUT_* of scene.h. */
    unsigned below_lod;
    /* Number of elements that could not be drawn, because a coordinate is not finite or overflows a double. */
    uint64_t left_out;
    const char *line; /* line of ticks.jsonl, with its newline; valid until the next tick is filmed */
    size_t size;
} film_step;

/* Play tick 0. A session or a view that cannot be drawn is an error before any file changes. `values` are the values of
 * the session's points; they may be null and must outlive the playback. Call playback_close() after a failure too. */
bool playback_open(playback *p, const octree_session *session, const point_values *values, const view *v,
                   octreel_error *error);
void playback_close(playback *p);

/* Open the picture into which frames are drawn. Does nothing if the target has no frames. */
bool playback_open_picture(playback *p, const playback_target *target, octreel_error *error);

/* Play the next tick. playback_advance() uses the input that the session has for the tick; playback_play_input() uses
 * the caller's input. */
bool playback_advance(playback *p, octreel_error *error);
bool playback_play_input(playback *p, const octree_input *input, octreel_error *error);

/* Make the scene of the last played tick in p->scene. */
bool playback_compose_scene(playback *p, octreel_error *error);

/* Make the scene, the frame and the line of ticks.jsonl for the last played tick. */
bool playback_film_tick(playback *p, film_step *step, octreel_error *error);

/* Check the last drawn frame, unless it was checked already. A live recording calls this function when it is closed,
 * because only then the last frame is known. That frame has been written before. */
bool playback_check_last_frame(playback *p, octreel_error *error);

/* A function that is called for each tick of a share, in order. If it returns false, playback_run() ends and returns
 * false. */
typedef bool film_sink(void *context, const film_step *step, octreel_error *error);

/* Play to the end of a share and film its ticks. `watch` may be null. keep_going() of the watcher is called after each
 * tick; progress() is not called. If keep_going() returns false, the run ends early and returns true. */
bool playback_run(playback *p, const film_share *share, film_sink *sink, void *context, const watcher *watch,
                  octreel_error *error);

#endif
