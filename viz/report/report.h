/* SPDX-License-Identifier: MIT */
/* report.h - reports the result of a comparison as text, JSON, JUnit, Markdown, HTML and GitHub commands. */
#ifndef REPORT_REPORT_H
#define REPORT_REPORT_H

#include "evidence.h"
#include "explain.h"
#include "groups.h"

#include <stdio.h>

/* The input of all reports: both sides, the result, its explanation, and the pictures of evidence. */
typedef struct diff_report {
    const diff_side *a, *b;
    const diff_result *result;
    const explanation *why;
    const evidence *evidence; /* null: no pictures were written */
    size_t lines;             /* the largest number of groups that the text lists */
    const frame_groups *groups;
} diff_report;

/* Print the text for people: the verdict, the headline, up to report->lines groups, and the tolerance. A group has a
 * line for its first frame, one for its cause and one for its other frames. */
void diff_report_text(FILE *out, const diff_report *report);

/* Write one JSON object on one line, with all differing frames and their groups; diff.schema.json describes it. */
#define DIFF_REPORT_JSON_VERSION 1
void diff_report_json(FILE *out, const diff_report *report);

/* Write JUnit XML for GitHub actions, GitLab and Jenkins: a test case for each frame, because these systems track a
 * case by its name. The first case of a group has all details, the others refer to it. */
void diff_report_junit(FILE *out, const diff_report *report);

/* Write GitHub workflow commands, "::error file=...,title=...::...", which annotate a change: one line for each of the
 * first groups, because GitHub shows only a few for each step. */
#define DIFF_REPORT_ANNOTATIONS 10
void diff_report_github(FILE *out, const diff_report *report);

/* Write a section of GitHub Markdown for the summary of a CI job: the verdict and a table of up to DIFF_REPORT_ROWS
 * groups. */
#define DIFF_REPORT_ROWS 20
void diff_report_markdown(FILE *out, const diff_report *report);

/* Write report.html into the folder of evidence: one self-contained page to look through the differences and to tick
 * frames for acceptance. It holds the first DIFF_REPORT_PAGE_FRAMES groups and their pictures, up to
 * DIFF_REPORT_PAGE_BYTES, and says what is left out. */
#define DIFF_REPORT_PAGE_FRAMES 50
#define DIFF_REPORT_PAGE_BYTES (UINT64_C(96) << 20) /* of PNG files; more slows browsers down */
bool diff_report_page(const diff_report *report, octreel_error *error);

#endif
