/* SPDX-License-Identifier: MIT */
/* join.h - completes a recording that was made in chunks. */
#ifndef RECORD_JOIN_H
#define RECORD_JOIN_H

#include "film_options.h"

/* Join the chunks in options->folder, which may overlap. The view is read from the folder; of the options only folder
 * and watch are used. Of the summary only ticks, frames, gaps, left_out and total are set. A
 * join that is stopped changes nothing, and summary->ticks is below summary->total. False with an error where a tick or
 * a frame is missing or wrong. */
bool join_chunks(film_options *options, film_summary *summary, octreel_error *error);

#endif
