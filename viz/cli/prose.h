/* SPDX-License-Identifier: MIT */
/* prose.h - formats help texts. The indentation of a line says which kind of block it belongs to:
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

/* The maximum number of columns in a wrapped line. */
#define PROSE_WIDTH 80

typedef enum prose_kind { PROSE_HEADING, PROSE_PARAGRAPH, PROSE_ITEM, PROSE_VERBATIM } prose_kind;

/* A block of a help text. Its lines are in `text`, with their line ends and indentation. */
typedef struct prose_block {
    prose_kind kind;
    int indent; /* the indentation of the block's first line, in columns */
    const char *term, *text;
    size_t term_length, length;
} prose_block;

/* Reads the next block at *at and moves *at past the block. Returns false at the end of the text. */
bool prose_next_block(const char **at, prose_block *block);

/* Returns the next word at *at, sets *length to its length, and moves *at past the word. Returns null if there is no
 * word before `end`. */
const char *prose_next_word(const char **at, const char *end, size_t *length);

/* Returns the next line at *at after up to `indent` spaces at its start. Sets *length to the length of the returned
 * text, and moves *at past the line. Returns null at `end`. */
const char *prose_next_line(const char **at, const char *end, int indent, size_t *length);

/* Writes words, wrapped at PROSE_WIDTH. `column` is the column at which the output already is. Further lines are
 * indented by `indent` spaces. */
void prose_write_wrapped(FILE *out, const char *text, size_t length, int column, int indent);

/* Writes wrapped words at `column`, beside a term of `width` characters that is already written. If fewer than two
 * spaces would separate term and words, the words begin on the next line. */
void prose_write_column(FILE *out, int width, const char *text, size_t length, int column);

/* Writes a whole help text. */
void prose_print(FILE *out, const char *text);

#endif
