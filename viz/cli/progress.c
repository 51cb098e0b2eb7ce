/* SPDX-License-Identifier: MIT */
/* progress.c - draws the progress bar, and checks for pending signals. */
#include "progress.h"
#include "options.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

/* ---- The bar ------------------------------------------------------------------------------------------------ */

#define BAR 32
#define LEAST_BAR 8 /* a shorter bar is left out */
#define LINE 512
#define SECONDS_BETWEEN 0.1

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* True if standard error is a terminal that can overwrite a line. */
static bool can_overwrite_line(void)
{
    const char *term = getenv("TERM");
    return term && *term && strcmp(term, "dumb") != 0 && isatty(STDERR_FILENO);
}

/* Asked anew each time, because the window may be resized. */
static int count_columns(void)
{
    struct winsize size;
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

progress progress_start(const char *unit)
{
    return (progress){.unit = unit, .started = now(), .visible = !is_quiet() && can_overwrite_line()};
}

double progress_seconds(const progress *p)
{
    return now() - p->started;
}

/* Overwrites the rest of a longer previous line with spaces. */
static void clear_rest(progress *p, int length, int columns)
{
    const int longer = p->length < columns ? p->length : columns;
    fprintf(stderr, "%*s", longer > length ? longer - length : 0, "");
    p->length = length;
}

/* Prints one line that fits the window: first the bar shrinks, then the text is cut. */
static void print_line(progress *p, const char *text)
{
    char bar[BAR + 1];
    const int columns = count_columns() - 1, room = columns - (int)strlen(text) - (int)strlen("[] ");
    const int length = room < BAR ? room : BAR;
    int written = 0;
    fputc('\r', stderr);
    if (length >= LEAST_BAR && p->fraction >= 0) {
        memset(bar, '.', (size_t)length);
        memset(bar, '#', (size_t)(p->fraction * length));
        written = fprintf(stderr, "[%.*s] ", length, bar);
    }
    written += fprintf(stderr, "%.*s", columns, text);
    clear_rest(p, written, columns);
    fflush(stderr);
}

void progress_show(progress *p, uint64_t done, uint64_t total)
{
    const double time = now();
    if (!p->visible || ((total == 0 || done < total) && time - p->shown < SECONDS_BETWEEN))
        return;
    p->shown = time;
    p->fraction = total > 0 ? (double)done / (double)total : -1;
    const double elapsed = time - p->started, rate = elapsed > 0 ? (double)done / elapsed : 0;
    const double left = total > 0 && rate > 0 ? (double)(total - done) / rate : 0;
    char text[LINE];
    if (total > 0)
        snprintf(text, sizeof text, "%" PRIu64 "/%" PRIu64 " %s  %.0f/s  %.0f s left", done, total, p->unit, rate,
                 left);
    else
        snprintf(text, sizeof text, "%" PRIu64 " %s  %.0f/s", done, p->unit, rate);
    print_line(p, text);
}

void progress_say(progress *p, const char *format, ...)
{
    va_list arguments;
    if (!p->visible)
        return;
    p->shown = now();
    char text[LINE];
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    print_line(p, text);
}

void progress_end(progress *p)
{
    if (!p->visible || p->shown <= 0)
        return;
    fputc('\r', stderr);
    clear_rest(p, 0, count_columns() - 1);
    fputc('\r', stderr);
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
        if (!is_ignored(signals[i])) /* nohup ignores SIGHUP, for example */
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
