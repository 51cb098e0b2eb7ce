/* SPDX-License-Identifier: MIT */
/* prose.h - formats help texts. The indentation of a line says what it is:
 *
 *     HEADING, a line without lower-case letters
 *     a paragraph; an empty line ends it
 *       TERM  its description, after two spaces;
 *             more deeply indented lines continue it
 *       an indented paragraph
 *         verbatim lines, indented by at least four spaces
 */
#ifndef CLI_PROSE_H
#define CLI_PROSE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Width of wrapped lines. */
#define PROSE_WIDTH 80

typedef enum prose_kind { PROSE_HEADING, PROSE_PARAGRAPH, PROSE_ITEM, PROSE_VERBATIM } prose_kind;

/* A block of a text. `text` still contains its line ends and indentation. */
typedef struct prose_block {
    prose_kind kind;
    int indent; /* indentation of its first line */
    const char *term, *text;
    size_t term_length, length;
} prose_block;

/* Read the next block at *at and move *at past it. False: end of the text. */
bool prose_next_block(const char **at, prose_block *block);

/* Read the next word at *at and move *at past it. Null: `end` is reached. */
const char *prose_next_word(const char **at, const char *end, size_t *length);

/* Read the next line and strip up to `indent` spaces of indentation. Null: `end` is reached. */
const char *prose_next_line(const char **at, const char *end, int indent, size_t *length);

/* Write words, wrapped at PROSE_WIDTH. The output is at `column`; further lines are indented by `indent` spaces. */
void prose_fill(FILE *out, const char *text, size_t length, int column, int indent);

/* Write wrapped words at `column`, beside a term of `width` characters that is already written; on the next line if
 * fewer than two spaces would lie between. */
void prose_fill_column(FILE *out, int width, const char *text, size_t length, int column);

/* Write a whole text. */
void prose_print(FILE *out, const char *text);

#endif
