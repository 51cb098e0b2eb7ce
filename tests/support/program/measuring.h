/* SPDX-License-Identifier: MIT */
/* measuring.h - measures processor time, and computes the median of several times. */
#ifndef MEASURING_H
#define MEASURING_H

#include <stddef.h>

/* Processor time of this process, in nanoseconds. */
double processor_time(void);

/* The median of one or more values, which are sorted in place. */
double median(double *values, size_t count);

#endif
