/* SPDX-License-Identifier: MIT */
/* cores.h - how many processors this machine has. */
#ifndef BASE_CORES_H
#define BASE_CORES_H

/* Those that are online; at least 1. */
unsigned count_cores(void);

#endif
