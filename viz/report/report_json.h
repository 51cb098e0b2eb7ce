/* SPDX-License-Identifier: MIT */
/* report_json.h - members of JSON that more than one report has. */
#ifndef REPORT_REPORT_JSON_H
#define REPORT_REPORT_JSON_H

#include "json_write.h"
#include "report.h"

/* The verdict, both sides, the tolerance and the counts, as members of an object that the caller began. */
void diff_json_summary(json_writer *writer, const diff_report *report);

/* The i-th pair: its name, its finding and what belongs to that, as members likewise. */
void diff_json_finding(json_writer *writer, const diff_report *report, size_t i);

/* The names of a group's frames, as one member likewise. */
void diff_json_group(json_writer *writer, const diff_report *report, size_t group);

#endif
