/* number_text.c - see number_text.h. */
#include "number_text.h"

#include <stdio.h>

const char *number_text(double value, int digits, char text[NUMBER_WORDS])
{
    snprintf(text, NUMBER_WORDS, "%.*g", digits, value);
    for (char *at = text; *at; at++)
        if (*at == ',')
            *at = '.';
    return text;
}
