/* SPDX-License-Identifier: MIT */
/* hint.h - helps users to correct typing mistakes: finds the known name nearest to a mistyped word, and prints commands
 * that users can copy. */
#ifndef BASE_HINT_H
#define BASE_HINT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* ---- The nearest name -------------------------------------------------------------------------------------- */

/* A mistyped word, and the nearest of the candidates that were added so far. */
typedef struct hint {
    const char *word;
    size_t length;
    const char *name; /* the nearest candidate; null: no candidate is near enough */
    size_t distance;
} hint;

hint hint_create(const char *word, size_t length);

/* Compares the word with a candidate and keeps the nearest candidate. A candidate is near enough in three cases: other
 * programs use the mistyped word for the same option, the candidate begins with the word, or few edits turn the word
 * into the candidate. An edit inserts, deletes or replaces a letter, or swaps two neighbouring letters. Case is
 * ignored. */
void hint_add_candidate(hint *h, const char *name);

/* Writes the text between an error and its advice. With `before` = "--" the text is ", did you mean --size? "; if no
 * candidate is near enough, the text is "; ". Returns `text`. */
#define HINT_TEXT 96
const char *hint_format(const hint *h, const char *before, char text[HINT_TEXT]);

/* ---- Commands ----------------------------------------------------------------------------------------------- */

/* Sets the name by which the user called the program, argv[0]. Must be called once, before any thread starts. */
void hint_set_program(const char *called);

/* Returns the name that hint_set_program() set, quoted for a shell. If no name was set, returns "octreel". */
const char *hint_program_name(void);

/* Writes a text. Where "octreel" begins a command, the name from hint_program_name() is written instead. Within
 * sentences "octreel" stays. */
void hint_write_commands(FILE *out, const char *text);

/* Writes a word, quoted for a shell and with control characters escaped. A word that begins with "-" is written as a
 * path that begins with "./-", so that it cannot be taken for an option. */
void hint_write_shell_word(FILE *out, const char *text);

#endif
