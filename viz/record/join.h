/* join.h - a recording that was filmed in parts becomes whole.
 *
 * The session is played once more. Every frame must be there, whole and the one of its tick, and each line of each part
 * must be what the session makes of it; so parts of another session, view or version are found, and parts may overlap
 * where they agree. Then ticks.jsonl and index.html are written, the lines of the parts are removed, and the folder is
 * the same as if one process had filmed it. Nothing is drawn: no renderer is needed.
 */
#ifndef RECORD_JOIN_H
#define RECORD_JOIN_H

#include "film.h"

/* Join the parts in options->folder, and read the rest of the options from there; progress, keep_going and context are
 * the caller's. Stopped, it changes nothing, and summary->ticks is below its total. False where anything is missing,
 * which the sentence names, or wrong. */
bool join_parts(film_options *options, film_summary *summary, octreel_error *error);

#endif
