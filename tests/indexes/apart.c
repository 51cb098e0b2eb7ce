/* SPDX-License-Identifier: MIT */
/* apart.c - see apart.h. */
#define _DEFAULT_SOURCE /* RLIMIT_AS */
#include "apart.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "program.h"

enum { SECONDS = 2 };

static const char *const programs[APART_PROGRAMS] = {OCTREE_ANSWER, OCTREE_ANSWER_FAST, OCTREE_ANSWER_CONTRACTED};

static FILE *open_temporary(void)
{
    FILE *file = tmpfile();
    if (!file)
        stop_with_error("no temporary file can be made");
    return file;
}

static void write_all(const void *data, size_t size, size_t count, FILE *out)
{
    if (fwrite(data, size, count, out) != count)
        stop_with_error("a temporary file cannot be written");
}

/* Replace this process. Sanitizers reserve more memory than the limit. */
static void become(apart_program program, const char *index, FILE *in, FILE *out)
{
    const struct rlimit seconds = {SECONDS, SECONDS + 1}, bytes = {1 << 30, 1 << 30}, none = {0, 0};
    dup2(fileno(in), STDIN_FILENO);
    dup2(fileno(out), STDOUT_FILENO);
    if (!freopen("/dev/null", "w", stderr)) /* libraries complain there */
        _exit(EXIT_TROUBLE);
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_CORE, &none);
    if (!OCTREEL_SANITIZED)
        setrlimit(RLIMIT_AS, &bytes);
    execl(programs[program], programs[program], index, (char *)NULL);
    _exit(127);
}

static apart_result wait_for(pid_t child, const char *program)
{
    int status;
    if (child < 0 || waitpid(child, &status, 0) != child || (WIFEXITED(status) && WEXITSTATUS(status) == 127))
        stop_with_error("%s cannot be started", program);
    if (WIFSIGNALED(status))
        return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL ? APART_HUNG : APART_CRASHED;
    return WEXITSTATUS(status) == EXIT_DONE      ? APART_ANSWERED
           : WEXITSTATUS(status) == EXIT_FINDING ? APART_REFUSED
                                                 : APART_CRASHED;
}

apart_result ask_apart(apart_program program, const char *index, const apart_question *question,
                       const octree_point *points, const octree_query *queries, apart_answer *answers)
{
    FILE *in = open_temporary(), *out = open_temporary();
    write_all(question, sizeof *question, 1, in);
    write_all(points, sizeof *points, question->point_count, in);
    write_all(queries, sizeof *queries, question->query_count, in);
    rewind(in);
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0)
        become(program, index, in, out);
    apart_result result = wait_for(child, programs[program]);
    rewind(out);
    if (result == APART_ANSWERED &&
        fread(answers, sizeof *answers, question->query_count, out) != question->query_count)
        result = APART_CRASHED;
    fclose(in);
    fclose(out);
    return result;
}
