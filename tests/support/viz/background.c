/* SPDX-License-Identifier: MIT */
/* background.c - see background.h. */
#include "background.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "files.h"
#include "fixture.h"

enum { LINE = 2048, MILLISECONDS = 30000 };

static _Noreturn void become_octreel(const char *line, int err)
{
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    close(err);
    setpgid(0, 0);
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1); /* see commands.c */
    execl("/bin/sh", "sh", "-c", line, (char *)NULL);
    _exit(127);
}

background start_octreel(const char *format, ...)
{
    char line[LINE];
    int ends[2];
    va_list values;
    const int used = snprintf(line, sizeof line, "exec %s ", octreel_program());
    va_start(values, format);
    const int length = vsnprintf(line + used, sizeof line - (size_t)used, format, values);
    va_end(values);
    assert_true(length >= 0 && length < LINE - used);
    assert_int_equal(pipe(ends), 0);
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        close(ends[0]);
        become_octreel(line, ends[1]);
    }
    close(ends[1]);
    setpgid(pid, pid); /* here too: whoever is first */
    return (background){pid, ends[0]};
}

/* Its end stays to be waited for. */
static bool has_ended(pid_t pid)
{
    siginfo_t ended = {.si_pid = 0};
    return waitid(P_PID, (id_t)pid, &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == pid;
}

bool wait_until_file_exists(const background *b, const char *path)
{
    const struct timespec pause = {0, 1000000};
    for (int i = 0; i < MILLISECONDS; i++) {
        const bool ended = has_ended(b->pid); /* asked first: the file may be the last that it wrote */
        if (file_exists(path) || ended)
            return file_exists(path);
        nanosleep(&pause, NULL);
    }
    return false;
}

void wait_for_file(background *b, const char *path)
{
    if (wait_until_file_exists(b, path))
        return;
    kill(b->pid, SIGKILL);
    const command_result result = wait_for_end(b);
    fail_msg("%s was not created; octreel ended with status %d: %s", path, result.status, result.err);
}

static pid_t parent_of(const char *pid)
{
    char path[300], text[512];
    snprintf(path, sizeof path, "/proc/%s/stat", pid);
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return 0;
    const size_t size = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[size] = '\0';
    const char *name_end = strrchr(text, ')'); /* "pid (name) state parent ..." */
    return name_end == NULL ? 0 : (pid_t)strtol(name_end + 4, NULL, 10);
}

pid_t find_child_process(pid_t parent, unsigned place)
{
    pid_t found = 0;
    DIR *processes = opendir("/proc");
    for (struct dirent *entry; processes != NULL && found == 0 && (entry = readdir(processes)) != NULL;)
        if (entry->d_name[0] >= '1' && entry->d_name[0] <= '9' && parent_of(entry->d_name) == parent && place-- == 0)
            found = (pid_t)strtol(entry->d_name, NULL, 10);
    if (processes != NULL)
        closedir(processes);
    return found;
}

command_result wait_for_end(background *b)
{
    command_result result = {0, calloc(1, 1), calloc(LINE, 1)};
    size_t size = 0;
    for (ssize_t got; (got = read(b->err, result.err + size, LINE - 1 - size)) != 0;) {
        assert_true(got > 0 || errno == EINTR);
        size += got > 0 ? (size_t)got : 0;
    }
    close(b->err);
    int status;
    while (waitpid(b->pid, &status, 0) < 0)
        assert_int_equal(errno, EINTR);
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}
