/* SPDX-License-Identifier: MIT */
/* main.c - octreel's command line: a table of commands. */
#include "command.h"
#include "options.h"

#include <stdio.h>
#include <string.h>

typedef struct command {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *line; /* what it does, in one line */
} command;

static const command commands[] = {
    {"record", cmd_record, "film a session: every tick of the game becomes one PNG frame"},
    {"join", cmd_join, "make a recording that was filmed in chunks whole"},
    {"verify", cmd_verify, "play a recording again: is it still what its session makes?"},
    {"pick", cmd_pick, "say what is drawn at a pixel of a frame"},
    {"inspect", cmd_inspect, "build a tree from a point cloud, draw its subdivision, print its statistics"},
    {"diff", cmd_diff, "compare two pictures, folders of them or recordings, exactly or within a tolerance"},
    {"digest", cmd_digest, "write digests of many frames, a small reference for diff"},
    {"accept", cmd_accept, "take over new frames as the reference"},
};

#define COMMANDS (sizeof commands / sizeof commands[0])

static int print_help(FILE *out)
{
    fputs("octreel - an octree you can watch\n\nusage: octreel COMMAND [OPTION ...]\n\n", out);
    for (size_t i = 0; i < COMMANDS; i++)
        fprintf(out, "  %-10s %s\n", commands[i].name, commands[i].line);
    fputs("\n  octreel COMMAND --help   what a command takes\n"
          "  octreel --version        the version, and who would draw\n\n"
          "Exit status: 0 done, 1 finding, 2 trouble; stopped by a signal, that signal's (130 for Ctrl-C).\n",
          out);
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

static int run(int argc, char **argv)
{
    if (argc < 2)
        return print_help(stderr);
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)
        return print_help(stdout);
    if (strcmp(argv[1], "--version") == 0)
        return print_version();
    for (size_t i = 0; i < COMMANDS; i++) {
        if (strcmp(argv[1], commands[i].name) == 0) {
            static char name[] = "octreel"; /* what getopt's own messages begin with */
            argv[1] = name;
            return commands[i].run(argc - 1, argv + 1);
        }
    }
    return trouble("there is no command \"%s\"; octreel --help lists them", argv[1]);
}

/* Output that could not be written is a failure, whatever the command returned. */
int main(int argc, char **argv)
{
    const int status = run(argc, argv);
    if (fflush(stdout) == 0 && !ferror(stdout))
        return status;
    return trouble("what there is to say cannot be written to standard output");
}
