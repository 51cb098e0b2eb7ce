/* status.c - the names and sentences of the statuses. */
#include "octree/octree.h"

const char *octree_status_text(octree_status status)
{
    static const char *const texts[] = {
#define STATUS_TEXT(name, word, text) text,
        OCTREE_STATUS_MAP(STATUS_TEXT)
#undef STATUS_TEXT
    };
    return (unsigned)status < OCTREE_STATUS_COUNT ? texts[status] : "unknown status";
}

const char *octree_status_name(octree_status status)
{
    static const char *const words[] = {
#define STATUS_WORD(name, word, text) word,
        OCTREE_STATUS_MAP(STATUS_WORD)
#undef STATUS_WORD
    };
    return (unsigned)status < OCTREE_STATUS_COUNT ? words[status] : "unknown";
}
