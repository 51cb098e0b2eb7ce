/* SPDX-License-Identifier: MIT */
/* hint.h - helps to correct typing mistakes: finds the known name nearest to a word, and prints commands that can be
 * copied. */
#ifndef BASE_HINT_H
#define BASE_HINT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* ---- The nearest name -------------------------------------------------------------------------------------- */

/* A mistyped word, and the nearest of the candidates offered so far. */
typedef struct hint {
    const char *word;
    size_t length;
    const char *name; /* null: no candidate is near enough */
    size_t distance;
} hint;

hint hint_for(const char *word, size_t length);

/* Offer a candidate. It is near enough if other programs use the word for it, if it begins with the word, or if few
 * edits turn the word into it: insert, delete or replace a letter, or swap two neighbours. Case does not count. */
void hint_offer(hint *h, const char *name);

/* Write the text between an error and its advice: ", did you mean --size? " with `before` = "--", or "; " if no
 * candidate is near enough. Returns `text`. */
#define HINT_TEXT 96
const char *hint_text(const hint *h, const char *before, char text[HINT_TEXT]);

/* ---- Commands ----------------------------------------------------------------------------------------------- */

/* Set the name by which the program was called, argv[0]. Call it once, before any thread starts. */
void hint_set_program(const char *called);

/* Returns that name, quoted for a shell; "octreel" if it is not set. */
const char *hint_program_name(void);

/* Write a text and replace the "octreel" of commands by hint_program_name(). Within sentences it stays. */
void hint_write_commands(FILE *out, const char *text);

/* Write a word quoted for a shell, with control characters escaped. A word that begins with - becomes a path, ./-... */
void hint_write_word(FILE *out, const char *text);

#endif
