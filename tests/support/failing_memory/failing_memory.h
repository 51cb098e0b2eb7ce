/* SPDX-License-Identifier: MIT */
/* failing_memory.h - the n-th allocation of a test fails.
 *
 * The linker hands the allocations of the programs test_x_memory.c here (see tests/CMakeLists.txt): their own and
 * viz's, not those of libraries. */
#ifndef FAILING_MEMORY_H
#define FAILING_MEMORY_H

#include <stdbool.h>

/* Let so many of this thread succeed, and none that follows; below 0: all. */
void memory_fails_after(long count);

/* From now on one fails, and those that follow succeed: what is not noticed at once is not noticed at all. */
void memory_fails_alone(void);

/* End that. Returns whether one has failed. */
bool memory_has_failed(void);

/* The same of the threads that do not call it, of which the one behind so many fails. */
void memory_fails_elsewhere_after(long count);
bool memory_has_failed_elsewhere(void);

#endif
