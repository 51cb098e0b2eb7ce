/* SPDX-License-Identifier: MIT */
/* heap_peak.h - the most memory at one time, of a test that is linked with octreel_heap_peak: malloc, calloc, realloc
 * and free of the program lead through here, and with glibc and without sanitizers those of shared libraries too.
 */
#ifndef HEAP_PEAK_H
#define HEAP_PEAK_H

#include <stddef.h>

/* Count from here on. */
void heap_peak_begin(void);

/* The most bytes since then that were there at one time beyond those that were there before. */
size_t heap_peak(void);

#endif
