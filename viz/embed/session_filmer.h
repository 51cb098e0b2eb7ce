/* SPDX-License-Identifier: MIT */
/* session_filmer.h - a thread that films ticks as a program handed them over: those of a queue as they come, those of a
 * ring when they are wanted.
 *
 * The thread leaves the program's alone: its signals go to others, its floating-point mode is the default, and what GL
 * context the program has is not its own. Private to this folder. */
#ifndef EMBED_SESSION_FILMER_H
#define EMBED_SESSION_FILMER_H

#include "edit_order.h"
#include "film_options.h"
#include "live.h"
#include "queue.h"

/* The definition of a recorder, checked and copied. */
typedef struct filmer_settings {
    octree_def tree; /* as a tree of it has it in force */
    octree_player player;
    film_options film; /* without a folder */
} filmer_settings;

typedef struct session_filmer {
    const filmer_settings *settings;
    const char *folder;
    const points *start; /* at the first tick, whose batch has no changes then; null: there are none before it */
    queue *queue;
    pthread_t thread;
    /* The thread's, until the queue is broken or the thread has ended. */
    live_recording *live;
    edit_order order;
    uint64_t tick;
    octreel_status status;
    octreel_error error;
} session_filmer;

/* Start to film what comes through a queue; the four members above are set, and *f stays where it is until
 * session_filmer_join(). Errors: NO_MEMORY. */
octreel_status session_filmer_start(session_filmer *f);

/* Wait until the queue has ended, all of it is filmed, and the recording is complete. Errors, the first that there was,
 * with the sentence in f->error: of the first tick CANNOT_DRAW, BAD_FOLDER and NO_MEMORY, then BROKEN. */
octreel_status session_filmer_join(session_filmer *f);

#endif
