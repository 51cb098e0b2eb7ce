/* sentence.h - text that is printed into memory. */
#ifndef DIFF_SENTENCE_H
#define DIFF_SENTENCE_H

#include <stdbool.h>
#include <stdio.h>

typedef struct sentence {
    FILE *stream; /* null where there is no memory */
    char *text;
    size_t size;
} sentence;

bool sentence_begin(sentence *s);

/* *text becomes what was printed, which the caller frees; null where that is nothing. False where there was no memory.
 */
bool sentence_end(sentence *s, char **text);

#endif
