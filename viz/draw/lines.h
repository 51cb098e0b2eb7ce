/* lines.h - the lines that edges of boxes lie on, each once, found by their coordinates. Private to the edges. */
#ifndef DRAW_LINES_H
#define DRAW_LINES_H

#include "line_key.h"

#include <stddef.h>

typedef struct line {
    line_key key;
    size_t last;  /* the stretch that was put on it last */
    size_t count; /* of its stretches */
} line;

/* A zeroed one is empty. */
typedef struct line_set {
    line *items;
    size_t count, room;
    uint32_t *table; /* 1 + places in `items`, by hash; 0 is free */
    size_t size;     /* of the table: a power of two, or 0 */
} line_set;

void lines_clear(line_set *set);
void lines_release(line_set *set);

/* The place of a line, which is new where its count is 0. SIZE_MAX when there is no memory. The two zeros are one. */
size_t lines_find(line_set *set, const line_key *key);

#endif
