/* SPDX-License-Identifier: MIT */
/* commands.h - runs octreel or a line of shell as a child process, and returns its output and status. */
#ifndef COMMANDS_H
#define COMMANDS_H

#include <stdbool.h>
#include <stddef.h>

/* The environment of a run; zeros mean that of the test. */
typedef struct command_setting {
    const char *environment[4]; /* "NAME=value", added to the environment; the list ends with null */
    const char *input, *output; /* files that replace stdin and stdout */
    size_t file_limit;          /* no file can grow beyond this many bytes; 0 is no limit */
    bool terminal;              /* stderr is a terminal, with TERM=xterm unless `environment` sets TERM */
    unsigned columns;           /* width of the terminal; 0: unknown */
} command_setting;

typedef struct command_result {
    int status; /* the exit status, or 128 + the number of the signal */
    char *out;  /* the output to stdout, zero-terminated */
    char *err;  /* the output to stderr, zero-terminated */
} command_result;

/* Run octreel with formatted arguments, separated by blanks. `setting` may be null. The test fails if the program
 * cannot be run. */
command_result run_octreel(const command_setting *setting, const char *format, ...);

/* A text, quoted as one word of a shell line. */
typedef struct shell_word {
    char text[2048];
} shell_word;

shell_word shell_quote(const char *text);

/* The path of octreel, quoted for a shell line. */
const char *octreel_program(void);

/* Run a line of shell. The test fails if there is no shell. */
command_result run_shell(const char *line);

/* Run a formatted line of shell. */
command_result run_script(const char *format, ...);

/* Whether a shell finds a program of this name. */
bool is_program_installed(const char *name);

void command_release(command_result *result);

/* The test fails unless the status is 0 and stderr is empty. */
void assert_done(const command_result *result);

/* The test fails unless the status is 2, stdout is empty, and stderr is one line: "octreel: " and a sentence that
 * contains `part`. Releases the result. */
void assert_trouble(command_result *result, const char *part);

/* False if the system has no pseudo-terminals, as in a bare container. */
bool command_has_terminals(void);

#endif
