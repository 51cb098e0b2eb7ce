/* SPDX-License-Identifier: MIT */
/* verify_line.h - reads ticks.jsonl line by line, whatever it holds, and finds in what a line differs. */
#ifndef REPLAY_VERIFY_LINE_H
#define REPLAY_VERIFY_LINE_H

#include "ticks_write.h"
#include "verify.h"

typedef struct line_reader {
    FILE *stream;
    char *line; /* the last line that was read, its newline included */
    size_t size, room;
} line_reader;

typedef enum line_state {
    LINE_WHOLE,
    LINE_TORN,    /* the file ends before the line's newline */
    LINE_LONG,    /* longer than the limit; the rest is not read */
    LINE_NONE,    /* the end of the file */
    LINE_TROUBLE, /* it cannot be read, or there is no memory */
} line_state;

/* Open the ticks.jsonl of a folder, which must be a regular file. */
bool lines_open(line_reader *reader, const char *folder, octreel_error *error);
void lines_close(line_reader *reader);

/* Read the next line, of `limit` bytes at most. */
line_state lines_next(line_reader *reader, size_t limit);

/* A line as it is expected, with what is in it. */
typedef struct expected_line {
    const char *text;
    size_t size;
    const octree_tick *tick;
    const tick_extras *extras;
} expected_line;

/* The longest line that may be one like this: of an earlier version, which listed all nodes that split or merged. */
size_t line_limit(const expected_line *expected);

/* Compare a line that was read with the expected one. True where they are equal, or it is that of an earlier version;
 * else the finding's kind, fact and text say in what they differ. */
bool line_same(const line_reader *found, const expected_line *expected, verify_finding *finding);

#endif
