/* SPDX-License-Identifier: MIT */
/* junit.h - writes the elements of JUnit XML that enclose the test cases; used only in this folder.
 *
 * Readers of JUnit XML require a time for each test case. Octreel does not measure this time, so it writes 0.
 */
#ifndef REPORT_JUNIT_H
#define REPORT_JUNIT_H

#include "text.h"

/* Begin a report of one test suite. The name of the suite is `path`. */
void junit_begin(FILE *out, const char *tool, const char *path, size_t tests, size_t failures, size_t errors);
void junit_end(FILE *out);

/* Begin a test case of the suite. The caller closes the testcase element. */
void junit_begin_case(FILE *out, const char *path, const char *name);

#endif
