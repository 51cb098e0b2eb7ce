/* SPDX-License-Identifier: MIT */
/* cores.h - the number of processors of this machine. */
#ifndef BASE_CORES_H
#define BASE_CORES_H

/* Returns the number of processors that are online, at least 1. */
unsigned count_cores(void);

#endif
