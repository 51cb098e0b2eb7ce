/* SPDX-License-Identifier: MIT */
/* prose.c - splits help texts into blocks and wraps their words.
 *
 * One source text serves --help and man pages, which lay it out differently. So the text must mark the kind of each
 * part. The indentation of the lines does so, as prose.h describes; other markup would make the C strings unreadable.
 * The first line of a block decides its kind. The block continues while the following lines have the indentation of
 * this kind.
 *
 * Wrapping is greedy: a word goes on the current line if it fits into 80 columns, otherwise on the next line. Greedy
 * wrapping gives the fewest lines, in one pass and without a buffer. Optimal-fit wrapping (Knuth and Plass) would only
 * make the right margin more even. Cost: O(length of the text).
 */
#include "prose.h"

#include <string.h>

/* ---- Blocks ------------------------------------------------------------------------------------------------- */

static size_t line_length(const char *line)
{
    return strcspn(line, "\n");
}

static int count_indent(const char *line)
{
    return (int)strspn(line, " ");
}

static bool is_blank_line(const char *line)
{
    return line_length(line) == (size_t)count_indent(line);
}

static const char *next_line(const char *line)
{
    line += line_length(line);
    return *line ? line + 1 : line;
}

static bool is_heading(const char *line)
{
    for (size_t i = 0; i < line_length(line); i++)
        if (line[i] >= 'a' && line[i] <= 'z')
            return false;
    return true;
}

/* Returns the start of the description in a line that begins an item. Returns null if the line does not begin an
 * item. */
static const char *find_item_text(const char *line)
{
    const char *term = line + count_indent(line), *gap = strstr(term, "  ");
    return gap && gap < line + line_length(line) ? gap + count_indent(gap) : NULL;
}

/* Returns whether a line belongs to the block that precedes it. */
static bool continues_block(const prose_block *block, const char *line)
{
    const int indent = count_indent(line);
    if (!*line || is_blank_line(line))
        return false;
    if (block->kind == PROSE_ITEM)
        return indent > block->indent + 2;
    return block->kind == PROSE_VERBATIM ? indent >= block->indent
                                         : indent == block->indent && (indent == 0 || !find_item_text(line));
}

static const char *skip_blank_lines(const char *at)
{
    while (*at && is_blank_line(at))
        at = next_line(at);
    return at;
}

bool prose_next_block(const char **at, prose_block *block)
{
    const char *line = skip_blank_lines(*at), *end, *text;
    if (!*line)
        return false;
    *block = (prose_block){PROSE_PARAGRAPH, count_indent(line), .text = line};
    if (block->indent == 0 && is_heading(line)) {
        block->kind = PROSE_HEADING;
    } else if (block->indent >= 4) {
        block->kind = PROSE_VERBATIM;
    } else if (block->indent > 0 && (text = find_item_text(line))) {
        block->kind = PROSE_ITEM;
        block->term = line + block->indent;
        block->term_length = (size_t)(strstr(block->term, "  ") - block->term);
        block->text = text;
    }
    for (end = next_line(line); block->kind != PROSE_HEADING; end = next_line(end)) {
        const char *more = block->kind == PROSE_VERBATIM ? skip_blank_lines(end) : end;
        if (!continues_block(block, more))
            break;
        end = more;
    }
    block->length = (size_t)(end - block->text);
    *at = end;
    return true;
}

const char *prose_next_word(const char **at, const char *end, size_t *length)
{
    const char *word = *at;
    while (word < end && (*word == ' ' || *word == '\n'))
        word++;
    for (*at = word; *at < end && **at != ' ' && **at != '\n';)
        ++*at;
    *length = (size_t)(*at - word);
    return *length ? word : NULL;
}

const char *prose_next_line(const char **at, const char *end, int indent, size_t *length)
{
    const char *line = *at;
    if (line >= end)
        return NULL;
    *at = next_line(line);
    line += count_indent(line) < indent ? count_indent(line) : indent;
    *length = line_length(line);
    return line;
}

/* ---- Filled lines ------------------------------------------------------------------------------------------- */

void prose_write_wrapped(FILE *out, const char *text, size_t length, int column, int indent)
{
    const char *at = text, *word;
    size_t size;
    bool begins = true;
    while ((word = prose_next_word(&at, text + length, &size))) {
        if (!begins && column + 1 + (int)size > PROSE_WIDTH) {
            fprintf(out, "\n%*s", indent, "");
            column = indent;
        } else if (!begins) {
            putc(' ', out);
            column++;
        }
        fwrite(word, 1, size, out);
        column += (int)size;
        begins = false;
    }
    putc('\n', out);
}

void prose_write_column(FILE *out, int width, const char *text, size_t length, int column)
{
    const bool fits = width + 2 <= column;
    fprintf(out, "%s%*s", fits ? "" : "\n", fits ? column - width : column, "");
    prose_write_wrapped(out, text, length, column, column);
}

/* The column of an item's description, counted from the item's indentation. If the item's term is too long for this
 * column, the description begins on the next line. */
enum { SHORT_TERM = 14 };

static void print_item(FILE *out, const prose_block *block)
{
    const int width = fprintf(out, "%*s%.*s", block->indent, "", (int)block->term_length, block->term);
    prose_write_column(out, width, block->text, block->length, block->indent + SHORT_TERM);
}

static void print_lines(FILE *out, const prose_block *block)
{
    const char *at = block->text, *line;
    size_t length;
    while ((line = prose_next_line(&at, block->text + block->length, 0, &length)))
        fprintf(out, "%.*s\n", (int)length, line);
}

/* Returns whether an empty line is printed between two blocks: always, except after a heading and between two items. */
static bool needs_empty_line(prose_kind before, prose_kind kind)
{
    return before != PROSE_HEADING && !(before == PROSE_ITEM && kind == PROSE_ITEM);
}

void prose_print(FILE *out, const char *text)
{
    prose_block block;
    prose_kind before = PROSE_HEADING;
    for (const char *at = text; prose_next_block(&at, &block); before = block.kind) {
        if (needs_empty_line(before, block.kind))
            putc('\n', out);
        if (block.kind == PROSE_ITEM)
            print_item(out, &block);
        else if (block.kind == PROSE_PARAGRAPH)
            fprintf(out, "%*s", block.indent, ""),
                prose_write_wrapped(out, block.text, block.length, block.indent, block.indent);
        else
            print_lines(out, &block);
    }
}
