/* SPDX-License-Identifier: MIT */
/* audit_print.h - reports an audit of a foreign index as text, JSON, JUnit and HTML. */
#ifndef REPORT_AUDIT_PRINT_H
#define REPORT_AUDIT_PRINT_H

#include "audit.h"

#include <stdio.h>

/* The input of all reports: the recording or session, and the result of its audit. */
typedef struct audit_verdict {
    const char *path;
    bool recording; /* true: `path` is a recording, which has frames or a page; false: `path` is a session file */
    const audit_report *report;
} audit_verdict;

/* Print the audit as lines of text, or as one JSON object on one line. The text has one line for the whole audit and
 * one line for each kind of query. Each line is followed by the worst cases. In this file no function checks the
 * stream for errors: the caller does. */
void audit_print_text(FILE *out, const audit_verdict *verdict);
void audit_print_json(FILE *out, const audit_verdict *verdict);

/* Write JUnit XML: a test case for each kind of query, one for the pairs, and one for the nodes. */
void audit_print_junit(FILE *out, const audit_verdict *verdict);

/* Write a self-contained HTML page: charts of recall and ratio over the ticks, and the worst cases. Each point of a
 * chart is a link to a frame. The links are relative to `from`, the folder of the page. A chart has at most
 * AUDIT_PAGE_POINTS points. Each point stands for a range of ticks and shows the worst tick of the range. Return
 * false if memory runs out. */
#define AUDIT_PAGE "audit.html"
#define AUDIT_PAGE_POINTS 400
bool audit_print_page(FILE *out, const audit_verdict *verdict, const char *from);

/* ---- Used only in this folder --------------------------------------------------------------------------------
 *
 * The printed sentences contain no "<" and no "&", so they need no escape in XML and HTML. Only
 * audit_print_wrong_answer() prints double quotes; its sentence is not for attributes.
 */

/* Print a ratio, "1.7" or "infinite", into `text`. Return `text`. */
#define AUDIT_RATIO_TEXT 48
const char *audit_ratio_text(double ratio, char text[AUDIT_RATIO_TEXT]);

/* Print one line without a newline: the result of the whole audit, of one kind of query, or of the nodes. */
void audit_print_summary(FILE *out, const audit_verdict *verdict);
void audit_print_kind(FILE *out, const audit_verdict *verdict, int kind);
void audit_print_nodes(FILE *out, const audit_nodes *nodes);

/* Print the text `before`, the limits and the text `after`. If no limits are set, print nothing. */
void audit_print_limits(FILE *out, const char *before, const audit_limits *limits, const char *after);

/* Print one part of the line of audit_print_nodes(). The first function prints its beginning, "nodes: 3 wrong in 2
 * ticks, ...". The second prints, for one kind of wrong node, the number of such nodes and the first such node. */
void audit_print_nodes_head(FILE *out, const audit_nodes *nodes);
void audit_print_wrong_nodes(FILE *out, const audit_nodes *nodes, octree_wrong_node_kind kind);

/* Print a wrong answer to a query of the kind `about`, or wrong pairs: the index of the answer in its tick, why the
 * answer is wrong, and its missing and extra points. If other bounds of the query, open or closed, would make the
 * answer right, print these bounds. */
void audit_print_wrong_answer(FILE *out, const audit_case *c, const octree_query_traits *about);

#endif
