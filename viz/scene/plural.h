/* plural.h - words that count. */
#ifndef SCENE_PLURAL_H
#define SCENE_PLURAL_H

#include <stdint.h>

/* The ending of what there are so many of. */
static inline const char *plural(uint64_t count)
{
    return count == 1 ? "" : "s";
}

#endif
