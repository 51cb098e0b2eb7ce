/* SPDX-License-Identifier: MIT */
/* plots.c - see plots.h. */
#include "plots.h"

#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "program.h"

/* The exit status; 127 when the program cannot be run. */
static int run_program(char *const *arguments)
{
    int status;
    const pid_t child = fork();
    if (child == 0) {
        execvp(arguments[0], arguments);
        _exit(127);
    }
    if (child < 0 || waitpid(child, &status, 0) != child)
        stop_with_error("%s cannot be started", arguments[0]);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

bool plots_can(void)
{
    return run_program((char *[]){"gnuplot", "-e", "exit", NULL}) == 0;
}

/* The scenes of a table, each once, with blanks between. */
static void list_scenes(const table *t, char *list, size_t room)
{
    size_t used = 0;
    list[0] = '\0';
    for (size_t i = 0; i < t->count; i++) {
        bool met = false;
        for (size_t j = 0; j < i && !met; j++)
            met = strcmp(t->rows[j].scene, t->rows[i].scene) == 0;
        if (!met && used < room)
            used += (size_t)snprintf(list + used, room - used, "%s%s", used ? " " : "", t->rows[i].scene);
    }
}

/* As gnuplot has it between apostrophes. The plots hand names of files to a shell, so that they get plain ones only. */
static void put_quoted(const char *folder, char *quoted, size_t room)
{
    size_t used = 0;
    for (; *folder != '\0'; folder++) {
        if (used + 3 > room)
            stop_with_error("the folder's name is too long");
        if (*folder == '\'')
            quoted[used++] = '\'';
        quoted[used++] = *folder;
    }
    quoted[used] = '\0';
}

void plot(const knob *k, const table *t, const char *folder)
{
    char values[10000], scenes[1024], script[4200], quoted[8192];
    list_scenes(t, scenes, sizeof scenes);
    put_quoted(folder, quoted, sizeof quoted);
    snprintf(values, sizeof values, "cd '%s'; csv='%s.csv'; png='%s.png'; scenes='%s'", quoted, k->name, k->name,
             scenes);
    snprintf(script, sizeof script, "%s/%s.gp", OCTREEL_PLOTS, k->name);
    char *const arguments[] = {"gnuplot", "-e", values, OCTREEL_PLOTS "/style.gp", script, NULL};
    if (run_program(arguments) != 0)
        stop_with_error("gnuplot fails on %s", script);
}
