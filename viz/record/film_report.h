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

/* If tick 0 refused more than half of the session's points, print a note that suggests the member of session.json that
 * would keep them. */
void film_report_start(FILE *out, const film_start *start, const octree_session *session);

/* Print a note for each view option that shows nothing: the option needs a value that no point has, or foreign nodes
 * that no tick has. */
void film_report_empty(FILE *out, const film_summary *summary, const film_options *options);

/* Print the notes of film_report_start() and film_report_empty(), and a note if frames could not be checked. */
void film_report_notes(FILE *out, const film_summary *summary, const film_options *options,
                       const octree_session *session);

/* Print the summary of a recording that join_chunks() completed. This summary is shorter than the summary that
 * film_report() prints. */
void film_report_joined(FILE *out, const film_summary *summary, const film_options *options, bool json);

/* Print the number of recorded ticks and the command that resumes the recording. */
void film_report_stopped(FILE *out, const film_summary *summary, const film_options *options);

#endif
