/* SPDX-License-Identifier: MIT */
/* commands.c - see commands.h. */
#define _XOPEN_SOURCE 700 /* pseudo terminals */

#include "commands.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fixture.h"

enum { ARGUMENTS = 64, LINE = 8192 };

/* Where the child writes, and where that is read. */
typedef struct channel {
    int child, test;
} channel;

/* What was read so far. */
typedef struct capture {
    int from;
    char *text;
    size_t size;
} capture;

static channel open_pipe(void)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    return (channel){ends[1], ends[0]};
}

bool command_has_terminals(void)
{
    const int own = posix_openpt(O_RDWR | O_NOCTTY);
    if (own >= 0)
        close(own);
    return own >= 0;
}

static channel open_terminal(unsigned columns)
{
    const int own = posix_openpt(O_RDWR | O_NOCTTY);
    assert_true(own >= 0);
    assert_int_equal(grantpt(own), 0);
    assert_int_equal(unlockpt(own), 0);
    const int other = open(ptsname(own), O_RDWR | O_NOCTTY);
    assert_true(other >= 0);
    assert_int_equal(ioctl(other, TIOCSWINSZ, &(struct winsize){.ws_row = 24, .ws_col = (unsigned short)columns}), 0);
    return (channel){other, own};
}

static channel open_output(const command_setting *setting)
{
    channel made = open_pipe();
    if (setting->output != NULL) {
        close(made.child);
        made.child = open(setting->output, O_WRONLY);
        assert_true(made.child >= 0);
    }
    return made;
}

/* What octreel is called, as where PATH has it. */
static char called[] = "octreel";

/* octreel and the arguments of a line, in place. */
static void split(char *line, char *arguments[ARGUMENTS])
{
    size_t count = 0;
    arguments[count++] = called;
    for (char *word = strtok(line, " "); word != NULL; word = strtok(NULL, " ")) {
        assert_true(count < ARGUMENTS - 1);
        arguments[count++] = word;
    }
    arguments[count] = NULL;
}

/* Of what a CI system sets around the tests, nothing is passed on but what a test asks for. */
static bool set_environment(const command_setting *setting)
{
    unsetenv("GITHUB_ACTIONS");
    if (setting->terminal && setenv("TERM", "xterm", 1) != 0)
        return false;
    for (size_t i = 0; i < sizeof setting->environment / sizeof *setting->environment; i++) {
        char name[64];
        const char *pair = setting->environment[i], *equals = pair == NULL ? NULL : strchr(pair, '=');
        if (pair == NULL)
            return true;
        if (equals == NULL || (size_t)(equals - pair) >= sizeof name)
            return false;
        memcpy(name, pair, (size_t)(equals - pair));
        name[equals - pair] = '\0';
        if (setenv(name, equals + 1, 1) != 0)
            return false;
    }
    return true;
}

/* Under AddressSanitizer leaks are looked for in the tests that film within their own process: in a child that ends
 * while Mesa's threads do, the search itself crashes now and then, and what it passes over is listed on stderr. */
static bool leave_leaks(void)
{
    char options[LINE];
    const char *given = getenv("ASAN_OPTIONS");
    snprintf(options, sizeof options, "%s:detect_leaks=0", given == NULL ? "" : given);
    return setenv("ASAN_OPTIONS", options, 1) == 0;
}

static bool set_limit(size_t bytes)
{
    struct rlimit limit;
    if (bytes == 0)
        return true;
    signal(SIGXFSZ, SIG_IGN); /* so that write() fails, as on a full disk */
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0)
        return false;
    limit.rlim_cur = bytes;
    return setrlimit(RLIMIT_FSIZE, &limit) == 0;
}

