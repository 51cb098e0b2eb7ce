/* SPDX-License-Identifier: MIT */
/* manual.c - writes manuals with the man(7) macros that groff, man-db and mandoc all support. */
#include "manual.h"
#include "prose.h"

#include <ctype.h>
#include <string.h>

enum { LINE = 78 }; /* the maximum number of characters in a line of roff source */

/* ---- Text --------------------------------------------------------------------------------------------------- */

/* The notation by which roff prints a character. */
typedef struct literal {
    char text[5];
} literal;

/* Returns the roff notation that prints a character unchanged. Roff would typeset a plain - as a hyphen and a plain
 * ' as a closing quotation mark. */
static literal escape_literal(char c)
{
    static const char from[] = "\\-'`^~";
    static const literal to[] = {{"\\e"}, {"\\-"}, {"\\(aq"}, {"\\(ga"}, {"\\(ha"}, {"\\(ti"}};
    const char *found = strchr(from, c);
    return found ? to[found - from] : (literal){{c}};
}

/* Begins a line of text whose first character is `first`. A character that would make the line a roff macro is
 * protected. */
static void begin_line(FILE *out, char first)
{
    if (first == '.' || first == '\'')
        fputs("\\&", out);
}

static void write_code(FILE *out, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        fputs(escape_literal(text[i]).text, out);
}

static void write_bold(FILE *out, const char *text, size_t length)
{
    fputs("\\fB", out);
    write_code(out, text, length);
    fputs("\\fR", out);
}

/* Returns the length of the option with which a word begins: 6 for "--size,", 2 for "-o". Returns 0 if the word is
 * not an option. */
static size_t length_of_option_at_start(const char *word, size_t length)
{
    size_t end = 0;
    while (end < length && (isalnum((unsigned char)word[end]) || word[end] == '-'))
        end++;
    const bool named = end > 2 && word[0] == '-' && word[1] == '-' && isalpha((unsigned char)word[2]);
    return named || (end == 2 && word[0] == '-' && isalpha((unsigned char)word[1])) ? end : 0;
}

enum { WORD = 512 }; /* the room for a word in roff notation, in bytes */

static void append_to_word(char set[WORD], const char *text)
{
    strncat(set, text, WORD - 1 - strlen(set));
}

/* Formats a word of a sentence in roff notation. Options, and text between backquotes, become bold. Hyphens inside
 * words stay hyphens. *code is true while the text is between two backquotes. */
static void format_word(char set[WORD], const char *word, size_t length, bool *code)
{
    const size_t before = strspn(word, "(\""), quoted = before < length ? before : 0;
    const size_t option = *code ? 0 : length_of_option_at_start(word + quoted, length - quoted), rest = quoted + option;
    for (size_t i = 0; i < length; i++) {
        const bool plain = word[i] == '\'' || (word[i] == '-' && i > 0 && isalpha((unsigned char)word[i - 1]));
        if (option && i == quoted)
            append_to_word(set, "\\fB");
        if (i >= rest && word[i] == '`')
            append_to_word(set, (*code = !*code) ? "\\fB" : "\\fR");
        else
            append_to_word(set, i >= rest && !*code && plain ? (char[]){word[i], 0} : escape_literal(word[i]).text);
        if (option && i + 1 == rest)
            append_to_word(set, "\\fR");
    }
}

/* Writes words as lines of roff source with at most LINE characters each. */
static void write_words(FILE *out, const char *text, size_t length)
{
    const char *at = text, *word;
    size_t size, column = 0;
    bool code = false;
    while ((word = prose_next_word(&at, text + length, &size))) {
        char set[WORD] = "";
        format_word(set, word, size, &code);
        const size_t width = strlen(set);
        if (column && column + 1 + width > LINE)
            putc('\n', out), column = 0;
        if (column)
            putc(' ', out), column++;
        else
            begin_line(out, *set);
        fputs(set, out);
        column += width;
    }
    putc('\n', out);
}

static void write_sentence(FILE *out, const char *text)
{
    write_words(out, text, strlen(text));
}

