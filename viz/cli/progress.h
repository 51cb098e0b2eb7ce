/* SPDX-License-Identifier: MIT */
/* progress.h - a progress bar for long tasks, and signals that stop a task after it has finished its files. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

/* A progress bar on standard error. It is shown only on a terminal, not with TERM=dumb, and not with --quiet. Each new
 * bar overwrites the last one after a carriage return; no escape sequences are printed. */
typedef struct progress {
    const char *unit;
    double started, shown; /* times of the start and of the last update, in seconds; shown is 0 before the first */
    double fraction;       /* the share that is done, 0 to 1; negative: unknown, no bar is drawn */
    int length;            /* of the line on the terminal, in characters */
    bool visible;
} progress;

/* `unit` names what is counted: "ticks". */
progress progress_start(const char *unit);

/* Update the bar, at most 10 times a second. `total` 0: unknown. The context is a progress, so that this function can
 * be the callback of a task. */
void progress_show(uint64_t done, uint64_t total, void *context);

/* Show a sentence beside the bar, for a step that cannot be counted. */
void progress_say(progress *p, const char *format, ...);

/* Erase the bar. */
void progress_end(progress *p);

/* Returns the seconds since progress_start(). */
double progress_seconds(const progress *p);

/* SIGHUP, SIGINT and SIGTERM stop a task only between two of its steps. They are blocked, unless they are ignored, and
 * the task asks has_no_stop_signal(), which is a callback and does not use its context, whether to go on. There is no
 * signal handler. unblock_stop_signals() delivers a pending signal, which then ends the program as its sender expects.
 */
void block_stop_signals(void);
bool has_no_stop_signal(void *context);
void unblock_stop_signals(void);

#endif
