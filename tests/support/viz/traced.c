/* SPDX-License-Identifier: MIT */
/* traced.c - see traced.h. */
#include "traced.h"

#ifdef __linux__
#include <sys/ptrace.h>
#endif

#ifndef PTRACE_GET_SYSCALL_INFO

bool trace_octreel(const char *arguments, const char *since, bool (*visit)(size_t call, void *context), void *context)
{
    (void)arguments, (void)since, (void)visit, (void)context;
    return false;
}

#else

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"

enum { SYSCALL_STOP = SIGTRAP | 0x80 };

/* Not every processor has all of them. */
static const long calls[] = {
    SYS_write,    SYS_close,  SYS_openat,    SYS_ftruncate, SYS_truncate,
    SYS_unlinkat, SYS_linkat, SYS_renameat2, SYS_mkdirat,
#ifdef SYS_open
    SYS_open,     SYS_unlink, SYS_link,      SYS_rename,    SYS_mkdir,
#endif
#ifdef SYS_renameat
    SYS_renameat,
#endif
};

static bool is_watched(long call)
{
    for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++)
        if (calls[i] == call)
            return true;
    return false;
}

static _Noreturn void become_traced(const char *arguments)
{
    char line[4096];
    const int nowhere = open("/dev/null", O_WRONLY);
    snprintf(line, sizeof line, "exec %s %s", octreel_program(), arguments);
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1); /* leaks cannot be looked for in a process that is traced */
    dup2(nowhere, STDOUT_FILENO);
    if (ptrace(PTRACE_TRACEME, 0, NULL, NULL) != 0)
        _exit(126);
    raise(SIGSTOP);
    execl("/bin/sh", "sh", "-c", line, (char *)NULL);
    _exit(127);
}

/* Whether a process that has stopped did so before a call that is watched. */
static bool is_at_call(pid_t pid, int status)
{
    struct __ptrace_syscall_info info;
    if (WSTOPSIG(status) != SYSCALL_STOP || ptrace(PTRACE_GET_SYSCALL_INFO, pid, (void *)sizeof info, &info) <= 0)
        return false;
    return info.op == PTRACE_SYSCALL_INFO_ENTRY && is_watched((long)info.entry.nr);
}

/* A signal that stops it is handed on, but for those of tracing itself. */
static long signal_of(int status)
{
    const int number = WSTOPSIG(status);
    return number == SYSCALL_STOP || number == SIGTRAP || number == SIGSTOP ? 0 : number;
}

static void end_killed(pid_t pid)
{
    int status;
    kill(pid, SIGKILL);
    while (waitpid(pid, &status, 0) == pid && !WIFSIGNALED(status))
        continue;
}

bool trace_octreel(const char *arguments, const char *since, bool (*visit)(size_t call, void *context), void *context)
{
    int status;
    size_t call = 0;
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0)
        become_traced(arguments);
    assert_int_equal(waitpid(pid, &status, 0), pid);
    if (WIFEXITED(status) ||
        ptrace(PTRACE_SETOPTIONS, pid, NULL, (void *)(PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL))) {
        end_killed(pid);
        return false;
    }
    while (WIFSTOPPED(status)) {
        if (is_at_call(pid, status) && file_exists(since) && !visit(call++, context)) {
            end_killed(pid);
            return true;
        }
        assert_int_equal(ptrace(PTRACE_SYSCALL, pid, NULL, (void *)signal_of(status)), 0);
        assert_int_equal(waitpid(pid, &status, 0), pid);
    }
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
    return true;
}

#endif
