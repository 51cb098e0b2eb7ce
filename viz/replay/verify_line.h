/* SPDX-License-Identifier: MIT */
/* verify_line.h - reads ticks.jsonl line by line, and finds the first difference between a line and the expected line.
 */
#ifndef REPLAY_VERIFY_LINE_H
#define REPLAY_VERIFY_LINE_H

#include "ticks_write.h"
#include "verify.h"

typedef struct line_reader {
    FILE *stream;
    char *line; /* the last line that was read, with its newline */
    size_t size, room;
} line_reader;

typedef enum line_state {
    LINE_WHOLE,   /* the line is complete, with its newline */
    LINE_TORN,    /* the file ends in the middle of the line, before its newline */
    LINE_LONG,    /* the line is longer than the limit; the part beyond the limit is not read */
    LINE_NONE,    /* the end of the file: no line is left */
    LINE_TROUBLE, /* a read error, or out of memory */
} line_state;

/* Open the file ticks.jsonl in a folder. The file must be a regular file. */
bool line_reader_open(line_reader *reader, const char *folder, octreel_error *error);
void line_reader_close(line_reader *reader);

/* Skip the next `count` lines. */
void line_reader_skip(line_reader *reader, uint64_t count);

/* Read the next line of ticks.jsonl. `limit` is the maximum number of bytes to read. */
line_state line_reader_next(line_reader *reader, size_t limit);

/* The line of ticks.jsonl that a tick should have, and the data from which the line was made. */
typedef struct expected_line {
    const char *text;
    size_t size;
    const octree_tick *tick;
    const tick_extras *extras;
} expected_line;

/* Returns the maximum number of bytes to read of a line. The limit allows for lines of earlier versions, which are
 * longer because they list all nodes that split or merged. */
size_t line_size_limit(const expected_line *expected);

/* Returns true if a line equals the expected line, or the line that an earlier version would have written. Otherwise
 * sets the members kind, fact and text of the finding. */
bool line_matches(const line_reader *found, const expected_line *expected, verify_finding *finding);

#endif
