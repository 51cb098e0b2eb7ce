/* SPDX-License-Identifier: MIT */
/* prose.h - texts for people: what their lines are, by how they are set in, and lines that are filled.
 *
 *     HEADING, without a small letter
 *     a paragraph, which ends at an empty line
 *       TERM  what it is, two blanks behind it;
 *             lines that are set in further go on with it
 *       a paragraph that is set in by two
 *         lines as they are, set in by four
 */
#ifndef CLI_PROSE_H
#define CLI_PROSE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* What help is filled to. */
#define PROSE_WIDTH 80

typedef enum prose_kind { PROSE_HEADING, PROSE_PARAGRAPH, PROSE_ITEM, PROSE_VERBATIM } prose_kind;

/* A part of a text; within `text` lines end and are set in as they are in it. */
typedef struct prose_block {
    prose_kind kind;
    int indent; /* blanks before its first line */
    const char *term, *text;
    size_t term_length, length;
} prose_block;

/* Take the next block from *at, which then is behind it; false at the end. */
bool prose_next(const char **at, prose_block *block);

/* Take the next word from *at, which ends at `end`. Null at the end. */
const char *prose_word(const char **at, const char *end, size_t *length);

/* Take the next line, without what it is set in by. */
const char *prose_line(const char **at, const char *end, int indent, size_t *length);

/* Write words in lines that begin with `indent` blanks, the first at `column`; ends the last. */
void prose_fill(FILE *out, const char *text, size_t length, int column, int indent);

/* Write words beside a term, `width` blanks and letters that are written already: from `column` on, in the next line
 * where there is no room for two blanks between. */
void prose_fill_column(FILE *out, int width, const char *text, size_t length, int column);

/* Write a whole text so. */
void prose_print(FILE *out, const char *text);

#endif
