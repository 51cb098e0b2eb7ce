/* SPDX-License-Identifier: MIT */
/* progress.c - a progress bar, and pending signals. */
#include "progress.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* ---- The bar ------------------------------------------------------------------------------------------------ */

#define BAR 32
#define SECONDS_BETWEEN 0.1

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

progress progress_start(const char *unit)
{
    return (progress){.unit = unit, .started = now(), .visible = isatty(STDERR_FILENO)};
}

double progress_seconds(const progress *p)
{
    return now() - p->started;
}

static void print_bar(const progress *p)
{
    char bar[BAR + 1];
    memset(bar, '.', BAR);
    memset(bar, '#', (size_t)(p->fraction * BAR));
    bar[BAR] = 0;
    fprintf(stderr, "\r[%s] ", bar);
}

void progress_show(progress *p, uint64_t done, uint64_t total)
{
    const double time = now();
    if (!p->visible || total == 0 || (done < total && time - p->shown < SECONDS_BETWEEN))
        return;
    p->shown = time;
    p->fraction = (double)done / (double)total;
    const double elapsed = time - p->started, rate = elapsed > 0 ? (double)done / elapsed : 0;
    const double left = rate > 0 ? (double)(total - done) / rate : 0;
    print_bar(p);
    fprintf(stderr, "%" PRIu64 "/%" PRIu64 " %s  %.0f/s  %.0f s left \033[K", done, total, p->unit, rate, left);
    fflush(stderr);
}

void progress_say(progress *p, const char *format, ...)
{
    va_list arguments;
    if (!p->visible)
        return;
    p->shown = now();
    print_bar(p);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputs("\033[K", stderr);
    fflush(stderr);
}

void progress_end(progress *p)
{
    if (p->visible && p->shown > 0)
        fprintf(stderr, "\r\033[K");
}

/* ---- Signals ------------------------------------------------------------------------------------------------ */

static const int signals[] = {SIGHUP, SIGINT, SIGTERM};

#define SIGNALS (sizeof signals / sizeof signals[0])

static bool is_ignored(int number)
{
    struct sigaction action;
    return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

watch watch_begin(const char *unit)
{
    watch w = {.progress = progress_start(unit)};
    sigemptyset(&w.held);
    for (size_t i = 0; i < SIGNALS; i++)
        if (!is_ignored(signals[i])) /* as by nohup */
            sigaddset(&w.held, signals[i]);
    sigprocmask(SIG_BLOCK, &w.held, &w.before);
    return w;
}

void watch_progress(uint64_t done, uint64_t total, void *context)
{
    watch *w = context;
    progress_show(&w->progress, done, total);
}

bool watch_keep_going(void *context)
{
    const watch *w = context;
    sigset_t pending;
    if (sigpending(&pending) != 0)
        return true;
    for (size_t i = 0; i < SIGNALS; i++)
        if (sigismember(&w->held, signals[i]) == 1 && sigismember(&pending, signals[i]) == 1)
            return false;
    return true;
}

void watch_end(const watch *w)
{
    sigprocmask(SIG_SETMASK, &w->before, NULL);
}
