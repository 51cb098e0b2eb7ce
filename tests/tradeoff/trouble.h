/* trouble.h - what ends the program: a sentence, and status 2. */
#ifndef TRADEOFF_TROUBLE_H
#define TRADEOFF_TROUBLE_H

#include <stdlib.h>

#include "octree/octree.h"

/* Say why on standard error and end with status 2. */
_Noreturn void stop(const char *format, ...);

/* As realloc, or stop. */
void *memory(void *old, size_t size);

/* Stop unless a call of the library was done. */
void must(octree_status status);

#endif
