/* SPDX-License-Identifier: MIT */
/* command.h - the description of a command, which each cmd_*.c defines. The program reads the command line by this
 * description, and generates --help, the manual and the completions of shells from it. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include "file_kind.h"
#include "options.h"

#include <getopt.h>

typedef struct command {
    const char *name;
    int (*run)(int argc, char **argv); /* runs the command and returns its exit status; argv[0] is the command's name */
    /* The options, up to a zeroed row; null: the command has only the options that every command has. */
    const command_option *options;

    /* Help texts, in the notation of prose.h. Null: no text. */
    const char *line;  /* one line that says what the command does */
    const char *usage; /* the arguments after the command's name: "FRAME X Y [OPTION ...]" */
    const char *about; /* help text that is printed before the options */
    const char *more;  /* help text that is printed after the options */
    /* Meanings of the exit statuses 0, 1, 2; null: "done" for 0, not used for 1, "error" for 2. */
    const char *statuses[3];
    const char *examples;    /* examples, two lines each: "# what the command produces", then the command line */
    const char *files;       /* the section FILES; printed only in the manual */
    const char *environment; /* the section ENVIRONMENT; printed only in the manual */

    /* The error for an argument such as -10. Null: -10 is read as the options -1 and -0, so the error is "unknown
     * option -1". */
    const char *negative_error;
    int min_arguments, max_arguments; /* how many arguments the command takes, not counting options */
    const char *takes;                /* the arguments in words, for errors: "one session" */
    /* The kinds of files that the first and the second argument can be; 0: the argument is not a file. */
    file_kinds inputs[2];
    /* True: "-" is refused as an input, because the command also reads other files in the input's folder. */
    bool refuses_standard_input;
    /* A pattern such as "*.pcd". If several files are given, the error shows a shell loop over this pattern. Null: no
     * loop. */
    const char *files_pattern;
} command;

extern const command command_record, command_play, command_join, command_film, command_verify, command_audit,
    command_pick, command_inspect, command_diff, command_accept;

/* The program itself, as `octreel help` and the manual octreel(1) describe it. */
extern const command command_octreel;

/* Returns the n-th command; null if n is beyond the last. */
const command *command_at(size_t n);

/* A kind of file with a help text: `octreel help NAME` and a manual of section 5 print it. */
typedef struct help_topic {
    const char *name, *line;
    const char *text; /* the help text, in the notation of prose.h */
} help_topic;

/* Returns the n-th help topic; null if n is beyond the last. */
const help_topic *help_topic_at(size_t n);

/* Sets *option to the n-th option of a command. The options of the command's own table come first, including those of
 * shared tables that are inserted in it. The options that every command has come last. Returns false if n is beyond the
 * last option. */
bool command_option_at(const command *c, size_t n, command_option *option);

/* Returns the meaning of an exit status; null if the command never returns it. */
const char *command_status_meaning(const command *c, int status);

/* Reads the options into the structure `arguments`, and checks the other arguments; argv[optind] is then the first
 * argument that is not an option. Returns COMMAND_GO_ON. If help or an error was printed, returns the exit status of
 * the program instead. */
enum { COMMAND_GO_ON = -1 };
int command_read_arguments(const command *c, void *arguments, int argc, char **argv);

#endif
