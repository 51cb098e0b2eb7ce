/* take.h - a session played, and what a recording has of each tick: its frame and its line. What plays a recording
 * again, see replay.h, has one too. */
#ifndef RECORD_TAKE_H
#define RECORD_TAKE_H

#include "film.h"
#include "heat.h"
#include "picture.h"
#include "ticks_write.h"

/* What becomes of the frame of a tick. */
typedef enum take_frames {
    FRAMES_DRAW,  /* it is drawn */
    FRAMES_KEEP,  /* it is drawn, unless it is there already, whole and right */
    FRAMES_CHECK, /* it must be there, whole and right; there is no renderer */
    FRAMES_CLAIM, /* where it is there it must say that it is this one, see frame_claim(); there is no renderer */
    FRAMES_SHOW,  /* it is drawn, and stays in take.picture */
} take_frames;

typedef struct take {
    const film_options *options;
    view view; /* that of the options, fitted to tick 0 */
    take_frames frames;
    uint64_t session_digest; /* of session.json; to be set before the first tick is taken */
    octree_game *game;
    heat heat; /* of all ticks that were played, whether they are taken or not; where the view shows it */
    picture picture;
    scene scene;
    tick_extras extras;
    char *line;
} take;

/* A tick that was taken. */
typedef struct film_step {
    uint64_t tick;
    unsigned events;  /* bits of octree_event */
    bool filmed;      /* it has a frame */
    bool over_budget; /* which leaves out what is beyond the view's budget */
    uint64_t left_out;
    const char *line; /* of ticks.jsonl, its newline included; until the next tick is taken */
    size_t size;
} film_step;

/* Start a session and open what draws it. Every session and view that cannot be filmed is refused here, before any file
 * is touched. */
bool take_open(take *t, const octree_session *session, const film_options *options, take_frames frames,
               octreel_error *error);
void take_close(take *t);

/* Make take.scene of the tick at which the game is, as the view shows it. */
bool take_scene(take *t, octreel_error *error);

/* Take that tick: its scene and its frame, where it has one, and its line. */
bool take_tick(take *t, film_step *step, octreel_error *error);

/* Play the next tick; and one that is not in the session. */
bool take_advance(take *t, octreel_error *error);
bool take_play(take *t, const octree_input *input, octreel_error *error);

/* The ticks [first, last) of a session; where a count is given, of each `count` frames, with the ticks up to the next
 * one, only that of this index. */
typedef struct film_share {
    uint64_t first, last;
    uint64_t index, count;
} film_share;

/* What is done with each tick of a share, in their order. */
typedef bool film_sink(void *context, const film_step *step, octreel_error *error);

/* Play on to the end of a share and take its ticks. Ends early, and true, where options->keep_going says so. */
bool film_ticks(take *t, const film_share *share, film_sink *sink, void *context, octreel_error *error);

#endif
