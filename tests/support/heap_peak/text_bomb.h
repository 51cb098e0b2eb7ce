/* SPDX-License-Identifier: MIT */
/* text_bomb.h - texts that are built to make their reader use as much memory as possible. */
#ifndef TEXT_BOMB_H
#define TEXT_BOMB_H

#include "heap_peak.h"

#include <stdbool.h>

enum { TEXT_BOMB_SIZE = 300000 };

/* The text is `head`, then `repeated` many times, then `end`. Each '@' in `repeated` becomes a counter. */
typedef struct text_bomb {
    const char *name, *head, *repeated, *end;
} text_bomb;

/* Make a text of a little more than TEXT_BOMB_SIZE bytes and a final zero; the caller frees it. */
char *text_bomb_make(const text_bomb *bomb, size_t *size);

/* Make a text, read it, and release the result. Returns the peak of memory per byte of text, which includes the text.
 */
typedef void text_bomb_reader(char *text, size_t size);
double text_bomb_measure(const text_bomb *bomb, text_bomb_reader *read);

#endif
