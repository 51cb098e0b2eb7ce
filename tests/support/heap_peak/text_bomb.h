/* SPDX-License-Identifier: MIT */
/* text_bomb.h - texts that are made to take as much memory as they can. */
#ifndef TEXT_BOMB_H
#define TEXT_BOMB_H

#include "heap_peak.h"

#include <stdbool.h>

enum { TEXT_BOMB_SIZE = 300000 };

/* The head, then again and again what is repeated, then the end. In what is repeated each '@' becomes so many digits
 * that count. */
typedef struct text_bomb {
    const char *name, *head, *repeated, *end;
} text_bomb;

/* Of a little more than TEXT_BOMB_SIZE bytes, ended by a zero; the caller frees it. */
char *text_bomb_make(const text_bomb *bomb, size_t *size);

/* Make it, read it, and release all that was read. The most memory for each of its bytes, itself included. */
typedef void text_bomb_reader(char *text, size_t size);
double text_bomb_measure(const text_bomb *bomb, text_bomb_reader *read);

#endif
