/* SPDX-License-Identifier: MIT */
/* audit_print.h - reports an audit of a foreign index as text, JSON, JUnit and HTML. */
#ifndef REPORT_AUDIT_PRINT_H
#define REPORT_AUDIT_PRINT_H

#include "audit.h"

#include <stdio.h>

/* The input of all reports: the recording or session, and the result of its audit. */
typedef struct audit_verdict {
    const char *path;
    bool recording; /* the path is a recording, which has frames or a page */
    const audit_report *report;
} audit_verdict;

/* Print text with a line for the audit, one for each kind of query, and its worst cases below; or one JSON object on
 * one line. The caller checks the stream for errors, here and below. */
void audit_print_text(FILE *out, const audit_verdict *verdict);
void audit_print_json(FILE *out, const audit_verdict *verdict);

/* Write JUnit XML: a test case for each kind of query, and one for the nodes. */
void audit_print_junit(FILE *out, const audit_verdict *verdict);

/* Write a self-contained HTML page: charts of recall and ratio over the ticks, whose points link to their frames, and
 * the worst cases. Links are relative to `from`, the folder of the page. A chart has at most AUDIT_PAGE_POINTS points,
 * each for the worst of its ticks. Return false if memory runs out. */
#define AUDIT_PAGE "audit.html"
#define AUDIT_PAGE_POINTS 400
bool audit_print_page(FILE *out, const audit_verdict *verdict, const char *from);

/* ---- For this folder ------------------------------------------------------------------------------------------
 *
 * The printed sentences need no escape in XML and HTML: they hold no "<", "&" or double quote.
 */

/* "1.7", "infinite". */
#define AUDIT_RATIO_TEXT 48
const char *audit_ratio_text(double ratio, char text[AUDIT_RATIO_TEXT]);

/* Print one line without its newline: the result of the audit; of one kind of query; and of the nodes. */
void audit_print_all(FILE *out, const audit_verdict *verdict);
void audit_print_kind(FILE *out, const audit_verdict *verdict, int kind);
void audit_print_nodes(FILE *out, const audit_nodes *nodes);

/* Print the limits between two texts; nothing if there are no limits. */
void audit_print_limits(FILE *out, const char *before, const audit_limits *limits, const char *after);

/* Print the parts of audit_print_nodes(): "nodes: 3 wrong in 2 ticks, ...", and for one kind of wrong nodes their
 * number and the first of them. */
void audit_print_nodes_head(FILE *out, const audit_nodes *nodes);
void audit_print_wrong_nodes(FILE *out, const audit_nodes *nodes, octree_wrong_node_kind kind);

/* Print a wrong answer: its index in its tick, why it is wrong, and the missing and extra points. */
void audit_print_case(FILE *out, const audit_case *c, bool neighbors);

#endif
