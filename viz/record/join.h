/* SPDX-License-Identifier: MIT */
/* join.h - a recording that was filmed in chunks becomes whole.
 *
 * Each tick must have its line in a chunk, and each frame must be there, whole, and of its tick, of the scene that the
 * line names and of the folder's session; so chunks of another session, view or version are found. Then ticks.jsonl and
 * index.html are written, the lines of the chunks are removed, and the folder is the same as if one process had filmed
 * it. Nothing is played or drawn: that the lines are what the session makes of them is for octreel verify to say. */
#ifndef RECORD_JOIN_H
#define RECORD_JOIN_H

#include "film_options.h"

/* Join the chunks in options->folder, and read the view from there; progress, keep_going and context are the caller's.
 * Chunks may overlap. Of the summary only ticks, frames, left_out and total are set. Stopped, it changes nothing, and
 * summary->ticks is below its total. False with an error where anything is missing or wrong. */
bool join_chunks(film_options *options, film_summary *summary, octreel_error *error);

#endif
