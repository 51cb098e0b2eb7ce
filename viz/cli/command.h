/* SPDX-License-Identifier: MIT */
/* command.h - the description of a command, which each cmd_*.c defines. From it the command line is read, and --help,
 * the manual and the completions of shells are written. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include "file_kind.h"
#include "options.h"

#include <getopt.h>

typedef struct command {
    const char *name;
    int (*run)(int argc, char **argv); /* argv[0] is the command's name; returns the exit status */
    const command_option *options;     /* ended by a zeroed row; null: only the options that every command has */

    /* Help texts, in the notation of prose.h; null: none. */
    const char *line;        /* says in one line what the command does */
    const char *usage;       /* the arguments: "FRAME X Y [OPTION ...]" */
    const char *about;       /* before the options */
    const char *more;        /* after the options */
    const char *statuses[3]; /* the meaning of exit statuses 0, 1, 2; null: "done", none, "error" */
    const char *examples;    /* lines in pairs: "# what the command produces", and the command */
    const char *files;       /* only in the manual */
    const char *environment; /* only in the manual */

    const char *negative_error;       /* printed for an argument such as -10; null: -1 is an unknown option */
    int min_arguments, max_arguments; /* not counting options */
    const char *takes;                /* the arguments in errors: "one session" */
    file_kinds inputs[2];             /* the kinds of file that the first and second argument may be; 0: no file */
    bool refuses_standard_input;      /* because the command also reads files beside its input */
    const char *files_pattern;        /* such as "*.pcd": the error for several files shows a shell loop; or null */
} command;

extern const command command_record, command_play, command_join, command_verify, command_audit, command_pick,
    command_inspect, command_diff, command_accept;

/* The program itself, for octreel help and octreel(1). */
extern const command command_octreel;

/* The n-th command; null: n is beyond the last. */
const command *command_at(size_t n);

/* A kind of file that `octreel help NAME` and a manual of section 5 describe. */
typedef struct help_topic {
    const char *name, *line;
    const char *text; /* in the notation of prose.h */
} help_topic;

/* The n-th topic; null: n is beyond the last. */
const help_topic *help_topic_at(size_t n);

/* Get the n-th row of a command's options: the rows of its own table, with the shared tables inserted, and then the
 * options that every command has. False: n is beyond the last. */
bool command_option_at(const command *c, size_t n, command_option *option);

/* The meaning of an exit status; null: the command never returns it. */
const char *command_status(const command *c, int status);

/* Read the options into the structure `arguments`; argv[optind] is then the first argument that is no option. Returns
 * COMMAND_GO_ON, or the exit status after it has printed help or an error. */
enum { COMMAND_GO_ON = -1 };
int command_read_arguments(const command *c, void *arguments, int argc, char **argv);

#endif
