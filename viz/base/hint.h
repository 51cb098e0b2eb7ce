/* SPDX-License-Identifier: MIT */
/* hint.h - what a sentence about a mistake can add: the name that was meant, and a command that can be copied. */
#ifndef BASE_HINT_H
#define BASE_HINT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* ---- The name that was meant -------------------------------------------------------------------------------- */

/* The nearest so far of the names that are offered for a word. */
typedef struct hint {
    const char *word;
    size_t length;
    const char *name; /* null: none is near */
    size_t distance;
} hint;

hint hint_for(const char *word, size_t length);

/* Offer a name. It is near that other programs use the word for, that begins with the word, or that takes few changes,
 * each a letter that is missing, too many, another, or swapped with the next, whatever its case. */
void hint_offer(hint *h, const char *name);

/* What joins the two parts of a sentence: ", did you mean --size? ", the name after `before`; "; " where none is near.
 * Returns `text`. */
#define HINT_TEXT 96
const char *hint_text(const hint *h, const char *before, char text[HINT_TEXT]);

/* ---- Commands ----------------------------------------------------------------------------------------------- */

/* Set how the program was called: argv[0]. Call it once, before there are threads. */
void hint_set_program(const char *called);

/* That, as a shell reads it; "octreel" where it is not known. */
const char *hint_program_name(void);

/* Write a text in which "octreel COMMAND", except within a sentence, becomes that of the program as it was called. */
void hint_write_commands(FILE *out, const char *text);

/* Write a word as a shell reads it, without control characters; one that looks like an option becomes a path. */
void hint_write_word(FILE *out, const char *text);

#endif
