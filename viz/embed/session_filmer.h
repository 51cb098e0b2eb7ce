/* SPDX-License-Identifier: MIT */
/* session_filmer.h - a thread that records the ticks of a queue, or of a ring on request.
 *
 * The thread does not disturb the program: it blocks all signals, uses the default floating-point mode, and leaves the
 * program's GL context alone. Private to this folder. */
#ifndef EMBED_SESSION_FILMER_H
#define EMBED_SESSION_FILMER_H

#include "edit_order.h"
#include "film_options.h"
#include "live.h"
#include "queue.h"

/* A recorder's definition, checked and copied. */
typedef struct filmer_settings {
    octree_def tree; /* with the options in force */
    octree_player player;
    film_options film; /* the folder is not set */
} filmer_settings;

typedef struct session_filmer {
    const filmer_settings *settings;
    const char *folder;
    queue *queue; /* its first batch inserts the points at the start */
    pthread_t thread;
    /* Used by the thread alone until the queue is broken or the thread has ended. */
    live_recording *live;
    edit_order order;
    uint64_t tick;
    octreel_status status;
    octreel_error error;
} session_filmer;

/* Start the thread. The caller sets settings, folder and queue, and keeps *f in place until
 * session_filmer_join(). Errors: NO_MEMORY. */
octreel_status session_filmer_start(session_filmer *f);

/* Wait until the queue has ended and the recording is complete. Returns the first error, with its text in f->error: at
 * the first tick CANNOT_DRAW, BAD_FOLDER or NO_MEMORY, later BROKEN. */
octreel_status session_filmer_join(session_filmer *f);

#endif
