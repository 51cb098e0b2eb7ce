/* SPDX-License-Identifier: MIT */
#include "text_bomb.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS = 6 };

static char *add_repeated(char *at, const char *repeated, unsigned number)
{
    for (; *repeated; repeated++) {
        if (*repeated == '@')
            at += snprintf(at, DIGITS + 1, "%0*u", DIGITS, 100000 + number);
        else
            *at++ = *repeated;
    }
    return at;
}

char *text_bomb_make(const text_bomb *bomb, size_t *size)
{
    char *text = malloc(TEXT_BOMB_SIZE + 4096);
    if (!text)
        abort();
    char *at = text + strlen(strcpy(text, bomb->head));
    for (unsigned number = 0; at < text + TEXT_BOMB_SIZE; number++)
        at = add_repeated(at, bomb->repeated, number);
    strcpy(at, bomb->end);
    *size = strlen(text);
    return text;
}

double text_bomb_measure(const text_bomb *bomb, text_bomb_reader *read)
{
    size_t size;
    char *text = text_bomb_make(bomb, &size);
    heap_peak_begin();
    read(text, size);
    const double each = (double)heap_peak() / (double)size + 1;
    free(text);
    return each;
}
