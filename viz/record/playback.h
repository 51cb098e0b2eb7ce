/* SPDX-License-Identifier: MIT */
/* playback.h - a session played: each of its ticks becomes a scene, a frame and a line of ticks.jsonl.
 *
 *   playback p;
 *   bool ok = playback_open(&p, session, &view, &error) && playback_film(&p, &target, &error) &&
 *             playback_run(&p, &(film_share){.last = ticks}, sink, NULL, context, &error);
 *   playback_close(&p);
 *
 * This is the only way from a tick to a frame: of a recording by one process or by several, of a program that records
 * itself, and of a recording that is verified. Without playback_film() ticks are played and nothing is drawn. */
#ifndef RECORD_PLAYBACK_H
#define RECORD_PLAYBACK_H

#include "frame_checks.h"
#include "frame_file.h"
#include "point_values.h"
#include "scene.h"
#include "tick_scene.h"
#include "ticks_write.h"

typedef enum playback_frames {
    FRAMES_SHOW,  /* a frame is drawn into playback.picture */
    FRAMES_WRITE, /* and written into the folder */
    FRAMES_KEEP,  /* the same, unless the file is there already, whole and of this tick */
} playback_frames;

/* The ticks [first, last) of a session. With a count, only the frames that share_has_frame() gives to the job `index`,
 * each with the ticks up to the next frame. */
typedef struct film_share {
    uint64_t first, last;
    uint64_t index, count;
} film_share;

/* The number of the job, of share->count, that films a frame; `frame` is its tick divided by `every`. Job 0 films the
 * frames that are checked, so that one process alone loads GL. */
uint64_t share_find_job(const film_share *share, uint64_t frame, uint64_t every);

/* What becomes of the ticks that are filmed. */
typedef struct playback_target {
    playback_frames frames;
    const char *folder; /* not read by FRAMES_SHOW */
    uint64_t every;     /* ticks 0, every, 2 * every ... have a frame, but for gaps; 0: none has */
    renderer_choice renderer;
} playback_target;

typedef struct playback {
    view view; /* fitted to tick 0 */
    octree_game *game;
    const point_values *values; /* of the session's points; may be null */
    tick_history history;       /* of all ticks that were played, filmed or not */
    scene scene;
    playback_target target;
    film_share share;           /* where it is known: what playback_run() films */
    frame_checks checks;        /* under DRAW_FILL_CHECKED */
    char unchecked[FRAME_NAME]; /* the frame that playback.picture shows, until it is checked; "": none */
    uint64_t session_digest;    /* of session.json, for the frames that are written; set by the caller, */
    void (*learn_session)(uint64_t *digest, void *context); /* or by this before the first is written; may be null */
    void *learn_context;
    picture picture;
    tick_extras extras;
    char *line;
} playback;

/* A tick that was filmed. */
typedef struct film_step {
    uint64_t tick;
    unsigned events;      /* bits of octree_event */
    size_t refusals;      /* of points, edits and steps */
    bool program_nodes;   /* a program has said nodes of its own by then */
    bool gap;             /* nothing is known of it */
    bool filmed;          /* it has a frame, */
    bool kept;            /* and had the right one already */
    unsigned over_budget; /* what that leaves out beyond the view's budget, as bits of scene.h, */
    unsigned below_lod;   /* or smaller than its lod */
    uint64_t left_out;
    const char *line; /* of ticks.jsonl, its newline included; until the next tick is filmed */
    size_t size;
} film_step;

/* Play tick 0. Sessions and views that cannot be filmed are refused here, before any file is touched. The values of the
 * session's points may be null, and stay the caller's. `p` is set in any case, to be closed. */
bool playback_open(playback *p, const octree_session *session, const point_values *values, const view *v,
                   octreel_error *error);
void playback_close(playback *p);

/* Open what draws the ticks to be filmed, if any. */
bool playback_film(playback *p, const playback_target *target, octreel_error *error);

/* Play the next tick of the session, or one that is not in it. */
bool playback_advance(playback *p, octreel_error *error);
bool playback_play(playback *p, const octree_input *input, octreel_error *error);

/* Fill playback.scene with the tick that was played last. */
bool playback_scene(playback *p, octreel_error *error);

/* Film that tick: its scene and its frame, where it has one, and its line. */
bool playback_tick(playback *p, film_step *step, octreel_error *error);

/* Check the last frame that was drawn, unless it is checked already: where filming ends at a tick that nobody could
 * foresee, this comes after the frame is written. */
bool playback_check_last(playback *p, octreel_error *error);

/* What is done with each tick of a share, in order. False ends the run. */
typedef bool film_sink(void *context, const film_step *step, octreel_error *error);

/* Play on to the end of a share and film its ticks. Ends early, and true, when keep_going(), which is called
 * after each tick and may be null, returns false. */
bool playback_run(playback *p, const film_share *share, film_sink *sink, bool (*keep_going)(void *context),
                  void *context, octreel_error *error);

#endif
