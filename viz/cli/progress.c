/* SPDX-License-Identifier: MIT */
/* progress.c - draws the progress bar, and records signals that ask the program to stop. */
#include "progress.h"
#include "options.h"

#include <inttypes.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

/* ---- The bar ------------------------------------------------------------------------------------------------ */

#define MOST_BAR 32 /* the bar's largest length in characters */
#define LEAST_BAR 8 /* the bar's smallest length in characters; if less room is left, no bar is drawn */
#define LINE 512
#define SECONDS_BETWEEN_UPDATES 0.1

static double read_clock(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* Returns whether standard error is a terminal that can overwrite a line. */
static bool can_overwrite_line(void)
{
    const char *term = getenv("TERM");
    return term && *term && strcmp(term, "dumb") != 0 && isatty(STDERR_FILENO);
}

/* Returns the current width of the terminal, which the user may resize at any time. */
static int read_terminal_width(void)
{
    struct winsize size;
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

progress progress_start(const char *unit)
{
    return (progress){.unit = unit, .started = read_clock(), .visible = !is_quiet() && can_overwrite_line()};
}

double progress_seconds(const progress *p)
{
    return read_clock() - p->started;
}

/* If the new line on the terminal is shorter than the old line, overwrites the rest of the old line with spaces. */
static void erase_rest_of_old_line(progress *p, int length, int columns)
{
    const int end = p->length < columns ? p->length : columns;
    fprintf(stderr, "%*s", end > length ? end - length : 0, "");
    p->length = length;
}

/* Prints one line that fits the terminal's width. If the line is too long, the bar shrinks; if that is not enough,
 * the text is cut. */
static void print_line(progress *p, const char *text)
{
    char bar[MOST_BAR + 1];
    const int columns = read_terminal_width() - 1, room = columns - (int)strlen(text) - (int)strlen("[] ");
    const int length = room < MOST_BAR ? room : MOST_BAR;
    int written = 0;
    fputc('\r', stderr);
    if (length >= LEAST_BAR && p->fraction >= 0) {
        memset(bar, '.', (size_t)length);
        memset(bar, '#', (size_t)(p->fraction * length));
        written = fprintf(stderr, "[%.*s] ", length, bar);
    }
    written += fprintf(stderr, "%.*s", columns, text);
    erase_rest_of_old_line(p, written, columns);
    fflush(stderr);
}

void progress_show(uint64_t done, uint64_t total, void *context)
{
    progress *p = context;
    const double time = read_clock();
    if (!p->visible || ((total == 0 || done < total) && time - p->shown < SECONDS_BETWEEN_UPDATES))
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

void progress_show_sentence(progress *p, const char *format, ...)
{
    va_list arguments;
    if (!p->visible)
        return;
    p->shown = read_clock();
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
    erase_rest_of_old_line(p, 0, read_terminal_width() - 1);
    fputc('\r', stderr);
    fflush(stderr);
}

/* ---- Signals ------------------------------------------------------------------------------------------------ */

enum { GRACE = 5 /* seconds between a stop signal and the end of a program that does not stop by itself */ };

static const int stop_signals[] = {SIGHUP, SIGINT, SIGTERM};

#define STOP_SIGNALS (sizeof stop_signals / sizeof stop_signals[0])

static struct sigaction actions_before[STOP_SIGNALS];
static volatile sig_atomic_t stop_signal; /* the first stop signal that arrived; 0: no signal */

static void end_process_by_stop_signal(int alarm_signal)
{
    (void)alarm_signal;
    signal(stop_signal, SIG_DFL);
    raise(stop_signal);
}

static void record_stop_signal(int sent)
{
    if (stop_signal)
        return;
    stop_signal = sent;
    signal(SIGALRM, end_process_by_stop_signal);
    alarm(GRACE);
}

void defer_stop_signals(void)
{
    struct sigaction noting = {.sa_handler = record_stop_signal, .sa_flags = SA_RESTART};
    sigset_t stops;
    sigemptyset(&noting.sa_mask);
    sigemptyset(&stops);
    sigaddset(&stops, SIGALRM); /* SIGALRM ends the program after GRACE seconds */
    for (size_t i = 0; i < STOP_SIGNALS; i++) {
        sigaddset(&stops, stop_signals[i]);
        if (sigaction(stop_signals[i], NULL, &actions_before[i]) == 0 && actions_before[i].sa_handler != SIG_IGN)
            /* Signals that were ignored stay ignored: nohup ignores SIGHUP. */
            sigaction(stop_signals[i], &noting, NULL);
    }
    sigprocmask(SIG_UNBLOCK, &stops, NULL); /* unblock the signals, because the parent process may have blocked them */
}

bool has_no_stop_signal(void *context)
{
    (void)context;
    return stop_signal == 0;
}

void deliver_stop_signal(void)
{
    for (size_t i = 0; i < STOP_SIGNALS; i++)
        sigaction(stop_signals[i], &actions_before[i], NULL);
    if (stop_signal)
        raise(stop_signal);
}
