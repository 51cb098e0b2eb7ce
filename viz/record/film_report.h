/* SPDX-License-Identifier: MIT */
/* film_report.h - the summary printed after filming. */
#ifndef RECORD_FILM_REPORT_H
#define RECORD_FILM_REPORT_H

#include "film_options.h"

#include <stdio.h>

/* Write the names of the element kinds in `left_out` (bits LEFT_OUT_* of scene.h), such as "nodes, points and velocity
 * arrows". Returns `text`. */
#define FILM_LEFT_OUT 48
const char *film_left_out_text(unsigned left_out, char text[FILM_LEFT_OUT]);

/* Print the summary as a few lines of text, with the command that makes a film, or as one JSON object on one
 * line. */
void film_report(FILE *out, const film_summary *summary, const film_options *options, double seconds, bool json);

/* If tick 0 refused more than half of the session's points, print a note that suggests a member of session.json with
 * which the tree would keep these points. */
void film_report_refused_points(FILE *out, const film_start *start, const octree_session *session);

/* Print a note for each view option that has no effect, because no point has the value that the option shows, or no
 * tick has foreign nodes. */
void film_report_useless_options(FILE *out, const film_summary *summary, const film_options *options);

/* Print the notes of film_report_refused_points() and film_report_useless_options(), and a note if frames could not be
 * checked. */
void film_report_notes(FILE *out, const film_summary *summary, const film_options *options,
                       const octree_session *session);

/* Print the summary of a recording that join_chunks() completed. This summary is shorter than the summary that
 * film_report() prints. */
void film_report_joined(FILE *out, const film_summary *summary, const film_options *options, bool json);

/* Print the number of recorded ticks and the command that resumes the recording. */
void film_report_stopped(FILE *out, const film_summary *summary, const film_options *options);

#endif
