/* SPDX-License-Identifier: MIT */
/* hint.c - suggests the known name that is nearest to a mistyped word, and prints commands in the form in which the
 * user types them.
 *
 * The distance of two words is their optimal string alignment distance: the smallest number of edits that turn one word
 * into the other. An edit inserts, deletes or replaces a letter, or swaps two neighbouring letters. Nearly all typing
 * mistakes are one of these edits; plain Levenshtein distance would count a swap as two.
 *
 * The distance is computed by dynamic programming. Cell (i, j) is the distance of the first i letters of one word and
 * the first j letters of the other. A cell depends only on the cells one step back in one or both words and, for a
 * swap, on the cell two steps back in both words. So three rows of the table are enough. Cost: the product of the
 * lengths, for words of fewer than 40 letters.
 *
 * A suggestion may need at most a third as many edits as the word has letters; otherwise every word would resemble some
 * option. Source: Damerau 1964; Boytsov 2011, "Indexing methods for approximate dictionary searching".
 */
#include "hint.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

/* ---- The nearest name -------------------------------------------------------------------------------------- */

enum { LONGEST = 40, SHORTEST_BEGINNING = 3 };

/* Names of options and commands of other programs, such as odiff, ffmpeg and make. Beside each name is Octreel's name
 * for the same option or command. Commands that overwrite files have --force; octreel record also has --replace, which
 * comes first in its table of options and is therefore suggested. */
static const char *const synonyms[][2] = {
    {"force", "replace"},    {"overwrite", "replace"},   {"clobber", "replace"},
    {"replace", "force"},    {"overwrite", "force"},     {"clobber", "force"},
    {"continue", "resume"},  {"movie", "film"},          {"video", "film"},
    {"gif", "film"},         {"animate", "film"},        {"run", "record"},
    {"render", "record"},    {"check", "verify"},        {"replay", "verify"},
    {"compare", "diff"},     {"merge", "join"},          {"concat", "join"},
    {"view", "inspect"},     {"show", "inspect"},        {"info", "inspect"},
    {"update", "accept"},    {"approve", "accept"},      {"hash", "accept"},
    {"checksum", "accept"},  {"threshold", "max-delta"}, {"tolerance", "max-delta"},
    {"fuzz", "max-delta"},   {"threads", "jobs"},        {"resolution", "size"},
    {"width", "size"},       {"height", "size"},         {"step", "every"},
    {"palette", "color-by"}, {"antialiasing", "aa"},     {"frames", "ticks"},
    {"bounds", "world"},
};

hint hint_create(const char *word, size_t length)
{
    return (hint){.word = word, .length = length};
}

static size_t minimum(size_t a, size_t b)
{
    return a < b ? a : b;
}

static int to_lower_case(char c)
{
    return tolower((unsigned char)c);
}

/* Returns the optimal string alignment distance of two words, ignoring case, or LONGEST if a word is too long. */
static size_t find_edit_distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t rows[3][LONGEST + 1];
    if (a_length >= LONGEST || b_length >= LONGEST)
        return LONGEST;
    for (size_t i = 0; i <= a_length; i++) {
        size_t *now = rows[i % 3], *last = rows[(i + 2) % 3], *before = rows[(i + 1) % 3];
        for (size_t j = 0; j <= b_length; j++) {
            if (i == 0 || j == 0) {
                now[j] = i + j;
                continue;
            }
            const bool same = to_lower_case(a[i - 1]) == to_lower_case(b[j - 1]);
            now[j] = minimum(minimum(last[j], now[j - 1]) + 1, last[j - 1] + !same);
            if (i > 1 && j > 1 && to_lower_case(a[i - 1]) == to_lower_case(b[j - 2]) &&
                to_lower_case(a[i - 2]) == to_lower_case(b[j - 1]))
                now[j] = minimum(now[j], before[j - 2] + 1);
        }
    }
    return rows[a_length % 3][b_length];
}

static bool is_synonym(const hint *h, const char *name)
{
    for (size_t i = 0; i < sizeof synonyms / sizeof synonyms[0]; i++)
        if (strlen(synonyms[i][0]) == h->length && strncasecmp(h->word, synonyms[i][0], h->length) == 0 &&
            strcmp(name, synonyms[i][1]) == 0)
            return true;
    return false;
}

/* Returns whether a name is near enough to the mistyped word to be suggested. A third of the word's letters may be
 * wrong, or one letter if the word has fewer than three letters. A name that begins with the word is always near
 * enough. */
static bool is_near_enough(const hint *h, const char *name, size_t length, size_t distance)
{
    const size_t allowed = h->length / 3;
    const bool begins = h->length >= SHORTEST_BEGINNING && strncasecmp(name, h->word, h->length) == 0;
    return begins || (distance < minimum(h->length, length) && distance <= (allowed ? allowed : 1));
}

void hint_add_candidate(hint *h, const char *name)
{
    const size_t length = strlen(name);
    const bool means = is_synonym(h, name);
    const size_t distance = means ? 0 : find_edit_distance(h->word, h->length, name, length);
    if ((h->name && distance >= h->distance) || !(means || is_near_enough(h, name, length, distance)))
        return;
    h->name = name;
    h->distance = distance;
}

const char *hint_format(const hint *h, const char *before, char text[HINT_TEXT])
{
    if (h->name)
        snprintf(text, HINT_TEXT, ", did you mean %s%s? ", before, h->name);
    else
        memcpy(text, "; ", sizeof "; ");
    return text;
}

/* ---- Commands ----------------------------------------------------------------------------------------------- */

#define PROGRAM "octreel"

enum { LONGEST_CALL = 200 }; /* if the program's name is longer than this, "octreel" is printed instead */

static char program[9 * LONGEST_CALL + 8] = PROGRAM;

void hint_set_program(const char *called)
{
    if (!called || !*called || strlen(called) > LONGEST_CALL)
        return;
    FILE *out = fmemopen(program, sizeof program, "w");
    if (!out)
        return;
    hint_write_shell_word(out, called);
    fclose(out);
}

const char *hint_program_name(void)
{
    return program;
}

/* Returns whether "octreel" at `at` begins a command: at the start of a line, after indentation, or after "usage:",
 * "&&" and similar signs. Within sentences "octreel" does not begin a command. */
static bool is_command_start(const char *text, const char *at)
{
    if (at == text || at[-1] != ' ')
        return at == text || at[-1] == '\n';
    return at == text + 1 || strchr(" :;&|", at[-2]);
}

void hint_write_commands(FILE *out, const char *text)
{
    static const char word[] = PROGRAM " ";
    const size_t length = sizeof word - 1;
    for (const char *at = text, *found; *at; at = found) {
        found = strstr(at, word);
        const bool command = found && isalpha((unsigned char)found[length]) && is_command_start(text, found);
        const char *end = !found ? at + strlen(at) : command ? found : found + length;
        fwrite(at, 1, (size_t)(end - at), out);
        if (command)
            fprintf(out, "%s ", program);
        found = command ? found + length : end;
    }
}

void hint_write_shell_word(FILE *out, const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+:,-";
    if (*text && *text != '-' && strspn(text, plain) == strlen(text)) {
        fputs(text, out);
        return;
    }
    fputs(*text == '-' ? "'./" : "'", out);
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 127)
            fprintf(out, "'$'\\%03o''", (unsigned)*text);
        else
            fputs(*text == '\'' ? "'\\''" : (char[]){*text, 0}, out);
    putc('\'', out);
}
