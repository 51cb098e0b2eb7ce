/* SPDX-License-Identifier: MIT */
/* verify_line.h - reads ticks.jsonl line by line and finds the first difference of a line. */
#ifndef REPLAY_VERIFY_LINE_H
#define REPLAY_VERIFY_LINE_H

#include "ticks_write.h"
#include "verify.h"

typedef struct line_reader {
    FILE *stream;
    char *line; /* the last line read, with its newline */
    size_t size, room;
} line_reader;

typedef enum line_state {
    LINE_WHOLE,
    LINE_TORN,    /* the file ends before the newline */
    LINE_LONG,    /* longer than the limit; the rest is not read */
    LINE_NONE,    /* the end of the file */
    LINE_TROUBLE, /* a read error, or out of memory */
} line_state;

/* Open the ticks.jsonl of a folder, which must be a regular file. */
bool lines_open(line_reader *reader, const char *folder, octreel_error *error);
void lines_close(line_reader *reader);

/* Read the next line, at most `limit` bytes. */
line_state lines_next(line_reader *reader, size_t limit);

/* The expected line, and the tick from which it is made. */
typedef struct expected_line {
    const char *text;
    size_t size;
    const octree_tick *tick;
    const tick_extras *extras;
} expected_line;

/* The size to which a line is read. Earlier versions listed all nodes that split or merged, in longer lines. */
size_t line_limit(const expected_line *expected);

/* Whether a line equals the expected one, or the line that an earlier version would write. If not, sets kind, fact and
 * text of the finding. */
bool line_matches(const line_reader *found, const expected_line *expected, verify_finding *finding);

#endif
