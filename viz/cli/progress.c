/* progress.c - how far a long work is, on a terminal alone. */
#include "command.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

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
    memset(bar, '#', (size_t)(p->part * BAR));
    bar[BAR] = 0;
    fprintf(stderr, "\r[%s] ", bar);
}

void progress_show(progress *p, uint64_t done, uint64_t total)
{
    const double time = now();
    if (!p->visible || total == 0 || (done < total && time - p->shown < SECONDS_BETWEEN))
        return;
    p->shown = time;
    p->part = (double)done / (double)total;
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
