/* SPDX-License-Identifier: MIT */
/* report.h - what a comparison found, for people and for programs. */
#ifndef REPORT_REPORT_H
#define REPORT_REPORT_H

#include "evidence.h"
#include "explain.h"
#include "groups.h"

#include <stdio.h>

/* What is reported: both sides, how they were compared, what came of it and why, and where that can be seen. */
typedef struct diff_report {
    const diff_side *a, *b;
    const diff_result *result;
    const explanation *why;
    const evidence *evidence; /* null: none was left */
    size_t lines;             /* of the text: at most so many groups are listed */
    const frame_groups *groups;
} diff_report;

/* The verdict, the headline, for each group of frames that are not the same (at most report->lines) a line for its
 * first, one for its cause and one for its other frames, and what was forgiven. */
void diff_report_text(FILE *out, const diff_report *report);

/* One JSON object on one line, with all frames that are not the same, and their groups: diff.schema.json
 * says what is in it. */
#define DIFF_REPORT_JSON_VERSION 1
void diff_report_json(FILE *out, const diff_report *report);

/* JUnit's XML, as GitHub's actions, GitLab and Jenkins read it: a test case for each frame, since those systems follow
 * a case by its name from run to run. The first of a group has all that is known, the others name it. False where there
 * is no memory. */
bool diff_report_junit(FILE *out, const diff_report *report);

/* Commands by which GitHub shows what differs beside a change: "::error file=...,title=...::...", a line for each of
 * the first groups, since it shows no more of a step. False where there is no memory. */
#define DIFF_REPORT_ANNOTATIONS 10
bool diff_report_github(FILE *out, const diff_report *report);

/* A section for the page of a CI job, in GitHub's Markdown: the verdict, and a table of the groups that differ, at most
 * DIFF_REPORT_ROWS of them. False where there is no memory. */
#define DIFF_REPORT_ROWS 20
bool diff_report_markdown(FILE *out, const diff_report *report);

/* report.html, in the folder of evidence: one file to look through what differs, and to tick what shall be accepted,
 * which loads nothing. It has the first DIFF_REPORT_PAGE_FRAMES groups that differ, the pictures of as many of them as
 * there is room for, and says what was left out. */
#define DIFF_REPORT_PAGE_FRAMES 50
#define DIFF_REPORT_PAGE_BYTES (UINT64_C(96) << 20) /* of PNG files; a browser holds no more with ease */
bool diff_report_page(const diff_report *report, octreel_error *error);

/* In one line without its end: the verdict and the counts; and what was forgiven, or that nothing was. */
void diff_print_summary(FILE *out, const diff_report *report);
void diff_print_tolerance(FILE *out, const diff_report *report);

#endif
