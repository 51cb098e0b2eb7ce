/* SPDX-License-Identifier: MIT */
/* failing_memory.h - lets the n-th allocation of a test fail.
 *
 * The linker redirects the allocations of the programs test_*_memory.c to this file (see tests/CMakeLists.txt): those
 * of the tests and of viz, but not those of libraries. */
#ifndef FAILING_MEMORY_H
#define FAILING_MEMORY_H

#include <stdbool.h>

/* Let this number of allocations of the calling thread succeed, and all further ones fail; below 0: none fails. */
void fail_allocations_after(long count);

/* Let only one allocation fail instead, and all after it succeed: this reveals failures that are not checked. */
void fail_one_allocation(void);

/* End the failures. Returns whether an allocation failed. */
bool memory_has_failed(void);

/* The same for all threads but the calling one: the allocation after this number of successful ones fails. */
void fail_allocations_elsewhere_after(long count);
bool memory_has_failed_elsewhere(void);

#endif
