/* printable.h - text of others, such as a file's name, made fit for a terminal. */
#ifndef RECORD_PRINTABLE_H
#define RECORD_PRINTABLE_H

/* Put a question mark in the place of every byte that is not printable ASCII. Returns `text`. */
static inline char *make_printable(char *text)
{
    for (char *at = text; *at; at++)
        if (*at < ' ' || *at > '~')
            *at = '?';
    return text;
}

#endif