static void write_lines(FILE *out, const char *text, size_t length, int indent)
{
    const char *at = text, *line;
    size_t size;
    fputs(".EX\n", out);
    while ((line = prose_next_line(&at, text + length, indent, &size))) {
        begin_line(out, *line);
        write_code(out, line, size);
        putc('\n', out);
    }
    fputs(".EE\n", out);
}

/* Begins a section. The section's name ends at the first line end in `name`. */
static void write_section_heading(FILE *out, const char *name)
{
    fputs(".SH ", out);
    write_code(out, name, strcspn(name, "\n"));
    putc('\n', out);
}

static void write_term(FILE *out, const char *term, size_t length)
{
    fputs(".TP\n", out);
    write_bold(out, term, length);
    putc('\n', out);
}

static void write_text(FILE *out, const char *text)
{
    prose_block block;
    bool begins = true; /* true: a paragraph has just begun; the macro .SH also begins a paragraph */
    for (const char *at = text; prose_next_block(&at, &block);) {
        switch (block.kind) {
        case PROSE_HEADING:
            write_section_heading(out, block.text);
            break;
        case PROSE_ITEM:
            write_term(out, block.term, block.term_length);
            write_words(out, block.text, block.length);
            break;
        case PROSE_VERBATIM:
            fputs(begins ? ".RS 4\n" : ".PP\n.RS 4\n", out);
            write_lines(out, block.text, block.length, block.indent);
            fputs(".RE\n", out);
            break;
        case PROSE_PARAGRAPH:
            fputs(begins ? "" : ".PP\n", out);
            write_words(out, block.text, block.length);
            break;
        }
        begins = block.kind == PROSE_HEADING;
    }
}

static void write_text_section(FILE *out, const char *name, const char *text)
{
    if (!text)
        return;
    write_section_heading(out, name);
    write_text(out, text);
}

/* ---- Sections ----------------------------------------------------------------------------------------------- */

/* Writes the name of a command's manual: "octreel-record", or "octreel" for the program itself. */
static void write_page_name(FILE *out, const char *name)
{
    fputs("octreel", out);
    if (strcmp(name, command_octreel.name) != 0)
        fprintf(out, "\\-%s", name);
}

static void write_title(FILE *out, const char *name, int section, const char *line)
{
    fputs(".TH \"", out);
    write_page_name(out, name);
    fprintf(out, "\" %d %s \"Octreel %s\" Octreel\n.nr HY 0\n.ad l\n.SH NAME\n", section, OCTREEL_DATE,
            OCTREEL_VERSION);
    write_page_name(out, name);
    fputs(" \\- ", out);
    write_sentence(out, line);
}

/* Writes a usage line with bold options and italic placeholders. */
static void write_usage(FILE *out, const char *usage)
{
    for (const char *at = usage; *at;) {
        const size_t option = at == usage || strchr(" [", at[-1]) ? length_of_option_at_start(at, strlen(at)) : 0;
        const size_t name = strspn(at, "ABCDEFGHIJKLMNOPQRSTUVWXYZ");
        if (option)
            write_bold(out, at, option);
        else if (name)
            fprintf(out, "\\fI%.*s\\fR", (int)name, at);
        else
            write_code(out, at, 1);
        at += option ? option : name ? name : 1;
    }
    putc('\n', out);
}

static void write_option(FILE *out, const command_option *o)
{
    const char letter[] = {'-', option_letter(o->name), 0};
    fputs(".TP\n", out);
    if (letter[1]) {
        write_bold(out, letter, 2);
        fputs(", ", out);
    }
    write_bold(out, "--", 2);
    write_bold(out, o->name, strlen(o->name));
    if (o->value) {
        fputs(" \\fI", out);
        write_code(out, o->value, strlen(o->value));
        fputs("\\fR", out);
    }
    putc('\n', out);
    write_sentence(out, o->help);
    if (!o->words)
        return;
    fputs(".RS\n.PD 0\n", out); /* print no empty lines between the possible values */
    for (int i = 0; o->names(i); i++) {
        write_term(out, o->names(i), strlen(o->names(i)));
        write_sentence(out, o->words(i));
    }
    fputs(".PD\n.RE\n", out);
}

