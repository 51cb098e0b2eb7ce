/* trace_words.h - what is drawn under the pixels that differ, in words. */
#ifndef DIFF_TRACE_WORDS_H
#define DIFF_TRACE_WORDS_H

#include "trace.h"

#include <stdio.h>

/* "node 0/3/7", "point 12", "text". */
void trace_print_part(FILE *out, const trace_part *part);

/* "312 pixels: 180 of node 0/3/7, 90 of point 12, 42 of text"; of many parts the first so many, and
 * text last of them. */
#define TRACE_TOLD 5
void trace_print(FILE *out, const trace *t);

#endif
