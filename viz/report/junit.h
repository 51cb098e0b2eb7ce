/* SPDX-License-Identifier: MIT */
/* junit.h - writes the frame of a JUnit XML report; used only in this folder. Readers require a time for each test
 * case; it is unknown, so it is 0.
 */
#ifndef REPORT_JUNIT_H
#define REPORT_JUNIT_H

#include "text.h"

/* Begin a report of one suite, whose name is a path. */
void junit_begin(FILE *out, const char *tool, const char *path, size_t tests, size_t failures, size_t errors);
void junit_end(FILE *out);

/* Begin a test case of the suite; the caller closes the element. */
void junit_begin_case(FILE *out, const char *path, const char *name);

/* Write " NAME="VALUE"", an attribute of XML. */
void write_attribute(FILE *out, const char *name, const char *value);

#endif
