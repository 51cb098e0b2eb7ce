/* SPDX-License-Identifier: MIT */
/* heap_peak.h - the most memory at one time: of a test that is linked with HEAP_PEAK_OPTIONS of tests/CMakeLists.txt,
 * which lead malloc, calloc, realloc and free of the program, though not of shared libraries, through here.
 */
#ifndef HEAP_PEAK_H
#define HEAP_PEAK_H

#include <stddef.h>

/* Count from here on. */
void heap_peak_begin(void);

/* The most bytes since then that were there at one time beyond those that were there before. */
size_t heap_peak(void);

#endif
