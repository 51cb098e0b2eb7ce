/* parts.h - the lines of a recording that was filmed in parts: ticks_A_B.jsonl has those of the ticks [A, B). */
#ifndef RECORD_PARTS_H
#define RECORD_PARTS_H

#include "folder.h"

#include <stdint.h>

#define PART_NAME 56
char *part_name(uint64_t first, uint64_t last, char name[PART_NAME]);

/* The ticks of such a name; false for any other name. */
bool part_parse_name(const char *name, uint64_t *first, uint64_t *last);

/* A file with lines of a recording, as far as it got. */
typedef struct part {
    uint64_t first, last; /* the ticks that it is to have */
    uint64_t lines;       /* the whole lines that it has */
    char name[PART_NAME];
} part;

typedef struct part_list {
    part *parts; /* by their first tick, the longer first */
    size_t count;
} part_list;

/* Find the parts of a folder, for a recording of `ticks` ticks. Its ticks.jsonl is one too, of all of them. A part that
 * reaches beyond them, or has more lines than ticks, is an error. */
bool parts_find(const char *folder, uint64_t ticks, part_list *list, record_error *error);
void parts_release(part_list *list);

#endif
