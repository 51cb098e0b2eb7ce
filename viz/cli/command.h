/* SPDX-License-Identifier: MIT */
/* command.h - the description of a command, which each cmd_*.c defines. The command line is read by it, and --help,
 * the manual and the completions of shells are written from it. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include "file_kind.h"
#include "options.h"

#include <getopt.h>

typedef struct command {
    const char *name;
    int (*run)(int argc, char **argv); /* runs the command, returns the exit status; argv[0] is the command's name */
    const command_option *options;     /* ends with a zeroed row; null: only the options that every command has */

    /* Help texts, in the notation of prose.h. Null: no text. */
    const char *line;        /* one line that says what the command does */
    const char *usage;       /* the arguments: "FRAME X Y [OPTION ...]" */
    const char *about;       /* printed before the options */
    const char *more;        /* printed after the options */
    const char *statuses[3]; /* meanings of exit statuses 0, 1, 2; null: "done" for 0, 1 is unused, "error" for 2 */
    const char *examples;    /* pairs of lines: "# what the command produces", then the command */
    const char *files;       /* printed only in the manual */
    const char *environment; /* printed only in the manual */

    const char *negative_error;       /* the error for an argument such as -10; null: "unknown option -1" */
    int min_arguments, max_arguments; /* how many arguments the command takes, without options */
    const char *takes;                /* words for the arguments in errors: "one session" */
    file_kinds inputs[2];             /* the kinds of file that the first and the second argument can be; 0: no file */
    bool refuses_standard_input;      /* "-" is refused, because the command also reads files beside its input */
    const char *files_pattern;        /* "*.pcd": the error for several files shows a shell loop over it; or null */
} command;

extern const command command_record, command_play, command_join, command_verify, command_audit, command_pick,
    command_inspect, command_diff, command_accept;

/* The program itself, as `octreel help` and the manual octreel(1) describe it. */
extern const command command_octreel;

/* Returns the n-th command; null if n is beyond the last. */
const command *command_at(size_t n);

/* A kind of file that `octreel help NAME` and a manual of section 5 describe. */
typedef struct help_topic {
    const char *name, *line;
    const char *text; /* the help text, in the notation of prose.h */
} help_topic;

/* Returns the n-th topic; null if n is beyond the last. */
const help_topic *help_topic_at(size_t n);

/* Gets the n-th row of a command's options. First come the rows of the command's own table, in which shared tables
 * are inserted, then the options that every command has. Returns false if n is beyond the last row. */
bool command_option_at(const command *c, size_t n, command_option *option);

/* Returns the meaning of an exit status; null if the command never returns it. */
const char *command_status(const command *c, int status);

/* Reads the options into the structure `arguments`. argv[optind] is then the first argument that is not an option.
 * Returns COMMAND_GO_ON or, after help or an error was printed, the exit status. */
enum { COMMAND_GO_ON = -1 };
int command_read_arguments(const command *c, void *arguments, int argc, char **argv);

#endif
