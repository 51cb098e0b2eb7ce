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
    const evidence *evidence; /* null if no pictures of evidence were written */
    size_t lines;             /* the largest number of groups that the report as text lists */
    const frame_groups *groups;
} diff_report;

/* Print the report as text for people: the verdict, the headline, up to report->lines groups, and the tolerance. A
 * group has a line for its first frame, a line for its cause and a line for its other frames. */
void diff_report_text(FILE *out, const diff_report *report);

/* Print the lines of one group: its first frame, the cause, and the names of the other frames. */
void diff_report_print_group(FILE *out, const frame_group *group);

/* Write the report as one JSON object on one line. The object holds all differing frames and their groups;
 * diff.schema.json describes it. */
#define DIFF_REPORT_JSON_VERSION 1
void diff_report_json(FILE *out, const diff_report *report);

/* Write the report as JUnit XML for GitHub actions, GitLab and Jenkins. Each frame is a test case, because these
 * systems track test cases by name. The first case of a group has all details; the other cases refer to the first. */
void diff_report_junit(FILE *out, const diff_report *report);

/* Write GitHub workflow commands, "::error file=...,title=...::...". GitHub shows each command as an annotation of a
 * pull request. GitHub shows only a few annotations for each step, so only the first groups have a command. */
#define DIFF_REPORT_ANNOTATIONS 10
void diff_report_github(FILE *out, const diff_report *report);

/* Write the report as a section of GitHub Markdown for the summary of a CI job. The section has the verdict and a
 * table of up to DIFF_REPORT_ROWS groups. */
#define DIFF_REPORT_ROWS 20
void diff_report_markdown(FILE *out, const diff_report *report);

/* Write the report as the comment of a pull request: comment.md in a folder, and beside it the pictures that it shows,
 * copied from the evidence. For up to DIFF_COMMENT_FINDINGS groups it has the sentence, the pictures and the line of
 * octreel accept. diff_comment_prepare() creates the folder before; it returns false with an error if the folder is not
 * empty. */
#define DIFF_COMMENT_FINDINGS 10
bool diff_comment_prepare(const char *folder, octreel_error *error);
bool diff_report_comment(const diff_report *report, const char *folder, octreel_error *error);

/* Write report.html into the folder of evidence. It is a self-contained page on which a person views the differences
 * and selects frames for acceptance. The page holds the first DIFF_REPORT_PAGE_FRAMES groups, and at most
 * DIFF_REPORT_PAGE_BYTES bytes of pictures. The page states how many groups and pictures are left out. */
#define DIFF_REPORT_PAGE_FRAMES 1000
#define DIFF_REPORT_PAGE_CAUSES 50 /* so many findings are explained by default; each may replay a session */
#define DIFF_REPORT_PAGE_BYTES (UINT64_C(96) << 20) /* bytes of embedded PNG files; more bytes slow browsers down */
bool diff_report_page(const diff_report *report, octreel_error *error);

#endif
