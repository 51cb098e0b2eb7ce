/* SPDX-License-Identifier: MIT */
/* command.h - a command of octreel's: what it takes and all that is said about it. Its options are read by this, --help
 * and its manual print it, and shells complete by it. Each is defined in the cmd_*.c of its name. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include "file_kind.h"
#include "options.h"

#include <getopt.h>

typedef struct command {
    const char *name;
    int (*run)(int argc, char **argv); /* argv[0] is the program's name; returns the exit status */
    const command_option *options;     /* its own, ended by a zeroed one; may be null */

    /* What is said. Texts are as prose.h has them; null: there is nothing to say. */
    const char *line;        /* what it does, in one line */
    const char *usage;       /* what follows its name: "FRAME X Y [OPTION ...]" */
    const char *about;       /* before the options */
    const char *more;        /* behind them */
    const char *statuses[3]; /* what each exit status says; 0 "done" and 2 "trouble" when left out */
    const char *examples;    /* a line each */
    const char *files;       /* in the manual alone */
    const char *environment; /* likewise */

    const char *no_negative; /* the sentence about an argument such as -10; null: getopt's own */
    int least, most;         /* arguments beside the options */
    const char *takes;       /* what these are: "one session" */
    file_kinds inputs[2];    /* of the first of them; 0: it is no file. "-" is standard input where a file is taken, */
    bool no_standard_input;  /* unless it is read together with what lies beside it */
    const char *several;     /* files of which one makes a PNG, and all of which may be given: "*.pcd"; may be null */
} command;

extern const command command_record, command_play, command_join, command_verify, command_audit, command_pick,
    command_inspect, command_diff, command_accept;

/* octreel itself: what is said about all of it. */
extern const command command_octreel;

/* The n-th command; null beyond the last. */
const command *command_at(size_t n);
const command *find_command(const char *name);

/* What there is help on beside commands: files, each with a manual of section 5. */
typedef struct help_topic {
    const char *name, *line;
    const char *text; /* as prose.h has it */
} help_topic;

/* The n-th topic; null beyond the last. */
const help_topic *help_topic_at(size_t n);
const help_topic *find_help_topic(const char *name);

/* The n-th row of a command's options: its own, those of the tables that it shares with others, and those that all
 * commands have. False beyond the last. */
bool command_option_at(const command *c, size_t n, command_option *option);

/* What an exit status says; null where the command does not end with it. */
const char *command_status(const command *c, int status);

/* Read all options into the command's arguments; optind is then the first of the others. Returns COMMAND_GO_ON, or the
 * command's exit status: help was asked for, or the sentence about what does not fit is printed. */
enum { COMMAND_GO_ON = -1 };
int command_read_arguments(const command *c, void *arguments, int argc, char **argv);

#endif
