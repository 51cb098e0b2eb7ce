/* SPDX-License-Identifier: MIT */
/* help.c - prints --help and --version from the tables of the commands. */
#include "help.h"
#include "hint.h"
#include "prose.h"
#include "renderer.h"

#include <string.h>

/* ---- Options ------------------------------------------------------------------------------------------------ */

enum { COMMAND_COLUMN = 18, OPTION_COLUMN = 24, CHOICE_WIDTH = 12 };

static void print_wrapped(FILE *out, const char *text, int column)
{
    prose_write_wrapped(out, text, strlen(text), column, column);
}

/* Prints the possible values of an option below its description, one on each line. */
static void print_choices(FILE *out, const command_option *option)
{
    for (int i = 0; option->names(i); i++) {
        fprintf(out, "%*s%-*s", OPTION_COLUMN, "", CHOICE_WIDTH, option->names(i));
        print_wrapped(out, option->words(i), OPTION_COLUMN + CHOICE_WIDTH);
    }
}

/* Prints an option with its description: " -o, --output DIR where the recording goes". */
static void print_option(FILE *out, const command_option *option)
{
    const char letter = option_letter(option->name), short_form[] = {'-', letter, ',', 0};
    const int width = fprintf(out, "  %-3s --%s%s%s", letter ? short_form : "", option->name, option->value ? " " : "",
                              option->value ? option->value : "");
    prose_write_column(out, width, option->help, strlen(option->help), OPTION_COLUMN);
    if (option->words)
        print_choices(out, option);
}

static void print_options(FILE *out, const command *c)
{
    command_option option;
    bool had = false;
    for (size_t n = 0; command_option_at(c, n, &option); n++) {
        if (!option.name) {
            fputs(had ? "\n" : "", out);
            print_wrapped(out, option.help, 0);
        } else {
            print_option(out, &option);
        }
        had = true;
    }
}

/* ---- Commands ----------------------------------------------------------------------------------------------- */

static void print_row(FILE *out, const char *help, const char *name, const char *line)
{
    prose_write_column(out, fprintf(out, "  %s%s", help, name), line, strlen(line), COMMAND_COLUMN);
}

static void print_commands(FILE *out)
{
    fputs("Commands:\n", out);
    for (size_t i = 0; command_at(i); i++)
        print_row(out, "", command_at(i)->name, command_at(i)->line);
    print_row(out, "help ", "COMMAND", "print the help of a command, as COMMAND --help does");
    for (size_t i = 0; help_topic_at(i); i++)
        print_row(out, "help ", help_topic_at(i)->name, help_topic_at(i)->line);
    print_row(out, "", "--version", "print the version and the available renderers");
}

const char *command_status_meaning(const command *c, int status)
{
    static const char *const usual[] = {[EXIT_DONE] = "done", [EXIT_TROUBLE] = "error"};
    return c->statuses[status] ? c->statuses[status] : usual[status];
}

static void print_exit_statuses(FILE *out, const command *c)
{
    fputs("\nExit status:\n", out);
    for (int i = EXIT_DONE; i <= EXIT_TROUBLE; i++)
        if (command_status_meaning(c, i)) {
            fprintf(out, "  %d  ", i);
            prose_write_wrapped(out, command_status_meaning(c, i), strlen(command_status_meaning(c, i)), 5, 5);
        }
}

/* Prints the examples of a command. The word "octreel" in them is replaced by the name by which the user called the
 * program. */
static void print_examples(FILE *out, const char *examples)
{
    fputs("Examples:\n", out);
    for (const char *line = examples; *line; line += strcspn(line, "\n") + 1) {
        char example[256];
        snprintf(example, sizeof example, "  %.*s\n", (int)strcspn(line, "\n"), line);
        hint_write_commands(out, example);
    }
    putc('\n', out);
}

int help_print(FILE *out, const command *c)
{
    const bool whole = c == &command_octreel;
    fprintf(out, "%s%s: %s\n\nusage: %s%s%s %s\n\n", whole ? "" : "octreel ", c->name, c->line, hint_program_name(),
            whole ? "" : " ", whole ? "" : c->name, c->usage);
    prose_print(out, c->about);
    putc('\n', out);
    print_examples(out, c->examples);
    if (whole)
        print_commands(out);
    else
        print_options(out, c);
    if (c->more) {
        putc('\n', out);
        prose_print(out, c->more);
    }
    print_exit_statuses(out, c);
    return EXIT_DONE;
}

/* ---- The version -------------------------------------------------------------------------------------------- */

/* Prints the name of the renderer of a kind of GL context. If the context cannot be opened, prints the reason and
 * returns false. */
static bool print_renderer(draw_context kind)
{
    const renderer_choice choice = {.context = kind, .fill = DRAW_FILL_GL};
    octreel_error error;
    renderer *r = renderer_open(16, 16, &choice, &error);
    if (!r) {
        printf("%s: %s\n", draw_context_name(kind), error.text);
        return false;
    }
    const renderer_info info = renderer_describe(r);
    printf("%s: %s, %s\n", info.context, info.renderer, info.version);
    renderer_close(r);
    return true;
}

int version_print(void)
{
    int built = 0, found = 0;
    printf("octreel %s\n", OCTREEL_VERSION);
    for (int kind = DRAW_AUTO + 1; kind < DRAW_CONTEXTS; kind++) {
        built += draw_context_is_built((draw_context)kind);
        found += draw_context_is_built((draw_context)kind) && print_renderer((draw_context)kind);
    }
    if (!built)
        puts("built without OpenGL");
    return found || !built ? EXIT_DONE : EXIT_TROUBLE;
}
