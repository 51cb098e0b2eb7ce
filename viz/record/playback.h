/* SPDX-License-Identifier: MIT */
/* playback.h - plays a session and makes a scene, a frame and a line of ticks.jsonl from each tick.
 *
 *   playback p;
 *   bool ok = playback_open(&p, session, &view, &error) && playback_open_picture(&p, &target, &error) &&
 *             playback_run(&p, &(film_share){.last = ticks}, sink, context, NULL, &error);
 *   playback_close(&p);
 *
 * Every frame is made here: for recordings by one process or several, for programs that record themselves, and for
 * verify. Without playback_open_picture() ticks are played and nothing is drawn. */
#ifndef RECORD_PLAYBACK_H
#define RECORD_PLAYBACK_H

#include "frame_checks.h"
#include "frame_file.h"
#include "point_values.h"
#include "scene.h"
#include "tick_scene.h"
#include "ticks_write.h"
#include "watcher.h"

typedef enum playback_frames {
    FRAMES_SHOW,  /* draw frames into playback.picture */
    FRAMES_WRITE, /* and write them into the folder */
    FRAMES_KEEP,  /* the same, except frames whose file exists already, complete and correct */
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

/* What is done with frames. */
typedef struct playback_target {
    playback_frames frames;
    const char *folder; /* not used with FRAMES_SHOW */
    uint64_t every;     /* ticks 0, every, 2 * every ... have a frame unless they are gaps; 0: no frames */
    renderer_choice renderer;
} playback_target;

typedef struct playback {
    view view; /* fitted to tick 0 */
    octree_game *game;
    const point_values *values; /* of the session's points; may be null */
    tick_history history;       /* of all ticks played so far */
    scene scene;
    playback_target target;
    film_share share;           /* where it is known: what playback_run() films */
    frame_checks checks;        /* under DRAW_FILL_CHECKED */
    char unchecked[FRAME_NAME]; /* the frame that playback.picture shows, until it is checked; "": none */
    uint64_t session_digest;    /* of session.json, for the frames; set by the caller or by learn_session() */
    void (*learn_session)(uint64_t *digest, void *context); /* called before the first frame is written; may be null */
    void *learn_context;
    picture picture;
    tick_extras extras;
    char *line;
} playback;

/* The result of playback_film_tick(). */
typedef struct film_step {
    uint64_t tick;
    unsigned events;      /* bits of octree_event */
    size_t refusals;      /* of points, edits and steps */
    bool foreign_nodes;   /* it shows the nodes of a foreign index */
    bool gap;             /* the tick has no data: it was refused */
    bool filmed;          /* it has a frame */
    bool kept;            /* its frame existed already and was correct */
    unsigned over_budget; /* the kinds of elements left out beyond the view's budget, as bits of scene.h */
    unsigned below_lod;   /* the kinds left out because they are smaller than the view's lod */
    uint64_t left_out;    /* the number of elements that cannot be drawn */
    const char *line;     /* of ticks.jsonl, with its newline; valid until the next tick */
    size_t size;
} film_step;

/* Play tick 0. Refuses sessions and views that cannot be drawn, before any file is touched. `values`, the values of the
 * session's points, may be null and must outlive the playback. Close `p` in any case. */
bool playback_open(playback *p, const octree_session *session, const point_values *values, const view *v,
                   octreel_error *error);
void playback_close(playback *p);

/* Open the picture into which frames are drawn, if there are any. */
bool playback_open_picture(playback *p, const playback_target *target, octreel_error *error);

/* Play the next tick of the session, or a tick with input from elsewhere. */
bool playback_advance(playback *p, octreel_error *error);
bool playback_play_input(playback *p, const octree_input *input, octreel_error *error);

/* Fill p->scene with the scene of the last tick played. */
bool playback_compose_scene(playback *p, octreel_error *error);

/* Make the scene, frame and line of the last tick played. */
bool playback_film_tick(playback *p, film_step *step, octreel_error *error);

/* Check the last frame that was drawn, unless it is checked already. A live recording calls this when it is closed:
 * only then is it known which frame is the last, and that frame has been written. */
bool playback_check_last(playback *p, octreel_error *error);

/* Called for each tick of a share, in order. False ends the run. */
typedef bool film_sink(void *context, const film_step *step, octreel_error *error);

/* Play to the end of a share and film its ticks. Ends early, and returns true, when the watcher, which is asked after
 * each tick and may be null, stops it. Its progress() is not called. */
bool playback_run(playback *p, const film_share *share, film_sink *sink, void *context, const watcher *watch,
                  octreel_error *error);

#endif