static void write_options(FILE *out, const command *c)
{
    command_option option;
    for (size_t n = 0; command_option_at(c, n, &option); n++) {
        if (option.name) {
            write_option(out, &option);
            continue;
        }
        fputs(n ? ".PP\n" : "", out);
        write_sentence(out, option.help);
    }
}

static void write_statuses(FILE *out, const command *c)
{
    for (int i = EXIT_DONE; i <= EXIT_TROUBLE; i++)
        if (command_status_meaning(c, i)) {
            write_term(out, &"012"[i], 1);
            write_sentence(out, command_status_meaning(c, i));
        }
}

/* Returns whether the help texts of a command contain the given words, such as "octreel join". */
static bool mentions_words(const command *c, const char *words)
{
    const char *const texts[] = {c->about, c->more, c->examples, c->files};
    command_option o;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        if (texts[i] && strstr(texts[i], words))
            return true;
    for (size_t n = 0; command_option_at(c, n, &o); n++)
        if (o.help && strstr(o.help, words))
            return true;
    return false;
}

/* Writes a reference to a manual, unless that is the manual `own`, which is being written. *begun becomes true when the
 * first reference is written. */
static void write_reference(FILE *out, const char *name, int section, const char *own, bool *begun)
{
    if (strcmp(name, own) == 0)
        return;
    fputs(*begun ? ",\n.BR " : ".BR ", out);
    write_page_name(out, name);
    fprintf(out, " (%d)", section);
    *begun = true;
}

/* Writes the section SEE ALSO in the manual of a command or a topic. The section refers to octreel(1), to the commands
 * that the texts mention, and to all topics. */
static void write_see_also(FILE *out, const command *c, const help_topic *topic)
{
    const char *own = c ? c->name : topic->name;
    char words[64];
    bool begun = false;
    write_section_heading(out, "SEE ALSO");
    write_reference(out, command_octreel.name, 1, own, &begun);
    for (size_t i = 0; command_at(i); i++) {
        snprintf(words, sizeof words, "octreel %s", command_at(i)->name);
        if (c == &command_octreel || (c ? mentions_words(c, words) : strstr(topic->text, words) != NULL))
            write_reference(out, command_at(i)->name, 1, own, &begun);
    }
    for (size_t i = 0; help_topic_at(i); i++)
        write_reference(out, help_topic_at(i)->name, 5, own, &begun);
    putc('\n', out);
}

/* ---- Pages -------------------------------------------------------------------------------------------------- */

static void write_commands(FILE *out)
{
    write_section_heading(out, "COMMANDS");
    for (size_t i = 0; command_at(i); i++) {
        fputs(".TP\n.BR ", out);
        write_page_name(out, command_at(i)->name);
        fputs(" (1)\n", out);
        write_sentence(out, command_at(i)->line);
    }
}

void manual_write(FILE *out, const command *c)
{
    static const char environment[] =
        "  TERM      if empty or \"dumb\", no progress is shown\n"
        "  NO_COLOR  has no effect: the output never contains colours or escape sequences\n";
    write_title(out, c->name, 1, c->line);
    write_section_heading(out, "SYNOPSIS");
    fprintf(out, "\\fBoctreel%s%s\\fR ", c == &command_octreel ? "" : " ", c == &command_octreel ? "" : c->name);
    write_usage(out, c->usage);
    write_text_section(out, "DESCRIPTION", c->about);
    if (c == &command_octreel)
        write_commands(out);
    write_section_heading(out, "OPTIONS");
    write_options(out, c);
    write_text_section(out, "NOTES", c->more);
    write_section_heading(out, "EXIT STATUS");
    write_statuses(out, c);
    write_text_section(out, "ENVIRONMENT", c->environment ? c->environment : "");
    write_text(out, environment);
    write_text_section(out, "FILES", c->files);
    write_section_heading(out, "EXAMPLES");
    write_lines(out, c->examples, strlen(c->examples), 0);
    write_see_also(out, c, NULL);
}

void manual_write_topic(FILE *out, const help_topic *topic)
{
    write_title(out, topic->name, 5, topic->line);
    write_text_section(out, "DESCRIPTION", topic->text);
    write_see_also(out, NULL, topic);
}
