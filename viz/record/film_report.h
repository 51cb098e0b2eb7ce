/* SPDX-License-Identifier: MIT */
/* film_report.h - the summary printed after filming. */
#ifndef RECORD_FILM_REPORT_H
#define RECORD_FILM_REPORT_H

#include "film_options.h"

#include <stdio.h>

/* "nodes, points and velocity arrows", for bits LEFT_OUT_* of scene.h. Returns `text`. */
#define FILM_LEFT_OUT 48
const char *film_left_out_text(unsigned left_out, char text[FILM_LEFT_OUT]);

/* Print a few lines for people, with the ffmpeg command that makes a film, or one JSON object on one line. */
void film_report(FILE *out, const film_summary *summary, const film_options *options, double seconds, bool json);

/* A note where more than half of the session's points were refused at its start, with the member of the session that
 * keeps them. */
void film_report_start(FILE *out, const film_start *start, const octree_session *session);

/* Notes where the view asks for values that no point and no tick has. */
void film_report_empty(FILE *out, const film_summary *summary, const film_options *options);

/* All of these notes, and one where frames could not be checked. */
void film_report_notes(FILE *out, const film_summary *summary, const film_options *options,
                       const octree_session *session);

/* Print the shorter summary of a recording that join_chunks() made. */
void film_report_joined(FILE *out, const film_summary *summary, const film_options *options, bool json);

/* Print the number of recorded ticks and the command that continues. */
void film_report_stopped(FILE *out, const film_summary *summary, const film_options *options);

#endif
