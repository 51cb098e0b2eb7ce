/* SPDX-License-Identifier: MIT */
/* cores.c - counts the processors of this machine. */
#include "cores.h"

#include <unistd.h>

unsigned count_cores(void)
{
#ifdef _SC_NPROCESSORS_ONLN
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores > 1 ? (unsigned)cores : 1;
#else
    return 1;
#endif
}
