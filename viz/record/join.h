/* SPDX-License-Identifier: MIT */
/* join.h - completes a recording that was made in chunks. */
#ifndef RECORD_JOIN_H
#define RECORD_JOIN_H

#include "film_options.h"

/* Join the chunks in options->folder into one recording. Chunks may overlap. The view is read from the folder, so only
 * `folder` and `watch` of the options are used. Only `ticks`, `frames`, `gaps`, `left_out` and `total` of the summary
 * are set. If the watcher stops the join, no file changes and summary->ticks is less than summary->total. Returns false
 * with an error if a tick or a frame is missing or wrong. */
bool join_chunks(film_options *options, film_summary *summary, octreel_error *error);

#endif
