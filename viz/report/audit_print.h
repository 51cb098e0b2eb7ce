/* SPDX-License-Identifier: MIT */
/* audit_print.h - reports an audit of a foreign index as text, JSON, JUnit and HTML. */
#ifndef REPORT_AUDIT_PRINT_H
#define REPORT_AUDIT_PRINT_H

#include "audit.h"

#include <stdio.h>

/* The input of all reports: the recording or session, and the result of its audit. */
typedef struct audit_verdict {
    const char *path;
    bool recording; /* the path is a recording, which has frames or a page; false: it is a session */
    const audit_report *report;
} audit_verdict;

/* Print the audit as lines of text, or as one JSON object on one line. The text has a line for the whole audit and
 * one for each kind of query, each followed by its worst cases. The caller of any function of this file checks the
 * stream for errors. */
void audit_print_text(FILE *out, const audit_verdict *verdict);
void audit_print_json(FILE *out, const audit_verdict *verdict);

/* Write JUnit XML: a test case for each kind of query, and one for the nodes. */
void audit_print_junit(FILE *out, const audit_verdict *verdict);

/* Write a self-contained HTML page. It has charts of recall and ratio over the ticks, and the worst cases. The
 * points of the charts link to frames. Links are relative to `from`, the folder of the page. A chart has at most
 * AUDIT_PAGE_POINTS points; each point represents a range of ticks and shows the worst of them. Return false if
 * memory runs out. */
#define AUDIT_PAGE "audit.html"
#define AUDIT_PAGE_POINTS 400
bool audit_print_page(FILE *out, const audit_verdict *verdict, const char *from);

/* ---- For this folder ------------------------------------------------------------------------------------------
 *
 * The printed sentences contain no "<" and no "&", so they need no escape in XML and HTML. Only audit_print_case()
 * prints double quotes; its sentence is not for attributes.
 */

/* Print a ratio, "1.7" or "infinite", into `text`. Return `text`. */
#define AUDIT_RATIO_TEXT 48
const char *audit_ratio_text(double ratio, char text[AUDIT_RATIO_TEXT]);

/* Print one line without its newline: about the whole audit, about one kind of query, or about the nodes. */
void audit_print_all(FILE *out, const audit_verdict *verdict);
void audit_print_kind(FILE *out, const audit_verdict *verdict, int kind);
void audit_print_nodes(FILE *out, const audit_nodes *nodes);

/* Print the limits, between the texts `before` and `after`. Print nothing if there are no limits. */
void audit_print_limits(FILE *out, const char *before, const audit_limits *limits, const char *after);

/* Print the parts of audit_print_nodes(). The head is "nodes: 3 wrong in 2 ticks, ...". For one kind of wrong node,
 * print the number of such nodes and the first of them. */
void audit_print_nodes_head(FILE *out, const audit_nodes *nodes);
void audit_print_wrong_nodes(FILE *out, const audit_nodes *nodes, octree_wrong_node_kind kind);

/* Print a wrong answer to a query of the kind `about`: its index among the answers of its tick, why it is wrong, its
 * missing and extra points, and which bounds of the query, open or closed, would make it right. */
void audit_print_case(FILE *out, const audit_case *c, const octree_query_traits *about);

#endif
