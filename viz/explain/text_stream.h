/* text_stream.h - text that is printed into memory. */
#ifndef DIFF_TEXT_STREAM_H
#define DIFF_TEXT_STREAM_H

#include <stdbool.h>
#include <stdio.h>

typedef struct text_stream {
    FILE *stream; /* null where there is no memory */
    char *text;
    size_t size;
} text_stream;

bool text_stream_begin(text_stream *s);

/* *text becomes what was printed, which the caller frees; null where that is nothing. False where there was no memory.
 */
bool text_stream_end(text_stream *s, char **text);

#endif
