/* SPDX-License-Identifier: MIT */
/* heap_peak.h - measures the peak of heap memory in a test that links octreel_heap_peak. The library replaces malloc,
 * calloc, realloc and free in the program and, with glibc and without sanitizers, also in shared libraries. */
#ifndef HEAP_PEAK_H
#define HEAP_PEAK_H

#include <stddef.h>

/* Begin a measurement. */
void heap_peak_begin(void);

/* The peak since heap_peak_begin(), in bytes above the memory that was in use then. */
size_t heap_peak(void);

#endif
