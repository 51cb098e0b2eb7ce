/* SPDX-License-Identifier: MIT */
/* traced.h - runs octreel one system call at a time, to see what it leaves behind if it is killed at any of them. */
#ifndef TRACED_H
#define TRACED_H

#include <stdbool.h>
#include <stddef.h>

/* Run octreel with these arguments, blanks between them, and stop it before each call with which its first thread
 * opens, writes, cuts, closes, renames, links or removes a file, once there is something of the name `since`. visit()
 * is told how many such calls there were before; where it returns false the program is killed there. Returns false
 * where the system does not let one process follow another. The test fails when the program fails. */
bool trace_octreel(const char *arguments, const char *since, bool (*visit)(size_t call, void *context), void *context);

#endif
