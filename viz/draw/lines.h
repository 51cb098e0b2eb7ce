/* lines.h - the lines that edges of boxes lie on, each once, found by their coordinates. Private to the edges. */
#ifndef DRAW_LINES_H
#define DRAW_LINES_H

#include "line_key.h"

#include <stddef.h>

#define LINE_NONE UINT32_MAX

typedef struct line {
    line_key key;
    uint32_t users;        /* edges of boxes that lie on it */
    uint32_t first, count; /* its merged edges */
    uint32_t next;         /* while it is merged: where its next stretch goes; */
    uint32_t last;         /* and the stretch that was put on it last, LINE_NONE before the first */
} line;

/* A zeroed one is empty. */
typedef struct line_set {
    line *items;
    uint8_t *changed; /* for each: whether its merged edges are out of date */
    size_t count, room;
    size_t idle;     /* those without users */
    uint32_t *table; /* 1 + places in `items`, by hash; 0 is free */
    size_t size;     /* of the table: a power of two, or 0 */
} line_set;

void lines_clear(line_set *set);
void lines_release(line_set *set);

/* The place of a line that is changed by one user more; LINE_NONE when there is no memory. A new line comes behind all
 * others, and places stay what they are. The two zeros are one. */
uint32_t lines_use(line_set *set, const line_key *key);

/* One user less. */
void lines_leave(line_set *set, uint32_t place);

#endif
