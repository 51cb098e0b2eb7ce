/* SPDX-License-Identifier: MIT */
/* audit_print.h - the verdict on a program's answers, for people and for programs. */
#ifndef REPORT_AUDIT_PRINT_H
#define REPORT_AUDIT_PRINT_H

#include "audit.h"

#include <stdio.h>

/* What is told: of which recording or session, and what came of it. */
typedef struct audit_verdict {
    const char *path;
    bool recording; /* the path is one: it has frames or a page */
    const audit_report *report;
} audit_verdict;

/* A line for the whole and for each kind, and below each kind its worst cases; or one JSON object on one line. Errors
 * stay with the stream, as below. */
void audit_print_text(FILE *out, const audit_verdict *verdict);
void audit_print_json(FILE *out, const audit_verdict *verdict);

/* JUnit's XML: a test case for each kind of query, and one for the nodes. False where there is no memory. */
bool audit_print_junit(FILE *out, const audit_verdict *verdict);

/* One page of HTML that loads nothing: recall and ratio over the ticks, where each point leads to its frame, and the
 * worst cases. Links go from the folder `from`, in which the page lies, to the recording. Charts have AUDIT_PAGE_POINTS
 * points at most, each the worst of its ticks. False where there is no memory. */
#define AUDIT_PAGE "audit.html"
#define AUDIT_PAGE_POINTS 400
bool audit_print_page(FILE *out, const audit_verdict *verdict, const char *from);

/* ---- For this folder ------------------------------------------------------------------------------------------ */

/* "1.7", "infinite". */
#define AUDIT_RATIO_TEXT 48
const char *audit_ratio_text(double ratio, char text[AUDIT_RATIO_TEXT]);

/* In one line without its end: what came of all; of one kind; of the nodes; and what is allowed, or "" where nothing
 * is. */
void audit_print_all(FILE *out, const audit_verdict *verdict);
void audit_print_kind(FILE *out, const audit_verdict *verdict, int kind);
void audit_print_nodes(FILE *out, const audit_nodes *nodes);
void audit_print_nodes_head(FILE *out, const audit_nodes *nodes);                         /* "nodes: 3 faults" */
void audit_print_fault(FILE *out, const audit_nodes *nodes, octree_wrong_node_kind kind); /* how often, and the first */
void audit_print_limits(FILE *out, const audit_limits *limits);

/* Which of the tick's answers a case is, as in ticks.jsonl, what is wrong with it, and the points that it missed and
 * named wrongly. */
void audit_print_case(FILE *out, const audit_case *c, bool neighbors);

#endif
