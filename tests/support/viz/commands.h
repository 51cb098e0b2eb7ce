/* SPDX-License-Identifier: MIT */
/* commands.h - the program octreel, or a line of shell, run as a child: what it says, and how it ends. */
#ifndef COMMANDS_H
#define COMMANDS_H

#include <stdbool.h>
#include <stddef.h>

/* The surroundings of a run; zeros are those of the test. */
typedef struct command_setting {
    const char *environment[4]; /* "NAME=value", beside what is there; the first null ends them */
    const char *input, *output; /* files in place of stdin and stdout */
    size_t file_limit;          /* no file can grow beyond this many bytes; 0 is no limit */
    bool terminal;              /* stderr is a terminal, of TERM=xterm unless the environment says otherwise, */
    unsigned columns;           /* so wide; 0: it does not say */
} command_setting;

typedef struct command_result {
    int status; /* of the exit, or the signal's number and 128 */
    char *out;  /* all that came from stdout, zero-terminated */
    char *err;  /* likewise, stderr */
} command_result;

/* Run octreel with the arguments that a format gives, blanks between them. `setting` may be null. The test fails when
 * the program cannot be run. */
command_result run_octreel(const command_setting *setting, const char *format, ...);

/* A word of a shell's line that is read as some text, whatever is in it. */
typedef struct shell_word {
    char text[2048];
} shell_word;

shell_word shell_quote(const char *text);

/* The path of octreel as such a word: folders have any names. */
const char *octreel_program(void);

/* Run a line as a shell does. The test fails when there is no shell. */
command_result run_shell(const char *line);

/* The same for the line that a format gives. */
command_result run_script(const char *format, ...);

/* Whether a shell finds a program of this name. */
bool program_is_there(const char *name);

void command_release(command_result *result);

/* It ended with status 0 and said nothing on stderr. */
void assert_done(const command_result *result);

/* It ended with status 2, said nothing on stdout, and said one line on stderr: "octreel: " and a sentence that holds
 * `part`. The result is released. */
void assert_trouble(command_result *result, const char *part);

/* False where the system gives no pseudo-terminals, as in a bare container. */
bool command_has_terminals(void);

#endif
