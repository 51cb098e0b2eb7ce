/* SPDX-License-Identifier: MIT */
/* traced.h - runs octreel one system call at a time, to see what it leaves behind if it is killed at any of them. */
#ifndef TRACED_H
#define TRACED_H

#include <stdbool.h>
#include <stddef.h>

/* Run octreel with these arguments, separated by blanks. Once a file named `since` exists, stop it before each call
 * with which its first thread opens, writes, truncates, closes, renames, links or removes a file, and call visit() with
 * the number of such calls so far. If visit() returns false, octreel is killed there. Returns false if the system does
 * not allow tracing. The test fails if octreel fails. */
bool trace_octreel(const char *arguments, const char *since, bool (*visit)(size_t call, void *context), void *context);

#endif
