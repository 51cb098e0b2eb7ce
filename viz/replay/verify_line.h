/* verify_line.h - the lines of a ticks.jsonl one by one, whatever they hold, and in what one differs from another. */
#ifndef RECORD_VERIFY_LINE_H
#define RECORD_VERIFY_LINE_H

#include "verify.h"

/* A regular file that is read line by line. */
typedef struct line_reader {
    FILE *stream;
    char *line; /* the last one, its newline included */
    size_t size, room;
} line_reader;

typedef enum line_state {
    LINE_WHOLE,
    LINE_TORN, /* the last one, without its newline */
    LINE_LONG, /* longer than was asked for; its rest is left out */
    LINE_NONE, /* the file is at its end */
    LINE_TROUBLE,
} line_state;

bool lines_open(line_reader *reader, const char *path, octreel_error *error);
void lines_close(line_reader *reader);

/* Read the next line, of `limit` bytes at most. Errors of the file are LINE_TROUBLE; so is lack of memory. */
line_state lines_next(line_reader *reader, size_t limit);

/* Say in what a line that was found differs from the one of this tick that was expected, if it does: kind, fact and
 * text of the finding. True when they are equal. */
bool line_same(const line_reader *found, const char *expected, size_t size, uint64_t tick, verify_finding *finding);

#endif
