/* SPDX-License-Identifier: MIT */
/* main.c - octreel's command line: a table of commands, and help on each. */
#include "command.h"
#include "file_kind.h"
#include "hint.h"
#include "options.h"
#include "session_text.h"

#include <stdio.h>
#include <string.h>

typedef struct command {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *line; /* what it does, in one line */
} command;

static const command commands[] = {
    {"record", cmd_record, "film a session: every tick of the game becomes one PNG frame"},
    {"play", cmd_play, "make a page of a session that plays it in a browser, and films nothing"},
    {"join", cmd_join, "make a recording that was filmed in chunks whole"},
    {"verify", cmd_verify, "play a recording again: is it still what its session makes?"},
    {"audit", cmd_audit, "judge what a program answered to queries: how much of it is wrong, and where"},
    {"pick", cmd_pick, "say what is drawn at a pixel of a frame"},
    {"inspect", cmd_inspect, "build a tree from a point cloud, draw its subdivision, print its statistics"},
    {"diff", cmd_diff, "compare two pictures, folders of them or recordings, exactly or within a tolerance"},
    {"digest", cmd_digest, "write digests of many frames, a small reference for diff"},
    {"accept", cmd_accept, "take over new frames as the reference"},
};

#define COMMANDS (sizeof commands / sizeof commands[0])

/* What help is about beside commands. */
static const struct {
    const char *name, *text, *line;
} topics[] = {
    {"session", session_text, "what a session file holds: a world, points, keys, edits, queries"},
};

#define TOPICS (sizeof topics / sizeof topics[0])

static void print_row(FILE *out, const char *help, const char *name, const char *line)
{
    fprintf(out, "  %s%-*s  %s\n", help, 14 - (int)strlen(help), name, line);
}

static int print_help(FILE *out)
{
    hint_write_commands(out, "octreel - an octree you can watch\n\nusage: octreel COMMAND [OPTION ...]\n\n");
    for (size_t i = 0; i < COMMANDS; i++)
        print_row(out, "", commands[i].name, commands[i].line);
    print_row(out, "help ", "COMMAND", "what a command takes; so does COMMAND --help");
    for (size_t i = 0; i < TOPICS; i++)
        print_row(out, "help ", topics[i].name, topics[i].line);
    print_row(out, "", "--version", "the version, and who would draw");
    fputs("\nExit status: 0 done, 1 finding, 2 trouble; stopped by a signal, that signal's (130 for Ctrl-C).\n", out);
    return out == stdout ? EXIT_DONE : EXIT_TROUBLE;
}

/* Whether a context of this kind can be opened, and its renderer. */
static bool print_renderer(draw_context kind)
{
    const renderer_choice choice = {.context = kind};
    octreel_error error;
    renderer *r = renderer_open(16, 16, &choice, &error);
    if (!r) {
        printf("%s: %s\n", draw_context_name(kind), error.text);
        return false;
    }
    const renderer_info info = renderer_about(r);
    printf("%s: %s, %s\n", info.context, info.renderer, info.version);
    renderer_close(r);
    return true;
}

static int print_version(void)
{
    int found = 0;
    printf("octreel %s\n", OCTREEL_VERSION);
    for (int kind = DRAW_AUTO + 1; kind < DRAW_CONTEXTS; kind++)
        if (draw_context_built((draw_context)kind))
            found += print_renderer((draw_context)kind);
    return found ? EXIT_DONE : EXIT_TROUBLE;
}

static const command *find_command(const char *name)
{
    for (size_t i = 0; i < COMMANDS; i++)
        if (strcmp(name, commands[i].name) == 0)
            return &commands[i];
    return NULL;
}

/* `help`: on what help was asked for. */
static int refuse_word(const char *word, bool help)
{
    static const char *const other_words[] = {"help", "--help", "--version"};
    char meant[HINT_TEXT];
    hint h = hint_for(word, strlen(word));
    for (size_t i = 0; i < COMMANDS; i++)
        hint_offer(&h, commands[i].name);
    for (size_t i = 0; help && i < TOPICS; i++)
        hint_offer(&h, topics[i].name);
    for (size_t i = 0; !help && i < sizeof other_words / sizeof other_words[0]; i++)
        hint_offer(&h, other_words[i]);
    const file_kind kind = help ? KIND_UNKNOWN : file_kind_of(word);
    if (file_kind_rows[kind].command)
        return trouble("there is no command \"%s\", which is %s; %s %s %s", word, file_kind_rows[kind].words,
                       hint_program(), file_kind_rows[kind].command, file_kind_rows[kind].use);
    if (!help && *word == '-' && !h.name)
        return trouble("a command comes first, and \"%s\" is an option; %s help lists them", word, hint_program());
    return trouble("there is no %s \"%s\"%s%s help lists all", help ? "help on" : "command", word,
                   hint_text(&h, "", meant), hint_program());
}

/* On nothing, a command or a topic. */
static int help(int argc, char **argv)
{
    static char option[] = "--help";
    if (argc == 1)
        return print_help(stdout);
    if (argc > 2)
        return trouble("help takes one command, not also \"%s\"", argv[2]);
    for (size_t i = 0; i < TOPICS; i++)
        if (strcmp(argv[1], topics[i].name) == 0)
            return fputs(topics[i].text, stdout) < 0 ? EXIT_TROUBLE : EXIT_DONE;
    const command *found = find_command(argv[1]);
    return found ? found->run(2, (char *[]){argv[0], option, NULL}) : refuse_word(argv[1], true);
}

static int run(int argc, char **argv)
{
    if (argc < 2)
        return print_help(stderr);
    if (strcmp(argv[1], "help") == 0 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)
        return help(argc - 1, argv + 1);
    if (strcmp(argv[1], "--version") == 0)
        return print_version();
    const command *found = find_command(argv[1]);
    return found ? found->run(argc - 1, argv + 1) : refuse_word(argv[1], false);
}

static void say_context(const char *name, const char *instead_of, const char *why)
{
    fprintf(stderr, "octreel: %s draws, since %s does not: %s\n", name, instead_of, why);
}

/* Output that could not be written is a failure, whatever the command returned. */
int main(int argc, char **argv)
{
    hint_set_program(argc > 0 ? argv[0] : NULL);
    draw_context_tell(say_context);
    const int status = run(argc, argv);
    if (fflush(stdout) == 0 && !ferror(stdout))
        return status;
    return trouble("what there is to say cannot be written to standard output");
}
