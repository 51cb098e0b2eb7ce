/* job_link.h - what the processes of one recording tell each other. Private to this folder.
 *
 * A job says that it is ready, hears the digest of the session, and then tells its steps; or it tells an error. It
 * goes on until who started it says nothing more.
 */
#ifndef RECORD_JOB_LINK_H
#define RECORD_JOB_LINK_H

#include "playback.h"

typedef enum message_kind {
    MESSAGE_READY,
    MESSAGE_STEP,
    MESSAGE_ERROR,
    MESSAGE_NONE /* the job has ended */
} message_kind;

/* What job 0 knows when it is ready: the view, fitted to tick 0, and who draws. */
typedef struct job_ready {
    view view;
    char context[64], vendor[256], renderer[256], version[256];
} job_ready;

typedef struct message {
    message_kind kind;
    film_step step; /* of MESSAGE_STEP: its line is in `bytes` */
    size_t size;
    char *bytes; /* job_ready, the line, or octreel_error; owned */
} message;

/* Make the two ends of a link. */
bool link_open(int ends[2], octreel_error *error);

/* Tell a message, or any bytes. False when nobody hears it any more. */
bool link_tell_message(int link, message_kind kind, const film_step *step, const void *bytes, size_t size);
bool link_tell(int link, const void *bytes, size_t size);

/* Say that there is nothing more to tell; what the other end tells is still heard. */
void link_end(int link);

/* Hear a message, whose bytes take the place of those that are there. */
void link_hear_message(int link, message *m);

/* Hear exactly so many bytes. False when the other end has nothing more to tell. */
bool link_hear(int link, void *bytes, size_t size);

/* Whether within so many milliseconds there is something to hear, or that there is nothing more. */
bool link_stirs(int link, int milliseconds);

#endif
