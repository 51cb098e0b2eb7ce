/* film_report.h - what was filmed, said when it is done. */
#ifndef RECORD_FILM_REPORT_H
#define RECORD_FILM_REPORT_H

#include "film.h"

#include <stdio.h>

/* A few lines for people, what to do with the recording among them, or one JSON object on one line. */
void film_report(FILE *out, const film_summary *summary, const film_options *options, double seconds, bool json);

/* One sentence: how far it came, and the command that goes on. */
void film_report_stopped(FILE *out, const film_summary *summary, const film_options *options);

#endif
