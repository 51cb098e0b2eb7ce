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

hint hint_create(const char *word, size_t length);

/* Compare the word with a candidate and keep the nearest. A candidate is near enough if other programs use the word for
 * it, if it begins with the word, or if few edits turn the word into it: insert, delete or replace a letter, or swap
 * two neighbours. Upper and lower case are equal. */
void hint_add_candidate(hint *h, const char *name);

/* Write the text between an error and its advice: ", did you mean --size? " with `before` = "--", or "; " if no
 * candidate is near enough. Returns `text`. */
#define HINT_TEXT 96
const char *hint_format(const hint *h, const char *before, char text[HINT_TEXT]);

/* ---- Commands ----------------------------------------------------------------------------------------------- */

/* Set the name by which the program was called, argv[0]. Call it once, before any thread starts. */
void hint_set_program(const char *called);

/* Returns the name set by hint_set_program(), quoted for a shell; "octreel" if none is set. */
const char *hint_program_name(void);

/* Write a text and replace "octreel" by hint_program_name() where it begins a command. Within sentences it stays. */
void hint_write_commands(FILE *out, const char *text);

/* Write a word quoted for a shell, with control characters escaped. A word that begins with - becomes a path, ./-... */
void hint_write_shell_word(FILE *out, const char *text);

#endif
