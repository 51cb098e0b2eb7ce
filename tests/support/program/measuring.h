/* SPDX-License-Identifier: MIT */
/* measuring.h - what a time is, and which of several is told. */
#ifndef MEASURING_H
#define MEASURING_H

#include <stddef.h>

/* Nanoseconds of this process alone: what else the machine does is not counted. */
double processor_time(void);

/* Of at least one value; they are sorted in place. */
double median(double *values, size_t count);

#endif
