/* SPDX-License-Identifier: MIT */
/* mirrored.h - near ties: places mirrored about a target, some of them a double or two aside.
 */
#ifndef TRADEOFF_MIRRORED_H
#define TRADEOFF_MIRRORED_H

#include "workload.h"

/* One target, and points about it whose distances doubles can hardly tell apart. Coordinates are as large as distances:
 * with many targets in one tree they would not be, and differences of doubles would be exact. */
workload mirrored_make(const char *name, uint64_t *random);

#endif