static void become_program(const command_setting *setting, char **arguments, int out, int err)
{
    const int in = setting->input == NULL ? STDIN_FILENO : open(setting->input, O_RDONLY);
    const bool ready = dup2(in, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0 && dup2(err, STDERR_FILENO) >= 0 &&
                       leave_leaks() && set_environment(setting) && set_limit(setting->file_limit);
    if (ready)
        execv(arguments[0] == called ? OCTREEL_PROGRAM : arguments[0], arguments);
    _exit(127);
}

/* Add what is there to read. False at the end, which a terminal tells by EIO. */
static bool read_more(capture *c)
{
    char bytes[4096];
    const ssize_t size = read(c->from, bytes, sizeof bytes);
    if (size < 0 && errno == EINTR)
        return true;
    if (size <= 0)
        return false;
    c->text = realloc(c->text, c->size + (size_t)size + 1);
    assert_non_null(c->text);
    memcpy(c->text + c->size, bytes, (size_t)size);
    c->size += (size_t)size;
    c->text[c->size] = '\0';
    return true;
}

static void read_both(capture captures[2])
{
    struct pollfd waiting[2] = {{captures[0].from, POLLIN, 0}, {captures[1].from, POLLIN, 0}};
    while (waiting[0].fd >= 0 || waiting[1].fd >= 0) {
        if (poll(waiting, 2, -1) < 0)
            continue;
        for (int i = 0; i < 2; i++)
            if (waiting[i].fd >= 0 && waiting[i].revents != 0 && !read_more(&captures[i]))
                waiting[i].fd = -1;
    }
}

static capture start_capture(int from)
{
    capture c = {from, calloc(1, 1), 0};
    assert_non_null(c.text);
    return c;
}

static command_result run(const command_setting *setting, char **arguments)
{
    const channel out = open_output(setting), err = setting->terminal ? open_terminal(setting->columns) : open_pipe();
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        close(out.test);
        close(err.test);
        become_program(setting, arguments, out.child, err.child);
    }
    close(out.child);
    close(err.child);
    capture captures[2] = {start_capture(out.test), start_capture(err.test)};
    read_both(captures);
    close(out.test);
    close(err.test);
    int status;
    while (waitpid(child, &status, 0) < 0)
        assert_int_equal(errno, EINTR);
    return (command_result){WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), captures[0].text,
                            captures[1].text};
}

command_result run_octreel(const command_setting *setting, const char *format, ...)
{
    static const command_setting plain = {.output = NULL};
    char line[LINE], *arguments[ARGUMENTS];
    va_list values;
    va_start(values, format);
    const int length = vsnprintf(line, sizeof line, format, values);
    va_end(values);
    assert_true(length >= 0 && length < LINE);
    split(line, arguments);
    return run(setting == NULL ? &plain : setting, arguments);
}

/* Between apostrophes all is plain but an apostrophe, which goes between two such pieces. */
shell_word shell_quote(const char *text)
{
    shell_word word = {"'"};
    size_t used = 1;
    for (; *text != '\0'; text++) {
        const char *piece = *text == '\'' ? "'\\''" : (char[]){*text, '\0'};
        assert_true(used + strlen(piece) + sizeof "'" <= sizeof word.text);
        strcpy(word.text + used, piece);
        used += strlen(piece);
    }
    strcpy(word.text + used, "'");
    return word;
}

const char *octreel_program(void)
{
    static shell_word word;
    word = shell_quote(OCTREEL_PROGRAM);
    return word.text;
}

command_result run_shell(const char *line)
{
    static char shell[] = "/bin/sh", option[] = "-c";
    static const command_setting plain = {.output = NULL};
    char copy[LINE];
    const int length = snprintf(copy, sizeof copy, "%s", line);
    assert_true(length >= 0 && length < LINE);
    return run(&plain, (char *[]){shell, option, copy, NULL});
}

command_result run_script(const char *format, ...)
{
    char line[LINE];
    va_list values;
    va_start(values, format);
    const int length = vsnprintf(line, sizeof line, format, values);
    va_end(values);
    assert_true(length >= 0 && length < LINE);
    return run_shell(line);
}

bool is_program_installed(const char *name)
{
    char line[128];
    snprintf(line, sizeof line, "command -v %s", name);
    command_result result = run_shell(line);
    const bool there = result.status == 0;
    command_release(&result);
    return there;
}

void command_release(command_result *result)
{
    free(result->out);
    free(result->err);
    *result = (command_result){0, NULL, NULL};
}

void assert_done(const command_result *result)
{
    assert_string_equal(result->err, "");
    assert_int_equal(result->status, 0);
}

void assert_trouble(command_result *result, const char *part)
{
    static const char prefix[] = "octreel: ";
    const char *end = strchr(result->err, '\n');
    if (strstr(result->err, part) == NULL)
        fail_msg("stderr is \"%s\" and does not contain \"%s\"", result->err, part);
    if (end == NULL || end[1] != '\0' || strncmp(result->err, prefix, sizeof prefix - 1) != 0)
        fail_msg("stderr is not a single line from octreel: \"%s\"", result->err);
    assert_string_equal(result->out, "");
    assert_int_equal(result->status, 2);
    command_release(result);
}
