/* SPDX-License-Identifier: MIT */
/* session_filmer.h - a thread that records the ticks of a queue, or of a ring on request.
 *
 * The thread does not disturb the program: it blocks all signals, uses the default floating-point mode, and does not
 * touch the program's GL context. Private to viz/embed. */
#ifndef EMBED_SESSION_FILMER_H
#define EMBED_SESSION_FILMER_H

#include "edit_order.h"
#include "film_options.h"
#include "live.h"
#include "queue.h"

/* The definition of a recorder after it was checked and copied. */
typedef struct filmer_settings {
    octree_def tree; /* the tree's definition with its defaults filled in */
    octree_player player;
    film_options film; /* the options of the recording; film.folder is not set */
} filmer_settings;

typedef struct session_filmer {
    const filmer_settings *settings;
    const char *folder;
    queue *queue; /* the ticks to record; the first batch inserts the points of tick 0 */
    pthread_t thread;
    /* Only the thread uses these members until the queue is broken or the thread has ended. */
    live_recording *live;
    edit_order order;
    uint64_t tick;
    octreel_status status;
    octreel_error error;
} session_filmer;

/* Start the thread. Before, the caller sets the members settings, folder and queue. *f must not move in memory until
 * session_filmer_join(). Errors: NO_MEMORY. */
octreel_status session_filmer_start(session_filmer *f);

/* Wait until the queue has ended and the recording is complete. Returns the first error, and its text in f->error:
 * CANNOT_DRAW, BAD_FOLDER or NO_MEMORY at the first tick, BROKEN later. */
octreel_status session_filmer_join(session_filmer *f);

#endif
