/* film_live.h - a session that is being made becomes a recording: each tick is drawn and written when it is there, and
 * what it is like is written last. The recording is that of film_session() with the session that came out.
 *
 * While it goes on, what is known of the session is in session.json.live, a session file too: when the process dies,
 * nothing but the tick in hand is lost, and octreel record --resume makes a recording of the others. One thread films,
 * from open to close.
 */
#ifndef RECORD_FILM_LIVE_H
#define RECORD_FILM_LIVE_H

#include "film.h"

typedef struct film_live film_live;

/* Begin with tick 0: of the session its start, and what it asks and shows at tick 0 or at every tick, is played; it has
 * no keys and no edits. All that is given is copied. Null, and a sentence, on failure; then *drawn tells whether there
 * is what draws it, so that the folder is to blame. Of the options, part, jobs and resume are not read. */
film_live *film_live_open(const octree_session *start, const film_options *options, bool *drawn, octreel_error *error);

/* Film the next tick. After a failure only film_live_close() is left. */
bool film_live_tick(film_live *film, const octree_input *input, octreel_error *error);

/* Write what comes last: session.json with all ticks that were taken, and the page. Where a tick failed, the files are
 * those of a recording that broke off, which --resume completes. False, and a sentence, when that cannot be written. */
bool film_live_close(film_live *film, octreel_error *error);

#endif
