/* SPDX-License-Identifier: MIT */
/* command_line.h - reads the command line of a command: its own options, and those that commands share. */
#ifndef CLI_COMMAND_LINE_H
#define CLI_COMMAND_LINE_H

#include "file_kind.h"
#include "options.h"
#include "query_options.h"

/* What a command takes. Shared options are those whose member is not null. */
typedef struct command_line {
    const char *name;
    const char *help, *more_help;  /* around the help of the shared options; more_help may be null */
    const command_option *options; /* the command's own, ended by a zeroed one; may be null */
    void *arguments;               /* where their values go */
    const char *no_negative;       /* the sentence about an argument such as -10; null: getopt's own */

    bool *json;                /* --json */
    renderer_choice *renderer; /* --context, --any-renderer */
    view_options *view;
    query_options *queries; /* --nearest, --radius, --range */

    int least, most;        /* arguments beside the options */
    const char *takes;      /* what these are: "one session" */
    file_kinds inputs[2];   /* of the first of them; 0: it is no file. "-" is standard input where a file is taken, */
    bool no_standard_input; /* unless it is read together with what lies beside it */
    const char *several;    /* files of which one makes a PNG, and all of which may be given: "*.pcd"; may be null */
} command_line;

/* Read all options; optind is then the first argument. Returns COMMAND_GO_ON, or the command's exit status: help was
 * asked for, or the sentence about what does not fit is printed. */
enum { COMMAND_GO_ON = -1 };
int command_line_read(const command_line *line, int argc, char **argv);

#endif
