/* SPDX-License-Identifier: MIT */
/* report.h - prints the measurements: a table for people, and one JSON object per line for programs. */
#ifndef BENCH_REPORT_H
#define BENCH_REPORT_H

#include "ops.h"

/* The heading of one workload's table. */
void report_heading(const workload *w, int rounds);

/* An operation as a row of that table, or as one line a contender. Each is a report_op. */
void report_row(const op *o, const workload *w, const lineup *l, void *context);
void report_json(const op *o, const workload *w, const lineup *l, void *context);

#endif
