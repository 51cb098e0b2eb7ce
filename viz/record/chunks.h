/* parts.h - the lines of a recording that was filmed in parts: ticks_A_B.jsonl has those of the ticks [A, B). */
#ifndef RECORD_PARTS_H
#define RECORD_PARTS_H

#include "folder.h"

#include <stdint.h>

/* A file with lines of a recording, as far as it got. */
typedef struct part {
    uint64_t first, last; /* the ticks that it is to have */
    uint64_t lines;       /* the whole lines that it has */
    char name[CHUNK_NAME];
} part;

typedef struct chunk_list {
    part *parts; /* by their first tick, the longer first */
    size_t count;
} chunk_list;

/* Find the parts of a folder, for a recording of `ticks` ticks. Its ticks.jsonl is one too, of all of them. A part that
 * reaches beyond them, or has more lines than ticks, is an error. */
bool chunks_find(const char *folder, uint64_t ticks, chunk_list *list, octreel_error *error);
void chunks_release(chunk_list *list);

#endif
