/* SPDX-License-Identifier: MIT */
/* verify_line.h - reads ticks.jsonl line by line, whatever it holds, and finds in what a line differs. */
#ifndef REPLAY_VERIFY_LINE_H
#define REPLAY_VERIFY_LINE_H

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

/* Compare a line that was read with the expected one of this tick. True where they are equal; else the finding's kind,
 * fact and text say in what they differ. */
bool line_same(const line_reader *found, const char *expected, size_t size, uint64_t tick, verify_finding *finding);

#endif
