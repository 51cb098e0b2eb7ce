/* SPDX-License-Identifier: MIT */
/* session_filmer.h - a thread that records the ticks of a queue. The ticks of a ring are passed to the thread in a
 * queue when the program requests a recording.
 *
 * The thread does not disturb the program: it blocks all signals, uses the default floating-point mode, and does not
 * touch the program's GL context. Private to viz/embed. */
#ifndef EMBED_SESSION_FILMER_H
#define EMBED_SESSION_FILMER_H

#include "edit_order.h"
#include "film_options.h"
#include "live.h"
#include "queue.h"

/* The checked copy of a recorder's definition. */
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
    /* Until the queue is broken or the thread has ended, only the thread uses these members. */
    live_recording *live;
    edit_order order;
    uint64_t tick;
    octreel_status status;
    octreel_error error;
} session_filmer;

/* Start the thread. The caller must have set the members settings, folder and queue. *f must stay at its address until
 * session_filmer_join(). Errors: NO_MEMORY. */
octreel_status session_filmer_start(session_filmer *f);

/* Wait until the queue has ended and the recording is complete. Returns the first error, with its text in f->error:
 * CANNOT_DRAW, BAD_FOLDER or NO_MEMORY at tick 0, BROKEN at a later tick. */
octreel_status session_filmer_join(session_filmer *f);

#endif
