/* SPDX-License-Identifier: MIT */
/* test_cli_lines.c - octreel writes each line of standard error by one call, however long its words are. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fixture.h"

enum { LONGEST = 1 << 17 };

/* Start octreel with a datagram socket as standard error: each call of write() is then a message of its own. */
static pid_t start_octreel(const int ends[2], const char *const arguments[])
{
    const pid_t child = fork();
    if (child != 0)
        return child;
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    execv(OCTREEL_PROGRAM, (char *const *)arguments);
    _exit(127);
}

static void assert_whole_lines(const char *const arguments[], int expected)
{
    static char message[LONGEST];
    int ends[2], status, lines = 0;
    assert_int_equal(socketpair(AF_UNIX, SOCK_DGRAM, 0, ends), 0);
    const pid_t child = start_octreel(ends, arguments);
    assert_true(child > 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 2);
    close(ends[1]);
    for (ssize_t size; (size = recv(ends[0], message, sizeof message, MSG_DONTWAIT)) > 0; lines++) {
        assert_int_equal(message[size - 1], '\n');
        assert_ptr_equal(memchr(message, '\n', (size_t)size), &message[size - 1]);
    }
    close(ends[0]);
    assert_int_equal(lines, expected);
}

static void errors_are_written_line_by_line(void **state)
{
    (void)state;
    char name[4000];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = 0;
    assert_whole_lines((const char *const[]){"octreel", "diff", "no\x01such", "folder", NULL}, 1);
    assert_whole_lines((const char *const[]){"octreel", "audit", name, NULL}, 1);
    assert_whole_lines((const char *const[]){"octreel", "inspekt", NULL}, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(errors_are_written_line_by_line)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
