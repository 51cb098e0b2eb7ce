/* SPDX-License-Identifier: MIT */
/* report_json.h - writes the JSON members that diff --json and report.html share. */
#ifndef REPORT_REPORT_JSON_H
#define REPORT_REPORT_JSON_H

#include "json_write.h"
#include "report.h"

/* Write the verdict, both sides, the tolerance and the counts as members of the current object. */
void diff_json_summary(json_writer *writer, const diff_report *report);

/* Write the result of comparing the i-th pair as members of the current object: its name, its finding and the
 * details. */
void diff_json_finding(json_writer *writer, const diff_report *report, size_t i);

/* Write the names of a group's frames as one member of the current object. */
void diff_json_group_frames(json_writer *writer, const diff_report *report, size_t group);

#endif
